//! The student's program at some of the probes, run again and again with some of its values changed.

use super::columns::{ScalarColumns, is_colour};
use super::{Evidence, position_scale};
use crate::compare::{POSITION_TOLERANCE, position_difference};
use glam::DVec3;
use reference::Assignment;
use reference::interpreter::trace::{Trace, ValueChange};
use reference::traced::{Bench, Place, Seen, TracedProgram};

/// How many wrong and how many right samples are looked at.
const OF_EACH_KIND: usize = 10;

/// So many of them are asked first: most that is tried fails there.
pub(super) const FIRST: usize = 3;

/// The steps of lanes that one search may take: a tenth of a second or two.
const FUEL: u64 = 30_000_000;

/// The steps of a run that records everything, and of all those that look at all places.
pub(super) const FUEL_OF_TRACE: u64 = 10_000_000;

/// What is changed in the vertex and in the fragment stage.
pub(super) type StageChanges = [Vec<ValueChange>; 2];

/// A program at some probes, the first of which are asked first.
#[derive(Debug)]
pub(super) struct Trials<'p> {
    few: Bench<'p>,
    all: Bench<'p>,
    count: usize,
}

impl<'p> Trials<'p> {
    /// Makes ready. `None` where the program cannot be run.
    pub fn new(
        assignment: &'p Assignment,
        program: &'p TracedProgram,
        places: &[Place<'p>],
        in_quads: bool,
    ) -> Option<Self> {
        let first = &places[..places.len().min(FIRST)];
        let mut few = Bench::new(assignment, program, first, in_quads, FUEL)?;
        let mut all = Bench::new(assignment, program, places, in_quads, FUEL_OF_TRACE)?;
        // How many steps a run may take is known from the first.
        few.with(&StageChanges::default())?;
        all.with(&StageChanges::default())?;
        Some(Self { few, all, count: places.len() })
    }

    /// Whether what is seen with these changes is right, at the first places and then at all.
    pub fn holds(&mut self, changes: &StageChanges, is_right: &dyn Fn(&Seen, usize) -> bool) -> bool {
        let first = self.count.min(FIRST);
        self.at_first(changes).is_some_and(|seen| is_right(&seen, first))
            && self.all.with(changes).is_some_and(|seen| is_right(&seen, self.count))
    }

    /// What is seen with these changes at all places.
    pub fn at_all(&mut self, changes: &StageChanges) -> Option<Seen> {
        self.all.with(changes)
    }

    /// What is seen with these changes at the first places.
    pub fn at_first(&mut self, changes: &StageChanges) -> Option<Seen> {
        let mut changes = changes.clone();
        let all = changes.iter_mut().flatten().flat_map(|change| &mut change.values);
        for column in all.flatten() {
            let each = column.len() / self.count.max(1);
            column.truncate(each * self.count.min(FIRST));
        }
        self.few.with(&changes)
    }
}

/// An event has other values, and only it of all that its site computes.
pub(super) fn change(trace: &Trace, event: usize, values: &ScalarColumns) -> ValueChange {
    let site = trace.events[event].site;
    let turns = trace.events.iter().enumerate().filter(|(_, other)| other.site == site);
    let values = turns.map(|(at, other)| if at == event { values.clone() } else { other.values.clone() });
    ValueChange { site, values: values.collect() }
}

/// Wrong and right samples in turn, a wrong one first; right ones alone where none is wrong.
pub(super) fn chosen(evidence: &Evidence<'_>) -> Vec<usize> {
    let scale = position_scale(evidence);
    let is_wrong = |at: &usize| {
        let (probe, sample) = (&evidence.probes.probes[*at], &evidence.samples[*at]);
        !is_colour(probe.colour, DVec3::from(sample.colour_f64()))
            || position_difference(probe.position, sample, scale) > POSITION_TOLERANCE
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
    chosen
}

/// A probe with its uniforms.
pub(super) fn place<'e>(evidence: &Evidence<'e>, at: usize) -> Place<'e> {
    let probe = &evidence.probes.probes[at];
    Place { probe, uniforms: evidence.probes.uniforms(probe) }
}

/// Whether the driver computed these colours at the chosen probes: what it computed is what is judged. What is no number may become
/// any colour there; of a power the line is known.
pub(super) fn is_drawn(evidence: &Evidence<'_>, chosen: &[usize], colours: &[DVec3]) -> bool {
    let is_open = |colour: &DVec3| colour.is_nan() && evidence.undefined.is_none();
    let is_one = |(at, colour): (&usize, &DVec3)| {
        is_open(colour) || is_colour(DVec3::from(evidence.samples[*at].colour_f64()), *colour)
    };
    chosen.iter().zip(colours).all(is_one)
}
