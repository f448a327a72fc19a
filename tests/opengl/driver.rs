//! OpenGL behind functions that cannot be misused.
//!
//! Two facts carry every call below. A [`Context`] is current in its thread as long as it lives and cannot leave it, so
//! the functions that glow loaded may be called; and each object name handed to them was made by this context.
#![allow(unsafe_code, reason = "OpenGL is a C library")]

use super::context::{Context, Version};
use super::{Rejection, Stage};
use glow::HasContext;

/// A linked program.
#[derive(Clone, Copy)]
pub struct Linked(glow::Program);

impl Linked {
    pub(super) fn name(self) -> glow::Program {
        self.0
    }
}

/// A framebuffer with one 8-bit RGBA renderbuffer.
pub struct Frame {
    framebuffer: glow::Framebuffer,
    renderbuffer: glow::Renderbuffer,
    width: i32,
    height: i32,
}

/// The attributes of a mesh, laid out for one program.
pub struct Vertices {
    array: glow::VertexArray,
    buffers: [glow::Buffer; 2],
    count: i32,
}

/// OpenGL in this thread.
pub struct Driver {
    context: Context,
}

impl Driver {
    /// Makes a context in this thread.
    pub fn start(version: Version) -> Result<Self, String> {
        Ok(Self { context: Context::start(version)? })
    }

    /// Renderer and version.
    pub fn renderer(&self) -> String {
        // SAFETY: see the head of this file.
        let [renderer, version] =
            unsafe { [glow::RENDERER, glow::VERSION].map(|name| self.context.gl().get_parameter_string(name)) };
        format!("{renderer}, OpenGL {version}")
    }

    /// Compiles and links; `varyings` are recorded by transform feedback.
    pub fn link(&self, vertex: &str, fragment: &str, varyings: &[&str]) -> Result<Linked, Rejection> {
        let vertex =
            self.shader(glow::VERTEX_SHADER, vertex).map_err(|log| Rejection { stage: Stage::Compile, log })?;
        let fragment =
            self.shader(glow::FRAGMENT_SHADER, fragment).map_err(|log| Rejection { stage: Stage::Compile, log })?;
        let gl = self.context.gl();
        // SAFETY: see the head of this file. A shader that is deleted while attached lives as long as the program.
        unsafe {
            let program = gl.create_program().expect("a program");
            for shader in [vertex, fragment] {
                gl.attach_shader(program, shader);
                gl.delete_shader(shader);
            }
            if !varyings.is_empty() {
                gl.transform_feedback_varyings(program, varyings, glow::INTERLEAVED_ATTRIBS);
            }
            gl.link_program(program);
            if gl.get_program_link_status(program) {
                return Ok(Linked(program));
            }
            let log = readable(gl.get_program_info_log(program));
            gl.delete_program(program);
            Err(Rejection { stage: Stage::Link, log })
        }
    }

    fn shader(&self, stage: u32, text: &str) -> Result<glow::Shader, String> {
        let gl = self.context.gl();
        // SAFETY: see the head of this file. The text is passed with its length.
        unsafe {
            let shader = gl.create_shader(stage).expect("a shader");
            gl.shader_source(shader, text);
            gl.compile_shader(shader);
            if gl.get_shader_compile_status(shader) {
                return Ok(shader);
            }
            let log = readable(gl.get_shader_info_log(shader));
            gl.delete_shader(shader);
            Err(log)
        }
    }

    /// Ends a program.
    pub fn delete(&self, program: Linked) {
        // SAFETY: see the head of this file. A program that is in use is deleted when another takes its place.
        unsafe { self.context.gl().delete_program(program.0) };
    }

    /// Sets the matrices that the program has. One declared with another type keeps its value, as on any driver.
    pub fn set_uniforms(&self, program: Linked, uniforms: &[(&str, [f32; 16])]) {
        let gl = self.context.gl();
        // SAFETY: see the head of this file. The value has the 16 floats of one matrix.
        unsafe {
            gl.use_program(Some(program.0));
            for (name, matrix) in uniforms {
                gl.uniform_matrix_4_f32_slice(gl.get_uniform_location(program.0, name).as_ref(), false, matrix);
                gl.get_error();
            }
        }
    }

