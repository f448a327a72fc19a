//! The search for the statement that computes a definition, or for the sum that lacks it.

use super::super::inside::others;
use super::{Located, MistakeOrigin, TracedProbes};
use crate::diagnose::columns::{ScalarColumns, fits, is_colour, is_same, is_zero, shaped};
use crate::diagnose::trials::{StageChanges, change};
use glam::DVec3;
use reference::interpreter::Binary;
use reference::interpreter::trace::{Site, ValueChange, What};
use reference::mistake::{FoundMistake, Mistake};
use std::collections::BTreeSet;

/// A mistake that makes something 0 everywhere that should not be.
struct Missing {
    /// The definition that it replaces.
    definition: usize,
    /// That definition without the mistake, and with it.
    right: ScalarColumns,
    wrong: ScalarColumns,
    /// The colour at each point without the mistake.
    wanted: Vec<DVec3>,
    handed_out: bool,
}

impl TracedProbes<'_> {
    /// The place of the first of these definitions that is all there is to mend. `usual`: the same text where nothing is to be mended,
    /// in which the place has the definition's value: what only mends by chance is another one.
    pub fn place_of(&mut self, definitions: &[String], usual: &TracedProbes<'_>) -> Option<Located> {
        let equation = &self.assignment.equation;
        let right = self.definitions(&equation.right());
        let wanted = self.colours(&equation.right());
        let as_usual = usual.definitions(&usual.assignment.equation.right());
        let chosen: Vec<usize> = definitions.iter().filter_map(|name| equation.index(name)).collect();
        let found = chosen.into_iter().find_map(|d| {
            let mut mending = self.mending(&right[d], &wanted, false).into_iter();
            mending.find(|event| usual.has_at(&self.sites[self.trace.events[*event].site], &as_usual[d]))
        })?;
        Some(self.located(found, MistakeOrigin::Wrong))
    }

    /// Whether a place of the text has this value. Sites have other numbers where a constant is written in another way.
    fn has_at(&self, place: &Site, value: &ScalarColumns) -> bool {
        let is_it = |site: &Site| site.line == place.line && site.what == place.what;
        self.trace.events.iter().any(|event| is_it(&self.sites[event.site]) && is_same(event, value))
    }

    /// Where a term is that mistake `index` makes 0 everywhere, or else the sum in which it does not appear. `None` for any
    /// other mistake.
    pub fn missing(&mut self, found: &[FoundMistake], index: usize) -> Option<Located> {
        let missing = self.of_mistake(found, index)?;
        let d = missing.definition;
        // What is 0 at the points may be another term.
        if self.has_constants_of(d) {
            let zero = self.mending(&missing.right, &missing.wanted, missing.handed_out);
            if let Some(zero) = zero.into_iter().find(|event| !self.is_start_of_sum(*event)) {
                return Some(self.located(zero, MistakeOrigin::Zero));
            }
        }
        let role = if self.has_influence(d) { MistakeOrigin::Lost } else { MistakeOrigin::Absent };
        if let Some(sum) = self.last_sum(&missing) {
            return Some(self.located(sum, role));
        }
        let output = &self.assignment.interface.outputs.first()?.name;
        let stores = |whole: bool| {
            self.sites.iter().rfind(
                |site| matches!(&site.what, What::Assign { name, is_part } if name == output && !(whole && *is_part)),
            )
        };
        Some(Located { role, ..Located::at(stores(true).or_else(|| stores(false))?.line) })
    }

    /// The condition that decides where a mistake shows that is one: all is right on the other side of it.
    pub fn condition(&self, found: &[FoundMistake], index: usize) -> Option<Located> {
        let own = self.assignment.mistake(&found[index].id)?.forms.get(found[index].form)?;
        if !own.overrides.iter().any(|one| one.text.contains('?')) {
            return None;
        }
        let wanted = self.colours(&self.assignment.variant(&others(found, index))?);
        let is_wrong: Vec<bool> =
            self.seen.iter().zip(&wanted).map(|(own, wanted)| !is_colour(*wanted, *own)).collect();
        let events = self.trace.events.iter();
        let conditions: BTreeSet<usize> = events.flat_map(|event| event.under.iter().copied()).collect();
        let shares =
            conditions.into_iter().flat_map(|at| [0.0, 1.0].map(|side| (at, side))).filter_map(|(at, side)| {
                let event = &self.trace.events[at];
                let is_there = |place: usize| {
                    let lane = place * self.each;
                    event.lanes[lane] && event.values[0][lane] == side
                };
                let there: Vec<usize> = (0..is_wrong.len()).filter(|place| is_there(*place)).collect();
                let wrong = there.iter().filter(|place| is_wrong[**place]).count();
                let is_all = wrong > 0 && wrong == is_wrong.iter().filter(|is| **is).count();
                (is_all && there.len() < is_wrong.len() && self.is_own(event)).then_some((at, there.len()))
            });
        // By as little as may be besides.
        let (found, _) = shares.min_by_key(|(_, all)| *all)?;
        Some(self.located(found, MistakeOrigin::Wrong))
    }

    fn of_mistake(&mut self, found: &[FoundMistake], index: usize) -> Option<Missing> {
        let found_one = found.get(index)?;
        let others = others(found, index);
        let assignment = self.assignment;
        let mistake = assignment.mistake(&found_one.id)?;
        let (without, with) = (assignment.variant(&others)?, assignment.variant(found)?);
        let [definition] = self.replaced(mistake, found_one, &others, &self.colours(&with))?[..] else { return None };
        let right = self.definitions(&without).swap_remove(definition);
        let wrong = self.definitions(&with).swap_remove(definition);
        let is_zero = wrong.iter().take(3).flatten().all(|value| *value == 0.0);
        let wanted = self.colours(&without);
        // What is as it should be already cannot be mended.
        let is_it = is_zero && !self.becomes(&wanted, None);
        is_it.then_some(Missing { definition, right, wrong, wanted, handed_out: mistake.handed_out })
    }

    /// The definitions that the mistake replaces in the form in which it was found, and in those that come to the same.
    fn replaced(
        &self,
        mistake: &Mistake,
        found: &FoundMistake,
        others: &[FoundMistake],
        wrong: &[DVec3],
    ) -> Option<Vec<usize>> {
        let is_equal = |form: usize| {
            let other = FoundMistake { form, ..found.clone() };
            let all: Vec<FoundMistake> = others.iter().cloned().chain([other]).collect();
            let colours = self.assignment.variant(&all).map(|variant| self.colours(&variant));
            colours.is_some_and(|colours| colours.iter().zip(wrong).all(|(a, b)| is_colour(*b, *a)))
        };
        let forms = (0..mistake.forms.len()).filter(|form| *form == found.form || is_equal(*form));
        let overrides = forms.flat_map(|form| mistake.forms[form].overrides.iter().map(|one| one.definition));
        let mut replaced: Vec<usize> = overrides.collect();
        replaced.sort_unstable();
        replaced.dedup();
        Some(replaced)
    }

    /// The values that mend the colour when they are `right`, in the order in which they are computed.
    fn mending(&mut self, right: &ScalarColumns, wanted: &[DVec3], handed_out: bool) -> Vec<usize> {
        let candidates = self.trace.events.iter().enumerate().filter(|(_, event)| {
            fits(event.values.len(), right.len())
                && event.lanes[0]
                && event.values[0].len() == right[0].len()
                && (handed_out || self.is_own(event))
                && self.sites[event.site].function.is_some()
                && !is_same(event, right)
        });
        let candidates: Vec<(usize, ValueChange)> =
            candidates.map(|(at, event)| (at, change(&self.trace, at, &shaped(event, right)))).collect();
        let mends = candidates.into_iter().filter(|(_, change)| self.becomes(wanted, Some(change.clone())));
        mends.map(|(at, _)| at).collect()
    }

    /// The last sum that mends the colour when what the definition lacks is added.
    fn last_sum(&mut self, missing: &Missing) -> Option<usize> {
        let Missing { right, wrong, wanted, .. } = missing;
        // What adds to a variable, `colour += x`, gives it a part of its value.
        let is_sum = |site: usize| {
            let what = &self.sites[site].what;
            matches!(what, What::Binary(Binary::Add | Binary::Subtract) | What::Assign { is_part: true, .. })
        };
        let sums = self.trace.events.iter().enumerate().filter(|(_, event)| {
            is_sum(event.site) && fits(event.values.len(), right.len()) && event.values[0].len() == right[0].len()
        });
        let sums: Vec<(usize, ValueChange)> = sums
            .map(|(at, event)| {
                let mut values = event.values.clone();
                for ((own, right), wrong) in values.iter_mut().zip(right).zip(wrong).take(3) {
                    own.iter_mut().zip(right.iter().zip(wrong)).for_each(|(own, (right, wrong))| *own += right - wrong);
                }
                (at, change(&self.trace, at, &values))
            })
            .collect();
        let found = sums.into_iter().rev().find(|(_, change)| self.becomes(wanted, Some(change.clone())));
        found.map(|(at, _)| at)
    }

    /// Whether a value is only what a sum begins with, and not a term.
    fn is_start_of_sum(&self, event: usize) -> bool {
        let own = &self.trace.events[event];
        let site = &self.sites[own.site];
        // A global variable begins with something that is no term of a sum.
        if site.function.is_none() {
            return true;
        }
        let gives = |at: usize| match &self.sites[at].what {
            What::Assign { name, .. } => Some(name),
            _ => None,
        };
        let is_written = match &site.what {
            What::Literal | What::Call(_) => true,
            What::Assign { .. } => site.operands.iter().all(|from| !matches!(self.sites[*from].what, What::Read(_))),
            _ => false,
        };
        let user = || self.sites.iter().position(|other| other.operands.contains(&own.site));
        let Some(name) = gives(own.site).or_else(|| gives(user()?)).filter(|_| is_written && is_zero(own)) else {
            return false;
        };
        let is_output = self.assignment.interface.outputs.first().is_some_and(|output| output.name == *name);
        let reads = |what: &What| matches!(what, What::Read(own) if own == name);
        let mut read = self.trace.events.iter().filter(|event| reads(&self.sites[event.site].what));
        is_output || read.next_back().is_some_and(|last| !is_zero(last))
    }

    /// Whether the text uses a constant that the definition is made of, or none is.
    fn has_constants_of(&self, d: usize) -> bool {
        let used = self.assignment.equation.constants_in(d);
        let count = |name: &str| self.source.words().filter(|(_, word)| *word == name).count();
        used.is_empty() || used.iter().any(|name| count(name) > 1)
    }

    /// Whether the colour changes with one of the constants that the definition is made of.
    fn has_influence(&mut self, d: usize) -> bool {
        // Neither 0 nor what a clamp hides.
        const BRIGHTER: f64 = 1.7;
        let used = self.assignment.equation.constants_in(d);
        let Some(seen) = self.trials.at_first(&StageChanges::default()) else { return false };
        let constants: Vec<ValueChange> = used
            .into_iter()
            .filter_map(|name| self.constant(name))
            .map(|mut change| {
                let numbers = change.values.iter_mut().flatten().flatten();
                numbers.for_each(|number| *number = *number * BRIGHTER + 0.1);
                change
            })
            .collect();
        constants.into_iter().any(|change| {
            let mut changes = StageChanges::default();
            changes[self.stage as usize].push(change);
            self.trials.at_first(&changes).is_some_and(|other| other != seen)
        })
    }

    /// The values that a constant of this name is given.
    fn constant(&self, constant: &str) -> Option<ValueChange> {
        let is_it = |site: usize| {
            let site = &self.sites[site];
            site.function.is_none() && matches!(&site.what, What::Assign { name, .. } if name == constant)
        };
        let event = self.trace.events.iter().find(|event| is_it(event.site))?;
        Some(ValueChange { site: event.site, values: vec![event.values.clone()] })
    }
}
