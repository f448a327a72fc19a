//! The one place that speaks to the C interface of glslang: a safe function around its objects.
//!
//! Source text is handed over as "preprocessed" code: the parser runs the preprocessor itself, so
//! that line *and* column of a message are those of the student's own text, and one pass is saved.

mod limits;

use glslang_sys as sys;
pub use reference::interpreter::Stage;
use std::ffi::{CStr, CString};
use std::sync::OnceLock;

/// Under whose rules the text is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GlslangRules {
    /// Desktop OpenGL: these give the verdict.
    OpenGl,
    /// Desktop OpenGL as far as SPIR-V can express it, with automatic locations: these give SPIR-V.
    SpirV,
}

/// How far the compiler came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// A stage does not compile; the first that does not.
    Stage(Stage),
    /// All compile, and they do not link.
    Link,
    /// They link, and their interfaces have locations.
    Done,
}

/// What the compiler says about the stages of a program.
#[derive(Clone, Debug)]
pub struct CompilerOutput {
    /// How far it came.
    pub reached: Reached,
    /// Its log about each stage, as it wrote it, in the order of the request.
    pub logs: Vec<(Stage, String)>,
    /// Its log about linking, as it wrote it.
    pub link_log: String,
    /// The stage that was asked for, in SPIR-V; empty under OpenGL's rules.
    pub spirv: Vec<u32>,
}

impl CompilerOutput {
    /// The log about a stage; empty where it was not asked for.
    pub fn log(&self, stage: Stage) -> &str {
        self.logs.iter().find(|(one, _)| *one == stage).map_or("", |(_, log)| log)
    }
}

/// The text of one stage.
#[derive(Clone, Copy, Debug)]
pub struct StageText<'a> {
    /// Which stage.
    pub stage: Stage,
    /// The text.
    pub text: &'a CStr,
    /// Text that stands before its first line without counting as a line.
    pub preamble: &'a CStr,
    /// Read it as this GLSL version whatever its `#version` says.
    pub version: Option<i32>,
}

impl<'a> StageText<'a> {
    /// The text as it stands.
    pub fn plain(stage: Stage, text: &'a CStr) -> Self {
        Self { stage, text, preamble: c"", version: None }
    }
}

/// How a program is to be read.
#[derive(Clone, Copy, Debug)]
pub struct GlslangRequest<'a> {
    /// Its stages in order; one by itself is linked alone.
    pub stages: &'a [StageText<'a>],
    /// Whose rules.
    pub rules: GlslangRules,
    /// The stage to write as SPIR-V under [`GlslangRules::SpirV`].
    pub emit: Stage,
}

/// Compiles the stages and links them; under [`GlslangRules::SpirV`] also writes SPIR-V.
pub fn compile(request: &GlslangRequest<'_>) -> CompilerOutput {
    static PROCESS: OnceLock<()> = OnceLock::new();
    PROCESS.get_or_init(|| {
        // SAFETY: called once, before any other call into glslang; it has no other precondition.
        unsafe { sys::glslang_initialize_process() };
    });
    let mut outcome =
        CompilerOutput { reached: Reached::Link, logs: Vec::new(), link_log: String::new(), spirv: Vec::new() };
    let mut shaders = Vec::with_capacity(request.stages.len());
    for text in request.stages {
        let shader = GlslangShader::new(request.rules, text);
        let parsed = shader.parse();
        outcome.logs.push((text.stage, shader.log()));
        if !parsed && outcome.reached == Reached::Link {
            outcome.reached = Reached::Stage(text.stage);
        }
        shaders.push(shader);
    }
    if outcome.reached != Reached::Link {
        return outcome;
    }
    let program = GlslangProgram::new(&shaders);
    if program.link(request.rules) {
        outcome.reached = Reached::Done;
        if request.rules == GlslangRules::SpirV {
            outcome.spirv = program.spirv(request.emit);
        }
    }
    outcome.link_log = program.log();
    outcome
}

fn raw(stage: Stage) -> sys::glslang_stage_t {
    match stage {
        Stage::Vertex => sys::glslang_stage_t::Vertex,
        Stage::Fragment => sys::glslang_stage_t::Fragment,
    }
}

impl GlslangRules {
    fn messages(self) -> sys::glslang_messages_t {
        use sys::glslang_messages_t as m;
        let both = m::CASCADING_ERRORS | m::DISPLAY_ERROR_COLUMN | m::VALIDATE_CROSS_STAGE_IO;
        match self {
            GlslangRules::OpenGl => both,
            GlslangRules::SpirV => both | m::SPV_RULES,
        }
    }
}

/// Owns a shader object together with the C text that it reads from.
struct GlslangShader {
    raw: *mut sys::glslang_shader_t,
    input: Box<sys::glslang_input_t>,
    _resource: Box<sys::glslang_resource_t>,
    _code: CString,
}

