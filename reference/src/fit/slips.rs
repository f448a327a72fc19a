//! Derived mistakes that are programs of their own, by all that is seen of them.

use super::{agrees, padded};
use crate::Assignment;
use crate::accepted::Computed;
use crate::derived::{Derived, definition};
use crate::mistake::FoundMistake;
use crate::pipeline::POSITION;
use crate::probes::ProbeSet;
use glam::DVec4;

/// Looks for a derived mistake by which everything stands where it is seen, where the colours are right.
///
/// `is_there`: whether a sample's position is a given one.
pub fn explain_moved(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> Option<FoundMistake> {
    let samples = padded(probes, samples);
    let shows = |place: usize, (colour, position): &Computed| {
        // What is drawn nowhere is nowhere in particular.
        position.is_finite() && agrees(*colour, samples[place], tolerance) && is_there(place, *position)
    };
    // Of the position itself the homework has its own words.
    let is_before_it = |found: &FoundMistake| definition(&found.id) != Some(POSITION);
    program(assignment.derived(), probes, &shows, &is_before_it)
}

/// So many programs are run at all probes, where the first ones do not tell them apart.
const MOST_PROGRAMS: usize = 40;

/// The first of some programs that shows at every probe what is shown there.
pub(super) fn program(
    derived: &Derived,
    probes: &ProbeSet,
    shows: &dyn Fn(usize, &Computed) -> bool,
    is_one: &dyn Fn(&FoundMistake) -> bool,
) -> Option<FoundMistake> {
    let likely = derived.likely(probes, shows).into_iter().filter(is_one).take(MOST_PROGRAMS);
    let is_it = |found: &FoundMistake| {
        let shown = derived.shown(found, probes);
        shown.is_some_and(|shown| shown.iter().enumerate().all(|(place, own)| shows(place, own)))
    };
    likely.into_iter().find(is_it)
}
