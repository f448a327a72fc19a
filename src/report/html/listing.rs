//! The student's files with what there is to say about its lines.

use super::body::HtmlMessage;
use super::rich::{MessagePiece, pieces};
use crate::language::Language;
use crate::report::Report;
use crate::report::labels::Labels;
use crate::source::Source;

/// One file.
pub(super) struct FileListing {
    pub name: String,
    pub lines: Vec<ListedLine>,
}

/// One line of a file.
pub(super) struct ListedLine {
    pub number: u32,
    pub anchor: String,
    pub spans: Vec<Span>,
    pub notes: Vec<Note>,
}

/// A stretch of a line that is shown in one way.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub text: String,
    pub marked: bool,
    pub comment: bool,
}

/// What there is to say about a line.
pub(super) struct Note {
    pub kind: &'static str,
    pub heading: String,
    pub text: Vec<MessagePiece>,
    /// Id of the rubric line that says it, where it is not said here.
    pub target: Option<String>,
}

/// The files in lines, each line with the rubric lines and the messages that point at it.
pub(super) fn listings(
    sources: &[Source],
    report: &Report,
    messages: &[HtmlMessage],
    language: Language,
) -> Vec<FileListing> {
    let listing = |source: &Source| {
        let name = source.facts.name.as_str();
        let file = ListedFile { name, is_only: report.sources.len() <= 1 };
        let index = report.sources.iter().position(|source| source.name == name).unwrap_or(0);
        let mut in_comment = false;
        let line = |(number, text): (u32, &str)| ListedLine {
            number,
            anchor: anchor(index, number),
            spans: spans(text, &marks(&file, report, number), &mut in_comment),
            notes: notes(&file, number, report, messages, language),
        };
        FileListing { name: name.to_owned(), lines: (1..).zip(source.text.lines()).map(line).collect() }
    };
    sources.iter().map(listing).collect()
}

/// The id of a line: `L12` in the first file, `F2L12` in the second.
pub(super) fn anchor(file: usize, line: u32) -> String {
    if file == 0 { format!("L{line}") } else { format!("F{}L{line}", file + 1) }
}

/// The file that is listed.
struct ListedFile<'a> {
    name: &'a str,
    is_only: bool,
}

impl ListedFile<'_> {
    /// Whether a place that names this file, or none, is in it.
    fn has(&self, file: Option<&str>) -> bool {
        self.is_only || file == Some(self.name)
    }
}

fn notes(file: &ListedFile, number: u32, report: &Report, messages: &[HtmlMessage], language: Language) -> Vec<Note> {
    let messages = messages.iter().filter(|message| message.line == Some(number) && file.has(message.file.as_deref()));
    let mut notes: Vec<Note> = messages
        .map(|message| Note {
            kind: message.kind,
            heading: message.severity.to_owned(),
            text: message.text.clone(),
            target: None,
        })
        .collect();
    let lines = report
        .rubric
        .iter()
        .filter(|line| line.line == Some(number) && file.has(line.file.as_deref()) && line.points < line.max_points);
    notes.extend(lines.map(|line| Note {
        kind: "rubric",
        heading: line.label.get(language).to_owned(),
        text: Vec::new(),
        target: Some(line.id.clone()),
    }));
    let comments = report.comments.iter().filter(|comment| comment.line == number && file.has(Some(&comment.file)));
    notes.extend(comments.map(|comment| Note {
        kind: "comment",
        heading: comment.author.clone().unwrap_or_else(|| Labels::of(language).comment.to_owned()),
        text: pieces(&comment.text),
        target: None,
    }));
    notes
}

/// The columns that messages mark in a line, from 0.
fn marks(file: &ListedFile, report: &Report, number: u32) -> Vec<std::ops::Range<usize>> {
    let here = report.diagnostics.iter().filter(|d| d.line == Some(number) && file.has(d.file.as_deref()));
    here.filter_map(|diagnostic| {
        let start = diagnostic.column?.saturating_sub(1) as usize;
        Some(start..start + diagnostic.length.max(1) as usize)
    })
    .collect()
}

fn spans(text: &str, marks: &[std::ops::Range<usize>], in_comment: &mut bool) -> Vec<Span> {
    let mut spans: Vec<Span> = Vec::new();
    for (column, (c, comment)) in text.chars().zip(comments(text, in_comment)).enumerate() {
        let marked = marks.iter().any(|mark| mark.contains(&column));
        match spans.last_mut() {
            Some(span) if (span.marked, span.comment) == (marked, comment) => span.text.push(c),
            _ => spans.push(Span { text: c.into(), marked, comment }),
        }
    }
    spans
}

/// Which characters of a line are a comment; `in_block` is carried from line to line.
fn comments(text: &str, in_block: &mut bool) -> Vec<bool> {
    let characters: Vec<char> = text.chars().collect();
    let mut flags = vec![false; characters.len()];
    let mut at = 0;
    while at < characters.len() {
        let pair = (characters[at], characters.get(at + 1).copied());
        let length = match pair {
            ('/', Some('/')) if !*in_block => {
                flags[at..].fill(true);
                return flags;
            }
            ('/', Some('*')) if !*in_block => {
                *in_block = true;
                flags[at..at + 2].fill(true);
                2
            }
            ('*', Some('/')) if *in_block => {
                *in_block = false;
                flags[at..at + 2].fill(true);
                2
            }
            _ => {
                flags[at] = *in_block;
                1
            }
        };
        at += length;
    }
    flags
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str, mark: std::ops::Range<usize>) -> Vec<(String, bool, bool)> {
        let spans = spans(text, &[mark], &mut false);
        spans.into_iter().map(|span| (span.text, span.marked, span.comment)).collect()
    }

    #[test]
    fn a_mark_counts_characters_not_bytes() {
        let expected = [("あい", false), ("うえ", true), ("お", false)];
        assert_eq!(of("あいうえお", 2..4), expected.map(|(text, marked)| (text.to_owned(), marked, false)));
    }

    #[test]
    fn a_mark_beyond_the_line_is_harmless() {
        assert_eq!(of("ab", 5..9), [("ab".to_owned(), false, false)]);
    }

    #[test]
    fn comments_reach_over_lines() {
        let mut in_block = false;
        assert_eq!(comments("a/*b", &mut in_block), [false, true, true, true]);
        assert_eq!(comments("//*/c", &mut in_block), [true, true, true, true, false]);
        assert!(!in_block);
        assert_eq!(comments("a//*", &mut in_block), [false, true, true, true]);
        assert!(!in_block);
    }
}