impl GlslangShader {
    fn new(rules: GlslangRules, text: &StageText<'_>) -> Self {
        let code: CString = text.text.to_owned();
        let resource = Box::new(limits::desktop());
        let spirv = rules == GlslangRules::SpirV;
        let input = Box::new(sys::glslang_input_t {
            language: sys::glslang_source_t::GLSL,
            stage: raw(text.stage),
            // Vulkan's rules would give parameters a precision, and so refuse a student's own `max`.
            client: sys::glslang_client_t::OpenGL,
            client_version: sys::glslang_target_client_version_t::OpenGL450,
            target_language: if spirv {
                sys::glslang_target_language_t::SPIRV
            } else {
                sys::glslang_target_language_t::None
            },
            target_language_version: sys::glslang_target_language_version_t::SPIRV1_0,
            code: code.as_ptr(),
            // The version of a file without a `#version` line.
            default_version: 110,
            default_profile: sys::glslang_profile_t::None,
            force_default_version_and_profile: 0,
            forward_compatible: 0,
            messages: rules.messages(),
            resource: &*resource,
            callbacks: sys::glsl_include_callbacks_t {
                include_system: None,
                include_local: None,
                free_include_result: None,
            },
            callbacks_ctx: std::ptr::null_mut(),
        });
        // SAFETY: `input` is fully initialised, and what it points to (code, resource) lives in boxes
        // that this object owns, so longer than the shader.
        let raw = unsafe { sys::glslang_shader_create(&*input) };
        assert!(!raw.is_null(), "glslang_shader_create rejects its input");
        use sys::glslang_shader_options_t as o;
        let options = o::AUTO_MAP_BINDINGS | o::AUTO_MAP_LOCATIONS;
        // SAFETY: `raw` is live; the texts are NUL-terminated and copied by the callee.
        unsafe {
            sys::glslang_shader_set_options(raw, options.0);
            sys::glslang_shader_set_preamble(raw, text.preamble.as_ptr());
            if let Some(version) = text.version {
                sys::glslang_shader_set_glsl_version(raw, version);
            }
            sys::glslang_shader_set_preprocessed_code(raw, code.as_ptr());
        }
        Self { raw, input, _resource: resource, _code: code }
    }

    fn parse(&self) -> bool {
        // SAFETY: `raw` is live and `input` is the one it was created with.
        unsafe { sys::glslang_shader_parse(self.raw, &*self.input) != 0 }
    }

    fn log(&self) -> String {
        // SAFETY: `raw` is live; the log is a NUL-terminated text that it owns.
        unsafe { text(sys::glslang_shader_get_info_log(self.raw)) }
    }
}

impl Drop for GlslangShader {
    fn drop(&mut self) {
        // SAFETY: created in `new`, deleted once, after every program that refers to it.
        unsafe { sys::glslang_shader_delete(self.raw) }
    }
}

/// A program of shaders that outlive it.
struct GlslangProgram<'a> {
    raw: *mut sys::glslang_program_t,
    _shaders: &'a [GlslangShader],
}

impl<'a> GlslangProgram<'a> {
    fn new(shaders: &'a [GlslangShader]) -> Self {
        // SAFETY: no precondition; the shaders are parsed and outlive the program by the lifetime.
        let raw = unsafe {
            let raw = sys::glslang_program_create();
            shaders.iter().for_each(|shader| sys::glslang_program_add_shader(raw, shader.raw));
            raw
        };
        Self { raw, _shaders: shaders }
    }

    fn link(&self, rules: GlslangRules) -> bool {
        // SAFETY: `raw` is live and has parsed shaders; map_io follows a successful link.
        unsafe {
            sys::glslang_program_link(self.raw, rules.messages().0) != 0
                && (rules == GlslangRules::OpenGl || sys::glslang_program_map_io(self.raw) != 0)
        }
    }

    fn spirv(&self, stage: Stage) -> Vec<u32> {
        let mut options = sys::glslang_spv_options_t {
            generate_debug_info: true,
            strip_debug_info: false,
            disable_optimizer: true,
            optimize_size: false,
            optimize_performance: false,
            disassemble: false,
            validate: false,
            emit_nonsemantic_shader_debug_info: false,
            emit_nonsemantic_shader_debug_source: false,
            compile_only: false,
            optimize_allow_expanded_id_bound: false,
            compiler_signature: std::ptr::null(),
            command_line_arguments: std::ptr::null(),
            current_working_directory: std::ptr::null(),
        };
        // SAFETY: the program is linked and mapped; the pointer is valid for `size` words until the
        // program is deleted or generates again, and the words are copied at once.
        unsafe {
            sys::glslang_program_SPIRV_generate_with_options(self.raw, raw(stage), &mut options);
            let size = sys::glslang_program_SPIRV_get_size(self.raw);
            if size == 0 {
                return Vec::new();
            }
            std::slice::from_raw_parts(sys::glslang_program_SPIRV_get_ptr(self.raw), size).to_vec()
        }
    }

    fn log(&self) -> String {
        // SAFETY: `raw` is live; the log is a NUL-terminated text that it owns.
        unsafe { text(sys::glslang_program_get_info_log(self.raw)) }
    }
}

impl Drop for GlslangProgram<'_> {
    fn drop(&mut self) {
        // SAFETY: created in `new`, deleted once.
        unsafe { sys::glslang_program_delete(self.raw) }
    }
}

/// Copies a text of glslang's; bytes that are not UTF-8 (a student's) are replaced.
///
/// # Safety
/// `raw` is null or a NUL-terminated text that stays valid during the call.
unsafe fn text(raw: *const std::ffi::c_char) -> String {
    if raw.is_null() {
        return String::new();
    }
    // SAFETY: by the contract of this function.
    unsafe { CStr::from_ptr(raw) }.to_string_lossy().into_owned()
}
