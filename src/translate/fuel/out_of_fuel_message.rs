//! What is said where the fuel is used up.

use super::{LoopFuel, MAX_TURNS};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::ffi::glslang::Stage as GlslStage;
use crate::language::Text;

/// What a student is told whose loops ran out of fuel.
pub(in crate::translate) fn out_of_fuel(meters: &[LoopFuel], ran_out: u32, stage: GlslStage) -> Diagnostic {
    let (each, each_ja) = match stage {
        GlslStage::Vertex => ("vertex", "頂点"),
        GlslStage::Fragment => ("fragment", "フラグメント"),
    };
    let meter = meters.get((ran_out as usize).wrapping_sub(1)).copied();
    let line = meter.or(meters.first().copied()).and_then(|meter| meter.line);
    let turns = meter.map_or(MAX_TURNS, |meter| meter.turns);
    let message = match meter {
        Some(_) => Text::new(
            format!(
                "your loop ran more than {turns} times: it was stopped (the limit counts all loops of one {each} together)"
            ),
            format!(
                "ループの繰り返しが {turns} 回を超えたため、打ち切りました (上限は{each_ja} 1 個のすべてのループを合わせた回数です)"
            ),
        ),
        None => Text::new(
            format!("your loops ran more than {turns} times in all: they were stopped"),
            format!("ループの繰り返しが合わせて {turns} 回を超えたため、打ち切りました"),
        ),
    };
    let diagnostic = Diagnostic::error(DiagnosticStage::Run, message).hint(Text::new(
        "Does the loop's condition ever become false? Look at the variable that it tests.",
        "ループの条件はいつか偽になりますか。条件で調べている変数の変わり方を確かめてください。",
    ));
    match line {
        Some(line) => diagnostic.at(line, None),
        None => diagnostic,
    }
}
