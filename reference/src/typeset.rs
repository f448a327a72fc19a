//! The equation of a homework as the lecture writes it, typeset.

use crate::Text;

/// A sum of terms, each tied to a line of the rubric. Formulas are MathML without the outer `math` element; they are made
/// from LaTeX, so that no markup of a folder reaches a page.
#[derive(Clone, Debug)]
pub struct Typeset {
    /// Where it stands, such as `lecture 6, slide 31`.
    pub source: Text,
    /// The symbol of the sum.
    pub total: String,
    /// What the sum is made of, from left to right.
    pub sum: Vec<SumPart>,
    /// The summands, in order.
    pub terms: Vec<Term>,
    /// What the terms need.
    pub given: Vec<SymbolMeaning>,
}

/// A part of the sum.
#[derive(Clone, Debug, PartialEq)]
pub enum SumPart {
    /// What stands between summands.
    Formula(String),
    /// The symbol of a summand, by its place.
    Term(usize),
}

/// One summand.
#[derive(Clone, Debug)]
pub struct Term {
    /// Id of the rubric line that judges it.
    pub line: String,
    /// Its symbol in the sum.
    pub symbol: String,
    /// What the symbol stands for.
    pub value: String,
}

/// What a symbol in the terms stands for.
#[derive(Clone, Debug)]
pub struct SymbolMeaning {
    /// The symbol.
    pub symbol: String,
    /// What it stands for.
    pub value: String,
    /// Where that stands.
    pub source: Text,
}
