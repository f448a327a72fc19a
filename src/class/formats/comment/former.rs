//! The comments of ggrade 0.1.0, which had no words at their ends: what the worksheet leaves of them is known by their form.

use super::exported::{GAP, text};
use super::{LANGUAGES, body};
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry};
use crate::language::Language;
use crate::report::labels::Labels;
use std::ops::Range;

/// What a comment of 0.1.0 is known by.
#[derive(Debug, Default)]
pub(super) struct Former {
    /// The text of this very comment in both languages: a grading that says the same again.
    same: Vec<String>,
    /// How a graded one begins: verdict and the word for the score, in both languages.
    beginnings: Vec<String>,
    /// The label of the rubric's last line in both languages.
    last_labels: Vec<String>,
}

/// Where a comment of 0.1.0 stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FormerComment {
    pub span: Range<usize>,
    /// Whether its end is taken to be that of the paragraph, since a message of unknown wording comes last.
    pub is_end_guessed: bool,
}

/// What the reasons said why there was nothing to grade, behind their title.
const REASONS: [&str; 10] = [
    "There is no ",
    "No file was handed in",
    "Several files could be the one to grade",
    "Only text typed into Moodle",
    " could not be taken.",
    " がありません。提出されているのは",
    "ファイルが提出されていません",
    "候補が複数あります",
    "オンラインテキストだけが提出されています",
    "を受け付けられませんでした",
];

impl Former {
    /// What tells the comments on this student.
    pub fn of(entry: &ClassEntry, class: &Class) -> Self {
        let verdicts = [Standing::Correct, Standing::Wrong, Standing::Rejected, Standing::Stopped];
        let beginning = |language| {
            verdicts.map(|standing| format!("{} — {} ", standing.word(language), Labels::of(language).score))
        };
        let rubric = class.entries.iter().find_map(|entry| entry.report()?.rubric.last());
        Self {
            same: LANGUAGES.iter().map(|language| text(&body(entry, *language)).trim().to_owned()).collect(),
            beginnings: LANGUAGES.into_iter().flat_map(beginning).collect(),
            last_labels: LANGUAGES
                .iter()
                .filter_map(|language| Some(rubric?.label.get(*language).to_owned()))
                .collect(),
        }
    }

    /// The first comment in a text of a worksheet.
    pub fn find(&self, text: &str) -> Option<FormerComment> {
        let same = self.same.iter().filter_map(|same| {
            let start = text.find(same.as_str()).filter(|_| !same.is_empty())?;
            Some(FormerComment { span: start..start + same.len(), is_end_guessed: false })
        });
        let graded = self.beginning(text, 0).map(|start| self.graded(text, start));
        // Of two at one place the one whose end is known.
        same.chain(graded).chain(not_graded(text)).min_by_key(|found| (found.span.start, found.is_end_guessed))
    }

    /// Where the next graded comment begins at or behind `from`.
    fn beginning(&self, text: &str, from: usize) -> Option<usize> {
        let starts = |beginning: &String| {
            let mut found = text[from..].match_indices(beginning.as_str());
            found.find_map(|(at, _)| points(&text[from + at + beginning.len()..]).map(|_| from + at))
        };
        self.beginnings.iter().filter_map(starts).min()
    }

    /// The graded comment that begins at `start`.
    fn graded(&self, text: &str, start: usize) -> FormerComment {
        let score = start + text[start..].find(" / ").map_or(0, |at| at + " / ".len());
        let title = text[score..].find(GAP).map_or(text.len(), |at| score + at + GAP.len());
        let next = self.beginning(text, title).unwrap_or(text.len());
        // All its points: nothing but the numbers comes behind the label.
        let full = self.last_labels.iter().find_map(|label| {
            let item = format!("○ {label} ");
            let end = title + text[title..next].find(&item)? + item.len();
            Some(end + points(&text[end..])?)
        });
        if let Some(end) = full {
            return FormerComment { span: start..end, is_end_guessed: false };
        }
        let end = text[title..next].find(GAP).map_or(next, |at| title + at);
        FormerComment { span: start..end, is_end_guessed: end < next }
    }
}

/// The length of `20 / 40` at the beginning of a text.
fn points(text: &str) -> Option<usize> {
    let number = |text: &str| {
        let length = text.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.len());
        (length > 0).then_some(length)
    };
    let first = number(text)?;
    let rest = text[first..].strip_prefix(" / ")?;
    Some(first + " / ".len() + number(rest)?)
}

/// The first comment that says why there was nothing to grade.
fn not_graded(text: &str) -> Option<FormerComment> {
    let titles = LANGUAGES.map(|language: Language| format!("{}{GAP}", Standing::NotGraded.word(language)));
    let found = titles.iter().filter_map(|title| {
        let start = text.find(title.as_str())?;
        let reason = start + title.len();
        let end = text[reason..].find(GAP).map_or(text.len(), |at| reason + at);
        REASONS.iter().any(|part| text[reason..end].contains(part)).then_some(start..end)
    });
    found.min_by_key(|span| span.start).map(|span| FormerComment { span, is_end_guessed: false })
}
