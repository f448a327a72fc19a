//! Which of several readings of the same bytes a person would have written.
//!
//! Shift_JIS and EUC-JP share most of their bytes: every two half-width katakana of the one are a kanji of the other,
//! and most runs of accented letters are some rare kanji. What tells them apart in a comment of three characters is
//! which characters come out, so each reading earns points by them. The points are ranks, not measurements.

use super::Encoding;
use std::ops::RangeInclusive;

/// Bytes that are nothing in this encoding.
const INVALID: i32 = -10;
/// A character of everyday Japanese: kana, a kanji of JIS level 1, full-width signs.
const EVERYDAY: i32 = 6;
/// Any character but ASCII in UTF-8: a sequence that is well formed is hardly chance.
const WELL_FORMED: i32 = 12;
/// A kanji of JIS level 2.
const RARE: i32 = -2;
/// A character that a vendor left to its users, or a letter that is not Japanese.
const ALIEN: i32 = -12;
/// A half-width katakana next to another one; two of them take the bytes of one kanji and earn less.
const HALF_WIDTH: i32 = 2;
/// A voiced mark after a katakana that takes one, or where none can stand.
const MARK: i32 = 8;
/// An accented letter inside a word.
const ACCENT: i32 = 2;
/// A two-byte character between ASCII letters, its second byte being one too: an accent swallowed the next letter.
const SWALLOWED: i32 = -6;

/// The reading that earns most; the first in this order where several do.
pub(super) fn best(bytes: &[u8]) -> Encoding {
    let japanese = [Encoding::Utf8, Encoding::ShiftJis, Encoding::EucJp].map(|encoding| {
        let text = encoding.read(bytes);
        (encoding, score_japanese(encoding, &text))
    });
    let western = (Encoding::Windows1252, score_western(&Encoding::Windows1252.read(bytes)));
    let mut best = western;
    for candidate in japanese {
        if candidate.1 > best.1 {
            best = candidate;
        }
    }
    best.0
}

/// Whether `text` is EUC-JP that happens to be well-formed UTF-8, as the kanji 表 (C9 BD) is.
///
/// Only two-byte characters can be both, and of those only letters that nobody writes alone count as chance: not
/// Latin with accents, Greek and Cyrillic.
pub(super) fn is_utf8_by_chance(text: &str) -> bool {
    let by_chance = |c: char| c.is_ascii() || matches!(c, '\u{180}'..='\u{2FF}' | '\u{500}'..='\u{7FF}');
    if text.is_ascii() || !text.chars().all(by_chance) {
        return false;
    }
    let japanese = Encoding::EucJp.read(text.as_bytes());
    japanese.chars().filter(|c| !c.is_ascii()).all(|c| full_width(Encoding::EucJp, c) == EVERYDAY)
}

fn score_japanese(encoding: Encoding, text: &str) -> i32 {
    let characters: Vec<char> = text.chars().collect();
    let at = |index: usize| characters.get(index).copied().unwrap_or('\n');
    let mut score = 0;
    for (index, &c) in characters.iter().enumerate().filter(|(_, c)| !c.is_ascii()) {
        let before = at(index.wrapping_sub(1));
        let last = index + 1 == characters.len();
        score += match c {
            // A copy that was cut off says nothing about the rest.
            '\u{FFFD}' if last => -1,
            '\u{FFFD}' => INVALID,
            '\u{FF61}'..='\u{FF9F}' => half_width(before, c, at(index + 1)),
            _ => full_width(encoding, c),
        };
        if before.is_ascii_alphabetic() && at(index + 1).is_ascii() && swallows(encoding, c) {
            score += SWALLOWED;
        }
    }
    score
}

/// Points of a half-width katakana between its neighbours.
fn half_width(before: char, c: char, after: char) -> i32 {
    const KATAKANA: RangeInclusive<char> = '\u{FF61}'..='\u{FF9F}';
    let voiced = matches!(before, 'ｳ' | 'ｶ'..='ﾄ' | 'ﾊ'..='ﾎ');
    match c {
        'ﾞ' if voiced => MARK,
        'ﾟ' if matches!(before, 'ﾊ'..='ﾎ') => MARK,
        'ﾞ' | 'ﾟ' => -MARK,
        // Half-width punctuation is what the kana rows of EUC-JP (A4, A5) look like.
        '｡'..='･' => -1,
        // No word begins with a small letter or a prolonged sound.
        'ｧ'..='ｰ' if !KATAKANA.contains(&before) => RARE,
        _ if KATAKANA.contains(&before) || KATAKANA.contains(&after) => HALF_WIDTH,
        _ => RARE,
    }
}

fn full_width(encoding: Encoding, c: char) -> i32 {
    match c {
        _ if encoding == Encoding::Utf8 => WELL_FORMED,
        '\u{3000}'..='\u{30FF}' | '\u{FF01}'..='\u{FF5E}' => EVERYDAY,
        '\u{2010}'..='\u{2312}' | '\u{2500}'..='\u{266F}' | '×' | '÷' | '°' | '±' => EVERYDAY,
        '\u{4E00}'..='\u{9FFF}' if is_level_one(c) => EVERYDAY,
        '\u{4E00}'..='\u{9FFF}' => RARE,
        'Α'..='ω' | 'А'..='я' => RARE,
        _ => ALIEN,
    }
}

/// Whether `c` is in JIS X 0208 level 1, the kanji in daily use: 889F to 9872 in Shift_JIS.
fn is_level_one(c: char) -> bool {
    let mut buffer = [0; 4];
    let (bytes, _, unmappable) = encoding_rs::SHIFT_JIS.encode(c.encode_utf8(&mut buffer));
    !unmappable && matches!(*bytes, [high, low] if (0x889F..=0x9872).contains(&u16::from_be_bytes([high, low])))
}

/// Whether the second byte of `c` is an ASCII letter.
fn swallows(encoding: Encoding, c: char) -> bool {
    let mut buffer = [0; 4];
    let (bytes, _, unmappable) = encoding.codec().encode(c.encode_utf8(&mut buffer));
    !unmappable && matches!(*bytes, [_, low] if low.is_ascii_alphabetic())
}

fn score_western(text: &str) -> i32 {
    let characters: Vec<char> = text.chars().collect();
    let is_letter = |index: usize| characters.get(index).is_some_and(|c| c.is_ascii_alphabetic());
    let points = |(index, &c): (usize, &char)| match c {
        'À'..='ÿ' if is_letter(index.wrapping_sub(1)) || is_letter(index + 1) => ACCENT,
        // Bytes that Windows-1252 leaves free.
        '\u{80}'..='\u{9F}' => INVALID,
        _ => 0,
    };
    characters.iter().enumerate().map(points).sum()
}
