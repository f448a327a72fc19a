//! Textures and how OpenGL reads them (OpenGL 4.1 core, sections 3.8.8 to 3.8.18).

mod cube;
mod sample;

pub use sample::Lookup;

use super::code::Slot;
use super::types::{Dimension, Sampler};

/// How the texels around a place make its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The nearest one.
    #[default]
    Nearest,
    /// Weighted by distance.
    Linear,
}

/// What lies beyond the texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    pub texels: Vec<[f64; 4]>,
}

/// A texture with what OpenGL keeps beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Its coordinates.
    pub dimension: Dimension,
    /// Whether it has layers.
    pub array: bool,
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
    pub fn two_dimensional(width: usize, height: usize, texels: Vec<[f64; 4]>) -> Self {
        Self {
            dimension: Dimension::Two,
            array: false,
            levels: vec![Level { size: [width, height, 1], texels }],
            magnify: Filter::Nearest,
            minify: Filter::Nearest,
            mipmap: None,
            wrap: [Wrap::Repeat; 3],
            border: [0.0; 4],
            compare: None,
            clamps_reference: true,
        }
    }

    /// Whether a sampler of this kind may read it.
    pub fn fits(&self, sampler: Sampler) -> bool {
        self.dimension == sampler.dimension
            && self.array == sampler.array
            && sampler.shadow == self.compare.is_some()
            && !self.levels.is_empty()
            && self.levels.iter().all(|level| level.texels.len() == level.size.iter().product() && level.size[0] > 0)
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
pub enum Mode {
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
    pub mode: Mode,
    /// Where the results go.
    pub to: Vec<Slot>,
    /// The line that asks.
    pub line: u32,
}
