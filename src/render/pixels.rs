//! A fragment stage on its own: one pixel of a target of floats for each probe, whose inputs are given.

mod corners;

use super::device::Device;
use super::fragments::{DEPTH, FragmentData, FragmentStage, PipelineKey};
use super::scene::{DrawCall, DrawState, RenderScene};
use crate::translate::{CAPTURE_HEADER, CAPTURE_SLOT, InputInterpolation, Shader, StageVariable};
use corners::corners;
use naga::ScalarKind;
use reference::Values;
use reference::interpreter::Type;
use wgpu::util::DeviceExt;

/// Probes of a row of the target.
const SIDE: u32 = 64;

/// Each probe has 2 × 2 pixels of its own, of which it is the first. A derivative is a difference within these, so it would be another
/// one at the second: the interpreter takes the first, and so do both answers that are compared.
const SPACING: u32 = 2;

/// Where a probe lies in the target: the pixels to its left, and the rows before it.
fn place(probe: u32) -> [u32; 2] {
    [probe % SIDE * SPACING, probe / SIDE * SPACING]
}

/// What the target is cleared to: no shader computes just this.
const NOTHING: f64 = -1.234_567_890_123e38;

/// What a fragment stage computed for one pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixel {
    /// Whether it was thrown away.
    pub is_discarded: bool,
    /// The outputs in the order of the file, as four numbers each; integers as their values.
    pub outputs: Vec<[f32; 4]>,
}

/// The pass over all probes.
pub(super) struct PixelPass {
    readbacks: Vec<wgpu::Buffer>,
    pub data: FragmentData,
}

impl PixelPass {
    pub fn submit(
        device: &Device,
        stage: &mut FragmentStage,
        batches: &[DrawCall],
        textures: Option<&wgpu::TextureView>,
    ) -> Self {
        let drawn: Vec<&DrawCall> = batches.iter().collect();
        let data = FragmentData::new(&device.device, stage, &drawn, textures, false);
        let count: u32 = batches.iter().map(DrawCall::vertices).sum();
        let [width, height] = [SIDE, count.div_ceil(SIDE).max(1)].map(|probes| probes * SPACING);
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let [records, shifts] = corners(stage, batches, size).map(|contents| {
            device.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("probes"),
                contents: &contents,
                usage: wgpu::BufferUsages::VERTEX,
            })
        });
        let formats: Vec<_> = stage.outputs.iter().map(format).collect();
        let textures: Vec<_> = formats
            .iter()
            .map(|&format| {
                device.device.create_texture(&wgpu::TextureDescriptor {
                    label: Some("probes"),
                    size,
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                    view_formats: &[],
                })
            })
            .collect();
        let views: Vec<_> = textures.iter().map(|texture| texture.create_view(&Default::default())).collect();
        let targets = stage.outputs.iter().map(|output| output.location as usize + 1).max().unwrap_or(0);
        let at = |location: usize| stage.outputs.iter().position(|output| output.location as usize == location);
        let places: Vec<Option<usize>> = (0..targets).map(at).collect();
        let key = PipelineKey {
            state: DrawState::default(),
            targets: places.iter().map(|place| place.map(|place| formats[place])).collect(),
            // A pass needs something to draw to, also for a stage that writes nothing, or a depth of its own.
            has_depth: true,
            stride: (stage.inputs.len() as u64 + 1) * CAPTURE_SLOT,
            slots: (0..stage.inputs.len()).collect(),
            moves_each: true,
        };
        let is_placed = stage.is_placed;
        let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let depth = {
            let texture = device.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("depths"),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: DEPTH,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            });
            texture.create_view(&Default::default())
        };
        let pipeline = stage.pipeline(&device.device, &data, &key);
        let clear = wgpu::Color { r: NOTHING, g: NOTHING, b: NOTHING, a: NOTHING };
        let attachment = |view| wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Store },
        };
        let attachments: Vec<_> = places.iter().map(|place| place.map(|place| attachment(&views[place]))).collect();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("probes"),
            color_attachments: &attachments,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, records.slice(..));
        if is_placed {
            pass.set_vertex_buffer(1, shifts.slice(..));
        }
        let mut first = 0;
        for (number, batch) in batches.iter().enumerate().filter(|(_, batch)| batch.vertices() > 0) {
            data.bind(&mut pass, number);
            pass.draw(first..first + 3 * batch.vertices(), 0..1);
            first += 3 * batch.vertices();
        }
        drop(pass);
        let readbacks = textures
            .iter()
            .map(|texture| {
                let bytes_per_row = size.width * CAPTURE_SLOT as u32;
                let readback = device.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("probes, read back"),
                    size: u64::from(bytes_per_row) * u64::from(size.height),
                    usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                    mapped_at_creation: false,
                });
                let layout =
                    wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: None };
                let into = wgpu::TexelCopyBufferInfo { buffer: &readback, layout };
                encoder.copy_texture_to_buffer(texture.as_image_copy(), into, size);
                readback
            })
            .collect();
        data.copy_header(&mut encoder);
        device.queue.submit([encoder.finish()]);
        Self { readbacks, data }
    }

    /// Where each output is read back to.
    pub fn readbacks(&self) -> &[wgpu::Buffer] {
        &self.readbacks
    }
}

