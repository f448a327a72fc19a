//! Characters that do not belong into GLSL, told by their name before a compiler complains of what comes after them.

mod wording;

use super::Source;
use super::directives::{LineState, standings};
use super::encoding::Encoding;
use super::lookalikes::{ascii_for, is_bidi, is_invisible, is_space};
use crate::diagnostic::{Diagnostic, Severity};
use wording::{diagnostic, skipped};

/// How many places are told one by one.
const MAX_PLACES: usize = 20;

/// Neighbouring stray characters of one kind on one line.
struct CharacterRun<'a> {
    line: u32,
    /// Where it begins in the text, in bytes.
    offset: usize,
    text: &'a str,
}

/// Errors and warnings about the code of `source`.
pub(super) fn in_code(source: &Source) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let standings = standings(source.code());
    let standing = |run: &CharacterRun| standings.get(run.line as usize - 1).copied().unwrap_or(LineState::Compiled);
    let (errors, mut warnings): (Vec<_>, Vec<_>) =
        runs(source).into_iter().partition(|run| standing(run) == LineState::Compiled);
    // One word a line is enough where nothing is wrong.
    warnings.dedup_by(|next, run| standing(run) == LineState::Skipped && next.line == run.line);
    let errors = bounded(Severity::Error, &errors, diagnostic);
    let warnings = bounded(Severity::Warning, &warnings, |run| match standing(run) {
        LineState::Skipped => skipped(run),
        _ => diagnostic(run),
    });
    let place = |diagnostics: Vec<(Option<usize>, Diagnostic)>| {
        let placed = diagnostics.into_iter().map(|(offset, diagnostic)| match offset {
            Some(offset) => at(source, offset, diagnostic),
            None => diagnostic,
        });
        placed.collect()
    };
    (place(errors), place(warnings))
}

/// `diagnostic` at a byte offset of the text.
fn at(source: &Source, offset: usize, diagnostic: Diagnostic) -> Diagnostic {
    let (line, column) = source.position(offset);
    diagnostic.at(line, Some(column))
}

/// Warnings about the comments of `source`: what cannot be read, what misleads the eye, what a driver reads otherwise.
pub(super) fn in_comments(source: &Source) -> Vec<Diagnostic> {
    let comments = || source.comments.iter().map(|comment| (comment, &source.text[comment.range.clone()]));
    let characters =
        || comments().flat_map(|(comment, text)| text.char_indices().map(|(at, c)| (comment.range.start + at, c)));
    let mut notes = Vec::new();
    if source.facts.encoding == Some(Encoding::ShiftJis) {
        let ends = comments().filter(|(comment, _)| comment.to_line_end).map(|(comment, _)| comment.range.end);
        notes.extend(ends.filter_map(|end| hidden_backslash(source, end)).take(MAX_PLACES));
    }
    let turning = characters().filter(|&(_, c)| is_bidi(c)).take(MAX_PLACES);
    notes.extend(turning.map(|(offset, c)| at(source, offset, wording::turned(c))));
    let mut unreadable = characters().filter(|&(_, c)| c == '\u{FFFD}');
    if let Some((offset, _)) = unreadable.next() {
        notes.push(at(source, offset, wording::unreadable_comment(1 + unreadable.count())));
    }
    notes
}

fn runs(source: &Source) -> Vec<CharacterRun<'_>> {
    let mut runs = Vec::new();
    for (line, &start) in (1..).zip(&source.line_starts) {
        let code = source.code_line(line);
        let mut at = 0;
        while let Some(found) = code[at..].find(is_stray) {
            let begin = at + found;
            let first = code[begin..].chars().next().map_or(CharacterKind::Foreign, kind);
            let ends = |c: char| !is_stray(c) || kind(c) != first;
            at = code[begin..].find(ends).map_or(code.len(), |length| begin + length);
            runs.push(CharacterRun { line, offset: start + begin, text: &code[begin..at] });
        }
    }
    runs
}

/// Whether `c` is neither ASCII nor white space that GLSL takes.
fn is_stray(c: char) -> bool {
    !c.is_ascii() || (c.is_ascii_control() && !matches!(c, '\t' | '\n' | '\u{B}' | '\u{C}'))
}

/// What a run consists of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum CharacterKind {
    Space,
    Unseen,
    Unreadable,
    LookAlike,
    Foreign,
}

fn kind(c: char) -> CharacterKind {
    match c {
        '\u{FFFD}' => CharacterKind::Unreadable,
        _ if is_space(c) => CharacterKind::Space,
        _ if is_invisible(c) || is_bidi(c) || c.is_control() => CharacterKind::Unseen,
        // A long vowel inside Japanese text is no minus sign, so it stays with the text.
        'ー' | 'ｰ' | '・' | '･' | '、' | '。' | '「' | '」' => CharacterKind::Foreign,
        _ if ascii_for(c).is_some() => CharacterKind::LookAlike,
        _ => CharacterKind::Foreign,
    }
}

/// A `//` comment that ends at `end` with a character whose second byte, in Shift_JIS, is that of a backslash: a driver
/// that gets these bytes joins the next line to the comment.
fn hidden_backslash(source: &Source, end: usize) -> Option<Diagnostic> {
    let last = source.text[..end].chars().next_back()?;
    let mut buffer = [0; 4];
    let (bytes, _, _) = encoding_rs::SHIFT_JIS.encode(last.encode_utf8(&mut buffer));
    matches!(*bytes, [_, b'\\']).then(|| at(source, end - last.len_utf8(), wording::joined(last)))
}

/// What `tell` says of the first places, each with its offset, and how many more there are.
fn bounded(
    severity: Severity,
    runs: &[CharacterRun],
    tell: impl Fn(&CharacterRun) -> Diagnostic,
) -> Vec<(Option<usize>, Diagnostic)> {
    let first = runs.iter().take(MAX_PLACES);
    let mut told: Vec<_> = first.map(|run| (Some(run.offset), Diagnostic { severity, ..tell(run) })).collect();
    let more = runs.len() - told.len();
    if more > 0 {
        told.push((None, Diagnostic { severity, ..wording::more(more) }));
    }
    told
}
