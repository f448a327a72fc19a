//! An assignment: its folder, read and checked.

mod check;
mod error;
mod interface;
mod mistakes;

use crate::accepted::{AcceptedAnswer, Reading};
use crate::advice::Advice;
use crate::derived::Derived;
use crate::equation::Equation;
use crate::feature::Feature;
pub use crate::feed::{Attribute, Bounds, Feed, Role, Stream};
use crate::free::Free;
use crate::host::HostArray;
use crate::interpreter::{Stage, Texture};
pub use crate::manifest::{LectureName, RubricItem, Task};
use crate::mistake::{Mistake, MistakeForm};
use crate::pipeline::Pipeline;
use crate::probes::{Probing, Region};
use crate::scene::{Moment, Scene, Vertex};
use crate::text::both;
use crate::traced::TracedProgram;
use crate::typeset::Typeset;
use crate::{Folder, Text, Value, manifest};
pub use error::AssignmentError;
pub(crate) use error::error;
pub use interface::{Input, Interface, Output, Uniform};
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// A homework as data.
#[derive(Clone, Debug)]
pub struct Assignment {
    /// Its name, as in `ggsample06`.
    pub id: String,
    /// The digest of its folder: an assignment that was changed has another.
    pub digest: String,
    /// The files that it was read from.
    pub folder: Arc<Folder>,
    /// Its title.
    pub title: Text,
    /// What there is to do.
    pub task: Option<Task>,
    /// What the lecture writes.
    pub typeset: Option<Typeset>,
    /// The files that are handed in.
    pub files: Vec<HandedIn>,
    /// The stages that are not handed in.
    pub fixed: Vec<FixedStage>,
    /// What the shader is given and what it writes.
    pub interface: Interface,
    /// The textures that samplers read, by number.
    pub textures: Arc<[Texture]>,
    /// The right program.
    pub pipeline: Pipeline,
    /// What uniforms may be that students add, the likeliest first.
    pub free: Vec<Free>,
    /// The solution, changed: what these show otherwise is not judged.
    pub(crate) unjudged: Vec<AcceptedAnswer>,
    /// The ids of the mistakes of an answer that does not go gradually from one thing to another, where that is asked for.
    pub gradual: Option<Gradual>,
    /// The solution, changed: some probes lie where these show something else.
    pub(crate) revealed: Vec<AcceptedAnswer>,
    /// What the handed-out file defines.
    pub constants: Vec<Constant>,
    /// What the lecture says of the solution's definitions and variables, by their names.
    pub names: BTreeMap<String, LectureName>,
    /// What is drawn.
    pub scene: Scene,
    /// What a right answer computes.
    pub equation: Equation,
    /// What it is worth.
    pub rubric: Vec<RubricItem>,
    /// For each line of the rubric the solution with 0 for the definition that it judges, where that is a part of what is seen.
    pub(crate) terms: Vec<Option<MistakeForm>>,
    /// For each line of the rubric the solution without what the line judges, where that is known.
    pub features: Vec<Option<Feature>>,
    /// What goes wrong.
    pub mistakes: Vec<Mistake>,
    /// What is said of right answers that would break elsewhere.
    pub advice: Vec<Advice>,
    /// What a right answer shows at a probe.
    pub regions: Vec<Region>,
    /// So many times as long as usual a hand-in may take.
    pub time: u32,
    pub(crate) probing: Probing,
    /// Made once for all that differ in nothing it is made of.
    pub(crate) derived: Arc<OnceLock<Derived>>,
    pub(crate) traced: Arc<OnceLock<Option<TracedProgram>>>,
}

/// The mistakes that are told by the way of an answer across edges, by their ids.
#[derive(Clone, Debug)]
pub struct Gradual {
    /// It shows the one or the other, and nothing between.
    pub abrupt: String,
    /// It goes back on its way.
    pub uneven: String,
}

/// A file that is handed in.
#[derive(Clone, Debug)]
pub struct HandedIn {
    /// Its name.
    pub name: String,
    /// Its stage.
    pub stage: Stage,
    /// The text of the file that is handed out.
    pub starter: String,
    /// The name of that file.
    pub starter_name: String,
    /// A file that computes what is right.
    pub solution: Solution,
    /// What is read of it, where it is no shader.
    pub program: Option<HostProgram>,
    /// Other answers that are right as well.
    pub accepted: Vec<AcceptedAnswer>,
}

/// How a program in C++ is read that is handed in as a stage. The solution's text is that of a shader then.
#[derive(Clone, Debug)]
pub struct HostProgram {
    /// What is read.
    pub array: HostArray,
    /// The solution as it is written.
    pub solution: String,
    /// The handed-out file as a shader.
    pub starter: String,
}

impl HandedIn {
    /// The text of the handed-out file as a shader.
    pub fn starter_shader(&self) -> &str {
        self.program.as_ref().map_or(&self.starter, |program| &program.starter)
    }

