//! One device, one fixed fragment stage, one submission after the other.

use super::device::Device;
use super::frames::{Frames, Rendering, Sample};
use super::job::{Batch, Job, Scene};
use super::target::{Target, Tiles};
use crate::fault::Fault;
use crate::language::Text;
use crate::translate::{CAPTURE_HEADER, Shader};
use std::borrow::Cow;

/// Renders submissions on one device.
#[derive(Debug)]
pub struct Renderer {
    device: Device,
    fragment: wgpu::ShaderModule,
    target: Option<Target>,
}

impl Renderer {
    /// A renderer that runs this fixed fragment stage.
    pub fn new(device: Device, fragment: naga::Module) -> Result<Self, Fault> {
        let scope = device.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = device.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("fixed fragment stage"),
            source: wgpu::ShaderSource::Naga(Cow::Owned(fragment)),
        });
        match pollster::block_on(scope.pop()) {
            None => Ok(Self { device, fragment: module, target: None }),
            Some(error) => Err(render_fault(&error)),
        }
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Draws the scene with the shader. An error is ours: the shader was found valid before.
    pub fn render(&mut self, shader: &Shader, scene: &Scene) -> Result<Rendering, Fault> {
        let tiles = Tiles::new(scene)?;
        let scope = self.device.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let job = Job::new(&self.device.device, &self.fragment, shader, scene);
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(render_fault(&error));
        }
        let target = match self.target.take() {
            Some(target) if target.layout == tiles => target,
            _ => Target::new(&self.device.device, tiles),
        };
        let target = self.target.insert(target);
        job.submit(&self.device, target, scene);
        let frames = Frames {
            width: tiles.width,
            height: tiles.height,
            count: tiles.count,
            background: scene.background,
            columns: tiles.columns,
            bytes_per_row: tiles.bytes_per_row(),
            bytes: Vec::new(),
        };
        let (bytes, captured) = read_back(&self.device, target, &job)?;
        Ok(split(Frames { bytes, ..frames }, &captured, scene))
    }
}

fn read_back(device: &Device, target: &Target, job: &Job) -> Result<(Vec<u8>, Vec<u8>), Fault> {
    let (sender, receiver) = std::sync::mpsc::channel();
    for buffer in [&target.readback, &job.readback] {
        let sender = sender.clone();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver outlives the poll below; where it does not, nobody waits for this.
            let _ = sender.send(result);
        });
    }
    device.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| lost(&error.to_string()))?;
    for _ in 0..2 {
        receiver.recv().map_err(|e| lost(&e.to_string()))?.map_err(|e| lost(&e.to_string()))?;
    }
    let copy = |buffer: &wgpu::Buffer| -> Result<Vec<u8>, Fault> {
        let bytes = buffer.get_mapped_range(..).map_err(|error| lost(&error.to_string()))?.to_vec();
        buffer.unmap();
        Ok(bytes)
    };
    let frames = copy(&target.readback)?;
    let captured = copy(&job.readback)?;
    Ok((frames, captured))
}

fn split(frames: Frames, captured: &[u8], scene: &Scene) -> Rendering {
    let (header, records) = captured.split_at((CAPTURE_HEADER as usize).min(captured.len()));
    let word = |index: usize| {
        let bytes = header.get(index * 4..)?.first_chunk()?;
        Some(u32::from_le_bytes(*bytes)).filter(|number| *number != 0)
    };
    let (ran_out, undefined) = (word(0), word(1));
    let samples: Vec<Sample> = bytemuck::pod_collect_to_vec(records);
    let mut rest = samples.as_slice();
    let mut take = |batches: &[Batch]| {
        let mut all = Vec::with_capacity(batches.len());
        for batch in batches {
            let (these, others) = rest.split_at((batch.drawn() as usize).min(rest.len()));
            rest = others;
            all.push(these[..(batch.vertices() as usize).min(these.len())].to_vec());
        }
        all
    };
    let frame_samples = take(&scene.frames);
    let probe_samples = take(&scene.probes);
    Rendering { frames, frame_samples, probe_samples, ran_out, undefined }
}

fn render_fault(error: &wgpu::Error) -> Fault {
    crate::translate::unsupported(&error.to_string())
}

fn lost(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("the renderer gave no answer: {detail}"),
        format!("レンダラから応答がありません: {detail}"),
    ))
}
