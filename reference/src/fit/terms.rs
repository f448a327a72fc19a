//! Judging the terms of a shader that no known mistake explains, each where it stands alone.

use super::agrees;
use super::views::Views;
use crate::Assignment;
use crate::assignment::RubricItem;
use crate::probes::ProbeSet;
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
    /// A term that is right at so many probes.
    pub fn right(line: &str, judged: usize) -> Self {
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
    /// What shows there: a place among the assignment's regions.
    pub region: Option<usize>,
    /// The colour that a right term would give there, beside what the shader has of the earlier terms.
    pub expected: DVec3,
    /// The colour that the shader gives.
    pub found: DVec3,
}

/// Judges every line of the rubric whose term stands alone somewhere, see [`Views`].
///
/// At least one is wrong: it is known that the sum is.
pub(super) fn judge(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[DVec3],
    tolerance: f64,
) -> Vec<TermJudgement> {
    let views = Views::new(assignment, probes, samples, tolerance);
    let right = views.judge();
    let mut judgements: Vec<TermJudgement> = Vec::new();
    let mut shift = DVec3::ZERO;
    for (term, right) in views.terms.iter().zip(right) {
        let places = alone(assignment, term.line, probes);
        if judgements.is_empty() && !right {
            shift = constant_shift(probes, samples, &places, tolerance).unwrap_or(DVec3::ZERO);
        }
        judgements.push(if right {
            TermJudgement::right(&term.line.id, samples.len())
        } else {
            wrong(
                term.line,
                probes,
                samples,
                &places,
                if judgements.is_empty() { DVec3::ZERO } else { shift },
                tolerance,
            )
        });
    }
    judgements
}

/// The places where the line's term stands alone.
fn alone(assignment: &Assignment, line: &RubricItem, probes: &ProbeSet) -> Vec<usize> {
    let shows = |region: usize| assignment.regions.get(region).is_some_and(|region| line.alone_in.contains(&region.id));
    let here = |place: &usize| probes.probes[*place].region.is_some_and(shows);
    (0..probes.probes.len()).filter(here).collect()
}

/// The judgement of a wrong term: how far it is off where it stands alone, or anywhere if it is right there.
fn wrong(
    line: &RubricItem,
    probes: &ProbeSet,
    samples: &[DVec3],
    places: &[usize],
    shift: DVec3,
    tolerance: f64,
) -> TermJudgement {
    let alone = judge_line(line, probes, samples, places, shift, tolerance);
    if !alone.is_right() {
        return alone;
    }
    let all: Vec<usize> = (0..samples.len()).collect();
    let everywhere = judge_line(line, probes, samples, &all, DVec3::ZERO, tolerance);
    let matched = everywhere.matched.min(everywhere.judged.saturating_sub(1));
    TermJudgement { matched, ..everywhere }
}

fn judge_line(
    line: &RubricItem,
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
