//! Terms that the student's text computes right and adds as they are.
//!
//! What a driver shows is the sum. A wrong term that is 0 nowhere hides a right one from every sample. In the text the right
//! one still stands by itself: a value that is the right term at every probe, and that moves the colour by exactly what it
//! moves a right answer's when something is added to it.

use super::Evidence;
use super::columns::{ScalarColumns, is_constant, is_number, is_same, of_places};
use super::inside::{self, made_of};
use super::trials::{FUEL_OF_TRACE, StageChanges, is_drawn, place};
use glam::DVec3;
use reference::assignment::RubricItem;
use reference::equation::Reads;
use reference::fit::TermJudgement;
use reference::interpreter::trace::{Event, Trace, ValueChange, What};
use reference::interpreter::{Binary, Stage};
use reference::pipeline::POSITION;
use reference::traced::{Bench, Place};
use std::collections::BTreeSet;

/// Every seventh of the 560 probes is looked at, so that each of the 20 designs occurs four times.
const STRIDE: usize = 7;

/// What is added to a value to see what becomes of it, in red, green and blue: other than any constant of a homework, and
/// different so that no channel passes for another.
pub(super) const ADDED: [f64; 3] = [0.173, 0.139, 0.111];

/// A value beyond this counts as 0, as what is not finite does: such a term costs the others nothing. Those of a right answer
/// stay below 100.
pub(super) const OVERFLOWING: f64 = 1e4;

/// So exactly the colour has to move by what is added. Noise: 1e-12 (f64). Defect to catch: a factor of 0.999.
const EXACT: f64 = 1e-5;

/// A move of less than this tells nothing.
const LEAST: f64 = 1e-3;

/// So many values that are a term are tried.
const MOST_CANDIDATES: usize = 24;

/// The judgements; right are also the terms that the text adds as they are. One stays wrong, for the sum is.
pub(super) fn credit(evidence: &Evidence<'_>, judged: Vec<TermJudgement>) -> Vec<TermJudgement> {
    if evidence.assignment.equation.reads() == Reads::Outputs {
        return credited(evidence, judged, &inside::added_lines(evidence));
    }
    let Some(mut text) = TextEvaluation::of(evidence) else { return judged };
    let mut is_added = |judgement: &TermJudgement| {
        let line = evidence.assignment.rubric.iter().find(|line| line.id == judgement.line);
        line.is_some_and(|line| text.adds(line))
    };
    let added: Vec<String> =
        judged.iter().filter(|judgement| is_added(judgement)).map(|own| own.line.clone()).collect();
    credited(evidence, judged, &added)
}

/// The judgements; right are also these lines, unless they are all that is wrong.
pub(super) fn credited(evidence: &Evidence<'_>, judged: Vec<TermJudgement>, lines: &[String]) -> Vec<TermJudgement> {
    let samples = evidence.samples.len();
    let credited = judged.iter().map(|judgement| match lines.contains(&judgement.line) {
        true => TermJudgement::right(&judgement.line, samples),
        false => judgement.clone(),
    });
    let credited: Vec<TermJudgement> = credited.collect();
    if credited.iter().all(TermJudgement::is_right) { judged } else { credited }
}

/// Whether the text computes some term that the rubric judges, right and not the same everywhere, whatever becomes of it; or, in one
/// colour everywhere, one that is the same everywhere.
pub(super) fn computes_a_term(evidence: &Evidence<'_>) -> bool {
    let Some(text) = TextEvaluation::of(evidence) else { return false };
    text.is_begun()
        || evidence.assignment.rubric.iter().any(|line| {
            let term = text.right(&line.judges);
            !is_constant(&term) && !text.computing(&term).is_empty()
        })
}

/// Whether the text computes the right colour, whatever becomes of it.
pub(super) fn computes_the_colour(evidence: &Evidence<'_>) -> bool {
    let equation = &evidence.assignment.equation;
    let colour = equation.definitions().get(equation.colour()).map(|colour| &colour.name);
    TextEvaluation::of(evidence)
        .zip(colour)
        .is_some_and(|(text, colour)| !text.computing(&text.right(colour)).is_empty())
}

/// Whether the colour is made of something that a right answer computes as well and that is not the same everywhere, or is one colour
/// that such an answer begins with. Then the text computes, and a mistake on the way may leave one colour for all places: it looks
/// nothing up.
pub(super) fn is_computed(evidence: &Evidence<'_>) -> bool {
    let (Some(text), Some(program)) = (TextEvaluation::of(evidence), evidence.traced) else { return false };
    let outputs = program.stage(text.stage).outputs().iter().zip(&text.trace.outputs);
    let colours: Vec<usize> =
        outputs.filter(|(output, _)| output.name != POSITION).flat_map(|(_, events)| events.clone()).collect();
    let way = made_of(&text.trace, &colours);
    text.is_begun()
        || evidence.assignment.equation.definitions().iter().any(|definition| {
            let right = text.right(&definition.name);
            let is_it = |event: &usize| is_same(&text.trace.events[*event], &right);
            !is_constant(&right) && way.iter().any(is_it)
        })
}

