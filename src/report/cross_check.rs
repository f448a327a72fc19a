//! The second opinion of the interpreter, as a report has it. [`crate::cross_check`] forms it.

use crate::language::Text;
use serde::{Deserialize, Serialize};

/// How the two opinions relate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Opinion {
    /// All defined values agree.
    Agrees,
    /// Some defined values differ: one of the two is wrong.
    Differs,
    /// The interpreter does not know something that the file uses, or used up its steps.
    NotRun,
}

/// The second opinion on one file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrossCheck {
    /// How the two relate.
    pub opinion: Opinion,
    /// How many vertices agree.
    pub agreeing: u32,
    /// How many vertices have a value that GLSL leaves undefined, all others agreeing.
    pub undefined: u32,
    /// How many have a value that depends on how the driver rounds, all others agreeing.
    pub unsettled: u32,
    /// How many differ.
    pub differing: u32,
    /// The first difference, or why nothing was run.
    pub message: Option<Text>,
    /// The line of the student's file that the message is about, from 1.
    pub line: Option<u32>,
}

impl CrossCheck {
    /// Nothing was run, for this reason.
    pub fn not_run(why: impl Into<Text>, line: Option<u32>) -> Self {
        let Text { en, ja } = why.into();
        let message = Text::new(
            format!("the interpreter did not run this file: {en}"),
            format!("インタープリターでは実行できませんでした: {ja}"),
        );
        Self {
            opinion: Opinion::NotRun,
            agreeing: 0,
            undefined: 0,
            unsettled: 0,
            differing: 0,
            message: Some(message),
            line: line.filter(|&line| line > 0),
        }
    }
}
