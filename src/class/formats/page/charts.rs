//! How many students: by verdict, by score, by mistake.

use super::words::PageWords;
use crate::class::standing::Standing;
use crate::class::statistics::{self, BINS};
use crate::class::{Class, ClassEntry};
use crate::language::Language;
use crate::report::labels::mistake_title;
use crate::report::text::number;
use std::collections::HashMap;

/// Students with one verdict.
pub(super) struct VerdictCount {
    pub id: &'static str,
    pub sign: &'static str,
    pub word: &'static str,
    pub count: usize,
    pub percent: f64,
}

/// The verdicts that occur, from right to wrong.
pub(super) fn tallies(class: &Class, language: Language) -> Vec<VerdictCount> {
    let counts = Standing::count(&class.entries);
    let count = |status: Standing| counts[status as usize];
    let tally = |status: Standing| VerdictCount {
        id: status.id(),
        sign: sign(status, 1.0),
        word: status.word(language),
        count: count(status),
        percent: 100.0 * count(status) as f64 / class.entries.len().max(1) as f64,
    };
    Standing::ALL.into_iter().map(tally).filter(|tally| tally.count > 0).collect()
}

/// The id of the hand-drawn sign of a verdict, as a teacher marks it.
pub(super) fn sign(status: Standing, score: f64) -> &'static str {
    match status {
        Standing::Correct => "full",
        Standing::Wrong if score > 0.0 => "partial",
        Standing::Wrong | Standing::Rejected | Standing::Stopped => "none",
        Standing::NotGraded => "nothing",
        Standing::Fault => "fault",
    }
}

/// Students with scores from `from` on.
pub(super) struct Bin {
    pub id: usize,
    pub from: String,
    pub range: String,
    pub spoken: String,
    pub count: usize,
    pub percent: f64,
}

/// The highest bar takes so much of its column, in percent; the rest is for the count above it.
const HIGHEST: f64 = 76.0;

/// The scores of everyone who was graded.
pub(super) fn bins(class: &Class, max_score: f64, words: &PageWords) -> Vec<Bin> {
    let counts = statistics::histogram(class);
    let most = counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    let from = |id: usize| number(max_score * id as f64 / BINS as f64);
    let of = |(id, &count): (usize, &usize)| {
        let next = (id < BINS).then(|| from(id + 1));
        let range = words.range(&from(id), next.as_deref());
        Bin {
            id,
            from: from(id),
            spoken: format!("{range}: {}", words.students(count)),
            range,
            count,
            percent: HIGHEST * count as f64 / most,
        }
    };
    counts.iter().enumerate().map(of).collect()
}

/// Students with one mistake.
pub(super) struct MistakeCount {
    pub id: String,
    pub title: String,
    pub label: String,
    pub count: usize,
    pub percent: f64,
}

/// A mistake that costs points in more lines of the rubric than these belongs to none of them.
const MOST_LABELS: usize = 2;

/// The mistakes that occur, the most frequent first; the label names the rubric lines that they cost points in.
pub(super) fn mistakes(class: &Class, language: Language) -> Vec<MistakeCount> {
    let mut labels: HashMap<&str, Vec<&str>> = HashMap::new();
    for line in class.entries.iter().filter_map(ClassEntry::report).flat_map(|report| &report.rubric) {
        if let Some(id) = &line.mistake {
            let (labels, label) = (labels.entry(id).or_default(), line.label.get(language));
            if !labels.contains(&label) {
                labels.push(label);
            }
        }
    }
    let found = statistics::mistakes(class);
    let most = found.first().map_or(1, |(_, count)| *count) as f64;
    let of = |(id, count): (&str, usize)| MistakeCount {
        id: id.to_owned(),
        title: mistake_title(&class.assignment, id, language),
        label: labels.get(id).filter(|labels| labels.len() <= MOST_LABELS).map_or(String::new(), |l| l.join(" · ")),
        count,
        percent: 100.0 * count as f64 / most,
    };
    found.into_iter().map(of).collect()
}
