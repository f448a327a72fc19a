//! `[[advice]]`: what is said of right answers that would break elsewhere.

use crate::Text;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Something to say of a right answer that would break elsewhere.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Advice")]
pub struct AdviceEntry {
    /// Its id in reports.
    pub id: String,
    /// Where it breaks.
    pub when: CircumstanceEntry,
    /// The definitions that are likely to be at fault, the likeliest first.
    pub about: Vec<String>,
    /// Whether it is said only if one of these is what breaks.
    #[serde(default)]
    pub only_about: bool,
    /// What would break, and where to look.
    pub message: Text,
}

/// What is different from a probe of the homework.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Circumstance")]
pub struct CircumstanceEntry {
    /// Vertex attribute → what its components are multiplied by.
    #[serde(default)]
    pub scaled: BTreeMap<String, [f64; 4]>,
    /// By how much the model is stretched along its axes.
    pub stretched: Option<[f64; 3]>,
    /// Constant → another value.
    #[serde(default)]
    pub constants: BTreeMap<String, Vec<f64>>,
}
