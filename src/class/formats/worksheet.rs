//! Moodle's offline grading worksheet: the file that Moodle made, with grades and feedback filled in.
//!
//! Only the cells of the columns "Grade" and "Feedback comments" change, and of these only those of students who were
//! graded; every other byte is the one that came in. Filling in the result again changes nothing.

mod columns;
mod matching;
mod points;
mod raw;
mod sheet;
#[cfg(test)]
mod tests;

use self::columns::{WorksheetColumns, says_no};
use self::matching::{BLIND, Match, Matching};
use self::points::Style;
use self::raw::{CsvCell, written};
use self::sheet::{Worksheet, WorksheetPerson};
use super::comment;
use super::feedback::{self, Recipient};
use super::names::{list, note};
use super::plain::one_line;
use crate::class::{Class, ClassEntry, Outcome};
use crate::fault::Fault;
use crate::intake::Participant;
use crate::language::Text;
use std::collections::{BTreeSet, HashSet};
use std::ops::Range;

/// A worksheet that is filled in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Filled {
    /// The file.
    pub bytes: Vec<u8>,
    /// Rows of students who were graded.
    pub filled: usize,
    /// What a teacher should know: rows and students without a partner, locked grades.
    pub notes: Vec<Text>,
}

/// Whether this is a worksheet that can be filled in; a fault that says why not.
pub fn check(worksheet: &[u8]) -> Result<(), Fault> {
    Worksheet::read(worksheet).map(drop)
}

/// The worksheet with the grades of the class; a fault when it is not such a worksheet.
pub fn fill(class: &Class, worksheet: &[u8]) -> Result<Filled, Fault> {
    let sheet = Worksheet::read(worksheet)?;
    let matching = Matching::new(class, &sheet);
    let mut work =
        Work { class, sheet: &sheet, matching, edits: Vec::new(), seen: HashSet::new(), left: UnfilledRows::default() };
    let filled = sheet.rows.iter().filter(|row| work.row(row)).count();
    let notes = work.notes();
    Ok(Filled { bytes: apply(worksheet, &work.edits), filled, notes })
}

/// Whom each student's report goes to: the student, or every member of the group.
pub fn recipients<'a>(class: &'a Class, worksheet: &[u8]) -> Result<Vec<Recipient<'a>>, Fault> {
    let sheet = Worksheet::read(worksheet)?;
    let matching = Matching::new(class, &sheet);
    if sheet.columns.group.is_none() {
        return Ok(feedback::by_number(class).into_iter().filter(|one| matching.is_only(one)).collect());
    }
    let recipient = |row: &Vec<CsvCell>| {
        let person = sheet.person(row)?.ok()?;
        let Match::Of(entry) = matching.of(&person) else { return None };
        Some(Recipient { entry, name: person.name.unwrap_or(person.identifier), number: person.number })
    };
    Ok(sheet.rows.iter().filter_map(recipient).collect())
}

/// Somebody whom a worksheet lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedParticipant {
    /// The full name, or what Moodle puts for it, with what the university knows them by beside it.
    pub known_as: String,
    /// How a download would name them where they hand in alone.
    pub participant: Participant,
}

/// Whom a worksheet lists.
pub fn listed(worksheet: &[u8]) -> Result<Vec<ListedParticipant>, Fault> {
    let sheet = Worksheet::read(worksheet)?;
    let one = |row: &Vec<CsvCell>| {
        let WorksheetPerson { number, name, group, .. } = sheet.person(row)?.ok()?;
        let numbers = sheet.columns.numbers.iter().flatten().filter_map(|column| sheet.text(row, *column));
        let name = name.unwrap_or_else(|| BLIND[0].to_owned());
        let known_as = numbers.fold(name.clone(), |so_far, number| format!("{so_far} {number}"));
        let name = group.map_or(name.clone(), |group| format!("{group}-{name}"));
        Some(ListedParticipant { known_as, participant: Participant { name, number: Some(number) } })
    };
    Ok(sheet.rows.iter().filter_map(one).collect())
}

