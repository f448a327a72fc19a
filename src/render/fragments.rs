//! A fragment stage behind captured vertices: a vertex stage of ours passes on what was captured, so that it does not
//! matter where the numbers come from.
//!
//! Every pass is drawn upside down: row 0 of the target is the bottom one, as in OpenGL, so that `gl_FragCoord`, `dFdy`
//! and `gl_FrontFacing` are those of OpenGL.

mod pass_on;

use super::buffers::{UniformBuffers, capture_group, capture_layout};
use super::scene::{DrawCall, DrawState};
use crate::translate::{CAPTURE_HEADER, CAPTURE_SLOT, InputInterpolation, Shader, StageVariable, UniformBlock};
use naga::ScalarKind;
use pass_on::pass_on;
use reference::interpreter::WindowCoordinates;
use reference::scene::{Cull, DepthTest};
use std::borrow::Cow;
use wgpu::util::DeviceExt;

/// The format of depths.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Bytes of what is added to `gl_FragCoord`.
pub(super) const SHIFT_STRIDE: u64 = 8;

/// A fragment stage and its pipelines.
#[derive(Debug)]
pub(super) struct FragmentStage {
    pass_on: wgpu::ShaderModule,
    module: wgpu::ShaderModule,
    /// What it is fed.
    pub inputs: Vec<StageVariable>,
    /// What it gives.
    pub outputs: Vec<StageVariable>,
    blocks: Vec<UniformBlock>,
    /// How it counts places in the window.
    window: WindowCoordinates,
    /// Whether it reads `gl_FragCoord`.
    pub is_placed: bool,
    /// Whether it gives a depth of its own, for which a pass needs a target.
    pub writes_depth: bool,
    is_fixed: bool,
    pub reads_textures: bool,
    /// Whether it takes derivatives.
    pub has_derivatives: bool,
    pipelines: Vec<(PipelineKey, wgpu::RenderPipeline)>,
}

/// What tells pipelines of one stage apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct PipelineKey {
    /// How fragments are kept.
    pub state: DrawState,
    /// The formats of the targets.
    pub targets: Vec<Option<wgpu::TextureFormat>>,
    /// Whether there is a target for depths.
    pub has_depth: bool,
    /// Bytes of a record.
    pub stride: u64,
    /// For each input, its slot in a record behind the position.
    pub slots: Vec<usize>,
    /// Whether `gl_FragCoord` is moved for each vertex by itself.
    pub moves_each: bool,
}

/// What a fragment stage reads besides its inputs, for the batches of one pass.
pub(super) struct FragmentData {
    uniforms: UniformBuffers,
    header: Option<PassHeader>,
}