    /// Uploads a mesh, as 3 floats for each attribute that the program uses.
    pub fn vertices(&self, program: Linked, positions: &[[f32; 3]], normals: &[[f32; 3]]) -> Vertices {
        assert_eq!(positions.len(), normals.len(), "one normal for each position");
        let count = i32::try_from(positions.len()).expect("a mesh that OpenGL can count");
        let gl = self.context.gl();
        // SAFETY: see the head of this file. Both buffers hold `count` times 3 floats, so no draw of `count` vertices
        // reads past them.
        unsafe {
            let array = gl.create_vertex_array().expect("a vertex array");
            gl.bind_vertex_array(Some(array));
            let buffers = [("pv", positions), ("cv", normals)].map(|(name, values)| {
                let buffer = gl.create_buffer().expect("a buffer");
                gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
                gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytemuck::cast_slice(values), glow::STATIC_DRAW);
                if let Some(location) = gl.get_attrib_location(program.0, name) {
                    gl.enable_vertex_attrib_array(location);
                    gl.vertex_attrib_pointer_f32(location, 3, glow::FLOAT, false, 0, 0);
                }
                buffer
            });
            Vertices { array, buffers, count }
        }
    }

    /// Makes a framebuffer.
    pub fn frame(&self, width: u32, height: u32) -> Frame {
        let [width, height] = [width, height].map(|side| i32::try_from(side).expect("a size that OpenGL can count"));
        let gl = self.context.gl();
        // SAFETY: see the head of this file.
        unsafe {
            let renderbuffer = gl.create_renderbuffer().expect("a renderbuffer");
            gl.bind_renderbuffer(glow::RENDERBUFFER, Some(renderbuffer));
            gl.renderbuffer_storage(glow::RENDERBUFFER, glow::RGBA8, width, height);
            let framebuffer = gl.create_framebuffer().expect("a framebuffer");
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let (kind, colour) = (glow::RENDERBUFFER, glow::COLOR_ATTACHMENT0);
            gl.framebuffer_renderbuffer(glow::FRAMEBUFFER, colour, kind, Some(renderbuffer));
            let status = gl.check_framebuffer_status(glow::FRAMEBUFFER);
            assert_eq!(status, glow::FRAMEBUFFER_COMPLETE, "a framebuffer of {width} × {height}");
            Frame { framebuffer, renderbuffer, width, height }
        }
    }

    /// Clears the frame and draws triangles.
    pub fn draw(&self, frame: &Frame, program: Linked, vertices: &Vertices, [red, green, blue, alpha]: [f32; 4]) {
        let gl = self.context.gl();
        // SAFETY: see the head of this file. The buffers behind the vertex array hold `count` vertices.
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(frame.framebuffer));
            gl.viewport(0, 0, frame.width, frame.height);
            gl.clear_color(red, green, blue, alpha);
            gl.clear(glow::COLOR_BUFFER_BIT);
            gl.use_program(Some(program.0));
            gl.bind_vertex_array(Some(vertices.array));
            gl.draw_arrays(glow::TRIANGLES, 0, vertices.count);
            self.check("draw");
        }
    }

    /// Reads RGBA, 8 bits a channel, bottom row first.
    pub fn read(&self, frame: &Frame) -> Vec<u8> {
        let [width, height] = [frame.width, frame.height].map(|side| usize::try_from(side).unwrap_or(0));
        let mut pixels = vec![0; width * height * 4];
        let gl = self.context.gl();
        // SAFETY: see the head of this file. The slice holds 4 bytes for each pixel that is read, and rows of 4-byte
        // pixels need no padding.
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(frame.framebuffer));
            let into = glow::PixelPackData::Slice(Some(&mut pixels));
            gl.read_pixels(0, 0, frame.width, frame.height, glow::RGBA, glow::UNSIGNED_BYTE, into);
        }
        self.check("read");
        pixels
    }

    /// Runs a program whose recorded varyings are 8 floats, once for each vertex, and returns them.
    pub fn record(&self, program: Linked, positions: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<f32> {
        let vertices = self.vertices(program, positions, normals);
        // Without a window OpenGL draws only into a framebuffer, even when it discards what it draws.
        let frame = self.frame(1, 1);
        let mut floats = vec![0.0f32; positions.len() * 8];
        let gl = self.context.gl();
        // SAFETY: see the head of this file. OpenGL records no more than fits the buffer, and the buffer is read into a
        // slice of its own size.
        unsafe {
            let buffer = gl.create_buffer().expect("a buffer");
            gl.bind_buffer_base(glow::TRANSFORM_FEEDBACK_BUFFER, 0, Some(buffer));
            let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut floats);
            gl.buffer_data_u8_slice(glow::TRANSFORM_FEEDBACK_BUFFER, bytes, glow::DYNAMIC_READ);
            gl.use_program(Some(program.0));
            gl.enable(glow::RASTERIZER_DISCARD);
            gl.begin_transform_feedback(glow::POINTS);
            gl.draw_arrays(glow::POINTS, 0, vertices.count);
            gl.end_transform_feedback();
            gl.disable(glow::RASTERIZER_DISCARD);
            gl.get_buffer_sub_data(glow::TRANSFORM_FEEDBACK_BUFFER, 0, bytes);
            gl.delete_buffer(buffer);
        }
        self.check("record");
        self.release(frame, vertices);
        floats
    }

    /// Ends what was made for a draw.
    pub fn release(&self, frame: Frame, vertices: Vertices) {
        // SAFETY: see the head of this file.
        unsafe {
            self.context.gl().delete_framebuffer(frame.framebuffer);
            self.context.gl().delete_renderbuffer(frame.renderbuffer);
            self.context.gl().delete_vertex_array(vertices.array);
            vertices.buffers.into_iter().for_each(|buffer| self.context.gl().delete_buffer(buffer));
        }
    }

    /// The functions of OpenGL.
    pub(super) fn gl(&self) -> &glow::Context {
        self.context.gl()
    }

    pub(super) fn check(&self, what: &str) {
        // SAFETY: see the head of this file.
        let error = unsafe { self.context.gl().get_error() };
        assert_eq!(error, glow::NO_ERROR, "OpenGL error {error:#06x} at {what}");
    }
}

/// glow takes the log for UTF-8; Mesa may quote half a character of the shader in it.
fn readable(log: String) -> String {
    String::from_utf8_lossy(log.as_bytes()).into_owned()
}
