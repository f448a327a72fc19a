//! Diagnostics for the terminal, each with the line of the student's file that it is about and a mark under the place.
//!
//! The student's text is shown, never obeyed: what would move a cursor, hide or turn text appears as a picture of
//! itself, one character for one, so that columns stay what they are.

use crate::diagnostic::{Diagnostic, Severity};
use crate::language::Language;
use crate::source::Source;
use crate::source::lookalikes::{is_bidi, is_invisible};
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::ops::Range;
use unicode_width::UnicodeWidthChar;

/// Columns that an excerpt may fill.
const WIDTH: usize = 100;
/// The most characters that are marked: a longer mark tells nothing more.
const MAX_MARK: usize = 60;
/// The most characters of a line that are shown on either side of the place.
const MAX_AROUND: usize = 200;

/// Each diagnostic in turn: what is wrong, file name, line and column, the line with the place marked, and the hint.
///
/// One without a place is a line of its own, and so is one whose file is not among the `sources` to quote. The
/// result ends with a line end, or is empty.
pub fn excerpt(sources: &[Source], diagnostics: &[Diagnostic], language: Language, colour: bool) -> String {
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() }.term_width(WIDTH);
    let mut text = String::new();
    for diagnostic in diagnostics {
        // An empty line after each that quotes the file; those of one line stay together.
        if text.ends_with("\n") && diagnostic.line.is_some() {
            text.push('\n');
        }
        for group in groups(source_of(sources, diagnostic), diagnostic, language) {
            text.push_str(renderer.render(&[group]).trim_end());
            text.push('\n');
        }
    }
    text
}

/// The file that a diagnostic is about: the one that it names, or the only one.
fn source_of<'a>(sources: &'a [Source], diagnostic: &Diagnostic) -> Option<&'a Source> {
    match (&diagnostic.file, sources) {
        (None, [only]) => Some(only),
        (None, _) => None,
        (Some(file), sources) => sources.iter().find(|source| source.facts.name == *file),
    }
}

/// What is printed for one diagnostic: one group around a quotation, or a plain line each for message and hint.
fn groups<'a>(source: Option<&Source>, diagnostic: &Diagnostic, language: Language) -> Vec<Group<'a>> {
    let title = level(diagnostic.severity, language).primary_title(visible(diagnostic.message.get(language)));
    let help = Level::HELP.with_name(match language {
        Language::Ja => "ヒント",
        Language::En => "hint",
    });
    let hint = diagnostic.hint.as_ref().map(|hint| visible(hint.get(language)));
    let (Some(source), Some(line)) = (source, diagnostic.line) else {
        let hint = hint.map(|hint| Group::with_title(help.primary_title(hint)));
        return std::iter::once(Group::with_title(title)).chain(hint).collect();
    };
    let quoted = if line <= source.line_count() {
        title.element(quotation(source, line, diagnostic))
    } else {
        title.element(place(source, line, diagnostic))
    };
    vec![hint.into_iter().fold(quoted, |group, hint| group.element(help.clone().message(hint)))]
}

/// A place outside the file: the line after the last is where a compiler misses what was never written.
fn place<'a>(source: &Source, line: u32, diagnostic: &Diagnostic) -> Origin<'a> {
    let origin = Origin::path(visible(&source.facts.name)).line(line as usize);
    match diagnostic.column {
        Some(column) => origin.char_column(column as usize),
        None => origin,
    }
}

fn level<'a>(severity: Severity, language: Language) -> Level<'a> {
    let (level, en, ja) = match severity {
        Severity::Error => (Level::ERROR, "error", "エラー"),
        Severity::Warning => (Level::WARNING, "warning", "警告"),
        Severity::Note => (Level::NOTE, "note", "注意"),
    };
    level.with_name(match language {
        Language::En => en,
        Language::Ja => ja,
    })
}

fn quotation<'a>(source: &Source, number: u32, diagnostic: &Diagnostic) -> Snippet<'a, Annotation<'a>> {
    let line: Vec<char> = pictured(source.line(number));
    let mark = marked(&line, diagnostic);
    // A line without end would only be cut by the terminal; the columns before the cut stay in place.
    let end = line.len().min(mark.end + MAX_AROUND);
    let offset = |index: usize| line[..index].iter().map(|c| c.len_utf8()).sum::<usize>();
    let span = offset(mark.start)..offset(mark.end);
    Snippet::source(line[..end].iter().collect::<String>())
        .line_start(number as usize)
        .path(visible(&source.facts.name))
        .annotation(AnnotationKind::Primary.span(span))
}

/// The characters of `line` that are marked, as indices; without a column the whole line but its indentation.
fn marked(line: &[char], diagnostic: &Diagnostic) -> Range<usize> {
    let (start, length) = match diagnostic.column {
        Some(column) => ((column as usize).saturating_sub(1), diagnostic.length.max(1) as usize),
        None => (line.iter().take_while(|c| c.is_whitespace()).count(), line.len()),
    };
    let start = start.min(line.len());
    start..line.len().min(start + length.min(MAX_MARK))
}

/// A message with everything pictured that a terminal would act on; its line ends stay.
pub(crate) fn visible(text: &str) -> String {
    text.split('\n').map(|line| pictured(line).into_iter().collect::<String>()).collect::<Vec<_>>().join("\n")
}

/// The characters of `line`, one for one, each of them harmless and, but for one accent a letter, of some width.
fn pictured(line: &str) -> Vec<char> {
    let mut accented = true;
    let mut picture = |c: char| {
        let has_width = c.width().is_some_and(|width| width > 0);
        let is_second_accent = !has_width && std::mem::replace(&mut accented, !has_width);
        match c {
            '\t' => c,
            '\0'..='\x1F' => char::from_u32(0x2400 + u32::from(c)).unwrap_or('\u{FFFD}'),
            '\x7F' => '␡',
            _ if c.is_control() || is_bidi(c) || is_invisible(c) => '\u{FFFD}',
            '\u{2028}' | '\u{2029}' | '\u{E0000}'..='\u{E0FFF}' => '\u{FFFD}',
            _ if is_second_accent => '\u{FFFD}',
            _ => {
                accented = !has_width;
                c
            }
        }
    };
    line.chars().map(&mut picture).collect()
}

#[cfg(test)]
mod tests;
