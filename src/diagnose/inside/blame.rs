//! Whether a place that would mend everything is the one to speak of.

use super::candidates::Mend;
use super::search::{ONES, Search};
use super::{Binary, Stage, Trace, What};
use crate::diagnose::columns::{is_colour, is_constant, is_equal, is_same};
use glam::DVec3;
use reference::interpreter::Scalar;
use reference::interpreter::trace::{Event, Site};
use std::collections::BTreeSet;

impl Search<'_, '_> {
    /// Whether a place is the one to speak of, should this mend all. A value that is right by itself is only wrong where it is
    /// used, unless it is not finished yet.
    pub(super) fn is_to_blame(&self, mend: &Mend) -> bool {
        let Some(trace) = self.trace(mend.stage) else { return false };
        let Some(event) = mend.suspect.events.first().map(|event| &trace.events[*event]) else { return false };
        let site = self.site(mend.stage, &mend.suspect);
        // A number that has a name, or is computed, is not wrong where it should make no difference: its use is.
        let is_neutral = |one: f64| mend.values[0].iter().flatten().all(|number| *number == one);
        let is_whole_number = site.kind.scalar() != Some(Scalar::Bool) && ONES.into_iter().any(is_neutral);
        if is_whole_number && !matches!(site.what, What::Literal | What::Read(_)) {
            return false;
        }
        let Some(quantity) = mend.quantity.map(|number| &self.quantities.all[number]) else {
            // A value that is right has its reasons, and what decides is asked by itself.
            return !mend.suspect.is_right;
        };
        let name = match &site.what {
            What::Assign { name, .. } => Some(name),
            _ => None,
        };
        if self.is_right_elsewhere(mend, trace) {
            return false;
        }
        if name.is_some_and(|name| quantity.names.contains(name)) {
            return true;
        }
        // A sum that lacks something: what is there of it is right.
        let is_sum = matches!(site.what, What::Binary(Binary::Add | Binary::Subtract)) || self.goes_out(mend);
        if !is_sum && quantity.addends.iter().any(|(_, addend)| is_same(event, addend)) {
            return false;
        }
        let Some(right) = self.quantities.equal_to(mend.stage, event) else { return true };
        // A number is what many are by chance.
        let is_by_chance = quantity.is_constant && event.values.len() == 1;
        let is_known = !quantity.names.is_empty() || quantity.is_interpolated && self.is_other_input(mend, trace);
        let is_of_its_kind = event.values.len() == quantity.turns[0].len() && !is_by_chance && is_known;
        if !mend.suspect.gives_right || matches!(site.what, What::Read(_)) {
            return is_of_its_kind;
        }
        // What the right answer has no name for is a step on the way to something.
        right.names.is_empty()
            || self.quantities.finishes(quantity, right)
            || name.is_some() && self.is_computed_twice(mend, trace)
    }

    /// What a place is computed from in its statement, and the arguments that come to it; `None` for a condition.
    pub(super) fn operands(&self, mend: &Mend) -> Option<BTreeSet<usize>> {
        let trace = self.trace(mend.stage)?;
        let sites = self.theirs.stage(mend.stage).sites();
        let is_bool = |event: usize| sites[trace.events[event].site].kind.scalar() == Some(Scalar::Bool);
        let mut found = BTreeSet::new();
        let mut open = mend.suspect.events.clone();
        while let Some(event) = open.pop() {
            if is_bool(event) || !found.insert(event) {
                continue;
            }
            let is_end = |from: &&usize| !matches!(sites[trace.events[**from].site].what, What::Assign { .. });
            open.extend(trace.events[event].from.iter().filter(is_end));
        }
        Some(found)
    }

    /// Whether the mistake stands there, and not only what is seen of it.
    pub fn is_telling(&self, mend: &Mend) -> bool {
        !self.is_whole(mend) || self.missing_in(mend).is_some() || self.is_settled(mend) || self.is_own_statement(mend)
    }

    /// Whether the statement itself is to blame: all variables that it reads have right values.
    fn is_own_statement(&self, mend: &Mend) -> bool {
        let (Some(near), Some(trace)) = (self.operands(mend), self.trace(mend.stage)) else { return false };
        let sites = self.theirs.stage(mend.stage).sites();
        let mut reads = near.iter().map(|event| &trace.events[*event]);
        reads.all(|event| {
            !matches!(sites[event.site].what, What::Read(_))
                || is_constant(&event.values)
                || self.quantities.equal_to(mend.stage, event).is_some()
        })
    }

