//! The machine's OpenGL driver, without a display.
//!
//! Two facts carry every call. A [`OpenglContext`] is current in its thread as long as it lives and cannot leave it, so the functions
//! that glow loaded may be called. Each object name that is handed to them was made by this context.

mod context;
mod scene;
mod texture;

pub use context::Version;
pub use scene::{OpenglDraw, UniformValue, ValueKind, Window};

use context::OpenglContext;
use glow::HasContext;

/// Who refused a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefusedBy {
    /// The compiler, while reading a shader.
    Compiler,
    /// The linker, while joining the stages.
    Linker,
}

/// The driver refuses a program.
#[derive(Clone, Debug)]
pub struct Rejection {
    /// Who refuses it.
    pub by: RefusedBy,
    /// The driver's log.
    pub log: String,
}

/// A linked program. It lives until it is deleted.
#[derive(Clone, Copy, Debug)]
pub struct LinkedProgram(glow::Program);

impl LinkedProgram {
    /// Its name in OpenGL.
    pub fn name(self) -> glow::Program {
        self.0
    }
}

/// OpenGL 4.1 core or newer in this thread. Depth test, culling, blending, multisampling and dithering are off.
pub struct Driver {
    context: OpenglContext,
}

impl Driver {
    /// Makes a context in this thread.
    ///
    /// # Errors
    /// There is no driver, and then the message names the packages to install. Or this thread has a context already, or the
    /// process has started the driver with another version.
    pub fn start(version: Version) -> Result<Self, String> {
        Ok(Self { context: OpenglContext::start(version)? })
    }

    /// Renderer and version.
    pub fn renderer(&self) -> String {
        // SAFETY: see the head of this file.
        let [renderer, version] =
            unsafe { [glow::RENDERER, glow::VERSION].map(|name| self.gl().get_parameter_string(name)) };
        format!("{renderer}, OpenGL {version}")
    }

    /// Compiles and links; `varyings` are recorded by transform feedback.
    ///
    /// # Errors
    /// The driver refuses the program.
    pub fn link(&self, vertex: &str, fragment: &str, varyings: &[&str]) -> Result<LinkedProgram, Rejection> {
        let compiled = |stage, text| self.shader(stage, text).map_err(|log| Rejection { by: RefusedBy::Compiler, log });
        let shaders = [compiled(glow::VERTEX_SHADER, vertex)?, compiled(glow::FRAGMENT_SHADER, fragment)?];
        let gl = self.gl();
        // SAFETY: see the head of this file. A shader that is deleted while attached lives as long as the program.
        unsafe {
            let program = gl.create_program().expect("a program");
            for shader in shaders {
                gl.attach_shader(program, shader);
                gl.delete_shader(shader);
            }
            if !varyings.is_empty() {
                gl.transform_feedback_varyings(program, varyings, glow::INTERLEAVED_ATTRIBS);
            }
            gl.link_program(program);
            if gl.get_program_link_status(program) {
                return Ok(LinkedProgram(program));
            }
            let log = readable(&gl.get_program_info_log(program));
            gl.delete_program(program);
            Err(Rejection { by: RefusedBy::Linker, log })
        }
    }

    fn shader(&self, stage: u32, text: &str) -> Result<glow::Shader, String> {
        let gl = self.gl();
        // SAFETY: see the head of this file. The text is passed with its length.
        unsafe {
            let shader = gl.create_shader(stage).expect("a shader");
            gl.shader_source(shader, text);
            gl.compile_shader(shader);
            if gl.get_shader_compile_status(shader) {
                return Ok(shader);
            }
            let log = readable(&gl.get_shader_info_log(shader));
            gl.delete_shader(shader);
            Err(log)
        }
    }

    /// Ends a program.
    pub fn delete(&self, program: LinkedProgram) {
        // SAFETY: see the head of this file. A program that is in use is deleted when another takes its place.
        unsafe { self.gl().delete_program(program.0) };
    }

    /// The functions of OpenGL.
    pub fn gl(&self) -> &glow::Context {
        self.context.gl()
    }

    /// Holds that OpenGL has no error to tell.
    ///
    /// # Panics
    /// It has: an operation of ours is wrong, or the driver has no memory left.
    pub fn check(&self, what: &str) {
        // SAFETY: see the head of this file.
        let error = unsafe { self.gl().get_error() };
        assert_eq!(error, glow::NO_ERROR, "OpenGL error {error:#06x} at {what}");
    }
}

impl std::fmt::Debug for Driver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Driver").finish_non_exhaustive()
    }
}

/// glow takes the log for UTF-8; Mesa may quote half a character of the shader in it.
fn readable(log: &str) -> String {
    String::from_utf8_lossy(log.as_bytes()).into_owned()
}
