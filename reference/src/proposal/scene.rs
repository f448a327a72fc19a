//! What is drawn, by what the solution needs to be seen.

use super::FolderPlan;
use super::names::NameWords;
use super::shader_test::ShaderTest;
use crate::interpreter::{Dimension, Stage, Type};

/// The table `[scene]`: each line with what there is to say of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Proposed {
    /// `key = value`, with a comment where there is something to change.
    pub lines: Vec<String>,
    /// What is seen, in both languages, as a part of a sentence.
    pub seen: (&'static str, &'static str),
}

/// A mesh: what is written, and what is seen.
struct SceneKind {
    mesh: &'static str,
    more: &'static [&'static str],
    eye: &'static str,
    seen: (&'static str, &'static str),
}

const TORUS: SceneKind = SceneKind {
    mesh: "{ torus = { radius = 1, tube = 0.45, segments = [48, 24] } }",
    more: &["turn = 6.2831853 # about y in a cycle", "cull = \"back\""],
    eye: "[0, 1.8, 3.2]",
    seen: ("A ring that turns", "回転する輪"),
};
const SPHERE: SceneKind = SceneKind {
    mesh: "{ sphere = { radius = 1.2, segments = [48, 24] } }",
    more: &["turn = 6.2831853 # about y in a cycle", "cull = \"back\""],
    eye: "[0, 1.0, 3.2]",
    seen: ("A ball that turns", "回転する球"),
};
const CUBE: SceneKind = SceneKind {
    mesh: "{ cube = { size = [1.6, 1.6, 1.6] } }",
    more: &["turn = 6.2831853 # about y in a cycle", "cull = \"back\""],
    eye: "[0, 1.6, 3.0]",
    seen: ("A box that turns", "回転する箱"),
};
const GRID: SceneKind = SceneKind {
    mesh: "{ grid = { size = [3, 3], segments = [48, 48] } }",
    more: &["turn = 0.8 # about y in a cycle"],
    eye: "[0, 1.6, 3.2]",
    seen: ("A sheet of many squares", "細かい格子の面"),
};
const ROW: SceneKind = SceneKind {
    mesh: "{ cube = { size = [0.8, 0.8, 0.8] } }",
    more: &[
        "model = \"translate(vec3(1.2 * float(i) - 2.0, 0.0, -1.6 * float(i))) * rotate_y(turn)\"",
        "instances = 5",
        "cull = \"back\"",
    ],
    eye: "[0, 1.2, 3.5]",
    seen: ("A row of boxes that leads into the distance", "奥へ並ぶ箱"),
};
const WINDOW: SceneKind = SceneKind {
    mesh: "{ fullscreen = {} }",
    more: &[],
    eye: "[0, 0, 1]",
    seen: ("A picture that fills the window", "ウィンドウ全体の画像"),
};
const FLAT: SceneKind = SceneKind {
    mesh: "{ quad = { size = [1.4, 1.4] } }",
    more: &["depth_test = \"off\""],
    eye: "[0, 0, 1]",
    seen: ("A shape in the plane", "平面の図形"),
};

/// Chooses what is drawn.
pub(super) fn propose(plan: &mut FolderPlan, test: Option<&ShaderTest>) {
    if let Some(test) = test {
        plan.scene = Proposed { lines: test.scene(), seen: ("What the test draws", "テストが描くもの") };
        return;
    }
    let shape = shape(plan);
    let moves = moves(plan) || shape.more.iter().any(|line| line.starts_with("turn") || line.starts_with("model"));
    let is_window = std::ptr::eq(shape, &WINDOW);
    let mut lines = vec![format!("mesh = {} # see docs/assignment-toml.md for others", shape.mesh)];
    // Who tells backs from fronts wants to see them.
    let is_kept = |line: &&&str| !(line.starts_with("cull") && reads(plan, "gl_FrontFacing"));
    lines.extend(shape.more.iter().filter(is_kept).map(|line| (*line).to_owned()));
    lines.push(format!("eye = {}", shape.eye));
    // Who reads the number of an instance wants to see several.
    if reads(plan, "gl_InstanceID") && !lines.iter().any(|line| line.starts_with("instances")) {
        lines.push("instances = 3".to_owned());
    }
    lines.extend(
        ["target = [0, 0, 0]", "up = [0, 1, 0]", "fovy = 0.8 # radians", "near = 0.1", "far = 30"].map(str::to_owned),
    );
    lines.push("cycle = 5 # seconds".to_owned());
    lines.push(format!("window = {}", if is_window { "[400, 225]" } else { "[400, 300]" }));
    lines.push("background = [30, 32, 40, 255]".to_owned());
    lines.push(format!("poses = {} # pictures of a cycle", if moves { 6 } else { 1 }));
    plan.scene = Proposed { lines, seen: shape.seen };
    let (en, ja) = shape.seen;
    let said = shape.mesh;
    plan.guessed(format!("scene: {}: mesh = {said}", en.to_lowercase()), format!("scene: {ja}: mesh = {said}"));
}

/// Whether a solution reads this input.
fn reads(plan: &FolderPlan, name: &str) -> bool {
    plan.sources.iter().flat_map(|source| source.program.inputs()).any(|input| input.name == name)
}

/// Whether a uniform changes with time.
fn moves(plan: &FolderPlan) -> bool {
    let mut lines = plan.uniforms.iter().flat_map(|uniform| &uniform.lines);
    lines.any(|line| line.starts_with("is =") && (line.contains("* t") || line.contains("turn")))
}

fn shape(plan: &FolderPlan) -> &'static SceneKind {
    let carries = |role: &str| plan.attributes.iter().any(|attribute| attribute.said == format!("carries = {role:?}"));
    let has_camera = plan.uniforms.iter().any(|uniform| {
        uniform
            .lines
            .iter()
            .any(|line| line.contains("\"model") || line.contains("view") || line.contains("projection"))
    });
    let uniforms = || plan.sources.iter().flat_map(|source| source.program.uniforms());
    let named = |words: &[&str]| uniforms().any(|uniform| NameWords::of(&uniform.name).has(words));
    let has_cube = uniforms()
        .any(|uniform| matches!(uniform.kind, Type::Sampler(sampler) if sampler.dimension == Dimension::Cube));
    let has_picture =
        uniforms().any(|uniform| matches!(uniform.kind, Type::Sampler(sampler) if sampler.dimension == Dimension::Two));
    let moves_vertices = plan.hands_in(Stage::Vertex)
        && named(&[
            "amplitude",
            "amp",
            "wave",
            "waves",
            "wavelength",
            "frequency",
            "wind",
            "height",
            "displacement",
            "ripple",
        ]);
    match () {
        () if !has_camera && plan.hands_in(Stage::Vertex) => &FLAT,
        () if !has_camera => &WINDOW,
        () if moves_vertices => &GRID,
        () if named(&["fog", "density", "haze", "mist"]) => &ROW,
        () if carries("tangent") || has_cube => &SPHERE,
        () if has_picture => &CUBE,
        () => &TORUS,
    }
}
