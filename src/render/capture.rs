//! The student's vertex stage on its own: what it computes for every vertex of the scene goes to a buffer.
//!
//! The pipeline has no fragment stage and paints nothing, so that the driver compiles the student's text and no more.

use super::buffers::{ATTRIBUTE_STRIDE, UniformBuffers, capture_group, capture_layout, vertex_buffer};
use super::device::Device;
use super::scene::{DrawCall, RenderScene};
use crate::translate::{CAPTURE_GROUP, CAPTURE_HEADER, Shader};
use std::borrow::Cow;

/// Of the texture that a pass cannot be without.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth16Unorm;

/// What is the same for every submission.
#[derive(Debug)]
pub(super) struct FrameStage {
    layout: wgpu::BindGroupLayout,
    /// A pixel that nothing is painted to.
    nothing: wgpu::TextureView,
}

impl FrameStage {
    pub fn new(device: &wgpu::Device) -> Self {
        let layout = capture_layout(device, wgpu::ShaderStages::VERTEX, false);
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("nothing"),
            size: wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        Self { layout, nothing: texture.create_view(&wgpu::TextureViewDescriptor::default()) }
    }
}

/// Pipeline and buffers of one submission.
pub(super) struct Capture {
    pipeline: wgpu::RenderPipeline,
    bind_groups: [wgpu::BindGroup; 2],
    vertices: Vec<wgpu::Buffer>,
    /// The header, and the records of all vertices drawn.
    pub records: wgpu::Buffer,
    pub readback: wgpu::Buffer,
    /// Bytes from one batch's uniforms to the next, by block.
    strides: Vec<u32>,
}

impl Capture {
    pub fn new(
        device: &wgpu::Device,
        stage: &FrameStage,
        shader: &Shader,
        scene: &RenderScene,
        textures: Option<&wgpu::TextureView>,
    ) -> Self {
        let batches: Vec<&DrawCall> = scene.batches().collect();
        let uniforms = UniformBuffers::new(device, wgpu::ShaderStages::VERTEX, &shader.uniforms, &batches);
        let size = CAPTURE_HEADER + u64::from(scene.drawn().max(1)) * shader.record_stride();
        let buffer = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_SRC;
        let records = buffer("capture", usage);
        let readback = buffer("capture, read back", wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
        let with_textures = textures.map(|_| capture_layout(device, wgpu::ShaderStages::VERTEX, true));
        let layout = with_textures.as_ref().unwrap_or(&stage.layout);
        let group = capture_group(device, layout, &records, textures);
        let (vertices, formats): (Vec<_>, Vec<_>) =
            shader.inputs.iter().map(|attribute| vertex_buffer(device, attribute, &batches)).unzip();
        Self {
            pipeline: pipeline(device, shader, &formats, [&uniforms.layout, layout]),
            bind_groups: [uniforms.group, group],
            vertices,
            records,
            readback,
            strides: uniforms.strides,
        }
    }

    /// Runs the vertices of the whole scene.
    pub fn submit(&self, device: &Device, stage: &FrameStage, scene: &RenderScene) {
        let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.draw(&mut encoder, stage, scene);
        encoder.copy_buffer_to_buffer(&self.records, 0, &self.readback, 0, self.records.size());
        device.queue.submit([encoder.finish()]);
    }

    fn draw(&self, encoder: &mut wgpu::CommandEncoder, stage: &FrameStage, scene: &RenderScene) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("vertices"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &stage.nothing,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(CAPTURE_GROUP, &self.bind_groups[1], &[]);
        for (slot, buffer) in self.vertices.iter().enumerate() {
            pass.set_vertex_buffer(slot as u32, buffer.slice(..));
        }
        let mut first = 0;
        let mut offsets = vec![0; self.strides.len()];
        for batch in scene.batches() {
            pass.set_bind_group(0, &self.bind_groups[0], &offsets);
            for (slot, buffer) in self.vertices.iter().enumerate() {
                pass.set_vertex_buffer(slot as u32, buffer.slice(u64::from(first) * ATTRIBUTE_STRIDE..));
            }
            // The instance index tells the shader where its records go; see translate::entry.
            pass.draw(0..batch.drawn(), first..first + 1);
            first += batch.drawn();
            offsets.iter_mut().zip(&self.strides).for_each(|(offset, stride)| *offset += stride);
        }
    }
}

fn pipeline(
    device: &wgpu::Device,
    shader: &Shader,
    formats: &[wgpu::VertexFormat],
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
        .inputs
        .iter()
        .zip(formats)
        .map(|(attribute, &format)| [wgpu::VertexAttribute { format, offset: 0, shader_location: attribute.location }])
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
        depth_stencil: Some(wgpu::DepthStencilState {
            format: FORMAT,
            depth_write_enabled: Some(false),
            depth_compare: Some(wgpu::CompareFunction::Always),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}
