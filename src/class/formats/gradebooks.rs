//! Tables in the columns of other gradebooks: nbgrader's export, Canvas's import, Gradescope's export.
//!
//! UTF-8 without a byte-order mark, a row a student, LF. A cell with a comma or a quote is quoted, so that it stays one
//! cell (nbgrader's own exporter quotes nothing); what could be a formula is text.

use super::grades::write;
use super::plain::cell;
use crate::class::{Class, ClassEntry, Outcome};
use crate::fault::Fault;
use csv::{Terminator, WriterBuilder};

const NBGRADER: [&str; 11] = [
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

/// What Canvas knows of a student. Its importer finds one by `ID`, else by `SIS User ID`, else by `SIS Login ID`, else by
/// the name (`lib/gradebook_importer.rb` of canvas-lms).
const CANVAS: [&str; 5] = ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"];

const GRADESCOPE: [&str; 9] = [
    "Name",
    "SID",
    "Email",
    "Total Score",
    "Max Points",
    "Status",
    "Submission ID",
    "Submission Time",
    "Lateness (H:M:S)",
];

/// What a student's hand-in comes to, in points.
#[derive(Clone, Copy, Debug, Default)]
struct StudentPoints {
    score: Option<f64>,
    penalty: f64,
}

impl StudentPoints {
    fn of(entry: &ClassEntry) -> Self {
        let report = entry.report();
        let penalty = report.and_then(|report| report.lateness).map_or(0.0, |lateness| lateness.penalty);
        Self { score: report.map(|report| report.score), penalty }
    }

    fn total(self) -> Option<f64> {
        self.score.map(|score| score - self.penalty)
    }
}

/// `nbgrader export`.
///
/// A student without a file has 0.0, as in nbgrader. Where a file is there and could not be graded, the scores are
/// empty: a teacher decides. Which part of a name is the family name is not known, so the whole is in `last_name`.
pub fn nbgrader(class: &Class) -> Result<Vec<u8>, Fault> {
    let row = |entry: &ClassEntry| {
        let points = match is_missing(entry) {
            true => StudentPoints { score: Some(0.0), penalty: 0.0 },
            false => StudentPoints::of(entry),
        };
        let start = [class.assignment.id.as_str(), "", "", &entry.student.key, &entry.student.name, ""].map(cell);
        let numbers = [points.score, points.score.map(|_| points.penalty), points.total(), max_points(entry, class)];
        start.into_iter().chain([email(entry)]).chain(numbers.map(float)).collect()
    };
    table(NBGRADER.map(str::to_owned).into(), class.entries.iter().map(row))
}

/// What Canvas takes at *Grades* > *Import*: the points as they count.
///
/// The last column has the homework's title in the language of the course; a grade goes into the assignment of that
/// title. What was not graded is empty, which Canvas takes for no grade.
pub fn canvas(class: &Class) -> Result<Vec<u8>, Fault> {
    let title = cell(class.language.of(&class.assignment.title));
    let header = CANVAS.iter().map(|name| (*name).to_owned()).chain([title]).collect();
    let most = class.entries.iter().find_map(|entry| max_points(entry, class));
    // Four blanks stand before these words in Canvas's own export.
    let points = ["    Points Possible", "", "", "", ""].map(str::to_owned).into_iter().chain([float(most)]).collect();
    let row = |entry: &ClassEntry| {
        let student = &entry.student;
        let who = [student.name.as_str(), "", &student.key, &student.key, ""].map(cell);
        who.into_iter().chain([float(StudentPoints::of(entry).total())]).collect()
    };
    table(header, std::iter::once(points).chain(class.entries.iter().map(row)))
}

/// What Gradescope's *Download grades* gives, for tools that read it. A mail address is there where the roster
/// has one; ids of Gradescope's are not known and empty.
pub fn gradescope(class: &Class) -> Result<Vec<u8>, Fault> {
    let row = |entry: &ClassEntry| {
        let status = match &entry.outcome {
            Outcome::Graded(_) => "Graded",
            _ if is_missing(entry) => "Missing",
            Outcome::NotGraded(_) | Outcome::Fault(_) => "Ungraded",
        };
        let most = max_points(entry, class).filter(|_| !is_missing(entry));
        let lateness = entry.report().map(|report| report.lateness.map_or(0, |lateness| lateness.milliseconds));
        vec![
            cell(&entry.student.name),
            cell(&entry.student.key),
            email(entry),
            float(StudentPoints::of(entry).total()),
            float(most),
            status.to_owned(),
            String::new(),
            String::new(),
            lateness.map(clock).unwrap_or_default(),
        ]
    };
    table(GRADESCOPE.map(str::to_owned).into(), class.entries.iter().map(row))
}

fn table(header: Vec<String>, rows: impl Iterator<Item = Vec<String>>) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    let mut writer = WriterBuilder::new().terminator(Terminator::Any(b'\n')).from_writer(&mut bytes);
    write(&mut writer, std::iter::once(header).chain(rows))?;
    drop(writer);
    Ok(bytes)
}

/// Their mail address, as far as it is known.
fn email(entry: &ClassEntry) -> String {
    cell(entry.student.email.as_deref().unwrap_or_default())
}

/// Whether nothing was handed in.
fn is_missing(entry: &ClassEntry) -> bool {
    matches!(entry.outcome, Outcome::NotGraded(_)) && entry.places.is_empty()
}

/// The most that the homework gives; `None` where nobody's was graded.
fn max_points(entry: &ClassEntry, class: &Class) -> Option<f64> {
    let of_class = || class.entries.iter().find_map(ClassEntry::report);
    entry.report().or_else(of_class).map(|report| report.max_score)
}

/// A number as Python writes a float: `80.0`.
fn float(value: Option<f64>) -> String {
    value.filter(|value| value.is_finite()).map(|value| format!("{value:?}")).unwrap_or_default()
}

/// A time as `H:MM:SS`.
fn clock(milliseconds: u64) -> String {
    let seconds = milliseconds / 1000;
    format!("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60)
}
