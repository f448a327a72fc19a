//! What of the colour comes of two constants of a term.
//!
//! A text need not have a term as a value of its own: a loop may go through arrays of constants. What is there only with both of these
//! constants is that term all the same.

use super::search::Search;
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges};
use glam::DVec3;
use reference::interpreter::trace::{Event, Site, Trace, ValueChange, What};
use reference::traced::{Bench, TracedProgram};

/// Terms that differ by no more are the same. Noise: 1e-5 (f32, to the power of 80). Defect to catch: two percent of a term of 0.12.
const SAME: f64 = 2e-4;

/// The number of a line of the rubric, and what its term is at each place.
type Influence = (usize, Vec<DVec3>);

impl Search<'_, '_> {
    /// The ids of the lines whose terms are not the same in two programs. `None` where that is not known of every line.
    pub(super) fn changed_terms(&self, before: &TracedProgram, after: &TracedProgram) -> Option<Vec<String>> {
        let (before, after) = (self.influences(before)?, self.influences(after)?);
        let is_number = |(a, b): &(&DVec3, &DVec3)| a.is_finite() && b.is_finite();
        let is_other = |(a, b): (&DVec3, &DVec3)| (*a - *b).abs().max_element() > SAME;
        let mut changed = Vec::new();
        for ((line, a), (_, b)) in before.iter().zip(&after) {
            // Another term that is no number hides this one.
            let mut numbers = a.iter().zip(b).filter(is_number).peekable();
            numbers.peek()?;
            if numbers.any(is_other) {
                changed.push(self.assignment.rubric[*line].id.clone());
            }
        }
        Some(changed)
    }

    /// The ids of the lines whose terms are as in the right answer; none where that is not known of every line.
    pub(super) fn right_terms(&self) -> Vec<String> {
        let right = self.assignment.traced_solution();
        let Some(changed) = right.and_then(|right| self.changed_terms(self.theirs, right)) else { return Vec::new() };
        let of_colour = self.assignment.rubric.iter().filter(|line| !self.assignment.judges_position(line));
        of_colour.map(|line| line.id.clone()).filter(|id| !changed.contains(id)).collect()
    }

    /// Whether the terms of all these lines are made of a definition, or it of them; of what is no definition that is not known.
    pub(super) fn goes_into_all(&self, name: &str, lines: &[String]) -> bool {
        let equation = &self.assignment.equation;
        let Some(definition) = equation.index(name) else { return true };
        let of_lines = self.assignment.rubric.iter().filter(|line| lines.contains(&line.id));
        let mut terms = of_lines.filter_map(|line| equation.index(&line.judges));
        let is_on_the_way = |a, b| a == b || equation.depends(a, b) || equation.depends(b, a);
        terms.all(|term| is_on_the_way(term, definition))
    }

    /// Whether a constant is a colour: an attenuation is made of numbers, and is no term.
    fn is_colour(&self, constant: &str) -> bool {
        let own = self.assignment.constants.iter().find(|own| own.name == constant);
        own.is_some_and(|own| own.value.numbers().len() >= 3)
    }

    /// What each line's term is. `None` where a line judges something else, or the program lacks a constant.
    fn influences(&self, program: &TracedProgram) -> Option<Vec<Influence>> {
        let assignment = self.assignment;
        let stage = assignment.equation.reads().stage()?;
        let mut bench = Bench::new(assignment, program, self.places, self.in_quads, FUEL_OF_TRACE)?;
        let (_, mut traces) = bench.trace(&StageChanges::default())?;
        let (trace, sites) = (traces[stage as usize].take()?, program.stage(stage).sites());
        let mut seen = |constants: &[&ValueChange]| {
            let mut changes = StageChanges::default();
            changes[stage as usize].extend(constants.iter().map(|own| (*own).clone()));
            Some(bench.with(&changes)?.colours)
        };
        let lines = (0..assignment.rubric.len()).filter(|line| !assignment.judges_position(&assignment.rubric[*line]));
        let of_line = |line: usize| {
            let definition = assignment.equation.index(&assignment.rubric[line].judges)?;
            let constants = assignment.equation.constants_in(definition).into_iter();
            let constants = constants.filter(|name| self.is_colour(name));
            let mut own = constants.map(|constant| without(constant, sites, &trace));
            Some((line, [own.next()??, own.next()??]))
        };
        let constants: Vec<(usize, [Option<ValueChange>; 2])> = lines.map(of_line).collect::<Option<_>>()?;
        let mut influence = |own: usize| {
            let [Some(first), Some(second)] = &constants[own].1 else {
                return Some(vec![DVec3::ZERO; self.places.len()]);
            };
            // Terms that are far too great would swallow this one.
            let others = constants.iter().enumerate().filter(|(number, _)| *number != own);
            let others: Vec<&ValueChange> = others.flat_map(|(_, (_, pair))| pair.iter().flatten()).collect();
            let mut with = |more: &[&ValueChange]| seen(&[&others[..], more].concat());
            let (all, none) = (with(&[])?, with(&[first, second])?);
            let (first, second) = (with(&[first])?, with(&[second])?);
            Some((0..all.len()).map(|at| all[at] - first[at] - second[at] + none[at]).collect())
        };
        (0..constants.len()).map(|own| Some((constants[own].0, influence(own)?))).collect()
    }
}

/// A constant that is 0: `None` for one that nothing is made of, and no change at all where the text does not declare it.
#[expect(clippy::option_option, reason = "the two are told apart")]
fn without(constant: &str, sites: &[Site], trace: &Trace) -> Option<Option<ValueChange>> {
    let is_it =
        |site: &Site| site.function.is_none() && matches!(&site.what, What::Assign { name, .. } if name == constant);
    let site = sites.iter().position(is_it)?;
    let event = trace.events.iter().find(|event| event.site == site);
    let dark = |event: &Event| {
        let values = event.values.iter().map(|column| vec![0.0; column.len()]).collect();
        ValueChange { site, values: vec![values] }
    };
    Some(event.map(dark))
}
