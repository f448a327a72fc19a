//! The report as JSON: the contract `ggrade/report/v1`, in the order in which it is documented.

mod values;

use super::{
    AdviceLine, Comment, Environment, FrameResult, Hints, Lateness, MapLookup, ProbeResult, Repair, Report, RubricLine,
    SourceInfo, Verdict,
};
use crate::diagnostic::{Diagnostic, DiagnosticStage, Severity};
use crate::language::Language;
use crate::report::{CrossCheck, Opinion};
use serde::{Serialize, Serializer};
use values::JsonValues;

/// Name and version of the contract.
pub const SCHEMA: &str = "ggrade/report/v1";

/// One JSON object, indented, with a final newline; its messages are in `language`.
pub fn render(report: &Report, language: Language) -> String {
    // Strings, numbers and unit enums under constant keys: there is nothing that could fail.
    let mut json = serde_json::to_string_pretty(&view(report, language)).unwrap_or_default();
    json.push('\n');
    json
}

/// The same object, to be embedded in a larger answer, as its student may see it ([`Report::for_student`]).
pub fn view(report: &Report, language: Language) -> JsonReport<'_> {
    let view = JsonReport { repairs: &[], ..staff_view(report, language) };
    if report.hints > Hints::None {
        return view;
    }
    let rubric = view.rubric.into_iter().map(|line| JsonRubricLine { mistake: None, file: None, line: None, ..line });
    JsonReport { rubric: rubric.collect(), mistakes: &[], ..view }
}

/// The same object with all that a teacher may see.
pub fn staff_view(report: &Report, language: Language) -> JsonReport<'_> {
    JsonReport {
        schema: SCHEMA,
        assignment: &report.assignment,
        assignment_digest: &report.assignment_digest,
        source: report.source(),
        sources: &report.sources,
        verdict: report.verdict,
        score: Number(report.score),
        max_score: Number(report.max_score),
        lateness: report.lateness,
        total: report.lateness.map(|_| Number(report.total())),
        rubric: report.rubric.iter().map(|line| JsonRubricLine::of(report, line, language)).collect(),
        comments: &report.comments,
        mistakes: &report.mistakes,
        repairs: &report.repairs,
        advice: report.advice.iter().map(|advice| JsonAdvice::of(advice, language)).collect(),
        diagnostics: report.diagnostics.iter().map(|d| JsonMessage::of(report, d, language)).collect(),
        frames: report.frames.iter().map(JsonFrame::of).collect(),
        probes: JsonProbes::of(&report.probes),
        map_lookup: report.map_lookup.as_ref(),
        own_values: report.own_values.as_ref().map(|values| JsonValues::of(report, values, language)),
        cross_check: report.cross_check.as_ref().map(|checked| CrossChecked::of(checked, language)),
        environment: &report.environment,
        elapsed_ms: Number(report.elapsed_ms),
    }
}

/// A number that is written without a fraction when it is whole, and as null when it is not finite.
#[derive(Debug)]
struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // Whole numbers of this size are exact in f64.
        const EXACT: f64 = 9e15;
        if !self.0.is_finite() {
            serializer.serialize_none()
        } else if self.0.fract() == 0.0 && self.0.abs() < EXACT {
            serializer.serialize_i64(self.0 as i64)
        } else {
            serializer.serialize_f64(self.0)
        }
    }
}

/// A report in the shape of the contract.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = Report))]
pub struct JsonReport<'a> {
    schema: &'static str,
    assignment: &'a str,
    assignment_digest: &'a str,
    source: &'a SourceInfo,
    sources: &'a [SourceInfo],
    verdict: Verdict,
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    score: Number,
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    max_score: Number,
    /// How late it was handed in, where a service knows; `total` is what is left of the score then.
    #[serde(skip_serializing_if = "Option::is_none")]
    lateness: Option<Lateness>,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    total: Option<Number>,
    rubric: Vec<JsonRubricLine<'a>>,
    /// What people say about lines of the files.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    comments: &'a [Comment],
    mistakes: &'a [String],
    /// The changes by which the files become right; only for who teaches.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    repairs: &'a [Repair],
    advice: Vec<JsonAdvice<'a>>,
    diagnostics: Vec<JsonMessage<'a>>,
    frames: Vec<JsonFrame>,
    probes: JsonProbes,
    /// Where the map that a pass draws is looked up for a pixel that is wrong.
    #[serde(skip_serializing_if = "Option::is_none")]
    map_lookup: Option<&'a MapLookup>,
    /// What the files compute on their way, line by line, at a few places; only of a wrong answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    own_values: Option<JsonValues<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cross_check: Option<CrossChecked<'a>>,
    environment: &'a Environment,
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    elapsed_ms: Number,
}

