//! Where a wrong answer is followed: the places that show most of what is wrong, and one that is right.

use crate::diagnose::Evidence;
use crate::diagnose::columns::is_colour;
use crate::diagnose::trials::{FUEL_OF_TRACE, chosen, place};
use glam::DVec3;
use reference::probes::Pictured;
use reference::traced::{Bench, Place, TracedProgram};

/// So many places that differ are shown, and one that does not.
const MOST_WRONG: usize = 3;

/// Places that are nearer to one another, as a share of the picture's sides, show the same thing.
const APART: f64 = 0.03;

/// A place that is shown.
pub(super) struct ShownPlace<'p> {
    pub place: Place<'p>,
    pub at: Option<[f64; 2]>,
    pub pixel: Option<[u32; 2]>,
    pub is_right: bool,
}

/// The places of a picture where the answer is furthest from what is right, and one where it is right.
pub(super) fn shown_in<'p>(evidence: &Evidence<'_>, pictured: &'p [Pictured]) -> Vec<ShownPlace<'p>> {
    let places: Vec<Place<'p>> =
        pictured.iter().map(|one| Place { probe: &one.probe, uniforms: &one.uniforms }).collect();
    let Some(apart) = apart(evidence, &places) else { return Vec::new() };
    let mut order: Vec<usize> = (0..pictured.len()).collect();
    order.sort_by(|a, b| apart[*b].total_cmp(&apart[*a]).then(a.cmp(b)));
    let is_right = |at: &usize| apart[*at] <= 0.0;
    let is_near = |a: usize, b: usize| {
        let [a, b] = [pictured[a].at, pictured[b].at];
        (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < APART
    };
    let mut chosen: Vec<usize> = Vec::new();
    for at in order.iter().copied().filter(|at| !is_right(at)) {
        if chosen.len() < MOST_WRONG && !chosen.iter().any(|other| is_near(at, *other)) {
            chosen.push(at);
        }
    }
    chosen.extend((0..pictured.len()).find(is_right));
    let shown = |at: usize| ShownPlace {
        place: places[at],
        at: Some(pictured[at].at),
        pixel: pictured[at].pixel,
        is_right: is_right(&at),
    };
    chosen.into_iter().map(shown).collect()
}

/// How far the colour is from the right one at each place, as it is seen; 0 where it is right.
fn apart(evidence: &Evidence<'_>, places: &[Place<'_>]) -> Option<Vec<f64>> {
    if places.is_empty() {
        return None;
    }
    let (theirs, assignment) = (evidence.traced?, evidence.assignment);
    let solution = assignment.traced_solution()?;
    let in_quads = theirs.needs_quads(assignment) || solution.needs_quads(assignment);
    let seen = |program: &TracedProgram| {
        Some(Bench::new(assignment, program, places, in_quads, FUEL_OF_TRACE)?.with(&Default::default())?.colours)
    };
    let (own, right) = (seen(theirs)?, seen(solution)?);
    let apart = |(own, right): (&DVec3, &DVec3)| match is_colour(*right, *own) {
        true => 0.0,
        // What is no number is as far off as can be.
        false if !own.is_finite() => f64::INFINITY,
        false => (own.clamp(DVec3::ZERO, DVec3::ONE) - right.clamp(DVec3::ZERO, DVec3::ONE)).abs().max_element(),
    };
    Some(own.iter().zip(&right).map(apart).collect())
}

/// Some of the probes that are wrong, and one that is right.
pub(super) fn shown_of_probes<'e>(evidence: &Evidence<'e>) -> Option<Vec<ShownPlace<'e>>> {
    let chosen = chosen(evidence);
    let places: Vec<Place<'e>> = chosen.iter().map(|at| place(evidence, *at)).collect();
    let apart = apart(evidence, &places)?;
    let shown = |at: usize| ShownPlace { place: places[at], at: None, pixel: None, is_right: apart[at] <= 0.0 };
    let mut order: Vec<usize> = (0..places.len()).filter(|at| apart[*at] > 0.0).collect();
    order.sort_by(|a, b| apart[*b].total_cmp(&apart[*a]).then(a.cmp(b)));
    order.truncate(MOST_WRONG);
    order.extend((0..places.len()).find(|at| apart[*at] <= 0.0));
    Some(order.into_iter().map(shown).collect())
}