    /// The text of the solution as it is written.
    pub fn solution_as_written(&self) -> &str {
        self.program.as_ref().map_or(&self.solution.text, |program| &program.solution)
    }
}

/// A stage that every hand-in is linked with.
#[derive(Clone, Debug)]
pub struct FixedStage {
    /// Its stage.
    pub stage: Stage,
    /// The name of its file.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// A shader that is right.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Its name in the folder.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// A constant of the handed-out file.
#[derive(Clone, Debug)]
pub struct Constant {
    /// Its name in the shader.
    pub name: String,
    /// Its value.
    pub value: Value,
    /// What it means.
    pub means: Text,
    /// The rubric line that suffers when it is changed.
    pub line: String,
}

/// Name of the file that describes an assignment.
pub const MANIFEST: &str = "assignment.toml";

impl Assignment {
    /// Reads and checks the assignment in a folder.
    ///
    /// # Errors
    /// Whatever in a file contradicts itself or the others, with its place.
    pub fn load(folder: Folder) -> Result<Self, AssignmentError> {
        let mut assignment = Self::read(&folder).map_err(|error| error.located(&folder))?;
        assignment.digest = folder.digest();
        assignment.folder = Arc::new(folder);
        Ok(assignment)
    }

    fn read(folder: &Folder) -> Result<Self, AssignmentError> {
        let layers = manifest::Layers::of(folder)?;
        let checked = |manifest| check::assignment(manifest, &|at| layers.place_at(at), folder);
        let manifest = layers.manifest()?;
        let read_as = manifest.read_otherwise();
        let mut assignment = checked(manifest)?;
        for (file, accepted, reading) in read_as {
            let read = checked(layers.manifest()?.with_solution(file, &reading.file)).map_err(|error| {
                let Text { en, ja } = error.message;
                let message = both(
                    format!("{en} (with {} as the solution, which is accepted as a reading)", reading.file),
                    format!("{ja} ({} を別解釈の解答として読んだとき)", reading.file),
                );
                AssignmentError { message, ..error }
            })?;
            let manifest::ReadingEntry { id, note, .. } = reading;
            let reading = Arc::new(Reading { id, note, assignment: read });
            assignment.files[file].accepted[accepted].reading = Some(reading);
        }
        Ok(assignment)
    }

    /// Whether a stage is handed in.
    pub fn hands_in(&self, stage: Stage) -> bool {
        self.files.iter().any(|file| file.stage == stage)
    }

    /// Whether a line is judged by where things are drawn, not by their colour.
    pub fn judges_position(&self, line: &RubricItem) -> bool {
        let judged = self.equation.index(&line.judges);
        judged.is_some() && judged == self.equation.position
    }

    /// The line of the folder's own manifest in which a line of the rubric says its id.
    pub fn line_of_rubric(&self, id: &str) -> Option<usize> {
        #[derive(serde::Deserialize)]
        struct Ids {
            rubric: Vec<Id>,
        }
        #[derive(serde::Deserialize)]
        struct Id {
            id: toml::Spanned<String>,
        }
        let text = self.folder.text(MANIFEST).ok()?;
        let ids: Ids = toml::from_str(text).ok()?;
        let own = ids.rubric.into_iter().find(|own| own.id.get_ref() == id)?;
        Some(text[..own.id.span().start].matches('\n').count() + 1)
    }

    /// Points of the whole rubric.
    pub fn max_score(&self) -> f64 {
        self.rubric.iter().map(|line| line.points).sum()
    }

    /// The values of the uniforms at a moment, in the interface's order.
    pub fn uniform_values(&self, moment: &Moment) -> Vec<Value> {
        self.interface.uniforms.iter().map(|uniform| uniform.value(moment)).collect()
    }

    /// The values of the vertex attributes, in the interface's order.
    pub fn attribute_values(&self, vertex: &Vertex) -> Vec<Value> {
        self.interface.inputs.iter().map(|input| input.stream.value(&input.kind, vertex)).collect()
    }

    /// The same assignment with other values of some constants, as a student's file may define them.
    ///
    /// # Errors
    /// A constant that is not known, or a value of another type.
    pub fn with_constants(&self, changed: &[(&str, Value)]) -> Result<Self, AssignmentError> {
        let mut other = self.clone();
        for (name, value) in changed {
            let found = other.constants.iter().position(|c| c.name == *name);
            let place = found.ok_or_else(|| {
                error(
                    format!("constant `{name}`"),
                    both("is not a constant of the assignment", "この課題の定数ではありません"),
                )
            })?;
            if other.constants[place].value.kind() != value.kind() {
                return Err(error(format!("constant `{name}`"), both("has another type", "型が異なります")));
            }
            other.constants[place].value = value.clone();
            other.equation.constants[place].1 = value.clone();
        }
        other.derived = Arc::default();
        if let Some(derived) = self.derived.get().and_then(|derived| derived.with_constants(changed)) {
            let _ = other.derived.set(derived);
        }
        Ok(other)
    }
}

#[cfg(test)]
mod tests;
