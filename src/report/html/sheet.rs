//! All poses in one image, and images inside the page.

use crate::fault::Fault;
use crate::report::encode::{Raster, encode};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// How the poses lie in a sheet: row by row, in a grid that is about as wide as it is high, since
/// browsers limit the side of an image more tightly than its area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Grid {
    pub count: usize,
    pub columns: usize,
    pub rows: usize,
}

impl Grid {
    /// The grid for `count` poses, at least one.
    pub fn of(count: usize) -> Self {
        let columns = (1..).find(|side| side * side >= count).unwrap_or(1);
        Self { count, columns, rows: count.div_ceil(columns) }
    }

    /// The steps of the animation: percentage of the cycle, and how far the sheet moves, in
    /// percent of its own size.
    pub fn steps(self) -> Vec<Step> {
        let step = |pose: usize| Step {
            at: 100.0 * pose as f64 / self.count as f64,
            x: 100.0 * (pose % self.columns) as f64 / self.columns as f64,
            y: 100.0 * (pose / self.columns) as f64 / self.rows as f64,
        };
        (0..self.count).map(step).collect()
    }

    /// The pictures, of one size, in their places; cells that are left over are black.
    ///
    /// Of every picture, every `factor`-th pixel of every `factor`-th row: no colour is invented.
    pub fn sheet(self, pictures: &[&Raster], factor: usize) -> Raster {
        let first = pictures.first();
        let width = first.map_or(0, |first| first.width.div_ceil(factor));
        let height = first.map_or(0, |first| first.height.div_ceil(factor));
        let mut sheet = Raster {
            width: width * self.columns,
            height: height * self.rows,
            pixels: vec![[0; 3]; width * height * self.columns * self.rows],
        };
        for (pose, picture) in pictures.iter().enumerate() {
            let corner = (pose / self.columns * height) * sheet.width + pose % self.columns * width;
            for (y, row) in picture.rows().step_by(factor).enumerate() {
                let start = corner + y * sheet.width;
                let cells = sheet.pixels[start..start + width].iter_mut();
                cells.zip(row.iter().step_by(factor)).for_each(|(cell, pixel)| *cell = *pixel);
            }
        }
        sheet
    }
}

/// One step of the animation, in percent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    pub at: f64,
    pub x: f64,
    pub y: f64,
}

/// A picture as a `data:` address.
pub(super) fn address(picture: &Raster) -> Result<String, Fault> {
    let png = encode(&[picture])?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(png)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dot(level: u8) -> Raster {
        Raster { width: 1, height: 1, pixels: vec![[level; 3]] }
    }

    #[test]
    fn the_grid_has_room_for_every_pose() {
        let grid = |count| (Grid::of(count).columns, Grid::of(count).rows);
        assert_eq!([1, 2, 7, 12, 25, 26].map(grid), [(1, 1), (2, 1), (3, 3), (4, 3), (5, 5), (6, 5)]);
    }

    #[test]
    fn every_step_shows_the_cell_that_holds_its_pose() {
        let grid = Grid::of(7);
        let dots: Vec<Raster> = (1..=7).map(dot).collect();
        let sheet = grid.sheet(&dots.iter().collect::<Vec<_>>(), 1);
        assert_eq!((sheet.width, sheet.height), (3, 3));
        for (pose, step) in grid.steps().into_iter().enumerate() {
            let x = (step.x / 100.0 * 3.0).round() as usize;
            let y = (step.y / 100.0 * 3.0).round() as usize;
            assert_eq!(sheet.pixels[y * 3 + x], [pose as u8 + 1; 3]);
            assert!((step.at - 100.0 * pose as f64 / 7.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_reduced_picture_keeps_its_corner_and_its_odd_edge() {
        let picture = Raster { width: 3, height: 3, pixels: (0..9).map(|i| [i; 3]).collect() };
        let half = Grid::of(1).sheet(&[&picture], 2);
        assert_eq!((half.width, half.height), (2, 2));
        assert_eq!(half.pixels, [[0; 3], [2; 3], [6; 3], [8; 3]]);
    }
}