/// Whether no colour that the text computes is finite, so that what the driver shows says nothing.
pub(super) fn is_finite_nowhere(evidence: &Evidence<'_>) -> bool {
    // One of each design.
    let places: Vec<Place<'_>> = (0..evidence.probes.of_group(0).len()).map(|at| place(evidence, at)).collect();
    let colours = bench(evidence, &places).and_then(|bench| bench.lenient().with(&StageChanges::default()));
    colours.is_some_and(|seen| !seen.colours.iter().any(|colour| colour.is_finite()))
}

/// The program at some probes; `None` where it is known by no definitions.
fn bench<'p>(evidence: &Evidence<'p>, places: &[Place<'p>]) -> Option<Bench<'p>> {
    let assignment = evidence.assignment;
    let program = evidence.traced.filter(|_| assignment.equation.reads().stage().is_some())?;
    Bench::new(assignment, program, places, program.needs_quads(assignment), FUEL_OF_TRACE)
}

/// What the student's text computes at some of the probes, where what overflows counts as 0.
struct TextEvaluation<'a> {
    evidence: Evidence<'a>,
    places: Vec<Place<'a>>,
    stage: Stage,
    bench: Bench<'a>,
    trace: Trace,
    colours: Vec<DVec3>,
}

impl<'a> TextEvaluation<'a> {
    /// `None` where the interpreter does not compute what the driver computed.
    fn of(evidence: &Evidence<'a>) -> Option<Self> {
        let chosen: Vec<usize> =
            (0..evidence.samples.len().min(evidence.probes.probes.len())).step_by(STRIDE).collect();
        let places: Vec<Place<'a>> = chosen.iter().map(|at| place(evidence, *at)).collect();
        let plain = bench(evidence, &places)?.with(&StageChanges::default())?;
        // The driver shows anything for what overflows.
        let is_usual = |colour: &DVec3| colour.to_array().iter().all(|x| x.abs() < OVERFLOWING);
        let usual = chosen.iter().zip(&plain.colours).filter(|(_, colour)| is_usual(colour));
        let (usual, colours): (Vec<usize>, Vec<DVec3>) = usual.unzip();
        if !is_drawn(evidence, &usual, &colours) {
            return None;
        }
        let mut bench = bench(evidence, &places)?.bounded(OVERFLOWING);
        let (seen, mut traces) = bench.trace(&StageChanges::default())?;
        let stage = evidence.assignment.equation.reads().stage()?;
        let trace = traces[stage as usize].take()?;
        Some(Self { evidence: *evidence, places, stage, bench, trace, colours: seen.colours })
    }

    /// A definition, as a right answer computes it.
    fn right(&self, definition: &str) -> ScalarColumns {
        let right = self.evidence.assignment.equation.right();
        let value = |at: &Place<'_>| right.evaluate(at.uniforms, &at.probe.attributes).get(definition);
        let values: Vec<_> = self.places.iter().filter_map(value).collect();
        let lanes = self.trace.events.first().map_or(0, |event| event.lanes.len());
        of_places(&values, lanes / self.places.len().max(1))
    }

    /// Whether it shows one colour, and multiplies out a term that is the same everywhere: all else is not there yet.
    fn is_begun(&self) -> bool {
        let Some(program) = self.evidence.traced else { return false };
        let sites = program.stage(self.stage).sites();
        let is_product =
            |event: &usize| matches!(sites[self.trace.events[*event].site].what, What::Binary(Binary::Multiply));
        let is_one =
            |seen: &DVec3| seen.to_array().iter().zip(self.colours[0].to_array()).all(|(a, b)| is_number(*a, b));
        self.colours.iter().all(is_one)
            && self.evidence.assignment.rubric.iter().any(|line| {
                let term = self.right(&line.judges);
                is_constant(&term) && self.computing(&term).iter().any(is_product)
            })
    }

    /// Where the text computes a colour, alpha aside.
    fn computing(&self, colour: &ScalarColumns) -> Vec<usize> {
        let all = self.trace.events.iter().enumerate().filter(|(_, event)| is_it(event, colour));
        all.map(|(at, _)| at).take(MOST_CANDIDATES).collect()
    }

