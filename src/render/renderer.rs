//! One device, one fixed fragment stage, one submission after the other.

use super::capture::{self, Capture};
use super::device::Device;
use super::frames::{Frames, Mapped, Rendering, Sample};
use super::painter::Painter;
use super::scene::{Batch, Scene};
use super::tiles::{Area, Tiles};
use crate::fault::Fault;
use crate::language::Text;
use crate::translate::{CAPTURE_HEADER, Shader};
use std::sync::Arc;

/// Renders submissions on one device.
#[derive(Debug)]
pub struct Renderer {
    device: Device,
    stage: capture::Stage,
    painter: Painter,
}

impl Renderer {
    /// A renderer that runs this fixed fragment stage.
    pub fn new(device: Device, fragment: naga::Module) -> Result<Self, Fault> {
        let (stage, painter) =
            checked(&device.device, || (capture::Stage::new(&device.device), Painter::new(&device.device, fragment)))?;
        Ok(Self { device, stage, painter })
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Draws the scene with the shader. An error is ours: the shader was found valid before.
    pub fn render(&mut self, shader: &Shader, scene: &Scene) -> Result<Rendering, Fault> {
        let (capture, rendering) = self.run(shader, scene)?;
        if rendering.ran_out.is_some() {
            return Ok(rendering);
        }
        let device = &self.device;
        let areas: Vec<Area> =
            rendering.frame_samples.iter().map(|vertices| Area::painted(vertices, scene.width, scene.height)).collect();
        let tiles = Tiles::place(&areas)?;
        let painted = self.painter.submit(device, &capture.records, scene, &tiles);
        let bytes = Arc::new(map(device, &painted.readback)?);
        painted.reader = Arc::downgrade(&bytes);
        Ok(Rendering { frames: Frames::new(scene, tiles, bytes), ..rendering })
    }

    /// What the shader computes for every vertex of the scene; no frame is drawn.
    pub fn compute(&self, shader: &Shader, scene: &Scene) -> Result<Rendering, Fault> {
        Ok(self.run(shader, scene)?.1)
    }

    fn run(&self, shader: &Shader, scene: &Scene) -> Result<(Capture, Rendering), Fault> {
        let device = &self.device;
        let capture = checked(&device.device, || Capture::new(&device.device, &self.stage, shader, scene))?;
        capture.submit(device, &self.stage, scene);
        let rendering = split(map(device, &capture.readback)?.bytes(), scene);
        Ok((capture, rendering))
    }
}

/// What `make` makes, unless the device finds it invalid.
fn checked<T>(device: &wgpu::Device, make: impl FnOnce() -> T) -> Result<T, Fault> {
    let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    match pollster::block_on(scope.pop()) {
        None => Ok(made),
        Some(error) => Err(crate::translate::unsupported(&error.to_string())),
    }
}

/// The buffer's bytes, once the device is done with it.
fn map(device: &Device, buffer: &wgpu::Buffer) -> Result<Mapped, Fault> {
    let (sender, receiver) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver outlives the poll below; where it does not, nobody waits for this.
        let _ = sender.send(result);
    });
    device.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| lost(&error.to_string()))?;
    receiver.recv().map_err(|e| lost(&e.to_string()))?.map_err(|e| lost(&e.to_string()))?;
    Mapped::new(buffer).map_err(|error| lost(&error.to_string()))
}

/// The captured header and records; there are no frames yet.
fn split(captured: &[u8], scene: &Scene) -> Rendering {
    let (header, records) = captured.split_at((CAPTURE_HEADER as usize).min(captured.len()));
    let word = |index: usize| {
        let bytes = header.get(index * 4..)?.first_chunk()?;
        Some(u32::from_le_bytes(*bytes)).filter(|number| *number != 0)
    };
    let (ran_out, undefined) = (word(0), word(2));
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
    Rendering { frames: Frames::default(), frame_samples, probe_samples, ran_out, undefined }
}

fn lost(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("the renderer gave no answer: {detail}"),
        format!("レンダラから応答がありません: {detail}"),
    ))
}
