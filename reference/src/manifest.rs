//! `assignment.toml` as it is written: shapes only, nothing checked yet beyond them.

use crate::Text;
use crate::probes::Region;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Name of the assignment, as in `ggsample06`.
    pub id: String,
    /// Title of the homework.
    pub title: Text,
    /// The files that are handed in.
    pub file: Vec<File>,
    /// Vertex attributes.
    pub input: Vec<Input>,
    /// Uniforms of the default block.
    pub uniform: Vec<Uniform>,
    /// What the handed-in stage writes.
    pub output: Vec<Output>,
    /// What the handed-out file defines.
    pub constant: Vec<Constant>,
    /// Geometry, camera, animation.
    pub scene: Scene,
    /// The illumination equation, in order.
    pub definition: Vec<Definition>,
    /// How probes are chosen.
    pub probes: Probes,
    /// Lines of the rubric.
    pub rubric: Vec<RubricLine>,
    /// The known mistakes.
    pub mistake: Vec<Mistake>,
    /// What is said of right answers that would break elsewhere.
    #[serde(default)]
    pub advice: Vec<Advice>,
}

/// Something to say of a right answer that would break elsewhere.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Advice {
    /// Its id in reports.
    pub id: String,
    /// Where it breaks.
    pub when: Circumstance,
    /// The definitions that are likely to be at fault, the likeliest first.
    pub about: Vec<String>,
    /// Whether it is said only if one of these is what breaks.
    #[serde(default)]
    pub only_about: bool,
    /// What would break, and where to look.
    pub message: Text,
}

/// What is different from a probe of the homework.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Circumstance {
    /// Vertex attribute → what its components are multiplied by.
    #[serde(default)]
    pub scaled: BTreeMap<String, [f64; 4]>,
    /// By how much the model is stretched along its axes.
    pub stretched: Option<[f64; 3]>,
    /// Constant → another value.
    #[serde(default)]
    pub constants: BTreeMap<String, Vec<f64>>,
}

/// A file that is handed in.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// Its name.
    pub name: String,
    /// Its stage.
    pub stage: Stage,
    /// The file that is handed out, in the assignment's folder.
    pub starter: String,
    /// The stages that are not handed in.
    pub fixed: Vec<Fixed>,
}

/// A stage that every submission is linked with.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// Its stage.
    pub stage: Stage,
    /// The file, in the assignment's folder.
    pub file: String,
}

/// A stage of the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// The vertex shader.
    Vertex,
    /// The fragment shader.
    Fragment,
}

/// A vertex attribute.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Its name in the shader.
    pub name: String,
    /// Its GLSL type.
    pub r#type: String,
    /// What it holds.
    pub carries: Attribute,
}

/// What a vertex attribute holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Attribute {
    /// Position in object space, w = 1.
    Position,
    /// Normal in object space, w = 1.
    Normal,
}

/// A uniform.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Uniform {
    /// Its name in the shader.
    pub name: String,
    /// Its GLSL type.
    pub r#type: String,
    /// Which matrix it holds.
    pub carries: Matrix,
}

/// Which matrix a uniform holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Matrix {
    /// From object space to eye space.
    ModelView,
    /// From object space to clip space.
    ModelViewProjection,
    /// From normals in object space to normals in eye space.
    NormalMatrix,
}

/// An output of the handed-in stage.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Its name in the shader.
    pub name: String,
    /// Its GLSL type.
    pub r#type: String,
    /// The definition that it must hold.
    pub carries: String,
}

/// A constant of the handed-out file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    /// Its name in the shader.
    pub name: String,
    /// Its GLSL type.
    pub r#type: String,
    /// Its value, component by component.
    pub value: Vec<f64>,
    /// What it means.
    pub means: Text,
    /// The rubric line that suffers when it is changed.
    pub line: String,
}

