//! What is worth saying of a right answer: where it would break beyond the homework.
//!
//! The shader is run on the CPU under circumstances that the course's program does not have. That judges nothing and
//! costs no points; a right answer is right because every frame and every probe agrees.

use super::Evidence;
use super::columns::is_colour;
use super::locate::{Located, TracedProbes, Words, is_handed_out, last_position};
use super::trials::{StageChanges, place};
use crate::language::Text;
use crate::report::AdviceLine;
use crate::translate::plain_lines;
use glam::{DVec3, DVec4};
use reference::Assignment;
use reference::advice::Variation;
use reference::interpreter::Undefined;
use reference::probes::ProbeSet;
use reference::traced::{Bench, Place, Seen, TracedProgram};
use std::cell::LazyCell;

/// How many probes are varied for each piece of advice.
const PROBES: usize = 8;

/// A shader that takes more steps for them is not asked: it would cost more than a word is worth.
const FUEL: u64 = 200_000;

/// The probes of one piece of advice, and what a right answer computes there.
#[derive(Debug)]
pub struct Beyond {
    advice: reference::advice::Advice,
    /// The homework with the circumstance's constants.
    pub(super) assignment: Assignment,
    pub(super) variations: Vec<Variation>,
    expected: Vec<(DVec3, DVec4)>,
}

/// What advice comes from. `probes`: those that judge.
pub fn beyond(assignment: &Assignment, probes: &ProbeSet) -> Vec<Beyond> {
    let of_advice = |advice: &reference::advice::Advice| {
        let constants: Vec<_> =
            advice.when.constants.iter().map(|(name, value)| (name.as_str(), value.clone())).collect();
        let assignment = assignment.with_constants(&constants).ok()?;
        let variations = assignment.variations(&advice.when, probes, PROBES);
        let right = assignment.equation.right();
        let expected = variations.iter().map(|variation| {
            let outcome = right.evaluate(&variation.uniforms, &variation.probe.attributes);
            (outcome.colour(), outcome.position())
        });
        let expected = expected.collect();
        Some(Beyond { advice: advice.clone(), assignment, variations, expected })
    };
    assignment.advice.iter().filter_map(of_advice).collect()
}

/// The advice for a right answer, at most one piece for a line.
pub(super) fn find(evidence: &Evidence<'_>) -> Vec<AdviceLine> {
    let mut found: Vec<AdviceLine> = undefined(evidence).into_iter().collect();
    if !found.is_empty() || evidence.beyond.is_empty() || !is_defined(evidence) {
        return found;
    }
    let usual = LazyCell::new(|| TracedProbes::new(evidence, evidence.assignment));
    for advice in evidence.beyond.iter().filter_map(|beyond| beyond.advice(evidence, || usual.as_ref())) {
        if advice.line.is_none() || !found.iter().any(|other| other.line == advice.line) {
            found.push(advice);
        }
    }
    found
}

/// A result that GLSL leaves open, on which the colour depends: this driver has one that is right, and another need not.
fn undefined(evidence: &Evidence<'_>) -> Option<AdviceLine> {
    let places = Place::all(evidence.probes);
    let (stage, cause) = seen(evidence.assignment, evidence.traced?, &places)?.undefined?;
    // These are the text's own. The others come from where a probe lies, or drivers agree on them.
    let is_of_the_text = matches!(
        cause.what,
        Undefined::Uninitialised
            | Undefined::NoResult
            | Undefined::Index
            | Undefined::Power
            | Undefined::Domain
            | Undefined::Division
            | Undefined::Bounds
    );
    let (_, source) = evidence.sources.iter().find(|(own, _)| *own == stage).filter(|_| is_of_the_text)?;
    let ((en, ja), line) = (cause.what.words(), cause.line);
    let message = Text::new(
        format!(
            "The colour depends on what GLSL leaves undefined on line {line}: {en}. The driver here gives what is right, and another one \
             may give something else."
        ),
        format!(
            "{line} 行目に、GLSL では結果が決まらない計算があり、色がそれに依存しています: {ja}。ここのドライバーでは正しい結果になりましたが、\
             別のドライバーでは違う結果になることがあります。"
        ),
    );
    Some(AdviceLine { id: "undefined".into(), message, file: source.facts.name.clone(), line: Some(line) })
}

