//! The sheets of a right answer, from which those of a submission are made: most of what is handed in is right, and a right
//! answer draws nearly every pixel as it is expected.

use super::cache::PictureCache;
use super::sheet::SheetGrid;
use super::shots::Shots;
use crate::fault::Fault;
use crate::report::difference::ColourRamp;
use crate::report::encode::{Canvas, mismatched};
use crate::report::{Area, Picture};
use std::sync::Arc;

/// Neighbours in a row that are compared at once.
const STRIDE: usize = 16;

/// What is expected, as the two sheets of a submission that draws just that.
pub(super) struct ExpectedSheets {
    grid: SheetGrid,
    part: Area,
    yours: Canvas,
    difference: Canvas,
}

impl ExpectedSheets {
    /// The base for a part of these pictures, outside of which there is only background.
    pub fn of(expected: &Arc<[Picture]>, grid: SheetGrid, part: Area) -> Result<Arc<Self>, Fault> {
        static MADE: PictureCache<[Picture], Area, Arc<ExpectedSheets>> = PictureCache::new();
        MADE.get(expected, part, || {
            let shots = Shots::of(expected, part).ok_or_else(mismatched)?;
            let (yours, difference) = (shots.sheet(grid, 1), shots.difference(&shots, grid, 1));
            Ok(Arc::new(Self { grid, part, yours, difference }))
        })
    }

    /// The sheet of `yours`, and that of where it differs from `expected`, which the base is made of; `None` where what is drawn has
    /// more colours than a palette. All pictures have one size, and nothing but background outside of the part.
    pub fn sheets(&self, yours: &[Picture], expected: &[Picture]) -> Option<[Canvas; 2]> {
        let (part, ramp) = (self.part, ColourRamp::new());
        let (mut drawn, mut difference) = (self.yours.clone(), self.difference.clone());
        let mut buffers = [Vec::new(), Vec::new()];
        for (pose, (yours, expected)) in yours.iter().zip(expected).enumerate() {
            let (width, height) = (part.width as usize, part.height as usize);
            let corner = pose / self.grid.columns * height * drawn.width + pose % self.grid.columns * width;
            let area = match look_alike(&[yours.blank], &[expected.blank]) {
                true => yours.area.with(expected.area),
                false => part,
            };
            for y in area.rows() {
                let start = corner + (y - part.y) as usize * drawn.width + (area.x - part.x) as usize;
                let [left, right] = &mut buffers;
                let (own, right) = (yours.columns(y, area.columns(), left), expected.columns(y, area.columns(), right));
                let strides = own.chunks(STRIDE).zip(right.chunks(STRIDE)).enumerate();
                for (index, (own, right)) in strides.filter(|(_, (own, right))| !look_alike(own, right)) {
                    let start = start + index * STRIDE;
                    drawn.put(start, own.iter().map(|[r, g, b, _]| [*r, *g, *b]));
                    difference.put(start, own.iter().zip(right).map(|(own, right)| ramp.pixel(own, right)));
                }
            }
            if !drawn.is_indexed() {
                return None;
            }
        }
        Some([drawn, difference])
    }
}

/// Whether pixels have the same colours; alpha is not seen.
pub(super) fn look_alike(a: &[[u8; 4]], b: &[[u8; 4]]) -> bool {
    const RGB: u32 = u32::from_ne_bytes([255, 255, 255, 0]);
    let differences = a.iter().zip(b).map(|(a, b)| (u32::from_ne_bytes(*a) ^ u32::from_ne_bytes(*b)) & RGB);
    differences.fold(0, |any, difference| any | difference) == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Pictures, samples};

    fn pixels(sheet: &Canvas) -> Vec<u8> {
        image::load_from_memory(&sheet.encode().expect("a PNG")).expect("a picture").to_rgb8().into_raw()
    }

    fn whole(pictures: &[Picture]) -> Area {
        Area::whole(pictures[0].width, pictures[0].height)
    }

    fn assert_painted(base: &ExpectedSheets, pictures: &Pictures) {
        let [drawn, difference] = base.sheets(&pictures.yours, &pictures.expected).expect("few colours");
        let [yours, right] = [&pictures.yours, &pictures.expected].map(|all| Shots::of(all, base.part).unwrap());
        assert_eq!(pixels(&drawn), pixels(&yours.sheet(base.grid, 1)));
        assert_eq!(pixels(&difference), pixels(&yours.difference(&right, base.grid, 1)));
    }

    #[test]
    fn the_sheets_are_those_that_are_painted_without_a_base() {
        let mut pictures = samples::pictures();
        // A pixel outside, a missing one, one of another alpha.
        let width = pictures.yours[3].width as usize;
        let yours = Arc::make_mut(&mut pictures.yours);
        yours[3].rgba[..4].copy_from_slice(&[1, 2, 3, 255]);
        yours[4].rgba[4 * (20 * width + 40)..][..4].copy_from_slice(&[255, 255, 255, 0]);
        yours[5].rgba[7] = 9;
        let grid = SheetGrid::of(pictures.expected.len());
        let base = ExpectedSheets::of(&pictures.expected, grid, whole(&pictures.expected)).expect("a base");
        assert_painted(&base, &pictures);
    }

    #[test]
    fn a_part_shows_what_all_shows_there() {
        let mut pictures = samples::pictures();
        let blank = pictures.expected[0].blank;
        let cut = |all: &[Picture]| all.iter().map(|picture| picture.clone().cut(blank)).collect::<Arc<[Picture]>>();
        (pictures.yours, pictures.expected) = (cut(&pictures.yours), cut(&pictures.expected));
        let all = pictures.yours.iter().chain(&*pictures.expected);
        let part = all.fold(Area::default(), |part, picture| part.with(picture.area));
        let grid = SheetGrid::of(pictures.expected.len());
        let [shown, all] = [part, whole(&pictures.expected)]
            .map(|part| ExpectedSheets::of(&pictures.expected, grid, part).expect("a base"));
        assert_painted(&shown, &pictures);
        let [(shown, width), (all, all_width)] =
            [(&shown, part), (&all, whole(&pictures.expected))].map(|(base, part)| {
                let [drawn, _] = base.sheets(&pictures.yours, &pictures.expected).expect("few colours");
                (pixels(&drawn), 3 * part.width as usize)
            });
        // The first picture: the first cell of each sheet.
        for y in 0..part.height as usize {
            let (start, from) = (y * grid.columns * width, 3 * part.x as usize);
            let all_start = (y + part.y as usize) * grid.columns * all_width + from;
            assert_eq!(shown[start..start + width], all[all_start..all_start + width], "row {y}");
        }
    }

    #[test]
    fn more_colours_than_a_palette_has_are_painted_anew() {
        let mut pictures = samples::pictures();
        let noise = Arc::make_mut(&mut pictures.yours)[0].rgba.chunks_exact_mut(4).enumerate();
        noise.for_each(|(i, pixel)| pixel.copy_from_slice(&(i as u32 | 0xff00_0000).to_le_bytes()));
        let grid = SheetGrid::of(pictures.expected.len());
        assert!(
            ExpectedSheets::of(&pictures.expected, grid, whole(&pictures.expected))
                .unwrap()
                .sheets(&pictures.yours, &pictures.expected)
                .is_none()
        );
    }
}
