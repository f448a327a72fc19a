//! What is linear over the picture of a triangle.

use super::SILHOUETTE_DISTANCE;
use super::outline::Corner;
use crate::interpreter::Interpolation;
use glam::{DVec3, DVec4};

/// A drawn triangle, ready to be asked for what lies at a pixel.
///
/// With qᵢ = (xᵢ, yᵢ, wᵢ) a point (x, y, 1) of the picture is Σ bᵢ qᵢ for bᵢ = (qⱼ × qₖ) · (x, y, 1) up to a common factor, and
/// bᵢ / Σ b are the weights on the triangle itself (Olano and Greer, "Triangle scan conversion using 2D homogeneous
/// coordinates", 1997). No vertex needs to lie in front of the eye for it. The common factor is d = q₀ · (q₁ × q₂), so that
/// 1/w = Σ b / d and z/w = Σ bᵢ zᵢ / d are linear over the picture, and bᵢ wᵢ / d are the weights in the picture.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The surface that it belongs to.
    pub surface: u32,
    /// Its number there.
    pub triangle: u32,
    /// Whether its front is seen.
    pub is_front: bool,
    pub(super) outline: Vec<Corner>,
    weights: [DVec3; 3],
    w: DVec3,
    weight: DVec3,
    factor: f64,
    depth: DVec3,
    /// How much the depth changes over the distance that a rasteriser's rounding moves a surface by, and by its own rounding.
    pub(super) slack: f64,
}

/// The least step between depths of 24 bits, and of f32 from 0.5 to 1.
const LEAST_STEP: f64 = 1.0 / 16_777_216.0;

/// Depths of 24 bits or of f32, on the way from clip space: a few roundings of 2⁻²⁴.
const DEPTH_ROUNDING: f64 = 4e-7;

impl Setup {
    pub(super) fn new(
        [surface, triangle]: [u32; 2],
        positions: [DVec4; 3],
        outline: Vec<Corner>,
        is_front: bool,
        size: [f64; 2],
    ) -> Self {
        let q = positions.map(|p| DVec3::new(p.x, p.y, p.w));
        let weights = [q[1].cross(q[2]), q[2].cross(q[0]), q[0].cross(q[1])];
        let factor = q[0].dot(weights[0]);
        let sum = |of: &dyn Fn(usize) -> DVec3| (0..3).map(of).sum::<DVec3>();
        let depth = sum(&|i| weights[i] * positions[i].z) / factor;
        let mut depth = depth * 0.5;
        depth.z += 0.5;
        // A pixel is 2 / size of the picture.
        let slope = (depth.x * 2.0 / size[0]).abs() + (depth.y * 2.0 / size[1]).abs();
        Self {
            surface,
            triangle,
            is_front,
            outline,
            weights,
            w: DVec3::new(positions[0].w, positions[1].w, positions[2].w),
            weight: sum(&|i| weights[i]),
            factor,
            depth,
            slack: slope * SILHOUETTE_DISTANCE + DEPTH_ROUNDING,
        }
    }

    /// Moves its depths as `glPolygonOffset` does (OpenGL 4.1 core, 3.6.4): by a factor of the greater slope in a pixel, and by so many
    /// of the least steps that tell depths apart, each 2⁻²⁴.
    pub(super) fn offset(&mut self, [factor, units]: [f64; 2], size: [f64; 2]) {
        let slope = (self.depth.x * 2.0 / size[0]).abs().max((self.depth.y * 2.0 / size[1]).abs());
        self.depth.z += factor * slope + units * LEAST_STEP;
    }

    /// The depth at a place of the picture: 0 at the near plane, 1 at the far plane.
    pub fn depth(&self, x: f64, y: f64) -> f64 {
        at(self.depth, x, y)
    }

    /// 1/w at a place of the picture.
    pub fn reciprocal_w(&self, x: f64, y: f64) -> f64 {
        self.divisor(x, y) / self.factor
    }

    /// What a perspective-correct [`Ramp`] is divided by.
    pub fn divisor(&self, x: f64, y: f64) -> f64 {
        at(self.weight, x, y)
    }

    /// A number over the picture, from those of the vertices.
    pub fn ramp(&self, values: [f64; 3], interpolation: Interpolation) -> Ramp {
        let sum = |of: &dyn Fn(usize) -> DVec3| DVec3::ZERO + of(0) + of(1) + of(2);
        match interpolation {
            Interpolation::Smooth => Ramp { plane: sum(&|i| self.weights[i] * values[i]), is_divided: true },
            Interpolation::NoPerspective => {
                let plane = sum(&|i| self.weights[i] * (values[i] * self.w[i])) / self.factor;
                Ramp { plane, is_divided: false }
            }
            // The last vertex provokes.
            Interpolation::Flat => Ramp { plane: DVec3::new(0.0, 0.0, values[2]), is_divided: false },
        }
    }
}

/// A number over the picture.
#[derive(Clone, Copy, Debug)]
pub struct Ramp {
    plane: DVec3,
    is_divided: bool,
}

impl Ramp {
    /// The number at a place; `divisor` is that of the triangle there.
    pub fn at(&self, x: f64, y: f64, divisor: f64) -> f64 {
        let value = at(self.plane, x, y);
        if self.is_divided { value / divisor } else { value }
    }
}

fn at(plane: DVec3, x: f64, y: f64) -> f64 {
    plane.x * x + plane.y * y + plane.z
}
