//! A handed-in program of which an array is read, as `assignment.toml` has it.

use crate::Text;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// An array of numbers in a program in C++.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "HostArray")]
pub struct HostArrayEntry {
    /// The name that it is handed out with.
    pub name: String,
    /// The name of the matrix that the program makes of it.
    pub used_by: String,
    /// How many numbers it has.
    #[serde(default = "of_a_matrix")]
    pub count: usize,
    /// The shader in which the numbers are tried, a file of the folder.
    pub shader: String,
    /// What the program has beside: the elements of each variable, as expressions of that shader.
    #[serde(default)]
    pub given: BTreeMap<String, Vec<String>>,
    /// What is said where a number stands in the place of a uniform.
    pub written_in: Option<Text>,
    /// What is said of code beside the numbers, which is not judged.
    #[serde(default)]
    pub notice: Vec<NoticeEntry>,
}

/// Something to say of code that stands there, or does not.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Notice")]
pub struct NoticeEntry {
    /// The code, blanks aside; one of these.
    pub code: Vec<String>,
    /// Whether it is said where none of it stands there.
    #[serde(default)]
    pub absent: bool,
    /// What is said.
    pub message: Text,
}

/// The numbers of a matrix of four rows.
fn of_a_matrix() -> usize {
    16
}
