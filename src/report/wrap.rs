//! Text in terminal columns: width, padding, and line breaking for Latin and Japanese text alike.

use crate::source::lookalikes::is_bidi;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// Must not begin a line (kinsoku shori, JIS X 4051).
const CLOSING: &str = "、。，．・：；！？）」』】〕］｝〉》ー々…ぁぃぅぇぉっゃゅょァィゥェォッャュョ)]},.:;!?";
/// Must not end a line.
const OPENING: &str = "（「『【〔［｛〈《([{";

/// Columns that a text takes.
pub(crate) fn columns(text: &str) -> usize {
    text.width()
}

/// The text with spaces up to `width` columns.
pub(crate) fn pad(text: &str, width: usize) -> String {
    format!("{text}{}", " ".repeat(width.saturating_sub(columns(text))))
}

/// The text without characters that steer a terminal or reorder a line: they are shown as `�`.
///
/// Line feeds stay, and tabs become spaces.
pub(crate) fn plain(text: &str) -> String {
    let show = |c: char| match c {
        '\n' => '\n',
        '\t' => ' ',
        c if c.is_control() || is_bidi(c) => char::REPLACEMENT_CHARACTER,
        c => c,
    };
    text.chars().map(show).collect()
}

/// The text in lines of at most `width` columns, broken at spaces and between Japanese characters.
///
/// A word that is wider than a line is broken where the line ends.
pub(crate) fn wrap(text: &str, width: usize) -> Vec<String> {
    let width = width.max(2);
    text.lines().flat_map(|line| wrap_line(line, width)).collect()
}

fn wrap_line(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut used = 0;
    for unit in units(text) {
        let gap = usize::from(unit.spaced && used > 0);
        let needed = columns(&unit.text);
        if used > 0 && used + gap + needed > width {
            lines.push(String::new());
            used = 0;
        } else if gap > 0 {
            push(&mut lines, ' ');
            used += 1;
        }
        for c in unit.text.chars() {
            let wide = c.width().unwrap_or(0);
            if used + wide > width {
                lines.push(String::new());
                used = 0;
            }
            push(&mut lines, c);
            used += wide;
        }
    }
    lines
}

fn push(lines: &mut [String], c: char) {
    if let Some(line) = lines.last_mut() {
        line.push(c);
    }
}

/// What is not broken while it fits a line.
struct Unit {
    text: String,
    /// Whether a space stands before it.
    spaced: bool,
}

fn units(text: &str) -> Vec<Unit> {
    let mut units: Vec<Unit> = Vec::new();
    let mut previous: Option<char> = None;
    let mut in_code = false;
    for c in text.chars() {
        if c.is_whitespace() {
            previous = None;
            continue;
        }
        let after = previous.map(|p| BreakClass::of(p, !in_code));
        in_code ^= c == '`';
        let joined = after.is_some_and(|after| !after.may_break(BreakClass::of(c, !in_code)));
        match units.last_mut() {
            Some(unit) if joined => unit.text.push(c),
            _ => units.push(Unit { text: c.to_string(), spaced: previous.is_none() }),
        }
        previous = Some(c);
    }
    units
}

/// How a character behaves at the edge of a line.
struct BreakClass {
    wide: bool,
    opens: bool,
    closes: bool,
}

impl BreakClass {
    /// A back-quote opens or closes code by turns: `closing` says which.
    fn of(c: char, closing: bool) -> Self {
        Self {
            wide: c.width() == Some(2),
            opens: OPENING.contains(c) || c == '`' && !closing,
            closes: CLOSING.contains(c) || c == '`' && closing,
        }
    }

    fn may_break(&self, next: Self) -> bool {
        (self.wide || next.wide) && !self.opens && !next.closes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn latin_breaks_at_spaces() {
        assert_eq!(wrap("the half vector is not", 10), ["the half", "vector is", "not"]);
    }

    #[test]
    fn japanese_breaks_between_characters_but_not_before_a_full_stop() {
        // Ten columns hold five double-width characters; the full stop would begin the second line.
        assert_eq!(wrap("中間ベクト。長さ", 10), ["中間ベク", "ト。長さ"]);
        assert_eq!(wrap("中間ベク「長さ」", 10), ["中間ベク", "「長さ」"]);
    }

    #[test]
    fn code_holds_to_its_back_quotes() {
        assert_eq!(wrap("中間の`h`は", 7), ["中間の", "`h`は"]);
        assert_eq!(wrap("長さの`abc`を見る", 10), ["長さの", "`abc`を見", "る"]);
    }

    #[test]
    fn no_line_is_wider_than_asked() {
        let text = "37 行目の中間ベクトル `normalize(l+v)*0.5000000000000000000000000001` の長さ。";
        for width in 2..60 {
            let lines = wrap(text, width);
            assert!(lines.iter().all(|line| columns(line) <= width), "{width}: {lines:?}");
            let joined: String = lines.concat().chars().filter(|c| *c != ' ').collect();
            assert_eq!(joined, text.replace(' ', ""), "{width}");
        }
    }

    #[test]
    fn paragraphs_stay_apart() {
        assert_eq!(wrap("one\n\ntwo", 10), ["one", "", "two"]);
    }

    #[test]
    fn padding_counts_columns() {
        assert_eq!(pad("形状", 6), "形状  ");
    }

    #[test]
    fn escape_sequences_lose_their_power() {
        assert_eq!(plain("a\u{1b}[31m\tb\n\u{202e}c"), "a�[31m b\n�c");
    }
}
