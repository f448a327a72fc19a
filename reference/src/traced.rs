//! A program run at some probes, with every value on its way looked at or changed.
//!
//! A stage that is handed in is compiled so that it can be traced; a fixed one runs as it is. Where the fragment stage is all
//! that is handed in, it is given exactly what the probes' own vertex stage hands over.

mod bench;
mod handed_over;
mod inputs;

pub use bench::Bench;
pub use handed_over::ToldByOutputs;

use crate::equation::Reads;
use crate::interpreter::{Interpolation, Program, ProgramVariable, Scalar, Stage, UndefinedCause};
use crate::pipeline::{Pipeline, Varying};
use crate::probes::{Probe, ProbeSet};
use crate::{Assignment, Text, Value};
use glam::{DVec3, DVec4};
use std::sync::Arc;

/// The stages of a program, those that are handed in compiled to be traced.
#[derive(Clone, Debug)]
pub struct TracedProgram {
    vertex: Arc<Program>,
    fragment: Arc<Program>,
    handed_in: [bool; 2],
    pipeline: Option<Pipeline>,
}

/// A probe and its uniforms, in the interface's order.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// The probe.
    pub probe: &'a Probe,
    /// Its uniforms.
    pub uniforms: &'a [Value],
}

impl<'a> Place<'a> {
    /// All probes of a set with their uniforms.
    pub fn all(probes: &'a ProbeSet) -> Vec<Self> {
        probes.iter().map(|probe| Self { probe, uniforms: probes.uniforms(probe) }).collect()
    }
}

/// What is seen of a program at each probe.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The colour as the homework's target holds it; [`DISCARDED`](crate::equation::DISCARDED) where it is thrown away, no number where it is undefined.
    pub colours: Vec<DVec3>,
    /// The position of the vertex, or of the triangle's first corner, where a vertex stage is handed in.
    pub positions: Vec<DVec4>,
    /// Why the first colour is undefined that is, and the stage whose text does it.
    pub undefined: Option<(Stage, UndefinedCause)>,
}

impl Assignment {
    /// The program of the right answer, compiled when it is first asked for. `None` where it cannot be run.
    pub fn traced_solution(&self) -> Option<&TracedProgram> {
        let compiled = || {
            let texts: Vec<(Stage, &str)> =
                self.files.iter().map(|file| (file.stage, file.solution.text.as_str())).collect();
            TracedProgram::new(self, &texts).ok()
        };
        self.traced.get_or_init(compiled).as_ref()
    }
}

impl TracedProgram {
    /// The program of these texts, with the homework's own stages beside them.
    ///
    /// # Errors
    /// Why it cannot be run.
    pub fn new(assignment: &Assignment, texts: &[(Stage, &str)]) -> Result<Self, Text> {
        let [mut vertex, mut fragment] = [&assignment.pipeline.vertex, &assignment.pipeline.fragment].map(Arc::clone);
        let mut handed_in = [false; 2];
        for (stage, text) in texts {
            let traced = Arc::new(Program::traced(text, *stage).map_err(|refusal| refusal.what().clone())?);
            match stage {
                Stage::Vertex => (vertex, handed_in[0]) = (traced, true),
                Stage::Fragment => (fragment, handed_in[1]) = (traced, true),
            }
        }
        let pipeline = match assignment.equation.reads() {
            Reads::Attributes => None,
            Reads::Varyings | Reads::Outputs => Some(Pipeline::link(&vertex, &fragment, None)?),
        };
        Ok(Self { vertex, fragment, handed_in, pipeline })
    }

    /// The same program with another one in the place of a stage. `None` where the two stages do not go together.
    pub fn with(&self, stage: Stage, program: Program) -> Option<Self> {
        let mut other = self.clone();
        match stage {
            Stage::Vertex => other.vertex = Arc::new(program),
            Stage::Fragment => other.fragment = Arc::new(program),
        }
        if self.pipeline.is_some() {
            other.pipeline = Some(Pipeline::link(&other.vertex, &other.fragment, None).ok()?);
        }
        Some(other)
    }

    /// A stage.
    pub fn stage(&self, stage: Stage) -> &Program {
        match stage {
            Stage::Vertex => &self.vertex,
            Stage::Fragment => &self.fragment,
        }
    }

    /// The inputs of the fragment stage that a vertex stage which is handed in writes, and how each is interpolated.
    pub fn interpolated(&self) -> Vec<(&ProgramVariable, Interpolation)> {
        let Some(pipeline) = self.pipeline.as_ref().filter(|_| self.handed_in == [true; 2]) else { return Vec::new() };
        let is_float = |varying: &&Varying| {
            let kind = &pipeline.vertex.outputs()[varying.output].kind;
            matches!(kind.scalar(), Some(Scalar::Float | Scalar::Double) | None)
        };
        let own = |varying: &Varying| (&pipeline.fragment.inputs()[varying.input], varying.interpolation);
        pipeline.varyings.iter().filter(is_float).map(own).collect()
    }

    /// The output of the vertex stage, by its place, that an input of the fragment stage is interpolated from, by what the text calls it.
    pub fn interpolated_from(&self, input: &str) -> Option<usize> {
        let pipeline = self.pipeline.as_ref()?;
        let is_it = |varying: &&Varying| pipeline.fragment.inputs()[varying.input].written == input;
        pipeline.varyings.iter().find(is_it).map(|varying| varying.output)
    }

    /// The same program where these of its inputs are interpolated in another way.
    pub fn interpolating(&self, inputs: &[&str], interpolation: Interpolation) -> Self {
        let mut other = self.clone();
        if let Some(pipeline) = &mut other.pipeline {
            let is_it =
                |varying: &&mut Varying| inputs.contains(&pipeline.fragment.inputs()[varying.input].name.as_str());
            pipeline.varyings.iter_mut().filter(is_it).for_each(|varying| varying.interpolation = interpolation);
        }
        other
    }

    /// Whether fragments depend on their neighbours.
    pub fn needs_quads(&self, assignment: &Assignment) -> bool {
        self.pipeline.as_ref().is_some_and(|pipeline| pipeline.needs_quads(&assignment.textures))
    }
}
