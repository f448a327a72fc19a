//! The file that Moodle made, read.

use super::columns::{WorksheetColumns, participant};
use super::raw::{CsvCell, records};
use crate::fault::Fault;
use crate::language::Text;
use encoding_rs::{Encoding, SHIFT_JIS, UTF_8};

/// Whom a row is of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct WorksheetPerson {
    /// `Participant 1234`.
    pub identifier: String,
    pub number: u64,
    /// The full name; none under blind marking.
    pub name: Option<String>,
    /// The group, where groups hand in.
    pub group: Option<String>,
}

/// A worksheet that was read.
pub(super) struct Worksheet<'a> {
    pub bytes: &'a [u8],
    encoding: &'static Encoding,
    pub separator: u8,
    pub columns: WorksheetColumns,
    pub rows: Vec<Vec<CsvCell>>,
}

impl<'a> Worksheet<'a> {
    /// Reads a file, and finds its columns.
    pub fn read(bytes: &'a [u8]) -> Result<Self, Fault> {
        let encoding = encoding(bytes)?;
        let start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        let separator = separator(bytes, start);
        let mut rows = records(bytes, start, separator).map_err(unclosed)?;
        if rows.is_empty() {
            return Err(unreadable("it is empty", "空のファイルです"));
        }
        let text = |cell: &CsvCell| decode(encoding, &cell.content(bytes));
        let header: Vec<String> = rows.remove(0).iter().map(text).collect();
        let cells = |column: usize| {
            let cells = rows.iter().filter_map(|row| row.get(column)).map(text);
            cells.filter(|text| !text.trim().is_empty()).collect()
        };
        let columns = WorksheetColumns::find(&header, cells)?;
        Ok(Self { bytes, encoding, separator, columns, rows })
    }

    /// The content of the cell in a column of a row.
    pub fn text(&self, row: &[CsvCell], column: usize) -> Option<String> {
        row.get(column).map(|cell| self.decode(cell))
    }

    /// The content of a cell.
    pub fn decode(&self, cell: &CsvCell) -> String {
        decode(self.encoding, &cell.content(self.bytes))
    }

    /// Who the row is of; the error is the identifier that has no number. `None` for a row without one.
    pub fn person(&self, row: &[CsvCell]) -> Option<Result<WorksheetPerson, String>> {
        let text = |column: Option<usize>| self.text(row, column?).map(|text| text.trim().to_owned());
        let identifier = text(Some(self.columns.identifier)).filter(|identifier| !identifier.is_empty())?;
        let Some(number) = participant(&identifier) else { return Some(Err(identifier)) };
        let (name, group) = (text(self.columns.full_name), text(self.columns.group));
        Some(Ok(WorksheetPerson { identifier, number, name, group }))
    }

    /// `text` as bytes of this file; what its encoding does not have becomes a character reference, as HTML takes it.
    pub fn encode(&self, text: &str) -> Vec<u8> {
        self.encoding.encode(text).0.into_owned()
    }
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
