//! EGL and OpenGL behind functions that cannot be misused: the only unsafe code of the tests.
//!
//! Two facts carry every call below. A [`Driver`] cannot leave its thread and its context is current there as long as
//! it lives, so the functions that glow loaded may be called; and each object name handed to them was made by this
//! context.
#![allow(unsafe_code, reason = "OpenGL is a C library")]

use super::{Rejection, Stage};
use glow::HasContext;
use khronos_egl as egl;
use std::marker::PhantomData;
use std::sync::OnceLock;

const PACKAGES: &str =
    "install the software OpenGL driver: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri";

/// From the extension EGL_MESA_platform_surfaceless.
const PLATFORM_SURFACELESS_MESA: egl::Enum = 0x31DD;

type Egl = egl::DynamicInstance<egl::EGL1_5>;

/// Which `#version` the driver takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// What it offers of its own accord.
    AsOffered,
    /// Up to `#version 460`, which Mesa's compiler knows but its software driver does not offer before Mesa 23.
    Raised460,
}

/// A linked program.
#[derive(Clone, Copy)]
pub struct Linked(glow::Program);

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

/// A context that is current in this thread.
pub struct Driver {
    egl: &'static Egl,
    display: egl::Display,
    context: egl::Context,
    gl: glow::Context,
    /// Keeps the context in its thread.
    thread: PhantomData<*const ()>,
}

impl Drop for Driver {
    fn drop(&mut self) {
        // A context that cannot be released is lost with the process; there is nobody to tell.
        let _ = self.egl.make_current(self.display, None, None, None);
        let _ = self.egl.destroy_context(self.display, self.context);
    }
}

impl Driver {
    /// Makes a context and makes it current in this thread.
    pub fn start(version: Version) -> Result<Self, String> {
        let egl = library(version)?;
        if egl.get_current_context().is_some() {
            return Err("this thread has an OpenGL context already".into());
        }
        // SAFETY: the surfaceless platform takes no native display, only the default (null).
        let display = unsafe {
            egl.get_platform_display(
                PLATFORM_SURFACELESS_MESA,
                egl::DEFAULT_DISPLAY,
                &[egl::ATTRIB_NONE],
            )
        }
        .map_err(failed("no EGL display without a screen"))?;
        egl.initialize(display)
            .map_err(failed("EGL does not start"))?;
        egl.bind_api(egl::OPENGL_API)
            .map_err(failed("EGL knows no desktop OpenGL"))?;
        let config = egl
            .choose_first_config(
                display,
                &[
                    egl::SURFACE_TYPE,
                    0,
                    egl::RENDERABLE_TYPE,
                    egl::OPENGL_BIT,
                    egl::NONE,
                ],
            )
            .map_err(failed("EGL has no configuration"))?
            .ok_or_else(|| format!("EGL has no configuration for desktop OpenGL; {PACKAGES}"))?;
        let wanted = [
            egl::CONTEXT_MAJOR_VERSION,
            4,
            egl::CONTEXT_MINOR_VERSION,
            1,
            egl::CONTEXT_OPENGL_PROFILE_MASK,
            egl::CONTEXT_OPENGL_CORE_PROFILE_BIT,
            egl::NONE,
        ];
        let context = egl
            .create_context(display, config, None, &wanted)
            .map_err(failed("no OpenGL 4.1 core"))?;
        egl.make_current(display, None, None, Some(context))
            .map_err(failed("the OpenGL context is refused"))?;
        // SAFETY: a context is current, and the addresses come from the library that made it.
        let gl = unsafe {
            glow::Context::from_loader_function(|name| {
                egl.get_proc_address(name)
                    .map_or(std::ptr::null(), |function| function as *const _)
            })
        };
        // SAFETY: the context is current. Dithering is the one state that differs from the default.
        unsafe { gl.disable(glow::DITHER) };
        Ok(Self {
            egl,
            display,
            context,
            gl,
            thread: PhantomData,
        })
    }

    /// Renderer and version.
    pub fn renderer(&self) -> String {
        // SAFETY: see the head of this file.
        let [renderer, version] = unsafe {
            [glow::RENDERER, glow::VERSION].map(|name| self.gl.get_parameter_string(name))
        };
        format!("{renderer}, OpenGL {version}")
    }

