//! What vertex attributes carry.

use super::{AttributeEntry, numbers};
use crate::assignment::AssignmentError;
use crate::interpreter::{Scalar, Type};
use crate::proposal::FolderPlan;
use crate::proposal::guess::guess;
use crate::proposal::names::{self, NameWords};
use crate::proposal::shader_test::ShaderTest;
use std::collections::BTreeMap;

/// The attributes of a vertex solution.
pub(super) fn attributes(
    plan: &mut FolderPlan,
    at: usize,
    test: Option<&ShaderTest>,
) -> Result<Vec<AttributeEntry>, AssignmentError> {
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
            attributes.push(AttributeEntry { name: name.clone(), said: format!("values = {values}") });
            continue;
        }
        let known = names::attribute(&NameWords::of(name), kind);
        let said = known.map(str::to_owned).or_else(|| fallback(kind, &carried).map(str::to_owned));
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
                plan.guessed(
                    format!("input `{name}`: one of three values for each vertex in turn"),
                    format!("input `{name}`: 頂点ごとに 3 つの値を順に渡します"),
                );
                let values = (0..3).map(|nth| numbers(&guess(&NameWords::of("color"), kind, nth, false).value, kind));
                format!("values = [{}]", values.collect::<Vec<_>>().join(", "))
            }
        };
        attributes.push(AttributeEntry { name: name.clone(), said });
    }
    Ok(attributes)
}

/// What an attribute carries whose name is not known: what is still missing, by its type.
fn fallback(kind: &Type, carried: &BTreeMap<&str, &str>) -> Option<&'static str> {
    let is_free = |said: &&str| !carried.contains_key(*said);
    let Type::Vector(Scalar::Float, count) = kind else { return None };
    match count {
        2 if carried.contains_key("position") => Some("texture-coordinates").filter(is_free),
        2..=4 => Some("position").filter(is_free),
        _ => None,
    }
}
