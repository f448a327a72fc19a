//! A handed-in text on its way to the interpreter.

use super::concessions::Renamed;
use super::glslang::Stage;
use super::{Interpreter, Submitted, hints, macros, second_pass, text};
use crate::source::Source;

/// The text of a stage that the compiler accepts, to be run step by step.
#[derive(Clone, Debug)]
pub struct Steps {
    stage: Stage,
    text: String,
    renamed: Vec<Renamed>,
}

impl Steps {
    pub(super) fn of(submitted: Submitted<'_>) -> Self {
        Self { stage: submitted.stage, text: submitted.text, renamed: submitted.renamed }
    }

    /// The shader. Its numeric constants are variables there, so that an expression of them is computed on the line on which it
    /// is written, and not before the shader runs.
    pub fn interpreter(&self, source: &Source) -> Option<Interpreter> {
        let version = text::version(source.code());
        // Lines are those of the file, whatever it says of them.
        let plain = hints::without_line_directives(&self.text);
        let text = plain.as_ref().unwrap_or(&self.text);
        let text = macros::on_their_lines(text, version).unwrap_or_else(|| text.clone());
        let variable = text::without_constants(&text);
        let compiled = |text: &str| second_pass(self.stage, text, &self.renamed, version).ok();
        let words = variable.as_deref().and_then(compiled).or_else(|| compiled(&text));
        Interpreter::new(&words?)
    }
}
