//! Which known mistakes explain what a shader computed at the probes.
//!
//! The combination with the fewest mistakes that reproduces every sample wins; of equals the one with the fewest free parameters,
//! then the one that touches the fewest lines of the rubric, then the first in the assignment's table. What nothing explains is judged term by term, where a term stands alone.

mod alternatives;
mod candidates;
mod columns;
mod derived;
mod digits;
mod factor;
mod features;
mod parts;
mod programs;
mod search;
mod slips;
mod solve;
mod taste;
mod terms;
mod views;

pub use alternatives::Alternatives;
pub use derived::explain_derived;
pub use factor::judge_factor;
pub use features::{FEWEST, Footprints, JudgedLine, ProbeChannel, alike, judge_features, programs_showing};
pub use parts::{FeatureDefect, FeatureExplanation, explain_parts};
pub use programs::programs_of;
pub use slips::explain_moved;
pub use terms::{TermJudgement, Worst};

use crate::Assignment;
use crate::accepted::Computed;
use crate::mistake::FoundMistake;
use crate::probes::{Probe, ProbeSet};
use glam::DVec3;
use std::ops::RangeInclusive;

/// How many mistakes are looked for at once.
pub const MOST_MISTAKES: usize = 3;

/// A tolerance for [`explain`] that suits f32 drivers: half a step of 8 bits, which nobody sees.
///
/// Measured on Mesa's OpenGL driver (llvmpipe) at 560 probes: the right answer is off by 4.3e-6 at most, each of the 132 forms
/// in ggsample06's table by 2.4e-5. The tests hold every two mistakes ten times this tolerance apart.
pub const TOLERANCE: f64 = 2e-3;

/// What the samples say.
#[derive(Clone, Debug, PartialEq)]
pub enum Fit {
    /// The equation with these mistakes in it reproduces every sample; with none, the answer is right.
    Explained(Vec<FoundMistake>),
    /// No combination does: the rubric's terms, judged where they stand alone.
    Unexplained(Vec<TermJudgement>),
}

impl Fit {
    /// Whether every sample is right.
    pub fn is_right(&self) -> bool {
        matches!(self, Self::Explained(found) if found.is_empty())
    }
}

/// Looks for the mistakes that explain `samples`: red, green and blue at each probe, in the probes' order. The probes are the
/// assignment's own ([`Assignment::reprobe`] makes them so).
///
/// A channel agrees if it is within `tolerance` of what is expected, relative to what is expected where that is over 1. Where
/// GLSL leaves the expected value undefined (`pow` of a negative base is NaN on real drivers), only what is not finite agrees;
/// a sample that is missing counts as NaN.
pub fn explain(assignment: &Assignment, probes: &ProbeSet, samples: &[[f64; 3]], tolerance: f64) -> Fit {
    explain_by(1..=MOST_MISTAKES, assignment, probes, samples, tolerance)
}

/// The same with so many mistakes at once.
pub fn explain_by(
    counts: RangeInclusive<usize>,
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    tolerance: f64,
) -> Fit {
    let samples = padded(probes, samples);
    let is_right = |place: &usize| agrees(probes.probes[*place].colour, samples[*place], tolerance);
    let (rest, wrong): (Vec<_>, Vec<_>) = (0..samples.len()).partition(is_right);
    if wrong.is_empty() {
        return Fit::Explained(Vec::new());
    }
    let order = alternating(&wrong, &rest);
    match search::search(assignment, probes, &samples, &order, tolerance, counts) {
        Some(found) => Fit::Explained(found),
        None => Fit::Unexplained(terms::judge(assignment, probes, &samples, tolerance)),
    }
}

/// The rubric's terms, judged where they stand alone; for samples that are not all right. The arguments are those of
/// [`explain`].
pub fn judge_terms(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    tolerance: f64,
) -> Vec<TermJudgement> {
    terms::judge(assignment, probes, &padded(probes, samples), tolerance)
}

