//! Whole programs in place of forms: what a mistake's program shows, and what shows of a feature by itself.

use super::{TermJudgement, Worst, agrees};
use crate::Assignment;
use crate::mistake::Found;
use crate::probes::ProbeSet;
use glam::{DVec3, DVec4};

/// A feature that shows by itself at fewer probes than this is not judged by them.
const FEWEST: usize = 8;

/// The first mistake whose program shows what the samples show, in colour and, as far as it is known, in place.
///
/// `is_there`: whether a sample's position is a given one.
pub fn program_of(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> Option<Found> {
    let samples = super::padded(probes, samples);
    assignment.mistakes.iter().find_map(|mistake| {
        let shows = |number: &usize| {
            let computed = assignment.computed_by(&mistake.variants[*number], probes);
            computed.iter().zip(&samples).enumerate().all(|(place, ((colour, position), sample))| {
                agrees(*colour, *sample, tolerance) && is_there(place, *position)
            })
        };
        let found = (0..mistake.variants.len()).find(shows)?;
        Some(Found { id: mistake.id.clone(), form: mistake.forms.len() + found, parameter: None })
    })
}

/// The lines whose features show by themselves at some probes: where the solution without the feature differs from the solution, and
/// the solution without any other does not.
pub fn judge_features(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    tolerance: f64,
) -> Vec<TermJudgement> {
    let samples = super::padded(probes, samples);
    let shows: Vec<Option<Vec<bool>>> = assignment
        .features
        .iter()
        .map(|feature| {
            let computed = assignment.computed_by(feature.as_ref()?, probes);
            let differs =
                computed.iter().zip(probes).map(|((colour, _), probe)| !agrees(probe.colour, *colour, tolerance));
            Some(differs.collect())
        })
        .collect();
    let judgement = |line: usize| {
        let own = shows[line].as_ref()?;
        let is_alone = |place: &usize| {
            let mut others = shows.iter().enumerate().filter(|(other, _)| *other != line);
            own[*place] && !others.any(|(_, other)| other.as_ref().is_some_and(|other| other[*place]))
        };
        let footprint: Vec<usize> = (0..samples.len()).filter(is_alone).collect();
        if footprint.len() < FEWEST {
            return None;
        }
        let apart = |place: &usize| {
            let apart = (samples[*place] - probes.probes[*place].colour).abs().max_element();
            if apart.is_finite() { apart } else { f64::INFINITY }
        };
        let is_wrong = |place: &&usize| !agrees(probes.probes[**place].colour, samples[**place], tolerance);
        let wrong: Vec<usize> = footprint.iter().filter(is_wrong).copied().collect();
        let worst = wrong.iter().copied().max_by(|a, b| apart(a).total_cmp(&apart(b))).map(|probe| Worst {
            probe,
            region: probes.probes[probe].region,
            expected: probes.probes[probe].colour,
            found: samples[probe],
        });
        let (judged, matched) = (footprint.len(), footprint.len() - wrong.len());
        Some(TermJudgement { line: assignment.rubric[line].id.clone(), judged, matched, worst })
    };
    (0..assignment.features.len()).filter_map(judgement).collect()
}

/// What is shown with these mistakes in it, where one of them is a whole program.
pub(super) fn shown_with(assignment: &Assignment, found: &[Found], probes: &ProbeSet) -> Option<Vec<DVec3>> {
    let [found] = found else { return None };
    let program = assignment.mistake(&found.id)?.program(found.form)?;
    Some(assignment.computed_by(program, probes).into_iter().map(|(colour, _)| colour).collect())
}
