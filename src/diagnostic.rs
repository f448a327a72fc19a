//! What a stage has to say about a place in the student's file.

use crate::language::Text;
use serde::{Deserialize, Serialize};

/// How much a diagnostic weighs: an error refuses the file, a warning and a note do not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The file cannot be graded as it is.
    Error,
    /// The file is graded, but some real driver would refuse it.
    Warning,
    /// Something worth knowing.
    Note,
}

/// The stage that speaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = Stage))]
#[serde(rename_all = "lowercase")]
pub enum DiagnosticStage {
    /// Reading the bytes as text.
    Source,
    /// Compiling the shader.
    Compile,
    /// Linking it with the other stages.
    Link,
    /// Holding its inputs, uniforms and outputs against the assignment.
    Interface,
    /// Running it.
    Run,
}

/// A message about the student's file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Diagnostic {
    /// How much it weighs.
    pub severity: Severity,
    /// Who speaks.
    pub stage: DiagnosticStage,
    /// The file that it is about, where it is about one.
    #[serde(default)]
    pub file: Option<String>,
    /// Line in that file, from 1.
    pub line: Option<u32>,
    /// Column in that line, from 1, counted in characters (Unicode scalar values).
    pub column: Option<u32>,
    /// How many characters are marked from `column` on; 0 or 1 marks one place.
    pub length: u32,
    /// What is wrong.
    pub message: Text,
    /// What to look at next, where there is something useful to say.
    pub hint: Option<Text>,
}

impl Diagnostic {
    /// An error without a place.
    pub fn error(stage: DiagnosticStage, message: Text) -> Self {
        Self { severity: Severity::Error, stage, file: None, line: None, column: None, length: 1, message, hint: None }
    }

    /// A warning without a place.
    pub fn warning(stage: DiagnosticStage, message: Text) -> Self {
        Self { severity: Severity::Warning, ..Self::error(stage, message) }
    }

    /// The same at a line and column, both from 1.
    pub fn at(mut self, line: u32, column: Option<u32>) -> Self {
        self.line = Some(line);
        self.column = column;
        self
    }

    /// The same with `length` characters marked.
    pub fn spanning(mut self, length: usize) -> Self {
        self.length = u32::try_from(length).unwrap_or(1).max(1);
        self
    }

    /// The same with a hint.
    pub fn hint(mut self, hint: Text) -> Self {
        self.hint = Some(hint);
        self
    }
}
