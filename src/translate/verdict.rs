//! The first pass: what the compiler says of the texts of all stages, under OpenGL's rules.

use super::concessions::{self, Renamed};
use super::old_lookups::{self, Renewed};
use super::{LinkedInterface, TranslationRefusal, hints, log, portability, strict, text, unsupported};
use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::ffi::glslang::{CompilerOutput, GlslangRequest, GlslangRules, Reached, Stage, StageText, compile};
use crate::language::Text;
use crate::source::Source;
use std::ffi::{CStr, CString};

/// How often a text is changed for what the compiler minds and drivers take; each refusal can hide the next.
const MAX_CONCESSIONS: usize = 4;

/// A stage that is handed in, on its way through the compiler.
pub(super) struct Submitted<'a> {
    pub stage: Stage,
    pub source: &'a Source,
    pub interface: &'a LinkedInterface,
    /// The text that the compiler is given under OpenGL's rules.
    text: String,
    /// Macros that it needs before it.
    preamble: CString,
    renamed: Vec<Renamed>,
    warnings: Vec<Diagnostic>,
}

impl<'a> Submitted<'a> {
    pub fn new(stage: Stage, source: &'a Source, interface: &'a LinkedInterface) -> Self {
        let own = text::prepared(source);
        let Renewed { text, preamble, warning } = old_lookups::renewed(own.clone(), source);
        let warnings = warning.into_iter().collect();
        // By its own version the compiler knows them and not those of today.
        let (text, preamble) = match source.version() < old_lookups::FIRST_OF_TODAY {
            true => (own, CString::default()),
            false => (text, text::c_text(&preamble)),
        };
        Self { stage, source, interface, text, preamble, renamed: Vec::new(), warnings }
    }

    /// A text of it as the compiler reads it.
    fn as_stage<'t>(&'t self, text: &'t CStr) -> StageText<'t> {
        let Self { stage, ref preamble, .. } = *self;
        StageText { stage, text, preamble, version: self.source.implied_version() }
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
    pub fn diagnostics(&self, verdict: &CompilerOutput) -> Result<Vec<Diagnostic>, TranslationRefusal> {
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
    pub fn second_pass(&self) -> Result<Vec<u32>, Fault> {
        let Renewed { text, preamble, .. } = old_lookups::renewed(self.text.clone(), self.source);
        super::second_pass(self.stage, &text, &text::c_text(&preamble), &self.renamed, self.source.version())
    }
}

/// The compiler's verdict on the texts of all stages, with what it minds and drivers take changed in them; or the first
/// stage that does not compile, and why.
pub(super) fn first_pass(
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

/// The verdict on the texts as they stand.
fn check(submitted: &[Submitted<'_>], fixed: &[StageText<'_>]) -> CompilerOutput {
    let texts: Vec<_> = submitted.iter().map(|one| text::c_text(&one.text)).collect();
    check_texts(submitted, &texts, fixed)
}

/// The verdict on these texts of the stages that are handed in, in the student's names.
fn check_texts(submitted: &[Submitted<'_>], texts: &[CString], fixed: &[StageText<'_>]) -> CompilerOutput {
    let mut outcome = compiled(submitted.iter().zip(texts).map(|(one, text)| one.as_stage(text)), fixed);
    submitted.iter().for_each(|one| concessions::in_own_names(&mut outcome, &one.renamed));
    outcome
}

/// The stages in the order of the pipeline, compiled and linked under OpenGL's rules.
pub(super) fn compiled<'a>(texts: impl Iterator<Item = StageText<'a>>, fixed: &[StageText<'a>]) -> CompilerOutput {
    let mut stages: Vec<_> = texts.chain(fixed.iter().copied()).collect();
    stages.sort_by_key(|text| text.stage == Stage::Fragment);
    compile(&GlslangRequest { stages: &stages, rules: GlslangRules::OpenGl, emit: Stage::Vertex })
}

/// The verdict without `#line`: with it the compiler counts as the student tells it to, and a person counts lines of the
/// file. `None` where no text has it.
fn plainly(submitted: &[Submitted<'_>], fixed: &[StageText<'_>]) -> Option<CompilerOutput> {
    let plain: Vec<_> = submitted.iter().map(|one| hints::without_line_directives(&one.text)).collect();
    plain.iter().any(Option::is_some).then(|| {
        let c_text =
            |(one, plain): (&Submitted<'_>, &Option<String>)| text::c_text(plain.as_ref().unwrap_or(&one.text));
        let texts: Vec<_> = submitted.iter().zip(&plain).map(c_text).collect();
        check_texts(submitted, &texts, fixed)
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
        None => TranslationRefusal::Fault(Fault::new(Text::verbatim(format!(
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
pub(super) fn linked(
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
