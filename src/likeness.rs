//! Answers that are the same, and nearly the same: a hint for a person who looks, and never a verdict.
//!
//! The fingerprints are those of Schleimer, Wilkerson and Aiken ("Winnowing: local algorithms for document fingerprinting",
//! 2003), on which Moss rests: every run of [`RUN`] tokens is one. [`reading`] makes them, [`wording`] knows what anybody
//! would write: the hand-out, and the lecture's equation however it is cut into statements. Both are taken away, and so is
//! what many of a class have. [`view`] shows two answers side by side.
//!
//! # What is told, as measured on the samples of ggsample06
//! Of the 102 right answers of `accepted/answers`, each was held against each, and against a copy of itself in which all names
//! were changed and lines that do not need each other were swapped. Two different answers share at
//! most 0.47 of their own fingerprints, where they share [`FEWEST`] at all; 97 of the copies share 0.55 and more.
//! [`LEAST`] stands between. Without the lecture's wording taken away, the common right answer and its like share up to 0.79.
//! A window of four runs, of which one is kept, as for long texts, lost three more of them: here every run is kept.

mod reading;
pub mod view;
mod wording;

use crate::source::Source;
use reading::{Passage, TextStatement};
use sha2::{Digest, Sha256};
use std::collections::{HashMap, HashSet};
use wording::KnownWording;

pub use view::{Comparison, Side};

/// Tokens in a fingerprint. With six, a copy whose lines are swapped keeps fewer: 83 of 102 share 0.7 and more in place of 92.
const RUN: usize = 5;

/// Fewest fingerprints of their own that two answers share where it is told. Below are answers that hardly say more than the
/// lecture does: the common right answer has 8.
pub const FEWEST: usize = 12;

/// Least share of all the fingerprints of two answers that both have, where it is told.
pub const LEAST: f64 = 0.55;

/// Fewest tokens of their own of two files that are the same as a whole, comments included, where it is told. One term of the
/// lecture's equation has 19, and a file with a tenth line of comment has more.
const FEWEST_TOKENS: usize = 24;

/// A fingerprint that more answers have is anybody's: a tenth of all, and at least this many.
const COMMON: usize = 10;

/// Finds what answers to a homework have in common.
#[derive(Debug)]
pub struct Likeness {
    wording: KnownWording,
}

/// One answer, read.
#[derive(Clone, Debug)]
pub struct Answer {
    /// In the order of the text.
    passages: Vec<Passage>,
    /// Digest of the whole text with its comments, white space aside; `None` where hardly anything was added.
    text: Option<[u8; 32]>,
    /// Digest of the tokens that are not the hand-out's; none likewise.
    tokens: Option<[u8; 32]>,
}

/// Two answers that are alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Places of the two in the list, the smaller first.
    pub places: (usize, usize),
    /// Share of their own fingerprints that both have, 0 to 1.
    pub share: f64,
    /// How many fingerprints both have.
    pub shared: usize,
    /// Whether the two have the same tokens throughout.
    pub is_same: bool,
    /// Whether the two are the same files, comments included.
    pub is_same_text: bool,
}

impl Pair {
    fn of((one, other): (&Answer, &Answer), shared: usize, all: usize) -> Self {
        let is_same_text = one.text.is_some() && one.text == other.text;
        let is_same = is_same_text || one.tokens.is_some() && one.tokens == other.tokens;
        let share = if is_same { 1.0 } else { shared as f64 / all.max(1) as f64 };
        Self { places: (0, 1), share, shared, is_same, is_same_text }
    }

    fn is_told(&self) -> bool {
        self.is_same_text || self.shared >= FEWEST && self.share >= LEAST
    }

    /// The share in percent.
    pub fn percent(&self) -> u32 {
        (100.0 * self.share).round() as u32
    }
}

