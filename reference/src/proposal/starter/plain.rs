//! Values that say nothing, for what a starter has to write.

use crate::interpreter::outline::{self, FunctionText};
use crate::interpreter::{Scalar, Stage, Type};
use crate::proposal::names::{self, NameWords};
use crate::proposal::source::SolutionFile;

/// `name = value;`
pub(super) fn assigned(source: &SolutionFile, name: &str, kind: &Type) -> Option<String> {
    if name == "gl_Position" {
        return Some(format!("gl_Position = {};", plain_position(source)));
    }
    let path = path_in(source, name);
    plain(kind, true)
        .filter(|_| !name.starts_with("gl_") || name == "gl_FragColor")
        .map(|value| format!("{path} = {value};"))
}

/// An output as the file calls it: `Frame.uv` is `vs_out.uv` where the block has that name there.
pub(super) fn path_in(source: &SolutionFile, name: &str) -> String {
    let own = source.program.outputs().iter().find(|output| output.name == name);
    own.map_or(name, |output| &output.written).to_owned()
}

/// The position as the mesh has it.
fn plain_position(source: &SolutionFile) -> String {
    let own = source.program.inputs().iter();
    let found = own.filter(|_| source.stage == Stage::Vertex).find(|input| {
        let name = NameWords::of(&input.name);
        names::attribute(&name, &input.kind) == Some("position")
    });
    match found.map(|input| (&input.name, &input.kind)) {
        Some((name, Type::Vector(_, 4))) => name.clone(),
        Some((name, Type::Vector(_, 3))) => format!("vec4({name}, 1.0)"),
        Some((name, Type::Vector(_, 2))) => format!("vec4({name}, 0.0, 1.0)"),
        _ => "vec4(0.0, 0.0, 0.0, 1.0)".to_owned(),
    }
}

/// A value that says nothing: a grey colour where it is seen, else nothing.
pub(super) fn plain(kind: &Type, is_seen: bool) -> Option<String> {
    let number = if is_seen { "0.5" } else { "0.0" };
    Some(match kind {
        Type::Vector(Scalar::Float, 1) => number.to_owned(),
        Type::Vector(Scalar::Float, 4) if is_seen => "vec4(0.5, 0.5, 0.5, 1.0)".to_owned(),
        Type::Vector(Scalar::Float, _) => format!("{kind}({number})"),
        Type::Vector(Scalar::Bool, 1) => "false".to_owned(),
        Type::Vector(..) | Type::Matrix(..) => format!("{kind}(0)"),
        Type::Array(element, Some(length)) => {
            let one = plain(element, is_seen)?;
            format!("{kind}({})", vec![one; *length].join(", "))
        }
        Type::Struct(structure) => {
            let members: Option<Vec<String>> = structure.members.iter().map(|(_, kind)| plain(kind, is_seen)).collect();
            format!("{kind}({})", members?.join(", "))
        }
        _ => return None,
    })
}

/// The names of the `out` parameters of a function, each with the statement that gives it a plain value.
pub(super) fn written_parameters(function: &FunctionText) -> Vec<(String, String)> {
    let each = function.parameters.split(|word| word.text == ",");
    let written = each.filter(|words| words.iter().any(|word| word.text == "out" || word.text == "inout"));
    let value = |words: &[outline::Word]| {
        let kind = words.iter().find_map(|word| Type::named(&word.text))?;
        let name = words.last()?.text.clone();
        plain(&kind, true).map(|value| (name.clone(), format!("{name} = {value};")))
    };
    written.filter_map(value).collect()
}