    /// Whether a variable only begins there, with a number, and is given other values further on.
    pub fn is_start(&self, mend: &Mend) -> bool {
        let sites = self.theirs.stage(mend.stage).sites();
        let (What::Assign { name, .. }, Some(near)) = (&sites[mend.suspect.site].what, self.operands(mend)) else {
            return false;
        };
        let is_other = |(at, site): (usize, &Site)| {
            at > mend.suspect.site && matches!(&site.what, What::Assign { name: own, .. } if own == name)
        };
        let Some(trace) = self.trace(mend.stage) else { return false };
        let mut reads = near.iter().map(|event| &sites[trace.events[*event].site].what);
        !reads.any(|what| matches!(what, What::Read(_))) && sites.iter().enumerate().any(is_other)
    }

    /// Whether all that a place is computed from is right, or the same everywhere.
    pub(super) fn is_settled(&self, mend: &Mend) -> bool {
        let Some(trace) = self.trace(mend.stage) else { return false };
        let sites = self.theirs.stage(mend.stage).sites();
        let mut open = mend.suspect.events.clone();
        while let Some(event) = open.pop() {
            let is_copy = matches!(sites[trace.events[event].site].what, What::Assign { .. });
            for from in &trace.events[event].from {
                let own = &trace.events[*from];
                if is_copy && own.values == trace.events[event].values {
                    open.push(*from);
                } else if !is_constant(&own.values) && self.quantities.equal_to(mend.stage, own).is_none() {
                    return false;
                }
            }
        }
        true
    }

    /// Whether a place is a scalar that is the same everywhere, and not written there.
    pub(super) fn is_number(&self, mend: &Mend) -> bool {
        let Some(trace) = self.trace(mend.stage) else { return false };
        let site = self.site(mend.stage, &mend.suspect);
        let is_written = matches!(site.what, What::Literal | What::Read(_)) || site.kind.scalar() == Some(Scalar::Bool);
        let is_it = |event: &usize| trace.events[*event].values.len() == 1 && is_constant(&trace.events[*event].values);
        !is_written && mend.suspect.events.iter().all(is_it)
    }

    /// Whether a function computes right in another call what it computes wrong here: then what it is given is to blame.
    pub(super) fn is_right_elsewhere(&self, mend: &Mend, trace: &Trace) -> bool {
        let site = self.site(mend.stage, &mend.suspect);
        let is_function = site.function.as_deref().is_some_and(|name| name != "main");
        let turn = |at: usize| if mend.values.len() == 1 { &mend.values[0] } else { &mend.values[at] };
        let mut events = mend.suspect.events.iter().enumerate();
        is_function
            && mend.suspect.events.len() > 1
            && events.any(|(at, event)| is_same(&trace.events[*event], turn(at)))
    }

    /// Whether another place computes the same by itself.
    pub(super) fn is_computed_twice(&self, mend: &Mend, trace: &Trace) -> bool {
        let Some(&first) = mend.suspect.events.first() else { return false };
        let own = &trace.events[first];
        let sites = self.theirs.stage(mend.stage).sites();
        let computes = |event: &Event| {
            matches!(sites[event.site].what, What::Binary(_) | What::Call(_) | What::Unary | What::Part)
        };
        let others = trace.events.iter().filter(|event| computes(event) && is_equal(&event.values, &own.values));
        let mut lines: Vec<u32> = others.map(|event| sites[event.site].line).collect();
        lines.sort_unstable();
        lines.dedup();
        lines.len() > 1
    }

    /// Whether a value is what an output of the last stage is given.
    pub(super) fn goes_out(&self, mend: &Mend) -> bool {
        let is_last = mend.stage == Stage::Fragment || self.trace(Stage::Fragment).is_none();
        let outputs = self.trace(mend.stage).filter(|_| is_last).map(|trace| &trace.outputs);
        outputs.is_some_and(|outputs| outputs.iter().flatten().any(|event| mend.suspect.events.contains(event)))
    }

    /// Whether what has to stand in a place is all that is seen.
    pub(super) fn is_whole(&self, mend: &Mend) -> bool {
        let Some(columns) = mend.values.last().filter(|columns| columns.len() >= 3) else { return false };
        let each = columns[0].len() / self.count.max(1);
        let own = |at: usize| DVec3::new(columns[0][at * each], columns[1][at * each], columns[2][at * each]);
        let is_it = |at: usize| {
            let wanted = self.wanted.colours[at];
            is_colour(wanted, own(at)) || is_colour(wanted, own(at).clamp(DVec3::ZERO, DVec3::ONE))
        };
        (0..self.count).all(is_it)
    }
}
