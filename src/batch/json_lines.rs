//! One JSON object for each finished entry, for programs that follow a run.

use crate::class::standing::Standing;
use crate::class::{AlikeStudent, ClassEntry, Outcome};
use crate::intake::Student;
use crate::language::Language;
use crate::report::json;
use serde::Serialize;

/// Name and version of the format.
pub const SCHEMA: &str = "ggrade/entry/v1";

#[derive(Serialize)]
struct JsonLine<'a> {
    schema: &'static str,
    student: &'a Student,
    path: Option<String>,
    /// The contract's verdicts, and `not-graded` and `fault`.
    standing: Standing,
    /// Why there is no report.
    message: Option<&'a str>,
    shares_with: Vec<&'a str>,
    alike: &'a [AlikeStudent],
    report: Option<json::JsonReport<'a>>,
}

/// The entry on one line, with a line feed at its end.
pub fn line(entry: &ClassEntry, language: Language) -> String {
    let message = match &entry.outcome {
        Outcome::Graded(_) => None,
        Outcome::NotGraded(why) => Some(why.get(language)),
        Outcome::Fault(fault) => Some(fault.message.get(language)),
    };
    let line = JsonLine {
        schema: SCHEMA,
        student: &entry.student,
        path: entry.path(),
        standing: Standing::of(&entry.outcome),
        message,
        shares_with: entry.shares_with().collect(),
        alike: &entry.alike,
        report: entry.report().map(|report| json::staff_view(report, language)),
    };
    // Strings, numbers and unit enums under constant keys: there is nothing that could fail.
    let mut line = serde_json::to_string(&line).unwrap_or_default();
    line.push('\n');
    line
}
