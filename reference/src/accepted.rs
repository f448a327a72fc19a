//! Other answers that are right as well: shaders of their own, which are run as they are.

use crate::assignment::HandedIn;
use crate::equation::Reads;
use crate::frames::VertexStage;
use crate::interpreter::{Column, Program, SlipMark, Stage};
use crate::pipeline::{Pipeline, UniformsOf, columns, slices};
use crate::probes::ProbeSet;
use crate::rasteriser::Frame;
use crate::scene::Pose;
use crate::{Assignment, Text, Value};
use glam::{DVec3, DVec4};
use std::sync::Arc;

/// A shader that is right beside the solution.
#[derive(Clone, Debug)]
pub struct AcceptedAnswer {
    /// The name of its file.
    pub name: String,
    pub(crate) pipeline: Pipeline,
    /// What it has in place of texts of the solution, where that is all in which it differs.
    pub(crate) replaced: Vec<[String; 2]>,
    /// The texts of the solution's files with that.
    pub(crate) texts: Vec<String>,
    /// The slip by which it differs from the solution, where it is one, and the stage whose text that is in.
    pub(crate) slip: Option<Box<(Stage, SlipMark)>>,
    /// What is asked for, read in another way, where the answer is right by that.
    pub reading: Option<Arc<Reading>>,
}

/// Another reading of what is asked for, which costs nothing.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Its id in reports.
    pub id: String,
    /// What is said of an answer that follows it.
    pub note: Text,
    /// The homework with the answer in the place of its solution: what goes wrong beside the reading is known by it.
    pub assignment: Assignment,
}

/// A colour and a position.
pub(crate) type Computed = (DVec3, DVec4);

impl AcceptedAnswer {
    /// A program of which no more is known.
    pub(crate) fn new(name: &str, pipeline: Pipeline) -> Self {
        Self { name: name.to_owned(), pipeline, replaced: Vec::new(), texts: Vec::new(), slip: None, reading: None }
    }
}

impl Assignment {
    /// The answers that are right beside the solution.
    pub fn accepted(&self) -> impl Iterator<Item = &AcceptedAnswer> {
        self.files.iter().flat_map(|file| &file.accepted)
    }

    /// The solution with another program in the place of one of its files.
    pub(crate) fn linked_with(&self, file: &HandedIn, program: Program, name: &str) -> Option<AcceptedAnswer> {
        let own = Arc::new(program);
        let right = &self.pipeline;
        let [vertex, fragment] = match file.stage {
            Stage::Vertex => [&own, &right.fragment],
            Stage::Fragment => [&right.vertex, &own],
        };
        let pipeline = Pipeline::link(vertex, fragment, None).ok()?;
        Some(AcceptedAnswer::new(name, pipeline))
    }

    /// The same probes with what an answer computes there.
    pub fn probes_of(&self, answer: &AcceptedAnswer, probes: &ProbeSet) -> ProbeSet {
        let mut theirs = probes.clone();
        for (probe, (colour, position)) in theirs.probes.iter_mut().zip(self.computed_by(answer, probes)) {
            (probe.colour, probe.position) = (colour, position);
        }
        theirs
    }

    /// The colour and the position that an answer computes at each probe.
    pub(crate) fn computed_by(&self, answer: &AcceptedAnswer, probes: &ProbeSet) -> Vec<Computed> {
        match self.equation.reads {
            Reads::Attributes => {
                let given = probes.iter().map(|probe| (probes.uniforms(probe), probe.attributes.as_slice()));
                self.run(answer, &given.collect::<Vec<_>>())
            }
            Reads::Varyings | Reads::Outputs => match self.shown_once(&answer.pipeline, probes) {
                Some(shown) => shown.iter().map(|shown| (shown.colour, shown.position)).collect(),
                None => vec![(DVec3::NAN, DVec4::NAN); probes.probes.len()],
            },
        }
    }

    /// The picture that is right by an answer at a pose: what is not judged of it is left to the rasteriser.
    pub fn frame_of(&self, answer: &AcceptedAnswer, pose: &Pose) -> Frame {
        self.without_unjudged(pose, self.drawn_by(answer, pose))
    }

    /// The picture that a program draws at a pose, right or wrong.
    pub(crate) fn drawn_by(&self, program: &AcceptedAnswer, pose: &Pose) -> Frame {
        self.picture(pose, &program.pipeline, VertexStage::Program(&program.pipeline.vertex))
    }

    /// Runs an answer on vertices, each with uniforms and attributes. What is undefined is not a number.
    fn run(&self, answer: &AcceptedAnswer, given: &[(&[Value], &[Value])]) -> Vec<Computed> {
        self.computed(&answer.pipeline.vertex, given).unwrap_or_else(|| vec![(DVec3::NAN, DVec4::NAN); given.len()])
    }

    fn computed(&self, program: &Program, given: &[(&[Value], &[Value])]) -> Option<Vec<Computed>> {
        let names = self.interface.inputs.iter().map(|input| &input.name).enumerate();
        let attributes: Vec<_> = names
            .filter_map(|(place, name)| {
                let own = program.inputs().iter().find(|own| own.name == *name)?;
                Some((name, columns(own, given.iter().map(|(_, attributes)| &attributes[place]))))
            })
            .collect();
        let uniforms: Vec<&[Value]> = given.iter().map(|(uniforms, _)| *uniforms).collect();
        let mut run = self.fed(program, given.len(), UniformsOf::Each(&uniforms))?;
        for (name, columns) in &attributes {
            run = run.input(name, &slices(columns)).ok()?;
        }
        let outputs = run.outputs().ok()?;
        let colour = outputs.get(&self.interface.outputs.first()?.name)?;
        let position = outputs.get("gl_Position")?;
        Some((0..given.len()).map(|at| (vector(colour, at).truncate(), vector(position, at))).collect())
    }
}

/// What a shader wrote for a vertex; not a number where that is undefined.
fn vector(column: &Column, vertex: usize) -> DVec4 {
    let scalar = |at: usize| match column.values.get(at) {
        Some(values) if column.undefined(at, vertex).is_none() => values[vertex],
        _ => f64::NAN,
    };
    DVec4::from_array(std::array::from_fn(scalar))
}
