//! How many students: by verdict, by score, by mistake.

use super::words::Words;
use crate::batch::class::{Class, Entry};
use crate::batch::formats::status::Status;
use crate::language::Language;
use crate::report::Report;
use crate::report::text::number;
use std::collections::HashMap;

/// Students with one verdict.
pub(super) struct Tally {
    pub id: &'static str,
    pub sign: &'static str,
    pub word: &'static str,
    pub count: usize,
    pub percent: f64,
}

/// The verdicts that occur, from right to wrong.
pub(super) fn tallies(class: &Class, language: Language) -> Vec<Tally> {
    let count = |status: Status| class.entries.iter().filter(|entry| Status::of(entry) == status).count();
    let tally = |status: Status| Tally {
        id: status.id(),
        sign: sign(status, 1.0),
        word: status.word(language),
        count: count(status),
        percent: 100.0 * count(status) as f64 / class.entries.len().max(1) as f64,
    };
    Status::ALL.into_iter().map(tally).filter(|tally| tally.count > 0).collect()
}

/// The id of the hand-drawn sign of a verdict, as a teacher marks it.
pub(super) fn sign(status: Status, score: f64) -> &'static str {
    match status {
        Status::Correct => "full",
        Status::Wrong if score > 0.0 => "partial",
        Status::Wrong | Status::Rejected | Status::Stopped => "none",
        Status::NotGraded => "nothing",
        Status::Fault => "fault",
    }
}

/// Parts of the full score that are counted together; full marks are a bin of their own.
const BINS: usize = 10;

/// The bin of a score.
pub(super) fn bin(report: &Report) -> usize {
    let share = if report.max_score > 0.0 { report.score / report.max_score } else { 0.0 };
    // A tenth is no binary fraction: 0.7 * 10 must not fall below 7.
    (share * BINS as f64 + 1e-9).clamp(0.0, BINS as f64) as usize
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
pub(super) fn bins(class: &Class, max_score: f64, words: &Words) -> Vec<Bin> {
    let mut counts = [0usize; BINS + 1];
    for report in class.entries.iter().filter_map(Entry::report) {
        counts[bin(report)] += 1;
    }
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

/// Mean and median of the scores; none where nobody was graded.
pub(super) fn mean_and_median(class: &Class) -> Option<(f64, f64)> {
    let mut scores: Vec<f64> = class.entries.iter().filter_map(Entry::report).map(|report| report.score).collect();
    scores.sort_by(f64::total_cmp);
    let middle = scores.len() / 2;
    let median = match scores.len() {
        0 => return None,
        n if n % 2 == 0 => (scores[middle - 1] + scores[middle]) / 2.0,
        _ => scores[middle],
    };
    Some((scores.iter().sum::<f64>() / scores.len() as f64, median))
}

/// Students with one mistake.
pub(super) struct Mistake {
    pub id: String,
    pub label: String,
    pub count: usize,
    pub percent: f64,
}

/// The mistakes that occur, the most frequent first; the label is the rubric line that they cost points in.
pub(super) fn mistakes(class: &Class, language: Language) -> Vec<Mistake> {
    let mut found: Vec<(&str, usize)> = Vec::new();
    let mut place: HashMap<&str, usize> = HashMap::new();
    let mut labels: HashMap<&str, &str> = HashMap::new();
    for report in class.entries.iter().filter_map(Entry::report) {
        for id in &report.mistakes {
            let at = *place.entry(id).or_insert_with(|| {
                found.push((id, 0));
                found.len() - 1
            });
            found[at].1 += 1;
        }
        for line in &report.rubric {
            if let Some(id) = &line.mistake {
                labels.entry(id).or_insert(line.label.get(language));
            }
        }
    }
    found.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(b.0)));
    let most = found.first().map_or(1, |(_, count)| *count) as f64;
    let of = |(id, count): (&str, usize)| Mistake {
        id: id.to_owned(),
        label: labels.get(id).copied().unwrap_or_default().to_owned(),
        count,
        percent: 100.0 * count as f64 / most,
    };
    found.into_iter().map(of).collect()
}
