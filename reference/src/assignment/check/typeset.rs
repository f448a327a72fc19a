//! The equation as the lecture writes it.

use super::CheckResult;
use super::rubric::known_line;
use crate::Text;
use crate::assignment::error;
use crate::manifest;
use crate::text::both;
use crate::typeset::{SumPart, SymbolMeaning, Term, Typeset};
use math_core::{LatexToMathML, MathDisplay};
use std::collections::HashSet;
use toml::Spanned;

/// The equation, its formulas made from LaTeX.
pub(super) fn typeset(
    entry: manifest::EquationEntry,
    lines: &HashSet<String>,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Typeset> {
    let latex =
        LatexToMathML::new(Default::default()).map_err(|e| error("equation", Text::verbatim(format!("{e:?}"))))?;
    let formula = |text: &Spanned<String>| {
        let made = latex.convert_with_local_state(text.get_ref(), MathDisplay::Inline);
        let made = made.map_err(|refusal| {
            let place = place_at(text.span().start);
            let found = text.get_ref().get(refusal.0.clone()).unwrap_or_default();
            let why = refusal.error_message();
            let message =
                both(format!("`{found}` is not LaTeX: {why}"), format!("`{found}` は LaTeX として読めません ({why})"));
            error(format!("{place}, equation"), message)
        })?;
        let inside = made.mathml.strip_prefix("<math>").and_then(|rest| rest.strip_suffix("</math>"));
        Ok(inside.unwrap_or(&made.mathml).to_owned())
    };
    let term = |term: manifest::TermEntry| {
        known_line(lines, &term.line, "equation")?;
        Ok(Term { symbol: formula(&term.symbol)?, value: formula(&term.value)?, line: term.line })
    };
    let terms: Vec<Term> = entry.term.into_iter().map(term).collect::<CheckResult<_>>()?;
    let sum = match &entry.sum {
        Some(sum) => parts(sum, &terms, &formula)?,
        None => {
            let plus = (0..terms.len()).flat_map(|place| [SumPart::Formula("<mo>+</mo>".into()), SumPart::Term(place)]);
            plus.skip(1).collect()
        }
    };
    let given = |given: manifest::SymbolMeaningEntry| {
        Ok(SymbolMeaning { symbol: formula(&given.symbol)?, value: formula(&given.value)?, source: given.source })
    };
    Ok(Typeset {
        total: formula(&entry.total)?,
        sum,
        terms,
        given: entry.given.into_iter().map(given).collect::<CheckResult<_>>()?,
        source: entry.source,
    })
}

/// A sum as it is written, in which `{LINE}` is a summand.
fn parts(
    sum: &Spanned<String>,
    terms: &[Term],
    formula: &dyn Fn(&Spanned<String>) -> CheckResult<String>,
) -> CheckResult<Vec<SumPart>> {
    let (mut rest, mut start) = (sum.get_ref().as_str(), sum.span().start);
    let mut parts = Vec::new();
    loop {
        let found = terms.iter().enumerate().filter_map(|(place, term)| {
            let mark = format!("{{{}}}", term.line);
            Some((rest.find(&mark)?, mark.len(), place))
        });
        let Some((at, length, place)) = found.min() else { break };
        if !rest[..at].trim().is_empty() {
            parts.push(SumPart::Formula(formula(&Spanned::new(start..start + at, rest[..at].to_owned()))?));
        }
        parts.push(SumPart::Term(place));
        (rest, start) = (&rest[at + length..], start + at + length);
    }
    if !rest.trim().is_empty() {
        parts.push(SumPart::Formula(formula(&Spanned::new(start..start + rest.len(), rest.to_owned()))?));
    }
    Ok(parts)
}
