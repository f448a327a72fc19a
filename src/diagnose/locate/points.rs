//! Some of the probes, and what the student's shader computes there step by step.

use super::lines::is_handed_out;
use crate::compare::COLOUR_TOLERANCE;
use crate::diagnose::Evidence;
use crate::diagnose::advice::Beyond;
use crate::source::Source;
use crate::translate::{Interpreter, Invocation, Site, Value, Written};
use reference::advice::Variation;
use reference::equation::{Reads, Variant};
use reference::interpreter::Type;
use reference::probes::Probe;
use reference::{Assignment, Value as Reference};
use std::cell::Cell;

/// How many wrong and how many right samples are looked at. Each run takes some 20 µs.
const OF_EACH_KIND: usize = 10;

/// How many instructions a search may run. Measured: 100,000 to 600,000 for answers of the usual length, which takes some
/// milliseconds; a file whose loops make it run longer is answered without a line.
const MOST_STEPS: u64 = 5_000_000;

/// The shader at some of the probes.
pub(in crate::diagnose) struct Points<'a> {
    pub interpreter: &'a Interpreter,
    /// The homework, with the student's own constants.
    pub assignment: &'a Assignment,
    pub(super) output: &'a str,
    pub(super) points: Vec<Point<'a>>,
    pub(super) source: &'a Source,
    /// How many more instructions may be run.
    budget: Cell<u64>,
}

/// One probe.
pub(super) struct Point<'a> {
    pub given: Invocation<'a>,
    uniforms: &'a [Reference],
    attributes: &'a [Reference],
    steps: u32,
    /// Every value on the way to the colour, in the order in which they are computed.
    pub values: Vec<(Site, Value)>,
}

impl<'a> Points<'a> {
    /// Runs the shader at wrong and at right samples in turn, a wrong one first. `None` where it does not compute what
    /// the driver computed.
    pub fn new(evidence: &Evidence<'a>, assignment: &'a Assignment) -> Option<Self> {
        let interpreter = evidence.interpreter?;
        let output = assignment.interface.outputs.first()?.name.as_str();
        let all: Vec<_> = evidence.probes.iter().zip(evidence.samples).collect();
        let is_wrong = |(probe, sample): &&(&'a Probe, &crate::render::Sample)| {
            !is_close(probe.colour.to_array(), &sample.colour_f64())
        };
        let (wrong, right): (Vec<_>, Vec<_>) = all.iter().partition(is_wrong);
        let mut chosen = spread(&wrong);
        chosen.extend(spread(&right));
        let mut points = Vec::new();
        for (probe, sample) in chosen {
            let uniforms = evidence.probes.uniforms(probe);
            let (point, written) = Point::new(
                interpreter,
                output,
                given(assignment, uniforms, &probe.attributes),
                uniforms,
                &probe.attributes,
            )?;
            if !is_close(sample.colour_f64(), &written.output) {
                return None;
            }
            points.push(point);
        }
        let (source, budget) = (evidence.source, Cell::new(MOST_STEPS));
        (!points.is_empty()).then_some(Self { interpreter, assignment, output, points, source, budget })
    }

