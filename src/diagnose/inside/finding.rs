//! What is known of a place that mends everything.

use super::candidates::Mend;
use super::quantities::Quantity;
use super::search::Search;
use super::walk::{Suspect, made_of};
use super::{Finding, Flaw, Stage, What, variable};
use crate::compare::COLOUR_TOLERANCE;
use crate::diagnose::columns::{ScalarColumns, is_colour, is_same};
use reference::interpreter::Scalar;
use reference::interpreter::trace::Event;

impl Search<'_, '_> {
    /// What is said of a place.
    pub(super) fn finding(&self, mend: &Mend) -> Option<Finding> {
        let trace = self.trace(mend.stage)?;
        let sites = self.theirs.stage(mend.stage).sites();
        let site = &sites[mend.suspect.site];
        let quantity = mend.quantity.map(|number| &self.quantities.all[number]);
        let event = &trace.events[*mend.suspect.events.first()?];
        let missing = self.missing_in(mend);
        let flaw = match quantity {
            _ if site.kind.scalar() == Some(Scalar::Bool) => Flaw::Condition,
            Some(_) => missing.clone().map_or(Flaw::Value, Flaw::Lacks),
            None => Flaw::Value,
        };
        let overwritten = match &flaw {
            Flaw::Lacks(_) => self.overwritten(mend, quantity),
            _ => None,
        };
        let thrown_away = mend.values.first().and_then(|wanted| self.thrown_away(mend.stage, wanted));
        let (line, flaw) = match thrown_away {
            Some(line) => (line, Flaw::ThrownAway),
            None => overwritten.map_or((site.line, flaw), |line| (line, Flaw::Overwrites)),
        };
        let handed_over = if flaw == Flaw::Value && quantity.is_some() { self.handed_over(mend) } else { None };
        let is_handed_over = handed_over.is_some();
        let (stage, line, name) = match handed_over {
            Some((line, name)) => (Stage::Vertex, line, Some(name)),
            None => (mend.stage, line, variable(sites, mend.suspect.site)),
        };
        let lane = worst(event, &mend.values[0]);
        // What a fragment is given is no value of the vertex stage.
        let at = |columns: &ScalarColumns| match is_handed_over {
            true => Vec::new(),
            false => columns.iter().map(|column| column[lane]).collect(),
        };
        let serves = quantity.and_then(|quantity| self.quantities.served_by(quantity));
        let is_of_one_line = serves.as_ref().is_some_and(|name| self.assignment.is_of_one_line(name));
        Some(Finding {
            stage,
            line,
            name,
            quantity: quantity.and_then(|quantity| quantity.names.first().cloned()),
            features: if is_of_one_line { Vec::new() } else { self.lines_around(self.mended(mend)) },
            serves,
            is_settled: self.is_settled(mend),
            is_whole: self.is_whole(mend),
            is_telling: (self.is_telling(mend) || flaw != Flaw::Value) && !self.is_start(mend),
            touches_position: !self.is_in_place(self.own),
            is_use: !is_handed_over && matches!(site.what, What::Read(_)),
            touches: match missing {
                Some(missing) => missing,
                None => quantity.map_or_else(Vec::new, |quantity| self.quantities.touched_by(quantity)),
            },
            flaw,
            expected: at(&mend.values[0]),
            found: at(&event.values),
        })
    }

    /// The last place that is given a sum of right terms which lacks some, and is right with all of them.
    pub(super) fn lacking_sum(&mut self, places: &[(Stage, Suspect)]) -> Option<Mend> {
        let given = places.iter().rev().filter(|(stage, one)| self.is_assignment(*stage, one));
        let given: Vec<&(Stage, Suspect)> = given.collect();
        let mend = given.into_iter().find_map(|(stage, one)| self.mend_at(*stage, one))?;
        self.missing_in(&mend).is_some().then_some(mend)
    }

    /// What a place lacks of a sum. An addend that is there wherever it shows is not missing: it makes no difference where all is wrong.
    pub(super) fn missing_in(&self, mend: &Mend) -> Option<Vec<String>> {
        let trace = self.trace(mend.stage)?;
        let quantity = mend.quantity.map(|number| &self.quantities.all[number])?;
        let missing = self.lacking(&trace.events[*mend.suspect.events.first()?], quantity)?;
        let addend = |name: &&String| quantity.addends.iter().find(|(own, _)| own.as_ref() == Some(name));
        let is_lost = |name: &&String| addend(name).is_none_or(|(_, addend)| !self.is_there_where_it_shows(addend));
        let lost: Vec<String> = missing.iter().filter(is_lost).cloned().collect();
        Some(if lost.is_empty() { missing } else { lost })
    }

