//! Two answers side by side, with what they share marked.

use super::Pair;
use super::reading::Passage;
use crate::source::Source;
use std::ops::Range;

/// Two answers that are alike, as they are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// How much.
    pub pair: Pair,
    /// Whose answers they are.
    pub names: [String; 2],
    /// The files of each.
    pub sides: [Vec<Side>; 2],
}

/// A file of one of two answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// Its name. Untrusted.
    pub name: String,
    /// Its lines.
    pub lines: Vec<Vec<LinePiece>>,
}

/// A piece of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct LinePiece {
    /// As it was handed in. Untrusted.
    pub text: String,
    /// Whether the other answer has it as well.
    pub is_shared: bool,
}

/// Files all of which both have.
pub(super) fn whole(sources: &[Source]) -> Vec<Side> {
    sources.iter().map(|source| side(source, std::slice::from_ref(&(0..source.text.len())))).collect()
}

/// Files with these passages marked.
pub(super) fn marked<'a>(sources: &[Source], passages: impl Iterator<Item = &'a Passage>) -> Vec<Side> {
    let mut marks: Vec<Vec<Range<usize>>> = vec![Vec::new(); sources.len()];
    for (file, range) in passages.flat_map(|passage| passage.places.iter().cloned()) {
        if let (Some(source), Some(marks)) = (sources.get(file), marks.get_mut(file)) {
            marks.extend(code_in(source, range));
        }
    }
    let sides = sources.iter().zip(marks).map(|(source, mut marks)| {
        marks.sort_by_key(|mark| mark.start);
        marks.dedup_by(|next, before| {
            let overlaps = next.start <= before.end;
            if overlaps {
                before.end = before.end.max(next.end);
            }
            overlaps
        });
        side(source, &marks)
    });
    sides.collect()
}

/// The parts of a passage that are code: comments within it are nobody's.
fn code_in(source: &Source, passage: Range<usize>) -> Vec<Range<usize>> {
    let (text, code) = (source.text.as_bytes(), source.code().as_bytes());
    let mut parts: Vec<Range<usize>> = Vec::new();
    for at in passage.filter(|at| text.get(*at) == code.get(*at)) {
        match parts.last_mut().filter(|part| part.end == at) {
            Some(part) => part.end += 1,
            None => parts.push(at..at + 1),
        }
    }
    parts.retain(|part| !source.code()[part.clone()].trim().is_empty());
    parts
}

/// The lines of a file; `marks` are in order and apart.
fn side(source: &Source, marks: &[Range<usize>]) -> Side {
    let mut lines = Vec::new();
    let mut start = 0;
    for line in source.text.split_inclusive('\n') {
        let shown = line.trim_end_matches('\n');
        let end = start + shown.len();
        let mut pieces = Vec::new();
        let mut at = start;
        let inside = marks.iter().filter(|mark| mark.end > start && mark.start < end);
        for mark in inside.map(|mark| mark.start.max(start)..mark.end.min(end)) {
            // White space at the edges of a line is nobody's.
            let text = &source.text[mark.clone()];
            let mark = mark.start + (text.len() - text.trim_start().len())..mark.end;
            pieces.push(LinePiece { text: source.text[at..mark.start].to_owned(), is_shared: false });
            pieces.push(LinePiece { text: source.text[mark.clone()].to_owned(), is_shared: true });
            at = mark.end;
        }
        pieces.push(LinePiece { text: source.text[at..end].to_owned(), is_shared: false });
        pieces.retain(|piece| !piece.text.is_empty());
        lines.push(pieces);
        start += line.len();
    }
    Side { name: source.facts.name.clone(), lines }
}

/// How two answers look side by side, for a page that has the colours of a report.
pub const STYLE: &str = include_str!("templates/side_by_side.css");

impl Comparison {
    /// Whose files, and the files.
    pub fn columns(&self) -> [(&str, &[Side]); 2] {
        let [one, other] = &self.names;
        [(one, &self.sides[0]), (other, &self.sides[1])]
    }
}