impl Likeness {
    /// For answers to a homework: the files as they are handed out, and right answers.
    pub fn new<'a>(hand_out: &[Source], solutions: impl Iterator<Item = &'a str>) -> Self {
        Self { wording: KnownWording::new(hand_out, solutions) }
    }

    /// For answers to this homework.
    pub fn of(assignment: &reference::Assignment) -> Self {
        let hand_out = crate::slots::handed_out(assignment).readable();
        let accepted = assignment.files.iter().flat_map(|file| {
            let others = file.accepted.iter().filter_map(|answer| assignment.folder.text(&answer.name).ok());
            std::iter::once(file.solution.text.as_str()).chain(others)
        });
        Self::new(&hand_out, accepted)
    }

    /// Reads the files of a hand-in.
    pub fn read(&self, sources: &[Source]) -> Answer {
        let own: Vec<TextStatement> = self.wording.own(sources);
        let passages = reading::passages(&own, self.wording.names());
        let passages = passages.into_iter().filter(|passage| !self.wording.has(passage.print)).collect();
        let is_enough = own.iter().map(|statement| statement.words.len()).sum::<usize>() >= FEWEST_TOKENS;
        let text = sources.iter().flat_map(|source| source.text.split_whitespace());
        let tokens = own.iter().flat_map(|statement| statement.words.iter().map(|word| word.text.as_str()));
        Answer { passages, text: is_enough.then(|| digest(text, "")), tokens: is_enough.then(|| digest(tokens, " ")) }
    }

    /// The pairs that are alike, the most alike first. Only those of which at least one is among the first `class` answers.
    pub fn pairs(&self, answers: &[Answer], class: usize) -> Vec<Pair> {
        let common = common(answers);
        let own: Vec<HashSet<u64>> = answers.iter().map(|answer| answer.prints(&common)).collect();
        let mut holders: HashMap<u64, Vec<usize>> = HashMap::new();
        for (place, prints) in own.iter().enumerate() {
            prints.iter().for_each(|print| holders.entry(*print).or_default().push(place));
        }
        let same_text = same_text(answers);
        // Of one answer after the other: of a class of 10,000, all pairs that have anything in common are tens of millions.
        let mut shared = vec![0; answers.len()];
        let mut pairs = Vec::new();
        for first in 0..class.min(answers.len()) {
            let behind = |places: &'_ [usize]| places.partition_point(|place| *place <= first);
            let alike = answers[first].text.and_then(|text| same_text.get(&text));
            let mut met: Vec<usize> = alike.map(|places| places[behind(places)..].to_vec()).unwrap_or_default();
            for places in own[first].iter().filter_map(|print| holders.get(print)) {
                for &second in &places[behind(places)..] {
                    shared[second] += 1;
                    // Fewer are told of nobody but of the same text.
                    if shared[second] == FEWEST {
                        met.push(second);
                    }
                }
            }
            met.sort_unstable();
            met.dedup();
            for second in met {
                let all = own[first].len() + own[second].len() - shared[second];
                let pair = Pair::of((&answers[first], &answers[second]), shared[second], all);
                pairs.extend(pair.is_told().then_some(Pair { places: (first, second), ..pair }));
            }
            shared[first..].fill(0);
        }
        pairs.sort_by(|a, b| {
            b.share.total_cmp(&a.share).then(b.shared.cmp(&a.shared)).then_with(|| a.places.cmp(&b.places))
        });
        pairs
    }

    /// How alike two answers are by themselves.
    pub fn pair(&self, one: &Answer, other: &Answer) -> Pair {
        let none = HashSet::new();
        let (a, b) = (one.prints(&none), other.prints(&none));
        let shared = a.intersection(&b).count();
        Pair::of((one, other), shared, a.len() + b.len() - shared)
    }

    /// The lines of two answers with what they share.
    pub fn compare(&self, one: (&Answer, &[Source]), other: (&Answer, &[Source])) -> (Vec<Side>, Vec<Side>) {
        let none = HashSet::new();
        let both: HashSet<u64> = one.0.prints(&none).intersection(&other.0.prints(&none)).copied().collect();
        let is_same = one.0.text.is_some() && one.0.text == other.0.text;
        let sides = |(answer, sources): (&Answer, &[Source])| match is_same {
            true => view::whole(sources),
            false => view::marked(sources, answer.passages.iter().filter(|passage| both.contains(&passage.print))),
        };
        (sides(one), sides(other))
    }
}

impl Answer {
    /// Its fingerprints but for those of `common`.
    fn prints(&self, common: &HashSet<u64>) -> HashSet<u64> {
        self.passages.iter().map(|passage| passage.print).filter(|print| !common.contains(print)).collect()
    }
}

/// What many of the answers have.
fn common(answers: &[Answer]) -> HashSet<u64> {
    let mut counts: HashMap<u64, usize> = HashMap::new();
    let none = HashSet::new();
    for answer in answers {
        answer.prints(&none).into_iter().for_each(|print| *counts.entry(print).or_default() += 1);
    }
    let most = COMMON.max(answers.len() / 10);
    counts.into_iter().filter(|(_, count)| *count > most).map(|(print, _)| print).collect()
}

/// The places of answers whose whole text is the same, by its digest, each group in order.
fn same_text(answers: &[Answer]) -> HashMap<[u8; 32], Vec<usize>> {
    let mut groups: HashMap<[u8; 32], Vec<usize>> = HashMap::new();
    for (place, answer) in answers.iter().enumerate() {
        if let Some(text) = answer.text {
            groups.entry(text).or_default().push(place);
        }
    }
    groups
}

fn digest<'a>(parts: impl Iterator<Item = &'a str>, between: &str) -> [u8; 32] {
    let mut digest = Sha256::new();
    for part in parts {
        digest.update(part);
        digest.update(between);
    }
    digest.finalize().into()
}

#[cfg(test)]
mod tests;
