//! The sheets of a right answer, from which those of a submission are made: most of what is handed in is right, and a right
//! answer draws nearly every pixel as it is expected. Of 30 right answers 26 draw the very same pixels: their sheets are
//! compressed once.

use super::cache::PictureCache;
use super::sheet::Grid;
use super::shots::Shots;
use crate::fault::Fault;
use crate::report::Picture;
use crate::report::difference::Ramp;
use crate::report::encode::{Canvas, mismatched};
use sha2::{Digest, Sha256};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Neighbours in a row that are compared at once.
const STRIDE: usize = 16;

/// So many pairs of sheets are kept that were compressed last, some 100 kB each.
const KEPT: usize = 16;

/// What is expected, as the two sheets of a submission that draws just that.
pub(super) struct Base {
    grid: Grid,
    yours: Canvas,
    difference: Canvas,
    /// The sheets that were compressed last, by what is drawn elsewise than expected; the latest first.
    encoded: Mutex<VecDeque<(Difference, EncodedSheets)>>,
}

/// A digest of all pixels that differ, with their places.
type Difference = [u8; 32];

/// The PNGs of what is drawn, and of where it differs.
type EncodedSheets = [Arc<[u8]>; 2];

impl Base {
    /// The base for these pictures.
    pub fn of(expected: &Arc<[Picture]>, grid: Grid) -> Result<Arc<Self>, Fault> {
        static MADE: PictureCache<[Picture], Arc<Base>> = PictureCache::new();
        MADE.get(expected, 0, || {
            let shots = Shots::of(expected).ok_or_else(mismatched)?;
            let (yours, difference) = (shots.sheet(grid, 1), shots.difference(&shots, grid, 1));
            Ok(Arc::new(Self { grid, yours, difference, encoded: Mutex::default() }))
        })
    }

    /// The sheet of `yours` as a PNG, and that of where it differs from `expected`, which the base is made of; none where one of
    /// the two has more colours than a palette. All pictures have one size.
    pub fn encoded(&self, yours: &[Picture], expected: &[Picture]) -> Result<Option<EncodedSheets>, Fault> {
        let Some((drawn, difference, digest)) = self.sheets(yours, expected) else { return Ok(None) };
        let lock = || self.encoded.lock().unwrap_or_else(PoisonError::into_inner);
        let known = lock().iter().find(|(of, _)| *of == digest).map(|(_, sheets)| sheets.clone());
        if known.is_some() {
            return Ok(known);
        }
        // Not under the lock: two that come at once compress it twice.
        let sheets = [drawn.encode()?.into(), difference.encode()?.into()];
        let mut encoded = lock();
        encoded.push_front((digest, sheets.clone()));
        encoded.truncate(KEPT);
        Ok(Some(sheets))
    }

    fn sheets(&self, yours: &[Picture], expected: &[Picture]) -> Option<(Canvas, Canvas, Difference)> {
        let ramp = Ramp::new();
        let mut digest = Sha256::new();
        let (mut drawn, mut difference) = (self.yours.clone(), self.difference.clone());
        for (pose, (yours, expected)) in yours.iter().zip(expected).enumerate() {
            let (width, height) = (expected.width as usize, expected.height as usize);
            let corner = pose / self.grid.columns * height * drawn.width + pose % self.grid.columns * width;
            let rows = |picture| Picture::pixels(picture).chunks_exact(width);
            for (y, (yours, expected)) in rows(yours).zip(rows(expected)).enumerate() {
                let start = corner + y * drawn.width;
                let strides = yours.chunks(STRIDE).zip(expected.chunks(STRIDE)).enumerate();
                for (index, (yours, expected)) in strides.filter(|(_, (yours, expected))| !look_alike(yours, expected))
                {
                    let start = start + index * STRIDE;
                    digest.update(start.to_le_bytes());
                    digest.update(yours.as_flattened());
                    drawn.put(start, yours.iter().map(|[r, g, b, _]| [*r, *g, *b]));
                    difference.put(start, yours.iter().zip(expected).map(|(yours, right)| ramp.pixel(yours, right)));
                }
            }
            if !drawn.is_indexed() {
                return None;
            }
        }
        Some((drawn, difference, digest.finalize().into()))
    }
}

