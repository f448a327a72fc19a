//! Source → [`Shader`]: the compiler's verdict, the interface, and the module that wgpu runs.
//!
//! Two passes over the student's text. The first, under OpenGL's rules, is the verdict; the second
//! writes SPIR-V, from which the module is made. What only the second refuses is our limit.

mod blocks;
mod boundary;
mod build;
mod concessions;
mod entry;
mod fuel;
#[cfg(fuzzing)]
pub mod fuzzing;
mod gate;
pub mod hints;
mod interface;
mod log;
mod module;
mod old_lookups;
mod opaque;
mod portability;
mod program;
mod spirv;
mod strict;
#[cfg(test)]
mod tests;
mod text;
mod undefined;
mod uniforms;
mod verdict;

pub use crate::ffi::glslang::Stage;
pub use blocks::PlacedUniform;
pub use entry::{CAPTURE_GROUP, CAPTURE_HEADER, CAPTURE_SLOT, StageVariable};
pub use fuel::{LoopFuel, MAX_TURNS};
pub(crate) use interface::place;
pub use interface::{LinkedInterface, Variable};
pub use module::{INSTANCE_NUMBER, Shader, VERTEX_NUMBER, unsupported};
pub use program::{HomeworkProgram, Linked, ProgramRefusal};
pub use spirv::{
    CommonTexture, DESCRIPTION, InputInterpolation, InterfaceQualifiers, LineTable, TEXTURES, descriptions,
};
pub use undefined::NO_LINE;
pub use uniforms::{UniformBlock, UniformMember};

use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::ffi::glslang::{CompilerOutput, GlslangRequest, GlslangRules, Reached, StageText, compile};
use crate::language::Text;
use crate::source::{self, Source};
use concessions::Renamed;
use module::Built;
use std::ffi::CStr;
use verdict::{Submitted, compiled, first_pass, linked};

/// Why there is no shader.
#[derive(Clone, Debug)]
pub enum TranslationRefusal {
    /// The student's file is at fault.
    Rejected(Vec<Diagnostic>),
    /// It exceeds a limit.
    Stopped(Vec<Diagnostic>),
    /// ggrade is.
    Fault(Fault),
}

impl From<Fault> for TranslationRefusal {
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

/// A text whose lines are those of the file, whatever it says of them.
pub fn plain_lines(text: &str) -> std::borrow::Cow<'_, str> {
    hints::without_line_directives(text).map_or(text.into(), Into::into)
}

/// Compiles, links and translates a vertex shader.
pub fn translate(source: &Source, interface: &LinkedInterface) -> Result<Translation, TranslationRefusal> {
    check_text(source)?;
    let mut stages = [Submitted::new(Stage::Vertex, source, interface)];
    let fixed = [StageText::plain(Stage::Fragment, &interface.fragment)];
    let verdict = first_pass(&mut stages, &fixed).map_err(|(_, refusal)| refusal)?;
    linked(&verdict, &stages, &fixed)?;
    let [stage] = stages;
    let mut diagnostics = stage.diagnostics(&verdict)?;
    let spirv = stage.second_pass()?;
    gate::check_words(&spirv, source, Stage::Vertex, &interface.set_uniforms())?;
    let outputs = Some(vec![interface.colour().to_owned()]);
    let shader = module::build(
        spirv,
        source,
        interface,
        Built { stage: Stage::Vertex, outputs, is_fixed: false, poisons: false },
    )?;
    diagnostics.extend(interface::check(&shader, source, interface)?);
    Ok(Translation { shader, diagnostics })
}

/// What is looked at before the compiler sees a text.
fn check_text(source: &Source) -> Result<(), TranslationRefusal> {
    gate::check_text(source)?;
    if let Some(error) = strict::hidden_version(source) {
        return Err(TranslationRefusal::Rejected(vec![error]));
    }
    old_lookups::refuse(source)
}

/// SPIR-V of a text that the first pass accepts. That the stages fit together, the first pass has seen.
fn second_pass(
    stage: Stage,
    text: &str,
    preamble: &CStr,
    renamed: &[Renamed],
    version: i32,
) -> Result<Vec<u32>, Fault> {
    let ready = text::for_spirv(text, preamble, version, stage);
    let text = StageText { stage, text: &ready.text, preamble: &ready.preamble, version: ready.version };
    let mut outcome = compile(&GlslangRequest { stages: &[text], rules: GlslangRules::SpirV, emit: stage });
    concessions::in_own_names(&mut outcome, renamed);
    if outcome.reached == Reached::Done && !outcome.spirv.is_empty() {
        return Ok(outcome.spirv);
    }
    let log = [outcome.log(stage), &outcome.link_log].concat();
    Err(unsupported(log.lines().find(|line| line.starts_with("ERROR")).unwrap_or(log.trim())))
}

/// The homework's own stage with this text.
fn fixed(stage: Stage, text: &CStr, interface: &LinkedInterface) -> Result<Shader, Fault> {
    let text = text.to_str().unwrap_or_default();
    let source =
        source::read_stage(stage, "fixed", text.as_bytes()).map_err(|_| unsupported("the text of a fixed stage"))?;
    let spirv = second_pass(stage, text, c"", &[], source.version())?;
    let how = Built { stage, outputs: None, is_fixed: true, poisons: false };
    module::build(spirv, &source, interface, how).map_err(|refusal| match refusal {
        TranslationRefusal::Fault(fault) => fault,
        TranslationRefusal::Rejected(_) | TranslationRefusal::Stopped(_) => unsupported("a fixed stage of this size"),
    })
}

/// The assignment's fixed fragment stage, which fits the vertex shader `vertex`.
pub fn fixed_stage(interface: &LinkedInterface, vertex: &str) -> Result<Shader, Fault> {
    // The compiler keeps one table of built-ins for both kinds of rules; it must be made under OpenGL's, or
    // `gl_DepthRange` is missing from it.
    let outcome = warm(interface, vertex);
    if outcome.reached != Reached::Done {
        let log = [outcome.log(Stage::Vertex), outcome.log(Stage::Fragment), &outcome.link_log].concat();
        return Err(Fault::new(Text::new(
            format!("the compiler refuses what the homework hands out: {log}"),
            format!("配布ファイルがコンパイルできません: {log}"),
        )));
    }
    fixed(Stage::Fragment, &interface.fragment, interface)
}

/// The same before any assignment is known.
pub fn warm_up() {
    let fragment = c"#version 410 core\nin vec4 colour; out vec4 fragment; void main() { fragment = colour; }";
    let interface = LinkedInterface {
        stage: Stage::Vertex,
        inputs: vec![],
        attributes: Vec::new(),
        uniforms: vec![],
        outputs: vec![Variable { name: "colour".into(), ty: "vec4".into() }],
        constants: vec![],
        functions: vec![],
        placed: vec![],
        version: String::new(),
        alike: None,
        fragment: fragment.to_owned(),
    };
    warm(&interface, "#version 410 core\nout vec4 colour; void main() { gl_Position = colour = vec4(0.0); }");
}

/// Has the compiler build its symbol tables, which takes a tenth of a second once a process.
pub fn warm(interface: &LinkedInterface, vertex: &str) -> CompilerOutput {
    let vertex = text::c_text(vertex);
    let fixed = [StageText::plain(Stage::Fragment, &interface.fragment)];
    compiled(std::iter::once(StageText::plain(Stage::Vertex, &vertex)), &fixed)
}
