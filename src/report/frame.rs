//! Frames: how far they are from the right ones, and their pictures.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::ops::Range;
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

    /// How far off it is, in 1/255: what is painted in one picture alone is as far off as a colour can be.
    pub fn largest_difference(&self) -> f64 {
        if self.coverage_mismatches > 0 { 255.0 } else { self.max_difference }
    }

    /// In how many frames pixels are painted in one picture alone, and the most of these in a frame; `None` where there are none.
    pub fn shape_mismatches(frames: &[Self]) -> Option<(usize, u32)> {
        let each = || frames.iter().map(|frame| frame.coverage_mismatches).filter(|count| *count > 0);
        Some((each().count(), each().max()?))
    }

    /// The frame that differs most, of equals the first; `None` where all agree.
    pub fn differs_most(frames: &[Self]) -> Option<usize> {
        let off = |frame: &Self| (frame.largest_difference(), frame.coverage_mismatches + frame.mismatched_pixels);
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

/// A part of a picture, in pixels from its top left corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Area {
    /// Its first column.
    pub x: u32,
    /// Its first row.
    pub y: u32,
    /// How many columns it has.
    pub width: u32,
    /// How many rows it has.
    pub height: u32,
}

impl Area {
    /// All of a picture of this size.
    pub fn whole(width: u32, height: u32) -> Self {
        Self { x: 0, y: 0, width, height }
    }

    /// How many pixels it has; `None` where a picture of this size does not hold it.
    pub fn pixels_within(self, width: u32, height: u32) -> Option<usize> {
        let is_inside = self.x.checked_add(self.width)? <= width && self.y.checked_add(self.height)? <= height;
        is_inside.then(|| self.width as usize * self.height as usize)
    }

    /// The least part of an area that holds every pixel of another colour than `blank`; `row` gives the pixels of one of its rows.
    pub fn foreground<'a>(area: Self, blank: [u8; 4], row: impl Fn(u32) -> &'a [[u8; 4]]) -> Self {
        let in_row = |y| {
            let columns = foreground_columns(row(y), blank);
            Self { x: area.x + columns.start as u32, y, width: columns.len() as u32, height: 1 }
        };
        area.rows().map(in_row).fold(Self::default(), Self::with)
    }

    /// The least area that holds both.
    pub fn with(self, other: Self) -> Self {
        if self.is_empty() || other.is_empty() {
            return if self.is_empty() { other } else { self };
        }
        let (x, y) = (self.x.min(other.x), self.y.min(other.y));
        let right = (self.x + self.width).max(other.x + other.width);
        let bottom = (self.y + self.height).max(other.y + other.height);
        Self { x, y, width: right - x, height: bottom - y }
    }

    /// Its rows.
    pub fn rows(self) -> Range<u32> {
        self.y..self.y + self.height
    }

    /// Its columns.
    pub fn columns(self) -> Range<u32> {
        self.x..self.x + self.width
    }

    /// Whether there is nothing in it.
    pub fn is_empty(self) -> bool {
        self.width == 0 || self.height == 0
    }
}

/// From the first to the last pixel of a row that has another colour than `blank`.
pub(super) fn foreground_columns(row: &[[u8; 4]], blank: [u8; 4]) -> Range<usize> {
    // Pixels that are compared at once take a tenth of the time that one by one they take.
    const STRIDE: usize = 16;
    let is_painted = |pixel: &[u8; 4]| u32::from_ne_bytes(*pixel) != u32::from_ne_bytes(blank);
    let is_any = |pixels: &[[u8; 4]]| pixels.iter().fold(false, |any, pixel| any | is_painted(pixel));
    let mut strides = row.chunks(STRIDE);
    let Some(first) = strides.position(is_any) else { return 0..0 };
    let last = strides.rposition(is_any).map_or(first, |behind| first + 1 + behind);
    let within = |stride: usize| &row[stride * STRIDE..row.len().min((stride + 1) * STRIDE)];
    let start = within(first).iter().position(is_painted).unwrap_or(0);
    let end = within(last).iter().rposition(is_painted).unwrap_or(0);
    first * STRIDE + start..last * STRIDE + end + 1
}