/// New content for a cell.
struct Edit {
    span: Range<usize>,
    cell: Vec<u8>,
}

/// What could not be filled in.
#[derive(Default)]
struct UnfilledRows<'a> {
    locked: Vec<&'a ClassEntry>,
    faults: Vec<&'a ClassEntry>,
    no_maximum: Vec<&'a ClassEntry>,
    not_graded: Vec<&'a ClassEntry>,
    ambiguous: BTreeSet<String>,
    unknown_rows: Vec<String>,
    bad_rows: Vec<String>,
    guessed_ends: Vec<&'a ClassEntry>,
}

/// The filling in.
struct Work<'a> {
    class: &'a Class,
    sheet: &'a Worksheet<'a>,
    matching: Matching<'a>,
    edits: Vec<Edit>,
    /// Keys of the students whose row was found.
    seen: HashSet<&'a str>,
    left: UnfilledRows<'a>,
}

impl<'a> Work<'a> {
    /// Fills in a row; whether a grade is in it now.
    fn row(&mut self, row: &[CsvCell]) -> bool {
        let person = match self.sheet.person(row) {
            None => return false,
            Some(Ok(person)) => person,
            Some(Err(identifier)) => {
                self.left.bad_rows.push(one_line(&identifier));
                return false;
            }
        };
        let entry = match self.matching.of(&person) {
            Match::Of(entry) => entry,
            Match::Several(entries) => {
                self.seen.extend(entries.iter().map(|entry| entry.student.key.as_str()));
                self.left.ambiguous.insert(one_line(person.group.as_ref().unwrap_or(&person.identifier)));
                return false;
            }
            Match::Nobody => {
                self.left.unknown_rows.push(label(&person));
                return false;
            }
        };
        self.seen.insert(&entry.student.key);
        let WorksheetColumns { can_change, feedback, .. } = self.sheet.columns;
        if can_change.and_then(|column| self.sheet.text(row, column)).is_some_and(|cell| says_no(&cell)) {
            self.left.locked.push(entry);
            return false;
        }
        if matches!(entry.outcome, Outcome::Fault(_)) {
            self.left.faults.push(entry);
            return false;
        }
        let graded = self.grade(row, entry);
        if let Some(cell) = feedback.and_then(|column| row.get(column)) {
            self.comment(cell, entry);
        }
        graded
    }

    fn grade(&mut self, row: &[CsvCell], entry: &'a ClassEntry) -> bool {
        let Some(report) = entry.report() else {
            self.left.not_graded.push(entry);
            return false;
        };
        let WorksheetColumns { grade, maximum, .. } = self.sheet.columns;
        let limit = self.sheet.text(row, maximum).unwrap_or_default();
        let (Some(cell), Some(most)) = (row.get(grade), points::read(&limit).filter(|most| *most > 0.0)) else {
            self.left.no_maximum.push(entry);
            return false;
        };
        let share = if report.max_score > 0.0 { (report.total() / report.max_score).clamp(0.0, 1.0) } else { 0.0 };
        let new = Style::of(&limit).write(share * most);
        let old = self.sheet.text(row, grade).unwrap_or_default();
        if points::read(&old) != points::read(&new) {
            self.edit(cell, new.as_bytes());
        }
        true
    }

    fn comment(&mut self, cell: &CsvCell, entry: &'a ClassEntry) {
        let old = self.sheet.decode(cell);
        let merged = comment::merge(&old, entry, self.class);
        if merged.is_end_guessed {
            self.left.guessed_ends.push(entry);
        }
        let new = self.sheet.encode(&merged.html);
        if cell.content(self.sheet.bytes) != new {
            self.edit(cell, &new);
        }
    }

    fn edit(&mut self, cell: &CsvCell, content: &[u8]) {
        let cell_bytes = written(content, self.sheet.separator, cell.is_quoted);
        self.edits.push(Edit { span: cell.span.clone(), cell: cell_bytes });
    }

