//! The textures of a scene as shaders read them: one buffer of numbers (see `textures.glsl` of the translator).

use reference::interpreter::{Compare, Filter, Level, Texels, Texture, Wrap};
use std::sync::Arc;
use wgpu::util::DeviceExt;

/// Words that describe a texture.
const DESCRIPTION: usize = 16;
/// Flags of a description.
const MAGNIFY_LINEAR: u32 = 1;
const MINIFY_LINEAR: u32 = 2;
const BYTES: u32 = 1 << 12;
const DEPTHS: u32 = 1 << 13;
const CLAMPS_REFERENCE: u32 = 1 << 20;

/// The textures of the last scene, which many submissions are drawn with.
#[derive(Debug, Default)]
pub(super) struct Textures {
    last: Option<(Arc<[Texture]>, wgpu::Buffer)>,
}

impl Textures {
    /// The buffer of a scene's textures.
    pub fn buffer(&mut self, device: &wgpu::Device, textures: &Arc<[Texture]>) -> wgpu::Buffer {
        if let Some((_, buffer)) = self.last.as_ref().filter(|(known, _)| Arc::ptr_eq(known, textures)) {
            return buffer.clone();
        }
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("textures"),
            contents: bytemuck::cast_slice(&words(textures)),
            usage: wgpu::BufferUsages::STORAGE,
        });
        self.last = Some((Arc::clone(textures), buffer.clone()));
        buffer
    }
}

/// The number of textures, their descriptions, their texels. Of a texture with levels the first is read.
fn words(textures: &[Texture]) -> Vec<u32> {
    let mut words = vec![textures.len() as u32];
    words.resize(1 + DESCRIPTION * textures.len().max(1), 0);
    for (number, texture) in textures.iter().enumerate() {
        let Some(level) = texture.levels.first() else { continue };
        let first = words.len() as u32;
        let own = describe(texture, level, first);
        words[1 + DESCRIPTION * number..][..own.len()].copy_from_slice(&own);
        match &level.texels {
            Texels::Bytes(texels) => words.extend(texels.iter().map(|texel| u32::from_le_bytes(*texel))),
            Texels::Depths(depths) if depths.each() == 1 => {
                words.extend(depths.drawn().iter().map(|depth| depth.to_bits()));
            }
            texels => {
                let texels = (0..texels.count()).map(|place| texels.at(place));
                words.extend(texels.flatten().map(|number| (number as f32).to_bits()));
            }
        }
    }
    words
}

fn describe(texture: &Texture, level: &Level, first: u32) -> [u32; 9] {
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
        | bit(matches!(level.texels, Texels::Bytes(_)), BYTES)
        | bit(matches!(&level.texels, Texels::Depths(depths) if depths.each() == 1), DEPTHS)
        | compare << 16
        | bit(texture.clamps_reference, CLAMPS_REFERENCE);
    let [width, height, depth] = level.size.map(|side| side as u32);
    let [r, g, b, a] = texture.border.map(|component| (component as f32).to_bits());
    [width, height, depth, first, flags, r, g, b, a]
}
