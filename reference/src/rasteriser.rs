//! From a triangle in clip space to pixels, by OpenGL's rules, in f64.
//!
//! Clipping to -w ≤ x, y, z ≤ w (OpenGL 4.1 core, 2.20), perspective-correct interpolation (3.6.1), pixels sampled at their
//! centres, ties by the top-left rule, 8 bits a channel without sRGB.

use glam::{DVec2, DVec3, DVec4};

/// A vertex after the vertex shader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipVertex {
    /// Position in clip space.
    pub position: DVec4,
    /// The colour that is interpolated.
    pub colour: DVec3,
}

/// Where a pixel's centre lies with respect to the drawn, clipped triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Coverage {
    /// Outside it, by every rasteriser.
    Outside,
    /// Inside it, by every rasteriser.
    Interior,
    /// So near an edge that a rasteriser's rounding may decide.
    Silhouette,
}

/// A picture, top row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// RGBA, 8 bits a channel, linear.
    pub pixels: Vec<[u8; 4]>,
    /// Where each pixel lies.
    pub coverage: Vec<Coverage>,
}

/// How near an edge, in pixels, a centre is left to the rasteriser's rounding.
///
/// Rasterisers snap vertices to a grid: llvmpipe to 1/256 pixel, and Vulkan and OpenGL allow no coarser one than 1/16. Rounding
/// to 1/16 moves a vertex, and with it an edge, by at most half a cell's diagonal, √2/32 = 0.044 pixels. The f32 of a viewport
/// 640 pixels wide adds 640 × 2⁻²³ < 0.0001. A wrong matrix moves an edge by whole pixels.
pub const SILHOUETTE_DISTANCE: f64 = 1.0 / 16.0;

impl Frame {
    /// A picture of one colour.
    pub fn cleared(width: u32, height: u32, background: [u8; 4]) -> Self {
        let count = width as usize * height as usize;
        Self { width, height, pixels: vec![background; count], coverage: vec![Coverage::Outside; count] }
    }

    /// Draws a triangle over what is there. A vertex that is not finite draws nothing.
    pub fn draw(&mut self, triangle: &[ClipVertex; 3]) {
        if triangle.iter().any(|v| !v.position.is_finite()) {
            return;
        }
        let outline = self.outline(triangle);
        if outline.len() < 3 {
            return;
        }
        let ramp = Ramp::new(triangle);
        self.fill(&outline, &ramp);
        for (i, a) in outline.iter().enumerate() {
            self.mark(*a, outline[(i + 1) % outline.len()]);
        }
    }

    /// The clipped triangle in window coordinates, in pixels, y downwards.
    fn outline(&self, triangle: &[ClipVertex; 3]) -> Vec<DVec2> {
        let size = DVec2::new(f64::from(self.width), f64::from(self.height));
        clip(triangle.map(|v| v.position).to_vec())
            .into_iter()
            .filter(|p| p.w > 0.0)
            .map(|p| DVec2::new((p.x / p.w + 1.0) / 2.0 * size.x, (1.0 - p.y / p.w) / 2.0 * size.y))
            .collect()
    }

    /// Paints the pixels whose centres lie inside.
    fn fill(&mut self, outline: &[DVec2], ramp: &Ramp) {
        let (top, bottom) = extent(outline.iter().map(|p| p.y));
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        for row in pixels(top, bottom, self.height) {
            let y = row as f64 + 0.5;
            let Some((left, right)) = span(outline, y) else {
                continue;
            };
            let ndc_y = 1.0 - 2.0 * y / height;
            let line = row * self.width as usize;
            for column in pixels(left, right, self.width) {
                let ndc_x = 2.0 * (column as f64 + 0.5) / width - 1.0;
                self.pixels[line + column] = quantised(ramp.colour(ndc_x, ndc_y));
                self.coverage[line + column] = Coverage::Interior;
            }
        }
    }

    /// Marks the pixels whose centres lie near the edge from `a` to `b`.
    fn mark(&mut self, a: DVec2, b: DVec2) {
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
                self.coverage[line + column] = Coverage::Silhouette;
            }
        }
    }
}

