//! How much of the right answer the text of a student computes, by what its own uniforms are taken for.

use crate::Assignment;
use crate::interpreter::trace::{Event, Trace, What};
use crate::interpreter::{Program, Stage, is_lookup};
use crate::probes::ProbeSet;
use crate::traced::{Bench, Place, TracedProgram};
use std::ops::Range;

/// The steps of a run: far more than an answer takes.
const FUEL: u64 = 20_000_000;

/// So many probes of each camera are looked at.
const PROBES: usize = 6;

/// So many ways and probes are run at once: every value on the way is kept.
const LANES: usize = 1024;

/// A named value of the right answer at all probes: its stage, and its scalars.
type NamedValue = (Stage, Vec<Vec<f64>>);

/// Of how much of the right answer a text has the values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct AnswerProgress {
    /// Whether the text looks a texture up where the right answer does.
    looks_up: bool,
    /// How many of its named values the text computes.
    count: usize,
}

impl Assignment {
    /// How much of the right answer a text computes in each of some ways; nothing where it cannot be traced. `extended`: the homework that
    /// sets the text's own uniforms. `given`: the probes with what these are in some ways.
    pub(super) fn progress(
        &self,
        extended: &Self,
        texts: &[(Stage, &str)],
        few: &ProbeSet,
        ways: &[usize],
        given: &dyn Fn(&[usize], &ProbeSet) -> ProbeSet,
    ) -> Vec<AnswerProgress> {
        let mut found = vec![AnswerProgress::default(); ways.len()];
        let programs = self.traced_solution().zip(TracedProgram::new(extended, texts).ok());
        let Some((solution, theirs)) = programs else { return found };
        let few = few.thinned(PROBES);
        let in_quads = solution.needs_quads(self) || theirs.needs_quads(extended);
        let Some(right) = traces(self, solution, &few, in_quads) else { return found };
        let (named, looked_up) = (named(solution, &right), looked_up(solution, &right));
        let each = (LANES / few.probes.len().max(1)).max(1);
        for (ways, found) in ways.chunks(each).zip(found.chunks_mut(each)) {
            let Some(traces) = traces(extended, &theirs, &given(ways, &few), in_quads) else { continue };
            let places = arguments(&theirs, &traces);
            for (at, found) in found.iter_mut().enumerate() {
                let lanes = |right: &[Vec<f64>]| at * right[0].len()..(at + 1) * right[0].len();
                let computes = |(stage, right): &&NamedValue| {
                    let mut events = traces[*stage as usize].iter().flat_map(|trace| &trace.events);
                    events.any(|event| has(&event.values, &event.lanes, right, lanes(right)))
                };
                let looks_up = |right: &Vec<Vec<f64>>| places.iter().any(|(own, on)| has(own, on, right, lanes(right)));
                *found = AnswerProgress {
                    looks_up: looked_up.iter().any(looks_up),
                    count: named.iter().filter(computes).count(),
                };
            }
        }
        found
    }
}

/// The traces of the handed-in stages at probes.
fn traces(
    assignment: &Assignment,
    program: &TracedProgram,
    probes: &ProbeSet,
    in_quads: bool,
) -> Option<[Option<Trace>; 2]> {
    let mut bench = Bench::new(assignment, program, &Place::all(probes), in_quads, FUEL)?.lenient();
    bench.trace(&Default::default()).map(|(_, traces)| traces)
}

/// What the right answer gives names to; none that others equal by chance.
fn named(solution: &TracedProgram, traces: &[Option<Trace>; 2]) -> Vec<NamedValue> {
    let mut named = Vec::new();
    for stage in [Stage::Vertex, Stage::Fragment] {
        let program: &Program = solution.stage(stage);
        for event in traces[stage as usize].iter().flat_map(|trace| &trace.events) {
            // What is seen is right by chance where most lies in shadow.
            let is_seen =
                |name: &String| stage == Stage::Fragment && program.outputs().iter().any(|own| own.name == *name);
            let is_value = match &program.sites()[event.site].what {
                What::Assign { name, is_part: false } => !is_seen(name),
                _ => false,
            };
            if is_value && event.values.iter().any(|column| is_telling(column)) {
                named.push((stage, event.values.clone()));
            }
        }
    }
    named
}

/// Where the right answer looks textures up, as far as it is not the same everywhere: at most the place on a picture and a depth.
fn looked_up(solution: &TracedProgram, traces: &[Option<Trace>; 2]) -> Vec<Vec<Vec<f64>>> {
    let places = arguments(solution, traces).into_iter().map(|(values, _)| values);
    places.filter(|place| place.iter().any(|column| is_telling(column))).collect()
}

/// What the lookups of the fragment stage are given, and where they are done. What a projective one divides by its last component is
/// given as it is then.
fn arguments(program: &TracedProgram, traces: &[Option<Trace>; 2]) -> Vec<(Vec<Vec<f64>>, Vec<bool>)> {
    let sites = program.stage(Stage::Fragment).sites();
    let Some(trace) = &traces[Stage::Fragment as usize] else { return Vec::new() };
    let lookup = |event: &Event| match &sites[event.site].what {
        What::Call(name) if is_lookup(name) => Some(name.contains("Proj")),
        _ => None,
    };
    let given = trace.events.iter().filter_map(|event| Some((lookup(event)?, event)));
    let given = given.flat_map(|(is_divided, event)| event.from.iter().map(move |from| (is_divided, *from)));
    let place = |(is_divided, from): (bool, usize)| {
        let Event { values, lanes, .. } = &trace.events[from];
        let place = match &values[..] {
            [place @ .., by] if is_divided && place.len() > 1 => {
                place.iter().map(|own| own.iter().zip(by).map(|(own, by)| own / by).collect()).collect()
            }
            whole => whole.to_vec(),
        };
        (place, lanes.clone())
    };
    given.map(place).collect()
}

/// Whether numbers differ so much that no others equal them by chance: those of a comparison are two.
fn is_telling(numbers: &[f64]) -> bool {
    const FEW: usize = 4;
    let mut distinct: Vec<f64> = numbers.to_vec();
    distinct.sort_by(f64::total_cmp);
    distinct.dedup();
    distinct.len() >= FEW
}

/// Whether a value is a right one for some samples, as far as both have components: a place on a picture may have a depth beside it.
fn has(values: &[Vec<f64>], lanes: &[bool], right: &[Vec<f64>], own: Range<usize>) -> bool {
    let is_equal = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-6 * b.abs().max(1.0);
    values.len() >= right.len().min(2)
        && lanes.get(own.clone()).is_some_and(|lanes| lanes.iter().all(|is_on| *is_on))
        && values.iter().zip(right).all(|(value, right)| value[own.clone()].iter().zip(right).all(is_equal))
}
