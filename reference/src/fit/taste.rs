//! What a mistaken answer shows, but for what is a matter of taste: it has the freedom that a right answer has.

use super::{FEWEST, agrees};
use crate::Assignment;
use crate::accepted::Computed;
use crate::derived::FIRST;
use crate::mistake::FoundMistake;
use crate::probes::ProbeSet;
use glam::{DVec3, DVec4};

/// Taste decides at fewer samples than this share of all: of a right answer with as much freedom as it may have it is a tenth.
const MOST_OF_TASTE: f64 = 0.4;

/// A position for each probe, and whether the sample there has it.
type IsThere<'e> = dyn Fn(usize, DVec4) -> bool + 'e;

/// What a program shows at probes, and what samples are not that.
struct ProbeComparison {
    own: Vec<Computed>,
    contradicted: Vec<bool>,
    /// Where taste decides what is shown.
    is_open: Vec<bool>,
}

impl ProbeComparison {
    fn of(assignment: &Assignment, found: &[FoundMistake], probes: &ProbeSet, samples: &Samples<'_>) -> Option<Self> {
        let own = assignment.computed_by(&assignment.together(found, &[])?, probes);
        let contradicted = own.iter().enumerate().map(|(at, own)| !samples.show(at, own)).collect();
        Some(Self { is_open: vec![false; own.len()], own, contradicted })
    }

    /// What lies between what is shown and what is shown with something in it that is not judged, contradicts nothing.
    fn spare_taste(
        &mut self,
        assignment: &Assignment,
        found: &[FoundMistake],
        probes: &ProbeSet,
        samples: &Samples<'_>,
    ) {
        for taste in &assignment.unjudged {
            let Some(program) = assignment.together(found, &[taste]) else { continue };
            for (at, (other, _)) in assignment.computed_by(&program, probes).into_iter().enumerate() {
                let (colour, position) = self.own[at];
                if !agrees(colour, other, samples.tolerance) {
                    self.is_open[at] = true;
                    self.contradicted[at] &= !samples.lie_between(at, [colour.min(other), colour.max(other)], position);
                }
            }
        }
    }
}

/// What samples show.
struct Samples<'e> {
    colours: &'e [DVec3],
    /// Whether a sample's position is a given one.
    is_there: &'e IsThere<'e>,
    tolerance: f64,
}

impl Samples<'_> {
    fn show(&self, at: usize, (colour, position): &Computed) -> bool {
        agrees(*colour, self.colours[at], self.tolerance) && (self.is_there)(at, *position)
    }

    fn lie_between(&self, at: usize, [least, most]: [DVec3; 2], position: DVec4) -> bool {
        let colour = self.colours[at];
        let is_between = colour.cmpge(least - self.tolerance).all() && colour.cmple(most + self.tolerance).all();
        is_between && (self.is_there)(at, position)
    }

    /// Whether some of the first probes contradict these mistakes whatever the taste.
    fn contradict_at_first(&self, assignment: &Assignment, found: &[FoundMistake], probes: &ProbeSet) -> bool {
        let (places, first) = probes.part(FIRST);
        let colours: Vec<DVec3> = places.iter().map(|place| self.colours[*place]).collect();
        let is_there = |at: usize, position| (self.is_there)(places[at], position);
        let samples = Samples { colours: &colours, is_there: &is_there, tolerance: self.tolerance };
        let Some(mut compared) = ProbeComparison::of(assignment, found, &first, &samples) else { return true };
        if compared.contradicted.contains(&true) {
            compared.spare_taste(assignment, found, &first, &samples);
        }
        compared.contradicted.contains(&true)
    }
}

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
    let of_samples = Samples { colours: samples, is_there, tolerance };
    let mut compared = ProbeComparison::of(assignment, found, probes, &of_samples)?;
    let count = compared.contradicted.iter().filter(|contradicted| **contradicted).count();
    if count == 0 || count as f64 > MOST_OF_TASTE * samples.len() as f64 {
        return Some(compared.contradicted);
    }
    compared.spare_taste(assignment, found, probes, &of_samples);
    // Where nothing is open the mistake has to show, or else anything would be explained.
    let ProbeComparison { own, contradicted, is_open } = compared;
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
    let of_samples = Samples { colours: samples, is_there, tolerance };
    !of_samples.contradict_at_first(assignment, found, probes)
        && contradicted_but_for_taste(assignment, found, probes, samples, is_there, tolerance)
            .is_some_and(|contradicted| !contradicted.contains(&true))
}
