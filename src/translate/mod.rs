//! Source → [`Shader`]: the compiler's verdict, the interface, and the module that wgpu runs.
//!
//! Two passes over the student's text. The first, under OpenGL's rules, is the verdict; the second
//! writes SPIR-V, from which the module is made. What only the second refuses is our limit.

mod build;
mod entry;
mod fuel;
mod gate;
pub mod glslang;
mod interface;
mod limits;
mod log;
mod module;
mod opaque;
mod rework;
mod spirv;

pub use entry::{Attribute, CAPTURE_GROUP, CAPTURE_HEADER, CAPTURE_STRIDE};
pub use fuel::{MAX_TURNS, Meter};
pub use interface::{Interface, Variable};
pub use module::{Shader, Uniform, UniformBlock, unsupported};
pub use spirv::Lines;

use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::source::Source;
use glslang::{Outcome, Reached, Request, Rules, Stage, compile};

/// Why there is no shader.
#[derive(Clone, Debug)]
pub enum Refusal {
    /// The student's file is at fault.
    Rejected(Vec<Diagnostic>),
    /// It exceeds a limit.
    Stopped(Vec<Diagnostic>),
    /// ggrade is.
    Fault(Fault),
}

impl From<Fault> for Refusal {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

/// A shader that runs, and what there is to say about it.
#[derive(Clone, Debug)]
pub struct Translation {
    /// The shader.
    pub shader: Shader,
    /// Warnings and notes.
    pub diagnostics: Vec<Diagnostic>,
}

/// Compiles, links and translates a vertex shader.
pub fn translate(source: &Source, interface: &Interface) -> Result<Translation, Refusal> {
    gate::check_text(source)?;
    let text = rework::c_text(&source.text);
    let verdict = compile(&Request {
        vertex: &text,
        fragment: &interface.fragment,
        preamble: c"",
        rules: Rules::OpenGl,
        version: None,
        emit: Stage::Vertex,
    });
    if verdict.reached != Reached::Done {
        return Err(rejected(&verdict, source, interface));
    }
    let mut diagnostics = log::vertex_diagnostics(&verdict.vertex_log, &source.text, interface);
    let spirv = second_pass(source, interface)?;
    gate::check_words(&spirv, source)?;
    let inputs: Vec<&str> = interface.inputs.iter().map(|variable| variable.name.as_str()).collect();
    let shader = module::build(&spirv, source, &inputs, &interface.output.name)?;
    diagnostics.extend(interface::check(&shader, source, interface)?);
    Ok(Translation { shader, diagnostics })
}

fn rejected(verdict: &Outcome, source: &Source, interface: &Interface) -> Refusal {
    match verdict.reached {
        Reached::Vertex => Refusal::Rejected(log::vertex_diagnostics(&verdict.vertex_log, &source.text, interface)),
        Reached::Link => Refusal::Rejected(log::link_diagnostics(&verdict.link_log, &source.text, interface)),
        Reached::Fragment | Reached::Done => Refusal::Fault(Fault::new(crate::language::Text::verbatim(format!(
            "the assignment's fixed fragment shader does not compile: {}",
            verdict.link_log
        )))),
    }
}

/// SPIR-V of a text that the first pass accepts.
fn second_pass(source: &Source, interface: &Interface) -> Result<Vec<u32>, Fault> {
    let version = rework::version(source.code());
    let reworked = rework::rework(&source.text, source.code(), version);
    let request = Request {
        vertex: &reworked.text,
        fragment: &interface.fragment,
        preamble: &reworked.preamble,
        rules: Rules::VulkanRelaxed,
        version: reworked.version,
        emit: Stage::Vertex,
    };
    let mut outcome = compile(&request);
    let set: Vec<&str> = interface.uniforms.iter().map(|variable| variable.name.as_str()).collect();
    if let Some(text) = rework::initialised_uniforms(&source.text, source.code(), &outcome.vertex_log, &set) {
        outcome = compile(&Request { vertex: &text, ..request });
    }
    if outcome.reached == Reached::Done && !outcome.spirv.is_empty() {
        return Ok(outcome.spirv);
    }
    let log = [outcome.vertex_log, outcome.link_log].concat();
    Err(unsupported(log.lines().find(|line| line.starts_with("ERROR")).unwrap_or(log.trim())))
}

/// The module of the assignment's fixed fragment stage, linked with a vertex shader that fits it.
pub fn fixed_stage(interface: &Interface, vertex: &str) -> Result<naga::Module, Fault> {
    let outcome = compile(&Request {
        vertex: &rework::c_text(vertex),
        fragment: &interface.fragment,
        preamble: c"",
        rules: Rules::VulkanRelaxed,
        version: None,
        emit: Stage::Fragment,
    });
    if outcome.reached != Reached::Done {
        return Err(unsupported(&[outcome.vertex_log, outcome.link_log].concat()));
    }
    module::build_fixed_stage(&outcome.spirv, &interface.output.name)
}

/// Has the compiler build its symbol tables, which takes a tenth of a second once a process.
pub fn warm(interface: &Interface, vertex: &str) {
    compile(&Request {
        vertex: &rework::c_text(vertex),
        fragment: &interface.fragment,
        preamble: c"",
        rules: Rules::OpenGl,
        version: None,
        emit: Stage::Vertex,
    });
}
