//! Pictures that are computed.

use super::TexturePicture;
use super::colour::Colour;
use super::noise::Noise;
use super::sky::Sky;
use crate::Text;
use crate::text::both;
use schemars::JsonSchema;
use serde::Deserialize;
use std::fmt::Display;

/// More along a side than this is refused: of squares, of bumps, of colours.
const MOST_ALONG: u32 = 4096;

/// Refuses what is out of range; it says what the range is.
pub(super) fn within<N: PartialOrd + Display>(key: &str, number: N, least: N, greatest: N) -> Result<(), Text> {
    let message = || {
        both(
            format!("`{key}` has to be {least} to {greatest}"),
            format!("`{key}` は {least} 以上 {greatest} 以下にしてください"),
        )
    };
    if number >= least && number <= greatest { Ok(()) } else { Err(message()) }
}

/// A picture with its parameters, as a folder writes it: `{ checker = { squares = [8, 8] } }`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Generator {
    /// Squares of two colours.
    Checker(Checker),
    /// Colours that run into one another.
    Gradient(Gradient),
    /// A cloudy surface.
    Noise(Noise),
    /// Round bumps.
    Bumps(Bumps),
    /// The normals of a surface whose height is the red of another picture.
    NormalMap(NormalMap),
    /// What is seen around, as a cube.
    Sky(Sky),
}

/// Squares; the lower left one has the first colour.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Checker {
    squares: [u32; 2],
    colours: [Colour; 2],
}

impl Default for Checker {
    fn default() -> Self {
        Self { squares: [8; 2], colours: [Colour::grey(0.0), Colour::grey(1.0)] }
    }
}

/// Rows of colours, the lowest first. The middles of the outermost texels have the outermost colours; between the colours it
/// is linear.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gradient {
    rows: Vec<Vec<Colour>>,
}

/// Round bumps in rows and columns, from one colour up to another.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Bumps {
    count: [u32; 2],
    /// Of a bump; the room that it has is 1 wide.
    radius: f64,
    colours: [Colour; 2],
}

impl Default for Bumps {
    fn default() -> Self {
        Self { count: [8; 2], radius: 0.4, colours: [Colour::grey(0.0), Colour::grey(1.0)] }
    }
}

/// Normals in tangent space, as colours: 2 c − 1 is the normal.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NormalMap {
    of: Box<Generator>,
    /// How high 1 is; the picture is 1 wide and 1 high.
    #[serde(default = "low")]
    height: f64,
}

fn low() -> f64 {
    0.05
}

impl Generator {
    /// Whether it makes the six faces of a cube.
    pub fn is_cube(&self) -> bool {
        matches!(self, Self::Sky(_))
    }

    /// The pictures in this size: six of a cube, or one.
    ///
    /// # Errors
    /// The parameters make none.
    pub fn pictures(&self, size: [usize; 2]) -> Result<Vec<TexturePicture<f64>>, Text> {
        match self {
            Self::Sky(sky) => sky.pictures(size),
            flat => Ok(vec![flat.picture(size)?]),
        }
    }

    fn picture(&self, size: [usize; 2]) -> Result<TexturePicture<f64>, Text> {
        Ok(match self {
            Self::Checker(checker) => checker.picture(size)?,
            Self::Gradient(gradient) => gradient.picture(size)?,
            Self::Noise(noise) => noise.picture(size)?,
            Self::Bumps(bumps) => bumps.picture(size)?,
            Self::NormalMap(map) => map.picture(size)?,
            Self::Sky(_) => {
                return Err(both(
                    "`of` is the surface whose normals are computed: a sky is none",
                    "`of` には法線を求める面を書いてください。`sky` は使えません",
                ));
            }
        })
    }
}

