//! Textures, as `assignment.toml` has them.

use crate::interpreter::{Compare, Filter, Scalar, Wrap};
use crate::texture::{Colour, Generator};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// A texture: its picture is that of `file` or of `generate`, its pictures are those of `cube`, `layers` or `slices`, or it is depths
/// that a pass draws.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Texture")]
pub struct TextureEntry {
    /// What uniforms call it.
    #[schemars(with = "String")]
    pub name: Spanned<String>,
    /// A PNG in the folder.
    pub file: Option<String>,
    /// The six PNGs of a cube: +x, -x, +y, -y, +z, -z.
    pub cube: Option<[String; 6]>,
    /// A picture that is computed.
    pub generate: Option<Generator>,
    /// The pictures of an array of textures, from layer 0 on.
    pub layers: Option<Vec<PictureOrigin>>,
    /// The pictures of a texture of three dimensions, from the lowest third coordinate on.
    pub slices: Option<Vec<PictureOrigin>>,
    /// Width and height of a picture that is computed or drawn; one number for a texture of one dimension.
    pub size: Option<TextureSize>,
    /// How texels are kept.
    pub format: Option<Format>,
    /// Whether the last row of a file is the first row of texels, so that the picture stands upright.
    pub flip: Option<bool>,
    /// Between texels.
    pub filter: Option<Filter>,
    /// Beyond the picture.
    pub wrap: Option<Wraps>,
    /// What lies beyond the picture with `clamp-to-border`.
    pub border: Option<Colour>,
    /// What a shadow sampler compares: `reference OP texel`. Only of depths.
    pub compare: Option<Compare>,
    /// Of moments, over how many texels to each side the mean is taken.
    pub blur: Option<u32>,
    /// Whether red, green and blue are decoded from sRGB.
    #[serde(default)]
    pub srgb: bool,
}

/// One of several pictures: a PNG in the folder, or one that is computed.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "write the name of a PNG, or a picture that is computed, such as { checker = {} }")]
#[schemars(rename = "Picture")]
pub enum PictureOrigin {
    /// The file.
    File(String),
    /// The computed one.
    Generated(Generator),
}

/// How large a picture is.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "write width and height, such as [64, 64], or one number for a texture of one dimension")]
pub enum TextureSize {
    /// So many texels of one dimension.
    Line(u32),
    /// Width and height.
    Flat([u32; 2]),
}

impl Default for TextureSize {
    fn default() -> Self {
        Self::Flat([256; 2])
    }
}

impl TextureSize {
    /// Width and height.
    pub fn sides(self) -> [u32; 2] {
        match self {
            Self::Line(texels) => [texels, 1],
            Self::Flat(sides) => sides,
        }
    }
}

/// How texels are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// Four bytes: 255ths, from 0 to 1.
    #[default]
    Rgba8,
    /// Four floats.
    Rgba32f,
    /// Four whole numbers, which an `isampler…` reads.
    Rgba32i,
    /// Four whole numbers without a sign, which a `usampler…` reads.
    Rgba32ui,
    /// Depths in 24 bits of fixed point, which a pass draws.
    Depth24,
    /// Depths as floats, which a pass draws.
    Depth32f,
    /// The mean of depths around a texel, and that of their squares, as floats.
    Moments,
}

impl Format {
    /// What a sampler reads of it.
    pub fn texel(self) -> Scalar {
        match self {
            Self::Rgba32i => Scalar::Int,
            Self::Rgba32ui => Scalar::Uint,
            _ => Scalar::Float,
        }
    }

    /// Whether it holds depths.
    pub fn is_depth(self) -> bool {
        matches!(self, Self::Depth24 | Self::Depth32f | Self::Moments)
    }
}

/// Beyond the picture along both coordinates, or along each.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "write \"repeat\", \"mirrored-repeat\", \"clamp-to-edge\" or \"clamp-to-border\", or two of them"
)]
pub enum Wraps {
    /// Along both.
    Both(Wrap),
    /// Along the first, and along the second.
    Each([Wrap; 2]),
}

impl Wraps {
    /// Along each coordinate; the third is like the second.
    pub fn each(self) -> [Wrap; 3] {
        match self {
            Self::Both(wrap) => [wrap; 3],
            Self::Each([first, second]) => [first, second, second],
        }
    }
}