    /// Whether it has the line's right term as an addend of the colour.
    fn adds(&mut self, line: &RubricItem) -> bool {
        let Some(definition) = self.evidence.assignment.equation.index(&line.judges) else { return false };
        let term = self.right(&line.judges);
        let right = self.evidence.assignment.equation.right();
        let moves = |at: &Place<'_>| right.moves(at.uniforms, &at.probe.attributes, definition, ADDED);
        let wanted: Vec<DVec3> = self.places.iter().map(moves).collect();
        let found = self.computing(&term).into_iter().find(|event| self.moves(*event, &wanted));
        found.is_some_and(|event| !self.has_a_constant_beside(event, &term, &wanted))
    }

    /// Something is added to an event.
    fn raised(&self, event: usize) -> StageChanges {
        raised(self.stage, &self.trace, &[event])
    }

    /// Whether the colour moves as a right answer's does when something is added to an event.
    fn moves(&mut self, event: usize, wanted: &[DVec3]) -> bool {
        let Some(seen) = self.bench.with(&self.raised(event)) else { return false };
        let places = self.colours.iter().zip(&seen.colours).zip(wanted);
        let passed: Vec<Option<bool>> =
            places.map(|((before, after), wanted)| passes(*before, *after, *wanted)).collect();
        // What is clamped at the others tells nothing.
        let seen = passed.iter().filter(|passed| **passed == Some(true)).count();
        !passed.contains(&Some(false)) && 2 * seen >= passed.len()
    }

    /// Whether the term is the same everywhere, and so is what is added to it before the rest: together they are a term that
    /// is not right.
    fn has_a_constant_beside(&mut self, event: usize, term: &ScalarColumns, wanted: &[DVec3]) -> bool {
        if !is_constant(term) {
            return false;
        }
        let Some((_, mut moved)) = self.bench.trace(&self.raised(event)) else { return false };
        let Some(moved) = moved[self.stage as usize].take() else { return false };
        let others = self.trace.events.iter().zip(&moved.events).enumerate().skip(event + 1);
        let colour = |event: &Event| match event.values.as_slice() {
            [red, green, blue, ..] => Some(DVec3::new(red[0], green[0], blue[0])),
            _ => None,
        };
        let is_beside = |(before, after): (&Event, &Event)| {
            let is_other = before.site == after.site && is_constant(&before.values) && !is_it(before, term);
            let (Some(before), Some(after)) = (colour(before), colour(after)) else { return false };
            is_other && passes(before, after, ADDED.into()) == Some(true)
        };
        let beside: Vec<usize> = others.filter(|(_, pair)| is_beside(*pair)).map(|(at, _)| at).collect();
        beside.into_iter().take(MOST_CANDIDATES).any(|other| self.moves(other, wanted))
    }
}

/// Something is added to some events.
pub(super) fn raised(stage: Stage, trace: &Trace, events: &[usize]) -> StageChanges {
    let raise = |values: &ScalarColumns| -> ScalarColumns {
        let more = ADDED.into_iter().chain(std::iter::repeat(0.0));
        values.iter().zip(more).map(|(column, added)| column.iter().map(|x| x + added).collect()).collect()
    };
    let mut changes = StageChanges::default();
    for site in events.iter().map(|event| trace.events[*event].site).collect::<BTreeSet<usize>>() {
        let turns = trace.events.iter().enumerate().filter(|(_, event)| event.site == site);
        let values = turns.map(|(at, own)| if events.contains(&at) { raise(&own.values) } else { own.values.clone() });
        changes[stage as usize].push(ValueChange { site, values: values.collect() });
    }
    changes
}

/// Whether an event is this colour wherever the program runs, alpha aside.
fn is_it(event: &Event, colour: &ScalarColumns) -> bool {
    let same = |(own, wanted): (&Vec<f64>, &Vec<f64>)| {
        own.len() == wanted.len() && own.iter().zip(wanted).all(|(own, wanted)| is_number(*own, *wanted))
    };
    event.values.len() >= 3
        && colour.len() >= 3
        && event.lanes.iter().all(|lane| *lane)
        && event.values.iter().zip(colour).take(3).all(same)
}

/// Whether the colour moves by so much; `None` where that cannot be seen.
pub(super) fn passes(before: DVec3, after: DVec3, wanted: DVec3) -> Option<bool> {
    let channels = before.to_array().into_iter().zip(after.to_array()).zip(wanted.to_array());
    let mut seen = None;
    for ((before, after), added) in channels {
        let is_at_an_end = before == after && (before == 0.0 || before == 1.0);
        if added.abs() < LEAST || is_at_an_end || after == 1.0 && before + added > 1.0 {
            continue;
        }
        let moves = (after - before - added).abs() <= EXACT;
        if !moves {
            return Some(false);
        }
        seen = Some(true);
    }
    seen
}