/// One 8-bit RGBA picture, top row first. Of most pictures the greater part is of one colour: it is not stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The colour of every pixel outside of `area`.
    pub blank: [u8; 4],
    /// The part that is stored.
    pub area: Area,
    /// The pixels of `area` row by row, four bytes each, linear, not sRGB-encoded.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// A picture of which every pixel is stored: `width * height * 4` bytes.
    pub fn whole(width: u32, height: u32, rgba: Vec<u8>) -> Self {
        let blank = rgba.first_chunk().copied().unwrap_or_default();
        Self { width, height, blank, area: Area::whole(width, height), rgba }
    }

    /// The same picture, of which only the least part is stored that holds every pixel of another colour than `blank`.
    pub fn cut(mut self, blank: [u8; 4]) -> Self {
        let least = Area::foreground(self.area, blank, |y| self.row(y));
        let mut buffer = Vec::new();
        let mut rgba = Vec::with_capacity(least.width as usize * least.height as usize * 4);
        for y in least.rows() {
            rgba.extend_from_slice(self.columns(y, least.columns(), &mut buffer).as_flattened());
        }
        (self.rgba, self.area, self.blank) = (rgba, least, blank);
        self
    }

    /// Whether it has pixels, and as many as its area says.
    pub fn is_sound(&self) -> bool {
        let stored = self.area.pixels_within(self.width, self.height);
        self.width > 0 && self.height > 0 && stored.is_some_and(|pixels| self.rgba.len() == pixels * 4)
    }

    /// Row `y` of its area; nothing where the area does not have it.
    pub fn row(&self, y: u32) -> &[[u8; 4]] {
        let width = self.area.width as usize;
        let start = y.checked_sub(self.area.y).map(|row| row as usize * width);
        start.and_then(|start| self.rgba.as_chunks().0.get(start..start + width)).unwrap_or_default()
    }

    /// Some columns of row `y`; `buffer` holds them where they are not all in the area.
    pub fn columns<'a>(&'a self, y: u32, columns: Range<u32>, buffer: &'a mut Vec<[u8; 4]>) -> &'a [[u8; 4]] {
        let (row, own) = (self.row(y), self.area.columns());
        if !row.is_empty() && own.start <= columns.start && columns.end <= own.end {
            return &row[(columns.start - own.start) as usize..(columns.end - own.start) as usize];
        }
        buffer.clear();
        buffer.resize(columns.len(), self.blank);
        let shared = own.start.max(columns.start)..own.end.min(columns.end);
        if !row.is_empty() && !shared.is_empty() {
            let from = &row[(shared.start - own.start) as usize..(shared.end - own.start) as usize];
            buffer[(shared.start - columns.start) as usize..][..from.len()].copy_from_slice(from);
        }
        buffer
    }

    /// All its pixels row by row, RGBA.
    pub fn pixels(&self) -> Cow<'_, [[u8; 4]]> {
        if self.area == Area::whole(self.width, self.height) {
            return Cow::Borrowed(self.rgba.as_chunks().0);
        }
        let mut pixels = vec![self.blank; self.width as usize * self.height as usize];
        for y in self.area.rows() {
            let start = (y * self.width + self.area.x) as usize;
            let row = self.row(y);
            pixels[start..start + row.len()].copy_from_slice(row);
        }
        Cow::Owned(pixels)
    }
}

/// The pictures of a grading: what was drawn beside what is expected, one pair a pose.
#[derive(Clone, Debug, Default)]
pub struct Pictures {
    /// What the student's shader draws.
    pub yours: Arc<[Picture]>,
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
    pub yours: Option<Arc<Picture>>,
    /// The term as a right answer computes it; most of what is handed in shares it.
    pub expected: Arc<Picture>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(max_difference: f64, mismatched_pixels: u32, coverage_mismatches: u32) -> FrameResult {
        FrameResult { t: 0.0, coverage_mismatches, max_difference, mean_difference: 0.0, mismatched_pixels }
    }

    #[test]
    fn every_painted_pixel_of_a_row_is_found() {
        let row = |places: &[usize]| {
            let mut row = [[255; 4]; 40];
            places.iter().for_each(|x| row[*x][1] = 0);
            foreground_columns(&row, [255; 4])
        };
        assert_eq!(row(&[]), 0..0);
        assert_eq!([row(&[0]), row(&[39]), row(&[17])], [0..1, 39..40, 17..18]);
        assert_eq!([row(&[16, 31]), row(&[15, 39]), row(&[2, 3, 9])], [16..32, 15..40, 2..10]);
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

    #[test]
    fn an_area_outside_its_frame_has_no_pixels() {
        let area = |x, y, width, height| Area { x, y, width, height }.pixels_within(4, 3);
        assert_eq!(area(1, 1, 3, 2), Some(3 * 2));
        assert_eq!(area(2, 1, 3, 2), None);
        assert_eq!(area(1, 2, 3, 2), None);
        assert_eq!(area(u32::MAX, 0, 2, 1), None);
    }
}
