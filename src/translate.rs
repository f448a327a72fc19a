//! Source → [`Shader`]: the compiler's verdict, the interface, and the module that wgpu runs.
//!
//! Two passes over the student's text. The first, under OpenGL's rules, is the verdict; the second
//! writes SPIR-V, from which the module is made. What only the second refuses is our limit.

mod build;
mod concessions;
mod entry;
mod fuel;
#[cfg(fuzzing)]
pub mod fuzzing;
mod gate;
pub mod glslang;
mod hints;
mod interface;
mod interpreter;
mod limits;
mod log;
mod macros;
mod module;
mod opaque;
mod portability;
mod spirv;
mod strict;
#[cfg(test)]
mod tests;
mod text;
mod undefined;

pub use entry::{Attribute, CAPTURE_GROUP, CAPTURE_HEADER, CAPTURE_STRIDE};
pub use fuel::{MAX_TURNS, Meter};
pub use interface::{Interface, Variable};
pub use interpreter::{Given, Interpreter, Place, Value, Written};
pub use module::{Shader, Uniform, UniformBlock, unsupported};
pub use spirv::Lines;
pub use undefined::NO_LINE;

use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::source::Source;
use concessions::Renamed;
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
    /// The text that the compiler accepts.
    text: String,
    renamed: Vec<Renamed>,
}

/// Compiles, links and translates a vertex shader.
pub fn translate(source: &Source, interface: &Interface) -> Result<Translation, Refusal> {
    gate::check_text(source)?;
    if let Some(error) = strict::hidden_version(source) {
        return Err(Refusal::Rejected(vec![error]));
    }
    let Accepted { text, renamed, verdict, warnings } = first_pass(source, interface)?;
    let mut overlooked = hints::overlooked_errors(&source.text, interface);
    overlooked.extend(strict::errors(source, interface));
    if !overlooked.is_empty() {
        return Err(Refusal::Rejected(overlooked));
    }
    let mut diagnostics = log::vertex_diagnostics(&verdict.vertex_log, &source.text, interface);
    diagnostics.extend(warnings);
    diagnostics.extend(portability::warnings(source, interface));
    let spirv = second_pass(&text, &renamed, text::version(source.code()))?;
    gate::check_words(&spirv, source)?;
    let shader = module::build(spirv, source, interface, false)?;
    diagnostics.extend(interface::check(&shader, source, interface)?);
    Ok(Translation { shader, diagnostics, text, renamed })
}

impl Translation {
    /// The shader, to be run step by step. Its numeric constants are variables there, so that an expression of them is
    /// computed on the line on which it is written, and not before the shader runs.
    pub fn interpreter(&self, source: &Source) -> Option<Interpreter> {
        let version = text::version(source.code());
        // Lines are those of the file, whatever it says of them.
        let plain = hints::without_line_directives(&self.text);
        let text = plain.as_ref().unwrap_or(&self.text);
        let text = macros::on_their_lines(text, version).unwrap_or_else(|| text.clone());
        let variable = text::without_constants(&text);
        let compiled = |text: &str| second_pass(text, &self.renamed, version).ok();
        let words = variable.as_deref().and_then(compiled).or_else(|| compiled(&text));
        Interpreter::new(&words?)
    }
}

/// A text that the compiler accepts under OpenGL's rules.
struct Accepted {
    text: String,
    renamed: Vec<Renamed>,
    verdict: Outcome,
    warnings: Vec<Diagnostic>,
}

/// How often the text is changed for what the compiler minds and drivers take; each refusal can hide the next.
const MAX_CONCESSIONS: usize = 4;

/// The compiler's verdict on the student's text.
fn first_pass(source: &Source, interface: &Interface) -> Result<Accepted, Refusal> {
    if let Some(name) = concessions::fatal(source) {
        return Err(unsupported(&format!("`{name}`")).into());
    }
    let mut text = text::prepared(source);
    let mut warnings = Vec::new();
    let mut renamed = Vec::new();
    let mut verdict = check(&text, interface, &renamed);
    for _ in 0..MAX_CONCESSIONS {
        if verdict.reached != Reached::Vertex {
            break;
        }
        let Some(granted) = concessions::grant(&text, &verdict, source) else { break };
        text = granted.text;
        warnings.extend(granted.warnings);
        renamed.extend(granted.renamed);
        verdict = check(&text, interface, &renamed);
    }

    match (verdict.reached, concessions::unimplemented(&verdict)) {
        (Reached::Done, _) => Ok(Accepted { text, renamed, verdict, warnings }),
        (_, Some(feature)) => Err(unsupported(&format!("`{feature}`")).into()),
        _ => Err(rejected(verdict, &text, &renamed, source, interface)),
    }
}

/// Compiles and links under OpenGL's rules.
fn check(text: &str, interface: &Interface, renamed: &[Renamed]) -> Outcome {
    let mut outcome = compile(&Request {
        vertex: &text::c_text(text),
        fragment: Some(&interface.fragment),
        preamble: c"",
        rules: Rules::OpenGl,
        version: None,
        emit: Stage::Vertex,
    });
    concessions::in_own_names(&mut outcome, renamed);
    outcome
}

fn rejected(verdict: Outcome, text: &str, renamed: &[Renamed], source: &Source, interface: &Interface) -> Refusal {
    // With `#line` the compiler counts as the student tells it to; a person counts lines of the file.
    let plain = hints::without_line_directives(text).map(|text| check(&text, interface, renamed));
    let verdict = match plain {
        None => verdict,
        Some(plain) if plain.reached == verdict.reached => plain,
        Some(_) => return Refusal::Rejected(vec![hints::refused_line_directive(text)]),
    };
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
fn second_pass(text: &str, renamed: &[Renamed], version: i32) -> Result<Vec<u32>, Fault> {
    let ready = text::for_spirv(text, version);
    let request = Request {
        vertex: &ready.text,
        // That the two fit together, the first pass has seen.
        fragment: None,
        preamble: &ready.preamble,
        rules: Rules::SpirV,
        version: ready.version,
        emit: Stage::Vertex,
    };
    let mut outcome = compile(&request);
    concessions::in_own_names(&mut outcome, renamed);
    if outcome.reached == Reached::Done && !outcome.spirv.is_empty() {
        return Ok(outcome.spirv);
    }
    let log = [outcome.vertex_log, outcome.link_log].concat();
    Err(unsupported(log.lines().find(|line| line.starts_with("ERROR")).unwrap_or(log.trim())))
}

/// The module of the assignment's fixed fragment stage, linked with a vertex shader that fits it.
pub fn fixed_stage(interface: &Interface, vertex: &str) -> Result<naga::Module, Fault> {
    // The compiler keeps one table of built-ins for both kinds of rules; it must be made under OpenGL's, or
    // `gl_DepthRange` is missing from it.
    warm(interface, vertex);
    let outcome = compile(&Request {
        vertex: &text::c_text(vertex),
        fragment: Some(&interface.fragment),
        preamble: c"",
        rules: Rules::SpirV,
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
    check(vertex, interface, &[]);
}
