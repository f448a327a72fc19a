//! What was handed in, read before it is graded: which of it is the same, and who is alike.

use super::content::ContentDigest;
use super::{AlikeStudent, ClassEntry, Outcome};
use crate::hand_in::HandIn;
use crate::intake::{self, StudentWork};
use crate::language::Text;
use crate::likeness::{Comparison, Likeness, Pair};
use crate::source::{self, Source};
use reference::Assignment;
use std::collections::HashMap;
use std::path::PathBuf;

/// A hand-in and what is known of it before it is graded.
#[derive(Debug)]
pub struct GradingCandidate {
    /// Who handed in what.
    pub hand_in: StudentWork,
    /// The hand-in's digest in hexadecimal; `None` where there is nothing to grade.
    pub sha256: Option<String>,
    /// The files that can be read as text.
    pub sources: Vec<Source>,
    content: Option<ContentDigest>,
    alike: Vec<AlikeStudent>,
}

/// What was handed in, read, and who is alike.
#[derive(Debug)]
pub struct Roll {
    /// Everyone.
    pub candidates: Vec<GradingCandidate>,
    /// Those whose answers are alike, the most alike first.
    pub comparisons: Vec<Comparison>,
}

/// Most pairs that are shown side by side.
const MOST_COMPARISONS: usize = 200;

/// Reads what was handed in as text, and finds who is alike: of the class, or one of the class and one of an earlier term.
pub fn roll(hand_ins: Vec<StudentWork>, earlier: Vec<StudentWork>, assignment: &Assignment) -> Roll {
    let class = hand_ins.len();
    let mut all: Vec<GradingCandidate> = hand_ins.into_iter().chain(earlier).map(GradingCandidate::new).collect();
    let likeness = Likeness::of(assignment);
    let answers: Vec<_> = all.iter().map(|candidate| likeness.read(&candidate.sources)).collect();
    let pairs = likeness.pairs(&answers, class);
    let called = |place: usize| {
        let student = &all[place].hand_in.student;
        match (place < class, &all[place].hand_in.content) {
            // Of an earlier term, the place of the files says which one it is.
            (false, intake::HandInContent::Files { .. }) => {
                all[place].hand_in.path().unwrap_or_else(|| student.name.clone())
            }
            _ => student.name.clone(),
        }
    };
    let comparison = |pair: &Pair| {
        let (one, other) = pair.places;
        let side = |place: usize| (&answers[place], all[place].sources.as_slice());
        let sides = likeness.compare(side(one), side(other)).into();
        Comparison { pair: pair.clone(), names: [called(one), called(other)], sides }
    };
    let comparisons = pairs.iter().take(MOST_COMPARISONS).map(comparison).collect();
    // Each student's own list begins with who is most alike.
    let keys: Vec<String> = all.iter().map(|candidate| candidate.hand_in.student.key.clone()).collect();
    let names: Vec<String> = (0..all.len()).map(called).collect();
    for pair in &pairs {
        for (place, other) in [pair.places, (pair.places.1, pair.places.0)] {
            let is_earlier = other >= class;
            let key = if is_earlier { names[other].clone() } else { keys[other].clone() };
            all[place].alike.push(AlikeStudent { key, percent: pair.percent(), is_same: pair.is_same, is_earlier });
        }
    }
    all.truncate(class);
    Roll { candidates: all, comparisons }
}

impl GradingCandidate {
    fn new(work: StudentWork) -> Self {
        let none = |hand_in| Self { hand_in, sha256: None, sources: Vec::new(), content: None, alike: Vec::new() };
        let intake::HandInContent::Files { hand_in, .. } = &work.content else { return none(work) };
        let read: Vec<Option<Source>> = hand_in.files.iter().map(source::readable).collect();
        let contents = hand_in.files.iter().zip(&read).map(|(file, source)| match source {
            Some(source) => ContentDigest::of_text(source),
            None => ContentDigest::of_bytes(&file.sha256()),
        });
        let content = ContentDigest::of_all(contents);
        let sha256 = hand_in.sha256();
        Self {
            sha256: Some(sha256),
            sources: read.into_iter().flatten().collect(),
            content: Some(content),
            ..none(work)
        }
    }

    /// What is graded; `None` where there is nothing.
    pub fn files(&self) -> Option<&HandIn> {
        match &self.hand_in.content {
            intake::HandInContent::Files { hand_in, .. } => Some(hand_in),
            intake::HandInContent::Nothing(_) => None,
        }
    }

    /// Why there is nothing to grade.
    pub fn nothing(&self) -> Outcome {
        match &self.hand_in.content {
            intake::HandInContent::Nothing(why) => Outcome::NotGraded(why.clone()),
            intake::HandInContent::Files { .. } => Outcome::NotGraded(Text::default()),
        }
    }

    /// The entry of this outcome.
    pub fn entry(&self, outcome: Outcome, portrait: Option<Vec<u8>>, page: Option<PathBuf>) -> ClassEntry {
        let places = match &self.hand_in.content {
            intake::HandInContent::Files { places, .. } => places.clone(),
            intake::HandInContent::Nothing(_) => Vec::new(),
        };
        ClassEntry {
            student: self.hand_in.student.clone(),
            places,
            outcome,
            sources: self.sources.clone(),
            portrait,
            page,
            alike: self.alike.clone(),
        }
    }

    /// Whether there is something to grade.
    pub fn is_gradable(&self) -> bool {
        self.files().is_some()
    }
}

/// `indices` with those that need one grading together, in order of the first of each.
pub fn groups(candidates: &[GradingCandidate], indices: &[usize]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut places: HashMap<&ContentDigest, usize> = HashMap::new();
    for &index in indices {
        let content = candidates[index].content.as_ref();
        match content.and_then(|content| places.get(content)) {
            Some(&place) => groups[place].push(index),
            None => {
                places.extend(content.map(|content| (content, groups.len())));
                groups.push(vec![index]);
            }
        }
    }
    groups
}
