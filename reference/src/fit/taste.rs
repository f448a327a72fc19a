//! What a mistaken answer shows, but for what is a matter of taste: it has the freedom that a right answer has.

use super::{FEWEST, agrees};
use crate::Assignment;
use crate::accepted::AcceptedAnswer;
use crate::mistake::FoundMistake;
use crate::probes::ProbeSet;
use glam::{DVec3, DVec4};

/// Taste decides at fewer samples than this share of all: of a right answer with as much freedom as it may have it is a tenth.
const MOST_OF_TASTE: f64 = 0.4;

/// A position for each probe, and whether the sample there has it.
type IsThere<'e> = dyn Fn(usize, DVec4) -> bool + 'e;

/// Where samples are not what the solution with these mistakes shows, nor between that and what it shows with something in it that
/// is not judged. `None` where the mistakes are no programs that go together.
///
/// `is_there`: whether a sample's position is a given one.
pub(super) fn contradicted_but_for_taste(
    assignment: &Assignment,
    found: &[FoundMistake],
    probes: &ProbeSet,
    samples: &[DVec3],
    is_there: &IsThere<'_>,
    tolerance: f64,
) -> Option<Vec<bool>> {
    let colours = |program: &AcceptedAnswer| -> Vec<DVec3> {
        assignment.computed_by(program, probes).into_iter().map(|(colour, _)| colour).collect()
    };
    let own = assignment.computed_by(&assignment.together(found, None)?, probes);
    let is_shown = |at: usize, colour: DVec3| agrees(colour, samples[at], tolerance);
    let mut contradicted: Vec<bool> = own
        .iter()
        .enumerate()
        .map(|(at, (colour, position))| !(is_shown(at, *colour) && is_there(at, *position)))
        .collect();
    let count = contradicted.iter().filter(|contradicted| **contradicted).count();
    if count == 0 || count as f64 > MOST_OF_TASTE * samples.len() as f64 {
        return Some(contradicted);
    }
    let mut is_open = vec![false; samples.len()];
    for taste in &assignment.unjudged {
        let Some(program) = assignment.together(found, Some(taste)) else { continue };
        for (at, other) in colours(&program).into_iter().enumerate() {
            let (colour, position) = own[at];
            if agrees(colour, other, tolerance) {
                continue;
            }
            is_open[at] = true;
            let (least, most) = (colour.min(other) - tolerance, colour.max(other) + tolerance);
            let is_between = samples[at].cmpge(least).all() && samples[at].cmple(most).all();
            contradicted[at] &= !(is_between && is_there(at, position));
        }
    }
    // Where nothing is open the mistake has to show, or else anything would be explained.
    let is_telling =
        |at: &usize| !is_open[*at] && !contradicted[*at] && !agrees(probes.probes[*at].colour, own[*at].0, tolerance);
    let is_told = (0..samples.len()).filter(is_telling).count() >= FEWEST;
    Some(if is_told { contradicted } else { vec![true; samples.len()] })
}

/// Whether nothing contradicts these mistakes, see [`contradicted_but_for_taste`].
pub(super) fn is_explained(
    assignment: &Assignment,
    found: &[FoundMistake],
    probes: &ProbeSet,
    samples: &[DVec3],
    is_there: &IsThere<'_>,
    tolerance: f64,
) -> bool {
    contradicted_but_for_taste(assignment, found, probes, samples, is_there, tolerance)
        .is_some_and(|contradicted| !contradicted.contains(&true))
}
