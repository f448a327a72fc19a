//! Where in the student's own text a mistake stands.
//!
//! The interpreter of `reference` runs the student's text and the right answer at some of the probes, and keeps every value of
//! every expression. What the right answer computes on its way are the right quantities. From the output one walks back to what
//! it is made of, as far as that is not right yet. Where one of these values is replaced by a right quantity, and everything
//! that is seen becomes right by that, there the mistake stands. A value that is right whatever it is called, is never accused.

mod additive;
mod blame;
mod finding;
mod quantities;
mod search;
mod walk;
mod words;

use super::Evidence;
use super::locate::{Located, Role, is_handed_out};
use crate::compare::{COLOUR_TOLERANCE, POSITION_TOLERANCE};
use glam::DVec3;
use quantities::Quantities;
use reference::Assignment;
use reference::equation::Variant;
use reference::interpreter::trace::{Site, Trace, What};
use reference::interpreter::{Binary, Stage};
use reference::mistake::FoundMistake;
use reference::traced::{Bench, Place, Seen, TracedProgram};
use search::Search;

/// How many wrong and how many right samples are looked at.
const OF_EACH_KIND: usize = 10;

/// So many of them are asked first: most that is tried fails there.
const FIRST: usize = 3;

/// The steps of lanes that one search may take: a tenth of a second or two.
const FUEL: u64 = 30_000_000;

/// The steps of a run that records everything, and of all those that look at all places.
const FUEL_OF_TRACE: u64 = 10_000_000;

/// Where a mistake stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Finding {
    /// The stage whose text it is.
    pub stage: Stage,
    /// The line, from 1.
    pub line: u32,
    /// The variable that is given the value, or read.
    pub name: Option<String>,
    /// What the value stands for: a definition of the right answer, where it has a name.
    pub quantity: Option<String>,
    /// Whether the value is right by itself, and used where another one belongs.
    pub is_use: bool,
    /// The variables of the right answer that it is computed from, it is, and that are computed from it.
    pub touches: Vec<String>,
    /// Whether all that it is computed from is right.
    pub is_settled: bool,
    /// Whether it is all that is seen, which can always be mended.
    pub is_whole: bool,
    /// Whether the mistake stands there: it is not only what is seen of it, nor where a variable only begins.
    pub is_telling: bool,
    /// Whether it moves the position.
    pub touches_position: bool,
    /// What is wrong with it.
    pub flaw: Flaw,
    /// What it should be, and what it is, at a place that shows it.
    pub expected: Vec<f64>,
    pub found: Vec<f64>,
}

/// What is wrong with a value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Flaw {
    /// It is not what it should be.
    Value,
    /// A sum lacks these of its addends, by the names of their definitions.
    Lacks(Vec<String>),
    /// It writes over what belongs to a sum.
    Overwrites,
    /// What should become of it is computed and thrown away.
    ThrownAway,
    /// It decides the wrong way.
    Condition,
}

/// Looks for the one place that has to be mended for what is seen to be right.
pub(super) fn find(evidence: &Evidence<'_>) -> Vec<Finding> {
    within(evidence, evidence.assignment, None).unwrap_or_default()
}

/// Looks for the place of one of the mistakes that were found: where a right answer is the one with the others in it.
pub(super) fn find_one(
    evidence: &Evidence<'_>,
    assignment: &Assignment,
    found: &[FoundMistake],
    index: usize,
) -> Option<Finding> {
    let others: Vec<FoundMistake> =
        found.iter().enumerate().filter(|(at, _)| *at != index).map(|(_, other)| other.clone()).collect();
    let findings = match others.is_empty() {
        true => within(evidence, assignment, None)?,
        false => within(evidence, assignment, Some(&assignment.variant(&others)?))?,
    };
    // A mistake may be made in two places: each is one that is to be mended.
    findings.into_iter().next()
}

/// The one place that all is mended at, where there is such a place.
pub(super) fn only(evidence: &Evidence<'_>, assignment: &Assignment) -> Option<Finding> {
    let findings = within(evidence, assignment, None)?;
    match <[Finding; 1]>::try_from(findings) {
        Ok([finding]) if finding.is_settled && !finding.is_whole => Some(finding),
        _ => None,
    }
}

impl Finding {
    /// The place as others name it.
    pub fn located(&self) -> Located {
        Located { line: self.line, name: self.name.clone(), role: Role::Wrong, stage: Some(self.stage) }
    }
}