    /// Compiles and links; `varyings` are recorded by transform feedback.
    pub fn link(
        &self,
        vertex: &str,
        fragment: &str,
        varyings: &[&str],
    ) -> Result<Linked, Rejection> {
        let vertex = self
            .shader(glow::VERTEX_SHADER, vertex)
            .map_err(|log| Rejection {
                stage: Stage::Compile,
                log,
            })?;
        let fragment = self
            .shader(glow::FRAGMENT_SHADER, fragment)
            .expect("the fixed fragment shader compiles");
        let gl = &self.gl;
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
            Err(Rejection {
                stage: Stage::Link,
                log,
            })
        }
    }

    fn shader(&self, stage: u32, text: &str) -> Result<glow::Shader, String> {
        let gl = &self.gl;
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
        unsafe { self.gl.delete_program(program.0) };
    }

    /// Sets the matrices that the program has. One declared with another type keeps its value, as on any driver.
    pub fn set_uniforms(&self, program: Linked, uniforms: &[(&str, [f32; 16])]) {
        let gl = &self.gl;
        // SAFETY: see the head of this file. The value has the 16 floats of one matrix.
        unsafe {
            gl.use_program(Some(program.0));
            for (name, matrix) in uniforms {
                gl.uniform_matrix_4_f32_slice(
                    gl.get_uniform_location(program.0, name).as_ref(),
                    false,
                    matrix,
                );
                gl.get_error();
            }
        }
    }

    /// Uploads a mesh, as 3 floats for each attribute that the program uses.
    pub fn vertices(
        &self,
        program: Linked,
        positions: &[[f32; 3]],
        normals: &[[f32; 3]],
    ) -> Vertices {
        assert_eq!(
            positions.len(),
            normals.len(),
            "one normal for each position"
        );
        let count = i32::try_from(positions.len()).expect("a mesh that OpenGL can count");
        let gl = &self.gl;
        // SAFETY: see the head of this file. Both buffers hold `count` times 3 floats, so no draw of `count` vertices
        // reads past them.
        unsafe {
            let array = gl.create_vertex_array().expect("a vertex array");
            gl.bind_vertex_array(Some(array));
            let buffers = [("pv", positions), ("cv", normals)].map(|(name, values)| {
                let buffer = gl.create_buffer().expect("a buffer");
                gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
                gl.buffer_data_u8_slice(
                    glow::ARRAY_BUFFER,
                    bytemuck::cast_slice(values),
                    glow::STATIC_DRAW,
                );
                if let Some(location) = gl.get_attrib_location(program.0, name) {
                    gl.enable_vertex_attrib_array(location);
                    gl.vertex_attrib_pointer_f32(location, 3, glow::FLOAT, false, 0, 0);
                }
                buffer
            });
            Vertices {
                array,
                buffers,
                count,
            }
        }
    }

    /// Makes a framebuffer.
    pub fn frame(&self, width: u32, height: u32) -> Frame {
        let [width, height] =
            [width, height].map(|side| i32::try_from(side).expect("a size that OpenGL can count"));
        let gl = &self.gl;
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
            assert_eq!(
                status,
                glow::FRAMEBUFFER_COMPLETE,
                "a framebuffer of {width} × {height}"
            );
            Frame {
                framebuffer,
                renderbuffer,
                width,
                height,
            }
        }
    }

    /// Clears the frame and draws triangles.
    pub fn draw(
        &self,
        frame: &Frame,
        program: Linked,
        vertices: &Vertices,
        [red, green, blue, alpha]: [f32; 4],
    ) {
        let gl = &self.gl;
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
        let [width, height] =
            [frame.width, frame.height].map(|side| usize::try_from(side).unwrap_or(0));
        let mut pixels = vec![0; width * height * 4];
        let gl = &self.gl;
        // SAFETY: see the head of this file. The slice holds 4 bytes for each pixel that is read, and rows of 4-byte
        // pixels need no padding.
        unsafe {
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(frame.framebuffer));
            let into = glow::PixelPackData::Slice(Some(&mut pixels));
            gl.read_pixels(
                0,
                0,
                frame.width,
                frame.height,
                glow::RGBA,
                glow::UNSIGNED_BYTE,
                into,
            );
        }
        self.check("read");
        pixels
    }

    /// Runs a program whose recorded varyings are 8 floats, once for each vertex, and returns them.
    pub fn record(
        &self,
        program: Linked,
        positions: &[[f32; 3]],
        normals: &[[f32; 3]],
    ) -> Vec<f32> {
        let vertices = self.vertices(program, positions, normals);
        // Without a window OpenGL draws only into a framebuffer, even when it discards what it draws.
        let frame = self.frame(1, 1);
        let mut floats = vec![0.0f32; positions.len() * 8];
        let gl = &self.gl;
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
            self.gl.delete_framebuffer(frame.framebuffer);
            self.gl.delete_renderbuffer(frame.renderbuffer);
            self.gl.delete_vertex_array(vertices.array);
            vertices
                .buffers
                .into_iter()
                .for_each(|buffer| self.gl.delete_buffer(buffer));
        }
    }

    fn check(&self, what: &str) {
        // SAFETY: see the head of this file.
        let error = unsafe { self.gl.get_error() };
        assert_eq!(error, glow::NO_ERROR, "OpenGL error {error:#06x} at {what}");
    }
}

fn failed(what: &str) -> impl Fn(egl::Error) -> String {
    move |error| format!("{what}: {error}; {PACKAGES}")
}

/// The EGL library, loaded once.
fn library(version: Version) -> Result<&'static Egl, String> {
    static LIBRARY: OnceLock<(Version, Result<Egl, String>)> = OnceLock::new();
    let (started, library) = LIBRARY.get_or_init(|| {
        set_environment(version);
        // SAFETY: libEGL.so.1 is by its name the library whose functions the crate declares.
        let library = unsafe { Egl::load_required() };
        (
            version,
            library.map_err(|error| format!("no EGL library ({error:?}); {PACKAGES}")),
        )
    });
    if *started != version {
        return Err(format!(
            "this process runs the OpenGL driver with {started:?} and cannot change to {version:?}"
        ));
    }
    library.as_ref().map_err(Clone::clone)
}

/// Mesa is told by its environment what to do, and reads it while it starts.
fn set_environment(version: Version) {
    let raised: &[_] = match version {
        Version::AsOffered => &[],
        Version::Raised460 => &[
            ("MESA_GL_VERSION_OVERRIDE", "4.6"),
            ("MESA_GLSL_VERSION_OVERRIDE", "460"),
        ],
    };
    let always = [
        ("LIBGL_ALWAYS_SOFTWARE", "1"),
        ("MESA_SHADER_CACHE_DISABLE", "true"),
    ];
    for (name, value) in always.iter().chain(raised) {
        // SAFETY: once in a process, before the library is loaded that reads these variables. Rust's own readers of the
        // environment take the same lock.
        unsafe { std::env::set_var(name, value) };
    }
}

/// glow takes the log for UTF-8; Mesa may quote half a character of the shader in it.
fn readable(log: String) -> String {
    String::from_utf8_lossy(log.as_bytes()).into_owned()
}
