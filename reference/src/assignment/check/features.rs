//! The feature that each line of the rubric judges.

use super::CheckResult;
use super::solution::CheckedSolution;
use super::variants::Variants;
use crate::feature::Feature;
use crate::interpreter::Scalar;
use crate::manifest::Manifest;
use crate::mistake::{DefinitionOverride, MistakeForm};

/// For each line of the rubric the solution with 0 for the definition that it judges, where that is a part of what is seen.
pub(super) fn terms(m: &Manifest, solution: &mut CheckedSolution<'_>) -> CheckResult<Vec<Option<MistakeForm>>> {
    m.rubric.iter().map(|line| term(solution, &line.judges)).collect()
}

/// What the folder says with `without`; else the definition that the line judges. Where there are regions, they say more exactly
/// at which probes a definition can be judged.
pub(super) fn features(
    m: &Manifest,
    terms: &[Option<MistakeForm>],
    variants: &Variants<'_>,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Vec<Option<Feature>>> {
    let mut features = Vec::new();
    for (line, term) in m.rubric.iter().zip(terms) {
        let place = |at: usize| format!("{}, rubric `{}`", place_at(at), line.id);
        features.push(match &line.without {
            Some(without) => Some(Feature::Program(variants.program(without.get_ref(), &place(without.span().start))?)),
            None if m.region.is_empty() => term.clone().map(Feature::Term),
            None => None,
        });
    }
    Ok(features)
}

/// The equation with a definition that is 0; `None` where the definition is all that is seen, or no number.
fn term(solution: &mut CheckedSolution<'_>, name: &str) -> CheckResult<Option<MistakeForm>> {
    let definition = solution.definition(name, &String::new)?;
    let is_all = definition == solution.colour()? || solution.is_position(name);
    let kind = solution.kind(definition);
    if is_all || kind.scalar() != Some(Scalar::Float) {
        return Ok(None);
    }
    let text = format!("{kind}(0.0)");
    let (formula, _) = solution.replacement(definition, &text, None, &String::new)?;
    Ok(Some(MistakeForm { overrides: vec![DefinitionOverride { definition, text, formula }], free: false }))
}
