//! The known mistakes of an assignment.

use super::{Checked, declare, definition_uses, known_line, named};
use crate::Text;
use crate::assignment::error;
use crate::equation::Equation;
use crate::expression::{Expression, Scope, Type};
use crate::manifest::{self, TermState};
use crate::mistake::{Alternative, Condition, Form, FreeParameter, Mistake, Override};
use std::collections::{BTreeMap, HashSet};

/// A mistake whose forms fit the equation.
pub(super) fn mistake(entry: manifest::Mistake, equation: &Equation, lines: &HashSet<String>) -> Checked<Mistake> {
    let place = format!("mistake `{}`", entry.id);
    title(&entry.title, &place)?;
    for (line, fraction) in &entry.keeps {
        known_line(lines, line, &place)?;
        if !(0.0..=1.0).contains(fraction) {
            return Err(error(place, format!("keeps {fraction} of `{line}`: not a fraction")));
        }
    }
    let mut scope = equation.scope.clone();
    let fit = match entry.fit {
        None => None,
        Some(f) => {
            declare(&mut scope, &f.name, Type::Float)?;
            if !(f.from > 0.0 && f.from < f.example && f.example < f.to && f.to.is_finite()) {
                return Err(error(place, "`fit` needs 0 < from < example < to"));
            }
            Some(FreeParameter { name: f.name, from: f.from, to: f.to, example: f.example, turns: f.turns })
        }
    };
    let forms = entry
        .forms
        .iter()
        .enumerate()
        .map(|(i, f)| form(f, equation, &scope, &format!("{place}, form {i}")))
        .collect::<Checked<Vec<_>>>()?;
    if fit.is_some() && !forms.iter().any(|f| f.free) {
        return Err(error(place, "no form uses the name in `fit`"));
    }
    Ok(Mistake {
        id: entry.id,
        title: entry.title,
        keeps: entry.keeps.into_iter().collect(),
        fit,
        needs: entry.needs,
        lacks: entry.lacks,
        handed_out: entry.handed_out,
        at_use: entry.at_use,
        instead: entry
            .instead
            .into_iter()
            .map(|other| alternative(other, forms.len(), &place))
            .collect::<Checked<_>>()?,
        forms,
        seen: entry.seen,
        equation: entry.equation,
        look: entry.look,
    })
}

/// Longest title in characters: a title shares its line in a table with a score.
const LONGEST_TITLE: usize = 60;

/// A title is one short line in each language.
fn title(title: &Text, place: &str) -> Checked<()> {
    for wording in [&title.en, &title.ja] {
        let length = wording.chars().count();
        if wording.trim().is_empty() || length > LONGEST_TITLE || wording.contains(['\n', '{', '⟨']) {
            return Err(error(place, format!("the title needs 1 to {LONGEST_TITLE} characters in each language")));
        }
    }
    Ok(())
}

fn alternative(entry: manifest::Alternative, forms: usize, place: &str) -> Checked<Alternative> {
    let manifest::When { forms: of_forms, lacks, term } = entry.when;
    if let Some(form) = of_forms.iter().find(|form| **form >= forms) {
        return Err(error(place, format!("`instead` speaks of form {form}, and there are {forms}")));
    }
    let mut when = Vec::new();
    if !of_forms.is_empty() {
        when.push(Condition::Forms(of_forms));
    }
    if !lacks.is_empty() {
        when.push(Condition::Lacks(lacks));
    }
    when.extend(term.map(|term| match term {
        TermState::Zero => Condition::Zero,
        TermState::Absent => Condition::Absent,
    }));
    if when.is_empty() {
        return Err(error(place, "`instead` has no condition"));
    }
    if entry.seen.is_none() && entry.equation.is_none() && entry.look.is_none() {
        return Err(error(place, "`instead` says nothing"));
    }
    Ok(Alternative { when, seen: entry.seen, equation: entry.equation, look: entry.look })
}

fn form(texts: &BTreeMap<String, String>, equation: &Equation, scope: &Scope, place: &str) -> Checked<Form> {
    let mut overrides = Vec::new();
    let mut free = false;
    for (name, text) in texts {
        let place = format!("{place}, `{name}`");
        let definition = named(equation, name, &place)?;
        let expression = Expression::parse(text, scope).map_err(|e| error(&place, e.to_string()))?;
        let wanted = equation.definitions[definition].kind();
        if expression.kind() != wanted {
            return Err(error(place, format!("is a {}, not a {}", expression.kind().glsl(), wanted.glsl())));
        }
        let parameter = equation.parameter_slot();
        let later = |slot: &&usize| **slot >= equation.slot(definition) && **slot != parameter;
        if let Some(slot) = expression.slots().iter().find(later) {
            let used = scope.get(*slot).map_or("", |(n, _)| n);
            return Err(error(place, format!("uses `{used}`, which is defined later")));
        }
        definition_uses(&expression, equation, &place)?;
        free |= expression.slots().contains(&parameter);
        overrides.push(Override { definition, expression });
    }
    if overrides.is_empty() {
        return Err(error(place, "replaces nothing"));
    }
    overrides.sort_by_key(|o| o.definition);
    Ok(Form { overrides, free })
}
