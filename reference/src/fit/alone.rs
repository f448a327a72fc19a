//! Which terms of a shader are right although nothing known explains the whole: by the direction of their colour.
//!
//! A term is a number times a constant colour, K ⊗ L. So if all terms but one are right, what is left of a sample after
//! the right ones are taken away is a multiple of that one's colour, whatever number the shader computes for it.

use crate::assignment::RubricLine;
use crate::probes::ProbeSet;
use crate::{Assignment, equation::COLOUR};
use glam::DVec3;

/// A term's right values at all probes.
pub(super) struct Term<'a> {
    pub line: &'a RubricLine,
    pub values: Vec<DVec3>,
}

/// The terms that the rubric judges, in its order.
pub(super) fn terms<'a>(assignment: &'a Assignment, probes: &ProbeSet) -> Vec<Term<'a>> {
    let right = assignment.equation.right();
    let lines = assignment.rubric.iter().filter(|line| !line.alone_in.is_empty() && line.judges != COLOUR);
    lines
        .map(|line| Term {
            line,
            values: probes
                .iter()
                .map(|probe| {
                    let outcome = right.evaluate(probes.uniforms(probe), &probe.attributes);
                    outcome.get(&line.judges).map_or(DVec3::NAN, |value| value.vec3())
                })
                .collect(),
        })
        .collect()
}

/// The only term that is wrong, if all others can be right.
///
/// Of two terms of one colour the first is to blame only if what it leaves is the same everywhere, as it should be.
pub(super) fn only_wrong(terms: &[Term<'_>], probes: &ProbeSet, samples: &[DVec3], tolerance: f64) -> Option<usize> {
    (0..terms.len()).find(|&index| {
        let term = &terms[index];
        let Some(direction) = direction(term) else { return false };
        let rest: Vec<DVec3> =
            usable(samples).map(|place| samples[place] - (probes.probes[place].colour - term.values[place])).collect();
        if rest.len() * 2 < samples.len() {
            return false;
        }
        let along = rest.iter().all(|r| (*r - direction * r.dot(direction)).abs().max_element() <= tolerance);
        let constant = term.values.iter().all(|value| (*value - term.values[0]).abs().max_element() <= tolerance);
        along && (!constant || rest.iter().all(|r| (*r - rest[0]).abs().max_element() <= tolerance))
    })
}

/// Whether a term is right in the channels that no other term reaches; `None` if it has none of its own.
pub(super) fn right_in_its_channels(
    terms: &[Term<'_>],
    index: usize,
    probes: &ProbeSet,
    samples: &[DVec3],
    tolerance: f64,
) -> Option<bool> {
    let reaches = |term: &Term<'_>, channel: usize| term.values.iter().any(|value| value[channel].abs() > tolerance);
    let others =
        |channel: usize| terms.iter().enumerate().any(|(other, term)| other != index && reaches(term, channel));
    let own: Vec<usize> = (0..3).filter(|c| reaches(&terms[index], *c) && !others(*c)).collect();
    let agrees = |place: usize, channel: usize| {
        (samples[place][channel] - probes.probes[place].colour[channel]).abs() <= tolerance
    };
    (!own.is_empty()).then(|| (0..samples.len()).all(|place| own.iter().all(|channel| agrees(place, *channel))))
}

/// The unit vector of a term's colour.
fn direction(term: &Term<'_>) -> Option<DVec3> {
    let strongest = term.values.iter().copied().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
    strongest.try_normalize()
}

fn usable(samples: &[DVec3]) -> impl Iterator<Item = usize> {
    samples.iter().enumerate().filter(|(_, sample)| sample.is_finite()).map(|(place, _)| place)
}
