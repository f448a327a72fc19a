//! (Reference, candidate) → difference. Pure: no GPU, no file, no clock.
//!
//! The two sides are different types, so that nothing can be compared with itself by accident: the expected frame
//! comes from the reference crate in f64, the candidate from the renderer.

use crate::render::{Frames, Sample};
use crate::report::FrameResult;
use reference::rasteriser::{Coverage, Frame};
use std::ops::Range;

/// Largest difference of an interior pixel's channel that still agrees, in 1/255.
///
/// Noise: the CPU reference and the software driver differ by at most 1 over all poses of the course's animation
/// (rounding at .5). Defect to catch: the half vector that is not normalised, 5 in one frame. Margin: 2 on both sides.
pub const PIXEL_TOLERANCE: u8 = 2;

/// Largest difference of a colour channel of a probe that still agrees (1 is the full range of a channel).
///
/// Noise: right answers written in f32 in unlike ways differ from the f64 reference by up to 4e-4 (x^80 by way of an
/// angle); the usual ones by 1e-5. Defect to catch: the faintest known mistake differs by more than 2e-2 at some probe.
pub const COLOUR_TOLERANCE: f64 = 2e-3;

/// Largest difference of a clip-space coordinate that still agrees, as a fraction of the vertex's largest coordinate.
///
/// Noise: two products of f32 matrices, 1e-6. Defect to catch: a shift of a pixel in 640, 3e-3.
pub const POSITION_TOLERANCE: f64 = 2e-4;

/// What a right answer draws for one pose, prepared for fast comparison.
#[derive(Clone, Debug)]
pub struct ExpectedFrame {
    /// Fraction of the animation cycle, in [0, 1).
    pub t: f64,
    frame: Frame,
    background: [u8; 4],
    /// For each row, the pixels from the first to the last that is not certainly outside.
    spans: Vec<Range<usize>>,
}

impl ExpectedFrame {
    /// Prepares the reference's frame of pose `t`.
    pub fn new(t: f64, frame: Frame, background: [u8; 4]) -> Self {
        let spans = frame
            .coverage
            .chunks_exact(frame.width.max(1) as usize)
            .map(|row| {
                let inside = |coverage: &Coverage| *coverage != Coverage::Outside;
                match (row.iter().position(inside), row.iter().rposition(inside)) {
                    (Some(first), Some(last)) => first..last + 1,
                    _ => 0..0,
                }
            })
            .collect();
        Self { t, frame, background, spans }
    }

    /// The picture itself.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }
}

/// Holds frame `index` of the candidate against the expected one. Alpha is not seen and not compared.
///
/// # Panics
/// Where the two have different sizes: a programming error of ours.
pub fn frame(expected: &ExpectedFrame, candidate: &Frames, index: u32) -> FrameResult {
    assert_eq!((expected.frame.width, expected.frame.height), (candidate.width, candidate.height), "frame sizes");
    let mut tally = Tally::default();
    let blank = expected.background.repeat(candidate.width as usize);
    for (y, span) in expected.spans.iter().enumerate() {
        let row = candidate.row(index, y as u32);
        let first = y * expected.frame.width as usize;
        for outside in [0..span.start, span.end..candidate.width as usize] {
            tally.outside(&row[bytes(&outside)], &blank[bytes(&outside)]);
        }
        let inside = first + span.start..first + span.end;
        let pixels = &expected.frame.pixels[inside.clone()];
        let coverage = &expected.frame.coverage[inside];
        for ((expected_pixel, coverage), pixel) in pixels.iter().zip(coverage).zip(row[bytes(span)].chunks_exact(4)) {
            tally.pixel(*expected_pixel, *coverage, pixel, &expected.background);
        }
    }
    tally.result(expected.t)
}

fn bytes(pixels: &Range<usize>) -> Range<usize> {
    pixels.start * 4..pixels.end * 4
}

#[derive(Default)]
struct Tally {
    coverage_mismatches: u32,
    mismatched: u32,
    max: u8,
    sum: u64,
    covered: u64,
}

impl Tally {
    fn outside(&mut self, row: &[u8], blank: &[u8]) {
        if row == blank {
            return;
        }
        for (pixel, blank) in row.chunks_exact(4).zip(blank.chunks_exact(4)) {
            if pixel[..3] != blank[..3] {
                self.coverage_mismatches += 1;
            }
        }
    }

    fn pixel(&mut self, expected: [u8; 4], coverage: Coverage, pixel: &[u8], blank: &[u8; 4]) {
        match coverage {
            Coverage::Outside => self.outside(pixel, blank),
            // The rasteriser's rounding decides whether it is painted at all.
            Coverage::Silhouette => {}
            Coverage::Interior if pixel == blank && expected[..3] != blank[..3] => self.coverage_mismatches += 1,
            Coverage::Interior => {
                let differences = [0, 1, 2].map(|channel| expected[channel].abs_diff(pixel[channel]));
                let largest = differences.into_iter().max().unwrap_or(0);
                self.max = self.max.max(largest);
                self.sum += differences.iter().map(|d| u64::from(*d)).sum::<u64>();
                self.covered += 3;
                self.mismatched += u32::from(largest > PIXEL_TOLERANCE);
            }
        }
    }

    fn result(self, t: f64) -> FrameResult {
        FrameResult {
            t,
            coverage_mismatches: self.coverage_mismatches,
            max_difference: f64::from(self.max),
            mean_difference: self.sum as f64 / self.covered.max(1) as f64,
            mismatched_pixels: self.mismatched,
        }
    }
}

impl FrameResult {
    /// Whether the triangle stands where it should.
    pub fn shape_agrees(&self) -> bool {
        self.coverage_mismatches == 0
    }
}

/// The largest difference of a channel; infinite where the candidate is not a number.
pub fn colour_difference(expected: glam::DVec3, candidate: &Sample) -> f64 {
    let candidate = candidate.colour_f64();
    let channels = expected.to_array().into_iter().zip(candidate);
    channels.map(|(e, c)| if c.is_finite() { (e - c).abs() } else { f64::INFINITY }).fold(0.0, f64::max)
}

/// The largest difference of a clip-space coordinate as a fraction of the vertex's largest coordinate; infinite where
/// the candidate is not a number.
///
/// `scale` is the factor by which all positions of the candidate may be multiplied: homogeneous coordinates that have
/// one positive factor in common draw the same picture.
pub fn position_difference(expected: glam::DVec4, candidate: &Sample, scale: f64) -> f64 {
    let largest = expected.abs().max_element().max(f64::MIN_POSITIVE);
    let candidate = candidate.position.map(f64::from);
    let coordinates = expected.to_array().into_iter().zip(candidate);
    coordinates
        .map(|(e, c)| if c.is_finite() { (e - c / scale).abs() / largest } else { f64::INFINITY })
        .fold(0.0, f64::max)
}
