//! Declarations of what stands between two stages, and a fragment stage that shows it.

use crate::interpreter::{Interpolation, ProgramVariable, Scalar, Type};
use crate::proposal::names::NameWords;
use crate::proposal::source::SolutionFile;

/// An input or output as the program without a block's instance name has it: `VS_OUT.FragPos` is `vs_OUT.FragPos` there.
pub(super) fn path_of_output(name: &str) -> String {
    match name.split_once('.') {
        Some((block, member)) => format!("{}.{member}", instance(block)),
        None => name.to_owned(),
    }
}

/// What a block is called, and one of several with its number: `VS_OUT[1]` is `vs_out_[1]`.
fn instance(block: &str) -> String {
    let (name, number) = block.split_at(block.find('[').unwrap_or(block.len()));
    format!("{}_{number}", name.to_lowercase())
}

/// Declarations of the structures of a type that are not there yet, inner ones first.
fn structures(kind: &Type, lines: &mut Vec<String>) {
    match kind {
        Type::Array(element, _) => structures(element, lines),
        Type::Struct(own) => {
            own.members.iter().for_each(|(_, member)| structures(member, lines));
            let members: Vec<String> = own.members.iter().map(|(name, kind)| format!("    {kind} {name};")).collect();
            let line = format!("struct {} {{\n{}\n}};", own.name, members.join("\n"));
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
        _ => {}
    }
}

/// Declarations of variables between the stages, members of blocks together.
pub(super) fn declared(variables: &[&ProgramVariable], storage: &str, version: u32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    variables.iter().for_each(|variable| structures(&variable.kind, &mut lines));
    let mut blocks: Vec<(&str, Vec<String>)> = Vec::new();
    for variable in variables {
        let interpolation = match variable.interpolation {
            Interpolation::Flat => "flat ",
            Interpolation::NoPerspective => "noperspective ",
            Interpolation::Smooth => "",
        };
        let kind = &variable.kind;
        if let Some((block, member)) = variable.name.split_once('.') {
            let line = format!("    {interpolation}{kind} {member};");
            match blocks.iter_mut().find(|(known, _)| *known == block) {
                Some((_, members)) => members.push(line),
                None => blocks.push((block, vec![line])),
            }
            continue;
        }
        let location = variable.location.filter(|_| version >= 410);
        let location = location.map(|number| format!("layout(location = {number}) ")).unwrap_or_default();
        lines.push(format!("{location}{interpolation}{storage} {kind} {};", variable.name));
    }
    for (block, members) in &blocks {
        // Several of one array are declared together, by the first.
        let name = block.strip_suffix("[0]").unwrap_or(block);
        if name.ends_with(']') {
            continue;
        }
        let count = blocks.iter().filter(|(other, _)| other.split('[').next() == Some(name)).count();
        let several = if name == *block { String::new() } else { format!("[{count}]") };
        lines.push(format!("{storage} {name} {{\n{}\n}} {}{several};", members.join("\n"), instance(name)));
    }
    lines
}

/// A fragment stage that shows all that a vertex solution writes.
pub(super) fn fragment_of(source: &SolutionFile) -> String {
    let own = source.program.outputs().iter().filter(|output| !output.name.starts_with("gl_"));
    let own: Vec<&ProgramVariable> = own.collect();
    let name = |output: &ProgramVariable| path_of_output(&output.name);
    let colour = match &own[..] {
        [] => "vec4(0.9, 0.6, 0.3, 1.0)".to_owned(),
        [one] if one.kind == Type::VEC4 => name(one),
        many => {
            let shown: Vec<String> =
                many.iter().filter_map(|output| shown(&name(output), &output.name, &output.kind)).collect();
            match &shown[..] {
                [] => "vec4(0.9, 0.6, 0.3, 1.0)".to_owned(),
                [one] => format!("vec4({one}, 1.0)"),
                many => format!("vec4(({}) / {}.0, 1.0)", many.join(" + "), many.len()),
            }
        }
    };
    let output = if own.iter().any(|output| output.name == "colour") { "shown" } else { "colour" };
    let mut head = vec![format!("#version {}", source.version)];
    head.extend(declared(&own, "in", source.version_number()));
    head.push(format!("out vec4 {output};"));
    format!("{}\n\nvoid main()\n{{\n    {output} = {colour};\n}}\n", head.join("\n"))
}

/// An output as a `vec3` of colours; a structure by its members.
fn shown(path: &str, name: &str, kind: &Type) -> Option<String> {
    if let Type::Struct(structure) = kind {
        let members = structure.members.iter();
        let all: Vec<String> =
            members.filter_map(|(name, kind)| shown(&format!("{path}.{name}"), name, kind)).collect();
        return (!all.is_empty()).then(|| format!("({}) / {}.0", all.join(" + "), all.len()));
    }
    let name = NameWords::of(name);
    let three = match kind {
        Type::Vector(Scalar::Float, 1) => format!("vec3({path})"),
        Type::Vector(Scalar::Float, 2) => format!("vec3({path}, 0.5)"),
        Type::Vector(Scalar::Float, 3) => path.to_owned(),
        Type::Vector(Scalar::Float, 4) => format!("{path}.rgb"),
        Type::Vector(_, 1) => format!("vec3(0.1 * float({path}))"),
        Type::Matrix(Scalar::Float, 3 | 4, 3) => format!("({path}[0] + 0.5 * {path}[1] + 0.25 * {path}[2])"),
        _ => return None,
    };
    Some(match () {
        () if name.is_colour() || name.is_coordinates() => three,
        () if name.is_normal() || name.is_tangent() || name.is_bitangent() => format!("(0.5 + 0.4 * {three})"),
        () if name.is_position() => format!("(0.5 + 0.1 * {three})"),
        () => three,
    })
}
