//! Textures and how OpenGL reads them (OpenGL 4.1 core, sections 3.8.8 to 3.8.18).

mod cube;
mod depths;
mod sample;

pub use depths::Depths;
pub use sample::Lookup;

use super::code::Slot;
use super::types::{Dimension, Sampler, Scalar};
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::LazyLock;

/// How the texels around a place make its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// The nearest one.
    #[default]
    Nearest,
    /// Weighted by distance.
    Linear,
}

/// What lies beyond the texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Wrap {
    /// The texture again.
    #[default]
    Repeat,
    /// The texture again, mirrored.
    MirroredRepeat,
    /// Its outermost texels.
    ClampToEdge,
    /// The border colour.
    ClampToBorder,
}

/// How a reference value is compared with a texel: `reference OP texel`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "they are what they are called in OpenGL")]
pub enum Compare {
    Never,
    Less,
    Equal,
    LessOrEqual,
    Greater,
    NotEqual,
    GreaterOrEqual,
    Always,
}

/// One picture of a texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Width, height and depth; layers and the six faces of a cube are the last of these that is not 1.
    pub size: [usize; 3],
    /// Texels in order of x, then y, then z.
    pub texels: Texels,
}

/// Red, green, blue and alpha of each texel.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// In 255ths.
    Bytes(Vec<[u8; 4]>),
    /// In 255ths; red, green and blue are coded as in sRGB.
    Srgb(Vec<[u8; 4]>),
    /// As they are.
    Numbers(Vec<[f64; 4]>),
    /// Depths, which are red, or their moments, red and green; what is not there is 0, alpha is 1.
    Depths(Depths),
}

impl Texels {
    /// How many there are.
    pub fn count(&self) -> usize {
        match self {
            Self::Bytes(texels) | Self::Srgb(texels) => texels.len(),
            Self::Numbers(texels) => texels.len(),
            Self::Depths(depths) => depths.count(),
        }
    }

    /// The texel at a place.
    pub fn at(&self, place: usize) -> [f64; 4] {
        match self {
            Self::Bytes(texels) => texels[place].map(|byte| f64::from(byte) / 255.0),
            Self::Srgb(texels) => {
                let [red, green, blue, alpha] = texels[place];
                let [red, green, blue] = [red, green, blue].map(|byte| LINEAR[usize::from(byte)]);
                [red, green, blue, f64::from(alpha) / 255.0]
            }
            Self::Numbers(texels) => texels[place],
            Self::Depths(depths) => {
                let [red, green] = depths.at(place).map(f64::from);
                [red, green, 0.0, 1.0]
            }
        }
    }
}

/// The intensity of each byte of an sRGB texture (OpenGL 4.1 core, section 3.8.16), as a float holds it.
static LINEAR: LazyLock<[f64; 256]> = LazyLock::new(|| {
    std::array::from_fn(|byte| {
        let coded = byte as f64 / 255.0;
        let intensity = if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) };
        f64::from(intensity as f32)
    })
});

impl From<Vec<[f64; 4]>> for Texels {
    fn from(texels: Vec<[f64; 4]>) -> Self {
        Self::Numbers(texels)
    }
}

impl From<Vec<[u8; 4]>> for Texels {
    fn from(texels: Vec<[u8; 4]>) -> Self {
        Self::Bytes(texels)
    }
}

/// A texture with what OpenGL keeps beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Its coordinates.
    pub dimension: Dimension,
    /// Whether it has layers.
    pub array: bool,
    /// What its texels count in: `Float`, or whole numbers.
    pub texel: Scalar,
    /// The pictures, largest first.
    pub levels: Vec<Level>,
    /// For places closer together than texels.
    pub magnify: Filter,
    /// For places farther apart.
    pub minify: Filter,
    /// Between levels; none reads the first only.
    pub mipmap: Option<Filter>,
    /// Beyond the texture, by coordinate.
    pub wrap: [Wrap; 3],
    /// The colour of `ClampToBorder`.
    pub border: [f64; 4],
    /// The comparison that a `…Shadow` sampler makes.
    pub compare: Option<Compare>,
    /// Whether a reference value is clamped to [0, 1], as for depths in fixed point.
    pub clamps_reference: bool,
}

impl Texture {
    /// A texture of two coordinates with one level, read by the nearest texel, repeated.
    pub fn two_dimensional(width: usize, height: usize, texels: impl Into<Texels>) -> Self {
        Self {
            dimension: Dimension::Two,
            array: false,
            texel: Scalar::Float,
            levels: vec![Level { size: [width, height, 1], texels: texels.into() }],
            magnify: Filter::Nearest,
            minify: Filter::Nearest,
            mipmap: None,
            wrap: [Wrap::Repeat; 3],
            border: [0.0; 4],
            compare: None,
            clamps_reference: true,
        }
    }

