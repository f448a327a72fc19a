//! From triangles in clip space to pixels, by OpenGL's rules, in f64.
//!
//! Clipping to -w ≤ x, y, z ≤ w (OpenGL 4.1 core, 2.20), culling by the area in the window (3.6.1), perspective-correct
//! interpolation (3.6.1), the depth test (4.1.5), pixels sampled at their centres, ties by the top-left rule, 8 bits a channel
//! without sRGB. What is drawn is known before anything is shaded: [`Visible`] says which triangle each pixel shows.

mod contour;
mod outline;
mod setup;
mod visible;

pub use setup::{Ramp, Setup};
pub use visible::{Surface, Visible, depth_map};

use glam::{DVec3, DVec4};

/// A vertex after the vertex shader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipVertex {
    /// Position in clip space.
    pub position: DVec4,
    /// The colour that is interpolated.
    pub colour: DVec3,
}

/// Where a pixel's centre lies with respect to what is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Coverage {
    /// Outside it, by every rasteriser.
    Outside,
    /// Inside it, by every rasteriser.
    Interior,
    /// So near an edge, or near where one thing stands before another, that a rasteriser's rounding may decide.
    Silhouette,
}

/// A picture, top row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// RGBA, 8 bits a channel, linear; what is drawn is opaque.
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
}

/// Eight bits a channel: clamped to [0, 1] and rounded to the nearest (OpenGL 4.1 core, 2.1.5); opaque. NaN becomes 0.
pub(crate) fn quantised(colour: [f64; 3]) -> [u8; 4] {
    // A cast from float saturates and takes NaN to 0.
    let [red, green, blue] = colour.map(|x| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
    [red, green, blue, 255]
}

#[cfg(test)]
mod tests;