/// Whether pixels have the same colours; alpha is not seen.
fn look_alike(a: &[[u8; 4]], b: &[[u8; 4]]) -> bool {
    const RGB: u32 = u32::from_ne_bytes([255, 255, 255, 0]);
    let differences = a.iter().zip(b).map(|(a, b)| (u32::from_ne_bytes(*a) ^ u32::from_ne_bytes(*b)) & RGB);
    differences.fold(0, |any, difference| any | difference) == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    fn pixels(sheet: &Canvas) -> Vec<u8> {
        image::load_from_memory(&sheet.encode().expect("a PNG")).expect("a picture").to_rgb8().into_raw()
    }

    #[test]
    fn the_sheets_are_those_that_are_painted_without_a_base() {
        let mut pictures = samples::pictures();
        // A pixel outside, a missing one, one of another alpha.
        let width = pictures.yours[3].width as usize;
        pictures.yours[3].rgba[..4].copy_from_slice(&[1, 2, 3, 255]);
        pictures.yours[4].rgba[4 * (20 * width + 40)..][..4].copy_from_slice(&[255, 255, 255, 0]);
        pictures.yours[5].rgba[7] = 9;
        let grid = Grid::of(pictures.expected.len());
        let base = Base::of(&pictures.expected, grid).expect("a base");
        let (drawn, difference, _) = base.sheets(&pictures.yours, &pictures.expected).expect("few colours");
        let (yours, right) = (Shots::of(&pictures.yours).unwrap(), Shots::of(&pictures.expected).unwrap());
        assert_eq!(pixels(&drawn), pixels(&yours.sheet(grid, 1)));
        assert_eq!(pixels(&difference), pixels(&yours.difference(&right, grid, 1)));
    }

    #[test]
    fn the_same_pixels_are_compressed_once() {
        let mut pictures = samples::pictures();
        let base = Base::of(&pictures.expected, Grid::of(pictures.expected.len())).expect("a base");
        let encoded = |yours: &[Picture]| base.encoded(yours, &pictures.expected).expect("PNGs").expect("few colours");
        let [first, again] = [encoded(&pictures.yours), encoded(&pictures.yours)];
        assert!(first.iter().zip(&again).all(|(first, again)| Arc::ptr_eq(first, again)));
        // One pixel of another colour is another sheet, and the same pixel elsewhere a third.
        let pixel = |yours: &mut [Picture], at: usize| yours[3].rgba[4 * at..][..4].copy_from_slice(&[1, 2, 3, 255]);
        let mut others = [pictures.yours.clone(), pictures.yours.clone()];
        others.iter_mut().zip([70, 71]).for_each(|(yours, at)| pixel(yours, at));
        let others = others.each_ref().map(|yours| encoded(yours));
        assert!(others[0][0] != first[0] && others[1][0] != first[0] && others[0][0] != others[1][0]);
        for number in 0..KEPT {
            pixel(&mut pictures.yours, 100 + number);
            base.encoded(&pictures.yours, &pictures.expected).expect("PNGs");
        }
        assert_eq!(base.encoded.lock().expect("a list").len(), KEPT);
    }

    #[test]
    fn more_colours_than_a_palette_has_are_painted_anew() {
        let mut pictures = samples::pictures();
        let noise = pictures.yours[0].rgba.chunks_exact_mut(4).enumerate();
        noise.for_each(|(i, pixel)| pixel.copy_from_slice(&(i as u32 | 0xff00_0000).to_le_bytes()));
        let grid = Grid::of(pictures.expected.len());
        assert!(Base::of(&pictures.expected, grid).unwrap().sheets(&pictures.yours, &pictures.expected).is_none());
    }
}