    /// Whether an addend shows at a place that is right, and at none that is wrong.
    fn is_there_where_it_shows(&self, addend: &ScalarColumns) -> bool {
        let is_right = |place: usize| is_colour(self.wanted.colours[place], self.own.colours[place]);
        let shows = |place: usize| {
            let of_place = |column: &Vec<f64>| {
                let each = column.len() / self.count;
                column[place * each..][..each].iter().any(|number| number.abs() > COLOUR_TOLERANCE)
            };
            addend.iter().any(of_place)
        };
        let (right, wrong): (Vec<usize>, Vec<usize>) = (0..self.count).partition(|place| is_right(*place));
        right.into_iter().any(shows) && !wrong.into_iter().any(shows)
    }

    /// The addends that a sum lacks, where what it has are the others.
    pub(super) fn lacking(&self, event: &Event, quantity: &Quantity) -> Option<Vec<String>> {
        let addends = &quantity.addends;
        if addends.len() < 2 || addends.len() > 8 {
            return None;
        }
        let sum = |chosen: usize| -> ScalarColumns {
            let width = event.values.len();
            let lanes = event.lanes.len();
            let mut total = vec![vec![0.0; lanes]; width];
            for (_, addend) in addends.iter().enumerate().filter(|(at, _)| chosen >> at & 1 == 1).map(|(_, one)| one) {
                for (scalar, column) in total.iter_mut().enumerate() {
                    let own = addend.get(scalar).or(addend.first().filter(|_| addend.len() == 1));
                    if let Some(own) = own {
                        column.iter_mut().zip(own).for_each(|(to, from)| *to += from);
                    }
                }
            }
            total
        };
        let all = (1_usize << addends.len()) - 1;
        // What a colour has as alpha is often written beside the sum.
        let mut colour = event.clone();
        colour.values.truncate(3);
        let is_it = |chosen: &usize| {
            let mut sum = sum(*chosen);
            is_same(event, &sum) || {
                sum.truncate(3);
                is_same(&colour, &sum)
            }
        };
        let chosen = (0..all).find(is_it)?;
        let missing = addends.iter().enumerate().filter(|(at, _)| chosen >> at & 1 == 0);
        missing.map(|(_, (name, _))| name.clone()).collect()
    }

    /// The line of the statement that writes over what a sum lacks.
    pub(super) fn overwritten(&self, mend: &Mend, quantity: Option<&Quantity>) -> Option<u32> {
        let trace = self.trace(mend.stage)?;
        let sites = self.theirs.stage(mend.stage).sites();
        let name = variable(sites, mend.suspect.site)?;
        let missing = self.missing_in(mend)?;
        let is_missing = |event: &Event| {
            let lost =
                quantity?.addends.iter().filter(|(name, _)| name.as_ref().is_some_and(|name| missing.contains(name)));
            Some(lost.into_iter().any(|(_, addend)| is_same(event, addend)))
        };
        let writes = trace
            .events
            .iter()
            .enumerate()
            .filter(|(_, event)| matches!(&sites[event.site].what, What::Assign { name: own, .. } if *own == name));
        let writes: Vec<(usize, &Event)> = writes.collect();
        let is_kept = |from: &usize, before: usize| *from == before || made_of(trace, &[*from]).contains(&before);
        let pair = writes.windows(2).find(|pair| {
            let (before, after) = (pair[0].0, pair[1].1);
            is_missing(pair[0].1) == Some(true) && !after.from.iter().any(|from| is_kept(from, before))
        })?;
        Some(sites[pair[1].1.site].line)
    }

    /// The line of a statement that computes what is needed, and does nothing with it.
    pub(super) fn thrown_away(&self, stage: Stage, wanted: &ScalarColumns) -> Option<u32> {
        let trace = self.trace(stage)?;
        let sites = self.theirs.stage(stage).sites();
        let event = trace.events.iter().find(|event| !sites[event.site].is_used && is_same(event, wanted))?;
        Some(sites[event.site].line)
    }
}

/// The lane where a value is furthest from what it should be.
fn worst(event: &Event, wanted: &ScalarColumns) -> usize {
    let apart = |lane: usize| {
        let columns = event.values.iter().zip(wanted);
        let apart = columns.map(|(own, wanted)| (own[lane] - wanted[lane]).abs()).fold(0.0, f64::max);
        if event.lanes[lane] && apart.is_finite() { apart } else { -1.0 }
    };
    (0..event.lanes.len()).max_by(|a, b| apart(*a).total_cmp(&apart(*b)).then(b.cmp(a))).unwrap_or(0)
}
