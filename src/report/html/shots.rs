//! The pictures of all poses, and where in them anything is painted: the rest of a sheet need not be looked at again.

use super::sheet::SheetGrid;
use crate::report::Picture;
use crate::report::difference::ColourRamp;
use crate::report::encode::Canvas;
use std::ops::Range;

/// Pixels that are compared with the background at once.
const STRIDE: usize = 16;

/// Pictures of one size.
pub(super) struct Shots<'a> {
    pictures: &'a [Picture],
    size: (usize, usize),
    /// The background: that of the first picture.
    blank: [u8; 4],
    /// The part of every row that is not background, picture by picture.
    painted: Vec<Range<usize>>,
}

impl<'a> Shots<'a> {
    /// None where there is no picture. All of them have one size.
    pub fn of(pictures: &'a [Picture]) -> Option<Self> {
        let first = pictures.first()?;
        let size = (first.width as usize, first.height as usize);
        let blank = first.blank;
        let background = vec![blank; size.0];
        let in_row = |picture: &Picture, y| {
            // Where a picture has a background of its own, all of it is painted.
            if picture.blank != blank {
                return 0..size.0;
            }
            let (row, left) = (picture.row(y), picture.area.x as usize);
            let painted = painted(row, &background[..row.len()]);
            if painted.is_empty() { 0..0 } else { painted.start + left..painted.end + left }
        };
        let in_picture = |picture: &'a Picture| (0..first.height).map(move |y| in_row(picture, y));
        let painted = pictures.iter().flat_map(in_picture).collect();
        Some(Self { pictures, size, blank, painted })
    }

    /// They as a sheet.
    pub fn sheet(&self, grid: SheetGrid, factor: usize) -> Canvas {
        let [r, g, b, _] = self.blank;
        let mut buffer = Vec::new();
        grid.sheet(self.size, factor, [r, g, b], |pose, y, to| {
            let range = self.painted(pose, y);
            let from = self.columns(pose, y, &range, &mut buffer);
            to[range.clone()].iter_mut().zip(from).for_each(|(to, [r, g, b, _])| *to = [*r, *g, *b]);
            range
        })
    }

    /// A sheet of where they differ from what is expected, which are as many pictures of the same size.
    pub fn difference(&self, expected: &Self, grid: SheetGrid, factor: usize) -> Canvas {
        let ramp = ColourRamp::new();
        let mut buffers = [Vec::new(), Vec::new()];
        grid.sheet(self.size, factor, ramp.pixel(&self.blank, &expected.blank), |pose, y, to| {
            let range = match (self.painted(pose, y), expected.painted(pose, y)) {
                (yours, none) if none.is_empty() => yours,
                (none, expected) if none.is_empty() => expected,
                (a, b) => a.start.min(b.start)..a.end.max(b.end),
            };
            let [yours, right] = &mut buffers;
            let (yours, right) = (self.columns(pose, y, &range, yours), expected.columns(pose, y, &range, right));
            let pairs = yours.iter().zip(right);
            to[range.clone()].iter_mut().zip(pairs).for_each(|(to, (yours, right))| *to = ramp.pixel(yours, right));
            range
        })
    }

    fn painted(&self, pose: usize, y: usize) -> Range<usize> {
        self.painted[pose * self.size.1 + y].clone()
    }

    fn columns<'b>(
        &'b self,
        pose: usize,
        y: usize,
        range: &Range<usize>,
        buffer: &'b mut Vec<[u8; 4]>,
    ) -> &'b [[u8; 4]] {
        self.pictures[pose].columns(y as u32, range.start as u32..range.end as u32, buffer)
    }
}

/// The pixels of a row that are not background, with some of their neighbours.
fn painted(row: &[[u8; 4]], background: &[[u8; 4]]) -> Range<usize> {
    // Comparing whole slices is many times faster than looking at each pixel.
    let strides = || row.chunks(STRIDE).zip(background.chunks(STRIDE));
    let Some(first) = strides().position(|(row, blank)| row != blank) else { return 0..0 };
    let last = strides().rposition(|(row, blank)| row != blank).unwrap_or(first);
    first * STRIDE..((last + 1) * STRIDE).min(row.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_painted_pixel_of_a_row_is_found() {
        let row = |places: &[usize]| {
            let mut row = [[255; 4]; 40];
            places.iter().for_each(|x| row[*x][1] = 0);
            painted(&row, &[[255; 4]; 40])
        };
        assert_eq!(row(&[]), 0..0);
        assert_eq!(row(&[0]), 0..16);
        assert_eq!(row(&[16, 31]), 16..32);
        assert_eq!(row(&[15, 39]), 0..40);
    }
}
