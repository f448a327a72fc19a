//! What the program is given: every uniform and attribute has a type, by the shaders, and values that fit it.

mod samplers;
mod uniforms;
mod values;

use super::CheckResult;
use super::solution::{self, CheckedSolution};
use super::stages::{Compiled, Stages};
use crate::Text;
use crate::assignment::{AssignmentError, Input, Interface, MANIFEST, error};
use crate::feed::Stream;
use crate::free::Free;
use crate::interpreter::{Stage, Texture, Type};
use crate::manifest::{self, Manifest};
use crate::text::both;
use samplers::FolderSamplers;

/// More uniforms, each part counted, than this are refused.
const MOST_UNIFORMS: usize = 4_096;

/// The interface. `place_at`: where a byte of the manifest stands.
pub(super) fn interface(
    m: &Manifest,
    textures: &[Texture],
    stages: &Stages,
    solution: &CheckedSolution<'_>,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Interface> {
    let samplers = FolderSamplers { entries: &m.texture, textures, place_at };
    let reader = InterfaceReader { programs: &stages.0, samplers, place_at };
    let mut uniforms = Vec::new();
    for entry in &m.uniform {
        reader.uniforms(entry, &mut uniforms)?;
    }
    if uniforms.len() > MOST_UNIFORMS {
        return Err(error(
            "uniform",
            both(
                format!("there are {} with all parts: use at most {MOST_UNIFORMS}", uniforms.len()),
                format!("部分を含めて {} 個あります。{MOST_UNIFORMS} 個以下にしてください", uniforms.len()),
            ),
        ));
    }
    reader.samplers.are_all_fed(&stages.0, &uniforms)?;
    let inputs = m.input.iter().map(|entry| reader.input(entry)).collect::<CheckResult<Vec<_>>>()?;
    for (index, input) in inputs.iter().enumerate() {
        if inputs[..index].iter().any(|other| other.name == input.name) {
            return Err(error(
                format!("input `{}`", input.name),
                both("stands twice: keep one", "2 回書かれています。一方を取り除いてください"),
            ));
        }
    }
    for Compiled { name, stage, program } in &stages.0 {
        let attributes = program.inputs().iter().filter(|_| *stage == Stage::Vertex);
        let own = attributes.filter(|input| !input.name.starts_with("gl_"));
        let known = |name: &str| {
            inputs.iter().any(|input| input.name == name) || uniforms.iter().any(|uniform| uniform.path == name)
        };
        if let Some(variable) = own.chain(program.uniforms()).find(|variable| !known(&variable.name)) {
            let variable_name = &variable.name;
            let table =
                if *stage == Stage::Vertex && program.inputs().contains(variable) { "input" } else { "uniform" };
            let said = crate::proposal::entry_for(variable_name, &variable.kind, table == "input");
            let entry = format!("[[{table}]]\nname = \"{variable_name}\"\n{said}");
            let message = both(
                format!(
                    "`{variable_name}` is neither [[input]] nor [[uniform]] in {MANIFEST}: remove it here, or write there, with a value \
                     of yours:\n{entry}"
                ),
                format!(
                    "`{variable_name}` は {MANIFEST} の [[input]] にも [[uniform]] にもありません。ここから取り除くか、次のように書いて値を\
                     決めてください:\n{entry}"
                ),
            );
            return Err(error(solution::place(name, variable.line), message));
        }
    }
    Ok(Interface { inputs, uniforms, outputs: solution.outputs() })
}

/// What uniforms may be that students add.
pub(super) fn free(
    m: &Manifest,
    textures: &[Texture],
    stages: &Stages,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Vec<Free>> {
    let samplers = FolderSamplers { entries: &m.texture, textures, place_at };
    let reader = InterfaceReader { programs: &stages.0, samplers, place_at };
    let mut all: Vec<Free> = Vec::new();
    for entry in &m.free {
        let (id, at) = (entry.id.get_ref().clone(), entry.id.span().start);
        let place = format!("free `{id}`");
        if all.iter().any(|known| known.id == id) {
            let message = both("stands twice: give one another name", "2 回書かれています。一方の名前を変えてください");
            return Err(reader.wrong(at, &place, message));
        }
        let kind = reader.named(&entry.kind, at, &place)?;
        let uniform = manifest::UniformEntry {
            name: entry.id.clone(),
            kind: None,
            carries: entry.carries,
            value: None,
            is: entry.is.clone(),
            texture: entry.texture.clone(),
            probe: None,
        };
        let feed = reader.feed(&uniform, "", &id, &kind, &place)?;
        all.push(Free { id, kind, feed, note: entry.note.clone() });
    }
    Ok(all)
}

struct InterfaceReader<'a> {
    programs: &'a [Compiled],
    samplers: FolderSamplers<'a>,
    place_at: &'a dyn Fn(usize) -> String,
}

