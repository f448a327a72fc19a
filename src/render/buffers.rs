//! Uniforms and attributes by name, laid out as one shader reads them.

use super::scene::Batch;
use crate::translate::UniformBlock;
use wgpu::util::DeviceExt;

/// Bytes of one attribute of one vertex: xyz and a w of 1, as f32. The driver has less to do for four numbers than for three.
pub(super) const ATTRIBUTE_STRIDE: u64 = 16;

/// What a vertex has of an attribute that nothing feeds.
const ORIGIN: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

/// The uniform blocks of a shader, filled for every batch.
pub(super) struct Uniforms {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
    /// Bytes from one batch's uniforms to the next, by block.
    pub strides: Vec<u32>,
}

impl Uniforms {
    pub fn new(device: &wgpu::Device, blocks: &[UniformBlock], batches: &[&Batch]) -> Self {
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
        let entries: Vec<_> =
            blocks.iter().map(|block| layout_entry(block.binding, wgpu::BufferBindingType::Uniform, true)).collect();
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

/// The bytes of one block for all batches; what the program does not set is zero, as in OpenGL.
fn fill(block: &UniformBlock, stride: usize, batches: &[&Batch]) -> Vec<u8> {
    let mut bytes = vec![0; stride * batches.len().max(1)];
    if !block.is_default {
        return bytes;
    }
    for (batch, chunk) in batches.iter().zip(bytes.chunks_mut(stride)) {
        for (name, value) in &batch.uniforms {
            let floats: Vec<f32> = value.numbers().iter().map(|number| *number as f32).collect();
            let bytes: &[u8] = bytemuck::cast_slice(&floats);
            for member in block.members.iter().filter(|member| member.name == *name) {
                let start = member.offset as usize;
                if let Some(place) = chunk.get_mut(start..start + bytes.len()) {
                    place.copy_from_slice(bytes);
                }
            }
        }
    }
    bytes
}

/// The values of one attribute for all batches, one after the other.
pub(super) fn vertex_buffer(device: &wgpu::Device, name: &str, batches: &[&Batch]) -> wgpu::Buffer {
    let mut values: Vec<[f32; 4]> = Vec::new();
    for batch in batches {
        let end = values.len() + batch.drawn() as usize;
        if let Some((_, these)) = batch.attributes.iter().find(|(attribute, _)| attribute == name) {
            // What an attribute lacks is that of OpenGL: 0, 0, 0, 1.
            let filled = |numbers: &[f64]| std::array::from_fn(|at| numbers.get(at).map_or(ORIGIN[at], |n| *n as f32));
            values.extend(these.iter().map(filled));
        }
        values.resize(end, values.last().copied().unwrap_or(ORIGIN));
    }
    if values.is_empty() {
        values.push(ORIGIN);
    }
    debug_assert_eq!(size_of_val(&ORIGIN) as u64, ATTRIBUTE_STRIDE);
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("attribute"),
        contents: bytemuck::cast_slice(&values),
        usage: wgpu::BufferUsages::VERTEX,
    })
}

/// A buffer that the vertex stage sees.
pub(super) fn layout_entry(
    binding: u32,
    ty: wgpu::BufferBindingType,
    has_dynamic_offset: bool,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None },
        count: None,
    }
}