fn within(evidence: &Evidence<'_>, assignment: &Assignment, right: Option<&Variant<'_>>) -> Option<Vec<Finding>> {
    let texts: Vec<(Stage, &str)> =
        evidence.sources.iter().map(|(stage, source)| (*stage, source.text.as_str())).collect();
    let theirs = TracedProgram::new(assignment, &texts).ok()?;
    let solution = TracedProgram::solution(assignment).ok()?;
    let chosen = chosen(evidence);
    if chosen.is_empty() {
        return None;
    }
    let places: Vec<Place<'_>> = chosen.iter().map(|at| place(evidence, *at)).collect();
    let in_quads = theirs.needs_quads(assignment) || solution.needs_quads(assignment);
    let (own, traces) = Bench::new(assignment, &theirs, &places, in_quads, FUEL_OF_TRACE)?.trace()?;
    // What the driver computed is what is judged.
    let is_drawn = |(at, colour): (&usize, &DVec3)| is_colour(DVec3::from(evidence.samples[*at].colour_f64()), *colour);
    if !chosen.iter().zip(&own.colours).all(is_drawn) {
        return None;
    }
    let (mut wanted, right_traces) = Bench::new(assignment, &solution, &places, in_quads, FUEL_OF_TRACE)?.trace()?;
    let mut quantities = Quantities::of(&solution, right_traces);
    if let Some(variant) = right {
        wanted.colours = quantities.replace(assignment, variant, &places, if in_quads { 4 } else { 1 })?;
    }
    let first = &places[..places.len().min(FIRST)];
    let bench = |places, fuel| Bench::new(assignment, &theirs, places, in_quads, fuel);
    let mut few = bench(first, FUEL)?;
    let mut all = bench(&places, FUEL_OF_TRACE)?;
    // How many steps a run may take is known from the first.
    few.with(&Default::default())?;
    all.with(&Default::default())?;
    let mut search = Search {
        evidence,
        theirs: &theirs,
        traces: &traces,
        own: &own,
        wanted: &wanted,
        quantities: &quantities,
        few,
        all,
        count: places.len(),
        base: Default::default(),
    };
    if search.is_right(&own, places.len()) {
        return Some(Vec::new());
    }
    Some(search.findings())
}

/// Wrong and right samples in turn, a wrong one first.
fn chosen(evidence: &Evidence<'_>) -> Vec<usize> {
    let scale = super::position_scale(evidence);
    let is_wrong = |at: &usize| {
        let (probe, sample) = (&evidence.probes.probes[*at], &evidence.samples[*at]);
        !is_colour(probe.colour, DVec3::from(sample.colour_f64()))
            || crate::compare::position_difference(probe.position, sample, scale) > POSITION_TOLERANCE
    };
    let count = evidence.samples.len().min(evidence.probes.probes.len());
    let (wrong, right): (Vec<usize>, Vec<usize>) = (0..count).partition(is_wrong);
    let [wrong, right] = [wrong, right].map(|all| {
        let count = all.len().min(OF_EACH_KIND);
        (0..count).map(|at| all[at * all.len() / count]).collect::<Vec<usize>>()
    });
    let mut chosen = Vec::new();
    for at in 0..wrong.len().max(right.len()) {
        chosen.extend(wrong.get(at));
        chosen.extend(right.get(at));
    }
    if wrong.is_empty() { Vec::new() } else { chosen }
}

fn place<'e>(evidence: &Evidence<'e>, at: usize) -> Place<'e> {
    let probe = &evidence.probes.probes[at];
    Place { probe, uniforms: evidence.probes.uniforms(probe) }
}

/// Whether two colours are the same.
fn is_colour(wanted: DVec3, found: DVec3) -> bool {
    let is_channel = |wanted: f64, found: f64| match wanted.is_finite() {
        true => (found - wanted).abs() <= COLOUR_TOLERANCE * wanted.abs().max(1.0),
        false => !found.is_finite(),
    };
    wanted.to_array().into_iter().zip(found.to_array()).all(|(wanted, found)| is_channel(wanted, found))
}

/// Whether two numbers are the same but for rounding.
fn is_number(a: f64, b: f64) -> bool {
    // What is computed in another order differs by rounding, and constants are f32.
    const RELATIVE: f64 = 1e-4;
    (a - b).abs() <= RELATIVE * a.abs().max(b.abs()).max(1e-3)
}