/// Indices of the pixels of a row or column whose centres lie in [from, to), within the window.
fn pixels(from: f64, to: f64, size: u32) -> std::ops::Range<usize> {
    // A cast from float saturates, so that what lies outside the window ends at its border.
    let index = |x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(size as usize);
    index(from)..index(to)
}

fn extent(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let wider = |(lo, hi): (f64, f64), x: f64| (lo.min(x), hi.max(x));
    values.into_iter().fold(start, wider)
}

/// Where the horizontal line at `y` enters and leaves the convex outline.
///
/// An edge takes part for its upper end ≤ y < its lower end; together with [from, to) along the row this is the top-left rule.
fn span(outline: &[DVec2], y: f64) -> Option<(f64, f64)> {
    let crossing = |(i, a): (usize, &DVec2)| {
        let b = &outline[(i + 1) % outline.len()];
        // Upper end first: two triangles that share an edge find the same number.
        let (upper, lower) = if (a.y, a.x) <= (b.y, b.x) { (a, b) } else { (b, a) };
        let crosses = upper.y <= y && y < lower.y;
        crosses.then(|| upper.x + (y - upper.y) * ((lower.x - upper.x) / (lower.y - upper.y)))
    };
    let (left, right) = extent(outline.iter().enumerate().filter_map(crossing));
    (left < right).then_some((left, right))
}

/// Sutherland and Hodgman: one plane of the view volume after the other.
fn clip(mut polygon: Vec<DVec4>) -> Vec<DVec4> {
    let planes: [fn(&DVec4) -> f64; 6] =
        [|p| p.w + p.z, |p| p.w - p.z, |p| p.w + p.x, |p| p.w - p.x, |p| p.w + p.y, |p| p.w - p.y];
    for distance in planes {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, a) in polygon.iter().enumerate() {
            let b = &polygon[(i + 1) % polygon.len()];
            let (da, db) = (distance(a), distance(b));
            if da >= 0.0 {
                kept.push(*a);
            }
            if (da >= 0.0) != (db >= 0.0) {
                kept.push(*a + (*b - *a) * (da / (da - db)));
            }
        }
        polygon = kept;
    }
    polygon
}

/// Colour over the plane of a triangle, perspective-correct.
///
/// With qᵢ = (xᵢ, yᵢ, wᵢ) a point (x, y, 1) of the picture is Σ bᵢ qᵢ for bᵢ = (qⱼ × qₖ) · (x, y, 1) up to a common factor, and
/// bᵢ / Σ b are the weights on the triangle itself (Olano and Greer, "Triangle scan conversion using 2D homogeneous
/// coordinates", 1997). No vertex needs to lie in front of the eye for it.
struct Ramp {
    colour: [DVec3; 3],
    weight: DVec3,
}

impl Ramp {
    fn new(triangle: &[ClipVertex; 3]) -> Self {
        let q = triangle.map(|v| DVec3::new(v.position.x, v.position.y, v.position.w));
        let b = [q[1].cross(q[2]), q[2].cross(q[0]), q[0].cross(q[1])];
        let sum = |weigh: &dyn Fn(usize) -> DVec3| (0..3).map(weigh).sum::<DVec3>();
        Self {
            // One row for x, one for y, one for 1.
            colour: [0, 1, 2].map(|axis| sum(&|i| triangle[i].colour * b[i][axis])),
            weight: sum(&|i| b[i]),
        }
    }

    fn colour(&self, x: f64, y: f64) -> DVec3 {
        let weight = self.weight.x * x + self.weight.y * y + self.weight.z;
        (self.colour[0] * x + self.colour[1] * y + self.colour[2]) / weight
    }
}

/// Eight bits a channel: clamped to [0, 1] and rounded to the nearest (OpenGL 4.1 core, 2.1.5); opaque. NaN becomes 0.
fn quantised(colour: DVec3) -> [u8; 4] {
    // A cast from float saturates and takes NaN to 0.
    let channel = |x: f64| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    [channel(colour.x), channel(colour.y), channel(colour.z), 255]
}

#[cfg(test)]
mod tests;
