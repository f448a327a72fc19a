//! What the text and the right answer compute at some of the probes: recorded once, and asked many times.

use super::Finding;
use super::around::FeatureWay;
use super::chain::Chain;
use super::quantities::Quantities;
use crate::diagnose::Evidence;
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges, chosen, is_drawn, place};
use reference::Assignment;
use reference::interpreter::trace::Trace;
use reference::mistake::FoundMistake;
use reference::traced::{Bench, Place, Seen};
use std::cell::OnceCell;

/// The recording of one evidence, made when it is first asked for. Evidence of another homework, program or samples needs one of its own.
#[derive(Debug, Default)]
pub struct Recorded(OnceCell<Option<Recording>>);

/// What both compute at the same places.
#[derive(Debug)]
pub(super) struct Recording {
    /// The probes, by their numbers.
    chosen: Vec<usize>,
    pub in_quads: bool,
    /// Every value of the student's text, by stage.
    pub traces: [Option<Trace>; 2],
    /// What is seen of it.
    pub own: Seen,
    /// What is seen of the right answer.
    pub wanted: Seen,
    pub quantities: Quantities,
    /// The places that have to be mended, once they were looked for.
    pub findings: OnceCell<Vec<Finding>>,
    /// The places of several mistakes, once they were looked for.
    pub chain: OnceCell<Chain>,
    /// What the lines' features are made of, once it was asked for.
    pub features: OnceCell<Vec<FeatureWay>>,
}

impl Recorded {
    pub(super) fn of(&self, evidence: &Evidence<'_>) -> Option<&Recording> {
        self.0.get_or_init(|| Recording::of(evidence, evidence.assignment, &[], &[])).as_ref()
    }
}

impl Recording {
    /// Runs both. `None` where one of them cannot be run, or the text does not compute what the driver computed.
    pub fn of(
        evidence: &Evidence<'_>,
        assignment: &Assignment,
        others: &[FoundMistake],
        more: &[Place<'_>],
    ) -> Option<Self> {
        let theirs = evidence.traced?;
        let variant = if others.is_empty() { None } else { assignment.variant(others) };
        let with_others;
        let solution = match (&variant, others) {
            (Some(_), _) | (None, []) => assignment.traced_solution()?,
            (None, others) => {
                with_others = assignment.traced_with(others)?;
                &with_others
            }
        };
        let chosen = chosen(evidence);
        if chosen.is_empty() {
            return None;
        }
        let places = places(&chosen, evidence, more);
        let in_quads = theirs.needs_quads(assignment) || solution.needs_quads(assignment);
        let run = |program| {
            Bench::new(assignment, program, &places, in_quads, FUEL_OF_TRACE)?.trace(&StageChanges::default())
        };
        let (own, traces) = run(theirs)?;
        if !is_drawn(evidence, &chosen, &own.colours) {
            return None;
        }
        let (mut wanted, right_traces) = run(solution)?;
        let mut quantities = Quantities::of(solution, right_traces);
        if let Some(variant) = &variant {
            wanted.colours = quantities.replace(assignment, variant, &places, if in_quads { 4 } else { 1 })?;
        }
        let (findings, chain, features) = Default::default();
        Some(Self { chosen, in_quads, traces, own, wanted, quantities, findings, chain, features })
    }

    /// The chosen probes, and these places after them.
    pub fn places<'e>(&self, evidence: &Evidence<'e>, more: &[Place<'e>]) -> Vec<Place<'e>> {
        places(&self.chosen, evidence, more)
    }
}

fn places<'e>(chosen: &[usize], evidence: &Evidence<'e>, more: &[Place<'e>]) -> Vec<Place<'e>> {
    chosen.iter().map(|at| place(evidence, *at)).chain(more.iter().copied()).collect()
}
