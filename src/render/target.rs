//! The texture that all frames of a submission are tiles of.

use super::job::Scene;
use crate::fault::Fault;
use crate::language::Text;

/// Side of the texture that holds the frames; every Vulkan driver for desktops takes it.
const MAX_TEXTURE_SIDE: u32 = 8192;
/// As the course's window: 8 bits a channel, linear, no sRGB encoding.
pub(super) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// How frames lie in the texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tiles {
    pub width: u32,
    pub height: u32,
    pub count: u32,
    pub columns: u32,
    rows: u32,
}

impl Tiles {
    pub fn new(scene: &Scene) -> Result<Self, Fault> {
        let count = scene.frames.len() as u32;
        let (width, height) = (scene.width.max(1), scene.height.max(1));
        // Near a square: no side grows past the limit before it must.
        let columns = (1..=count.max(1)).find(|c| c * width >= count.div_ceil(*c) * height).unwrap_or(1);
        let rows = count.div_ceil(columns).max(1);
        if columns * width > MAX_TEXTURE_SIDE || rows * height > MAX_TEXTURE_SIDE {
            return Err(Fault::new(Text::new(
                format!("{count} frames of {width} × {height} do not fit a texture of {MAX_TEXTURE_SIDE}²"),
                format!("{width} × {height} の画像 {count} 枚は {MAX_TEXTURE_SIDE}² のテクスチャに収まりません"),
            )));
        }
        Ok(Self { width, height, count, columns, rows })
    }

    pub fn size(&self) -> wgpu::Extent3d {
        wgpu::Extent3d { width: self.columns * self.width, height: self.rows * self.height, depth_or_array_layers: 1 }
    }

    pub fn bytes_per_row(&self) -> u32 {
        (self.size().width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
    }

    pub fn origin(&self, index: u32) -> (u32, u32) {
        (index % self.columns * self.width, index / self.columns * self.height)
    }
}

/// The texture of all frames, kept from one submission to the next.
#[derive(Debug)]
pub(super) struct Target {
    pub layout: Tiles,
    pub texture: wgpu::Texture,
    pub readback: wgpu::Buffer,
}

impl Target {
    pub fn new(device: &wgpu::Device, layout: Tiles) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("frames"),
            size: layout.size(),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let readback = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frames, read back"),
            size: u64::from(layout.bytes_per_row()) * u64::from(layout.size().height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { layout, texture, readback }
    }
}