/// The header of a pass.
struct PassHeader {
    buffer: wgpu::Buffer,
    readback: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl FragmentStage {
    pub fn new(device: &wgpu::Device, shader: &Shader) -> Self {
        let module =
            |label, source| device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(label), source });
        Self {
            pass_on: module("pass on", wgpu::ShaderSource::Wgsl(Cow::Owned(pass_on(shader)))),
            module: module("fragment stage", wgpu::ShaderSource::Naga(Cow::Owned(shader.module.clone()))),
            inputs: shader.inputs.clone(),
            outputs: shader.outputs.clone(),
            blocks: shader.uniforms.clone(),
            is_placed: shader.shift.is_some(),
            window: shader.window,
            writes_depth: shader.writes_depth(),
            is_fixed: shader.is_fixed,
            reads_textures: shader.reads_textures,
            has_derivatives: shader.has_derivatives(),
            pipelines: Vec::new(),
        }
    }

    /// What is added to a place in the target, or what it is taken from where rows are counted from the top; by OpenGL's own rules
    /// it is `shift`, in a window of so many rows.
    pub fn shift(&self, shift: [f64; 2], rows: f64) -> [f32; 2] {
        [0, 1].map(|axis| self.window.along(axis, shift[axis], rows) as f32)
    }

    /// Whether it has a group for header and textures.
    fn has_group(&self) -> bool {
        !self.is_fixed || self.reads_textures
    }

    /// Whether the order of a triangle's corners is seen.
    pub fn is_flat(&self) -> bool {
        self.inputs.iter().any(is_flat)
    }

    /// The pipeline for passes of this kind.
    pub fn pipeline(&mut self, device: &wgpu::Device, data: &FragmentData, key: &PipelineKey) -> &wgpu::RenderPipeline {
        let known = self.pipelines.iter().position(|(known, _)| known == key);
        let place = known.unwrap_or_else(|| {
            self.pipelines.push((key.clone(), self.make(device, data, key)));
            self.pipelines.len() - 1
        });
        &self.pipelines[place].1
    }

    fn make(&self, device: &wgpu::Device, data: &FragmentData, key: &PipelineKey) -> wgpu::RenderPipeline {
        let header = capture_layout(device, wgpu::ShaderStages::FRAGMENT, self.reads_textures);
        let mut groups = vec![Some(&data.uniforms.layout)];
        groups.extend(self.has_group().then_some(Some(&header)));
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("fragments"),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let attribute = |shader_location: usize, offset, format| wgpu::VertexAttribute {
            format,
            offset,
            shader_location: shader_location as u32,
        };
        let mut attributes = vec![attribute(0, 0, wgpu::VertexFormat::Float32x4)];
        attributes.extend(
            self.inputs
                .iter()
                .zip(&key.slots)
                .enumerate()
                .map(|(number, (input, slot))| attribute(number + 1, (*slot as u64 + 1) * CAPTURE_SLOT, format(input))),
        );
        let shift = [attribute(self.inputs.len() + 1, 0, wgpu::VertexFormat::Float32x2)];
        let (array_stride, step_mode) = (key.stride, wgpu::VertexStepMode::Vertex);
        let mut buffers = vec![Some(wgpu::VertexBufferLayout { array_stride, step_mode, attributes: &attributes })];
        let each = if key.moves_each { step_mode } else { wgpu::VertexStepMode::Instance };
        buffers.extend(self.is_placed.then_some(Some(wgpu::VertexBufferLayout {
            array_stride: SHIFT_STRIDE,
            step_mode: each,
            attributes: &shift,
        })));
        let targets: Vec<_> = key.targets.iter().map(|format| format.map(wgpu::ColorTargetState::from)).collect();
        let depth_compare = match key.state.depth_test {
            None => wgpu::CompareFunction::Always,
            Some(DepthTest::Less) => wgpu::CompareFunction::Less,
            Some(DepthTest::LessEqual) => wgpu::CompareFunction::LessEqual,
        };
        let cull_mode = match key.state.cull {
            Cull::None => None,
            Cull::Back => Some(wgpu::Face::Back),
            Cull::Front => Some(wgpu::Face::Front),
        };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("fragments"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &self.pass_on,
                entry_point: None,
                compilation_options: Default::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                // Upside down, what runs anticlockwise runs clockwise.
                front_face: wgpu::FrontFace::Cw,
                cull_mode,
                ..Default::default()
            },
            depth_stencil: key.has_depth.then(|| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(key.state.depth_test.is_some()),
                depth_compare: Some(depth_compare),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                entry_point: None,
                compilation_options: Default::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

impl FragmentData {
    /// For a pass that paints frames, or one that does not.
    pub fn new(
        device: &wgpu::Device,
        stage: &FragmentStage,
        batches: &[&DrawCall],
        textures: Option<&wgpu::TextureView>,
        is_frame: bool,
    ) -> Self {
        let header = stage.has_group().then(|| {
            let mut words = [0_u32; CAPTURE_HEADER as usize / 4];
            words[4] = u32::from(is_frame);
            let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("header"),
                contents: bytemuck::cast_slice(&words),
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            });
            let readback = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("header, read back"),
                size: CAPTURE_HEADER,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            let layout = capture_layout(device, wgpu::ShaderStages::FRAGMENT, stage.reads_textures);
            let group = capture_group(device, &layout, &buffer, textures.filter(|_| stage.reads_textures));
            PassHeader { buffer, readback, group }
        });
        Self { uniforms: UniformBuffers::new(device, wgpu::ShaderStages::FRAGMENT, &stage.blocks, batches), header }
    }

    /// Binds what the batch of this number reads.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>, batch: usize) {
        let offsets: Vec<u32> = self.uniforms.strides.iter().map(|stride| stride * batch as u32).collect();
        pass.set_bind_group(0, &self.uniforms.group, &offsets);
        if let Some(header) = &self.header {
            pass.set_bind_group(1, &header.group, &[]);
        }
    }

    /// Has the header read back behind the pass.
    pub fn copy_header(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(header) = &self.header {
            encoder.copy_buffer_to_buffer(&header.buffer, 0, &header.readback, 0, CAPTURE_HEADER);
        }
    }

    /// Where the header is read back to.
    pub fn header(&self) -> Option<&wgpu::Buffer> {
        self.header.as_ref().map(|header| &header.readback)
    }
}

pub(super) fn is_flat(input: &StageVariable) -> bool {
    input.qualifiers.interpolation == InputInterpolation::Flat || input.kind != Some(ScalarKind::Float)
}

fn format(input: &StageVariable) -> wgpu::VertexFormat {
    use wgpu::VertexFormat as F;
    match (input.kind, input.size) {
        (Some(ScalarKind::Sint), 1) => F::Sint32,
        (Some(ScalarKind::Sint), 2) => F::Sint32x2,
        (Some(ScalarKind::Sint), 3) => F::Sint32x3,
        (Some(ScalarKind::Sint), _) => F::Sint32x4,
        (Some(ScalarKind::Uint), 1) => F::Uint32,
        (Some(ScalarKind::Uint), 2) => F::Uint32x2,
        (Some(ScalarKind::Uint), 3) => F::Uint32x3,
        (Some(ScalarKind::Uint), _) => F::Uint32x4,
        (_, 1) => F::Float32,
        (_, 2) => F::Float32x2,
        (_, 3) => F::Float32x3,
        (_, _) => F::Float32x4,
    }
}
