//! A real OpenGL driver for the tests: vertex shaders drawn as the course's own program draws them.
//!
//! The context is OpenGL 4.1 core or newer on Mesa's software driver, without a display (EGL, surfaceless platform).
//! The state is that of the course program: no depth test, no culling, no blending, no multisampling, no dithering,
//! 8 bits a channel without sRGB encoding. Nothing here shares code with what the tests hold against it.
#![allow(dead_code, reason = "every test binary that includes this module uses a part of it")]

mod driver;
mod fragments;

use driver::Recorder;
pub use fragments::{Given, Texels};
use ggrade::ffi::opengl::LinkedProgram;
pub use ggrade::ffi::opengl::{Driver, OpenglDraw, Rejection, ValueKind, Version, Window};

/// One 4 × 4 matrix, column after column.
pub type Matrix = [f32; 16];

/// The uniforms of one pose: name and value. A name that the shader does not have (any more) is skipped.
pub type Uniforms<'a> = &'a [(&'a str, Matrix)];

/// What is drawn: triangles of three consecutive vertices each, with the attributes `pv` (position) and `cv` (normal).
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Object-space positions; the shader sees w = 1.
    pub positions: &'a [[f32; 3]],
    /// Object-space normals, one for each position; the shader sees w = 1.
    pub normals: &'a [[f32; 3]],
}

/// The window that is drawn into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Canvas {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The colour it is cleared to, RGBA.
    pub background: [f32; 4],
}

/// What stands in the window after one draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// RGBA, 8 bits a channel, top row first.
    pub pixels: Vec<u8>,
}

/// What the vertex shader wrote for one vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// The vertex colour.
    pub vc: [f32; 4],
    /// `gl_Position`: clip space, z in [−w, w].
    pub position: [f32; 4],
}

/// A vertex shader that the driver accepted and linked.
pub struct Program<'gl> {
    gl: &'gl OpenGl,
    drawing: LinkedProgram,
    /// The same shader with its outputs recorded, or why the driver cannot record them.
    recording: Result<LinkedProgram, String>,
}

impl Drop for Program<'_> {
    fn drop(&mut self) {
        self.gl.driver.delete(self.drawing);
        if let Ok(recording) = self.recording {
            self.gl.driver.delete(recording);
        }
    }
}

/// An OpenGL context, current in the thread that made it.
pub struct OpenGl {
    driver: Recorder,
}

impl OpenGl {
    /// Starts the driver as it is: `#version` up to what it offers (Mesa 22's software driver: 450).
    ///
    /// # Errors
    /// There is no driver, and then the message names the packages to install; or this thread has a context already.
    pub fn new() -> Result<Self, String> {
        Self::with_version(Version::AsOffered)
    }

    /// Starts the driver for a given range of `#version`. All contexts of a process share one.
    ///
    /// # Errors
    /// As for [`OpenGl::new`]; and when the process has started the driver with another version before.
    pub fn with_version(version: Version) -> Result<Self, String> {
        Ok(Self { driver: Recorder(Driver::start(version)?) })
    }

    /// The driver's name and version, for reports.
    pub fn renderer(&self) -> String {
        self.driver.renderer()
    }

    /// Compiles a vertex shader and links it with a fragment shader.
    ///
    /// The bytes are taken as UTF-8. Others become U+FFFD, which means as much to a compiler: nothing inside a comment,
    /// an error outside.
    ///
    /// # Errors
    /// The driver refuses it.
    pub fn compile(&self, vertex: &[u8], fragment: &str) -> Result<Program<'_>, Rejection> {
        let vertex = String::from_utf8_lossy(vertex);
        let drawing = self.driver.link(&vertex, fragment, &[])?;
        let recording = self.driver.link(&vertex, fragment, &["vc", "gl_Position"]).map_err(|refused| refused.log);
        Ok(Program { gl: self, drawing, recording })
    }

    /// Runs a fragment shader with one output for each pixel of a square window; rows from below.
    ///
    /// # Errors
    /// The driver refuses it.
    pub fn shade(
        &self,
        fragment: &str,
        given: Given<'_>,
        side: usize,
        untouched: [f32; 4],
    ) -> Result<Vec<[f32; 4]>, Rejection> {
        self.driver.shade(fragment, given, side, untouched)
    }

    /// The driver, for whole scenes.
    pub fn driver(&self) -> &Driver {
        &self.driver
    }

    /// Draws one pose.
    pub fn draw(&self, program: &Program<'_>, uniforms: Uniforms<'_>, mesh: Mesh<'_>, canvas: Canvas) -> Picture {
        self.draw_many(program, &[uniforms], mesh, canvas).remove(0)
    }

    /// Draws many poses, each on a cleared canvas.
    pub fn draw_many(
        &self,
        program: &Program<'_>,
        poses: &[Uniforms<'_>],
        mesh: Mesh<'_>,
        canvas: Canvas,
    ) -> Vec<Picture> {
        let frame = self.driver.frame(canvas.width, canvas.height);
        let vertices = self.driver.vertices(program.drawing, mesh.positions, mesh.normals);
        let draw = |uniforms: &Uniforms<'_>| {
            self.driver.set_uniforms(program.drawing, uniforms);
            self.driver.draw(&frame, program.drawing, &vertices, canvas.background);
            Picture {
                width: canvas.width,
                height: canvas.height,
                pixels: top_row_first(self.driver.read(&frame), canvas),
            }
        };
        let pictures = poses.iter().map(draw).collect();
        self.driver.release(frame, vertices);
        pictures
    }

    /// Runs the shader once for each vertex and records what it writes.
    ///
    /// # Errors
    /// The driver cannot record the outputs of this shader, which draws nevertheless.
    pub fn capture(
        &self,
        program: &Program<'_>,
        uniforms: Uniforms<'_>,
        mesh: Mesh<'_>,
    ) -> Result<Vec<Vertex>, String> {
        let recording = program.recording.clone()?;
        self.driver.set_uniforms(recording, uniforms);
        let floats = self.driver.record(recording, mesh.positions, mesh.normals);
        Ok(floats
            .as_chunks::<8>()
            .0
            .iter()
            .map(|&[r, g, b, a, x, y, z, w]| Vertex { vc: [r, g, b, a], position: [x, y, z, w] })
            .collect())
    }
}

/// OpenGL reads the bottom row first.
fn top_row_first(pixels: Vec<u8>, canvas: Canvas) -> Vec<u8> {
    pixels.chunks_exact(canvas.width as usize * 4).rev().flatten().copied().collect()
}
