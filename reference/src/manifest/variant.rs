//! The solution, changed in one way: as a whole program, so that it does not matter how it is written.

use schemars::JsonSchema;
use serde::Deserialize;

/// What is changed in the solution: one of these, or macros and texts together.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Macros that are defined behind `#version`, in every file.
    #[serde(default)]
    pub define: Vec<String>,
    /// Texts that stand once in the solution, each with what stands in its place.
    #[serde(default)]
    pub replace: Vec<[String; 2]>,
    /// A file in place of a file of the solution.
    pub file: Option<String>,
    /// Which of the files that are handed in is meant, where there are several.
    pub of: Option<String>,
}
