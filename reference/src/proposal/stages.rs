//! The stage that is not handed in: a vertex stage that feeds a fragment solution's inputs, or a fragment stage that shows what
//! a vertex solution writes.

use super::Plan;
use super::names::{self, NameWords, Space};
use super::shader_test::ShaderTest;
use super::source::SolutionFile;
use super::uniforms::{AttributeEntry, UniformEntry, usual_space};
use crate::assignment::{AssignmentError, both};
use crate::interpreter::{Interpolation, Scalar, Stage, Type, Variable};

/// A stage that is not handed in.
pub(super) struct FixedFile {
    pub stage: Stage,
    pub text: String,
}

impl FixedFile {
    /// Its name in the folder.
    pub fn name(&self) -> String {
        match self.stage {
            Stage::Vertex => "fixed.vert".to_owned(),
            Stage::Fragment => "fixed.frag".to_owned(),
        }
    }
}

/// Writes the stage that is missing, and says what it is fed with.
pub(super) fn fix(plan: &mut Plan, test: Option<&ShaderTest>) -> Result<(), AssignmentError> {
    match &plan.sources[..] {
        [source] if source.stage == Stage::Fragment => vertex_of(plan, test),
        [source] => {
            let text = fragment_of(source);
            plan.fixed = Some(FixedFile { stage: Stage::Fragment, text });
            plan.guessed(
                "fixed.frag: written, shows the outputs of the vertex shader as a colour",
                "fixed.frag: 頂点シェーダの出力を色として表示するように書きました",
            );
            Ok(())
        }
        _ => Ok(()),
    }
}

/// What an input of a fragment solution is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meaning {
    Position(Space),
    Normal(Space),
    Tangent(Space),
    Bitangent(Space),
    Frame(Space),
    ToEye(Space),
    ToLight,
    /// A place, in the frame of tangent, bitangent and normal where that is so.
    KnownPoint(KnownPoint, bool),
    Clip,
    Coordinates,
    Colour,
    Depth,
    Height,
    Nothing,
}

/// A place that a vertex stage hands over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum KnownPoint {
    Fragment,
    Eye,
    Light,
}

/// What a name says of a place that is no plain position of the fragment.
fn place(name: &NameWords) -> Option<Meaning> {
    let is_framed = name.is_tangent();
    let place = match () {
        () if !name.is_position() => return None,
        () if name.has(&["light", "lamp"]) => KnownPoint::Light,
        () if name.is_eye() || (is_framed && name.has(&["view", "eye", "camera"])) => KnownPoint::Eye,
        () if is_framed => KnownPoint::Fragment,
        () => return None,
    };
    // What is seen from the eye is in its space.
    (is_framed
        || place == KnownPoint::Light
        || name.is(&["viewpos", "eyepos", "camerapos", "campos", "cameraposition"]))
    .then_some(Meaning::KnownPoint(place, is_framed))
}

fn meaning(input: &Variable, usual: Space) -> Meaning {
    let name = NameWords::of(&input.name);
    let space = names::space_of(&name, usual);
    let floats = match input.kind {
        Type::Vector(Scalar::Float, count) => count,
        Type::Matrix(Scalar::Float, 3, 3) => return Meaning::Frame(space),
        _ => return Meaning::Nothing,
    };
    if let Some(meaning) = place(&name).filter(|_| floats >= 3) {
        return meaning;
    }
    match floats {
        1 if name.has(&["depth", "distance", "dist", "fog", "range"]) || name.is(&["z", "viewz"]) => Meaning::Depth,
        1 if name.has(&["height", "elevation", "altitude"]) => Meaning::Height,
        1 => Meaning::Height,
        2 => Meaning::Coordinates,
        _ if name.has(&["clip", "clipspace", "ndc", "screen", "proj"]) => Meaning::Clip,
        _ if name.is_bitangent() => Meaning::Bitangent(space),
        _ if name.is_tangent() => Meaning::Tangent(space),
        _ if name.is_normal() => Meaning::Normal(space),
        _ if name.is_colour() => Meaning::Colour,
        _ if name.is_coordinates() => Meaning::Coordinates,
        _ if name.is(&["v", "viewdir", "viewdirection", "toeye", "tocamera", "eyedir", "view"]) => {
            Meaning::ToEye(usual)
        }
        _ if name.is(&["l", "lightdir", "lightdirection", "tolight", "lightvec"]) => Meaning::ToLight,
        _ if floats == 4 && !name.is_position() => Meaning::Colour,
        _ => Meaning::Position(space),
    }
}

