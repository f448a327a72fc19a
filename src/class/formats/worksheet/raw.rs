//! A CSV file as the bytes that it is: where each cell stands, so that one can change and all others stay.

use std::ops::Range;

/// Where a cell stands in the file, its quotes included, the separator not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CsvCell {
    pub span: Range<usize>,
    pub is_quoted: bool,
}

impl CsvCell {
    /// Its bytes without the quotes around it, doubled quotes undone.
    pub fn content(&self, bytes: &[u8]) -> Vec<u8> {
        let raw = &bytes[self.span.clone()];
        if !self.is_quoted {
            return raw.to_vec();
        }
        let mut content = Vec::with_capacity(raw.len());
        let mut inside = true;
        let mut rest = raw[1..].iter().copied().peekable();
        while let Some(byte) = rest.next() {
            match byte {
                b'"' if inside && rest.peek() == Some(&b'"') => content.extend(rest.next()),
                b'"' if inside => inside = false,
                byte => content.push(byte),
            }
        }
        content
    }
}

/// The records of a file from `start` on. A record ends at LF, CRLF or CR outside quotes.
///
/// All bytes that matter are below 0x40, which no second byte of Shift_JIS and no part of a UTF-8 sequence is, so this
/// needs no encoding. The error is the line, from 1, of a quote that is never closed.
pub(super) fn records(bytes: &[u8], start: usize, separator: u8) -> Result<Vec<Vec<CsvCell>>, usize> {
    let mut records = Vec::new();
    let mut record = Vec::new();
    let mut at = start;
    while at < bytes.len() {
        let cell = cell(bytes, at, separator)?;
        at = cell.span.end;
        record.push(cell);
        match bytes.get(at) {
            Some(&byte) if byte == separator => {
                at += 1;
                if at == bytes.len() {
                    record.push(CsvCell { span: at..at, is_quoted: false });
                }
            }
            Some(b'\r') if bytes.get(at + 1) == Some(&b'\n') => {
                at += 2;
                records.push(std::mem::take(&mut record));
            }
            Some(_) => {
                at += 1;
                records.push(std::mem::take(&mut record));
            }
            None => {}
        }
    }
    if !record.is_empty() {
        records.push(record);
    }
    Ok(records)
}

fn cell(bytes: &[u8], start: usize, separator: u8) -> Result<CsvCell, usize> {
    let is_quoted = bytes[start] == b'"';
    let mut at = start + usize::from(is_quoted);
    let mut inside = is_quoted;
    while at < bytes.len() {
        match bytes[at] {
            b'"' if inside && bytes.get(at + 1) == Some(&b'"') => at += 1,
            b'"' if inside => inside = false,
            b'\r' | b'\n' if !inside => break,
            byte if byte == separator && !inside => break,
            _ => {}
        }
        at += 1;
    }
    if inside { Err(line_of(bytes, start)) } else { Ok(CsvCell { span: start..at, is_quoted }) }
}

/// The line, from 1, in which a byte stands.
pub(super) fn line_of(bytes: &[u8], at: usize) -> usize {
    1 + bytes[..at].iter().filter(|byte| **byte == b'\n').count()
}

/// `content` as a cell: quoted when it must be, or when the cell that it replaces is.
pub(super) fn written(content: &[u8], separator: u8, was_quoted: bool) -> Vec<u8> {
    let must = content.iter().any(|byte| matches!(byte, b'"' | b'\r' | b'\n' | b' ' | b'\t') || *byte == separator);
    if !must && !was_quoted {
        return content.to_vec();
    }
    let mut cell = vec![b'"'];
    for &byte in content {
        cell.push(byte);
        if byte == b'"' {
            cell.push(byte);
        }
    }
    cell.push(b'"');
    cell
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contents(text: &str, separator: u8) -> Vec<Vec<String>> {
        let bytes = text.as_bytes();
        let text = |cell: &CsvCell| String::from_utf8(cell.content(bytes)).expect("UTF-8");
        records(bytes, 0, separator).expect("records").iter().map(|record| record.iter().map(text).collect()).collect()
    }

    #[test]
    fn cells_are_cut_as_rfc_4180_says() {
        assert_eq!(contents("a,\"b,\"\"c\"\"\nd\",\r\ne", b','), [vec!["a", "b,\"c\"\nd", ""], vec!["e"]]);
        assert_eq!(contents("a;b\rc,d;", b';'), [vec!["a", "b"], vec!["c,d", ""]]);
        assert_eq!(contents("\n\nx\n", b','), [vec![""], vec![""], vec!["x"]]);
        assert_eq!(contents("a\"b,\"c\"d\n", b','), [vec!["a\"b", "cd"]]);
    }

    #[test]
    fn spans_and_what_stands_between_them_are_the_whole_file() {
        let bytes = b"\"a\",b,\r\n\r\n\"c\nd\",,e\r";
        let cells: Vec<CsvCell> = records(bytes, 0, b',').expect("records").concat();
        let between: Vec<u8> = (0..bytes.len())
            .filter(|at| !cells.iter().any(|cell| cell.span.contains(at)))
            .map(|at| bytes[at])
            .collect();
        assert_eq!(between, b",,\r\n\r\n,,\r");
    }

    #[test]
    fn an_open_quote_is_found_at_its_line() {
        assert_eq!(records(b"a,b\nc,\"d\ne\n", 0, b','), Err(2));
    }

    #[test]
    fn a_cell_is_quoted_as_the_one_it_replaces_or_when_it_must_be() {
        assert_eq!(written(b"80.00", b',', false), b"80.00");
        assert_eq!(written(b"80,00", b',', false), b"\"80,00\"");
        assert_eq!(written(b"80,00", b';', false), b"80,00");
        assert_eq!(written(b"80.00", b',', true), b"\"80.00\"");
        assert_eq!(written(b"a\"b", b',', false), b"\"a\"\"b\"");
    }
}
