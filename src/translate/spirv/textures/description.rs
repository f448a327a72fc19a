//! How the textures of a homework lie in the buffer that lookups read (see `textures.glsl`).

use reference::interpreter::{Compare, Filter, Level, Texels, Texture, Wrap};
use std::fmt::Write;

/// Words that each texture's description has room for.
pub const DESCRIPTION: usize = 16;
/// Which word of a description says where its texels begin.
const FIRST: usize = 3;
/// Which one holds the flags.
const FLAGS: usize = 4;
/// Flags of a description.
const MAGNIFY_LINEAR: u32 = 1;
const MINIFY_LINEAR: u32 = 2;
const FILTERS: u32 = MAGNIFY_LINEAR | MINIFY_LINEAR;
const BYTES: u32 = 1 << 12;
const DEPTHS: u32 = 1 << 13;
const CLAMPS_REFERENCE: u32 = 1 << 20;

/// A texture: width, height, depth, where its texels begin, flags, and the four numbers of its border.
pub type Description = [u32; 9];

/// The descriptions of textures whose texels stand one after the other, behind the number of textures and all descriptions.
pub fn descriptions(textures: &[Texture]) -> Vec<Description> {
    let mut first = 1 + DESCRIPTION * textures.len().max(1);
    let description = |texture: &Texture| {
        let Some(level) = texture.levels.first() else { return Description::default() };
        let own = describe(texture, level, first as u32);
        first += words(&level.texels);
        own
    };
    textures.iter().map(description).collect()
}

/// How many words texels take.
fn words(texels: &Texels) -> usize {
    texels.count() * if bytes(texels) | depths(texels) == 0 { 4 } else { 1 }
}

fn bytes(texels: &Texels) -> u32 {
    if matches!(texels, Texels::Bytes(_)) { BYTES } else { 0 }
}

fn depths(texels: &Texels) -> u32 {
    if matches!(texels, Texels::Depths(depths) if depths.each() == 1) { DEPTHS } else { 0 }
}

fn describe(texture: &Texture, level: &Level, first: u32) -> Description {
    let bit = |is: bool, bit: u32| if is { bit } else { 0 };
    let wrap = |axis: usize| match texture.wrap[axis] {
        Wrap::Repeat => 0,
        Wrap::MirroredRepeat => 1,
        Wrap::ClampToEdge => 2,
        Wrap::ClampToBorder => 3,
    };
    let compare = texture.compare.map_or(0, |compare| match compare {
        Compare::Never => 1,
        Compare::Less => 2,
        Compare::Equal => 3,
        Compare::LessOrEqual => 4,
        Compare::Greater => 5,
        Compare::NotEqual => 6,
        Compare::GreaterOrEqual => 7,
        Compare::Always => 8,
    });
    let flags = bit(texture.magnify == Filter::Linear, MAGNIFY_LINEAR)
        | bit(texture.minify == Filter::Linear, MINIFY_LINEAR)
        | wrap(0) << 4
        | wrap(1) << 6
        | wrap(2) << 8
        | bytes(&level.texels)
        | depths(&level.texels)
        | compare << 16
        | bit(texture.clamps_reference, CLAMPS_REFERENCE);
    let [width, height, depth] = level.size.map(|side| side as u32);
    let [r, g, b, a] = texture.border.map(|component| (component as f32).to_bits());
    [width, height, depth, first, flags, r, g, b, a]
}

/// What all textures of a homework have in common, where that is everything but their texels. Lookups need not read it then, and the
/// driver leaves out what no texture needs: measured, a lookup in a map of depths takes a fraction of the time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CommonTexture {
    /// The description of the first.
    first: Description,
    /// By how many words the texels of the next one stand behind.
    stride: u32,
}

impl CommonTexture {
    /// `None` where they differ, or where there is none.
    pub fn of(textures: &[Texture]) -> Option<Self> {
        let all = descriptions(textures);
        let first = *all.first()?;
        let stride = words(&textures[0].levels.first()?.texels) as u32;
        let expected = |number: usize| {
            let mut own = first;
            own[FIRST] += stride * number as u32;
            own
        };
        all.iter().enumerate().all(|(number, own)| *own == expected(number)).then_some(Self { first, stride })
    }

    /// What stands before `textures.glsl` to say so.
    pub(super) fn preamble(&self) -> String {
        let mut text = format!("#define ALIKE\n#define STRIDE {}u\n", self.stride);
        // Both filters alike: no level of detail is looked at.
        if let 0 | FILTERS = self.first[FLAGS] & FILTERS {
            text += "#define ONE_FILTER\n";
        }
        for (name, word) in NAMES.iter().zip(self.first) {
            let _ = writeln!(text, "#define {name} {word}u");
        }
        text
    }
}

const NAMES: [&str; 9] = [
    "ALIKE_WIDTH",
    "ALIKE_HEIGHT",
    "ALIKE_DEPTH",
    "ALIKE_FIRST",
    "ALIKE_FLAGS",
    "ALIKE_RED",
    "ALIKE_GREEN",
    "ALIKE_BLUE",
    "ALIKE_ALPHA",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textures_of_one_size_and_kind_are_alike() {
        let texture = |side: usize| Texture::two_dimensional(side, side, vec![[0_u8; 4]; side * side]);
        let alike = CommonTexture::of(&[texture(4), texture(4), texture(4)]).expect("alike");
        // Behind the number of textures and three descriptions of 16 words.
        assert_eq!((alike.first[FIRST], alike.stride), (49, 16));
        assert_eq!(CommonTexture::of(&[texture(4), texture(8)]), None);
        assert_eq!(CommonTexture::of(&[texture(4), Texture { wrap: [Wrap::ClampToEdge; 3], ..texture(4) }]), None);
        assert_eq!(CommonTexture::of(&[]), None);
    }
}
