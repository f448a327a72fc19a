//! What vertex attributes carry.

use super::{ProposedAttribute, numbers};
use crate::assignment::AssignmentError;
use crate::interpreter::{Scalar, Type};
use crate::proposal::FolderPlan;
use crate::proposal::guess::{Context, guess};
use crate::proposal::names::{self, NameWords};
use crate::proposal::shader_test::ShaderTest;
use std::collections::BTreeMap;

/// The attributes of a vertex solution.
pub(super) fn attributes(
    plan: &mut FolderPlan,
    at: usize,
    test: Option<&ShaderTest>,
) -> Result<Vec<ProposedAttribute>, AssignmentError> {
    let source = &plan.sources[at];
    let own = source.program.inputs().iter().filter(|input| !input.name.starts_with("gl_"));
    let own: Vec<(String, Type)> = own.map(|input| (input.name.clone(), input.kind.clone())).collect();
    let listed = |name: &str, kind: &Type| test.and_then(|test| test.attribute(name, kind));
    let mut carried: BTreeMap<&str, &str> = BTreeMap::new();
    for (name, kind) in &own {
        if let Some(said) = names::attribute(&NameWords::of(name), kind).filter(|_| listed(name, kind).is_none()) {
            carried.entry(said).or_insert(name);
        }
    }
    let mut attributes = Vec::new();
    for (name, kind) in &own {
        if let Some(values) = listed(name, kind) {
            attributes.push(ProposedAttribute { name: name.clone(), said: format!("values = {values}") });
            continue;
        }
        let known = names::attribute(&NameWords::of(name), kind);
        let said = known.map(str::to_owned).or_else(|| fallback(name, kind, &carried).map(str::to_owned));
        if known.is_none()
            && let Some(said) = &said
        {
            plan.guessed(
                format!("input `{name}`: its name says nothing, so it carries \"{said}\""),
                format!("input `{name}`: 名前から分からないので、\"{said}\" を渡します"),
            );
        } else if let Some(said) = &said {
            plan.read(format!("input `{name}`: carries \"{said}\""), format!("input `{name}`: \"{said}\" を渡します"));
        }
        let said = match said {
            Some(said) => {
                let name: &str = name;
                let key = ["position", "normal", "texture-coordinates", "tangent", "number"];
                key.iter().find(|key| **key == said).map(|key| carried.entry(key).or_insert(name));
                format!("carries = {said:?}")
            }
            None => {
                let values = in_turn(name, kind, super::longest_array(&plan.sources[at]));
                let count = values.len();
                plan.guessed(
                    format!("input `{name}`: one of {count} values for each vertex in turn"),
                    format!("input `{name}`: 頂点ごとに {count} つの値を順に渡します"),
                );
                let values = values.iter().map(|value| numbers(value, kind));
                format!("values = [{}]", values.collect::<Vec<_>>().join(", "))
            }
        };
        attributes.push(ProposedAttribute { name: name.clone(), said });
    }
    Ok(attributes)
}

/// Values that vertices have in turn: numbers of elements, shares, or colours.
fn in_turn(name: &str, kind: &Type, elements: Option<usize>) -> Vec<Vec<f64>> {
    let count = kind.slots().unwrap_or(0);
    let name = NameWords::of(name);
    match kind {
        Type::Vector(Scalar::Int | Scalar::Uint, _) => {
            let elements = elements.unwrap_or(4);
            let value = |nth: usize| (0..count).map(|place| ((nth + place) % elements) as f64).collect();
            (0..elements.min(4)).map(value).collect()
        }
        Type::Vector(Scalar::Float, 2..=4) if name.has(&["weight", "weights"]) => {
            const SHARES: [[f64; 4]; 3] = [[0.5, 0.3, 0.15, 0.05], [0.4, 0.1, 0.3, 0.2], [0.15, 0.45, 0.05, 0.35]];
            // The last one is what is left of the whole.
            let share = |shares: &[f64; 4], at: usize| match at + 1 == count {
                true => ((1.0 - shares[..at].iter().sum::<f64>()) * 100.0).round() / 100.0,
                false => shares[at],
            };
            SHARES.iter().map(|shares| (0..count).map(|at| share(shares, at)).collect()).collect()
        }
        // What is one number is a share of something; all alike would hide what is done with it.
        Type::Vector(Scalar::Float, 1) => [0.15, 0.5, 0.9].map(|share| vec![share]).into(),
        _ => (0..3)
            .map(|nth| guess(&NameWords::of("color"), kind, Context { nth, ..Context::default() }).value)
            .collect(),
    }
}

/// What an attribute carries whose name is not known: what is still missing, by its type.
fn fallback(name: &str, kind: &Type, carried: &BTreeMap<&str, &str>) -> Option<&'static str> {
    if NameWords::of(name).is_a_value() {
        return None;
    }
    let is_free = |said: &&str| !carried.contains_key(*said);
    let Type::Vector(Scalar::Float, count) = kind else { return None };
    match count {
        2 if carried.contains_key("position") => Some("texture-coordinates").filter(is_free),
        2..=4 => Some("position").filter(is_free),
        _ => None,
    }
}
