//! Bounds on what is compiled and run, each named to the student with its line.
//!
//! Three looks at three stages, because each stage can be made to eat all time or memory by the one before it:
//! [`text`] before the compiler, [`storage`] on its SPIR-V, [`bounds`] on the module that the driver compiles.
//! Every bound stands far above what a shading homework needs; what is measured for it stands at the constant.

mod bounds;
mod cost;
mod expand;
mod nesting;
mod storage;
mod structures;
mod text;
mod weight;

pub(super) use bounds::check_module;
pub(super) use cost::{Costs, each_statement};
pub(super) use storage::check_words;
pub(super) use text::check_text;

use super::TranslationRefusal;
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;

/// The answer to a `switch` whose cases run into one another at length; the translator needs each by itself.
pub(super) fn too_many_cases(line: Option<u32>) -> TranslationRefusal {
    let message = Text::new(
        "the cases of this `switch` run into one another, and each written out with all that it runs into, they are too \
         long (limit of the grader)",
        "この `switch` では case が次の case に続いています。続く文をそれぞれの case に書き足すと長くなりすぎます \
         (採点システムの上限)",
    );
    stopped(DiagnosticStage::Compile, line, message)
}

/// The answer to a file that exceeds a bound.
fn stopped(stage: DiagnosticStage, line: Option<u32>, message: Text) -> TranslationRefusal {
    TranslationRefusal::Stopped(vec![placed(Diagnostic::error(stage, message), line)])
}

fn placed(diagnostic: Diagnostic, line: Option<u32>) -> Diagnostic {
    match line {
        Some(line) => diagnostic.at(line, None),
        None => diagnostic,
    }
}
