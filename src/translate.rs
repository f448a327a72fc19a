//! Source → [`Shader`]: the compiler's verdict, the interface, and the module that wgpu runs.
//!
//! Two passes over the student's text. The first, under OpenGL's rules, is the verdict; the second
//! writes SPIR-V, from which the module is made. What only the second refuses is our limit.

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
pub(crate) mod limits;
mod log;
mod module;
mod opaque;
mod portability;
mod program;
mod spirv;
mod strict;
#[cfg(test)]
mod tests;
mod text;
mod undefined;

pub use crate::ffi::glslang::Stage;
pub use entry::{CAPTURE_GROUP, CAPTURE_HEADER, CAPTURE_SLOT, StageVariable};
pub use fuel::{LoopFuel, MAX_TURNS};
pub(crate) use interface::place;
pub use interface::{LinkedInterface, Variable};
pub use module::{Shader, UniformBlock, UniformMember, unsupported};
pub use program::{HomeworkProgram, Linked, ProgramRefusal};
pub use spirv::{
    CommonTexture, DESCRIPTION, InputInterpolation, InterfaceQualifiers, LineTable, TEXTURES, descriptions,
};
pub use undefined::NO_LINE;

use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::ffi::glslang::{CompilerOutput, GlslangRequest, GlslangRules, Reached, StageText, compile};
use crate::language::Text;
use crate::source::{self, Source};
use concessions::Renamed;
use module::Built;
use std::ffi::CStr;

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
    let outputs = Some(vec![interface.output.name.clone()]);
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
    concessions::refuse_old_lookups(source)
}

/// How often a text is changed for what the compiler minds and drivers take; each refusal can hide the next.
const MAX_CONCESSIONS: usize = 4;

/// A stage that is handed in, on its way through the compiler.
struct Submitted<'a> {
    stage: Stage,
    source: &'a Source,
    interface: &'a LinkedInterface,
    /// The text that the compiler is given under OpenGL's rules.
    text: String,
    renamed: Vec<Renamed>,
    warnings: Vec<Diagnostic>,
}

impl<'a> Submitted<'a> {
    fn new(stage: Stage, source: &'a Source, interface: &'a LinkedInterface) -> Self {
        let (text, warning) = concessions::with_lookups_of_today(text::prepared(source), source);
        Self { stage, source, interface, text, renamed: Vec::new(), warnings: warning.into_iter().collect() }
    }

    /// A text of it as the compiler reads it.
    fn as_stage<'t>(&self, text: &'t CStr) -> StageText<'t> {
        StageText { version: self.source.implied_version(), ..StageText::plain(self.stage, text) }
    }

    /// Changes the text for what the compiler minds and drivers take; whether there was anything of the kind.
    fn concede(&mut self, verdict: &CompilerOutput) -> bool {
        let Some(granted) = concessions::grant(&self.text, verdict.log(self.stage), self.source) else { return false };
        self.text = granted.text;
        self.warnings.extend(granted.warnings);
        self.renamed.extend(granted.renamed);
        true
    }

    /// What the compiler says of it.
    fn logged(&self, verdict: &CompilerOutput) -> Vec<Diagnostic> {
        let Self { source, interface, .. } = *self;
        log::stage_diagnostics(verdict.log(self.stage), &source.text, source.implied_version(), interface)
    }

    /// What there is to say about a text that compiles and links.
    fn diagnostics(&self, verdict: &CompilerOutput) -> Result<Vec<Diagnostic>, TranslationRefusal> {
        let Self { source, interface, .. } = *self;
        let mut errors = hints::overlooked_errors(&source.text, interface);
        errors.extend(strict::errors(source, interface));
        if !errors.is_empty() {
            return Err(TranslationRefusal::Rejected(errors));
        }
        let mut diagnostics = self.logged(verdict);
        diagnostics.extend(self.warnings.iter().cloned());
        diagnostics.extend(portability::warnings(source, interface));
        Ok(diagnostics)
    }

    /// SPIR-V of a text that the first pass accepts.
    fn second_pass(&self) -> Result<Vec<u32>, Fault> {
        second_pass(self.stage, &self.text, &self.renamed, self.source.version())
    }
}

