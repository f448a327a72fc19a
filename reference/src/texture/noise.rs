//! Value noise: numbers on a lattice, smoothly joined. It goes on at its other edge, and is the same on every machine.

use super::TexturePicture;
use super::colour::Colour;
use super::generator::{painted, within};
use crate::Text;
use schemars::JsonSchema;
use serde::Deserialize;

/// The finest lattice has at most so many points along a side.
const FINEST: u32 = 4096;

/// Clouds between two colours.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Noise {
    /// Another number makes another picture.
    seed: u32,
    /// The points of the coarsest lattice along width and height.
    cells: [u32; 2],
    /// How many lattices are added up: each is twice as fine as the one before, and half as strong.
    octaves: u32,
    colours: [Colour; 2],
}

impl Default for Noise {
    fn default() -> Self {
        Self { seed: 1, cells: [8; 2], octaves: 4, colours: [Colour::grey(0.0), Colour::grey(1.0)] }
    }
}

impl Noise {
    pub(super) fn picture(&self, size: [usize; 2]) -> Result<TexturePicture<f64>, Text> {
        within("octaves", self.octaves, 1, 8)?;
        self.cells.into_iter().try_for_each(|cells| within("cells", cells, 1, FINEST >> (self.octaves - 1)))?;
        let whole: f64 = (0..self.octaves).map(|octave| 0.5_f64.powi(octave as i32)).sum();
        Ok(painted(size, |at| {
            let level = |octave: u32| self.level(octave, at) * 0.5_f64.powi(octave as i32);
            Colour::mixed(self.colours[0], self.colours[1], (0..self.octaves).map(level).sum::<f64>() / whole)
        }))
    }

    /// One lattice at a place.
    fn level(&self, octave: u32, at: [f64; 2]) -> f64 {
        let cells = self.cells.map(|cells| cells << octave);
        let place = [0, 1].map(|axis| at[axis] * f64::from(cells[axis]));
        let [column, row] = place.map(|place| place.floor() as u32);
        // Its slope is 0 at the points of the lattice.
        let [x, y] = place.map(f64::fract).map(|share| share * share * (3.0 - 2.0 * share));
        let point =
            |right: u32, up: u32| number([self.seed, octave, (column + right) % cells[0], (row + up) % cells[1]]);
        let along = |up: u32| point(0, up) * (1.0 - x) + point(1, up) * x;
        along(0) * (1.0 - y) + along(1) * y
    }
}

/// A number in [0, 1) for each four numbers.
fn number(of: [u32; 4]) -> f64 {
    (of.into_iter().fold(0, mixed) >> 11) as f64 / (1_u64 << 53) as f64
}

/// A step of SplitMix64 (Steele, Lea and Flood, 2014) from a state that was moved by a number.
fn mixed(state: u64, by: u32) -> u64 {
    let z = state.wrapping_add(u64::from(by)).wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixing_is_that_of_splitmix64() {
        // What its authors' program gives first with the seed 0.
        assert_eq!(mixed(0, 0), 0xe220_a839_7b1d_cdaf);
    }

    #[test]
    fn noise_goes_on_at_its_edges_and_depends_on_its_seed() {
        let noise = |seed| Noise { seed, cells: [4, 4], octaves: 2, ..Noise::default() };
        let picture = noise(3).picture([64, 64]).expect("a picture");
        let red = |column: usize, row: usize| picture.texels[row % 64 * 64 + column % 64][0];
        // A cell of the finer lattice is 8 texels wide: a step is 1.5/8 of a difference of at most 1, a third as strong,
        // and 1.5/16 of the other two thirds.
        let steepest = 1.5 / 8.0 / 3.0 + 1.5 / 16.0 * 2.0 / 3.0 + 1e-9;
        for at in 0..64 * 64 {
            let (column, row) = (at % 64, at / 64);
            assert!((red(column + 1, row) - red(column, row)).abs() <= steepest);
            assert!((red(column, row + 1) - red(column, row)).abs() <= steepest);
        }
        let reds = || picture.texels.iter().map(|texel| texel[0]);
        let (low, high) = reds().fold((1.0_f64, 0.0_f64), |(low, high), red| (low.min(red), high.max(red)));
        assert!(low >= 0.0 && high <= 1.0 && high - low > 0.4, "{low} to {high}");
        assert_eq!(picture, noise(3).picture([64, 64]).expect("the same"));
        assert_ne!(picture, noise(4).picture([64, 64]).expect("another"));
    }
}
