//! What is drawn and recorded of a vertex shader. `src/ffi/opengl.rs` says what the calls rest on.
#![allow(unsafe_code, reason = "OpenGL is a C library")]

use ggrade::ffi::opengl::{Driver, LinkedProgram};
use glow::HasContext;

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

/// The driver, and what only vertex shaders of the first homework need of it.
pub struct Recorder(pub Driver);

impl std::ops::Deref for Recorder {
    type Target = Driver;

    fn deref(&self) -> &Driver {
        &self.0
    }
}

impl Recorder {
    /// Sets the matrices that the program has. One declared with another type keeps its value, as on any driver.
    pub fn set_uniforms(&self, program: LinkedProgram, uniforms: &[(&str, [f32; 16])]) {
        let gl = self.gl();
        // SAFETY: see `src/ffi/opengl.rs`. The value has the 16 floats of one matrix.
        unsafe {
            gl.use_program(Some(program.name()));
            for (name, matrix) in uniforms {
                gl.uniform_matrix_4_f32_slice(gl.get_uniform_location(program.name(), name).as_ref(), false, matrix);
                gl.get_error();
            }
        }
    }

    /// Uploads a mesh, as 3 floats for each attribute that the program uses.
    pub fn vertices(&self, program: LinkedProgram, positions: &[[f32; 3]], normals: &[[f32; 3]]) -> Vertices {
        assert_eq!(positions.len(), normals.len(), "one normal for each position");
        let count = i32::try_from(positions.len()).expect("a mesh that OpenGL can count");
        let gl = self.gl();
        // SAFETY: see `src/ffi/opengl.rs`. Both buffers hold `count` times 3 floats, so no draw of `count` vertices
        // reads past them.
        unsafe {
            let array = gl.create_vertex_array().expect("a vertex array");
            gl.bind_vertex_array(Some(array));
            let buffers = [("pv", positions), ("cv", normals)].map(|(name, values)| {
                let buffer = gl.create_buffer().expect("a buffer");
                gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
                gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytemuck::cast_slice(values), glow::STATIC_DRAW);
                if let Some(location) = gl.get_attrib_location(program.name(), name) {
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
        let gl = self.gl();
        // SAFETY: see `src/ffi/opengl.rs`.
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
    pub fn draw(
        &self,
        frame: &Frame,
        program: LinkedProgram,
        vertices: &Vertices,
        [red, green, blue, alpha]: [f32; 4],
    ) {
        let gl = self.gl();
        // SAFETY: see `src/ffi/opengl.rs`. The buffers behind the vertex array hold `count` vertices.
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(frame.framebuffer));
            gl.viewport(0, 0, frame.width, frame.height);
            gl.clear_color(red, green, blue, alpha);
            gl.clear(glow::COLOR_BUFFER_BIT);
            gl.use_program(Some(program.name()));
            gl.bind_vertex_array(Some(vertices.array));
            gl.draw_arrays(glow::TRIANGLES, 0, vertices.count);
            self.check("draw");
        }
    }

    /// Reads RGBA, 8 bits a channel, bottom row first.
    pub fn read(&self, frame: &Frame) -> Vec<u8> {
        let [width, height] = [frame.width, frame.height].map(|side| usize::try_from(side).unwrap_or(0));
        let mut pixels = vec![0; width * height * 4];
        let gl = self.gl();
        // SAFETY: see `src/ffi/opengl.rs`. The slice holds 4 bytes for each pixel that is read, and rows of 4-byte
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
    pub fn record(&self, program: LinkedProgram, positions: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<f32> {
        let vertices = self.vertices(program, positions, normals);
        // Without a window OpenGL draws only into a framebuffer, even when it discards what it draws.
        let frame = self.frame(1, 1);
        let mut floats = vec![0.0f32; positions.len() * 8];
        let gl = self.gl();
        // SAFETY: see `src/ffi/opengl.rs`. OpenGL records no more than fits the buffer, and the buffer is read into a
        // slice of its own size.
        unsafe {
            let buffer = gl.create_buffer().expect("a buffer");
            gl.bind_buffer_base(glow::TRANSFORM_FEEDBACK_BUFFER, 0, Some(buffer));
            let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut floats);
            gl.buffer_data_u8_slice(glow::TRANSFORM_FEEDBACK_BUFFER, bytes, glow::DYNAMIC_READ);
            gl.use_program(Some(program.name()));
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
        // SAFETY: see `src/ffi/opengl.rs`.
        unsafe {
            self.gl().delete_framebuffer(frame.framebuffer);
            self.gl().delete_renderbuffer(frame.renderbuffer);
            self.gl().delete_vertex_array(vertices.array);
            vertices.buffers.into_iter().for_each(|buffer| self.gl().delete_buffer(buffer));
        }
    }
}
