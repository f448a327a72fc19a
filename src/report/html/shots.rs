//! The pictures of all poses, and where in them anything is painted: the rest of a sheet need not be looked at again.

use super::sheet::Grid;
use crate::report::Picture;
use crate::report::difference::Ramp;
use crate::report::encode::Canvas;
use std::ops::Range;

/// Pixels that are compared with the background at once.
const STRIDE: usize = 16;

/// Pictures of one size.
pub(super) struct Shots<'a> {
    pictures: &'a [Picture],
    size: (usize, usize),
    /// The background: the colour of the first picture's first pixel.
    blank: [u8; 4],
    /// The part of every row that is not background, picture by picture.
    painted: Vec<Range<usize>>,
}

impl<'a> Shots<'a> {
    /// None where there is no picture. All of them have one size.
    pub fn of(pictures: &'a [Picture]) -> Option<Self> {
        let first = pictures.first()?;
        let size = (first.width as usize, first.height as usize);
        let blank = *first.rgba.first_chunk()?;
        let background = blank.repeat(size.0);
        let rows = pictures.iter().flat_map(|picture| picture.rgba.chunks_exact(size.0 * 4));
        let painted = rows.map(|row| painted(row, &background)).collect();
        Some(Self { pictures, size, blank, painted })
    }

    /// They as a sheet.
    pub fn sheet(&self, grid: Grid, factor: usize) -> Canvas {
        let [r, g, b, _] = self.blank;
        grid.sheet(self.size, factor, [r, g, b], |pose, y, to| {
            let range = self.painted(pose, y);
            let from = &self.row(pose, y)[range.clone()];
            to[range.clone()].iter_mut().zip(from).for_each(|(to, [r, g, b, _])| *to = [*r, *g, *b]);
            range
        })
    }

    /// A sheet of where they differ from what is expected, which are as many pictures of the same size.
    pub fn difference(&self, expected: &Self, grid: Grid, factor: usize) -> Canvas {
        let ramp = Ramp::new();
        grid.sheet(self.size, factor, ramp.pixel(&self.blank, &expected.blank), |pose, y, to| {
            let range = match (self.painted(pose, y), expected.painted(pose, y)) {
                (yours, none) if none.is_empty() => yours,
                (none, expected) if none.is_empty() => expected,
                (a, b) => a.start.min(b.start)..a.end.max(b.end),
            };
            let pairs = self.row(pose, y)[range.clone()].iter().zip(&expected.row(pose, y)[range.clone()]);
            to[range.clone()].iter_mut().zip(pairs).for_each(|(to, (yours, right))| *to = ramp.pixel(yours, right));
            range
        })
    }

    fn painted(&self, pose: usize, y: usize) -> Range<usize> {
        self.painted[pose * self.size.1 + y].clone()
    }

    fn row(&self, pose: usize, y: usize) -> &'a [[u8; 4]] {
        let start = y * self.size.0;
        &self.pictures[pose].rgba.as_chunks::<4>().0[start..start + self.size.0]
    }
}

/// The pixels of a row that are not background, with some of their neighbours.
fn painted(row: &[u8], background: &[u8]) -> Range<usize> {
    // Comparing whole slices is many times faster than looking at each pixel.
    let strides = || row.chunks(STRIDE * 4).zip(background.chunks(STRIDE * 4));
    let Some(first) = strides().position(|(row, blank)| row != blank) else { return 0..0 };
    let last = strides().rposition(|(row, blank)| row != blank).unwrap_or(first);
    first * STRIDE..((last + 1) * STRIDE).min(row.len() / 4)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_painted_pixel_of_a_row_is_found() {
        let row = |places: &[usize]| {
            let mut row = [255; 40 * 4];
            places.iter().for_each(|x| row[x * 4 + 1] = 0);
            painted(&row, &[255; 40 * 4])
        };
        assert_eq!(row(&[]), 0..0);
        assert_eq!(row(&[0]), 0..16);
        assert_eq!(row(&[16, 31]), 16..32);
        assert_eq!(row(&[15, 39]), 0..40);
    }
}