/// A picture of what a place has: its coordinates are those of the texel's middle.
pub(super) fn painted(size: [usize; 2], colour: impl Fn([f64; 2]) -> Colour) -> TexturePicture<f64> {
    let [width, height] = size;
    let middle = |at: usize, count: usize| (at as f64 + 0.5) / count as f64;
    let texel = |at: usize| colour([middle(at % width, width), middle(at / width, height)]).0;
    TexturePicture { width, height, texels: (0..width * height).map(texel).collect() }
}

impl Checker {
    fn picture(&self, size: [usize; 2]) -> Result<TexturePicture<f64>, Text> {
        self.squares.into_iter().try_for_each(|count| within("squares", count, 1, MOST_ALONG))?;
        let squares = self.squares.map(f64::from);
        Ok(painted(size, |at| {
            let [column, row] = [0, 1].map(|axis| (at[axis] * squares[axis]).floor() as usize);
            self.colours[(column + row) % 2]
        }))
    }
}

impl Gradient {
    fn picture(&self, size: [usize; 2]) -> Result<TexturePicture<f64>, Text> {
        within("rows", self.rows.len(), 1, MOST_ALONG as usize)?;
        for row in &self.rows {
            within("rows", row.len(), 1, MOST_ALONG as usize)?;
        }
        // From the middle of the first texel to that of the last; of one texel it is the middle of the colours.
        let place = |at: f64, texels: usize, colours: usize| {
            let texels = texels as f64;
            let share = if texels > 1.0 { (at * texels - 0.5) / (texels - 1.0) } else { 0.5 };
            let place = share.clamp(0.0, 1.0) * (colours - 1) as f64;
            // Rounding does not take it beyond a colour that it is meant to meet.
            let place = if (place - place.round()).abs() < 1e-9 { place.round() } else { place };
            (place.floor() as usize, (place.floor() as usize + 1).min(colours - 1), place.fract())
        };
        Ok(painted(size, |[x, y]| {
            let along = |row: &[Colour]| {
                let (low, high, share) = place(x, size[0], row.len());
                Colour::mixed(row[low], row[high], share)
            };
            let (low, high, share) = place(y, size[1], self.rows.len());
            Colour::mixed(along(&self.rows[low]), along(&self.rows[high]), share)
        }))
    }
}

impl Bumps {
    fn picture(&self, size: [usize; 2]) -> Result<TexturePicture<f64>, Text> {
        self.count.into_iter().try_for_each(|count| within("count", count, 1, MOST_ALONG))?;
        within("radius", self.radius, 0.01, 1.0)?;
        let count = self.count.map(f64::from);
        Ok(painted(size, |at| {
            let [x, y] = [0, 1].map(|axis| (at[axis] * count[axis]).fract() - 0.5);
            let falloff = (1.0 - (x * x + y * y) / (self.radius * self.radius)).max(0.0);
            Colour::mixed(self.colours[0], self.colours[1], falloff * falloff)
        }))
    }
}

