//! From captured vertices to frames.

use super::device::Device;
use super::fragments::{DEPTH, FragmentData, FragmentStage, PipelineKey};
use super::frames::Mapped;
use super::scene::{DrawCall, RenderScene};
use super::tiles::{TextureTile, Tiles};
use crate::translate::{CAPTURE_HEADER, CAPTURE_SLOT, StageVariable};
use std::sync::Weak;
use wgpu::util::DeviceExt;

/// As the course's window: 8 bits a channel, linear, no sRGB encoding.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Paints frames.
#[derive(Debug, Default)]
pub(super) struct Painter {
    target: Option<RenderTarget>,
}

/// The texture of all frames, kept from one submission to the next. Every pass clears it.
#[derive(Debug)]
pub(super) struct RenderTarget {
    tiles: Tiles,
    texture: wgpu::Texture,
    depth: Option<wgpu::Texture>,
    pub readback: wgpu::Buffer,
    /// Who still reads the last submission's frames.
    pub reader: Weak<Mapped>,
}

/// Captured vertices.
pub(super) struct Records<'a> {
    /// A header, and record after record.
    pub buffer: &'a wgpu::Buffer,
    /// What stands in the slots of a record.
    pub outputs: &'a [StageVariable],
}

impl Records<'_> {
    fn stride(&self) -> u64 {
        (self.outputs.len() as u64 + 1) * CAPTURE_SLOT
    }

    /// The slot of each input.
    fn slots(&self, inputs: &[StageVariable]) -> Vec<usize> {
        let slot = |input: &StageVariable| self.outputs.iter().position(|output| output.name == input.name);
        inputs.iter().map(|input| slot(input).unwrap_or(0)).collect()
    }
}

impl Painter {
    /// Gives back the memory of the frames.
    pub fn put_away(&mut self) {
        self.target = None;
    }

    /// Paints the frames of a scene with a fragment stage, to be read back from the target.
    pub fn submit(
        &mut self,
        device: &Device,
        stage: &mut FragmentStage,
        records: &Records<'_>,
        scene: &RenderScene,
        textures: Option<&wgpu::TextureView>,
        tiles: &Tiles,
    ) -> (&mut RenderTarget, FragmentData) {
        let is_tested = |draw: &DrawCall| draw.state.depth_test.is_some();
        let has_depth = stage.writes_depth || scene.frames.iter().flatten().any(is_tested);
        let target = match self.target.take() {
            Some(target)
                if target.tiles == *tiles
                    && target.reader.strong_count() == 0
                    && target.depth.is_some() == has_depth =>
            {
                target
            }
            _ => RenderTarget::new(&device.device, tiles.clone(), has_depth),
        };
        let target = self.target.insert(target);
        let draws: Vec<&DrawCall> = scene.frames.iter().flatten().collect();
        let data = FragmentData::new(&device.device, stage, &draws, textures, true);
        let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        target.paint(&device.device, &mut encoder, stage, &data, records, scene);
        encoder.copy_texture_to_buffer(
            target.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &target.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(tiles.bytes_per_row()),
                    rows_per_image: None,
                },
            },
            tiles.size(),
        );
        data.copy_header(&mut encoder);
        device.queue.submit([encoder.finish()]);
        (target, data)
    }
}

impl RenderTarget {
    fn new(device: &wgpu::Device, tiles: Tiles, has_depth: bool) -> Self {
        let texture = |label, format, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: tiles.size(),
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let depth = has_depth.then(|| texture("depths", DEPTH, wgpu::TextureUsages::empty()));
        let texture = texture("frames", FORMAT, wgpu::TextureUsages::COPY_SRC);
        let readback = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frames, read back"),
            size: u64::from(tiles.bytes_per_row()) * u64::from(tiles.size().height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { tiles, texture, depth, readback, reader: Weak::new() }
    }

    fn paint(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        stage: &mut FragmentStage,
        data: &FragmentData,
        records: &Records<'_>,
        scene: &RenderScene,
    ) {
        let [r, g, b, a] = scene.background.map(|channel| f64::from(channel) / 255.0);
        let view = self.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let depth = self.depth.as_ref().map(|depth| depth.create_view(&wgpu::TextureViewDescriptor::default()));
        let is_turned = stage.is_flat();
        let (mut corners, mut ranges) = (Vec::new(), Vec::new());
        for draw in scene.frames.iter().flatten() {
            let first = corners.len() as u32;
            corners.extend(draw.corners(is_turned));
            ranges.push(first..corners.len() as u32);
        }
        let buffer = |label, contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let indices = buffer("corners", bytemuck::cast_slice(&corners), wgpu::BufferUsages::INDEX);
        let shifts: Vec<[f32; 2]> = self
            .tiles
            .tiles
            .iter()
            .map(|tile| stage.shift(tile.shift(scene.height).map(f64::from), f64::from(scene.height)))
            .collect();
        let shifts = stage
            .is_placed
            .then(|| buffer("places of frames", bytemuck::cast_slice(&shifts), wgpu::BufferUsages::VERTEX));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("frames"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: depth.as_ref().map(|view| wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_vertex_buffer(0, records.buffer.slice(CAPTURE_HEADER..));
        if let Some(shifts) = &shifts {
            pass.set_vertex_buffer(1, shifts.slice(..));
        }
        if !corners.is_empty() {
            pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        }
        let (width, height) = (scene.width as f32, scene.height as f32);
        let (mut number, mut first) = (0, 0);
        for (frame, (draws, tile)) in (0..).zip(scene.frames.iter().zip(&self.tiles.tiles)) {
            for draw in draws {
                let (own, base, batch) = (ranges[number].clone(), first, number);
                number += 1;
                first += draw.drawn() as i32;
                if tile.area.is_empty() || own.is_empty() {
                    continue;
                }
                let key = PipelineKey {
                    state: draw.state,
                    targets: vec![Some(FORMAT)],
                    has_depth: depth.is_some(),
                    stride: records.stride(),
                    slots: records.slots(&stage.inputs),
                    moves_each: false,
                };
                pass.set_pipeline(stage.pipeline(device, data, &key));
                data.bind(&mut pass, batch);
                // A viewport for the whole frame, of which the tile shows its part.
                let [left, bottom] = tile.origin(scene.height);
                pass.set_viewport(left, bottom, width, height, 0.0, 1.0);
                let TextureTile { area, x, y } = *tile;
                pass.set_scissor_rect(x, y, area.width, area.height);
                pass.draw_indexed(own, base, frame..frame + 1);
            }
        }
    }
}
