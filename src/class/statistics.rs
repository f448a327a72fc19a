//! A class in numbers: scores and mistakes.

use super::{Class, ClassEntry};
use crate::report::Report;
use std::collections::HashMap;

/// Parts of the full score that are counted together; full marks are a bin of their own.
pub const BINS: usize = 10;

/// The bin of a score, from 0 to [`BINS`].
pub fn bin(report: &Report) -> usize {
    let share = if report.max_score > 0.0 { report.total() / report.max_score } else { 0.0 };
    // A tenth is no binary fraction: 0.7 * 10 must not fall below 7.
    (share * BINS as f64 + 1e-9).clamp(0.0, BINS as f64) as usize
}

/// How many of those who were graded have a score in each bin.
pub fn histogram(class: &Class) -> [usize; BINS + 1] {
    let mut counts = [0; BINS + 1];
    for report in class.entries.iter().filter_map(ClassEntry::report) {
        counts[bin(report)] += 1;
    }
    counts
}

/// The scores of those who were graded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Averages {
    /// How many they are.
    pub count: usize,
    /// Mean score.
    pub mean: f64,
    /// Half of them have this score or more, half this or less.
    pub median: f64,
}

/// Mean and median of the scores; `None` where nobody was graded.
pub fn averages(class: &Class) -> Option<Averages> {
    let mut scores: Vec<f64> = class.entries.iter().filter_map(ClassEntry::report).map(Report::total).collect();
    scores.sort_by(f64::total_cmp);
    let (count, middle) = (scores.len(), scores.len() / 2);
    let upper = *scores.get(middle)?;
    let median = if count.is_multiple_of(2) { f64::midpoint(scores[middle - 1], upper) } else { upper };
    Some(Averages { count, mean: scores.iter().sum::<f64>() / count as f64, median })
}

/// Ids of the mistakes that were made, with how many made them, the most frequent first.
pub fn mistakes(class: &Class) -> Vec<(&str, usize)> {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for mistake in class.entries.iter().filter_map(ClassEntry::report).flat_map(|report| &report.mistakes) {
        *counts.entry(mistake).or_default() += 1;
    }
    let mut counts: Vec<_> = counts.into_iter().collect();
    counts.sort_by(|(a, n), (b, m)| m.cmp(n).then(a.cmp(b)));
    counts
}
