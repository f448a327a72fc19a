//! Moodle's offline grading worksheet: the file that Moodle made, with grades and feedback filled in.
//!
//! Only the cells of the columns "Grade" and "Feedback comments" change, and of these only those of students who were
//! graded; every other byte is the one that came in. Filling in the result again changes nothing.

mod columns;
mod points;
mod raw;
#[cfg(test)]
mod tests;

use self::columns::{Columns, participant, says_no};
use self::points::Style;
use self::raw::{Cell, records, written};
use super::comment;
use super::names::{list, note};
use super::plain::one_line;
use crate::batch::class::{Class, Entry, Outcome};
use crate::fault::Fault;
use crate::language::Text;
use encoding_rs::{Encoding, SHIFT_JIS, UTF_8};
use std::collections::{HashMap, HashSet};
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

/// The worksheet with the grades of the class; a fault when it is not such a worksheet.
pub fn fill(class: &Class, worksheet: &[u8]) -> Result<Filled, Fault> {
    let sheet = Sheet::read(worksheet)?;
    let by_number: HashMap<u64, &Entry> =
        class.entries.iter().filter_map(|entry| Some((entry.student.moodle.as_ref()?.number, entry))).collect();
    let mut work = Work { class, sheet: &sheet, edits: Vec::new(), seen: HashSet::new(), left: Left::default() };
    let mut filled = 0;
    for row in &sheet.rows {
        filled += usize::from(work.row(row, &by_number)?);
    }
    let notes = work.notes();
    Ok(Filled { bytes: apply(worksheet, &work.edits), filled, notes })
}

/// A worksheet that was read.
struct Sheet<'a> {
    bytes: &'a [u8],
    encoding: &'static Encoding,
    separator: u8,
    columns: Columns,
    rows: Vec<Vec<Cell>>,
}

impl<'a> Sheet<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, Fault> {
        let encoding = encoding(bytes)?;
        let start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        let separator = separator(bytes, start);
        let mut rows = records(bytes, start, separator).map_err(unclosed)?;
        if rows.is_empty() {
            return Err(unreadable("it is empty", "空のファイルです"));
        }
        let text = |cell: &Cell| decode(encoding, &cell.content(bytes));
        let header: Vec<String> = rows.remove(0).iter().map(text).collect();
        let cells = |column: usize| {
            let cells = rows.iter().filter_map(|row| row.get(column)).map(text);
            cells.filter(|text| !text.trim().is_empty()).collect()
        };
        let columns = Columns::find(&header, cells)?;
        Ok(Self { bytes, encoding, separator, columns, rows })
    }

    fn text(&self, row: &[Cell], column: usize) -> Option<String> {
        row.get(column).map(|cell| decode(self.encoding, &cell.content(self.bytes)))
    }

    /// `text` as bytes of this file; what its encoding does not have becomes a character reference, as HTML takes it.
    fn encode(&self, text: &str) -> Vec<u8> {
        self.encoding.encode(text).0.into_owned()
    }
}

/// New content for a cell.
struct Edit {
    span: Range<usize>,
    cell: Vec<u8>,
}

/// What could not be filled in.
#[derive(Default)]
struct Left<'a> {
    locked: Vec<&'a Entry>,
    faults: Vec<&'a Entry>,
    no_maximum: Vec<&'a Entry>,
    not_graded: Vec<&'a Entry>,
    unknown_rows: Vec<String>,
    bad_rows: Vec<String>,
}

/// The filling in.
struct Work<'a> {
    class: &'a Class,
    sheet: &'a Sheet<'a>,
    edits: Vec<Edit>,
    seen: HashSet<u64>,
    left: Left<'a>,
}

impl<'a> Work<'a> {
    /// Fills in a row; whether a grade is in it now.
    fn row(&mut self, row: &[Cell], by_number: &HashMap<u64, &'a Entry>) -> Result<bool, Fault> {
        let Columns { identifier, can_change, feedback, .. } = self.sheet.columns;
        let Some(name) = self.sheet.text(row, identifier).filter(|name| !name.trim().is_empty()) else {
            return Ok(false);
        };
        let Some(number) = participant(&name) else {
            self.left.bad_rows.push(one_line(&name));
            return Ok(false);
        };
        self.seen.insert(number);
        let Some(&entry) = by_number.get(&number) else {
            self.left.unknown_rows.push(one_line(&name));
            return Ok(false);
        };
        if can_change.and_then(|column| self.sheet.text(row, column)).is_some_and(|cell| says_no(&cell)) {
            self.left.locked.push(entry);
            return Ok(false);
        }
        if matches!(entry.outcome, Outcome::Fault(_)) {
            self.left.faults.push(entry);
            return Ok(false);
        }
        let graded = self.grade(row, entry);
        if let Some(cell) = feedback.and_then(|column| row.get(column)) {
            self.comment(cell, entry);
        }
        Ok(graded)
    }

