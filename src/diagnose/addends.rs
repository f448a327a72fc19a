//! Terms that the student's text computes right and adds as they are.
//!
//! What a driver shows is the sum. A wrong term that is 0 nowhere hides a right one from every sample. In the text the right
//! one still stands by itself: a value that is the right term at every probe, and that moves the colour by exactly what it
//! moves a right answer's when something is added to it.

use super::Evidence;
use super::locate::{given, is_close, is_same};
use crate::render::Sample;
use crate::translate::{Interpreter, Invocation, Site, Value};
use reference::assignment::RubricLine;
use reference::fit::TermJudgement;
use reference::probes::Probe;

/// Every seventh of the 560 probes is looked at, so that each of the 20 designs occurs four times.
const STRIDE: usize = 7;

/// What is added to a value to see what becomes of it, in red, green and blue: other than any constant of a homework, and
/// different so that no channel passes for another.
const ADDED: [f64; 3] = [0.173, 0.139, 0.111];

/// A value beyond this counts as 0, as what is not finite does: such a term costs the others nothing. Those of a right answer
/// stay below 100.
const OVERFLOWING: f64 = 1e4;

/// So exactly the colour has to move by what is added. Noise: 1e-12 (f64). Defect to catch: a factor of 0.999.
const EXACT: f64 = 1e-5;

/// A move of less than this tells nothing.
const LEAST: f64 = 1e-3;

/// So many values that look like a term at one probe are tried.
const MOST_CANDIDATES: usize = 24;

/// A probe, and what the shader computes there when nothing overflows.
struct Point<'a> {
    probe: &'a Probe,
    given: Invocation<'a>,
    output: Vec<f64>,
}

/// The judgements; right are also the terms that the text adds as they are. One stays wrong, for the sum is.
pub(super) fn credit(evidence: &Evidence<'_>, judged: Vec<TermJudgement>) -> Vec<TermJudgement> {
    let Some(points) = points(evidence) else { return judged };
    let is_added = |judgement: &TermJudgement| {
        let line = evidence.assignment.rubric.iter().find(|line| line.id == judgement.line);
        line.is_some_and(|line| is_added(evidence, &points, line))
    };
    let samples = evidence.samples.len();
    let credited = judged.iter().map(|judgement| {
        let is_right = judgement.is_right() || is_added(judgement);
        if is_right { TermJudgement::right(&judgement.line, samples) } else { judgement.clone() }
    });
    let credited: Vec<TermJudgement> = credited.collect();
    if credited.iter().all(TermJudgement::is_right) { judged } else { credited }
}

/// Whether the text computes some term that the rubric judges, right and not the same everywhere, whatever becomes of it.
pub(super) fn computes_a_term(evidence: &Evidence<'_>) -> bool {
    let (Some(points), Some(interpreter)) = (points(evidence), evidence.interpreter) else { return false };
    let search = Search { evidence, interpreter, points: &points, wanted: Vec::new() };
    evidence.assignment.rubric.iter().any(|line| {
        let terms: Vec<Vec<f64>> = points.iter().map(|point| right_term(evidence, point, line)).collect();
        let varies = terms.iter().any(|term| !is_same(term, &terms[0]));
        let Some(brightest) = brightest(&terms).filter(|_| varies) else { return false };
        let is_it = |value: &Value| is_colour(value, &terms[brightest]);
        search.candidates(brightest, &is_it).into_iter().any(|place| search.has(place, &terms))
    })
}

/// Some of the probes. `None` where the interpreter does not compute what the driver computed.
fn points<'a>(evidence: &Evidence<'a>) -> Option<Vec<Point<'a>>> {
    let interpreter = evidence.interpreter?;
    let some = evidence.probes.iter().zip(evidence.samples).step_by(STRIDE);
    let point = |(probe, sample): (&'a Probe, &Sample)| {
        let given = given_at(evidence, probe);
        let computed = computed(evidence, &given)?;
        // The driver shows anything for what overflows.
        let overflows = !computed.iter().take(3).all(|x| x.abs() < OVERFLOWING);
        let given = Invocation { clamps: false, ..given };
        let output = run(evidence, interpreter, &given, &mut |_, _| None)?;
        (overflows || is_close(sample.colour_f64(), &computed)).then_some(Point { probe, given, output })
    };
    some.map(point).collect()
}

