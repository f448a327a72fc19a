//! Uniforms and attributes by name, laid out as one shader reads them.

use super::scene::DrawCall;
use super::uniforms::fill;
use crate::translate::{StageVariable, TEXTURES, UniformBlock};
use naga::ScalarKind;
use wgpu::util::DeviceExt;

/// Bytes of one attribute of one vertex: four numbers. The driver has less to do for four than for three.
pub(super) const ATTRIBUTE_STRIDE: u64 = 16;

/// The uniform blocks of a shader, filled for every batch.
pub(super) struct UniformBuffers {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
    /// Bytes from one batch's uniforms to the next, by block.
    pub strides: Vec<u32>,
}

impl UniformBuffers {
    /// For the stage that reads them.
    pub fn new(
        device: &wgpu::Device,
        stage: wgpu::ShaderStages,
        blocks: &[UniformBlock],
        batches: &[&DrawCall],
    ) -> Self {
        let alignment = device.limits().min_uniform_buffer_offset_alignment;
        let strides: Vec<u32> = blocks.iter().map(|block| block.size.max(16).next_multiple_of(alignment)).collect();
        let buffers: Vec<wgpu::Buffer> = blocks
            .iter()
            .zip(&strides)
            .map(|(block, stride)| {
                device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: Some("uniforms"),
                    contents: &fill(block, *stride as usize, batches),
                    usage: wgpu::BufferUsages::UNIFORM,
                })
            })
            .collect();
        let entries: Vec<_> = blocks
            .iter()
            .map(|block| layout_entry(stage, block.binding, wgpu::BufferBindingType::Uniform, true))
            .collect();
        let layout = device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("uniforms"), entries: &entries });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("uniforms"),
            layout: &layout,
            entries: &blocks
                .iter()
                .zip(&buffers)
                .map(|(block, buffer)| wgpu::BindGroupEntry {
                    binding: block.binding,
                    resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer,
                        offset: 0,
                        size: std::num::NonZeroU64::new(u64::from(block.size.max(16))),
                    }),
                })
                .collect::<Vec<_>>(),
        });
        Self { layout, group, strides }
    }
}

/// The values of one attribute for all batches, one after the other, and how a driver reads them: components that the
/// program does not feed are 0, 0, 0 and 1, as in OpenGL.
pub(super) fn vertex_buffer(
    device: &wgpu::Device,
    attribute: &StageVariable,
    batches: &[&DrawCall],
) -> (wgpu::Buffer, wgpu::VertexFormat) {
    let columns = || batches.iter().map(|batch| batch.attributes.iter().find(|(name, _)| *name == attribute.name));
    let (format, bits): (_, fn(f64) -> u32) = match attribute.kind {
        Some(ScalarKind::Sint) => (wgpu::VertexFormat::Sint32x4, |number| number as i64 as u32),
        Some(ScalarKind::Uint) => (wgpu::VertexFormat::Uint32x4, |number| number as i64 as u32),
        _ => (wgpu::VertexFormat::Float32x4, |number| (number as f32).to_bits()),
    };
    let missing = [0.0, 0.0, 0.0, 1.0].map(bits);
    let mut values: Vec<[u32; 4]> = Vec::new();
    for (batch, column) in batches.iter().zip(columns()) {
        let end = values.len() + batch.drawn() as usize;
        for vertex in column.iter().flat_map(|(_, values)| values.iter()) {
            values.push(std::array::from_fn(|axis| vertex.get(axis).map_or(missing[axis], |number| bits(*number))));
        }
        values.resize(end, values.last().copied().unwrap_or(missing));
    }
    if values.is_empty() {
        values.push(missing);
    }
    debug_assert_eq!(size_of_val(&missing) as u64, ATTRIBUTE_STRIDE);
    let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("attribute"),
        contents: bytemuck::cast_slice(&values),
        usage: wgpu::BufferUsages::VERTEX,
    });
    (buffer, format)
}

/// The layout of a stage's group that holds the header and, where textures are read, those.
pub(super) fn capture_layout(
    device: &wgpu::Device,
    stage: wgpu::ShaderStages,
    reads_textures: bool,
) -> wgpu::BindGroupLayout {
    let mut entries = vec![layout_entry(stage, 0, wgpu::BufferBindingType::Storage { read_only: false }, false)];
    if reads_textures {
        let ty = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Uint,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        entries.push(wgpu::BindGroupLayoutEntry { binding: TEXTURES.1, visibility: stage, ty, count: None });
    }
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("capture"), entries: &entries })
}

/// That group.
pub(super) fn capture_group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    header: &wgpu::Buffer,
    textures: Option<&wgpu::TextureView>,
) -> wgpu::BindGroup {
    let mut entries = vec![wgpu::BindGroupEntry { binding: 0, resource: header.as_entire_binding() }];
    entries.extend(textures.map(|picture| wgpu::BindGroupEntry {
        binding: TEXTURES.1,
        resource: wgpu::BindingResource::TextureView(picture),
    }));
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("capture"), layout, entries: &entries })
}

/// A buffer that one stage sees. A driver takes what a fragment stage could write to for written by every draw, and waits
/// between two of them.
fn layout_entry(
    stage: wgpu::ShaderStages,
    binding: u32,
    ty: wgpu::BufferBindingType,
    has_dynamic_offset: bool,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: stage,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None },
        count: None,
    }
}