/// The names of what the vertex stage reads, none of which the solution uses for something else.
struct Feeds<'a> {
    source: &'a SolutionFile,
    known: &'a [UniformEntry],
    uniforms: Vec<(&'static str, &'static str, String)>,
    attributes: Vec<(&'static str, &'static str)>,
}

impl Feeds<'_> {
    /// A matrix: the solution's own, or one that is declared.
    fn matrix(&mut self, role: &'static str, kind: &'static str, name: &'static str) -> String {
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

    fn attribute(&mut self, carries: &'static str) -> &'static str {
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
    fn value(&mut self, meaning: Meaning, kind: &Type) -> String {
        let count = kind.slots().unwrap_or(0);
        let of_three = |text: String, w: &str| match count {
            4 => format!("vec4({text}, {w})"),
            _ => text,
        };
        match meaning {
            Meaning::Position(space) => {
                let own = self.in_space(space);
                if count == 4 { own } else { format!("{own}.xyz") }
            }
            Meaning::Normal(space) => of_three(self.normal(space), "0.0"),
            Meaning::Tangent(space) => {
                self.attribute("tangent");
                of_three(self.direction("mesh_tangent.xyz", space), "mesh_tangent.w")
            }
            Meaning::Bitangent(space) => of_three(self.bitangent(space), "0.0"),
            Meaning::Frame(space) => {
                self.attribute("tangent");
                let (along, across) = (self.direction("mesh_tangent.xyz", space), self.bitangent(space));
                format!("mat3({along}, {across}, {})", self.normal(space))
            }
            Meaning::ToEye(Space::World) => {
                let (at, view) = (self.in_space(Space::World), self.matrix("view", "mat4", "view"));
                of_three(format!("inverse({view})[3].xyz - {at}.xyz"), "0.0")
            }
            Meaning::ToEye(Space::Eye) => of_three(format!("-{}.xyz", self.in_space(Space::Eye)), "0.0"),
            Meaning::ToLight => of_three(format!("vec3(1.5, 2.0, 2.0) - {}.xyz", self.in_space(Space::World)), "0.0"),
            Meaning::KnownPoint(place, is_framed) => {
                let at = match place {
                    KnownPoint::Fragment => format!("{}.xyz", self.in_space(Space::World)),
                    KnownPoint::Eye => format!("inverse({})[3].xyz", self.matrix("view", "mat4", "view")),
                    KnownPoint::Light => "vec3(1.5, 2.0, 2.0)".to_owned(),
                };
                let frame = self.value(Meaning::Frame(Space::World), kind);
                of_three(if is_framed { format!("transpose({frame}) * ({at})") } else { at }, "1.0")
            }
            Meaning::Clip => {
                let (view, projection) = (self.in_space(Space::Eye), self.matrix("projection", "mat4", "projection"));
                let own = format!("{projection} * {view}");
                if count == 4 { own } else { format!("({own}).xyz") }
            }
            Meaning::Coordinates => {
                let uv = self.attribute("texture-coordinates");
                match count {
                    2 => uv.to_owned(),
                    3 => format!("vec3({uv}, 0.0)"),
                    _ => format!("vec4({uv}, 0.0, 1.0)"),
                }
            }
            Meaning::Colour => {
                let position = self.attribute("position");
                of_three(format!("0.5 + 0.4 * {position}"), "1.0")
            }
            Meaning::Depth => format!("-{}.z", self.in_space(Space::Eye)),
            Meaning::Height => format!("{}.y", self.in_space(Space::World)),
            Meaning::Nothing => format!("{kind}(1)"),
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

/// Whether nothing of a fragment solution speaks of a scene: no inputs but texture coordinates, no camera, no sky.
fn is_of_window(plan: &Plan, source: &SolutionFile) -> bool {
    let inputs = source.program.inputs().iter().filter(|input| !input.name.starts_with("gl_"));
    let is_flat = |input: &Variable| matches!(input.kind, Type::Vector(Scalar::Float, 2));
    let carries = plan.uniforms.iter().any(|uniform| uniform.lines.iter().any(|line| line.starts_with("carries")));
    inputs.clone().all(is_flat) && !carries
}

fn vertex_of(plan: &mut Plan, test: Option<&ShaderTest>) -> Result<(), AssignmentError> {
    let source = &plan.sources[0];
    let usual = usual_space(&plan.sources);
    if let Some(test) = test.filter(|test| test.is_passthrough()) {
        let text = format!(
            "#version {}\nin vec4 piglit_vertex;\nvoid main() {{ gl_Position = piglit_vertex; }}\n",
            source.version
        );
        plan.fixed = Some(FixedFile { stage: Stage::Vertex, text });
        plan.attributes = test.passthrough();
        return Ok(());
    }
    let is_of_window = is_of_window(plan, source);
    let mut feeds = Feeds { source, known: &plan.uniforms, uniforms: Vec::new(), attributes: Vec::new() };
    let inputs: Vec<&Variable> =
        source.program.inputs().iter().filter(|input| !input.name.starts_with("gl_")).collect();
    let mut lines = Vec::new();
    let mut told = Vec::new();
    for input in &inputs {
        if input.kind.slots().is_none_or(|slots| slots > 9) || matches!(input.kind, Type::Array(..) | Type::Struct(_)) {
            let (name, kind) = (&input.name, &input.kind);
            let message = both(
                format!(
                    "nothing is known that feeds the input `{name}`, a {kind}: give the vertex shader as well, with `--from`"
                ),
                format!("入力 `{name}` ({kind}) に渡すものが分かりません。頂点シェーダも `--from` で指定してください"),
            );
            return Err(source.wrong(input.line, message));
        }
        let meaning = meaning(input, usual);
        let value = feeds.value(meaning, &input.kind);
        let written = path_of_output(&input.name);
        lines.push(format!("    {written} = {value};"));
        told.push((input.name.clone(), said(meaning)));
    }
    let position = feeds.attribute("position");
    let place = if is_of_window {
        format!("    gl_Position = vec4({position}, 1.0);")
    } else {
        let (model, view) = (feeds.matrix("model", "mat4", "model"), feeds.matrix("view", "mat4", "view"));
        let projection = feeds.matrix("projection", "mat4", "projection");
        format!("    gl_Position = {projection} * {view} * {model} * vec4({position}, 1.0);")
    };
    lines.push(place);
    let mut head = vec![format!("#version {}", source.version)];
    head.extend(feeds.attributes.iter().map(|(carries, kind)| format!("in {kind} {};", attribute_name(carries))));
    head.extend(feeds.uniforms.iter().map(|(_, kind, name)| format!("uniform {kind} {name};")));
    head.extend(declared(&inputs, "out", source.version_number()));
    let text = format!("{}\n\nvoid main()\n{{\n{}\n}}\n", head.join("\n"), lines.join("\n"));
    let attributes = feeds.attributes.iter().map(|(carries, _)| AttributeEntry {
        name: attribute_name(carries).to_owned(),
        said: format!("carries = {carries:?}"),
    });
    let attributes: Vec<_> = attributes.collect();
    let new = feeds.uniforms.iter().filter(|(_, _, name)| !plan.uniforms.iter().any(|known| known.name == *name));
    let new: Vec<UniformEntry> = new
        .map(|(role, _, name)| UniformEntry {
            name: name.clone(),
            lines: vec![format!("carries = {role:?}")],
            note: None,
            texture: None,
        })
        .collect();
    plan.attributes = attributes;
    plan.uniforms.splice(0..0, new);
    plan.fixed = Some(FixedFile { stage: Stage::Vertex, text });
    for (name, (en, ja)) in told {
        plan.guessed(
            format!("fixed.vert feeds `{name}` with {en}"),
            format!("fixed.vert は `{name}` に{ja}を渡します"),
        );
    }
    Ok(())
}

fn said(meaning: Meaning) -> (&'static str, &'static str) {
    use Space::{Eye, World};
    match meaning {
        Meaning::Position(World) => ("the position in world space", "ワールド座標の位置"),
        Meaning::Position(Eye) => ("the position in eye space", "視点座標の位置"),
        Meaning::Normal(World) => ("the normal in world space", "ワールド座標の法線"),
        Meaning::Normal(Eye) => ("the normal in eye space", "視点座標の法線"),
        Meaning::Tangent(_) => ("the tangent", "接ベクトル"),
        Meaning::Bitangent(_) => ("the bitangent", "従接ベクトル"),
        Meaning::Frame(_) => ("the frame of tangent, bitangent and normal", "接ベクトル・従接ベクトル・法線の行列"),
        Meaning::ToEye(_) => ("the vector to the eye", "視点へのベクトル"),
        Meaning::ToLight => ("the vector to a light", "光源へのベクトル"),
        Meaning::KnownPoint(KnownPoint::Fragment, _) => ("the position in the frame of the tangent", "接空間の位置"),
        Meaning::KnownPoint(KnownPoint::Eye, false) => ("the place of the eye", "視点の位置"),
        Meaning::KnownPoint(KnownPoint::Eye, true) => {
            ("the place of the eye in the frame of the tangent", "接空間の視点の位置")
        }
        Meaning::KnownPoint(KnownPoint::Light, false) => ("the place of a light", "光源の位置"),
        Meaning::KnownPoint(KnownPoint::Light, true) => {
            ("the place of a light in the frame of the tangent", "接空間の光源の位置")
        }
        Meaning::Clip => ("the position in clip space", "クリップ座標の位置"),
        Meaning::Coordinates => ("the texture coordinates", "テクスチャ座標"),
        Meaning::Colour => ("a colour from the position", "位置から作った色"),
        Meaning::Depth => ("the distance along the view", "視線方向の距離"),
        Meaning::Height => ("the height in world space", "ワールド座標の高さ"),
        Meaning::Nothing => ("1", "1"),
    }
}

fn attribute_name(carries: &str) -> &'static str {
    match carries {
        "position" => "mesh_position",
        "normal" => "mesh_normal",
        "tangent" => "mesh_tangent",
        _ => "mesh_uv",
    }
}

/// An input or output as the program without a block's instance name has it: `VS_OUT.FragPos` is `vs_OUT.FragPos` there.
fn path_of_output(name: &str) -> String {
    match name.split_once('.') {
        Some((block, member)) => format!("{}.{member}", instance(block)),
        None => name.to_owned(),
    }
}

fn instance(block: &str) -> String {
    format!("{}_", block.to_lowercase())
}

/// Declarations of variables between the stages, members of blocks together.
fn declared(variables: &[&Variable], storage: &str, version: u32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
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
    for (block, members) in blocks {
        lines.push(format!("{storage} {block} {{\n{}\n}} {};", members.join("\n"), instance(block)));
    }
    lines
}

/// A fragment stage that shows all that a vertex solution writes.
fn fragment_of(source: &SolutionFile) -> String {
    let own = source.program.outputs().iter().filter(|output| !output.name.starts_with("gl_"));
    let own: Vec<&Variable> = own.collect();
    let name = |output: &Variable| path_of_output(&output.name);
    let colour = match &own[..] {
        [] => "vec4(0.9, 0.6, 0.3, 1.0)".to_owned(),
        [one] if one.kind == Type::VEC4 => name(one),
        many => {
            let shown: Vec<String> = many.iter().filter_map(|output| shown(&name(output), output)).collect();
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

/// An output as a `vec3` of colours.
fn shown(path: &str, output: &Variable) -> Option<String> {
    let name = NameWords::of(&output.name);
    let kind = &output.kind;
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
