//! Frames: how far they are from the right ones, and their pictures.

use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How one frame of the animation compares. Differences are in 1/255, over red, green and blue.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameResult {
    /// Fraction of the animation cycle, in [0, 1).
    pub t: f64,
    /// Pixels that one picture covers and the other does not, silhouette rounding left out.
    pub coverage_mismatches: u32,
    /// Largest difference of a channel.
    pub max_difference: f64,
    /// Mean difference of a channel over the pixels that either picture covers.
    pub mean_difference: f64,
    /// Pixels that differ by more than the tolerance.
    pub mismatched_pixels: u32,
}

impl FrameResult {
    /// Whether the frame is the expected one, within the tolerances.
    pub fn agrees(&self) -> bool {
        self.coverage_mismatches == 0 && self.mismatched_pixels == 0
    }
}

/// Alpha of a pixel of a right picture at which a rasteriser's rounding may decide whether it is painted: it is not
/// compared, and agrees. Alpha is not seen, so that no picture needs it for itself.
pub const SILHOUETTE: u8 = 127;

/// One 8-bit RGBA picture, top row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height * 4` bytes, linear, not sRGB-encoded.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// Its pixels row by row, RGBA.
    pub fn pixels(&self) -> &[[u8; 4]] {
        self.rgba.as_chunks().0
    }
}

/// The pictures of a grading: what was drawn beside what is expected, one pair a pose.
#[derive(Clone, Debug, Default)]
pub struct Pictures {
    /// What the student's shader draws.
    pub yours: Vec<Picture>,
    /// What a right answer draws: the same for all of a class.
    pub expected: Arc<[Picture]>,
    /// One term of the equation at a time, where that is known.
    pub terms: Arc<[TermPictures]>,
    /// Seconds that the animation takes.
    pub cycle: f64,
}

/// One term of the equation on its own, at the pose where it shows best.
#[derive(Clone, Debug)]
pub struct TermPictures {
    /// Id of the rubric line that judges the term.
    pub id: String,
    /// Fraction of the animation cycle, in [0, 1).
    pub t: f64,
    /// The term as the student's shader computes it, where a known mistake explains it.
    pub yours: Option<Picture>,
    /// The term as a right answer computes it.
    pub expected: Picture,
}
