//! What differs in one frame, counted row by row.

use super::lanes::{LANES, LaneSums, MOST_ADDED};
use super::{PackedPixel, PixelRun, RGB};
use crate::report::FrameResult;
use reference::rasteriser::Coverage;
use std::ops::Range;

/// What was counted so far.
#[derive(Default)]
pub(super) struct FrameTally {
    background: PackedPixel,
    coverage_mismatches: u32,
    mismatched: u32,
    max: u8,
    sum: u64,
    covered: u64,
    lanes: LaneSums,
}

impl FrameTally {
    pub fn new(background: PackedPixel) -> Self {
        Self { background, ..Self::default() }
    }

    /// `row`: the columns `shown` of a row that is background elsewhere.
    pub fn row(&mut self, row: &[PackedPixel], shown: Range<usize>, runs: &[PixelRun]) {
        let mut left = 0;
        for run in runs {
            let Overlap { columns, before, expected, after } = run.overlap(&shown);
            self.outside(&row[left..columns.start.max(left)]);
            left = left.max(columns.end);
            // The rasteriser's rounding decides whether a pixel of the silhouette is painted at all.
            if run.coverage == Coverage::Interior {
                [before, after].into_iter().flatten().for_each(|expected| self.one(*expected, self.background));
                self.inside(expected, &row[columns]);
            }
        }
        self.outside(&row[left..]);
    }

    fn outside(&mut self, pixels: &[PackedPixel]) {
        let painted = |pixel: &PackedPixel| (pixel ^ self.background) & RGB;
        // Hardly ever is there anything to count.
        if pixels.iter().fold(0, |any, pixel| any | painted(pixel)) != 0 {
            self.coverage_mismatches += pixels.iter().filter(|pixel| painted(pixel) != 0).count() as u32;
        }
    }

    fn inside(&mut self, expected: &[PackedPixel], found: &[PackedPixel]) {
        // A pixel that nothing was painted to is rare; without one, none needs a decision of its own.
        if found.iter().fold(false, |any, pixel| any | (*pixel == self.background)) {
            expected.iter().zip(found).for_each(|(expected, found)| self.one(*expected, *found));
        } else {
            self.painted(expected, found);
        }
    }

    fn painted(&mut self, expected: &[PackedPixel], found: &[PackedPixel]) {
        self.covered += 3 * found.len() as u64;
        let (chunks, rest) = found.as_chunks::<LANES>();
        for (expected, found) in expected.as_chunks::<LANES>().0.iter().zip(chunks) {
            self.add(expected, found);
        }
        match (expected.last_chunk::<LANES>(), found.last_chunk::<LANES>()) {
            (Some(expected), Some(found)) if !rest.is_empty() => {
                // Of the last lanes, those that were looked at already differ in nothing.
                let known = LANES - rest.len();
                self.add(expected, &std::array::from_fn(|i| if i < known { expected[i] } else { found[i] }));
            }
            (Some(_), Some(_)) => {}
            _ => {
                let mut last = [[0; LANES]; 2];
                last[0][..expected.len()].copy_from_slice(expected);
                last[1][..found.len()].copy_from_slice(found);
                self.add(&last[0], &last[1]);
            }
        }
    }

    fn add(&mut self, expected: &[PackedPixel; LANES], found: &[PackedPixel; LANES]) {
        if self.lanes.added == MOST_ADDED {
            self.settle();
        }
        self.lanes.add(expected, found);
    }

    fn one(&mut self, expected: PackedPixel, found: PackedPixel) {
        if found == self.background && (expected ^ self.background) & RGB != 0 {
            self.coverage_mismatches += 1;
        } else {
            self.painted(&[expected], &[found]);
        }
    }

    /// Takes over what has been added up lane by lane.
    pub fn settle(&mut self) {
        let LaneSums { most, sums, far, .. } = std::mem::take(&mut self.lanes);
        self.max = most.into_iter().fold(self.max, u8::max);
        self.sum += sums.into_iter().map(u64::from).sum::<u64>();
        self.mismatched += far.into_iter().sum::<u32>();
    }

    pub fn result(self, t: f64) -> FrameResult {
        FrameResult {
            t,
            coverage_mismatches: self.coverage_mismatches,
            max_difference: f64::from(self.max),
            mean_difference: self.sum as f64 / self.covered.max(1) as f64,
            mismatched_pixels: self.mismatched,
        }
    }
}

/// Where a run meets the columns that a row shows.
struct Overlap<'a> {
    /// The columns of the run that are shown, counted from the first one shown.
    columns: Range<usize>,
    /// What is expected left of them, in them and right of them.
    before: &'a [PackedPixel],
    expected: &'a [PackedPixel],
    after: &'a [PackedPixel],
}

impl PixelRun {
    fn overlap(&self, shown: &Range<usize>) -> Overlap<'_> {
        let start = self.columns.start.clamp(shown.start, shown.end);
        let end = self.columns.end.clamp(start, shown.end);
        let (before, rest) = self.pixels.split_at((start - self.columns.start.min(start)).min(self.pixels.len()));
        let (expected, after) = rest.split_at(end - start);
        Overlap { columns: start - shown.start..end - shown.start, before, expected, after }
    }
}
