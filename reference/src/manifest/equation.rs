//! `[equation]`: what the lecture writes.

use crate::Text;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// A sum of terms, in LaTeX.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Equation")]
pub struct EquationEntry {
    /// Where it stands.
    pub source: Text,
    /// The symbol of the sum.
    #[schemars(with = "String")]
    pub total: Spanned<String>,
    /// How the sum is made of the summands, each as the id of its line in braces; they are added, where nothing is written.
    #[schemars(with = "Option<String>")]
    pub sum: Option<Spanned<String>>,
    /// The summands, in order.
    pub term: Vec<TermEntry>,
    /// What the terms need.
    #[serde(default, rename = "where")]
    pub given: Vec<SymbolMeaningEntry>,
}

/// A summand.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Term")]
pub struct TermEntry {
    /// The rubric line that judges it.
    pub line: String,
    /// Its symbol in the sum.
    #[schemars(with = "String")]
    pub symbol: Spanned<String>,
    /// What the symbol stands for.
    #[schemars(with = "String")]
    pub value: Spanned<String>,
}

/// What a symbol in the terms stands for.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SymbolMeaning")]
pub struct SymbolMeaningEntry {
    /// The symbol.
    #[schemars(with = "String")]
    pub symbol: Spanned<String>,
    /// What it stands for.
    #[schemars(with = "String")]
    pub value: Spanned<String>,
    /// Where that stands.
    pub source: Text,
}
