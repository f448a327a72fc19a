//! Constants of the handed-out file that the student changed, read from their own text.

use super::Evidence;
use super::trials::{FUEL_OF_TRACE, StageChanges};
use crate::compare::{COLOUR_TOLERANCE, colour_difference};
use crate::render::Sample;
use crate::source::{self, Source};
use glam::DVec3;
use reference::assignment::Constant;
use reference::equation::Reads;
use reference::interpreter::Stage;
use reference::probes::ProbeSet;
use reference::traced::{Bench, Place, TracedProgram};
use reference::{Assignment, Value, interpreter};

/// A constant with another value than the handed-out one.
#[derive(Clone, Debug)]
pub struct ChangedConstant {
    /// Its name.
    pub name: String,
    /// What the handed-out file says.
    pub expected: Value,
    /// What the student's file says.
    pub found: Value,
    /// The stage whose text says so.
    pub stage: Stage,
    /// The line there, from 1.
    pub line: u32,
}

/// The constants whose declaration or `#define` in one of the texts has another value.
///
/// A value that is not written as a constant expression of plain GLSL is not found; the samples show what it does.
pub fn changed<'s>(
    sources: impl Iterator<Item = (Stage, &'s Source)> + Clone,
    assignment: &Assignment,
) -> Vec<ChangedConstant> {
    let of_one = |constant: &Constant, stage: Stage, source: &Source| {
        let code = source.code();
        let (at, text) = initialiser(code, &constant.name).or_else(|| defined(code, &constant.name))?;
        let kind = constant.value.kind();
        let found = Value::new(kind.clone(), interpreter::constant(text, kind).ok()?)?;
        (!is_equal(&found, &constant.value)).then(|| ChangedConstant {
            name: constant.name.clone(),
            expected: constant.value.clone(),
            found,
            stage,
            line: source.position(at).0,
        })
    };
    let constants = assignment.constants.iter();
    constants
        .filter_map(|constant| sources.clone().find_map(|(stage, source)| of_one(constant, stage, source)))
        .collect()
}

/// `text` with another value for a constant that `code` declares: the same text without its comments. `None` where it does not.
pub(super) fn with(text: &str, code: &str, name: &str, value: &Value) -> Option<String> {
    let (at, _) = initialiser(code, name)?;
    let start = at + code[at..].find('=')? + 1;
    let numbers: Vec<String> = value.numbers().iter().map(|number| format!("{number:?}")).collect();
    let written = format!(" {}({})", value.kind(), numbers.join(", "));
    let end = start + end(&code[start..]);
    // Lines stay where they are.
    let lines = "\n".repeat(text.get(start..end)?.matches('\n').count());
    Some(format!("{}{written}{lines}{}", text.get(..start)?, text.get(end..)?))
}

/// Whether the samples are those of a right answer with these constants, also at the probes that nobody knows beforehand, where the
/// solution is a program of no definitions.
pub(super) fn explain(changed: &[ChangedConstant], evidence: &Evidence<'_>) -> bool {
    let assignment = evidence.assignment;
    if changed.is_empty() || assignment.equation.reads() != Reads::Outputs {
        return false;
    }
    let texts = assignment.files.iter().map(|file| {
        let own = file.solution.text.clone();
        let of_stage = changed.iter().filter(|constant| constant.stage == file.stage);
        let other = of_stage.clone().try_fold(own, |text, constant| {
            let code = source::read_stage(file.stage, "", text.as_bytes()).ok()?.code().to_owned();
            with(&text, &code, &constant.name, &constant.found)
        });
        Some((file.stage, other?))
    });
    let Some(texts) = texts.collect::<Option<Vec<(Stage, String)>>>() else { return false };
    let texts: Vec<(Stage, &str)> = texts.iter().map(|(stage, text)| (*stage, text.as_str())).collect();
    let Ok(program) = TracedProgram::new(assignment, &texts) else { return false };
    let shown = |probes: &ProbeSet| {
        let places = Place::all(probes);
        let mut bench = Bench::new(assignment, &program, &places, program.needs_quads(assignment), FUEL_OF_TRACE)?;
        Some(bench.with(&StageChanges::default())?.colours)
    };
    let agrees = |probes: &ProbeSet, samples: &[Sample]| {
        let is_it = |(wanted, sample): (&DVec3, &Sample)| colour_difference(*wanted, sample) <= COLOUR_TOLERANCE;
        shown(probes).is_some_and(|shown| shown.iter().zip(samples).all(is_it))
    };
    agrees(evidence.probes, evidence.samples) && agrees(evidence.fresh.probes, evidence.fresh.samples)
}

/// Whether two values draw the same: alpha is not seen, but a light's w is.
fn is_equal(a: &Value, b: &Value) -> bool {
    // Literals are read in f32 by a compiler; a change that small is none.
    const RELATIVE: f64 = 1e-6;
    let close = |(x, y): (f64, f64)| (x - y).abs() <= RELATIVE * y.abs().max(1e-3);
    a.numbers().iter().copied().zip(b.numbers().iter().copied()).all(close)
}

/// The text after `name =` up to the comma or semicolon that ends it, and where the name stands.
fn initialiser<'a>(code: &'a str, name: &str) -> Option<(usize, &'a str)> {
    for at in occurrences(code, name) {
        let rest = code[at + name.len()..].trim_start();
        let Some(value) = rest.strip_prefix('=').filter(|value| !value.starts_with('=')) else { continue };
        return Some((at, value[..end(value)].trim()));
    }
    None
}

/// The text of `#define name …`, and where the name stands.
fn defined<'a>(code: &'a str, name: &str) -> Option<(usize, &'a str)> {
    occurrences(code, name).find_map(|at| {
        let line_start = code[..at].rfind('\n').map_or(0, |newline| newline + 1);
        let before = code[line_start..at].trim();
        let is_define = before.strip_prefix('#').is_some_and(|word| word.trim() == "define");
        let value = code[at + name.len()..].lines().next().unwrap_or_default().trim();
        (is_define && !value.is_empty()).then_some((at, value))
    })
}

fn occurrences<'a>(code: &'a str, name: &'a str) -> impl Iterator<Item = usize> + 'a {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    code.match_indices(name).map(|(at, _)| at).filter(move |&at| {
        let before = code[..at].chars().next_back().is_some_and(|c| is_word(c) || c == '.');
        let after = code[at + name.len()..].chars().next().is_some_and(is_word);
        !before && !after
    })
}

/// Where an initialiser ends: at the first comma or semicolon outside parentheses.
fn end(value: &str) -> usize {
    let mut depth = 0;
    for (at, c) in value.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' | ';' if depth <= 0 => return at,
            _ => {}
        }
    }
    value.len()
}
