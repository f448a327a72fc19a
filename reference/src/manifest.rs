//! `assignment.toml` as it is written: shapes only, nothing checked yet beyond them.

mod advice;
mod equation;
mod gradual;
mod host;
mod interface;
mod layers;
mod mistake;
mod pass;
mod probes;
mod scene;
mod texture;
mod toml_error;
mod variant;

pub use advice::{AdviceEntry, CircumstanceEntry};
pub use equation::{EquationEntry, SymbolMeaningEntry, TermEntry};
pub use gradual::GradualEntry;
pub use host::{HostArrayEntry, NoticeEntry};
pub use interface::{FreeEntry, InputEntry, UniformEntry};
pub use layers::{Layers, extended, line_of_extends, name_of_base};
pub use mistake::{AlternativeEntry, FitEntry, MistakeEntry, TermState, When};
pub use pass::PassEntry;
pub use probes::{DesignEntry, Probes, Range, RegionEntry};
pub use scene::{Depth, DrawEntry, PointEntry, Poses, SceneEntry, Scenes};
pub use texture::{Format, PictureOrigin, TextureEntry, TextureSize, Wraps};
pub use variant::Variant;

use crate::Text;
use crate::interpreter::Stage;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// The whole file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Name of the assignment, as in `ggsample06`.
    pub id: String,
    /// The homework that this one is laid over: the folder of that name beside this one, or else the built-in one.
    pub extends: Option<String>,
    /// What is not taken over of it: keys, and the names and ids of what its lists have.
    #[serde(default)]
    pub leave_out: Vec<String>,
    /// Title of the homework.
    pub title: Text,
    /// What there is to do.
    pub task: Option<Task>,
    /// So many times as long as usual a hand-in may take.
    #[schemars(with = "u32")]
    #[serde(default)]
    pub time: Option<Spanned<u32>>,
    /// What the lecture writes.
    pub equation: Option<EquationEntry>,
    /// The files that are handed in.
    pub file: Vec<File>,
    /// The stages that are not handed in.
    #[serde(default)]
    pub fixed: Vec<Fixed>,
    /// Vertex attributes.
    #[serde(default)]
    pub input: Vec<InputEntry>,
    /// Uniforms.
    #[serde(default)]
    pub uniform: Vec<UniformEntry>,
    /// What samplers read.
    #[serde(default)]
    pub texture: Vec<TextureEntry>,
    /// What is drawn into a texture before each picture.
    #[serde(default)]
    pub pass: Vec<PassEntry>,
    /// Uniforms that students add and name.
    #[serde(default)]
    pub free: Vec<FreeEntry>,
    /// The solution, changed: what that shows otherwise is not judged.
    #[schemars(with = "Vec<Variant>")]
    #[serde(default)]
    pub unjudged: Vec<Spanned<Variant>>,
    /// What is judged by its course between places that are judged.
    pub gradual: Option<GradualEntry>,
    /// What the handed-out file defines, as the solution does.
    #[serde(default)]
    pub constant: Vec<ConstantEntry>,
    /// Geometry, camera, animation: one table, or several, of which the first is the course's own.
    pub scene: Scenes,
    /// What the lecture says of the solution's definitions, or of the variables of one that is no list of definitions, by their names.
    #[serde(default)]
    pub definition: BTreeMap<String, LectureName>,
    /// How probes are chosen.
    #[serde(default)]
    pub probes: Probes,
    /// What a right answer shows at a probe; the first whose condition holds.
    #[serde(default)]
    pub region: Vec<RegionEntry>,
    /// Lines of the rubric.
    pub rubric: Vec<RubricItem>,
    /// The known mistakes.
    #[serde(default)]
    pub mistake: Vec<MistakeEntry>,
    /// What is said of right answers that would break elsewhere.
    #[serde(default)]
    pub advice: Vec<AdviceEntry>,
}

impl Manifest {
    /// The other readings of what is asked for: the place of the file that is handed in, that among what is accepted for it.
    pub fn read_otherwise(&self) -> Vec<(usize, usize, ReadingEntry)> {
        let of_file = |(file, entry): (usize, &File)| {
            let readings = entry.accepted.iter().enumerate().filter_map(move |(place, accepted)| match accepted {
                Accepted::Reading(reading) => Some((file, place, reading.clone())),
                Accepted::File(_) => None,
            });
            readings.collect::<Vec<_>>()
        };
        self.file.iter().enumerate().flat_map(of_file).collect()
    }

