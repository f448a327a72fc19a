//! What is worth saying of a right answer: where it would break beyond the homework.
//!
//! The shader is run on the CPU under circumstances that the course's program does not have. That judges nothing and
//! costs no points; a right answer is right because every frame and every probe agrees.

use super::Evidence;
use super::locate::{Located, Points, Words, given, is_close, is_handed_out, of};
use crate::language::Text;
use crate::report::Advice;
use crate::translate::{Interpreter, Invocation};
use glam::{DVec3, DVec4};
use reference::Assignment;
use reference::advice::Variation;
use reference::probes::ProbeSet;

/// How many probes are varied for each piece of advice. A run takes some 20 µs, so that all of them cost a hundredth of
/// a grading.
const PROBES: usize = 8;

/// A shader that takes more instructions for a vertex is not asked: it would cost more than a word is worth.
const MOST_STEPS: u32 = 4_000;

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
            let outcome = right.evaluate(&variation.uniforms, &variation.attributes);
            (outcome.colour(), outcome.position())
        });
        let expected = expected.collect();
        Some(Beyond { advice: advice.clone(), assignment, variations, expected })
    };
    assignment.advice.iter().filter_map(of_advice).collect()
}

/// The advice for a right answer, at most one piece for a line.
pub(super) fn find(evidence: &Evidence<'_>) -> Vec<Advice> {
    let Some(interpreter) = evidence.interpreter else { return Vec::new() };
    let mut found: Vec<Advice> = Vec::new();
    for advice in evidence.beyond.iter().filter_map(|beyond| beyond.advice(evidence, interpreter)) {
        if advice.line.is_none() || !found.iter().any(|other| other.line == advice.line) {
            found.push(advice);
        }
    }
    found
}

impl Beyond {
    /// What the shader is run with.
    pub(super) fn given<'a>(&'a self, variation: &'a Variation) -> Invocation<'a> {
        let kept = self.advice.when.constants.iter().map(|(name, value)| (name.as_str(), of(value)));
        let given = given(&self.assignment, &variation.uniforms, &variation.attributes);
        Invocation { kept: kept.collect(), ..given }
    }

    fn advice(&self, evidence: &Evidence<'_>, interpreter: &Interpreter) -> Option<Advice> {
        // What the file does not declare cannot be set to something else.
        if !self.advice.when.constants.iter().all(|(name, _)| interpreter.has_variable(name)) {
            return None;
        }
        let differs = self.differs(evidence, interpreter)?;
        if !differs.colour && !differs.position {
            return None;
        }
        let place = || Points::beyond(interpreter, self, evidence.source)?.place_of(&self.advice.about);
        let located = if differs.colour { place() } else { interpreter.last_position().map(Located::at) };
        if self.advice.only_about && located.is_none() {
            return None;
        }
        let starter = &evidence.assignment.files[0].starter;
        let located = located.filter(|located| !is_handed_out(evidence.source, located.line, starter));
        Some(self.message(evidence, located))
    }

    /// Whether the colour or the position is not what a right answer has; `None` where the shader cannot be run.
    fn differs(&self, evidence: &Evidence<'_>, interpreter: &Interpreter) -> Option<Differs> {
        let output = &evidence.assignment.interface.outputs.first()?.name;
        let mut differs = Differs::default();
        for (variation, (colour, position)) in self.variations.iter().zip(&self.expected) {
            let written = interpreter.run(&self.given(variation), output, &mut |_, _| None)?;
            if written.steps > MOST_STEPS {
                return None;
            }
            differs.colour |= !is_close(colour.to_array(), &written.output);
            let own: [f64; 4] = written.position?.try_into().ok()?;
            differs.position |= !is_same_point(*position, DVec4::from_array(own));
        }
        Some(differs)
    }

    fn message(&self, evidence: &Evidence<'_>, located: Option<Located>) -> Advice {
        let line = located.as_ref().map(|located| located.line);
        let mut values = Vec::new();
        if let Some(Located { line, name, .. }) = located {
            values.push(("line", line.to_string()));
            let words = Words::at(evidence.source, line);
            values.extend(name.filter(|name| words.has(name)).map(|name| ("name", name)));
        }
        let values: Vec<(&str, &str)> = values.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let message = self.advice.message.fill(&values);
        Advice {
            id: self.advice.id.clone(),
            message: Text::new(message.en, message.ja),
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
