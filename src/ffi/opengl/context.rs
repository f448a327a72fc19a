//! An OpenGL context without a display, made by EGL.

use glow::HasContext;
use khronos_egl as egl;
use std::marker::PhantomData;
use std::sync::OnceLock;

const PACKAGES: &str = "install the software OpenGL driver: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri";

/// From the extension EGL_MESA_platform_surfaceless.
const PLATFORM_SURFACELESS_MESA: egl::Enum = 0x31DD;

type Egl = egl::DynamicInstance<egl::EGL1_5>;

/// Which `#version` the driver takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// What it offers of its own accord.
    AsOffered,
    /// Up to `#version 460`, which Mesa's compiler knows even where its software driver does not offer it.
    Raised460,
}

/// A context that is current in the thread that made it, and cannot leave it.
pub struct OpenglContext {
    egl: &'static Egl,
    display: egl::Display,
    context: egl::Context,
    gl: glow::Context,
    thread: PhantomData<*const ()>,
}

impl Drop for OpenglContext {
    fn drop(&mut self) {
        // A context that cannot be released is lost with the process; there is nobody to tell.
        let _ = self.egl.make_current(self.display, None, None, None);
        let _ = self.egl.destroy_context(self.display, self.context);
    }
}

impl OpenglContext {
    /// The functions of OpenGL.
    pub fn gl(&self) -> &glow::Context {
        &self.gl
    }

    /// Makes a context and makes it current in this thread.
    pub fn start(version: Version) -> Result<Self, String> {
        let egl = library(version)?;
        if egl.get_current_context().is_some() {
            return Err("this thread has an OpenGL context already".into());
        }
        // SAFETY: the surfaceless platform takes no native display, only the default (null).
        let display =
            unsafe { egl.get_platform_display(PLATFORM_SURFACELESS_MESA, egl::DEFAULT_DISPLAY, &[egl::ATTRIB_NONE]) }
                .map_err(failed("no EGL display without a screen"))?;
        egl.initialize(display).map_err(failed("EGL does not start"))?;
        egl.bind_api(egl::OPENGL_API).map_err(failed("EGL knows no desktop OpenGL"))?;
        let config = egl
            .choose_first_config(display, &[egl::SURFACE_TYPE, 0, egl::RENDERABLE_TYPE, egl::OPENGL_BIT, egl::NONE])
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
        let context = egl.create_context(display, config, None, &wanted).map_err(failed("no OpenGL 4.1 core"))?;
        egl.make_current(display, None, None, Some(context)).map_err(failed("the OpenGL context is refused"))?;
        // SAFETY: a context is current, and the addresses come from the library that made it.
        let gl = unsafe {
            glow::Context::from_loader_function(|name| {
                egl.get_proc_address(name).map_or(std::ptr::null(), |function| function as *const _)
            })
        };
        // SAFETY: the context is current. Dithering is the one state that differs from the default.
        unsafe { gl.disable(glow::DITHER) };
        Ok(Self { egl, display, context, gl, thread: PhantomData })
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
        (version, library.map_err(|error| format!("no EGL library ({error:?}); {PACKAGES}")))
    });
    if *started != version {
        return Err(format!("this process runs the OpenGL driver with {started:?} and cannot change to {version:?}"));
    }
    library.as_ref().map_err(Clone::clone)
}

/// Mesa is told by its environment what to do, and reads it while it starts.
fn set_environment(version: Version) {
    let raised: &[_] = match version {
        Version::AsOffered => &[],
        Version::Raised460 => &[("MESA_GL_VERSION_OVERRIDE", "4.6"), ("MESA_GLSL_VERSION_OVERRIDE", "460")],
    };
    let always = [("LIBGL_ALWAYS_SOFTWARE", "1"), ("MESA_SHADER_CACHE_DISABLE", "true")];
    for (name, value) in always.iter().chain(raised) {
        // SAFETY: once in a process, before the library is loaded that reads these variables. Rust's own readers of the
        // environment take the same lock.
        unsafe { std::env::set_var(name, value) };
    }
}