    /// Runs the shader under a circumstance of advice.
    pub fn beyond(interpreter: &'a Interpreter, beyond: &'a Beyond, source: &'a Source) -> Option<Self> {
        let assignment = &beyond.assignment;
        let output = assignment.interface.outputs.first()?.name.as_str();
        let point = |variation: &'a Variation| {
            let Variation { uniforms, attributes } = variation;
            Some(Point::new(interpreter, output, beyond.given(variation), uniforms, attributes)?.0)
        };
        let points = beyond.variations.iter().map(point).collect::<Option<_>>()?;
        Some(Self { interpreter, assignment, output, points, source, budget: Cell::new(MOST_STEPS) })
    }

    /// Whether the student wrote the line on which a value is computed: what was handed out is right.
    pub(super) fn is_own(&self, place: Site) -> bool {
        let starter = &self.assignment.files[0].starter;
        self.interpreter.line(place).is_some_and(|line| !is_handed_out(self.source, line, starter))
    }

    /// Whether a value is computed in the text of a macro.
    pub(super) fn is_in_macro(&self, place: Site) -> bool {
        let line = self.interpreter.line(place).map(|line| self.source.code_line(line));
        line.is_some_and(|line| line.trim_start().starts_with('#'))
    }

    /// The definitions of a variant of the equation at each point, in the equation's order.
    pub(super) fn definitions(&self, variant: &Variant<'_>) -> Vec<Vec<Vec<f64>>> {
        let names = self.assignment.equation.definitions();
        let at = |point: &Point<'_>| {
            let outcome = variant.evaluate(point.uniforms, point.attributes);
            names
                .iter()
                .map(|d| outcome.get(&d.name).map(|value| value.numbers().to_vec()).unwrap_or_default())
                .collect()
        };
        self.points.iter().map(at).collect()
    }

    /// Whether the colour is `wanted` at every point when the values are changed so.
    pub(super) fn becomes(&self, wanted: &[[f64; 3]], change: &dyn Fn(usize, Site, &Value) -> Option<Value>) -> bool {
        self.points.iter().zip(wanted).enumerate().all(|(index, (point, wanted))| {
            let Some(left) = self.budget.get().checked_sub(u64::from(point.steps)) else { return false };
            self.budget.set(left);
            let written =
                self.interpreter.run(&point.given, self.output, &mut |place, value| change(index, place, value));
            written.is_some_and(|written| is_close(*wanted, &written.output))
        })
    }

    /// Whether the colour stays the same at every point when a constant has another value.
    pub(super) fn is_unchanged_with(&self, constant: &str, value: &Value) -> bool {
        self.points.iter().all(|point| {
            let other = Invocation { kept: vec![(constant, value.clone())], ..point.given.clone() };
            let [before, after] =
                [&point.given, &other].map(|given| self.interpreter.run(given, self.output, &mut |_, _| None));
            before == after
        })
    }

    /// The student's own name for a definition: that of a variable that holds it at every point.
    pub fn name_of(&self, definition: &str) -> Option<&'a str> {
        let index = self.assignment.equation.index(definition)?;
        let right = self.definitions(&self.assignment.equation.right());
        let holds = |place: &Site| {
            self.points.iter().zip(&right).all(|(point, right)| {
                let value = point.values.iter().find(|(p, _)| p == place).and_then(|(_, value)| value.floats());
                value.is_some_and(|value| is_same(&value, &right[index]))
            })
        };
        let first = self.points.first()?;
        let mut named = first.values.iter().filter(|(place, value)| {
            value.floats().is_some_and(|value| is_same(&value, &right[0][index]))
                && self.interpreter.variable(*place).is_some()
                && holds(place)
        });
        self.interpreter.variable(named.next()?.0)
    }
}

impl<'a> Point<'a> {
    fn new(
        interpreter: &Interpreter,
        output: &str,
        given: Invocation<'a>,
        uniforms: &'a [Reference],
        attributes: &'a [Reference],
    ) -> Option<(Self, Written)> {
        let mut values = Vec::new();
        let look = &mut |place: Site, value: &Value| {
            values.push((place, value.clone()));
            None
        };
        let written = interpreter.run(&given, output, look)?;
        Some((Self { given, uniforms, attributes, steps: written.steps, values }, written))
    }
}

/// What the shader is run with.
pub(in crate::diagnose) fn given<'a>(
    assignment: &'a Assignment,
    uniforms: &[Reference],
    attributes: &[Reference],
) -> Invocation<'a> {
    let uniforms = assignment.interface.uniforms.iter().map(|u| u.path.as_str()).zip(uniforms);
    let attributes = assignment.names_read().into_iter().zip(attributes);
    Invocation {
        inputs: uniforms.chain(attributes).map(|(name, value)| (name, of(value))).collect(),
        textures: &assignment.textures,
        clamps: assignment.equation.reads() != Reads::Attributes,
        ..Invocation::default()
    }
}

/// A value of the reference as the interpreter has it.
pub(in crate::diagnose) fn of(value: &Reference) -> Value {
    match *value.kind() {
        Type::Matrix(_, _, rows) => Value::of_columns(value.numbers(), usize::from(rows)),
        _ => Value::of_floats(value.numbers()),
    }
}

/// Some of them, from the first to the last.
fn spread<T: Copy>(all: &[T]) -> Vec<T> {
    let count = all.len().min(OF_EACH_KIND);
    (0..count).map(|at| all[at * all.len() / count]).collect()
}

/// Whether two colours are the same, alpha aside; all that is no number is.
pub(in crate::diagnose) fn is_close(wanted: [f64; 3], found: &[f64]) -> bool {
    found.len() >= 3
        && wanted.iter().zip(found).all(|(wanted, found)| {
            if !wanted.is_finite() {
                return !found.is_finite();
            }
            (found - wanted).abs() <= COLOUR_TOLERANCE * wanted.abs().max(1.0)
        })
}

/// Whether two values are the same in the components that both have.
pub(in crate::diagnose) fn is_same(a: &[f64], b: &[f64]) -> bool {
    // What is computed in another order differs by rounding, and constants are f32.
    const RELATIVE: f64 = 1e-4;
    fits(a, b) && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= RELATIVE * a.abs().max(b.abs()).max(1e-3))
}

/// Whether a value of the student's can stand for a definition: a colour may have three components instead of four.
pub(super) fn fits(value: &[f64], definition: &[f64]) -> bool {
    value.len() == definition.len() || (value.len() == 3 && definition.len() == 4)
}
