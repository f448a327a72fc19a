//! What a vertex stage reads, and the expressions that it hands over.

use super::meaning::{InputMeaning, KnownPoint};
use crate::interpreter::Type;
use crate::proposal::names::Space;
use crate::proposal::source::SolutionFile;
use crate::proposal::uniforms::ProposedUniform;

/// The names of what the vertex stage reads, none of which the solution uses for something else.
pub(super) struct Feeds<'a> {
    pub source: &'a SolutionFile,
    pub known: &'a [ProposedUniform],
    pub uniforms: Vec<(&'static str, &'static str, String)>,
    pub attributes: Vec<(&'static str, &'static str)>,
}

impl Feeds<'_> {
    /// A matrix: the solution's own, or one that is declared.
    pub fn matrix(&mut self, role: &'static str, kind: &'static str, name: &'static str) -> String {
        if let Some((_, _, known)) = self.uniforms.iter().find(|(known, ..)| *known == role) {
            return known.clone();
        }
        let said = format!("carries = {role:?}");
        let declared = self.source.program.uniforms();
        let own = self.known.iter().filter(|uniform| uniform.lines.first() == Some(&said));
        let is_kind = |name: &str| declared.iter().any(|one| one.name == name && one.kind.to_string() == kind);
        let is_kind = |name: &str| is_kind(name) && !is_member(self.source, name);
        let own = own.map(|uniform| uniform.name.clone()).find(|name| !name.contains(['.', '[']) && is_kind(name));
        let is_taken = |name: &str| self.source.words().iter().any(|word| word.text == name);
        let name = own.unwrap_or_else(|| if is_taken(name) { format!("mesh_{name}") } else { name.to_owned() });
        self.uniforms.push((role, kind, name.clone()));
        name
    }

    pub fn attribute(&mut self, carries: &'static str) -> &'static str {
        let (name, kind) = match carries {
            "position" => ("mesh_position", "vec3"),
            "normal" => ("mesh_normal", "vec3"),
            "tangent" => ("mesh_tangent", "vec4"),
            _ => ("mesh_uv", "vec2"),
        };
        if !self.attributes.iter().any(|(known, _)| *known == carries) {
            self.attributes.push((carries, kind));
        }
        name
    }

    fn in_space(&mut self, space: Space) -> String {
        let (position, model) = (self.attribute("position"), self.matrix("model", "mat4", "model"));
        match space {
            Space::World => format!("({model} * vec4({position}, 1.0))"),
            Space::Eye => {
                let view = self.matrix("view", "mat4", "view");
                format!("({view} * {model} * vec4({position}, 1.0))")
            }
        }
    }

    fn direction(&mut self, what: &str, space: Space) -> String {
        let (model, view) = (self.matrix("model", "mat4", "model"), self.matrix("view", "mat4", "view"));
        match space {
            Space::World => format!("mat3({model}) * {what}"),
            Space::Eye => format!("mat3({view} * {model}) * {what}"),
        }
    }

    fn normal(&mut self, space: Space) -> String {
        let normal = self.attribute("normal");
        let matrix = match space {
            Space::World => self.matrix("world-normal-matrix", "mat3", "worldNormalMatrix"),
            Space::Eye => self.matrix("normal-matrix", "mat3", "normalMatrix"),
        };
        format!("{matrix} * {normal}")
    }

    fn bitangent(&mut self, space: Space) -> String {
        let tangent = self.attribute("tangent");
        let (normal, along) = (self.normal(space), self.direction("mesh_tangent.xyz", space));
        format!("cross({normal}, {along}) * {tangent}.w")
    }

    /// A `vec3` or less, as text.
    pub fn value(&mut self, meaning: InputMeaning, kind: &Type) -> String {
        let count = kind.slots().unwrap_or(0);
        let of_three = |text: String, w: &str| match count {
            4 => format!("vec4({text}, {w})"),
            _ => text,
        };
        match meaning {
            InputMeaning::Position(space) => {
                let own = self.in_space(space);
                if count == 4 { own } else { format!("{own}.xyz") }
            }
            InputMeaning::Normal(space) => of_three(self.normal(space), "0.0"),
            InputMeaning::Tangent(space) => {
                self.attribute("tangent");
                of_three(self.direction("mesh_tangent.xyz", space), "mesh_tangent.w")
            }
            InputMeaning::Bitangent(space) => of_three(self.bitangent(space), "0.0"),
            InputMeaning::Frame(space) => {
                self.attribute("tangent");
                let (along, across) = (self.direction("mesh_tangent.xyz", space), self.bitangent(space));
                format!("mat3({along}, {across}, {})", self.normal(space))
            }
            InputMeaning::ToEye(Space::World) => {
                let (at, view) = (self.in_space(Space::World), self.matrix("view", "mat4", "view"));
                of_three(format!("inverse({view})[3].xyz - {at}.xyz"), "0.0")
            }
            InputMeaning::ToEye(Space::Eye) => of_three(format!("-{}.xyz", self.in_space(Space::Eye)), "0.0"),
            InputMeaning::ToLight => {
                of_three(format!("vec3(1.5, 2.0, 2.0) - {}.xyz", self.in_space(Space::World)), "0.0")
            }
            InputMeaning::KnownPoint(place, is_framed) => {
                let at = match place {
                    KnownPoint::Fragment => format!("{}.xyz", self.in_space(Space::World)),
                    KnownPoint::Eye => format!("inverse({})[3].xyz", self.matrix("view", "mat4", "view")),
                    KnownPoint::Light => "vec3(1.5, 2.0, 2.0)".to_owned(),
                };
                let frame = self.value(InputMeaning::Frame(Space::World), kind);
                of_three(if is_framed { format!("transpose({frame}) * ({at})") } else { at }, "1.0")
            }
            InputMeaning::Clip => {
                let (view, projection) = (self.in_space(Space::Eye), self.matrix("projection", "mat4", "projection"));
                let own = format!("{projection} * {view}");
                if count == 4 { own } else { format!("({own}).xyz") }
            }
            InputMeaning::Coordinates => {
                let uv = self.attribute("texture-coordinates");
                match count {
                    2 => uv.to_owned(),
                    3 => format!("vec3({uv}, 0.0)"),
                    _ => format!("vec4({uv}, 0.0, 1.0)"),
                }
            }
            InputMeaning::Colour => {
                let position = self.attribute("position");
                of_three(format!("0.5 + 0.4 * {position}"), "1.0")
            }
            InputMeaning::Depth => format!("-{}.z", self.in_space(Space::Eye)),
            InputMeaning::Height => format!("{}.y", self.in_space(Space::World)),
            InputMeaning::Nothing => format!("{kind}(1)"),
        }
    }
}

/// Whether a uniform is a member of a block without an instance name: no other stage may declare it alone.
fn is_member(source: &SolutionFile, name: &str) -> bool {
    let words = source.words();
    let declared = words.iter().position(|word| word.text == name).unwrap_or(0);
    let border = words[..declared].iter().rposition(|word| matches!(word.text.as_str(), "{" | "}"));
    border.is_some_and(|border| words[border].text == "{")
}

pub(super) fn attribute_name(carries: &str) -> &'static str {
    match carries {
        "position" => "mesh_position",
        "normal" => "mesh_normal",
        "tangent" => "mesh_tangent",
        _ => "mesh_uv",
    }
}
