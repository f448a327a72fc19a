//! The least that a program must do for the same pictures: compile the submission's vertex stage and the fixed fragment
//! stage, draw every frame once, read all of them back.

use crate::class::Submission;
use ggrade::render::{DrawCall, RenderScene};
use ggrade::source;
use ggrade::translate::{self, UniformBlock};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use reference::Values;
use std::borrow::Cow;
use wgpu::util::DeviceExt;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Frames in a row of the texture that holds all of them.
const COLUMNS: u32 = 5;
/// Bytes from one frame's uniforms to the next: as any driver aligns them.
const STRIDE: u32 = 256;

/// A warm device.
pub struct Bare {
    device: wgpu::Device,
    queue: wgpu::Queue,
    scene: RenderScene,
    fragment: wgpu::ShaderModule,
    texture: wgpu::Texture,
    readback: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    vertices: Vec<wgpu::Buffer>,
}

/// The vertex stage of a submission, compiled to a module but not yet given to the driver.
pub struct Stage {
    module: naga::Module,
    uniforms: UniformBlock,
}

impl Stage {
    /// None where it has uniforms beside the homework's, or needs what devices lack.
    pub fn of(submission: &Submission) -> Option<Self> {
        let interface = ggrade::translate::LinkedInterface::of(reference::assignment("ggsample06")?).ok()?;
        let source = source::read(&submission.name, submission.text.as_bytes()).ok()?;
        let shader = translate::translate(&source, &interface).ok()?.shader;
        let [uniforms] = shader.uniforms.as_slice() else { return None };
        let known = uniforms.size <= STRIDE && uniforms.is_default;
        let module = known.then(|| shader.plain(&interface).ok())??;
        // A module that needs more than usual is left out of the comparison.
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::FLOAT64);
        validator.validate(&module).ok()?;
        Some(Self { module, uniforms: uniforms.clone() })
    }

    /// The matrices of all frames, as the stage reads them.
    fn matrices(&self, frames: &[DrawCall]) -> Vec<u8> {
        let mut bytes = vec![0; STRIDE as usize * frames.len()];
        for (batch, chunk) in frames.iter().zip(bytes.chunks_mut(STRIDE as usize)) {
            for (name, matrix) in &batch.uniforms {
                let matrix: Vec<f32> = matrix.numbers().iter().map(|number| *number as f32).collect();
                let bytes: &[u8] = bytemuck::cast_slice(&matrix);
                for member in self.uniforms.members.iter().filter(|member| member.path == *name) {
                    let start = member.offset as usize;
                    chunk[start..start + bytes.len()].copy_from_slice(bytes);
                }
            }
        }
        bytes
    }
}

impl Bare {
    /// Opens the software driver.
    pub fn open() -> Self {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::VULKAN;
        descriptor.flags = wgpu::InstanceFlags::empty();
        let instance = wgpu::Instance::new(descriptor);
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
        let software = adapters.into_iter().find(|adapter| adapter.get_info().device_type == wgpu::DeviceType::Cpu);
        let adapter = software.expect("a software driver");
        // What a shader may use and a device has only where it is asked for.
        let required_features = adapter.features() & wgpu::Features::SHADER_F64;
        let descriptor = wgpu::DeviceDescriptor { required_features, ..Default::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).expect("a device");
        let assignment = reference::assignment("ggsample06").expect("the assignment");
        let scene = ggrade::render::RenderScene::of(assignment, &[&assignment.probes(1)]);
        let interface = ggrade::translate::LinkedInterface::of(assignment).expect("the assignment is whole");
        let fragment =
            translate::fixed_stage(&interface, assignment.files[0].starter_shader()).expect("the fixed stage");
        let fragment = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Naga(Cow::Owned(fragment.module)),
        });
        let rows = (scene.frames.len() as u32).div_ceil(COLUMNS);
        let size =
            wgpu::Extent3d { width: COLUMNS * scene.width, height: rows * scene.height, depth_or_array_layers: 1 };
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let readback = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(size.width * 4) * u64::from(size.height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: true,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let attribute = |(_, values): &(String, Values)| {
            let values: Vec<f32> = values.iter().flat_map(|vertex| vertex[..3].iter().map(|n| *n as f32)).collect();
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents: bytemuck::cast_slice(&values),
                usage: wgpu::BufferUsages::VERTEX,
            })
        };
        let vertices = scene.frames[0][0].attributes.iter().map(attribute).collect();
        Self { device, queue, fragment, texture, readback, layout, vertices, scene }
    }

    /// Compiles, draws, reads back. Gives a byte of the picture, so that it cannot be left out.
    pub fn run(&self, stage: &Stage) -> u8 {
        let pipeline = self.pipeline(&stage.module);
        let uniforms = self.uniforms(stage);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.draw(&mut encoder, &pipeline, &uniforms);
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.texture.width() * 4),
                    rows_per_image: None,
                },
            },
            self.texture.size(),
        );
        self.queue.submit([encoder.finish()]);
        self.readback.map_async(wgpu::MapMode::Read, .., |result| result.expect("a mapping"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("an answer");
        let byte = self.readback.get_mapped_range(..).expect("the pictures")[0];
        self.readback.unmap();
        byte
    }

    fn uniforms(&self, stage: &Stage) -> wgpu::BindGroup {
        let buffer = self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: &stage.matrices(&self.scene.frames.concat()),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer: &buffer,
                    offset: 0,
                    size: std::num::NonZeroU64::new(u64::from(STRIDE)),
                }),
            }],
        })
    }

    fn pipeline(&self, module: &naga::Module) -> wgpu::RenderPipeline {
        let vertex = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Naga(Cow::Owned(module.clone())),
        });
        let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&self.layout)],
            immediate_size: 0,
        });
        // Position and normal stand in this order in the scene.
        let attributes: Vec<[wgpu::VertexAttribute; 1]> = [0, 1]
            .into_iter()
            .map(|shader_location| {
                [wgpu::VertexAttribute { format: wgpu::VertexFormat::Float32x3, offset: 0, shader_location }]
            })
            .collect();
        let buffers: Vec<_> = attributes
            .iter()
            .map(|attributes| {
                Some(wgpu::VertexBufferLayout { array_stride: 12, step_mode: wgpu::VertexStepMode::Vertex, attributes })
            })
            .collect();
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
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
                module: &self.fragment,
                entry_point: None,
                compilation_options: Default::default(),
                targets: &[Some(FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    fn draw(&self, encoder: &mut wgpu::CommandEncoder, pipeline: &wgpu::RenderPipeline, uniforms: &wgpu::BindGroup) {
        let view = self.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::WHITE), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        for (slot, buffer) in self.vertices.iter().enumerate() {
            pass.set_vertex_buffer(slot as u32, buffer.slice(..));
        }
        let (width, height) = (self.scene.width, self.scene.height);
        for index in 0..self.scene.frames.len() as u32 {
            let (x, y) = (index % COLUMNS * width, index / COLUMNS * height);
            pass.set_viewport(x as f32, y as f32, width as f32, height as f32, 0.0, 1.0);
            pass.set_scissor_rect(x, y, width, height);
            pass.set_bind_group(0, uniforms, &[index * STRIDE]);
            pass.draw(0..3, 0..1);
        }
    }
}
