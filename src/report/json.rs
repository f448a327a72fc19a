//! The report as JSON: the contract `ggrade/report/v1`, in the order in which it is documented.

use super::{Advice, Environment, FrameResult, Hints, ProbeResult, Report, RubricLine, SourceInfo, Verdict};
use crate::cross_check::{CrossCheck, Opinion};
use crate::diagnostic::{Diagnostic, Severity, Stage};
use crate::language::Language;
use serde::{Serialize, Serializer};

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
pub fn view(report: &Report, language: Language) -> View<'_> {
    let view = staff_view(report, language);
    if report.hints > Hints::None {
        return view;
    }
    let rubric = view.rubric.into_iter().map(|line| Rubric { mistake: None, line: None, ..line });
    View { rubric: rubric.collect(), mistakes: &[], ..view }
}

/// The same object with all that a teacher may see.
pub fn staff_view(report: &Report, language: Language) -> View<'_> {
    View {
        schema: SCHEMA,
        assignment: &report.assignment,
        source: &report.source,
        verdict: report.verdict,
        score: Number(report.score),
        max_score: Number(report.max_score),
        rubric: report.rubric.iter().map(|line| Rubric::of(line, language)).collect(),
        mistakes: &report.mistakes,
        advice: report.advice.iter().map(|advice| Remark::of(advice, language)).collect(),
        diagnostics: report.diagnostics.iter().map(|d| Message::of(d, language)).collect(),
        frames: report.frames.iter().map(Frame::of).collect(),
        probes: Probes::of(&report.probes),
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
#[derive(Debug, Serialize, utoipa::ToSchema)]
#[schema(as = Report)]
pub struct View<'a> {
    schema: &'static str,
    assignment: &'a str,
    source: &'a SourceInfo,
    verdict: Verdict,
    #[schema(value_type = Option<f64>)]
    score: Number,
    #[schema(value_type = Option<f64>)]
    max_score: Number,
    rubric: Vec<Rubric<'a>>,
    mistakes: &'a [String],
    advice: Vec<Remark<'a>>,
    diagnostics: Vec<Message<'a>>,
    frames: Vec<Frame>,
    probes: Probes,
    #[serde(skip_serializing_if = "Option::is_none")]
    cross_check: Option<CrossChecked<'a>>,
    environment: &'a Environment,
    #[schema(value_type = Option<f64>)]
    elapsed_ms: Number,
}

/// What the interpreter says of the same vertices.
#[derive(Debug, Serialize, utoipa::ToSchema)]
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

#[derive(Debug, Serialize, utoipa::ToSchema)]
struct Rubric<'a> {
    id: &'a str,
    #[schema(value_type = Option<f64>)]
    points: Number,
    #[schema(value_type = Option<f64>)]
    max_points: Number,
    mistake: Option<&'a str>,
    message: &'a str,
    label: &'a str,
    line: Option<u32>,
}

impl<'a> Rubric<'a> {
    fn of(line: &'a RubricLine, language: Language) -> Self {
        Self {
            id: &line.id,
            points: Number(line.points),
            max_points: Number(line.max_points),
            mistake: line.mistake.as_deref(),
            message: line.message.get(language),
            label: line.label.get(language),
            line: line.line,
        }
    }
}

#[derive(Debug, Serialize, utoipa::ToSchema)]
#[schema(as = Advice)]
struct Remark<'a> {
    id: &'a str,
    message: &'a str,
    file: &'a str,
    line: Option<u32>,
}

impl<'a> Remark<'a> {
    fn of(advice: &'a Advice, language: Language) -> Self {
        let Advice { id, message, file, line } = advice;
        Self { id, message: message.get(language), file, line: *line }
    }
}

#[derive(Debug, Serialize, utoipa::ToSchema)]
struct Message<'a> {
    severity: Severity,
    stage: Stage,
    line: Option<u32>,
    column: Option<u32>,
    message: &'a str,
    hint: Option<&'a str>,
}

impl<'a> Message<'a> {
    fn of(diagnostic: &'a Diagnostic, language: Language) -> Self {
        Self {
            severity: diagnostic.severity,
            stage: diagnostic.stage,
            line: diagnostic.line,
            column: diagnostic.column,
            message: diagnostic.message.get(language),
            hint: diagnostic.hint.as_ref().map(|hint| hint.get(language)),
        }
    }
}

#[derive(Debug, Serialize, utoipa::ToSchema)]
struct Frame {
    #[schema(value_type = Option<f64>)]
    t: Number,
    coverage_mismatches: u32,
    #[schema(value_type = Option<f64>)]
    max_difference: Number,
    #[schema(value_type = Option<f64>)]
    mean_difference: Number,
    mismatched_pixels: u32,
}