/// A `type` that the shader contradicts.
fn declared_as(kind: &Type) -> Text {
    both(
        format!("the shader declares it as {kind}: write that, or leave `type` out"),
        format!("シェーダでは {kind} と宣言されています。その型を書くか、`type` を取り除いてください"),
    )
}

impl InterfaceReader<'_> {
    fn wrong(&self, at: usize, place: &str, message: Text) -> AssignmentError {
        error(format!("{}, {place}", (self.place_at)(at)), message)
    }

    fn named(&self, text: &str, at: usize, place: &str) -> CheckResult<Type> {
        Type::named(text).filter(|kind| *kind != Type::Void).ok_or_else(|| {
            let message = both(
                format!("`{text}` is not a type: write one of GLSL's, such as vec3, mat4 or int"),
                format!("`{text}` は型ではありません。vec3、mat4、int など GLSL の型を書いてください"),
            );
            self.wrong(at, place, message)
        })
    }

    fn input(&self, entry: &manifest::InputEntry) -> CheckResult<Input> {
        let (name, at) = (entry.name.get_ref(), entry.name.span().start);
        let place = format!("input `{name}`");
        let vertex = self.programs.iter().find(|program| program.stage == Stage::Vertex);
        let declared = vertex.and_then(|vertex| vertex.program.inputs().iter().find(|input| input.name == *name));
        let kind = match (declared, &entry.kind) {
            (Some(declared), None) => declared.kind.clone(),
            (declared, Some(said)) => {
                let kind = self.named(said, at, &place)?;
                if let Some(declared) = declared.filter(|declared| declared.kind != kind) {
                    return Err(self.wrong(at, &place, declared_as(&declared.kind)));
                }
                kind
            }
            (None, None) => {
                let (en, ja) =
                    vertex.map_or(("the vertex stage", "頂点シェーダ"), |vertex| (&vertex.name, &vertex.name));
                let message = both(
                    format!(
                        "there is no such input in {en}: declare `in type {name};` there, or write `type = …` here"
                    ),
                    format!(
                        "{ja} にこの入力はありません。そこで `in 型 {name};` と宣言するか、ここに `type = …` を書いてください"
                    ),
                );
                return Err(self.wrong(at, &place, message));
            }
        };
        let stream = match (entry.carries, &entry.values) {
            (Some(attribute), None) => Stream::Mesh(attribute),
            (None, Some(listed)) => {
                let values = listed.iter().map(|value| values::value(value, &kind)).collect::<Result<Vec<_>, _>>();
                let message = |what: Text| {
                    let Text { en, ja } = what;
                    both(format!("`values`, each a {kind}: {en}"), format!("`values` (それぞれ {kind}): {ja}"))
                };
                Stream::Listed(values.map_err(|what| self.wrong(at, &place, message(what)))?)
            }
            _ => {
                let message = both(
                    "write where its values come from: `carries` or `values`",
                    "値の与え方を `carries` か `values` のどちらかで書いてください",
                );
                return Err(self.wrong(at, &place, message));
            }
        };
        if !stream.fits(&kind) {
            let message = both(
                format!("a {kind} cannot hold that: declare a float, vec2, vec3 or vec4"),
                format!("{kind} には入りません。float、vec2、vec3、vec4 のいずれかで宣言してください"),
            );
            return Err(self.wrong(at, &place, message));
        }
        let location = declared.and_then(|declared| declared.location);
        Ok(Input { name: name.clone(), kind, stream, location })
    }
}