    fn grade(&mut self, row: &[Cell], entry: &'a Entry) -> bool {
        let Some(report) = entry.report() else {
            self.left.not_graded.push(entry);
            return false;
        };
        let Columns { grade, maximum, .. } = self.sheet.columns;
        let limit = self.sheet.text(row, maximum).unwrap_or_default();
        let (Some(cell), Some(most)) = (row.get(grade), points::read(&limit).filter(|most| *most > 0.0)) else {
            self.left.no_maximum.push(entry);
            return false;
        };
        let share = if report.max_score > 0.0 { (report.score / report.max_score).clamp(0.0, 1.0) } else { 0.0 };
        let new = Style::of(&limit).write(share * most);
        let old = self.sheet.text(row, grade).unwrap_or_default();
        if points::read(&old) != points::read(&new) {
            self.edit(cell, new.as_bytes());
        }
        true
    }

    fn comment(&mut self, cell: &Cell, entry: &Entry) {
        let old = decode(self.sheet.encoding, &cell.content(self.sheet.bytes));
        let new = self.sheet.encode(&comment::merge(&old, &comment::render(entry, self.class)));
        if cell.content(self.sheet.bytes) != new {
            self.edit(cell, &new);
        }
    }

    fn edit(&mut self, cell: &Cell, content: &[u8]) {
        let cell_bytes = written(content, self.sheet.separator, cell.is_quoted);
        self.edits.push(Edit { span: cell.span.clone(), cell: cell_bytes });
    }

    fn notes(&self) -> Vec<Text> {
        let number = |entry: &&Entry| entry.student.moodle.as_ref().map(|moodle| moodle.number);
        let entries: Vec<&Entry> = self.class.entries.iter().collect();
        let without_row: Vec<&Entry> =
            entries.iter().copied().filter(|e| number(e).is_some_and(|n| !self.seen.contains(&n))).collect();
        let without_number: Vec<&Entry> = entries.iter().copied().filter(|e| number(e).is_none()).collect();
        let left = &self.left;
        let feedback = self.sheet.columns.feedback.is_none().then(no_feedback_column);
        let notes = [
            note(&without_row, "Not in the worksheet", "ワークシートに行がありません"),
            note(
                &without_number,
                "No number of Moodle, so not filled into the worksheet",
                "Moodle の番号がないため、ワークシートに記入していません",
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
            feedback,
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

/// UTF-8 as Moodle writes it, or Shift_JIS as Excel in Japan saves it.
fn encoding(bytes: &[u8]) -> Result<&'static Encoding, Fault> {
    let utf_16 = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    if !utf_16 && std::str::from_utf8(bytes).is_ok() {
        return Ok(UTF_8);
    }
    match SHIFT_JIS.decode_without_bom_handling_and_without_replacement(bytes) {
        Some(_) if !utf_16 => Ok(SHIFT_JIS),
        _ => Err(unreadable("it is neither UTF-8 nor Shift_JIS text", "UTF-8 でも Shift_JIS でもありません")),
    }
}

fn decode(encoding: &'static Encoding, bytes: &[u8]) -> String {
    encoding.decode_without_bom_handling(bytes).0.into_owned()
}

/// What separates the header's cells: Moodle writes commas, Excel where the comma is a decimal mark `;`.
fn separator(bytes: &[u8], start: usize) -> u8 {
    let cells = |separator: u8| records(bytes, start, separator).ok().and_then(|rows| rows.first().map(Vec::len));
    *b"\t;,".iter().max_by_key(|separator| cells(**separator)).unwrap_or(&b',')
}

fn unclosed(line: usize) -> Fault {
    unreadable(
        &format!("a quote that opens on line {line} is never closed"),
        &format!("{line} 行目で始まる引用符（\"）が閉じていません"),
    )
}

fn unreadable(en: &str, ja: &str) -> Fault {
    Fault::new(Text::new(
        format!("The worksheet cannot be read: {en}."),
        format!("ワークシートを読み取れません（{ja}）。"),
    ))
    .remedy(Text::new(
        "Download the grading worksheet from Moodle again, or save it as \"CSV UTF-8\".",
        "Moodle から評定ワークシートをもう一度ダウンロードするか、「CSV UTF-8」形式で保存し直してください。",
    ))
}

fn no_feedback_column() -> Text {
    Text::new(
        "The worksheet has no column \"Feedback comments\" (the feedback type is off in Moodle): only grades are filled in.",
        "ワークシートに「フィードバックコメント」の列がないため（Moodle でこのフィードバックタイプが無効）、評定だけを記入しました。",
    )
}
