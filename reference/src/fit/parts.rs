//! Which features a shader lacks, or has in another strength.
//!
//! Most colours are sums: what a feature adds is the difference between the solution and the solution without it. An answer
//! that is the solution, or one with known mistakes, less what some features add, lacks these features, and has all others.

use super::{Alternatives, channel_agrees};
use crate::accepted::Computed;
use crate::equation::Reads;
use crate::feature::Feature;
use crate::mistake::FoundMistake;
use glam::{DVec3, DVec4};

/// More features than this are not looked for in all combinations.
const MOST_FEATURES: usize = 8;

/// A channel of a fragment that has this much is cut off by the window: what was added to it is not known.
pub(super) const FULL: f64 = 1.0 - 1e-6;

/// What is wrong with a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FeatureDefect {
    /// It is not there.
    Missing,
    /// It is there, so many times as strong: red, green and blue.
    Factor([f64; 3]),
}

/// An explanation by features, and by known mistakes beside them.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureExplanation {
    /// What is known to be wrong.
    pub found: Vec<FoundMistake>,
    /// Lines of the rubric, and what is wrong with what they judge.
    pub parts: Vec<(usize, FeatureDefect)>,
}

impl FeatureExplanation {
    /// Whether features are missing, and none is in another strength.
    pub fn is_missing(&self) -> bool {
        self.parts.iter().all(|(_, defect)| *defect == FeatureDefect::Missing)
    }
}

/// The fewest features that explain the samples, where any do.
///
/// `is_there`: whether a sample's position is a given one.
pub fn explain_parts(
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> Option<FeatureExplanation> {
    let assignment = alternatives.assignment;
    let right = alternatives.right();
    let lines = 0..assignment.features.len();
    let without = lines.filter_map(|line| Some((line, alternatives.without(line)?)));
    let added = without.take(MOST_FEATURES).map(|(line, without)| {
        let add = |(own, without): (&Computed, &Computed)| (own.0 - without.0, own.1 - without.1);
        (line, right.iter().zip(without).map(add).collect())
    });
    let search = DefectSearch {
        samples: super::padded(alternatives.probes, samples),
        added: added.collect(),
        right: right.clone(),
        is_clamped: assignment.equation.reads() != Reads::Attributes,
        is_there,
        tolerance,
    };
    let together = || missing_together(alternatives, &search);
    if let Some(parts) = search.missing(&search.right, 1).or_else(|| search.scaled()).or_else(together) {
        return Some(FeatureExplanation { found: Vec::new(), parts });
    }
    let with_one = |(found, _, shown): (&FoundMistake, _, &[Computed])| {
        Some(FeatureExplanation { parts: search.missing(shown, 1)?, found: vec![found.clone()] })
    };
    if let Some(parts) = alternatives.programs().find_map(with_one) {
        return Some(parts);
    }
    // What two mistakes change is added up where they are of different lines.
    let firsts = alternatives.programs().enumerate();
    let pairs = firsts.flat_map(|(at, first)| alternatives.programs().skip(at + 1).map(move |other| (first, other)));
    pairs.filter(|((a, ..), (b, ..))| !assignment.share_a_line(a, b)).find_map(|((a, _, ours), (b, _, theirs))| {
        let both = ours.iter().zip(theirs).zip(&search.right);
        let both: Vec<Computed> = both.map(|((a, b), right)| (a.0 + b.0 - right.0, a.1 + b.1 - right.1)).collect();
        Some(FeatureExplanation { parts: search.missing(&both, 0)?, found: vec![a.clone(), b.clone()] })
    })
}

/// Two features without which the solution shows the samples, where they are not added to one another.
fn missing_together(alternatives: &Alternatives<'_>, search: &DefectSearch<'_>) -> Option<Vec<(usize, FeatureDefect)>> {
    let assignment = alternatives.assignment;
    let programs = assignment.features.iter().enumerate().filter_map(|(line, feature)| match feature {
        Some(Feature::Program(program)) => Some((line, program, alternatives.without(line)?)),
        _ => None,
    });
    let programs: Vec<_> = programs.take(MOST_FEATURES).collect();
    let shows = |place: usize, own: &Computed| search.shows(place, own.0, *own);
    let pairs =
        programs.iter().enumerate().flat_map(|(at, first)| programs[at + 1..].iter().map(move |own| (first, own)));
    let found = pairs.into_iter().find(|((_, first, without_first), (_, second, without_second))| {
        // Where one of them makes no difference, the other one is what shows.
        let is_possible = |(place, right): (usize, &Computed)| {
            let (a, b) = (&without_first[place], &without_second[place]);
            match (a == right, b == right) {
                (true, _) => shows(place, b),
                (false, true) => shows(place, a),
                (false, false) => true,
            }
        };
        let both = || assignment.together(&[], &[first, second]);
        let shown = search.right.iter().enumerate().all(is_possible).then(both).flatten();
        let shown = shown.map(|both| assignment.computed_by(&both, alternatives.probes));
        shown.is_some_and(|shown| shown.iter().enumerate().all(|(place, own)| shows(place, own)))
    });
    found.map(|((first, ..), (second, ..))| [*first, *second].map(|line| (line, FeatureDefect::Missing)).to_vec())
}

struct DefectSearch<'a> {
    samples: Vec<DVec3>,
    right: Vec<Computed>,
    /// For each line with a feature what it adds at each probe.
    added: Vec<(usize, Vec<Computed>)>,
    /// Whether colours are as a window holds them.
    is_clamped: bool,
    is_there: &'a dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
}

