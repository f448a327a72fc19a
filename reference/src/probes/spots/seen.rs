//! Where in the window a fragment of a triangle lies.

use super::FragmentChoice;
use glam::{DMat3, DVec2, DVec3, DVec4};

/// The share of each end of a triangle at a place in a window, in pixels; `None` where it is not before the eye.
pub(super) fn weights_at(ends: [DVec4; 3], place: [f64; 2], window: [f64; 2]) -> Option<[f64; 3]> {
    let [x, y] = (DVec2::from(place) / DVec2::from(window) * 2.0 - 1.0).to_array();
    let rows = ends.map(|end| DVec3::new(end.x - x * end.w, end.y - y * end.w, 1.0));
    let shares = DMat3::from_cols(rows[0], rows[1], rows[2]).inverse() * DVec3::Z;
    let w = shares.dot(DVec3::from(ends.map(|end| end.w)));
    (shares.is_finite() && w > 0.0).then(|| shares.to_array())
}

/// Where a fragment lies: the shares, moved so that it is in the middle of a pixel, `gl_FragCoord`, and whether it is of the
/// front. None where a corner is not before the eye, or where it is cut off by the near or far plane.
pub(super) fn seen_at(
    ends: [DVec4; 3],
    weights: [f64; 3],
    window: [f64; 2],
    taken: FragmentChoice,
) -> Option<([f64; 3], [f64; 4], bool)> {
    if !ends.iter().all(|end| end.is_finite() && end.w > 1e-3) {
        return None;
    }
    let at = |weights: [f64; 3]| ends.iter().zip(weights).map(|(end, weight)| *end * weight).sum::<DVec4>();
    let seen = |p: DVec4| (p.truncate().truncate() / p.w + 1.0) / 2.0 * DVec2::from(window);
    let middle = seen(at(weights)).floor() + 0.5;
    let within = weights_at(ends, middle.to_array(), window)
        .filter(|weights| taken != FragmentChoice::FrontInPlace && weights.iter().all(|share| *share >= 0.0));
    let place = within.map_or_else(|| seen(at(weights)), |_| middle);
    let weights = within.unwrap_or(weights);
    let p = at(weights);
    let [a, b, c] = ends.map(|end| end.truncate().truncate() / end.w);
    let is_front = (b - a).perp_dot(c - a) > 0.0;
    let depth = (p.z / p.w + 1.0) / 2.0;
    if !(0.0..=1.0).contains(&depth) {
        return None;
    }
    Some((weights, [place.x, place.y, depth, p.w.recip()], is_front))
}
