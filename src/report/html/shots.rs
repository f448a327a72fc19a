//! The pictures of all poses, and where in them anything is painted: the rest of a sheet need not be looked at again.

use super::sheet::SheetGrid;
use crate::report::difference::ColourRamp;
use crate::report::encode::Canvas;
use crate::report::frame::foreground_columns;
use crate::report::{Area, Picture};
use std::ops::Range;

/// The same part of pictures of one size.
pub(super) struct Shots<'a> {
    pictures: &'a [Picture],
    part: Area,
    /// The background: that of the first picture.
    blank: [u8; 4],
    /// The columns of every row of the part that are not background, counted from its first, picture by picture.
    painted: Vec<Range<usize>>,
}

impl<'a> Shots<'a> {
    /// `None` where there is no picture. All of them have one size, and outside of `part` nothing but background.
    pub fn of(pictures: &'a [Picture], part: Area) -> Option<Self> {
        let blank = pictures.first()?.blank;
        let in_row = |picture: &Picture, y| {
            // Where a picture has a background of its own, all of it is painted.
            if picture.blank != blank {
                return 0..part.width as usize;
            }
            let painted = foreground_columns(picture.row(y), blank);
            let from = |column: usize| (picture.area.x as usize + column).saturating_sub(part.x as usize);
            if painted.is_empty() { 0..0 } else { from(painted.start)..from(painted.end) }
        };
        let in_picture = |picture: &'a Picture| part.rows().map(move |y| in_row(picture, y));
        let painted = pictures.iter().flat_map(in_picture).collect();
        Some(Self { pictures, part, blank, painted })
    }

    /// They as a sheet.
    pub fn sheet(&self, grid: SheetGrid, factor: usize) -> Canvas {
        let [r, g, b, _] = self.blank;
        let mut buffer = Vec::new();
        grid.sheet(self.size(), factor, [r, g, b], |pose, y, to| {
            let range = self.painted(pose, y);
            let from = self.columns(pose, y, &range, &mut buffer);
            to[range.clone()].iter_mut().zip(from).for_each(|(to, [r, g, b, _])| *to = [*r, *g, *b]);
            range
        })
    }

    /// A sheet of where they differ from what is expected, which is the same part of as many pictures of the same size.
    pub fn difference(&self, expected: &Self, grid: SheetGrid, factor: usize) -> Canvas {
        let ramp = ColourRamp::new();
        let mut buffers = [Vec::new(), Vec::new()];
        grid.sheet(self.size(), factor, ramp.pixel(&self.blank, &expected.blank), |pose, y, to| {
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

    fn size(&self) -> (usize, usize) {
        (self.part.width as usize, self.part.height as usize)
    }

    fn painted(&self, pose: usize, y: usize) -> Range<usize> {
        self.painted[pose * self.part.height as usize + y].clone()
    }

    fn columns<'b>(
        &'b self,
        pose: usize,
        y: usize,
        range: &Range<usize>,
        buffer: &'b mut Vec<[u8; 4]>,
    ) -> &'b [[u8; 4]] {
        let column = |column: usize| self.part.x + column as u32;
        self.pictures[pose].columns(self.part.y + y as u32, column(range.start)..column(range.end), buffer)
    }
}
