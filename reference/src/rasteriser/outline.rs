//! The part of a triangle that lies in the view volume, as a polygon in the window.

use glam::{DVec2, DVec4};

/// A corner in window coordinates, in pixels, y downwards, and the edge that goes on from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    pub at: DVec2,
    pub edge: OutlineEdge,
}

/// An edge of an outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OutlineEdge {
    /// The triangle's own: from this vertex to the next.
    Own(usize),
    /// Where the view volume cuts it.
    Cut,
}

/// The clipped triangle.
pub(super) fn outline(positions: [DVec4; 3], [width, height]: [f64; 2]) -> Vec<Corner> {
    let corner = |(p, edge): (DVec4, OutlineEdge)| Corner {
        at: DVec2::new((p.x / p.w + 1.0) / 2.0 * width, (1.0 - p.y / p.w) / 2.0 * height),
        edge,
    };
    clip(positions).into_iter().filter(|(p, _)| p.w > 0.0).map(corner).collect()
}

/// Twice the area, positive where the corners run against the clock as one sees them.
pub(super) fn area(outline: &[Corner]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    // The window's y points downwards.
    -outline.iter().zip(next).map(|(a, b)| a.at.perp_dot(b.at)).sum::<f64>()
}

/// Sutherland and Hodgman: one plane of the view volume after the other.
fn clip(positions: [DVec4; 3]) -> Vec<(DVec4, OutlineEdge)> {
    let planes: [fn(&DVec4) -> f64; 6] =
        [|p| p.w + p.z, |p| p.w - p.z, |p| p.w + p.x, |p| p.w - p.x, |p| p.w + p.y, |p| p.w - p.y];
    let mut polygon: Vec<_> = positions.into_iter().enumerate().map(|(at, p)| (p, OutlineEdge::Own(at))).collect();
    if planes.iter().all(|distance| polygon.iter().all(|(p, _)| distance(p) >= 0.0)) {
        return polygon;
    }
    for distance in planes {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, (a, edge)) in polygon.iter().enumerate() {
            let (b, _) = &polygon[(i + 1) % polygon.len()];
            let (da, db) = (distance(a), distance(b));
            let crossing = || *a + (*b - *a) * (da / (da - db));
            match (da >= 0.0, db >= 0.0) {
                (true, true) => kept.push((*a, *edge)),
                (true, false) => kept.extend([(*a, *edge), (crossing(), OutlineEdge::Cut)]),
                (false, true) => kept.push((crossing(), *edge)),
                (false, false) => {}
            }
        }
        polygon = kept;
    }
    polygon
}

/// Indices of the pixels of a row or column whose centres lie in [from, to), within the window.
pub(super) fn pixels(from: f64, to: f64, size: u32) -> std::ops::Range<usize> {
    // A cast from float saturates, so that what lies outside the window ends at its border.
    let index = |x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(size as usize);
    index(from)..index(to)
}

pub(super) fn extent(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let wider = |(lo, hi): (f64, f64), x: f64| (lo.min(x), hi.max(x));
    values.into_iter().fold(start, wider)
}

/// Where the horizontal line at `y` enters and leaves the convex outline.
///
/// An edge takes part for its upper end ≤ y < its lower end; together with [from, to) along the row this is the top-left rule.
pub(super) fn span(outline: &[Corner], y: f64) -> Option<(f64, f64)> {
    let crossing = |(i, a): (usize, &Corner)| {
        let (a, b) = (&a.at, &outline[(i + 1) % outline.len()].at);
        // Upper end first: two triangles that share an edge find the same number.
        let (upper, lower) = if (a.y, a.x) <= (b.y, b.x) { (a, b) } else { (b, a) };
        let crosses = upper.y <= y && y < lower.y;
        crosses.then(|| upper.x + (y - upper.y) * ((lower.x - upper.x) / (lower.y - upper.y)))
    };
    let (left, right) = extent(outline.iter().enumerate().filter_map(crossing));
    (left < right).then_some((left, right))
}
