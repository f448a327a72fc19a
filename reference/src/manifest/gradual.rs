//! What may come and go over any distance, as `assignment.toml` has it.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// The mistakes of an answer whose way between two places that are judged is not that of a right one.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Gradual")]
pub struct GradualEntry {
    /// That of an answer that shows what is right at the one place or at the other, and nothing between.
    #[schemars(with = "String")]
    pub abrupt: Spanned<String>,
    /// That of an answer that goes back on its way.
    #[schemars(with = "String")]
    pub uneven: Spanned<String>,
}
