//! The equation with the marks of its terms.

use super::super::mark::Mark;
use super::HtmlRubricLine;
use crate::language::Language;
use reference::typeset::{SumPart, SymbolMeaning, Typeset};

/// What is shown of an equation.
pub(super) struct EquationView<'a> {
    pub source: &'a str,
    pub total: &'a str,
    pub sum: &'a [SumPart],
    pub terms: Vec<EquationTerm<'a>>,
    pub definitions: Vec<(&'a str, &'a str, &'a str)>,
}

/// A term with the mark of its line.
pub(super) struct EquationTerm<'a> {
    pub symbol: &'a str,
    pub value: &'a str,
    pub mark: Mark,
    pub label: String,
    pub points: String,
}

impl<'a> EquationView<'a> {
    pub fn of(equation: &'a Typeset, rubric: &[HtmlRubricLine], language: Language) -> Self {
        let terms = equation.terms.iter().filter_map(|term| {
            let line = rubric.iter().find(|line| line.id == term.line)?;
            Some(EquationTerm {
                symbol: &term.symbol,
                value: &term.value,
                mark: line.mark,
                label: line.label.clone(),
                points: format!("{} / {}", line.points, line.max_points),
            })
        });
        let given = |given: &'a SymbolMeaning| (&*given.symbol, &*given.value, language.of(&given.source));
        Self {
            source: language.of(&equation.source),
            total: &equation.total,
            sum: &equation.sum,
            terms: terms.collect(),
            definitions: equation.given.iter().map(given).collect(),
        }
    }
}
