//! What is said of the operators, and what they cost.

use crate::Text;
use crate::interpreter::Operator;
use serde::Deserialize;
use std::sync::LazyLock;

/// What is said of mistakes by an operator. `{quantity}` is what is computed, `{part}` what of it is concerned; with a capital
/// letter they begin a sentence.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OperatorText {
    /// The operator.
    pub of: Operator,
    /// What its mistakes are called, between the prefix and the definition's name.
    pub id: String,
    /// Fraction of a line's points that is kept.
    pub keeps: f64,
    /// Whether it is not looked for beside another mistake.
    #[serde(default)]
    pub rare: bool,
    /// The mistake in a few words.
    pub title: Text,
    /// What holds in the equation.
    pub equation: Text,
    /// What is found, and where to look.
    pub look: Text,
    /// What is said in place of that where the bound is 0.
    pub bounded: Option<OperatorTexts>,
    /// What is said in place of that of a program of which nothing is told apart.
    pub whole: Option<OperatorTexts>,
}

/// Two of the texts.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OperatorTexts {
    pub equation: Text,
    pub look: Text,
}

/// All of them, in the order of the file.
pub(crate) fn operators() -> &'static [OperatorText] {
    #[derive(Deserialize)]
    struct OperatorFile {
        operator: Vec<OperatorText>,
    }
    static ALL: LazyLock<Vec<OperatorText>> = LazyLock::new(|| {
        let read: Result<OperatorFile, _> = toml::from_str(include_str!("operators.toml"));
        // The tests of this crate read it as well.
        read.expect("operators.toml is broken").operator
    });
    &ALL
}

/// What is said of one.
pub(crate) fn operator_of(operator: Operator) -> &'static OperatorText {
    let known = operators().iter().find(|text| text.of == operator);
    known.expect("an operator without a text")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_operator_has_texts_and_a_name_of_its_own() {
        let ids: HashSet<&str> = Operator::ALL.iter().map(|operator| operator_of(*operator).id.as_str()).collect();
        assert_eq!(ids.len(), Operator::ALL.len());
        for said in operators() {
            assert!((0.0..1.0).contains(&said.keeps), "{}", said.id);
            for text in [&said.title, &said.equation, &said.look] {
                assert!(!text.en.is_empty() && !text.ja.is_empty(), "{}", said.id);
            }
        }
    }
}
