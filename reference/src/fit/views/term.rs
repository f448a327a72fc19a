//! A term by itself: its right values, and what is known of them.

use crate::assignment::RubricItem;
use glam::DVec3;

/// A right term below this does not show: far under half a step of 8 bits, also when its colour is wrong.
pub(super) const FAINT: f64 = 1e-6;

/// A term's right values at all probes.
pub(in crate::fit) struct TermValues<'a> {
    /// Its line's place in the rubric.
    pub(super) place: usize,
    pub line: &'a RubricItem,
    pub(super) values: Vec<DVec3>,
    /// The unit vector of its colour.
    pub(super) direction: DVec3,
    /// Its greatest length.
    pub(super) amplitude: f64,
    pub(super) is_constant: bool,
}

impl<'a> TermValues<'a> {
    pub(super) fn new(place: usize, line: &'a RubricItem, values: Vec<DVec3>) -> Self {
        let strongest = values.iter().copied().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let strongest = strongest.unwrap_or(DVec3::ZERO);
        let is_constant = values.iter().all(|value| (*value - strongest).abs().max_element() < FAINT);
        Self {
            place,
            line,
            values,
            direction: strongest.normalize_or_zero(),
            amplitude: strongest.length(),
            is_constant,
        }
    }
}
