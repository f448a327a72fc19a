//! Places in a file as SARIF counts them: columns in UTF-16 code units, the end behind the last one.

use serde_json::{Value, json};

/// The lines of a file.
pub(super) struct FileLines<'a>(Vec<&'a str>);

impl<'a> FileLines<'a> {
    /// Of a text whose lines end in `\r\n`, `\n` or `\r`.
    pub fn of(text: &'a str) -> Self {
        let mut lines = Vec::new();
        let mut rest = text;
        while !rest.is_empty() {
            let end = rest.find(['\n', '\r']).unwrap_or(rest.len());
            lines.push(&rest[..end]);
            let line_end = if rest[end..].starts_with("\r\n") { 2 } else { 1 };
            rest = rest.get(end + line_end..).unwrap_or_default();
        }
        Self(lines)
    }

    /// Line `number`, from 1; empty where there is no such line.
    pub fn text(&self, number: u32) -> &'a str {
        (number as usize).checked_sub(1).and_then(|index| self.0.get(index)).copied().unwrap_or_default()
    }

    /// A whole line; `None` for the line 0, which does not exist.
    pub fn whole(&self, line: u32) -> Option<Value> {
        (line > 0).then(|| json!({ "startLine": line }))
    }

    /// `length` characters (at least one) of a line from the character `column` on, from 1.
    ///
    /// A place behind the end of the line, where a compiler misses something, is one of no width at its end.
    pub fn span(&self, line: u32, column: u32, length: u32) -> Option<Value> {
        if line == 0 || column == 0 {
            return self.whole(line);
        }
        let text = self.text(line);
        let start = units(text, column - 1);
        let end = units(text, (column - 1).saturating_add(length.max(1)));
        Some(json!({ "startLine": line, "startColumn": start + 1, "endLine": line, "endColumn": end + 1 }))
    }
}

/// UTF-16 code units of the first `characters` characters.
fn units(text: &str, characters: u32) -> usize {
    text.chars().take(characters as usize).map(char::len_utf16).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_utf_16_code_units() {
        // 😀 (U+1F600) is one character and two code units; 式 is one of each.
        let lines = FileLines::of("a\n式😀 Max(x)\n");
        // `Max`: characters 4 to 6, units 5 to 7, so it ends before unit 8.
        let expected = json!({ "startLine": 2, "startColumn": 5, "endLine": 2, "endColumn": 8 });
        assert_eq!(lines.span(2, 4, 3), Some(expected));
    }

    #[test]
    fn a_place_behind_the_line_has_no_width() {
        let lines = FileLines::of("ab");
        let end = json!({ "startLine": 1, "startColumn": 3, "endLine": 1, "endColumn": 3 });
        assert_eq!(lines.span(1, 3, 1), Some(end.clone()));
        assert_eq!(lines.span(1, 99, u32::MAX), Some(end));
        assert_eq!(lines.span(7, 2, 1).unwrap()["startLine"], 7);
        assert_eq!(lines.span(0, 1, 1), None);
        assert_eq!(lines.span(1, 0, 1), lines.whole(1));
    }

    #[test]
    fn every_line_end_ends_one_line() {
        assert_eq!(FileLines::of("a\r\nb\rc\n\nd").0, ["a", "b", "c", "", "d"]);
        assert!(FileLines::of("").0.is_empty());
    }
}
