//! The look at the module: what it costs the driver to compile, and how much memory it asks for.

use super::cost::{CostWalk, Costs};
use super::stopped;
use super::weight::scalars;
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::ffi::glslang::Stage as GlslStage;
use crate::language::Text;
use crate::source::Source;
use crate::translate::interface::place;
use crate::translate::{LineTable, TranslationRefusal};
use naga::{AddressSpace, Module};

/// Most operations on scalars that are compiled, all calls inlined; see the weights below.
///
/// Answers to the homework have 100 to 600. The driver's time grows with the square: 0.1 s more at 3,000,
/// 0.7 s at this bound, 8 s at four times it.
pub(super) const MAX_OPERATIONS: u64 = 10_000;

/// Most scalars in variables and arrays of the shader's own, all calls inlined: 64 KiB.
///
/// Compiling their initial values takes 0.1 s at this bound.
pub(super) const MAX_SCALARS: u64 = 16_384;

/// Most bytes of uniforms. OpenGL drivers have at most this much for one stage.
pub(super) const MAX_UNIFORM_BYTES: u64 = 65_536;

/// Refuses a module that costs too much.
pub(in crate::translate) fn check_module(
    module: &Module,
    costs: &Costs,
    lines: &LineTable,
    source: &Source,
    stage: GlslStage,
) -> Result<(), TranslationRefusal> {
    let entry = &module.entry_points[0].function;
    if costs.of_entry <= MAX_OPERATIONS {
        return check_variables(module, costs, source, stage);
    }
    Err(stopped(
        DiagnosticStage::Compile,
        CostWalk { module, costs }.heaviest(entry, lines),
        Text::new(
            format!(
                "the shader has about {} operations when all calls and array accesses are written out, and at most \
                 {MAX_OPERATIONS} are compiled (limit of the grader); no other line has as many as this one",
                costs.of_entry
            ),
            format!(
                "関数呼び出しと配列の参照をすべて展開すると約 {} 個の演算になり、上限の {MAX_OPERATIONS} 個を超えます \
                 (採点システムの上限)。演算が最も多い行はここです",
                costs.of_entry
            ),
        ),
    ))
}

fn check_variables(
    module: &Module,
    costs: &Costs,
    source: &Source,
    stage: GlslStage,
) -> Result<(), TranslationRefusal> {
    let globals = || module.global_variables.iter().map(|(_, variable)| variable);
    let uniform: u64 = globals()
        .filter(|variable| variable.space == AddressSpace::Uniform)
        .map(|variable| scalars(module, &module.types[variable.ty].inner) * 4)
        .fold(0, u64::saturating_add);
    if uniform > MAX_UNIFORM_BYTES {
        return Err(too_many_uniforms(uniform));
    }
    let private: u64 = globals()
        .filter(|variable| variable.space == AddressSpace::Private)
        .map(|variable| scalars(module, &module.types[variable.ty].inner))
        .fold(0, u64::saturating_add);
    let all = private.saturating_add(costs.scalars_of_entry);
    if all <= MAX_SCALARS {
        return Ok(());
    }
    let locals = module.functions.iter().flat_map(|(_, function)| function.local_variables.iter());
    let variables = globals()
        .filter(|variable| variable.space == AddressSpace::Private)
        .map(|variable| (&variable.name, variable.ty))
        .chain(locals.map(|(_, variable)| (&variable.name, variable.ty)));
    let largest = variables.max_by_key(|(_, ty)| scalars(module, &module.types[*ty].inner));
    let name = largest.and_then(|(name, _)| name.as_deref()).unwrap_or_default();
    Err(too_much_memory(all.saturating_mul(4), name, source, stage))
}

pub(super) fn too_much_memory(bytes: u64, name: &str, source: &Source, stage: GlslStage) -> TranslationRefusal {
    let (each, each_ja) = match stage {
        GlslStage::Vertex => ("vertex", "頂点"),
        GlslStage::Fragment => ("fragment", "フラグメント"),
    };
    // The name of an input or output is followed by its number.
    let name = name.split('@').next().unwrap_or(name);
    let limit = MAX_SCALARS * 4;
    // The compiler makes variables of its own, whose names say nothing.
    let is_known = source.words().any(|(_, word)| word == name);
    let (en, ja) = if is_known {
        (format!(": `{name}` is the largest"), format!("。最も大きい変数は `{name}` です"))
    } else {
        Default::default()
    };
    let message = Text::new(
        format!(
            "the variables of the shader, with those of all calls, need {bytes} bytes, and a {each} has at most \
             {limit} (memory limit of the grader){en}"
        ),
        format!(
            "変数に、呼び出すすべての関数の分も合わせて {bytes} バイト必要ですが、{each_ja} 1 個あたり {limit} バイトまでです \
             (採点システムのメモリ上限){ja}"
        ),
    );
    TranslationRefusal::Stopped(vec![place(Diagnostic::error(DiagnosticStage::Compile, message), source, name)])
}

pub(super) fn too_many_uniforms(bytes: u64) -> TranslationRefusal {
    let message = Text::new(
        format!("the uniform variables need {bytes} bytes; OpenGL drivers have room for {MAX_UNIFORM_BYTES}"),
        format!(
            "uniform 変数に {bytes} バイト必要ですが、OpenGL のドライバで使えるのは {MAX_UNIFORM_BYTES} バイトまでです"
        ),
    );
    TranslationRefusal::Rejected(vec![Diagnostic::error(DiagnosticStage::Link, message)])
}
