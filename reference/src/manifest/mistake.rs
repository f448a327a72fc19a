//! The known mistakes as they are written.

use super::Variant;
use crate::Text;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// A known mistake.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Mistake")]
pub struct MistakeEntry {
    /// Its id in reports.
    pub id: String,
    /// The mistake in a few words.
    pub title: Text,
    /// Fraction of the points that is kept, by rubric line.
    pub keeps: BTreeMap<String, f64>,
    /// The ways in which it is written: definition → expression.
    #[serde(default)]
    #[schemars(with = "Vec<BTreeMap<String, String>>")]
    pub forms: Vec<BTreeMap<String, Spanned<String>>>,
    /// The ways in which it is written, each as the solution, changed.
    #[serde(default)]
    pub variants: Vec<Variant>,
    /// The free parameter of its forms or variants.
    pub fit: Option<FitEntry>,
    /// Whether the handed-out file itself has the mistake.
    #[serde(default)]
    pub handed_out: bool,
    /// Whether something is left out where a right value is used.
    #[serde(default)]
    pub at_use: bool,
    /// Whether it is what a negative base of a power means.
    #[serde(default)]
    pub undefined_power: bool,
    /// Of these the text contains one, parentheses and swizzles aside, where a free parameter explains as much.
    #[serde(default)]
    pub needs: Vec<String>,
    /// Of these constants the statements use none, where a free parameter explains as much.
    #[serde(default)]
    pub lacks: Vec<String>,
    /// What is seen in the picture.
    pub seen: Text,
    /// Which equation of the lecture it breaks.
    pub equation: Text,
    /// Where to look.
    pub look: Text,
    /// Texts for files of which these would not be true.
    #[serde(default)]
    pub instead: Vec<AlternativeEntry>,
}

/// Texts in place of a mistake's own.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Alternative")]
pub struct AlternativeEntry {
    /// When they are said: where all of it holds.
    pub when: When,
    /// What is seen in the picture.
    pub seen: Option<Text>,
    /// Which equation of the lecture it breaks.
    pub equation: Option<Text>,
    /// Where to look.
    pub look: Option<Text>,
}

/// What must hold for an `Alternative`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct When {
    /// The mistake is found in one of these of its forms, from 0.
    #[serde(default)]
    pub forms: Vec<usize>,
    /// None of these words is in the statement that is named; in the file, where none is named.
    #[serde(default)]
    pub lacks: Vec<String>,
    /// How the student's file has the term.
    pub term: Option<TermState>,
}

/// How a file has a term that does not show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TermState {
    /// It is computed, and it is 0.
    Zero,
    /// Nothing stands for it.
    Absent,
}

/// A free parameter.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Fit")]
pub struct FitEntry {
    /// Its name.
    pub name: String,
    /// Least value.
    pub from: f64,
    /// Greatest value.
    pub to: f64,
    /// A likely value.
    pub example: f64,
    /// Whether the colour at a place may rise and fall again while it grows.
    #[serde(default)]
    pub turns: bool,
    /// The constant of the handed-out file that it stands for.
    pub of: Option<String>,
}
