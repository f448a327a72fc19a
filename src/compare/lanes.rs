//! Differences of many pixels at once.

use super::{PIXEL_TOLERANCE, PackedPixel, RGB};

/// Pixels that are looked at together.
pub(super) const LANES: usize = 16;
/// The bytes that they have.
const BYTES: usize = LANES * 4;

/// How many differences of bytes a `u16` can add up.
pub(super) const MOST_ADDED: u32 = 257;

/// What was added, lane by lane.
pub(super) struct LaneSums {
    /// For each byte its largest difference.
    pub most: [u8; BYTES],
    /// For each byte the sum of all.
    pub sums: [u16; BYTES],
    /// How often the pixel was further off than is tolerated.
    pub far: [u32; LANES],
    /// How many times something was added.
    pub added: u32,
}

impl Default for LaneSums {
    fn default() -> Self {
        Self { most: [0; BYTES], sums: [0; BYTES], far: [0; LANES], added: 0 }
    }
}

impl LaneSums {
    /// Adds the differences of red, green and blue, at most [`MOST_ADDED`] times.
    // Whole lanes without a branch, so that the compiler makes vector instructions of it.
    pub fn add(&mut self, expected: &[PackedPixel; LANES], found: &[PackedPixel; LANES]) {
        let (expected, found) = (expected.map(|pixel| pixel & RGB), found.map(|pixel| pixel & RGB));
        let (expected, found): (&[u8; BYTES], &[u8; BYTES]) =
            (bytemuck::cast_ref(&expected), bytemuck::cast_ref(&found));
        let mut beyond = [0; BYTES];
        for index in 0..BYTES {
            let difference = expected[index].abs_diff(found[index]);
            self.most[index] = self.most[index].max(difference);
            self.sums[index] += u16::from(difference);
            beyond[index] = difference.saturating_sub(PIXEL_TOLERANCE);
        }
        let beyond: &[PackedPixel; LANES] = bytemuck::cast_ref(&beyond);
        self.far.iter_mut().zip(beyond).for_each(|(far, beyond)| *far += u32::from(*beyond != 0));
        self.added += 1;
    }
}
