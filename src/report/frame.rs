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

    /// The frame that differs most, of equals the first; none where all agree. A shape that is elsewhere is as far off as a
    /// colour can be.
    pub fn differs_most(frames: &[Self]) -> Option<usize> {
        let off = |frame: &Self| {
            let largest = if frame.coverage_mismatches > 0 { 255.0 } else { frame.max_difference };
            (largest, frame.coverage_mismatches + frame.mismatched_pixels)
        };
        let differing = frames.iter().enumerate().rev().filter(|(_, frame)| !frame.agrees());
        let most = differing
            .map(|(index, frame)| (index, off(frame)))
            .max_by(|(_, a), (_, b)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        most.map(|(index, _)| index)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(max_difference: f64, mismatched_pixels: u32, coverage_mismatches: u32) -> FrameResult {
        FrameResult { t: 0.0, coverage_mismatches, max_difference, mean_difference: 0.0, mismatched_pixels }
    }

    #[test]
    fn the_frame_that_differs_most_is_the_first_of_the_worst() {
        let agreeing = frame(2.0, 0, 0);
        assert_eq!(FrameResult::differs_most(&[agreeing.clone(), agreeing.clone()]), None);
        assert_eq!(
            FrameResult::differs_most(&[agreeing.clone(), frame(9.0, 5, 0), frame(40.0, 1, 0), frame(40.0, 1, 0)]),
            Some(2)
        );
        // Of two that are as far off, the one that is so in more places.
        assert_eq!(FrameResult::differs_most(&[frame(40.0, 1, 0), frame(40.0, 7, 0), agreeing.clone()]), Some(1));
        // A shape in another place differs by more than any colour in the right one.
        assert_eq!(FrameResult::differs_most(&[frame(200.0, 900, 0), frame(0.0, 0, 3), agreeing]), Some(1));
    }
}
