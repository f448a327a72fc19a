//! What is *our* failure: never a verdict on a student.

use crate::language::Text;
use serde::{Deserialize, Serialize};

/// Something of ours failed: a missing driver, a full disk, valid GLSL that we cannot take.
///
/// A fault ends a grading without a score (exit code 3, HTTP 5xx).
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Serialize, Deserialize)]
#[error("{}", .message.en)]
pub struct Fault {
    /// What failed.
    pub message: Text,
    /// What to do about it.
    pub remedy: Option<Text>,
}

impl Fault {
    /// A fault that needs no advice.
    pub fn new(message: Text) -> Self {
        Self { message, remedy: None }
    }

    /// The same with advice.
    pub fn remedy(mut self, remedy: Text) -> Self {
        self.remedy = Some(remedy);
        self
    }
}