    /// The same with another solution for a file, and with nothing beside it.
    pub fn with_solution(mut self, file: usize, solution: &str) -> Self {
        self.file.iter_mut().for_each(|file| file.accepted.clear());
        solution.clone_into(&mut self.file[file].solution);
        self
    }
}

/// What there is to do, as a page for students has it.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// A sentence; names between backticks are code.
    pub text: Text,
    /// What is seen in a right picture, for those who do not see it.
    pub picture: Text,
}

/// A file that is handed in.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// Its name.
    pub name: String,
    /// Its stage.
    pub stage: Stage,
    /// The file that is handed out, in the assignment's folder.
    pub starter: String,
    /// The file that computes what is right, in the same folder.
    pub solution: String,
    /// Other files that compute what is right as well.
    #[serde(default)]
    pub accepted: Vec<Accepted>,
    /// The same as [[fixed]] of the whole homework.
    #[serde(default)]
    pub fixed: Vec<Fixed>,
    /// What is read of the file where it is a program in C++, and no shader.
    pub array: Option<HostArrayEntry>,
}

/// A file that is right beside the solution.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "the name of a file, or { file = \"…\", id = \"…\", note = { en = \"…\", ja = \"…\" } }")]
pub enum Accepted {
    /// It is right, and nothing is said.
    File(String),
    /// Another reading of what is asked for.
    Reading(ReadingEntry),
}

/// Another reading of what is asked for: it costs nothing, and is told.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Reading")]
pub struct ReadingEntry {
    /// The file, which defines what the solution defines.
    pub file: String,
    /// Its id in reports, among the advice.
    pub id: String,
    /// What is said of an answer that is right by it.
    pub note: Text,
}

impl Accepted {
    /// The name of the file.
    pub fn file(&self) -> &str {
        match self {
            Self::File(file) => file,
            Self::Reading(reading) => &reading.file,
        }
    }
}

/// A stage that every submission is linked with.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// Its stage.
    pub stage: Stage,
    /// The file, in the assignment's folder.
    pub file: String,
}

/// A constant of the handed-out file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Constant")]
pub struct ConstantEntry {
    /// Its name in the shader.
    pub name: String,
    /// What it means.
    pub means: Text,
    /// The rubric line that suffers when it is changed.
    pub line: String,
}

/// What the lecture says of a definition, or of a variable of a solution that is no list of definitions.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LectureName {
    /// What the lecture calls it.
    pub symbol: Option<String>,
    /// What it is, as a part of a sentence: `the cosine between N and L`.
    pub means: Option<Text>,
}

impl LectureName {
    /// What stands for it in a sentence.
    pub fn said(&self) -> Option<Text> {
        self.means.clone().or_else(|| self.symbol.as_deref().map(Text::verbatim))
    }

    /// What it is called by itself.
    pub fn in_few_words(&self) -> Option<Text> {
        self.symbol.as_deref().map(Text::verbatim).or_else(|| self.means.clone())
    }
}

/// A line of the rubric.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "RubricLine")]
pub struct RubricItem {
    /// Its id in reports.
    pub id: String,
    /// Its points.
    pub points: f64,
    /// What it is called.
    pub label: Text,
    /// The definition that it judges; the colour, where nothing is written.
    #[serde(default)]
    pub judges: String,
    /// The solution without what it judges, where that is not said by the definition: where the two differ, and no other line's
    /// do, the line can be judged by itself.
    #[schemars(with = "Option<Variant>")]
    pub without: Option<Spanned<Variant>>,
    /// Of a program of which numbers are read: those that it judges, as the homework's shader calls them.
    #[serde(default)]
    pub numbers: Vec<String>,
    /// The variables and functions of the solution that the line is about, where `without` does not tell. What is wrong in one of them
    /// costs the lines that are about it, and no other.
    #[serde(default)]
    pub variables: Vec<String>,
    /// What is said where it is right: `{frames}` and `{probes}` are how many there are.
    pub right: Option<Text>,
    /// The regions where its term stands alone, beside those of earlier lines.
    #[serde(default)]
    pub alone_in: Vec<String>,
}
