//! A graded class: what every format is a view of.
//!
//! [`roll`] reads what was handed in, and finds with [`content`] which of it needs but one grading. [`standing`] and [`statistics`]
//! sum a class up, [`portrait`] and [`page`] show each student's result, [`formats`] are the files that people and courses' tools
//! read, and [`output`] writes them into a [`folder`].

pub mod content;
pub mod folder;
pub mod formats;
pub mod output;
pub mod page;
pub mod portrait;
pub mod roll;
pub mod standing;
pub mod statistics;

use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::intake::{FileLocation, Refused, Student};
use crate::language::{Language, Text};
use crate::report::Report;
use crate::source::Source;
use reference::Assignment;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::path::PathBuf;
use std::sync::Arc;

/// What became of one student's submission.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It was graded.
    Graded(Box<Report>),
    /// There is nothing to grade (no file, several files, a refused archive member), and why.
    NotGraded(Text),
    /// Grading it failed by no doing of the student's.
    Fault(Fault),
}

/// One student of a class.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassEntry {
    /// Who.
    pub student: Student,
    /// Where the files were, in the order of the report's; none without files.
    pub places: Vec<FileLocation>,
    /// What became of it.
    pub outcome: Outcome,
    /// The files that can be read as text.
    pub sources: Vec<Source>,
    /// A small PNG of what the shader draws, at the class's pose; `None` where nothing was drawn.
    pub portrait: Option<Vec<u8>>,
    /// The full report as a self-contained HTML page, on disk.
    pub page: Option<PathBuf>,
    /// Whose answers are alike, the most alike first: a hint, and no verdict.
    pub alike: Vec<AlikeStudent>,
}

/// Somebody whose answer is like another's.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct AlikeStudent {
    /// The student's key; of an earlier term, where the files were.
    pub key: String,
    /// How much of what the two wrote themselves is common to both.
    pub percent: u32,
    /// Whether the two have the same code throughout.
    pub is_same: bool,
    /// Whether it is somebody of an earlier term.
    pub is_earlier: bool,
}

impl ClassEntry {
    /// Keys of the others of the class who have the same code.
    pub fn shares_with(&self) -> impl Iterator<Item = &str> {
        self.alike.iter().filter(|it| it.is_same && !it.is_earlier).map(|it| it.key.as_str())
    }

    /// Where the files were, in one line.
    pub fn path(&self) -> Option<String> {
        FileLocation::joined(&self.places)
    }

    /// Where a file of the report was: the one with this name, or the first.
    pub fn place(&self, file: Option<&str>) -> Option<&FileLocation> {
        let named = |name: &str| self.report()?.sources.iter().position(|source| source.name == name);
        self.places.get(file.and_then(named).unwrap_or(0))
    }

    /// What the stages say, each with the report in which they say it.
    pub fn diagnostics(&self) -> impl Iterator<Item = (&Report, &Diagnostic)> {
        self.report().into_iter().flat_map(|report| report.diagnostics.iter().map(move |said| (report, said)))
    }

    /// The report, where there is one.
    pub fn report(&self) -> Option<&Report> {
        match &self.outcome {
            Outcome::Graded(report) => Some(report),
            _ => None,
        }
    }
}

/// A graded class.
#[derive(Clone, Debug)]
pub struct Class {
    /// The homework.
    pub assignment: Arc<Assignment>,
    /// Title, such as the name of the archive or folder.
    pub title: String,
    /// Everyone, in the order of the input.
    pub entries: Vec<ClassEntry>,
    /// What was left out.
    pub refused: Vec<Refused>,
    /// The right picture at the class's pose, a PNG of the size of the portraits.
    pub expected_portrait: Vec<u8>,
    /// Language of every message.
    pub language: Language,
}

impl Class {
    /// The class as its students may see it, see [`Report::for_student`]: for formats whose documents are shown to them.
    pub fn for_students(&self) -> Cow<'_, Self> {
        let is_same =
            |entry: &ClassEntry| entry.report().is_none_or(|report| matches!(report.for_student(), Cow::Borrowed(_)));
        if self.entries.iter().all(is_same) {
            return Cow::Borrowed(self);
        }
        let mut class = self.clone();
        for entry in &mut class.entries {
            if let Outcome::Graded(report) = &mut entry.outcome {
                **report = report.for_student().into_owned();
            }
        }
        Cow::Owned(class)
    }
}