/// Whether the interpreter finds the answer right, as the driver does. What GLSL leaves undefined is no matter of advice.
fn is_defined(evidence: &Evidence<'_>) -> bool {
    let all = evidence.probes.probes.len();
    let count = all.min(PROBES);
    let places: Vec<Place<'_>> = (0..count).map(|at| place(evidence, at * all / count)).collect();
    let seen = evidence.traced.and_then(|program| seen(evidence.assignment, program, &places));
    seen.is_some_and(|seen| {
        let mut own = seen.colours.iter().zip(&seen.positions).zip(&places);
        own.all(|((colour, position), Place { probe, .. })| {
            is_colour(probe.colour, *colour) && is_same_point(probe.position, *position)
        })
    })
}

/// What is seen of a program; `None` where it cannot be run, or not in time.
fn seen(assignment: &Assignment, program: &TracedProgram, places: &[Place<'_>]) -> Option<Seen> {
    let in_quads = program.needs_quads(assignment);
    Bench::new(assignment, program, places, in_quads, FUEL)?.with(&StageChanges::default())
}

impl Beyond {
    /// The probes, varied.
    pub(super) fn places<'b>(&'b self) -> Vec<Place<'b>> {
        let place = |one: &'b Variation| Place { probe: &one.probe, uniforms: &one.uniforms };
        self.variations.iter().map(place).collect()
    }

    /// The student's program with the circumstance's constants. `None` where the text does not declare them, so that nothing
    /// can set them to something else.
    fn program(&self, evidence: &Evidence<'_>) -> Option<TracedProgram> {
        let constants = &self.advice.when.constants;
        if constants.is_empty() {
            return evidence.traced.cloned();
        }
        let own = (evidence.source.text.clone(), evidence.source.code().to_owned());
        let (text, _) = constants.iter().try_fold(own, |(text, code), (name, value)| {
            let with = |text: &str| super::constants::with(text, &code, name, value);
            Some((with(&text)?, with(&code)?))
        })?;
        let (stage, _) = evidence.sources.first()?;
        TracedProgram::new(evidence.assignment, &[(*stage, &plain_lines(&text))]).ok()
    }

    /// `usual`: the text where nothing is varied, which is run only where a place is looked for.
    fn advice<'u>(
        &self,
        evidence: &Evidence<'_>,
        usual: impl FnOnce() -> Option<&'u TracedProbes<'u>>,
    ) -> Option<AdviceLine> {
        let program = self.program(evidence)?;
        let differs = self.differs(&program)?;
        if !differs.colour && !differs.position {
            return None;
        }
        let place = || TracedProbes::beyond(evidence, self, &program)?.place_of(&self.advice.about, usual()?);
        let located = if differs.colour { place() } else { last_position(&program).map(Located::at) };
        if self.advice.only_about && located.is_none() {
            return None;
        }
        let starter = evidence.assignment.files[0].starter_shader();
        let located = located.filter(|located| !is_handed_out(evidence.source, located.line, starter));
        Some(self.message(evidence, located))
    }

    /// Whether the colour or the position is not what a right answer has; `None` where the shader cannot be run.
    fn differs(&self, program: &TracedProgram) -> Option<Differs> {
        let seen = seen(&self.assignment, program, &self.places())?;
        let seen = seen.colours.iter().zip(&seen.positions);
        let mut differs = Differs::default();
        for ((own_colour, own_position), (colour, position)) in seen.zip(&self.expected) {
            differs.colour |= !is_colour(*colour, *own_colour);
            differs.position |= !is_same_point(*position, *own_position);
        }
        Some(differs)
    }

    fn message(&self, evidence: &Evidence<'_>, located: Option<Located>) -> AdviceLine {
        let line = located.as_ref().map(|located| located.line);
        let mut values = Vec::new();
        if let Some(Located { line, name, .. }) = located {
            values.push(("line", line.to_string()));
            let words = Words::at(evidence.source, line);
            values.extend(name.filter(|name| words.has(name)).map(|name| ("name", name)));
        }
        let values: Vec<(&str, &str)> = values.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let message = self.advice.message.fill(&values);
        AdviceLine {
            id: self.advice.id.clone(),
            message: message.into(),
            file: evidence.source.facts.name.clone(),
            line,
        }
    }
}

#[derive(Clone, Copy, Debug, Default)]
struct Differs {
    colour: bool,
    position: bool,
}

/// Whether two homogeneous positions are the same point.
fn is_same_point(a: DVec4, b: DVec4) -> bool {
    // Measured: a right answer in f32 is off by 1e-6 of the largest coordinate.
    const RELATIVE: f64 = 1e-3;
    let apart = (a * b.w - b * a.w).abs().max_element();
    apart <= RELATIVE * a.abs().max_element() * b.abs().max_element()
}
