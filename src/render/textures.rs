//! The textures of a scene as shaders read them: one buffer of numbers (see `textures.glsl` of the translator).

use crate::translate::{DESCRIPTION, descriptions};
use reference::interpreter::{Texels, Texture};
use std::sync::Arc;
use wgpu::util::DeviceExt;

/// The textures of the last scene, which many submissions are drawn with.
#[derive(Debug, Default)]
pub(super) struct UploadedTextures {
    last: Option<(Arc<[Texture]>, wgpu::Buffer)>,
}

impl UploadedTextures {
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
    for ((number, texture), own) in textures.iter().enumerate().zip(descriptions(textures)) {
        let Some(level) = texture.levels.first() else { continue };
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