/// What the interpreter says of the same vertices.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
struct CrossChecked<'a> {
    opinion: Opinion,
    agreeing: u32,
    undefined: u32,
    unsettled: u32,
    differing: u32,
    message: Option<&'a str>,
    line: Option<u32>,
}

impl<'a> CrossChecked<'a> {
    fn of(checked: &'a CrossCheck, language: Language) -> Self {
        let CrossCheck { opinion, agreeing, undefined, unsettled, differing, ref message, line } = *checked;
        let message = message.as_ref().map(|message| message.get(language));
        Self { opinion, agreeing, undefined, unsettled, differing, message, line }
    }
}

/// The name of the file that a place is in; a report of the first version names it once, above.
fn file_of<'a>(report: &'a Report, file: Option<&'a str>, line: Option<u32>) -> Option<&'a str> {
    file.or_else(|| line.and_then(|_| report.file_of(None)).map(|source| source.name.as_str()))
}

#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = Rubric))]
struct JsonRubricLine<'a> {
    id: &'a str,
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    points: Number,
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    max_points: Number,
    /// What the grading gave, where somebody who teaches gave other points.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    graded_points: Option<Number>,
    mistake: Option<&'a str>,
    message: &'a str,
    label: &'a str,
    file: Option<&'a str>,
    line: Option<u32>,
}

impl<'a> JsonRubricLine<'a> {
    fn of(report: &'a Report, line: &'a RubricLine, language: Language) -> Self {
        Self {
            id: &line.id,
            points: Number(line.points),
            max_points: Number(line.max_points),
            graded_points: line.graded.map(Number),
            mistake: line.mistake.as_deref(),
            message: line.message.get(language),
            label: line.label.get(language),
            file: file_of(report, line.file.as_deref(), line.line),
            line: line.line,
        }
    }
}

#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = Advice))]
struct JsonAdvice<'a> {
    id: &'a str,
    message: &'a str,
    file: &'a str,
    line: Option<u32>,
}

impl<'a> JsonAdvice<'a> {
    fn of(advice: &'a AdviceLine, language: Language) -> Self {
        let AdviceLine { id, message, file, line } = advice;
        Self { id, message: message.get(language), file, line: *line }
    }
}

#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = Message))]
struct JsonMessage<'a> {
    severity: Severity,
    stage: DiagnosticStage,
    file: Option<&'a str>,
    line: Option<u32>,
    column: Option<u32>,
    message: &'a str,
    hint: Option<&'a str>,
}

impl<'a> JsonMessage<'a> {
    fn of(report: &'a Report, diagnostic: &'a Diagnostic, language: Language) -> Self {
        Self {
            severity: diagnostic.severity,
            stage: diagnostic.stage,
            file: file_of(report, diagnostic.file.as_deref(), diagnostic.line),
            line: diagnostic.line,
            column: diagnostic.column,
            message: diagnostic.message.get(language),
            hint: diagnostic.hint.as_ref().map(|hint| hint.get(language)),
        }
    }
}

#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = Frame))]
struct JsonFrame {
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    t: Number,
    coverage_mismatches: u32,
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    max_difference: Number,
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    mean_difference: Number,
    mismatched_pixels: u32,
}

impl JsonFrame {
    fn of(frame: &FrameResult) -> Self {
        Self {
            t: Number(frame.t),
            coverage_mismatches: frame.coverage_mismatches,
            max_difference: Number(frame.max_difference),
            mean_difference: Number(frame.mean_difference),
            mismatched_pixels: frame.mismatched_pixels,
        }
    }
}

#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = Probes))]
struct JsonProbes {
    seed: u64,
    samples: u32,
    mismatched: u32,
    #[cfg_attr(feature = "service", schema(value_type = Option<f64>))]
    max_difference: Option<Number>,
}

impl JsonProbes {
    fn of(probes: &ProbeResult) -> Self {
        Self {
            seed: probes.seed,
            samples: probes.samples,
            mismatched: probes.mismatched,
            max_difference: probes.max_difference.map(Number),
        }
    }
}

#[cfg(test)]
mod tests;
