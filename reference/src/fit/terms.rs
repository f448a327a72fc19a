//! Judging the terms of a shader that no known mistake explains, each where it stands alone.

use super::{agrees, alone};
use crate::Assignment;
use crate::assignment::RubricLine;
use crate::probes::{Probe, ProbeSet, Region};
use glam::DVec3;

/// What is to be said about one line of the rubric.
#[derive(Clone, Debug, PartialEq)]
pub struct TermJudgement {
    /// The line's id.
    pub line: String,
    /// Number of probes at which the line could be judged.
    pub judged: usize,
    /// Number of those at which it is right.
    pub matched: usize,
    /// The place that is furthest off.
    pub worst: Option<Worst>,
}

impl TermJudgement {
    fn right(line: &str, judged: usize) -> Self {
        Self { line: line.to_owned(), judged, matched: judged, worst: None }
    }

    /// Whether the term is right wherever it could be judged, and could be judged somewhere.
    pub const fn is_right(&self) -> bool {
        self.judged > 0 && self.matched == self.judged
    }
}

/// A place where a term is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// The probe's place in the set.
    pub probe: usize,
    /// What shows there.
    pub region: Region,
    /// The colour that a right term would give there, beside what the shader has of the earlier terms.
    pub expected: DVec3,
    /// The colour that the shader gives.
    pub found: DVec3,
}

/// Judges every line of the rubric whose term stands alone somewhere.
///
/// The first such line is the one that is the same everywhere, the ambient term. If it is wrong but constant, the others are
/// judged on top of it as it is.
pub(super) fn judge(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[DVec3],
    tolerance: f64,
) -> Vec<TermJudgement> {
    let mut judgements: Vec<TermJudgement> = Vec::new();
    let mut shift = DVec3::ZERO;
    for line in assignment.rubric.iter().filter(|l| !l.alone_in.is_empty()) {
        let all_right = judgements.iter().all(TermJudgement::is_right);
        let here = |p: &Probe| line.alone_in.contains(&p.region) || (all_right && line.also_in.contains(&p.region));
        let places: Vec<usize> = (0..samples.len()).filter(|i| here(&probes.probes[*i])).collect();
        let judgement = judge_line(line, probes, samples, &places, shift, tolerance);
        if judgements.is_empty() && !judgement.is_right() {
            shift = constant_shift(probes, samples, &places, tolerance).unwrap_or(DVec3::ZERO);
        }
        judgements.push(judgement);
    }
    acquit(&mut judgements, assignment, probes, samples, tolerance);
    judgements
}

/// Clears the terms that are right by the direction of their colour, although they never stand alone in this shader.
fn acquit(
    judgements: &mut [TermJudgement],
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[DVec3],
    tolerance: f64,
) {
    let terms = alone::terms(assignment, probes);
    let culprit = alone::only_wrong(&terms, probes, samples, tolerance);
    for (index, term) in terms.iter().enumerate() {
        let right = match culprit {
            Some(culprit) => culprit != index,
            None => alone::right_in_its_channels(&terms, index, probes, samples, tolerance) == Some(true),
        };
        let Some(judgement) = judgements.iter_mut().find(|judgement| judgement.line == term.line.id) else { continue };
        if right {
            *judgement = TermJudgement::right(&term.line.id, samples.len());
        } else if judgement.is_right() && culprit == Some(index) {
            // It is right where it stands alone, and wrong beside the others.
            let all: Vec<usize> = (0..samples.len()).collect();
            *judgement = judge_line(term.line, probes, samples, &all, DVec3::ZERO, tolerance);
        }
    }
}

fn judge_line(
    line: &RubricLine,
    probes: &ProbeSet,
    samples: &[DVec3],
    places: &[usize],
    shift: DVec3,
    tolerance: f64,
) -> TermJudgement {
    let mut matched = 0;
    let mut worst: Option<(f64, Worst)> = None;
    for place in places {
        let probe = &probes.probes[*place];
        let (expected, found) = (probe.colour + shift, samples[*place]);
        if agrees(expected, found, tolerance) {
            matched += 1;
            continue;
        }
        // Something that is no number is worse than any.
        let apart = (found - expected).abs();
        let apart = if apart.is_finite() { apart.max_element() } else { f64::INFINITY };
        if worst.is_none_or(|(w, _)| apart > w) {
            let region = probe.region;
            worst = Some((apart, Worst { probe: *place, region, expected, found }));
        }
    }
    TermJudgement { line: line.id.clone(), judged: places.len(), matched, worst: worst.map(|(_, w)| w) }
}

/// By how much all samples at these places differ from what is right, if it is the same for all.
fn constant_shift(probes: &ProbeSet, samples: &[DVec3], places: &[usize], tolerance: f64) -> Option<DVec3> {
    let shift = |place: &usize| samples[*place] - probes.probes[*place].colour;
    let first = places.first().map(shift)?;
    let same = |place: &usize| (shift(place) - first).abs().max_element() <= tolerance;
    (first.is_finite() && places.iter().all(same)).then_some(first)
}