    fn notes(&self) -> Vec<Text> {
        let is_moodles = |entry: &&ClassEntry| entry.student.moodle.is_some();
        let (moodles, others): (Vec<&ClassEntry>, Vec<&ClassEntry>) = self.class.entries.iter().partition(is_moodles);
        let without_row: Vec<&ClassEntry> =
            moodles.into_iter().filter(|entry| !self.seen.contains(entry.student.key.as_str())).collect();
        let left = &self.left;
        let feedback = self.sheet.columns.feedback.is_none().then(no_feedback_column);
        let notes = [
            note(&without_row, "Not in the worksheet", "ワークシートに行がありません"),
            note(
                &others,
                "No number of Moodle, so not filled into the worksheet",
                "Moodle の番号がないため、ワークシートに記入していません",
            ),
            list(
                left.ambiguous.iter().cloned().collect(),
                "Several submissions or groups go by this name or number, so that none of them is filled in",
                "同じ名前または番号の提出やグループが複数あり、区別できないため記入していません",
            ),
            list(
                left.unknown_rows.clone(),
                "In the worksheet without a submission in the class, left as they are",
                "ワークシートにありますが提出がないため、行をそのまま残しました",
            ),
            note(
                &left.locked,
                "Moodle says that these grades cannot be changed, left as they are",
                "Moodle で評定の変更が許可されていないため、行をそのまま残しました",
            ),
            note(&left.faults, "Grading failed, rows left as they are", "採点に失敗したため、行をそのまま残しました"),
            note(
                &left.not_graded,
                "Nothing to grade, only the comment is filled in",
                "採点の対象がないため、コメントだけを記入しました",
            ),
            note(
                &left.no_maximum,
                "The row has no maximum grade, so no grade is filled in",
                "行に最大評定がないため、評定を記入していません",
            ),
            list(
                left.bad_rows.clone(),
                "Rows without a participant's number, left as they are",
                "参加者の番号が読み取れないため、行をそのまま残しました",
            ),
            note(
                &left.guessed_ends,
                "A comment of ggrade 0.1.0 was replaced up to the end of its paragraph: look whether words of yours stood \
                 right behind it",
                "ggrade 0.1.0 のコメントを段落の終わりまで置き換えました。直後に書き加えた文がなかったか確認してください",
            ),
            feedback,
            self.matching.is_of_other_kind.then(no_group_column),
        ];
        notes.into_iter().flatten().collect()
    }
}

fn apply(bytes: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut edits: Vec<&Edit> = edits.iter().collect();
    edits.sort_by_key(|edit| edit.span.start);
    let mut out = Vec::with_capacity(bytes.len() + edits.iter().map(|edit| edit.cell.len()).sum::<usize>());
    let mut at = 0;
    for edit in edits {
        out.extend_from_slice(&bytes[at..edit.span.start]);
        out.extend_from_slice(&edit.cell);
        at = edit.span.end;
    }
    out.extend_from_slice(&bytes[at..]);
    out
}

/// A row as a teacher finds it again.
fn label(person: &WorksheetPerson) -> String {
    let group = person.group.as_ref().filter(|group| !group.is_empty());
    let group = group.map(|group| format!(" ({group})")).unwrap_or_default();
    one_line(&format!("{}{group}", person.identifier))
}

fn no_group_column() -> Text {
    Text::new(
        "The archive is of an assignment in which groups hand in, and the worksheet has no column \"Group\": it is of \
         another assignment, and nothing is filled in.",
        "アーカイブはグループで提出する課題のものですが、ワークシートに「グループ」の列がありません。別の課題の\
         ワークシートなので、何も記入していません。",
    )
}

fn no_feedback_column() -> Text {
    Text::new(
        "The worksheet has no column \"Feedback comments\" (the feedback type is off in Moodle): only grades are filled in.",
        "ワークシートに「フィードバックコメント」の列がないため（Moodle でこのフィードバックタイプが無効）、評定だけを記入しました。",
    )
}