fn given_at<'a>(evidence: &Evidence<'a>, probe: &Probe) -> Invocation<'a> {
    given(evidence.assignment, evidence.probes.uniforms(probe), &probe.attributes)
}

/// The colour that the text computes.
fn computed(evidence: &Evidence<'_>, given: &Invocation<'_>) -> Option<Vec<f64>> {
    let output = &evidence.assignment.interface.outputs.first()?.name;
    Some(evidence.interpreter?.run(given, output, &mut |_, _| None)?.output)
}

/// Whether no colour that the text computes is finite, so that what the driver shows says nothing.
pub(super) fn is_finite_nowhere(evidence: &Evidence<'_>) -> bool {
    let is_finite = |probe: &Probe| {
        let colour = computed(evidence, &given_at(evidence, probe));
        colour.is_none_or(|colour| colour.iter().take(3).all(|x| x.is_finite()))
    };
    // One of each design.
    !evidence.probes.of_group(0).iter().any(is_finite)
}

/// What the shader writes where what overflows counts as 0.
fn run(
    evidence: &Evidence<'_>,
    interpreter: &Interpreter,
    given: &Invocation<'_>,
    change: &mut dyn FnMut(Site, &Value) -> Option<Value>,
) -> Option<Vec<f64>> {
    let output = &evidence.assignment.interface.outputs.first()?.name;
    let mut watch = |place: Site, value: &Value| change(place, value).or_else(|| finite(value));
    Some(interpreter.run(given, output, &mut watch)?.output)
}

/// The value with 0 for what overflows; `None` where nothing does.
fn finite(value: &Value) -> Option<Value> {
    let is_usual = |x: &f64| x.abs() < OVERFLOWING;
    let floats = value.floats().filter(|floats| !floats.iter().all(is_usual))?;
    Some(Value::of_floats(&floats.into_iter().map(|x| if is_usual(&x) { x } else { 0.0 }).collect::<Vec<_>>()))
}

/// What a line judges, as a right answer computes it at a point.
fn right_term(evidence: &Evidence<'_>, point: &Point<'_>, line: &RubricLine) -> Vec<f64> {
    let right = evidence.assignment.equation.right();
    let outcome = right.evaluate(evidence.probes.uniforms(point.probe), &point.probe.attributes);
    outcome.get(&line.judges).map(|value| value.numbers().to_vec()).unwrap_or_default()
}

/// The point at which a term is largest: where it is 0, many a value looks like it.
fn brightest(terms: &[Vec<f64>]) -> Option<usize> {
    let size = |term: &[f64]| term.iter().take(3).fold(0.0_f64, |most, x| most.max(x.abs()));
    (0..terms.len()).max_by(|a, b| size(&terms[*a]).total_cmp(&size(&terms[*b])))
}

/// Whether the text has the line's right term as an addend of the colour.
fn is_added(evidence: &Evidence<'_>, points: &[Point<'_>], line: &RubricLine) -> bool {
    let Some(interpreter) = evidence.interpreter else { return false };
    let right = evidence.assignment.equation.right();
    let terms: Vec<Vec<f64>> = points.iter().map(|point| right_term(evidence, point, line)).collect();
    let Some(brightest) = brightest(&terms) else { return false };
    let Some(definition) = evidence.assignment.equation.index(&line.judges) else { return false };
    let wanted = |point: &Point<'_>| {
        let uniforms = evidence.probes.uniforms(point.probe);
        right.moves(uniforms, &point.probe.attributes, definition, ADDED).to_array()
    };
    let search = Search { evidence, interpreter, points, wanted: points.iter().map(wanted).collect() };
    let is_it = |value: &Value| is_colour(value, &terms[brightest]);
    let found = search.candidates(brightest, &is_it).into_iter().find(|place| search.moves(*place, &terms));
    found.is_some_and(|place| !search.has_a_constant_beside(place, &terms))
}

struct Search<'s, 'a> {
    evidence: &'s Evidence<'a>,
    interpreter: &'s Interpreter,
    points: &'s [Point<'a>],
    /// By how much a right answer's colour moves at each point by what is added to the term.
    wanted: Vec<[f64; 3]>,
}