/// Geometry, camera, animation; lengths in world units, angles in radians.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Vertices of the triangle.
    pub triangle: [[f64; 3]; 3],
    /// Their normals.
    pub normals: [[f64; 3]; 3],
    /// Where the eye is.
    pub eye: [f64; 3],
    /// What it looks at.
    pub target: [f64; 3],
    /// Which way is up.
    pub up: [f64; 3],
    /// Vertical field of view.
    pub fovy: f64,
    /// Near clipping plane.
    pub near: f64,
    /// Far clipping plane.
    pub far: f64,
    /// Turn about y in one cycle.
    pub turn: f64,
    /// Seconds in a cycle.
    pub cycle: f64,
    /// Width and height in pixels.
    pub window: [u32; 2],
    /// Clear colour, RGBA.
    pub background: [u8; 4],
    /// Number of poses that are looked at.
    pub poses: u32,
}

/// A definition of the equation.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Definition {
    /// Its name.
    pub name: String,
    /// Its expression.
    pub is: String,
    /// The slide of the lecture that defines it.
    pub slide: Option<u32>,
    /// What the lecture calls it.
    pub symbol: Option<String>,
}

/// How probes are chosen.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Probes {
    /// Number of cameras.
    pub groups: usize,
    /// Vertices for each of them.
    pub per_group: usize,
    /// Constant that holds the light's position in eye space, homogeneous.
    pub light: String,
    /// Constant that holds the shininess.
    pub shininess: String,
}

/// A line of the rubric.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RubricLine {
    /// Its id in reports.
    pub id: String,
    /// Its points.
    pub points: f64,
    /// What it is called.
    pub label: Text,
    /// The definition that it judges.
    pub judges: String,
    /// Where its term stands alone, beside those of earlier lines.
    #[serde(default)]
    pub alone_in: Vec<Region>,
    /// Where it can be judged if all earlier lines are right.
    #[serde(default)]
    pub also_in: Vec<Region>,
}

/// A known mistake.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// Its id in reports.
    pub id: String,
    /// The mistake in a few words.
    pub title: Text,
    /// Fraction of the points that is kept, by rubric line.
    pub keeps: BTreeMap<String, f64>,
    /// The ways in which it is written: definition → expression.
    #[serde(default)]
    pub forms: Vec<BTreeMap<String, String>>,
    /// The free parameter of its forms.
    pub fit: Option<Fit>,
    /// Whether the handed-out file itself has the mistake.
    #[serde(default)]
    pub handed_out: bool,
    /// Whether something is left out where a right value is used.
    #[serde(default)]
    pub at_use: bool,
    /// Of these the text contains one, parentheses and swizzles aside, where a free parameter explains as much.
    #[serde(default)]
    pub needs: Vec<String>,
    /// Of these constants the statements use none, where a free parameter explains as much.
    #[serde(default)]
    pub lacks: Vec<String>,
    /// What is seen in the picture.
    pub seen: Text,
    /// Which equation of the lecture it breaks.
    pub equation: Text,
    /// Where to look.
    pub look: Text,
    /// Texts for files of which these would not be true.
    #[serde(default)]
    pub instead: Vec<Alternative>,
}

/// Texts in place of a mistake's own.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Alternative {
    /// When they are said: where all of it holds.
    pub when: When,
    /// What is seen in the picture.
    pub seen: Option<Text>,
    /// Which equation of the lecture it breaks.
    pub equation: Option<Text>,
    /// Where to look.
    pub look: Option<Text>,
}

/// What must hold for an [`Alternative`].
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct When {
    /// The mistake is found in one of these of its forms, from 0.
    #[serde(default)]
    pub forms: Vec<usize>,
    /// None of these words is in the statement that is named; in the file, where none is named.
    #[serde(default)]
    pub lacks: Vec<String>,
    /// How the student's file has the term.
    pub term: Option<TermState>,
}

/// How a file has a term that does not show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TermState {
    /// It is computed, and it is 0.
    Zero,
    /// Nothing stands for it.
    Absent,
}

/// A free parameter.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fit {
    /// Its name.
    pub name: String,
    /// Least value.
    pub from: f64,
    /// Greatest value.
    pub to: f64,
    /// A likely value.
    pub example: f64,
    /// Whether the colour at a place may rise and fall again while it grows.
    #[serde(default)]
    pub turns: bool,
}
