//! In which way one written mistake is all that is wrong.

use super::TOLERANCE;
use crate::Assignment;
use crate::accepted::Computed;
use crate::mistake::Mistake;
use crate::probes::{ProbeOutput, ProbeSet};
use glam::DVec3;

/// So many of the likeliest ways are looked at.
const MOST_WAYS: usize = 6;

impl Assignment {
    /// The first of some ways, the likeliest first, in which an answer shows what it shows with one written mistake. `shown`: what it shows
    /// in a way at these probes.
    ///
    /// A mistake after which hardly anything is left of a right answer, and one that looks like another one, tell nothing: what is wrong
    /// in any way may leave the same.
    pub(super) fn explained(
        &self,
        ways: &[usize],
        probes: &ProbeSet,
        shown: &dyn Fn(usize) -> Vec<ProbeOutput>,
    ) -> Option<usize> {
        let is_telling = |mistake: &&Mistake| {
            let kept: f64 = self.rubric.iter().map(|line| line.points * mistake.keeps(&line.id)).sum();
            mistake.fit.is_none() && 2.0 * kept >= self.max_score()
        };
        let programs = self.mistakes.iter().filter(is_telling).flat_map(|mistake| &mistake.variants);
        let all: Vec<Vec<Computed>> = programs.map(|program| self.computed_by(program, probes)).collect();
        let is_alike = |(a, b): (&Computed, &Computed)| is_equal(a.0, b.0);
        let is_like = |a: &[Computed], b: &[Computed]| a.iter().zip(b).all(is_alike);
        let is_only = |(at, own): &(usize, &Vec<Computed>)| {
            all.iter().enumerate().all(|(other, theirs)| other == *at || !is_like(own, theirs))
        };
        let telling: Vec<&Vec<Computed>> = all.iter().enumerate().filter(is_only).map(|(_, own)| own).collect();
        ways.iter().take(MOST_WAYS).copied().find(|way| {
            let shown = shown(*way);
            let is_it = |own: &&Vec<Computed>| {
                own.len() == shown.len() && own.iter().zip(&shown).all(|(own, shown)| is_equal(own.0, shown.colour))
            };
            telling.iter().any(is_it)
        })
    }
}

fn is_equal(a: DVec3, b: DVec3) -> bool {
    (a - b).abs().max_element() <= TOLERANCE
}
