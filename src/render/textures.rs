//! The textures of a scene as shaders read them: one picture of numbers (see `textures.glsl` of the translator).

use super::device::Device;
use crate::translate::{DESCRIPTION, descriptions};
use reference::interpreter::{Texels, Texture};
use std::sync::Arc;
use wgpu::util::DeviceExt;

/// Numbers of a row of the picture, as `textures.glsl` has it.
const ROW: u32 = 8192;

/// The textures of the last scene, which many submissions are drawn with.
#[derive(Debug, Default)]
pub(super) struct UploadedTextures {
    last: Option<(Arc<[Texture]>, wgpu::TextureView)>,
}

impl UploadedTextures {
    /// The picture of a scene's textures.
    pub fn picture(&mut self, device: &Device, textures: &Arc<[Texture]>) -> wgpu::TextureView {
        if let Some((_, picture)) = self.last.as_ref().filter(|(known, _)| Arc::ptr_eq(known, textures)) {
            return picture.clone();
        }
        let mut words = words(textures);
        words.resize(words.len().next_multiple_of(ROW as usize), 0);
        let descriptor = wgpu::TextureDescriptor {
            label: Some("textures"),
            size: wgpu::Extent3d { width: ROW, height: words.len() as u32 / ROW, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Uint,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        };
        let order = wgpu::util::TextureDataOrder::LayerMajor;
        let texture =
            device.device.create_texture_with_data(&device.queue, &descriptor, order, bytemuck::cast_slice(&words));
        let picture = texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.last = Some((Arc::clone(textures), picture.clone()));
        picture
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
