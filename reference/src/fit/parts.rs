//! Which features a shader lacks, or has in another strength.
//!
//! Most colours are sums: what a feature adds is the difference between the solution and the solution without it. An answer
//! that is the solution, or one with known mistakes, less what some features add, lacks these features, and has all others.

use super::channel_agrees;
use crate::Assignment;
use crate::accepted::Computed;
use crate::equation::Reads;
use crate::mistake::FoundMistake;
use crate::probes::ProbeSet;
use glam::{DVec3, DVec4};

/// More features than this are not looked for in all combinations.
const MOST_FEATURES: usize = 8;

/// A channel of a fragment that has this much is cut off by the window: what was added to it is not known.
const FULL: f64 = 1.0 - 1e-6;

/// What is wrong with a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    /// It is not there.
    Missing,
    /// It is there, so many times as strong: red, green and blue.
    Factor([f64; 3]),
}

/// An explanation by features, and by known mistakes beside them.
#[derive(Clone, Debug, PartialEq)]
pub struct Parts {
    /// What is known to be wrong.
    pub found: Vec<FoundMistake>,
    /// Lines of the rubric, and what is wrong with what they judge.
    pub parts: Vec<(usize, Part)>,
}

/// The fewest features that explain the samples, where any do.
///
/// `is_there`: whether a sample's position is a given one.
pub fn explain_parts(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> Option<Parts> {
    let samples = super::padded(probes, samples);
    let right: Vec<Computed> = probes.iter().map(|probe| (probe.colour, probe.position)).collect();
    let features = assignment.features.iter().enumerate();
    let features = features.filter_map(|(line, feature)| Some((line, feature.as_ref()?)));
    let added: Vec<(usize, Vec<Computed>)> = features
        .take(MOST_FEATURES)
        .map(|(line, feature)| {
            let without = assignment.computed_without(feature, probes);
            let add = |(own, without): (&Computed, Computed)| (own.0 - without.0, own.1 - without.1);
            (line, right.iter().zip(without).map(add).collect())
        })
        .collect();
    let is_clamped = assignment.equation.reads() != Reads::Attributes;
    let search = Search { samples, right, added, is_clamped, is_there, tolerance };
    let of = |found: Vec<FoundMistake>, base: &[Computed], least: u32| {
        Some(Parts { parts: search.missing(base, least)?, found })
    };
    let alone = of(Vec::new(), &search.right, 1).or_else(|| {
        let parts = search.scaled()?;
        Some(Parts { found: Vec::new(), parts })
    });
    alone.or_else(|| {
        let known = assignment.mistakes.iter().flat_map(|mistake| {
            let ways = mistake.variants.iter().zip(mistake.forms.len()..);
            ways.map(|(program, form)| (FoundMistake { id: mistake.id.clone(), form, parameter: None }, program))
        });
        let known: Vec<(FoundMistake, Vec<Computed>)> =
            known.map(|(found, program)| (found, assignment.computed_by(program, probes))).collect();
        let with_one = known.iter().find_map(|(found, base)| of(vec![found.clone()], base, 1));
        with_one.or_else(|| {
            // What two mistakes change is added up where they are of different lines.
            let is_apart = |a: &FoundMistake, b: &FoundMistake| {
                let costs = |found: &FoundMistake, line| assignment.keeps(found, line) < 1.0;
                !assignment.rubric.iter().any(|line| costs(a, line) && costs(b, line))
            };
            let pairs = known.iter().enumerate().flat_map(|(at, a)| known[at + 1..].iter().map(move |b| (a, b)));
            pairs.filter(|((a, _), (b, _))| is_apart(a, b)).find_map(|((a, ours), (b, theirs))| {
                let both = ours.iter().zip(theirs).zip(&search.right);
                let both = both.map(|((a, b), right)| (a.0 + b.0 - right.0, a.1 + b.1 - right.1));
                of(vec![a.clone(), b.clone()], &both.collect::<Vec<_>>(), 0)
            })
        })
    })
}

struct Search<'a> {
    samples: Vec<DVec3>,
    right: Vec<Computed>,
    /// For each line with a feature what it adds at each probe.
    added: Vec<(usize, Vec<Computed>)>,
    /// Whether colours are as a window holds them.
    is_clamped: bool,
    is_there: &'a dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
}

impl Search<'_> {
    /// The fewest features, `least` of them or more, without which `base` is what the samples show.
    fn missing(&self, base: &[Computed], least: u32) -> Option<Vec<(usize, Part)>> {
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
        Some(lacks(set).map(|(_, (line, _))| (*line, Part::Missing)).collect())
    }

    /// The feature that is in another strength, where all else is right.
    fn scaled(&self) -> Option<Vec<(usize, Part)>> {
        self.added.iter().find_map(|(line, added)| {
            let factor = self.factor(added);
            let explains = |place: usize| {
                let (colour, position) = self.right[place];
                self.shows(place, colour, (colour + added[place].0 * (factor - 1.0), position))
            };
            let is_other = factor.is_finite() && (factor - 1.0).abs().max_element() > self.tolerance;
            let explained = is_other && (0..self.right.len()).all(explains);
            explained.then(|| vec![(*line, Part::Factor(factor.to_array()))])
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

    /// Whether nothing of a channel of a colour is cut off.
    fn is_whole(&self, colour: DVec3, channel: usize) -> bool {
        !self.is_clamped || colour[channel] < FULL
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
