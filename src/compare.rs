//! (Reference, candidate) → difference. Pure: no GPU, no file, no clock.
//!
//! The two sides are different types, so that nothing can be compared with itself by accident: the expected frame
//! comes from the reference crate in f64, the candidate from the renderer.

mod lanes;
mod tally;

use crate::render::{Frames, Sample};
use crate::report::FrameResult;
use bytemuck::pod_collect_to_vec;
use reference::rasteriser::{Coverage, Frame};
use std::borrow::Cow;
use std::ops::Range;
use tally::FrameTally;

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
    width: u32,
    height: u32,
    background: PackedPixel,
    /// The pixels that are not certainly outside, row by row from the left.
    runs: Vec<PixelRun>,
    /// The runs of each row, as a range of `runs`.
    rows: Vec<Range<usize>>,
}

/// RGBA8 as it lies in memory.
type PackedPixel = u32;

/// Red, green and blue of a [`PackedPixel`].
const RGB: PackedPixel = PackedPixel::from_ne_bytes([255, 255, 255, 0]);

/// Neighbours in a row that lie alike with respect to the triangle.
#[derive(Clone, Debug)]
struct PixelRun {
    coverage: Coverage,
    columns: Range<usize>,
    /// What is expected there, without alpha.
    pixels: Vec<PackedPixel>,
}

impl ExpectedFrame {
    /// Prepares the reference's frame of pose `t`.
    pub fn new(t: f64, frame: &Frame, background: [u8; 4]) -> Self {
        let width = frame.width.max(1) as usize;
        let mut runs: Vec<PixelRun> = Vec::new();
        let mut rows = Vec::new();
        for (coverage, pixels) in frame.coverage.chunks_exact(width).zip(frame.pixels.chunks_exact(width)) {
            let first = runs.len();
            let mut column = 0;
            for alike in coverage.chunk_by(|a, b| a == b) {
                let columns = column..column + alike.len();
                column = columns.end;
                if alike[0] != Coverage::Outside {
                    let pixels =
                        pixels[columns.clone()].iter().map(|pixel| PackedPixel::from_ne_bytes(*pixel) & RGB).collect();
                    runs.push(PixelRun { coverage: alike[0], columns, pixels });
                }
            }
            rows.push(first..runs.len());
        }
        Self {
            t,
            width: frame.width,
            height: frame.height,
            background: PackedPixel::from_ne_bytes(background),
            runs,
            rows,
        }
    }
}

/// Holds frame `index` of the candidate against the expected one. Alpha is not seen and not compared.
///
/// # Panics
/// Where the two have different sizes: a programming error of ours.
pub fn frame(expected: &ExpectedFrame, candidate: &Frames, index: u32) -> FrameResult {
    assert_eq!((expected.width, expected.height), (candidate.width, candidate.height), "frame sizes");
    let mut tally = FrameTally::new(expected.background);
    let area = candidate.area(index);
    let shown = area.x as usize..(area.x + area.width) as usize;
    for (y, runs) in (0..).zip(&expected.rows) {
        let runs = &expected.runs[runs.clone()];
        if area.rows().contains(&y) {
            let row = candidate.row(index, y);
            // The device's memory is aligned; a copy of it need not be.
            let pixels = bytemuck::try_cast_slice(row).map_or_else(|_| pod_collect_to_vec(row).into(), Cow::Borrowed);
            tally.row(&pixels, shown.clone(), runs);
        } else {
            tally.row(&[], 0..0, runs);
        }
    }
    tally.settle();
    tally.result(expected.t)
}

impl FrameResult {
    /// Whether the triangle stands where it should.
    pub fn shape_agrees(&self) -> bool {
        self.coverage_mismatches == 0
    }
}

/// The pixels of a frame that are judged and differ by more than the tolerance: for each, row by row from above, whether it does.
pub fn wrong_pixels(expected: &ExpectedFrame, candidate: &Frames, index: u32) -> Vec<bool> {
    let all = differences(expected, candidate, index);
    all.into_iter().map(|one| one.is_some_and(|difference| difference > PIXEL_TOLERANCE)).collect()
}

/// For each pixel of a frame, row by row from above, the largest difference of a channel; `None` where it is not judged.
pub fn differences(expected: &ExpectedFrame, candidate: &Frames, index: u32) -> Vec<Option<u8>> {
    let drawn = candidate.picture(index);
    let width = expected.width as usize;
    let mut differences = vec![None; drawn.pixels().len()];
    for (y, runs) in expected.rows.iter().enumerate() {
        for run in expected.runs[runs.clone()].iter().filter(|run| run.coverage == Coverage::Interior) {
            for (column, right) in run.columns.clone().zip(&run.pixels) {
                let place = y * width + column;
                let (right, found) = (right.to_ne_bytes(), drawn.pixels()[place]);
                differences[place] = (0..3).map(|channel| right[channel].abs_diff(found[channel])).max();
            }
        }
    }
    differences
}

/// The pixel that is farthest from all that are not wrong, in steps along rows and columns; `None` where no pixel is wrong.
pub fn innermost(wrong: &[bool], width: u32) -> Option<[u32; 2]> {
    let width = width.max(1) as usize;
    let mut steps: Vec<u32> = wrong.iter().map(|wrong| if *wrong { u32::MAX } else { 0 }).collect();
    let rows = wrong.len() / width;
    // What lies beyond the frame is not wrong. Two sweeps find the way to what is nearest.
    let nearer = |steps: &mut Vec<u32>, place: usize, beside: Option<usize>| {
        let way = beside.map_or(0, |beside| steps[beside]).saturating_add(1);
        steps[place] = steps[place].min(way);
    };
    for place in 0..rows * width {
        nearer(&mut steps, place, (place % width > 0).then(|| place - 1));
        nearer(&mut steps, place, place.checked_sub(width));
    }
    for place in (0..rows * width).rev() {
        nearer(&mut steps, place, (place % width + 1 < width).then_some(place + 1));
        nearer(&mut steps, place, (place / width + 1 < rows).then_some(place + width));
    }
    let (place, most) = steps.iter().enumerate().rev().max_by_key(|(_, steps)| **steps)?;
    (*most > 0).then(|| [(place % width) as u32, (place / width) as u32])
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

#[cfg(test)]
mod tests;
