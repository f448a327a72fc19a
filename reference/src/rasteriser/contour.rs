//! Where a rasteriser's rounding may decide: near the contours of what is drawn, and where two things are equally deep.

use super::outline::{OutlineEdge, extent, pixels};
use super::{Coverage, SILHOUETTE_DISTANCE, Setup, Surface, Visible};
use glam::DVec2;
use std::collections::HashMap;

impl Visible {
    /// Marks the pixels whose centres lie near a contour that is seen, or near where surfaces meet.
    pub(super) fn mark(&mut self, surfaces: &[Surface<'_>]) {
        self.contours = self.contours(surfaces);
        self.mark_contours();
    }

    /// The same once more, where other surfaces are seen.
    pub(super) fn mark_contours(&mut self) {
        let contours = std::mem::take(&mut self.contours);
        for (number, from, to) in &contours {
            self.mark_edge(*number, *from, *to);
        }
        self.contours = contours;
        for pixel in std::mem::take(&mut self.doubtful) {
            self.coverage[pixel as usize] = Coverage::Silhouette;
        }
    }

    /// Edges without a neighbour that goes on from them, with the place of their triangle.
    fn contours(&self, surfaces: &[Surface<'_>]) -> Vec<(usize, DVec2, DVec2)> {
        let mut contours = Vec::new();
        let ends = |setup: &Setup, from: usize| {
            let surface = &surfaces[setup.surface as usize];
            let corners = surface.triangles[setup.triangle as usize];
            let [a, b] = [corners[from], corners[(from + 1) % 3]].map(|vertex| surface.same[vertex as usize]);
            (setup.surface, a.min(b), a.max(b))
        };
        // How many triangles with the same side to the eye have an edge.
        let mut neighbours: HashMap<(u32, u32, u32), [u8; 2]> = HashMap::new();
        let is_joined = |setup: &&Setup| !surfaces[setup.surface as usize].is_faceted;
        if self.setups.len() > 1 {
            for setup in self.setups.iter().filter(is_joined) {
                for from in 0..3 {
                    let count = &mut neighbours.entry(ends(setup, from)).or_default()[usize::from(setup.is_front)];
                    *count = count.saturating_add(1);
                }
            }
        }
        for (number, setup) in self.setups.iter().enumerate() {
            for (place, corner) in setup.outline.iter().enumerate() {
                let goes_on = match corner.edge {
                    OutlineEdge::Own(from) if is_joined(&setup) => {
                        let sides = neighbours.get(&ends(setup, from)).copied().unwrap_or_default();
                        sides[usize::from(setup.is_front)] == 2 && sides[usize::from(!setup.is_front)] == 0
                    }
                    _ => false,
                };
                if !goes_on {
                    contours.push((number, corner.at, setup.outline[(place + 1) % setup.outline.len()].at));
                }
            }
        }
        contours
    }

    /// Marks the pixels whose centres lie near the edge from `a` to `b`, where nothing hides it.
    fn mark_edge(&mut self, number: usize, a: DVec2, b: DVec2) {
        let near = SILHOUETTE_DISTANCE;
        let along = b - a;
        let length = along.length();
        let (top, bottom) = extent([a.y, b.y]);
        let (left, right) = extent([a.x, b.x]);
        for row in pixels(top - near, bottom + near, self.height) {
            let y = row as f64 + 0.5;
            // The band |cross(along, p - a)| <= near × length, solved for x on this row.
            let (mut from, mut to) = (left - near, right + near);
            if along.y.abs() > f64::EPSILON * length {
                let middle = a.x + (y - a.y) * along.x / along.y;
                let reach = near * length / along.y.abs();
                from = from.max(middle - reach);
                to = to.min(middle + reach);
            }
            let line = row * self.width as usize;
            for column in pixels(from, to, self.width) {
                if self.is_seen(number, line + column, column as f64 + 0.5, y) {
                    self.coverage[line + column] = Coverage::Silhouette;
                }
            }
        }
    }

    /// Whether a triangle's edge is not hidden at a pixel: by what is nearer or, where nothing is tested, by what comes later.
    fn is_seen(&self, number: usize, pixel: usize, x: f64, y: f64) -> bool {
        let Some(other) = self.number(pixel).filter(|_| !self.is_open) else { return true };
        let setup = &self.setups[number];
        if self.tests[setup.surface as usize].is_none() || self.depths.is_empty() {
            return other as usize <= number;
        }
        let [x, y] = [2.0 * x / f64::from(self.width) - 1.0, 1.0 - 2.0 * y / f64::from(self.height)];
        setup.depth(x, y) <= self.depths[pixel] + setup.slack + self.setups[other as usize].slack
    }
}
