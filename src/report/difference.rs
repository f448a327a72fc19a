//! The picture of a difference: one ramp of bands, shared by every view.
//!
//! What is within the tolerance of the comparison is drawn as agreeing: a frame that agrees has nothing in its
//! difference picture. The bands double from there, so that the smallest mistake and the largest one both show. The
//! lightness rises with the band: the ramp reads without colour.

use super::{Picture, SILHOUETTE};
use crate::compare::PIXEL_TOLERANCE;

/// One step of the ramp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Band {
    /// Smallest difference in it, in 1/255.
    pub low: u8,
    /// Largest difference in it, in 1/255.
    pub high: u8,
    /// Its colour in the difference picture.
    pub colour: [u8; 3],
    /// Its character in a terminal; neighbours share one.
    pub shade: char,
}

impl Band {
    /// The differences in it, such as `4–7`.
    pub fn range(&self) -> String {
        range(self.low, self.high)
    }
}

const fn band(low: u8, high: u8, colour: [u8; 3], shade: char) -> Band {
    Band { low, high, colour, shade }
}

/// The ramp, from the smallest difference that counts up.
pub(super) const BANDS: [Band; 7] = [
    band(PIXEL_TOLERANCE + 1, 3, [0xa0, 0x2c, 0x9a], '░'),
    band(4, 7, [0xc9, 0x3a, 0x7c], '▒'),
    band(8, 15, [0xe5, 0x53, 0x4f], '▒'),
    band(16, 31, [0xf3, 0x74, 0x2b], '▓'),
    band(32, 63, [0xfb, 0x9b, 0x06], '▓'),
    band(64, 127, [0xf7, 0xd1, 0x3d], '█'),
    band(128, 255, [0xfc, 0xff, 0xa4], '█'),
];

/// The shades of a terminal with the differences that each stands for.
pub(super) fn shades() -> impl Iterator<Item = (char, String)> {
    let same_shade = BANDS.chunk_by(|a, b| a.shade == b.shade);
    same_shade.map(|bands| (bands[0].shade, range(bands[0].low, bands[bands.len() - 1].high)))
}

/// The differences that are drawn as agreeing, such as `0–2`.
pub(super) fn agreeing() -> String {
    range(0, PIXEL_TOLERANCE)
}

/// The place in [`BANDS`] of a difference in 1/255; none within the tolerance. What is not finite counts as the largest.
pub(super) fn band_of(difference: f64) -> Option<usize> {
    // f64::min returns the other operand for NaN, and so the largest difference.
    let level = difference.ceil().min(255.0) as u8;
    BANDS.iter().position(|band| level <= band.high).filter(|_| level > PIXEL_TOLERANCE)
}

/// Where two pictures differ, by the largest of the three colour channels; alpha is not seen.
///
/// Where they agree within the tolerance, and on the silhouette, the expected picture shows through as a faint negative in four steps, so that
/// a difference can be placed. Both pictures have one size.
pub(super) fn difference(yours: &Picture, expected: &Picture) -> Vec<[u8; 3]> {
    let ramp = ColourRamp::new();
    let (yours, expected) = (yours.pixels(), expected.pixels());
    yours.iter().zip(expected.iter()).map(|(yours, expected)| ramp.pixel(yours, expected)).collect()
}

/// The colour of every difference, and of every sum of channels where it is within the tolerance.
pub(super) struct ColourRamp {
    bands: [[u8; 3]; 256],
    ghosts: [[u8; 3]; 3 * 255 + 1],
}

impl ColourRamp {
    pub fn new() -> Self {
        let band = |level| band_of(level as f64).map_or([0; 3], |band| BANDS[band].colour);
        Self { bands: std::array::from_fn(band), ghosts: std::array::from_fn(ghost) }
    }

    /// The pixel of the difference picture.
    pub fn pixel(&self, [r, g, b, _]: &[u8; 4], [er, eg, eb, coverage]: &[u8; 4]) -> [u8; 3] {
        let level = r.abs_diff(*er).max(g.abs_diff(*eg)).max(b.abs_diff(*eb));
        if level <= PIXEL_TOLERANCE || *coverage == SILHOUETTE {
            self.ghosts[usize::from(*er) + usize::from(*eg) + usize::from(*eb)]
        } else {
            self.bands[usize::from(level)]
        }
    }
}

/// What shows of a pixel on which both agree, by the sum of its channels.
fn ghost(sum: usize) -> [u8; 3] {
    let darkness = 3 - (sum * 3 / (3 * 255)).min(3);
    [0x12 + 0x0b * darkness as u8; 3]
}

fn range(low: u8, high: u8) -> String {
    if low == high { low.to_string() } else { format!("{low}–{high}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dot(rgba: [u8; 4]) -> Picture {
        Picture::whole(1, 1, rgba.to_vec())
    }

    #[test]
    fn bands_cover_every_difference_beyond_the_tolerance_once() {
        let mut next = u32::from(PIXEL_TOLERANCE) + 1;
        for (index, band) in BANDS.iter().enumerate() {
            assert_eq!(u32::from(band.low), next);
            next = u32::from(band.high) + 1;
            for level in band.low..=band.high {
                assert_eq!(band_of(f64::from(level)), Some(index));
            }
        }
        assert_eq!(next, 256);
    }

    #[test]
    fn ramp_gets_lighter_band_by_band() {
        // Rec. 709 luma, without its scale.
        let luma = |[r, g, b]: [u8; 3]| 2126 * u32::from(r) + 7152 * u32::from(g) + 722 * u32::from(b);
        let faintest_ghost = luma(ghost(0));
        assert!(luma(BANDS[0].colour) > faintest_ghost);
        assert!(BANDS.windows(2).all(|pair| luma(pair[1].colour) > luma(pair[0].colour)));
    }

    #[test]
    fn what_is_tolerated_has_no_band_and_what_is_not_finite_has_the_last() {
        assert_eq!(band_of(0.0), None);
        assert_eq!(band_of(f64::from(PIXEL_TOLERANCE)), None);
        // Beyond the tolerance by however little.
        assert_eq!(band_of(f64::from(PIXEL_TOLERANCE) + 0.3), Some(0));
        assert_eq!(band_of(f64::NAN), Some(BANDS.len() - 1));
        assert_eq!(band_of(f64::INFINITY), Some(BANDS.len() - 1));
    }

    #[test]
    fn a_difference_shows_in_any_colour_channel_beyond_the_tolerance_and_alpha_does_not() {
        let expected = dot([30, 0, 0, 255]);
        let over = PIXEL_TOLERANCE + 1;
        for rgba in [[30 + over, 0, 0, 255], [30, over, 0, 255], [30, 0, over, 255]] {
            assert_eq!(difference(&dot(rgba), &expected), [BANDS[0].colour]);
        }
        for rgba in [[30 + PIXEL_TOLERANCE, 0, 0, 255], [30 - PIXEL_TOLERANCE, 2, 2, 255], [30, 0, 0, 0]] {
            assert_eq!(difference(&dot(rgba), &expected), [ghost(30)], "{rgba:?}");
        }
        // On the silhouette either colour is right.
        assert_eq!(difference(&dot([255; 4]), &dot([30, 0, 0, SILHOUETTE])), [ghost(30)]);
    }
}