impl DefectSearch<'_> {
    /// The fewest features, `least` of them or more, without which `base` is what the samples show.
    fn missing(&self, base: &[Computed], least: u32) -> Option<Vec<(usize, FeatureDefect)>> {
        let mut sets: Vec<u32> = (0..1 << self.added.len()).filter(|set: &u32| set.count_ones() >= least).collect();
        sets.sort_by_key(|set| set.count_ones());
        let lacks = |set: u32| self.added.iter().enumerate().filter(move |(number, _)| set & (1 << number) != 0);
        let explains = |set: &u32| {
            base.iter().enumerate().all(|(place, own)| {
                let less = |sum: Computed, added: &Computed| (sum.0 - added.0, sum.1 - added.1);
                let lacking = lacks(*set).fold(*own, |sum, (_, (_, added))| less(sum, &added[place]));
                self.shows(place, own.0, lacking)
            })
        };
        let set = sets.into_iter().find(explains)?;
        Some(lacks(set).map(|(_, (line, _))| (*line, FeatureDefect::Missing)).collect())
    }

    /// The feature that is in another strength, where all else is right.
    fn scaled(&self) -> Option<Vec<(usize, FeatureDefect)>> {
        self.added.iter().find_map(|(line, added)| {
            let factor = self.factor(added);
            let explains = |place: usize| {
                let (colour, position) = self.right[place];
                self.shows(place, colour, (colour + added[place].0 * (factor - 1.0), position))
            };
            let is_other = factor.is_finite() && (factor - 1.0).abs().max_element() > self.tolerance;
            let explained = is_other && (0..self.right.len()).all(explains);
            explained.then(|| vec![(*line, FeatureDefect::Factor(factor.to_array()))])
        })
    }

    /// How much of a feature the samples have, by least squares; 1 where a channel has nothing of it.
    fn factor(&self, added: &[Computed]) -> DVec3 {
        let (mut up, mut down) = (DVec3::ZERO, DVec3::ZERO);
        for (place, (colour, _)) in added.iter().enumerate() {
            let apart = self.samples[place] - self.right[place].0;
            let is_known = |channel: &usize| {
                self.is_whole(self.right[place].0, *channel) && self.is_whole(self.samples[place], *channel)
            };
            for channel in (0..3).filter(is_known) {
                up[channel] += apart[channel] * colour[channel];
                down[channel] += colour[channel] * colour[channel];
            }
        }
        DVec3::from_array(std::array::from_fn(|channel| {
            let is_there = down[channel] > self.tolerance * self.tolerance;
            if is_there { 1.0 + up[channel] / down[channel] } else { 1.0 }
        }))
    }

    /// Whether nothing of a channel of a colour is cut off. What is no number is not cut off, and explains nothing.
    fn is_whole(&self, colour: DVec3, channel: usize) -> bool {
        !(self.is_clamped && colour[channel] >= FULL)
    }

    /// Whether a sample shows this, which is made of what is right and of `base`, as far as nothing of these is cut off.
    fn shows(&self, place: usize, base: DVec3, (colour, position): Computed) -> bool {
        let sample = self.samples[place];
        let agrees = |channel: usize| {
            let is_known = self.is_whole(self.right[place].0, channel) && self.is_whole(base, channel);
            let expected = if self.is_clamped { colour[channel].min(1.0) } else { colour[channel] };
            !is_known || channel_agrees(expected, sample[channel], self.tolerance)
        };
        (0..3).all(agrees) && (self.is_there)(place, position)
    }
}
