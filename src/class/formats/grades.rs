//! `grades.csv`: the class as a table for spreadsheets, and `grades.json`: the same for programs.
//!
//! The table is UTF-8 with a byte-order mark and CRLF, so that Excel opens it as it is; what could be a formula is text.

use super::plain::cell;
use super::status::summary;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry};
use crate::fault::Fault;
use crate::language::Text;
use crate::report::labels::mistake_title;
use crate::report::{Report, RubricLine};
use csv::{QuoteStyle, Terminator, WriterBuilder};
use serde_json::{Value, json};

const BOM: &[u8] = b"\xef\xbb\xbf";
const BEFORE_RUBRIC: [&str; 6] = ["key", "name", "moodle_id", "verdict", "score", "max_score"];
const AFTER_RUBRIC: [&str; 10] = [
    "mistakes",
    "feedback",
    "shares_with",
    "file",
    "sha256",
    "mistake_titles",
    "late_minutes",
    "late_penalty",
    "total",
    "alike",
];

/// The table: a row a student, in the order of the class. The column names are the same in both languages.
pub fn render(class: &Class) -> Result<Vec<u8>, Fault> {
    let lines = rubric_ids(class);
    let header = BEFORE_RUBRIC.iter().chain(&lines).chain(&AFTER_RUBRIC).map(|name| cell(name));
    let rows = class.entries.iter().map(|entry| row(entry, &lines, class));
    let mut bytes = BOM.to_vec();
    let mut writer =
        WriterBuilder::new().quote_style(QuoteStyle::Necessary).terminator(Terminator::CRLF).from_writer(&mut bytes);
    write(&mut writer, std::iter::once(header.collect()).chain(rows))?;
    drop(writer);
    Ok(bytes)
}

/// The class as JSON: an object a student, in the order of the class, with the columns of the table as its keys.
pub fn json(class: &Class) -> Result<Vec<u8>, Fault> {
    let students: Vec<Value> = class.entries.iter().map(|entry| object(entry, class)).collect();
    let mut json =
        serde_json::to_vec_pretty(&students).map_err(|error| Fault::new(Text::verbatim(error.to_string())))?;
    json.push(b'\n');
    Ok(json)
}

fn object(entry: &ClassEntry, class: &Class) -> Value {
    let (report, student) = (entry.report(), &entry.student);
    let lateness = report.and_then(|report| report.lateness);
    let line = |line: &RubricLine| json!({ "id": line.id, "points": line.points, "max_points": line.max_points, "graded_points": line.graded });
    json!({
        "key": student.key,
        "name": student.name,
        "moodle_id": student.moodle.as_ref().and_then(|moodle| moodle.number),
        "verdict": Standing::of(&entry.outcome).id(),
        "score": report.map(|report| report.score),
        "max_score": report.map(|report| report.max_score),
        "rubric": report.map(|report| report.rubric.iter().map(line).collect::<Vec<_>>()),
        "mistakes": report.map(|report| &report.mistakes),
        "mistake_titles": report.map(|report| titles(report, class).collect::<Vec<_>>()),
        "feedback": summary(entry, class.language),
        "shares_with": entry.shares_with().collect::<Vec<_>>(),
        "alike": entry.alike,
        "file": entry.path(),
        "sha256": report.map(Report::sha256),
        "late_minutes": lateness.map(|lateness| lateness.milliseconds.div_ceil(60_000)),
        "late_penalty": lateness.map(|lateness| lateness.penalty),
        "total": report.map(Report::total),
    })
}

/// Ids of the rubric's lines, in the order in which the reports have them.
fn rubric_ids(class: &Class) -> Vec<&str> {
    let mut ids: Vec<&str> = Vec::new();
    for line in class.entries.iter().filter_map(ClassEntry::report).flat_map(|report| &report.rubric) {
        if !ids.contains(&line.id.as_str()) {
            ids.push(&line.id);
        }
    }
    ids
}

fn row(entry: &ClassEntry, lines: &[&str], class: &Class) -> Vec<String> {
    let report = entry.report();
    let lateness = report.and_then(|report| report.lateness);
    let student = &entry.student;
    let mut row = vec![
        cell(&student.key),
        cell(&student.name),
        student.moodle.as_ref().and_then(|moodle| moodle.number).map(|number| number.to_string()).unwrap_or_default(),
        Standing::of(&entry.outcome).id().to_owned(),
        report.map(|report| exact(report.score)).unwrap_or_default(),
        report.map(|report| exact(report.max_score)).unwrap_or_default(),
    ];
    row.extend(lines.iter().map(|id| {
        let line = report.and_then(|report| report.rubric.iter().find(|line| line.id == *id));
        line.map(|line| exact(line.points)).unwrap_or_default()
    }));
    row.extend([
        report.map(|report| cell(&report.mistakes.join(" "))).unwrap_or_default(),
        cell(&summary(entry, class.language).replace('`', "")),
        cell(&entry.shares_with().collect::<Vec<_>>().join(" ")),
        cell(&entry.path().unwrap_or_default()),
        report.map(|report| cell(&report.sha256())).unwrap_or_default(),
        report.map(|report| cell(&titles(report, class).collect::<Vec<_>>().join(" / "))).unwrap_or_default(),
        lateness.map(|lateness| lateness.milliseconds.div_ceil(60_000).to_string()).unwrap_or_default(),
        lateness.map(|lateness| exact(lateness.penalty)).unwrap_or_default(),
        report.map(|report| exact(report.total())).unwrap_or_default(),
        cell(&entry.alike.iter().map(|it| format!("{} {}%", it.key, it.percent)).collect::<Vec<_>>().join(" / ")),
    ]);
    row
}

/// The mistakes by their titles. A comma stands inside of some; a semicolon cuts a cell in some spreadsheets.
fn titles(report: &Report, class: &Class) -> impl Iterator<Item = String> {
    report.mistakes.iter().map(|id| mistake_title(&class.assignment, id, class.language))
}

/// A number as every spreadsheet of an English or Japanese computer reads it; empty when there is none.
fn exact(value: f64) -> String {
    if value.is_finite() { value.to_string() } else { String::new() }
}

/// Rows into a CSV writer.
pub(super) fn write<W: std::io::Write>(
    writer: &mut csv::Writer<W>,
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<(), Fault> {
    let failed = |error: &dyn std::fmt::Display| {
        Fault::new(Text::new(
            format!("The table of grades could not be written: {error}."),
            format!("成績表を書き出せませんでした（{error}）。"),
        ))
    };
    for row in rows {
        writer.write_record(&row).map_err(|error| failed(&error))?;
    }
    writer.flush().map_err(|error| failed(&error))
}