/// Whether every sample is what is right at its probe, see [`explain`].
pub fn is_right(probes: &ProbeSet, samples: &[[f64; 3]], tolerance: f64) -> bool {
    let samples = padded(probes, samples);
    probes.iter().zip(samples).all(|(probe, sample)| agrees(probe.colour, sample, tolerance))
}

/// Which samples are not reproduced: by what is right at the probes where `found` is empty, else by the equation with these
/// mistakes in it, see [`explain`].
pub fn contradicted(
    assignment: &Assignment,
    found: &[FoundMistake],
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    tolerance: f64,
) -> Vec<bool> {
    let variant = assignment.variant(found);
    let expected = |probe: &Probe| match &variant {
        _ if found.is_empty() => Some(probe.colour),
        Some(variant) => Some(variant.evaluate(probes.uniforms(probe), &probe.attributes).colour()),
        None => None,
    };
    let samples = padded(probes, samples);
    // A whole file in place of the solution has nothing to be put into.
    let of_texts = || taste::contradicted_but_for_taste(assignment, found, probes, &samples, &|_, _| true, tolerance);
    if let Some(contradicted) = (!found.is_empty()).then(of_texts).flatten() {
        return contradicted;
    }
    if let Some(shown) = features::shown_with(assignment, found, probes) {
        return shown.iter().zip(samples).map(|(shown, sample)| !agrees(*shown, sample, tolerance)).collect();
    }
    let pairs = probes.iter().zip(samples);
    pairs.map(|(probe, sample)| !expected(probe).is_some_and(|expected| agrees(expected, sample, tolerance))).collect()
}

/// At how many probes a mistake shows something else than a right answer, or elsewhere.
pub fn showing(assignment: &Assignment, found: &FoundMistake, probes: &ProbeSet, tolerance: f64) -> usize {
    let found = std::slice::from_ref(found);
    let shown: Vec<Computed> = match (assignment.together(found, &[]), assignment.variant(found)) {
        (Some(answer), _) => assignment.computed_by(&answer, probes),
        (None, Some(variant)) => {
            let outcome = |probe: &Probe| variant.evaluate(probes.uniforms(probe), &probe.attributes);
            probes.iter().map(|probe| (outcome(probe).colour(), outcome(probe).position())).collect()
        }
        (None, None) => return 0,
    };
    let differs = |(probe, (colour, position)): &(&Probe, Computed)| {
        !agrees(probe.colour, *colour, tolerance) || (probe.position - *position).abs().max_element() > tolerance
    };
    probes.iter().zip(shown).filter(differs).count()
}

/// A sample for each probe.
fn padded(probes: &ProbeSet, samples: &[[f64; 3]]) -> Vec<DVec3> {
    let given = samples.iter().map(|s| DVec3::from_array(*s));
    given.chain(std::iter::repeat(DVec3::NAN)).take(probes.probes.len()).collect()
}

/// Wrong and right places in turn: an explanation must explain the ones and leave the others, and most candidates fail soon at
/// either.
fn alternating(wrong: &[usize], rest: &[usize]) -> Vec<usize> {
    let both = wrong.len().min(rest.len());
    let pairs = wrong.iter().zip(rest).flat_map(|(w, r)| [*w, *r]);
    let tail = wrong[both..].iter().chain(&rest[both..]).copied();
    pairs.chain(tail).collect()
}

/// From here on a value is as good as infinite: f32 ends at 3.4e38, and a driver may overflow on the way to it.
const OVERFLOWING: f64 = 1e36;

/// Whether a sample is what is expected, see [`explain`].
pub(crate) fn agrees(expected: DVec3, sample: DVec3, tolerance: f64) -> bool {
    (0..3).all(|channel| channel_agrees(expected[channel], sample[channel], tolerance))
}

pub(crate) fn channel_agrees(expected: f64, sample: f64, tolerance: f64) -> bool {
    if expected.is_nan() {
        !sample.is_finite()
    } else if expected.abs() > OVERFLOWING {
        sample.is_nan() || sample.abs() > OVERFLOWING / 10.0
    } else {
        (sample - expected).abs() <= tolerance * expected.abs().max(1.0)
    }
}