    /// A cube with one level, read by the nearest texel of a face; the texels of +x, -x, +y, -y, +z, -z.
    pub fn cube(side: usize, texels: impl Into<Texels>) -> Self {
        let levels = vec![Level { size: [side, side, 6], texels: texels.into() }];
        let flat = Self::two_dimensional(0, 0, Vec::<[u8; 4]>::new());
        Self { dimension: Dimension::Cube, levels, wrap: [Wrap::ClampToEdge; 3], ..flat }
    }

    /// The sampler that reads it.
    pub fn sampler(&self) -> Sampler {
        let Self { dimension, array, texel, .. } = *self;
        Sampler { dimension, array, shadow: self.compare.is_some(), texel }
    }

    /// Whether a sampler of this kind may read it. A texture with a comparison is read without it by a sampler that makes none:
    /// a host program switches the comparison on for the one and off for the other.
    pub fn fits(&self, sampler: Sampler) -> bool {
        self.dimension == sampler.dimension
            && self.array == sampler.array
            && self.texel == sampler.texel
            && (self.compare.is_some() || !sampler.shadow)
            && !self.levels.is_empty()
            && self
                .levels
                .iter()
                .all(|level| level.texels.count() == level.size.iter().product::<usize>() && level.size[0] > 0)
    }
}

impl Compare {
    /// 1 where it holds, 0 where not.
    pub fn apply(self, reference: f64, texel: f64) -> f64 {
        f64::from(u8::from(match self {
            Self::Never => false,
            Self::Less => reference < texel,
            Self::Equal => reference == texel,
            Self::LessOrEqual => reference <= texel,
            Self::Greater => reference > texel,
            Self::NotEqual => reference != texel,
            Self::GreaterOrEqual => reference >= texel,
            Self::Always => true,
        }))
    }
}

/// From where a lookup takes its level of detail, and what it gives.
#[derive(Clone, Debug, PartialEq)]
pub enum LookupMode {
    /// From the neighbours' coordinates, plus a bias.
    Implicit(Option<Slot>),
    /// A level.
    Level(Slot),
    /// Derivatives along x and y.
    Gradient(Vec<Slot>, Vec<Slot>),
    /// One texel of a level, by whole coordinates.
    Fetch(Slot),
    /// One component of the four texels around.
    Gather(Slot),
    /// The size of a level.
    Size(Slot),
    /// How many levels there are.
    Levels,
}

/// A lookup as the program asks for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Query {
    /// The number of the texture.
    pub texture: Slot,
    /// What the program takes it for.
    pub sampler: Sampler,
    /// Coordinates and layer, divided already where they are projected.
    pub coordinates: Vec<Slot>,
    /// What texels are compared with.
    pub reference: Option<Slot>,
    /// Whole texels by which the place is moved.
    pub offset: Vec<Slot>,
    /// How it is read.
    pub mode: LookupMode,
    /// Where the results go.
    pub to: Vec<Slot>,
    /// The line that asks.
    pub line: u32,
}

impl Query {
    /// All that it is asked with.
    pub fn operands(&self) -> impl Iterator<Item = Slot> + '_ {
        let of_mode: &[Slot] = match &self.mode {
            LookupMode::Implicit(bias) => bias.as_slice(),
            LookupMode::Level(slot) | LookupMode::Fetch(slot) | LookupMode::Gather(slot) | LookupMode::Size(slot) => {
                std::slice::from_ref(slot)
            }
            LookupMode::Gradient(..) | LookupMode::Levels => &[],
        };
        let along = match &self.mode {
            LookupMode::Gradient(x, y) => [x.as_slice(), y.as_slice()],
            _ => [&[][..]; 2],
        };
        let given = self.coordinates.iter().chain([&self.texture]).chain(&self.reference).chain(&self.offset);
        given.chain(of_mode).chain(along.into_iter().flatten()).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_is_decoded_as_the_standard_says() {
        let red = |byte: u8| Texels::Srgb(vec![[byte, 0, 0, byte]]).at(0)[0];
        // The ends are themselves; 10/255 = 0.0392 lies on the line, 0.0392 / 12.92 = 0.003035.
        assert_eq!([0, 255].map(red), [0.0, 1.0]);
        assert!((red(10) - 0.003_035_27).abs() < 1e-8);
        // 188 is the code nearest to half of the intensity: ((0.73725 + 0.055) / 1.055)^2.4 = 0.50289.
        assert!((red(188) - 0.502_886).abs() < 1e-6);
        // Alpha is no intensity.
        assert_eq!(Texels::Srgb(vec![[0, 0, 0, 51]]).at(0)[3], 0.2);
    }
}
