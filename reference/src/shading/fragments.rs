//! The fragments of what is seen, and what the fragment stage reads at them.

use super::Scenery;
use crate::interpreter::{Program, ProgramVariable, WindowCoordinates};
use crate::rasteriser::{Setup, Visible};

/// A pixel that a triangle covers, or one beside it that its quad needs.
#[derive(Clone, Copy)]
pub(super) struct Fragment {
    /// The place of its pixel among those that are asked for.
    pub pixel: Option<u32>,
    /// The place of its triangle.
    number: u32,
    column: u32,
    /// Counted from above; a row above the window is negative.
    row: i64,
}

impl Fragment {
    /// The place of the draw that it belongs to.
    pub(super) fn surface(&self, visible: &Visible) -> u32 {
        visible.setups()[self.number as usize].surface
    }
}

impl Scenery<'_> {
    /// The fragments of pixels: alone, or, where one depends on its neighbours, as 2 × 2 pixels of one triangle, row by row
    /// from below, with those that it does not cover.
    pub(super) fn fragments(&self, visible: &Visible, pixels: &[u32]) -> Vec<Fragment> {
        let (width, height) = visible.size();
        let (width, height) = (width as u32, height as i64);
        let fragment = |(place, pixel): (usize, &u32)| {
            let number = visible.number(*pixel as usize)?;
            Some(Fragment { pixel: Some(place as u32), number, column: pixel % width, row: i64::from(pixel / width) })
        };
        let mut alone: Vec<Fragment> = pixels.iter().enumerate().filter_map(fragment).collect();
        if !self.pipeline.needs_quads(&self.assignment.textures) {
            // Those of one triangle lie together.
            alone.sort_by_key(|fragment| fragment.number);
            return alone;
        }
        // Rows are counted from below: there a window of an odd height has its first quad.
        let quad = |fragment: &Fragment| (fragment.number, (height - 1 - fragment.row) / 2, fragment.column / 2);
        alone.sort_by_key(quad);
        let mut all: Vec<Fragment> = Vec::with_capacity(alone.len() * 2);
        for own in alone.chunk_by(|a, b| quad(a) == quad(b)) {
            let (number, up, right) = quad(&own[0]);
            for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let (column, row) = (2 * right + x, height - 1 - (2 * up + y));
                let covered = own.iter().find(|one| one.column == column && one.row == row);
                all.push(covered.copied().unwrap_or(Fragment { pixel: None, number, column, row }));
            }
        }
        all
    }

    /// What the fragment stage reads, as columns.
    pub(super) fn inputs<'p>(
        &self,
        visible: &Visible,
        program: &'p Program,
        fragments: &[Fragment],
        moved: [f64; 2],
    ) -> Vec<(&'p str, Vec<Vec<f64>>)> {
        let (width, height) = visible.size();
        let mut places = Vec::with_capacity(fragments.len());
        for fragment in fragments {
            let (column, row) = (f64::from(fragment.column) + 0.5, fragment.row as f64 + 0.5);
            let (x, y) = (2.0 * (column + moved[0]) / width - 1.0, 1.0 - 2.0 * (row + moved[1]) / height);
            places.push((&visible.setups()[fragment.number as usize], x, y));
        }
        let column =
            |of: &dyn Fn(&Setup, f64, f64) -> f64| places.iter().map(|(setup, x, y)| of(setup, *x, *y)).collect();
        let given = |(place, input): (usize, &'p ProgramVariable)| {
            let columns = match input.name.as_str() {
                name if let Some(window) = WindowCoordinates::of(name) => vec![
                    column(&|_, x, _| window.along(0, (x + 1.0) / 2.0 * width, height)),
                    column(&|_, _, y| window.along(1, (y + 1.0) / 2.0 * height, height)),
                    column(&Setup::depth),
                    column(&Setup::reciprocal_w),
                ],
                "gl_FrontFacing" => vec![column(&|setup, _, _| f64::from(u8::from(setup.is_front)))],
                "gl_PrimitiveID" => vec![column(&|setup, _, _| f64::from(setup.triangle))],
                _ => {
                    let varying = self.pipeline.varyings.iter().find(|varying| varying.input == place)?;
                    varying
                        .scalars
                        .clone()
                        .map(|scalar| self.interpolated(visible, &places, fragments, scalar))
                        .collect()
                }
            };
            Some((input.name.as_str(), columns))
        };
        program.inputs().iter().enumerate().filter_map(given).collect()
    }

    /// A varying at all places. Fragments of one triangle lie together.
    fn interpolated(
        &self,
        visible: &Visible,
        places: &[(&Setup, f64, f64)],
        fragments: &[Fragment],
        scalar: usize,
    ) -> Vec<f64> {
        let mut last = None;
        let value = |(fragment, (setup, x, y)): (&Fragment, &(&Setup, f64, f64))| {
            let ramp = match last {
                Some((number, ramp)) if number == fragment.number => ramp,
                _ => self.varying(&visible.setups()[fragment.number as usize], scalar),
            };
            last = Some((fragment.number, ramp));
            ramp.at(*x, *y, setup.divisor(*x, *y))
        };
        fragments.iter().zip(places).map(value).collect()
    }
}
