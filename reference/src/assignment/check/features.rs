//! The feature that each line of the rubric judges.

use super::Checked;
use super::solution::Solution;
use super::variants::Variants;
use crate::feature::Feature;
use crate::interpreter::Scalar;
use crate::manifest::Manifest;
use crate::mistake::{Form, Override};

/// What the folder says with `without`; else the definition that the line judges. Where there are regions, they say more exactly
/// at which probes a definition can be judged.
pub(super) fn features(
    m: &Manifest,
    solution: &mut Solution<'_>,
    variants: &Variants<'_>,
    place_at: &dyn Fn(usize) -> String,
) -> Checked<Vec<Option<Feature>>> {
    let mut features = Vec::new();
    for line in &m.rubric {
        let place = |at: usize| format!("{}, rubric line `{}`", place_at(at), line.id);
        features.push(match &line.without {
            Some(without) => Some(Feature::Program(variants.program(without.get_ref(), &place(without.span().start))?)),
            None if m.region.is_empty() => term(solution, &line.judges)?.map(Feature::Term),
            None => None,
        });
    }
    Ok(features)
}

/// The equation with a definition that is 0; none where the definition is all that is seen, or no number.
fn term(solution: &mut Solution<'_>, name: &str) -> Checked<Option<Form>> {
    let definition = solution.definition(name, &String::new)?;
    let is_all = definition == solution.colour()? || solution.is_position(name);
    let kind = solution.kind(definition);
    if is_all || kind.scalar() != Some(Scalar::Float) {
        return Ok(None);
    }
    let text = format!("{kind}(0.0)");
    let (formula, _) = solution.replacement(definition, &text, None, &String::new)?;
    Ok(Some(Form { overrides: vec![Override { definition, text, formula }], free: false }))
}
