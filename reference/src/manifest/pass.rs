//! What is drawn into a texture, as `assignment.toml` has it.

use crate::scene::{Cull, DepthTest};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// A pass that is drawn into a texture before each picture.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Pass")]
pub struct PassEntry {
    /// The name of the texture that it draws.
    #[schemars(with = "String")]
    pub target: Spanned<String>,
    /// What it is drawn by.
    pub program: PassProgram,
    /// The names of what is drawn, of [[scene.draw]]; all where nothing is written.
    pub draws: Option<Vec<String>>,
    /// From world space to the pass's eye space: an expression.
    #[schemars(with = "String")]
    pub view: Spanned<String>,
    /// From there to its clip space: an expression.
    #[schemars(with = "String")]
    pub projection: Spanned<String>,
    /// Which depths are kept.
    pub depth_test: Option<DepthTest>,
    /// Which triangles are left out.
    #[serde(default)]
    pub cull: Cull,
    /// Factor and units of `glPolygonOffset`.
    #[serde(default)]
    pub polygon_offset: [f64; 2],
}

/// The program of a pass, whose stages are files of the folder.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PassProgram {
    /// Its vertex stage.
    pub vertex: String,
}