/// The pixels of each batch from what was read back of each output.
pub(super) fn split(stage: &FragmentStage, batches: &[DrawCall], outputs: &[Vec<u32>]) -> Vec<Vec<Pixel>> {
    let mut number = 0;
    let mut next = || {
        let [column, row] = place(number);
        let first = 4 * (row * SIDE * SPACING + column) as usize;
        let words = |output: &Vec<u32>| -> [u32; 4] { std::array::from_fn(|axis| output[first + axis]) };
        let all: Vec<[u32; 4]> = outputs.iter().map(words).collect();
        number += 1;
        let value = |(output, words): (&StageVariable, &[u32; 4])| {
            words.map(|word| match output.kind {
                Some(ScalarKind::Sint) => word.cast_signed() as f32,
                Some(ScalarKind::Uint) => word as f32,
                _ => f32::from_bits(word),
            })
        };
        let outputs: Vec<[f32; 4]> = stage.outputs.iter().zip(&all).map(value).collect();
        let is_untouched = |(output, value): (&StageVariable, &[f32; 4])| {
            output.kind == Some(ScalarKind::Float) && value.iter().all(|component| *component == NOTHING as f32)
        };
        Pixel { is_discarded: stage.outputs.iter().zip(&outputs).any(is_untouched), outputs }
    };
    batches.iter().map(|batch| (0..batch.vertices()).map(|_| next()).collect()).collect()
}

/// A few pixels of the first batch.
pub(super) fn some_of(batches: &[DrawCall]) -> Option<DrawCall> {
    /// Enough that a loop that never ends shows, and few enough that it ends soon.
    const SOME: usize = 4;
    let first = batches.first()?;
    let column = |(name, values): &(String, Values)| {
        let numbers = values.iter().take(SOME).flatten().copied().collect();
        (name.clone(), Values { kind: values.kind.clone(), numbers })
    };
    Some(DrawCall { attributes: first.attributes.iter().map(column).collect(), ..first.clone() })
}

/// The batches of a scene's pixels with what a vertex stage hands over to them, from its captured header and records.
/// How that is interpolated is said by the `fragment` stage.
pub(super) fn between(
    captured: &[u8],
    outputs: &[StageVariable],
    fragment: &Shader,
    scene: &RenderScene,
) -> Vec<DrawCall> {
    let stride = (outputs.len() + 1) * CAPTURE_SLOT as usize;
    let records = captured.get(CAPTURE_HEADER as usize..).unwrap_or_default();
    let frames: u32 = scene.frames.iter().flatten().map(DrawCall::drawn).sum();
    let mut first = frames as usize;
    let has_derivatives = fragment.has_derivatives();
    let batches = scene.pixels.iter().zip(&scene.probes).zip(&scene.shares);
    let of_batch = |((pixels, probes), shares): ((&DrawCall, &DrawCall), &Vec<[[f64; 3]; 3]>)| {
        let own = first;
        first += probes.drawn() as usize;
        // The first slot is the position.
        let word = |vertex: usize, slot: usize, axis: usize| {
            let at = (own + vertex) * stride + slot * CAPTURE_SLOT as usize + 4 * axis;
            records.get(at..).and_then(|rest| rest.first_chunk()).map_or(0, |bytes| u32::from_le_bytes(*bytes))
        };
        let w = |vertex: usize| f64::from(f32::from_bits(word(vertex, 0, 3)));
        // Of the pixel itself, and of those beside.
        let column = |place: usize, slot: usize, output: &StageVariable| {
            let number = |vertex: usize, axis: usize| match output.kind {
                Some(ScalarKind::Sint) => f64::from(word(vertex, slot + 1, axis).cast_signed()),
                Some(ScalarKind::Uint) => f64::from(word(vertex, slot + 1, axis)),
                _ => f64::from(f32::from_bits(word(vertex, slot + 1, axis))),
            };
            let input = fragment.inputs.iter().find(|input| input.name == output.name).unwrap_or(output);
            let interpolation = match output.kind {
                Some(ScalarKind::Float) => input.qualifiers.interpolation,
                _ => InputInterpolation::Flat,
            };
            let weights = |pixel: usize| match interpolation {
                InputInterpolation::NoPerspective => {
                    reference::probes::linear(shares[pixel][place], [0, 1, 2].map(|corner| w(3 * pixel + corner)))
                }
                _ => shares[pixel][place],
            };
            let between = |pixel: usize| -> [f64; 4] {
                let weights = weights(pixel);
                [0, 1, 2, 3].map(|axis| match interpolation {
                    InputInterpolation::Flat => number(3 * pixel + 2, axis),
                    _ => (0..3).map(|corner| weights[corner] * number(3 * pixel + corner, axis)).sum(),
                })
            };
            (output.name.clone(), Values { kind: Type::VEC4, numbers: (0..shares.len()).flat_map(between).collect() })
        };
        let handed = |place: usize| outputs.iter().enumerate().map(move |(slot, output)| column(place, slot, output));
        DrawCall {
            attributes: pixels.attributes.iter().cloned().chain(handed(0)).collect(),
            beside: [1, 2].map(|place| if has_derivatives { handed(place).collect() } else { Vec::new() }),
            ..pixels.clone()
        }
    };
    batches.map(of_batch).collect()
}

fn format(output: &StageVariable) -> wgpu::TextureFormat {
    match output.kind {
        Some(ScalarKind::Sint) => wgpu::TextureFormat::Rgba32Sint,
        Some(ScalarKind::Uint) => wgpu::TextureFormat::Rgba32Uint,
        _ => wgpu::TextureFormat::Rgba32Float,
    }
}