/// The compiler's verdict on the texts of all stages, with what it minds and drivers take changed in them; or the first
/// stage that does not compile, and why.
fn first_pass(
    submitted: &mut [Submitted<'_>],
    fixed: &[StageText<'_>],
) -> Result<CompilerOutput, (Stage, TranslationRefusal)> {
    let mut verdict = check(submitted, fixed);
    for _ in 0..MAX_CONCESSIONS {
        let Reached::Stage(at) = verdict.reached else { break };
        if !submitted.iter_mut().filter(|one| one.stage == at).any(|one| one.concede(&verdict)) {
            break;
        }
        verdict = check(submitted, fixed);
    }
    let Reached::Stage(at) = verdict.reached else { return Ok(verdict) };
    match concessions::unimplemented(verdict.log(at)) {
        Some(feature) => Err((at, unsupported(&format!("`{feature}`")).into())),
        None => Err((at, rejected(verdict, submitted, fixed))),
    }
}

/// Compiles and links under OpenGL's rules.
fn check(submitted: &[Submitted<'_>], fixed: &[StageText<'_>]) -> CompilerOutput {
    let texts: Vec<_> = submitted.iter().map(|one| text::c_text(&one.text)).collect();
    let mut outcome = compiled(submitted.iter().zip(&texts).map(|(one, text)| one.as_stage(text)), fixed);
    submitted.iter().for_each(|one| concessions::in_own_names(&mut outcome, &one.renamed));
    outcome
}

fn compiled<'a>(texts: impl Iterator<Item = StageText<'a>>, fixed: &[StageText<'a>]) -> CompilerOutput {
    let mut stages: Vec<_> = texts.chain(fixed.iter().copied()).collect();
    stages.sort_by_key(|text| text.stage == Stage::Fragment);
    compile(&GlslangRequest { stages: &stages, rules: GlslangRules::OpenGl, emit: Stage::Vertex })
}

/// The verdict without `#line`: with it the compiler counts as the student tells it to, and a person counts lines of the
/// file. None where no text has it.
fn plainly(submitted: &[Submitted<'_>], fixed: &[StageText<'_>]) -> Option<CompilerOutput> {
    let plain: Vec<_> = submitted.iter().map(|one| hints::without_line_directives(&one.text)).collect();
    plain.iter().any(Option::is_some).then(|| {
        let texts: Vec<_> = submitted
            .iter()
            .zip(&plain)
            .map(|(one, plain)| text::c_text(plain.as_ref().unwrap_or(&one.text)))
            .collect();
        let mut outcome = compiled(submitted.iter().zip(&texts).map(|(one, text)| one.as_stage(text)), fixed);
        submitted.iter().for_each(|one| concessions::in_own_names(&mut outcome, &one.renamed));
        outcome
    })
}

/// The refusal of texts of which one does not compile.
fn rejected(verdict: CompilerOutput, submitted: &[Submitted<'_>], fixed: &[StageText<'_>]) -> TranslationRefusal {
    let verdict = match plainly(submitted, fixed) {
        None => verdict,
        Some(plain) if plain.reached == verdict.reached => plain,
        Some(_) => return refused_line_directive(submitted),
    };
    let Reached::Stage(at) = verdict.reached else { return refused_line_directive(submitted) };
    match submitted.iter().find(|one| one.stage == at) {
        Some(one) => TranslationRefusal::Rejected(one.logged(&verdict)),
        None => TranslationRefusal::Fault(Fault::new(crate::language::Text::verbatim(format!(
            "the assignment's fixed {at:?} shader does not compile: {}",
            verdict.log(at)
        )))),
    }
}

fn refused_line_directive(submitted: &[Submitted<'_>]) -> TranslationRefusal {
    let with_line = submitted.iter().find(|one| hints::without_line_directives(&one.text).is_some());
    TranslationRefusal::Rejected(
        with_line.map(|one| vec![hints::refused_line_directive(&one.text)]).unwrap_or_default(),
    )
}

/// Refuses texts that compile and do not link.
fn linked(
    verdict: &CompilerOutput,
    submitted: &[Submitted<'_>],
    fixed: &[StageText<'_>],
) -> Result<(), TranslationRefusal> {
    if verdict.reached == Reached::Done {
        return Ok(());
    }
    let plain = plainly(submitted, fixed);
    if plain.as_ref().is_some_and(|plain| plain.reached != verdict.reached) {
        return Err(refused_line_directive(submitted));
    }
    let log = &plain.as_ref().unwrap_or(verdict).link_log;
    let last = submitted.last();
    Err(TranslationRefusal::Rejected(
        last.map(|one| log::link_diagnostics(log, &one.source.text, one.interface)).unwrap_or_default(),
    ))
}

/// SPIR-V of a text that the first pass accepts. That the stages fit together, the first pass has seen.
fn second_pass(stage: Stage, text: &str, renamed: &[Renamed], version: i32) -> Result<Vec<u32>, Fault> {
    let ready = text::for_spirv(text, version, stage);
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
    let spirv = second_pass(stage, text, &[], source.version())?;
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
    let output = Variable { name: "colour".into(), ty: "vec4".into() };
    let fragment = c"#version 410 core\nin vec4 colour; out vec4 fragment; void main() { fragment = colour; }";
    let interface = LinkedInterface {
        inputs: vec![],
        uniforms: vec![],
        output,
        constants: vec![],
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