impl Frame {
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

#[derive(Debug, Serialize, utoipa::ToSchema)]
struct Probes {
    seed: u64,
    samples: u32,
    mismatched: u32,
    #[schema(value_type = Option<f64>)]
    max_difference: Option<Number>,
}

impl Probes {
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
mod tests {
    use super::*;
    use crate::report::samples;
    use serde_json::{Value, json};

    fn parsed(report: &Report, language: Language) -> Value {
        serde_json::from_str(&render(report, language)).expect("one JSON object")
    }

    fn keys(value: &Value) -> Vec<&str> {
        let object = value.as_object().expect("an object");
        object.keys().map(String::as_str).collect()
    }

    #[test]
    fn fields_stand_in_the_order_of_the_contract() {
        let value = parsed(&samples::wrong(), Language::En);
        let top = "schema assignment source verdict score max_score rubric mistakes advice diagnostics \
                   frames probes environment elapsed_ms";
        assert_eq!(keys(&value), top.split_whitespace().collect::<Vec<_>>());
        assert_eq!(keys(&value["source"]), ["name", "sha256", "bytes", "encoding"]);
        let rubric = ["id", "points", "max_points", "mistake", "message", "label", "line"];
        assert_eq!(keys(&value["rubric"][3]), rubric);
        let diagnostic = ["severity", "stage", "line", "column", "message", "hint"];
        assert_eq!(keys(&value["diagnostics"][0]), diagnostic);
        let frame = "t coverage_mismatches max_difference mean_difference mismatched_pixels";
        assert_eq!(keys(&value["frames"][0]), frame.split_whitespace().collect::<Vec<_>>());
        assert_eq!(keys(&value["probes"]), ["seed", "samples", "mismatched", "max_difference"]);
        assert_eq!(keys(&value["environment"]), ["ggrade", "renderer", "driver"]);
    }

    #[test]
    fn values_are_those_of_the_report() {
        let value = parsed(&samples::wrong(), Language::En);
        assert_eq!(value["schema"], "ggrade/report/v1");
        assert_eq!(value["verdict"], "wrong");
        assert_eq!((&value["score"], &value["max_score"]), (&json!(80), &json!(100)));
        assert_eq!(value["rubric"][3]["mistake"], "specular-half-unnormalized");
        assert_eq!(value["rubric"][0]["mistake"], Value::Null);
        assert_eq!(value["mistakes"], json!(["specular-half-unnormalized"]));
        assert_eq!(value["frames"].as_array().map(Vec::len), Some(25));
        assert_eq!(value["frames"][1]["t"], json!(0.04));
        assert_eq!(value["diagnostics"][0]["severity"], "warning");
        assert_eq!(value["probes"]["seed"], json!(20_240_613));
    }

    #[test]
    fn every_verdict_has_its_word() {
        let words = samples::all().map(|report| parsed(&report, Language::En)["verdict"].clone());
        assert_eq!(words, ["correct", "wrong", "rejected", "stopped"].map(Value::from));
    }

    #[test]
    fn messages_are_in_the_chosen_language() {
        let report = samples::wrong();
        let english = parsed(&report, Language::En);
        let japanese = parsed(&report, Language::Ja);
        assert_eq!(english["rubric"][3]["label"], "Specular");
        assert_eq!(japanese["rubric"][3]["label"], "鏡面反射光");
        assert_eq!(japanese["rubric"][3]["message"], report.rubric[3].message.ja.as_str());
        assert_eq!(japanese["diagnostics"][0]["message"], report.diagnostics[0].message.ja.as_str());
    }

    #[test]
    fn what_is_not_finite_is_null() {
        let mut report = samples::wrong();
        report.frames[0].max_difference = f64::NAN;
        report.frames[0].mean_difference = f64::INFINITY;
        report.probes.max_difference = Some(f64::NEG_INFINITY);
        let value = parsed(&report, Language::En);
        assert_eq!(value["frames"][0]["max_difference"], Value::Null);
        assert_eq!(value["frames"][0]["mean_difference"], Value::Null);
        assert_eq!(value["probes"]["max_difference"], Value::Null);
    }

    #[test]
    fn an_embedded_view_is_the_same_object() {
        let report = samples::rejected();
        let embedded = serde_json::to_value(view(&report, Language::Ja)).expect("a value");
        assert_eq!(embedded, parsed(&report, Language::Ja));
    }
}