impl NormalMap {
    fn picture(&self, size: [usize; 2]) -> Result<TexturePicture<f64>, Text> {
        within("height", self.height, -10.0, 10.0)?;
        let [width, height] = size;
        let surface = self.of.picture(size)?;
        let level = |column: usize, row: usize| surface.texels[row % height * width + column % width][0];
        let texel = |at: usize| {
            // The picture goes on at its other edge.
            let (column, row) = (at % width + width, at / width + height);
            let along_x = (level(column + 1, row) - level(column - 1, row)) * width as f64 / 2.0;
            let along_y = (level(column, row + 1) - level(column, row - 1)) * height as f64 / 2.0;
            let normal = glam::DVec3::new(-self.height * along_x, -self.height * along_y, 1.0).normalize();
            (normal * 0.5 + 0.5).extend(1.0).to_array()
        };
        Ok(TexturePicture { width, height, texels: (0..width * height).map(texel).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn generator(text: &str) -> Generator {
        toml::from_str::<std::collections::BTreeMap<String, Generator>>(&format!("x = {text}"))
            .expect(text)
            .remove("x")
            .expect("x")
    }

    fn reds(text: &str, size: [usize; 2]) -> Vec<f64> {
        let pictures = generator(text).pictures(size).expect(text);
        pictures[0].texels.iter().map(|texel| texel[0]).collect()
    }

    #[test]
    fn the_lower_left_square_has_the_first_colour() {
        let text = "{ checker = { squares = [2, 1], colours = [[1, 0, 0], [0.5, 0, 0]] } }";
        assert_eq!(reds(text, [4, 2]), [1.0, 1.0, 0.5, 0.5, 1.0, 1.0, 0.5, 0.5]);
        assert_eq!(reds("{ checker = { squares = [2, 2] } }", [2, 2]), [0.0, 1.0, 1.0, 0.0]);
    }

    #[test]
    fn a_gradient_meets_its_colours() {
        // As many texels as colours: each is one.
        assert_eq!(
            reds("{ gradient = { rows = [[[0.1, 0, 0], [0.9, 0, 0], [0.3, 0, 0]]] } }", [3, 1]),
            [0.1, 0.9, 0.3]
        );
        let corners = "{ gradient = { rows = [[[0, 0, 0], [1, 0, 0]], [[0.5, 1, 0], [0.5, 1, 0]]] } }";
        assert_eq!(reds(corners, [3, 3]), [0.0, 0.5, 1.0, 0.25, 0.5, 0.75, 0.5, 0.5, 0.5]);
        assert_eq!(reds(corners, [1, 1]), [0.5]);
    }

    #[test]
    fn bumps_are_highest_in_their_middle() {
        let heights = reds("{ bumps = { count = [1, 1], radius = 0.5 } }", [3, 3]);
        // The middle of an edge is a third away: (1 − (1/3)² / 0.25)² = (5/9)²; a corner is √2/3 away: (1 − 8/9)².
        let [edge, corner] = [(5.0_f64 / 9.0).powi(2), (1.0_f64 / 9.0).powi(2)];
        for (height, expected) in heights.iter().zip([corner, edge, corner, edge, 1.0, edge, corner, edge, corner]) {
            assert!((height - expected).abs() < 1e-12, "{heights:?}");
        }
    }

    #[test]
    fn normals_lean_away_from_the_rise() {
        // Height 0, 1, 0, 0 along x at a height of 0.5 and a width of 4 texels: slopes by central differences.
        let text = "{ normal-map = { height = 0.5, of = { gradient = { rows = [[[0, 0, 0], [1, 0, 0], [0, 0, 0], [0, 0, 0]]] } } } }";
        let pictures = generator(text).pictures([4, 1]).expect("a picture");
        let slopes = [2.0, 0.0, -2.0, 0.0].map(|slope: f64| slope * 0.5);
        for (texel, slope) in pictures[0].texels.iter().zip(slopes) {
            let normal = texel.map(|channel| 2.0 * channel - 1.0);
            let length = (slope * slope + 1.0).sqrt();
            assert!((normal[0] + slope / length).abs() < 1e-12 && (normal[2] - 1.0 / length).abs() < 1e-12);
            assert_eq!((normal[1], texel[3]), (0.0, 1.0));
        }
    }

    #[test]
    fn numbers_that_make_no_picture_are_named() {
        for (text, expected) in [
            ("{ checker = { squares = [0, 8] } }", "`squares` has to be 1 to 4096"),
            ("{ bumps = { radius = nan } }", "`radius` has to be 0.01 to 1"),
            ("{ gradient = { rows = [] } }", "`rows` has to be 1 to 4096"),
            ("{ noise = { octaves = 40 } }", "`octaves` has to be 1 to 8"),
            ("{ normal-map = { of = { sky = {} } } }", "`of` is the surface whose normals are computed: a sky is none"),
        ] {
            assert_eq!(generator(text).pictures([2, 2]).expect_err(text).en, expected);
        }
    }
}
