//! One device, one submission after the other.

use super::capture::{self, Capture};
use super::device::Device;
use super::fragments::FragmentStage;
use super::frames::{Frames, Mapped, Met, Rendering, Sample};
use super::painter::{Painter, Records};
use super::pixels::{self, PixelPass};
use super::scene::{DrawCall, RenderScene};
use super::textures::UploadedTextures;
use super::tiles::Tiles;
use crate::fault::Fault;
use crate::language::Text;
use crate::report::Area;
use crate::translate::{CAPTURE_HEADER, CAPTURE_SLOT, Linked, Shader, StageVariable};
use reference::interpreter::Texture;
use std::cell::RefCell;
use std::sync::Arc;

/// Renders submissions on one device.
#[derive(Debug)]
pub struct Renderer {
    device: Device,
    stage: capture::FrameStage,
    /// The fixed fragment stage of vertex shaders.
    fragments: Option<FragmentStage>,
    painter: Painter,
    textures: RefCell<UploadedTextures>,
}

/// The vertices of a scene after a vertex stage.
pub struct Captured {
    capture: Capture,
    outputs: Vec<StageVariable>,
    rendering: Rendering,
    /// Header and records, where this stage feeds the fragments that are probed.
    handed: Option<Vec<u8>>,
}

impl std::fmt::Debug for Captured {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Captured").field("outputs", &self.outputs).finish_non_exhaustive()
    }
}

impl Captured {
    /// What the vertex stage met.
    pub fn met(&self) -> Met {
        Met { ran_out: self.rendering.ran_out, undefined: self.rendering.undefined }
    }
}

