//! All poses in one image.

use crate::report::encode::Canvas;
use std::ops::Range;

/// How the poses lie in a sheet: row by row, in a grid that is about as wide as it is high, since
/// browsers limit the side of an image more tightly than its area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SheetGrid {
    pub count: usize,
    pub columns: usize,
    pub rows: usize,
}

impl SheetGrid {
    /// The grid for `count` poses, at least one.
    pub fn of(count: usize) -> Self {
        let columns = (1..).find(|side| side * side >= count).unwrap_or(1);
        Self { count, columns, rows: count.div_ceil(columns) }
    }

    /// The steps of the animation: percentage of the cycle, and how far the sheet moves, in
    /// percent of its own size.
    pub fn steps(self) -> Vec<FilmStep> {
        let step = |pose: usize| FilmStep {
            at: 100.0 * pose as f64 / self.count as f64,
            x: 100.0 * (pose % self.columns) as f64 / self.columns as f64,
            y: 100.0 * (pose / self.columns) as f64 / self.rows as f64,
        };
        (0..self.count).map(step).collect()
    }

    /// Pictures of one size in their places, on cells of the colour `blank`.
    ///
    /// `row` paints a row of a pose and says which pixels of it are to be seen: the others stay blank. Of every picture,
    /// every `factor`-th pixel of every `factor`-th row is taken: no colour is invented.
    pub fn sheet(
        self,
        size: (usize, usize),
        factor: usize,
        blank: [u8; 3],
        mut row: impl FnMut(usize, usize, &mut [[u8; 3]]) -> Range<usize>,
    ) -> Canvas {
        let (width, height) = (size.0.div_ceil(factor), size.1.div_ceil(factor));
        let mut sheet = Canvas::new(width * self.columns, height * self.rows, blank);
        let mut whole = vec![blank; size.0];
        for pose in 0..self.count {
            let corner = (pose / self.columns * height) * sheet.width + pose % self.columns * width;
            for (y, line) in (0..size.1).step_by(factor).enumerate() {
                let painted = row(pose, line, &mut whole);
                let first = painted.start.next_multiple_of(factor);
                if first < painted.end {
                    let pixels = whole[first..painted.end].iter().step_by(factor).copied();
                    sheet.put(corner + y * sheet.width + first / factor, pixels);
                }
            }
        }
        sheet
    }
}

/// One step of the animation, in percent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FilmStep {
    pub at: f64,
    pub x: f64,
    pub y: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::PIXEL_TOLERANCE;

    /// The pixels of a sheet, as a reader of the file sees them.
    fn pixels(sheet: &Canvas) -> Vec<[u8; 3]> {
        let png = sheet.encode().expect("a PNG");
        image::load_from_memory(&png).expect("a picture").to_rgb8().pixels().map(|pixel| pixel.0).collect()
    }

    #[test]
    fn the_grid_has_room_for_every_pose() {
        let grid = |count| (SheetGrid::of(count).columns, SheetGrid::of(count).rows);
        assert_eq!([1, 2, 7, 12, 25, 26].map(grid), [(1, 1), (2, 1), (3, 3), (4, 3), (5, 5), (6, 5)]);
    }

    #[test]
    fn every_step_shows_the_cell_that_holds_its_pose() {
        let grid = SheetGrid::of(7);
        let sheet = grid.sheet((1, 1), 1, [0; 3], |pose, _, row| {
            row[0] = [pose as u8 + 1; 3];
            0..1
        });
        assert_eq!((sheet.width, sheet.height), (3, 3));
        for (pose, step) in grid.steps().into_iter().enumerate() {
            let x = (step.x / 100.0 * 3.0).round() as usize;
            let y = (step.y / 100.0 * 3.0).round() as usize;
            assert_eq!(pixels(&sheet)[y * 3 + x], [pose as u8 + 1; 3]);
            assert!((step.at - 100.0 * pose as f64 / 7.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_reduced_picture_keeps_its_corner_and_its_odd_edge() {
        let half = SheetGrid::of(1).sheet((3, 3), 2, [99; 3], |_, y, row| {
            (0..3).for_each(|x| row[x] = [(y * 3 + x) as u8; 3]);
            0..3
        });
        assert_eq!((half.width, half.height), (2, 2));
        assert_eq!(pixels(&half), [[0; 3], [2; 3], [6; 3], [8; 3]]);
    }

    #[test]
    fn what_is_not_painted_stays_blank_at_every_reduction() {
        for (factor, seen) in [(1, vec![9, 9, 9, 7, 7, 9]), (2, vec![9, 9, 7]), (4, vec![9, 7])] {
            let row = SheetGrid::of(1).sheet((6, 1), factor, [9; 3], |_, _, row| {
                row.fill([7; 3]);
                3..5
            });
            assert_eq!(pixels(&row), seen.into_iter().map(|level| [level; 3]).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_sheet_of_more_colours_than_a_palette_has_shows_nearly_the_same_ones() {
        let colour = |i: usize| [(i % 256) as u8, (i / 256) as u8, 9];
        let sheet = SheetGrid::of(2).sheet((200, 1), 1, [0; 3], |pose, _, row| {
            row.iter_mut().enumerate().for_each(|(x, cell)| *cell = colour(pose * 200 + x));
            0..200
        });
        let off = |(a, b): (u8, u8)| a.abs_diff(b);
        let found = pixels(&sheet).into_flattened();
        let most = found.into_iter().zip((0..400).flat_map(colour)).map(off).max();
        assert!(most.is_some_and(|most| most <= PIXEL_TOLERANCE), "{most:?}");
    }
}
