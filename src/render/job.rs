//! One submission's draws: pipeline, buffers, one pass, one read-back.

use super::buffers::{Uniforms, layout_entry, vertex_buffer};
use super::device::Device;
use super::target::{FORMAT, Target};
use crate::translate::{CAPTURE_GROUP, CAPTURE_HEADER, CAPTURE_STRIDE, Shader};
use std::borrow::Cow;

/// A draw: its vertices, one array of xyz for each attribute, and the matrices that hold for them.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Matrix uniforms by name, column-major.
    pub uniforms: Vec<(String, [f32; 16])>,
    /// Attributes by name; all of one length.
    pub attributes: Vec<(String, Vec<[f32; 3]>)>,
}

impl Batch {
    pub(super) fn vertices(&self) -> u32 {
        self.attributes.first().map_or(0, |(_, values)| values.len() as u32)
    }

    /// How many are drawn: a driver leaves out the vertices of a triangle that is not complete, so the last one is
    /// repeated until it is.
    pub(super) fn drawn(&self) -> u32 {
        self.vertices().next_multiple_of(3)
    }
}

/// What is drawn: frames, which are seen, and probes, of which only the vertices count.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Pixels in a row of a frame.
    pub width: u32,
    /// Rows of a frame.
    pub height: u32,
    /// Colour that a frame is cleared to, RGBA8.
    pub background: [u8; 4],
    /// One batch a frame.
    pub frames: Vec<Batch>,
    /// The probes.
    pub probes: Vec<Batch>,
}

/// Bytes of one attribute of one vertex: xyz as f32; w is 1 where the shader reads it.
pub(super) const ATTRIBUTE_STRIDE: u64 = 12;

/// Pipeline and buffers of one submission.
pub(super) struct Job {
    pipeline: wgpu::RenderPipeline,
    bind_groups: [wgpu::BindGroup; 2],
    vertices: Vec<wgpu::Buffer>,
    capture: wgpu::Buffer,
    pub readback: wgpu::Buffer,
    /// Bytes from one batch's uniforms to the next, by block.
    strides: Vec<u32>,
}

impl Job {
    pub fn new(device: &wgpu::Device, fragment: &wgpu::ShaderModule, shader: &Shader, scene: &Scene) -> Self {
        let batches: Vec<&Batch> = scene.frames.iter().chain(&scene.probes).collect();
        let vertices: u32 = batches.iter().map(|batch| batch.drawn()).sum();
        let uniforms = Uniforms::new(device, &shader.uniforms, &batches);
        let size = CAPTURE_HEADER + u64::from(vertices.max(1)) * CAPTURE_STRIDE;
        let buffer = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let capture = buffer("capture", wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let readback = buffer("capture, read back", wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
        let capture_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("capture"),
            entries: &[layout_entry(0, wgpu::BufferBindingType::Storage { read_only: false }, false)],
        });
        let capture_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("capture"),
            layout: &capture_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: capture.as_entire_binding() }],
        });
        let pipeline = pipeline(device, fragment, shader, [&uniforms.layout, &capture_layout]);
        Self {
            pipeline,
            bind_groups: [uniforms.group, capture_group],
            vertices: shader.attributes.iter().map(|a| vertex_buffer(device, &a.name, &batches)).collect(),
            capture,
            readback,
            strides: uniforms.strides,
        }
    }

    pub fn submit(&self, device: &Device, target: &Target, scene: &Scene) {
        let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.draw(&mut encoder, target, scene);
        encoder.copy_texture_to_buffer(
            target.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &target.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(target.layout.bytes_per_row()),
                    rows_per_image: None,
                },
            },
            target.layout.size(),
        );
        encoder.copy_buffer_to_buffer(&self.capture, 0, &self.readback, 0, self.capture.size());
        device.queue.submit([encoder.finish()]);
    }

    fn draw(&self, encoder: &mut wgpu::CommandEncoder, target: &Target, scene: &Scene) {
        let [r, g, b, a] = scene.background.map(|channel| f64::from(channel) / 255.0);
        let view = target.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("frames and probes"),
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
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(CAPTURE_GROUP, &self.bind_groups[1], &[]);
        let tiles = &target.layout;
        let mut first = 0;
        for (index, batch) in scene.frames.iter().chain(&scene.probes).enumerate() {
            let index = index as u32;
            let count = batch.drawn();
            if index < tiles.count {
                let (x, y) = tiles.origin(index);
                pass.set_viewport(x as f32, y as f32, tiles.width as f32, tiles.height as f32, 0.0, 1.0);
                pass.set_scissor_rect(x, y, tiles.width, tiles.height);
            } else {
                // Probes are captured, not seen.
                pass.set_scissor_rect(0, 0, 0, 0);
            }
            let offsets: Vec<u32> = self.strides.iter().map(|stride| stride * index).collect();
            pass.set_bind_group(0, &self.bind_groups[0], &offsets);
            for (slot, buffer) in self.vertices.iter().enumerate() {
                pass.set_vertex_buffer(slot as u32, buffer.slice(u64::from(first) * ATTRIBUTE_STRIDE..));
            }
            // The instance index tells the shader where its records go; see translate::entry.
            pass.draw(0..count, first..first + 1);
            first += count;
        }
    }
}

fn pipeline(
    device: &wgpu::Device,
    fragment: &wgpu::ShaderModule,
    shader: &Shader,
    groups: [&wgpu::BindGroupLayout; 2],
) -> wgpu::RenderPipeline {
    let vertex = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("submission"),
        source: wgpu::ShaderSource::Naga(Cow::Owned(shader.module.clone())),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("submission"),
        bind_group_layouts: &groups.map(Some),
        immediate_size: 0,
    });
    let attributes: Vec<[wgpu::VertexAttribute; 1]> = shader
        .attributes
        .iter()
        .map(|a| {
            [wgpu::VertexAttribute { format: wgpu::VertexFormat::Float32x3, offset: 0, shader_location: a.location }]
        })
        .collect();
    let buffers: Vec<_> = attributes
        .iter()
        .map(|attributes| {
            Some(wgpu::VertexBufferLayout {
                array_stride: ATTRIBUTE_STRIDE,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes,
            })
        })
        .collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("submission"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &vertex,
            entry_point: None,
            compilation_options: Default::default(),
            buffers: &buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: fragment,
            entry_point: None,
            compilation_options: Default::default(),
            targets: &[Some(FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