impl Search<'_, '_> {
    /// Where such a value is computed at a point.
    fn candidates(&self, point: usize, is_it: &dyn Fn(&Value) -> bool) -> Vec<Site> {
        let mut candidates = Vec::new();
        let look = &mut |place: Site, value: &Value| {
            if is_it(value) && candidates.len() < MOST_CANDIDATES {
                candidates.push(place);
            }
            None
        };
        let ran = run(self.evidence, self.interpreter, &self.points[point].given, look).is_some();
        if ran { candidates } else { Vec::new() }
    }

    /// Whether a place has these values.
    fn has(&self, candidate: Site, values: &[Vec<f64>]) -> bool {
        self.points.iter().zip(values).all(|(point, wanted)| {
            let mut is_wanted = false;
            let look = &mut |place: Site, value: &Value| {
                is_wanted |= place == candidate && is_colour(value, wanted);
                None
            };
            run(self.evidence, self.interpreter, &point.given, look).is_some() && is_wanted
        })
    }

    /// Whether a place has these values, and the colour moves as a right answer's does when something is added to them.
    fn moves(&self, candidate: Site, values: &[Vec<f64>]) -> bool {
        let mut seen = 0;
        for ((point, wanted), moves) in self.points.iter().zip(values).zip(&self.wanted) {
            let mut is_wanted = false;
            let change = &mut |place: Site, value: &Value| {
                if place != candidate {
                    return None;
                }
                is_wanted |= is_colour(value, wanted);
                added_to(value)
            };
            let moved = run(self.evidence, self.interpreter, &point.given, change);
            match moved.filter(|_| is_wanted).map(|moved| passes(&point.output, &moved, *moves)) {
                Some(Some(true)) => seen += 1,
                Some(None) => {}
                Some(Some(false)) | None => return false,
            }
        }
        // What is clamped at the others tells nothing.
        2 * seen >= self.points.len()
    }

    /// Whether the term in this place is the same everywhere, and so is what is added to it before the rest: together they are
    /// a term that is not right.
    fn has_a_constant_beside(&self, term: Site, terms: &[Vec<f64>]) -> bool {
        let Some(first) = terms.first().filter(|first| terms.iter().all(|term| is_same(term, first))) else {
            return false;
        };
        let is_other = |value: &Value| value.floats().is_some_and(|v| v.len() >= 3) && !is_colour(value, first);
        self.candidates(0, &is_other).into_iter().filter(|place| *place > term).any(|place| {
            let [before, after] = [false, true].map(|is_moved| self.value(place, term, is_moved));
            let (Some(before), Some(after)) = (before, after) else { return false };
            passes(&before, &after, ADDED) == Some(true) && self.moves(place, &vec![before; self.points.len()])
        })
    }

    /// The colour in a place at the first point, before or after the term is moved.
    fn value(&self, place: Site, term: Site, is_moved: bool) -> Option<Vec<f64>> {
        let mut found = None;
        let look = &mut |at: Site, value: &Value| {
            if at == place {
                found = value.floats();
            }
            if is_moved && at == term { added_to(value) } else { None }
        };
        run(self.evidence, self.interpreter, &self.points[0].given, look)?;
        found
    }
}

/// Whether a value is this colour, alpha aside.
fn is_colour(value: &Value, colour: &[f64]) -> bool {
    let floats = value.floats().filter(|floats| floats.len() >= 3);
    floats.is_some_and(|floats| colour.len() >= 3 && is_same(&floats[..3], &colour[..3]))
}

fn added_to(value: &Value) -> Option<Value> {
    let mut floats = value.floats()?;
    floats.iter_mut().zip(ADDED).for_each(|(x, added)| *x += added);
    Some(Value::of_floats(&floats))
}

/// Whether the colour moves by so much; `None` where that cannot be seen.
fn passes(before: &[f64], after: &[f64], wanted: [f64; 3]) -> Option<bool> {
    let channels = before.iter().zip(after).zip(wanted);
    let mut seen = None;
    for ((before, after), added) in channels {
        let is_at_an_end = before == after && (*before == 0.0 || *before == 1.0);
        if added.abs() < LEAST || is_at_an_end || *after == 1.0 && before + added > 1.0 {
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
