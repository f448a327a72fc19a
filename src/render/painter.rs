//! From captured vertices to frames, by one pipeline for all submissions.
//!
//! The vertex stage here passes on what the student's computed, so the fixed fragment stage is compiled once and for
//! all, and nothing that belongs to one submission is kept for the next.

use super::device::Device;
use super::frames::Mapped;
use super::scene::Scene;
use super::tiles::{Tile, Tiles};
use crate::translate::{CAPTURE_HEADER, CAPTURE_STRIDE};
use std::borrow::Cow;
use std::sync::Weak;

/// As the course's window: 8 bits a channel, linear, no sRGB encoding.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Passes records on; OpenGL's clip range of z, [−w, w], becomes wgpu's [0, w].
///
/// A colour beyond ±2²⁰ is painted as if it were that: white or black at every pixel that shows any of it, as it is anyway,
/// but the driver's conversion to 8 bits goes through an `i32` and would make black of what that cannot hold.
///
/// Alpha is not seen. It says here what is painted, so that a colour that equals the background is not taken for it.
const PASS_ON: &str = "
struct Vertex {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(perspective, center) colour: vec4f,
}

fn bounded(colour: vec4f) -> vec4f {
    let most = 1048576.0;
    return select(colour, sign(colour) * most, abs(colour) > vec4f(most));
}

@vertex fn pass_on(@location(0) position: vec4f, @location(1) colour: vec4f) -> Vertex {
    return Vertex(vec4f(position.xy, (position.z + position.w) * 0.5, position.w), vec4f(bounded(colour).rgb, 1.0));
}
";

/// Paints frames.
#[derive(Debug)]
pub(super) struct Painter {
    pipeline: wgpu::RenderPipeline,
    target: Option<Target>,
}

/// The texture of all frames, kept from one submission to the next. Every pass clears it.
#[derive(Debug)]
pub(super) struct Target {
    tiles: Tiles,
    texture: wgpu::Texture,
    pub readback: wgpu::Buffer,
    /// Who still reads the last submission's frames.
    pub reader: Weak<Mapped>,
}

impl Painter {
    pub fn new(device: &wgpu::Device, fragment: naga::Module) -> Self {
        let module =
            |label, source| device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(label), source });
        let vertex = module("pass on", wgpu::ShaderSource::Wgsl(Cow::Borrowed(PASS_ON)));
        let fragment = module("fixed fragment stage", wgpu::ShaderSource::Naga(Cow::Owned(fragment)));
        let attributes = wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x4];
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("frames"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &vertex,
                entry_point: None,
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: CAPTURE_STRIDE,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &attributes,
                })],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &fragment,
                entry_point: None,
                compilation_options: Default::default(),
                targets: &[Some(FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { pipeline, target: None }
    }

    /// Paints the frames of a scene whose vertices were captured in `records`, to be read back from the target.
    pub fn submit(&mut self, device: &Device, records: &wgpu::Buffer, scene: &Scene, tiles: &Tiles) -> &mut Target {
        let target = match self.target.take() {
            Some(target) if target.tiles == *tiles && target.reader.strong_count() == 0 => target,
            _ => Target::new(&device.device, tiles.clone()),
        };
        let target = self.target.insert(target);
        let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        target.paint(&mut encoder, &self.pipeline, records, scene);
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
        device.queue.submit([encoder.finish()]);
        target
    }
}

impl Target {
    fn new(device: &wgpu::Device, tiles: Tiles) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("frames"),
            size: tiles.size(),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let readback = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frames, read back"),
            size: u64::from(tiles.bytes_per_row()) * u64::from(tiles.size().height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { tiles, texture, readback, reader: Weak::new() }
    }

    fn paint(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        records: &wgpu::Buffer,
        scene: &Scene,
    ) {
        let [r, g, b, a] = scene.background.map(|channel| f64::from(channel) / 255.0);
        let view = self.texture.create_view(&wgpu::TextureViewDescriptor::default());
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
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, records.slice(CAPTURE_HEADER..));
        let (width, height) = (scene.width as f32, scene.height as f32);
        let mut first = 0;
        for (batch, Tile { area, x, y }) in scene.frames.iter().zip(&self.tiles.tiles) {
            let vertices = first..first + batch.drawn();
            first = vertices.end;
            if area.is_empty() {
                continue;
            }
            // A viewport for the whole frame, of which the tile shows its part.
            let (left, top) = (*x as f32 - area.x as f32, *y as f32 - area.y as f32);
            pass.set_viewport(left, top, width, height, 0.0, 1.0);
            pass.set_scissor_rect(*x, *y, area.width, area.height);
            pass.draw(vertices, 0..1);
        }
    }
}
