//! The columns that `nbgrader export` writes, in its order.
//!
//! nbgrader's own exporter quotes nothing; here a cell with a comma or a quote is quoted, so that it stays one cell.

use super::grades::write;
use super::plain::cell;
use crate::batch::class::{Class, Entry, Outcome};
use crate::fault::Fault;
use csv::{Terminator, WriterBuilder};

const COLUMNS: [&str; 11] = [
    "assignment",
    "duedate",
    "timestamp",
    "student_id",
    "last_name",
    "first_name",
    "email",
    "raw_score",
    "late_submission_penalty",
    "score",
    "max_score",
];

/// The table: UTF-8 without a byte-order mark, a row a student.
///
/// A student without a file has 0.0, as in nbgrader. Where a file is there and could not be graded, the scores are
/// empty: a teacher decides. Which part of a name is the family name is not known, so the whole is in `last_name`.
pub fn render(class: &Class) -> Result<Vec<u8>, Fault> {
    let max_score = class.entries.iter().find_map(Entry::report).map(|report| report.max_score);
    let header = COLUMNS.map(str::to_owned).to_vec();
    let rows = class.entries.iter().map(|entry| row(entry, &class.assignment.id, max_score));
    let mut bytes = Vec::new();
    let mut writer = WriterBuilder::new().terminator(Terminator::Any(b'\n')).from_writer(&mut bytes);
    write(&mut writer, std::iter::once(header).chain(rows))?;
    drop(writer);
    Ok(bytes)
}

fn row(entry: &Entry, assignment: &str, max_score: Option<f64>) -> Vec<String> {
    let score = match &entry.outcome {
        Outcome::Graded(report) => Some(report.score),
        Outcome::NotGraded(_) if entry.places.is_empty() => Some(0.0),
        Outcome::NotGraded(_) | Outcome::Fault(_) => None,
    };
    let penalty = entry.report().and_then(|report| report.lateness).map_or(0.0, |lateness| lateness.penalty);
    let total = score.map(|score| score - penalty);
    let max_score = float(entry.report().map(|report| report.max_score).or(max_score));
    vec![
        cell(assignment),
        String::new(),
        String::new(),
        cell(&entry.student.key),
        cell(&entry.student.name),
        String::new(),
        String::new(),
        float(score),
        float(score.map(|_| penalty)),
        float(total),
        max_score,
    ]
}

/// A number as Python writes a float: `80.0`.
fn float(value: Option<f64>) -> String {
    value.filter(|value| value.is_finite()).map(|value| format!("{value:?}")).unwrap_or_default()
}
