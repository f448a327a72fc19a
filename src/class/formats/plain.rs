//! Text that a student wrote, made harmless for the reader that it goes to.

use crate::source::lookalikes::reorders;

/// Control characters and the invisible characters that turn the direction of the text around them become `U+FFFD`;
/// line ends and tabs become spaces.
pub(super) fn one_line(text: &str) -> String {
    let clean = |c: char| match c {
        '\n' | '\r' | '\t' => ' ',
        c if c.is_control() || reorders(c) => char::REPLACEMENT_CHARACTER,
        c => c,
    };
    text.replace("\r\n", "\n").chars().map(clean).collect()
}

/// What a spreadsheet reads as the beginning of a formula, in half and full width.
const FORMULA: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];

/// The text as a cell that no spreadsheet reads as a formula: an apostrophe before what would begin one.
///
/// A formula can begin the cell, blank and invisible characters aside, and also follow a `;`: where that is the list
/// separator, Excel cuts there whatever the quotes say.
pub(crate) fn cell(text: &str) -> String {
    let text = one_line(text);
    let mut safe = String::with_capacity(text.len() + 1);
    let mut at_start = true;
    for c in text.chars() {
        if at_start && FORMULA.contains(&c) {
            safe.push('\'');
        }
        at_start = c == ';' || (at_start && is_blank(c));
        safe.push(c);
    }
    safe
}

fn is_blank(c: char) -> bool {
    c.is_whitespace() || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{feff}' | '"' | '\u{fffd}')
}

/// The text inside an HTML element or a quoted attribute, without quotes and backslashes, which the readers of CSV
/// files take in different ways.
pub(super) fn html(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in one_line(text).chars() {
        match entity(c) {
            Some(named) => out.push_str(named),
            None if c == '\\' => out.push_str("&#92;"),
            None => out.push(c),
        }
    }
    out
}

/// What stands for a character that HTML does not take as itself, in an element and in a quoted attribute.
pub(super) const fn entity(c: char) -> Option<&'static str> {
    match c {
        '&' => Some("&amp;"),
        '<' => Some("&lt;"),
        '>' => Some("&gt;"),
        '"' => Some("&quot;"),
        '\'' => Some("&#39;"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_cell_begins_a_formula() {
        for (text, expected) in [
            ("=cmd|' /C calc'!A0", "'=cmd|' /C calc'!A0"),
            ("+81 3", "'+81 3"),
            ("-1", "'-1"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("\t=1", " '=1"),
            ("\r=1", " '=1"),
            ("＝１", "'＝１"),
            ("\u{feff}=1", "\u{feff}'=1"),
            ("a;=1;  -2", "a;'=1;  '-2"),
            ("\";=1", "\";'=1"),
            ("山田 太郎", "山田 太郎"),
            ("a-b = c", "a-b = c"),
            ("", ""),
        ] {
            assert_eq!(cell(text), expected, "{text:?}");
        }
    }

    #[test]
    fn what_moves_a_terminal_or_turns_the_text_is_replaced() {
        assert_eq!(one_line("a\u{1b}[2Jb\0\u{202e}c\r\nd\u{9b}"), "a\u{fffd}[2Jb\u{fffd}\u{fffd}c d\u{fffd}");
    }

    #[test]
    fn html_keeps_neither_tags_nor_quotes() {
        assert_eq!(html("<b a=\"x\">'&\\"), "&lt;b a=&quot;x&quot;&gt;&#39;&amp;&#92;");
    }
}