impl Renderer {
    /// A renderer of vertex shaders that are linked with this fragment stage, or of programs.
    pub fn new(device: Device, fragment: Option<&Shader>) -> Result<Self, Fault> {
        let (stage, fragments) = checked(&device.device, || {
            let fragments = fragment.map(|fragment| FragmentStage::new(&device.device, fragment));
            (capture::FrameStage::new(&device.device), fragments)
        })?;
        Ok(Self { device, stage, fragments, painter: Painter::default(), textures: RefCell::default() })
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Makes the textures of an assignment ready, which takes longer than a submission may: depths are drawn for it.
    pub fn prepare(&self, textures: &Arc<[Texture]>) {
        if !textures.is_empty() {
            self.textures.borrow_mut().picture(&self.device, textures);
        }
    }

    /// Gives back the memory of the last submission's frames, which the next one makes anew in some milliseconds.
    pub fn put_away(&mut self) {
        self.painter.put_away();
        // What is dropped is freed when the device is asked next.
        let _ = self.device.device.poll(wgpu::PollType::Poll);
    }

    /// Draws the scene with the shader and the fixed fragment stage. An error is ours: the shader was found valid before.
    pub fn render(&mut self, shader: &Shader, scene: &RenderScene) -> Result<Rendering, Fault> {
        let (capture, rendering) = self.run(shader, scene)?;
        if rendering.ran_out.is_some() {
            return Ok(rendering);
        }
        let records = Records { buffer: &capture.records, outputs: &shader.outputs };
        let Some(fragments) = &mut self.fragments else { return Err(lost("there is no fixed fragment stage")) };
        let textures =
            fragments.reads_textures.then(|| self.textures.borrow_mut().picture(&self.device, &scene.textures));
        paint(&self.device, &mut self.painter, fragments, &records, scene, textures.as_ref(), rendering)
    }

    /// Draws the scene with a program of which any stage may be handed in, and computes the probes of both stages.
    pub fn render_program(&mut self, program: &Linked, scene: &RenderScene) -> Result<Rendering, Fault> {
        let captured = self.capture(&program.vertex, scene)?;
        self.draw(&captured, &program.fragment, scene)
    }

    /// Runs a vertex stage on all vertices of a scene.
    pub fn capture(&self, vertex: &Shader, scene: &RenderScene) -> Result<Captured, Fault> {
        let (capture, rendering) = self.run(vertex, scene)?;
        let outputs = vertex.outputs.clone();
        let handed = (!scene.shares.is_empty() && rendering.ran_out.is_none())
            .then(|| Ok(map(&self.device, &capture.readback)?.bytes().to_vec()))
            .transpose()?;
        Ok(Captured { capture, outputs, rendering, handed })
    }

    /// Draws a scene whose vertices are known, and computes the probes of the fragment stage.
    pub fn draw(&mut self, captured: &Captured, fragment: &Shader, scene: &RenderScene) -> Result<Rendering, Fault> {
        let Captured { capture, outputs, rendering, handed } = captured;
        if rendering.ran_out.is_some() {
            return Ok(rendering.clone());
        }
        let fed = handed.as_ref().map(|bytes| pixels::between(bytes, outputs, fragment, scene));
        let pixels = fed.as_deref().unwrap_or(&scene.pixels);
        let (mut stage, rendering) = self.run_pixels(fragment, scene, pixels, rendering.clone())?;
        if rendering.of_fragments.ran_out.is_some() {
            return Ok(rendering);
        }
        let records = Records { buffer: &capture.records, outputs };
        let textures = self.textures(&[fragment], scene);
        paint(&self.device, &mut self.painter, &mut stage, &records, scene, textures.as_ref(), rendering)
    }

    /// What the fragment stage computes for the probes of the scene; no frame is drawn.
    pub fn compute_pixels(&self, fragment: &Shader, scene: &RenderScene) -> Result<Rendering, Fault> {
        Ok(self.run_pixels(fragment, scene, &scene.pixels, Rendering::default())?.1)
    }

    fn run_pixels(
        &self,
        fragment: &Shader,
        scene: &RenderScene,
        pixels: &[DrawCall],
        mut rendering: Rendering,
    ) -> Result<(FragmentStage, Rendering), Fault> {
        let device = &self.device;
        let textures = self.textures(&[fragment], scene);
        let mut stage = checked(&device.device, || FragmentStage::new(&device.device, fragment))?;
        let mut run = |pixels: &[DrawCall]| -> Result<_, Fault> {
            let pass = checked(&device.device, || PixelPass::submit(device, &mut stage, pixels, textures.as_ref()))?;
            let met = met(device, pass.data.header())?;
            Ok((pass, met))
        };
        // All fragments run before the first is known to have a loop that never ends, so a few of them go ahead.
        if let Some(some) = pixels::some_of(pixels).filter(|_| !fragment.meters.is_empty()) {
            rendering.of_fragments = run(&[some])?.1;
            if rendering.of_fragments.ran_out.is_some() {
                return Ok((stage, rendering));
            }
        }
        if !pixels.is_empty() {
            let (pass, met) = run(pixels)?;
            let read = |buffer: &wgpu::Buffer| -> Result<Vec<u32>, Fault> {
                Ok(bytemuck::pod_collect_to_vec(map(device, buffer)?.bytes()))
            };
            let outputs = pass.readbacks().iter().map(read).collect::<Result<Vec<_>, _>>()?;
            rendering.pixels = pixels::split(&stage, pixels, &outputs);
            rendering.of_fragments = met;
        }
        Ok((stage, rendering))
    }

    /// What the shader computes for every vertex of the scene; no frame is drawn.
    pub fn compute(&self, shader: &Shader, scene: &RenderScene) -> Result<Rendering, Fault> {
        Ok(self.run(shader, scene)?.1)
    }

    /// The textures of the scene, where a stage reads them.
    fn textures(&self, stages: &[&Shader], scene: &RenderScene) -> Option<wgpu::TextureView> {
        let is_read = stages.iter().any(|stage| stage.reads_textures);
        is_read.then(|| self.textures.borrow_mut().picture(&self.device, &scene.textures))
    }

    fn run(&self, shader: &Shader, scene: &RenderScene) -> Result<(Capture, Rendering), Fault> {
        let device = &self.device;
        let textures = self.textures(&[shader], scene);
        let capture =
            checked(&device.device, || Capture::new(&device.device, &self.stage, shader, scene, textures.as_ref()))?;
        capture.submit(device, &self.stage, scene);
        let rendering = split(map(device, &capture.readback)?.bytes(), &shader.outputs, scene);
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

/// Paints the frames of captured vertices.
fn paint(
    device: &Device,
    painter: &mut Painter,
    stage: &mut FragmentStage,
    records: &Records<'_>,
    scene: &RenderScene,
    textures: Option<&wgpu::TextureView>,
    mut rendering: Rendering,
) -> Result<Rendering, Fault> {
    let area = |vertices: &Vec<Sample>| {
        Area::painted(vertices.iter().map(|vertex| vertex.position), scene.width, scene.height)
    };
    let areas: Vec<Area> = rendering.frame_samples.iter().map(area).collect();
    let tiles = Tiles::place(&areas)?;
    let (painted, data) = checked(&device.device, || painter.submit(device, stage, records, scene, textures, &tiles))?;
    let bytes = Arc::new(map(device, &painted.readback)?);
    painted.reader = Arc::downgrade(&bytes);
    let met = met(device, data.header())?;
    rendering.of_fragments.ran_out = rendering.of_fragments.ran_out.or(met.ran_out);
    rendering.of_fragments.undefined = rendering.of_fragments.undefined.or(met.undefined);
    Ok(Rendering { frames: Frames::new(scene, tiles, bytes), ..rendering })
}

/// What the header of a pass says.
fn met(device: &Device, header: Option<&wgpu::Buffer>) -> Result<Met, Fault> {
    Ok(header.map(|header| map(device, header)).transpose()?.map(|header| Met::of(header.bytes())).unwrap_or_default())
}

/// The captured header and records; there are no frames yet.
fn split(captured: &[u8], outputs: &[StageVariable], scene: &RenderScene) -> Rendering {
    let (header, records) = captured.split_at((CAPTURE_HEADER as usize).min(captured.len()));
    let Met { ran_out, undefined } = Met::of(header);
    let samples = samples(records, outputs.len());
    let mut rest = samples.as_slice();
    let mut take = |batches: &[DrawCall]| {
        let mut all = Vec::new();
        for batch in batches {
            let (these, others) = rest.split_at((batch.drawn() as usize).min(rest.len()));
            rest = others;
            all.push(these[..(batch.vertices() as usize).min(these.len())].to_vec());
        }
        all
    };
    let frame_samples = scene.frames.iter().map(|draws| take(draws).concat()).collect();
    let probe_samples = take(&scene.probes);
    Rendering { frame_samples, probe_samples, ran_out, undefined, ..Rendering::default() }
}

/// Positions, and the first of so many outputs.
fn samples(records: &[u8], outputs: usize) -> Vec<Sample> {
    let stride = (outputs + 1) * CAPTURE_SLOT as usize;
    if stride == size_of::<Sample>() {
        return bytemuck::pod_collect_to_vec(records);
    }
    let floats = |record: &[u8], slot: usize| -> [f32; 4] {
        let bytes = record.get(slot * CAPTURE_SLOT as usize..).and_then(|rest| rest.first_chunk::<16>());
        bytes.map(|bytes| bytemuck::pod_read_unaligned(bytes)).unwrap_or_default()
    };
    let sample = |record: &[u8]| Sample { position: floats(record, 0), colour: floats(record, 1) };
    records.chunks_exact(stride).map(sample).collect()
}

fn lost(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("the renderer gave no answer: {detail}"),
        format!("レンダラから応答がありません: {detail}"),
    ))
}
