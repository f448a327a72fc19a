//! What is right must be a number in every picture: what GLSL leaves undefined is another thing on another machine.

mod undefined;

use super::{CheckResult, solution};
use crate::Assignment;
use crate::assignment::{MANIFEST, error};
use crate::equation::Reads;
use crate::frames::VertexStage;
use crate::interpreter::{Program, Stage, UndefinedCause};
use crate::pipeline::{Pipeline, UniformsOf, positions, scalars};
use crate::rasteriser::Frame;
use crate::scene::Pose;
use crate::text::both;
use std::collections::HashSet;

/// So many vertices are looked at, spread over all pictures.
const VERTICES: usize = 100_000;
/// Pictures are looked at in a window with sides of a fraction of theirs.
const FRACTION: u32 = 8;

pub(super) fn are_defined(assignment: &Assignment) -> CheckResult<()> {
    let interface = &assignment.interface;
    let mut known: HashSet<&str> = HashSet::new();
    known.extend(interface.uniforms.iter().map(|uniform| uniform.path.as_str()));
    known.extend(interface.inputs.iter().map(|input| input.name.as_str()));
    for answer in assignment.accepted() {
        let Pipeline { vertex, fragment, .. } = &answer.pipeline;
        let mut given = vertex.uniforms().iter().chain(fragment.uniforms()).chain(vertex.inputs());
        if let Some(other) = given.find(|one| !known.contains(one.name.as_str()) && !one.name.starts_with("gl_")) {
            let message = both(
                format!("`{}` is not among the inputs and uniforms of {MANIFEST}: remove it", other.name),
                format!("`{}` は {MANIFEST} の入力にも uniform 変数にもありません。取り除いてください", other.name),
            );
            return Err(error(solution::place(&answer.name, other.line), message));
        }
    }
    let poses = assignment.scene.all_poses();
    let right = assignment.equation.right();
    let own = match assignment.equation.reads {
        Reads::Attributes => VertexStage::Equation(&right, assignment.equation.colour),
        Reads::Varyings | Reads::Outputs => VertexStage::Program(&assignment.pipeline.vertex),
    };
    let file = assignment.files.last().map_or(MANIFEST, |file| &file.solution.name);
    for pose in &poses {
        let undefined = |file: &str, cause: Option<UndefinedCause>| {
            let message = undefined::message(cause);
            let place = solution::place(file, cause.map_or(0, |cause| cause.line));
            Err(error(format!("{place}, at t = {}", pose.t), message))
        };
        if let Err(why) = assignment.is_defined(pose, &assignment.pipeline, own, poses.len()) {
            let own = |stage| assignment.file_of(stage);
            let (file, cause) = why.and_then(|(stage, cause)| Some((own(stage)?, Some(cause)))).unwrap_or((file, None));
            return undefined(file, cause);
        }
        for answer in assignment.accepted() {
            let stage = VertexStage::Program(&answer.pipeline.vertex);
            if let Err(why) = assignment.is_defined(pose, &answer.pipeline, stage, poses.len()) {
                let of_answer =
                    assignment.files.iter().find(|file| file.accepted.iter().any(|own| own.name == answer.name));
                let own = why.filter(|(stage, _)| of_answer.is_some_and(|file| file.stage == *stage));
                return undefined(&answer.name, own.map(|(_, cause)| cause));
            }
        }
    }
    Ok(())
}

impl Assignment {
    /// Whether the solution tells backs of triangles from fronts, and its pictures show both.
    pub(super) fn shows_backs(&self) -> bool {
        let is_told_apart = self.pipeline.fragment.inputs().iter().any(|input| input.name == "gl_FrontFacing");
        let stage = VertexStage::Program(&self.pipeline.vertex);
        let shows = |pose: &Pose| {
            let [width, height] = self.small_window();
            let instances = self.scene.instances(pose);
            let (mut visible, scenery) = self.scenery([width, height], &instances, &self.pipeline, stage);
            scenery.shade(&mut visible, &mut Frame::cleared(width, height, self.scene.background));
            (0..visible.coverage.len()).any(|pixel| visible.at(pixel).is_some_and(|setup| !setup.is_front))
        };
        is_told_apart && self.scene.all_poses().iter().any(shows)
    }

    fn small_window(&self) -> [u32; 2] {
        [self.scene.width, self.scene.height].map(|side| side.div_ceil(FRACTION))
    }

    /// The file of the stage, handed in or not.
    fn file_of(&self, stage: Stage) -> Option<&str> {
        let solutions = self.files.iter().map(|file| (file.stage, &file.solution.name));
        let mut all = solutions.chain(self.fixed.iter().map(|fixed| (fixed.stage, &fixed.name)));
        all.find(|(own, _)| *own == stage).map(|(_, name)| name.as_str())
    }

    /// Whether what two stages compute for a picture is defined, as far as is looked at; if not, in which stage and why, where that
    /// is known.
    fn is_defined(
        &self,
        pose: &Pose,
        pipeline: &Pipeline,
        stage: VertexStage<'_>,
        pictures: usize,
    ) -> Result<(), Option<(Stage, UndefinedCause)>> {
        let instances = self.scene.instances(pose);
        let each = (VERTICES / (pictures * instances.len()).max(1)).max(3);
        for instance in &instances {
            let uniforms = self.uniform_values(&instance.moment);
            let vertices = &instance.draw.mesh.vertices;
            let some: Vec<_> = vertices.iter().step_by(vertices.len().div_ceil(each)).copied().collect();
            let run = |program: &Program| self.run_vertices(program, UniformsOf::All(&uniforms), &some);
            let is_defined = match stage {
                VertexStage::Equation(variant, _) => some.iter().all(|vertex| {
                    let outcome = variant.evaluate(&uniforms, &self.attribute_values(vertex));
                    let mut outputs = self.equation.outputs.iter().flat_map(|(_, given)| outcome.numbers(*given));
                    outputs.all(|number| number.is_finite())
                }),
                VertexStage::Program(program) => run(program).is_some_and(|outputs| {
                    let handed = pipeline.varyings.iter().flat_map(|varying| scalars(&outputs, varying.output));
                    handed.flatten().all(f64::is_finite)
                        && positions(&outputs, some.len()).iter().all(|position| position.is_finite())
                }),
            };
            if !is_defined {
                let outputs = run(&pipeline.vertex);
                let cause = outputs.and_then(|all| all.outputs.iter().find_map(|one| one.first_undefined(|_| true)));
                return Err(cause.map(|cause| (Stage::Vertex, cause)));
            }
        }
        if pipeline.copied.is_some() || self.picture_of_size(self.small_window(), pose, pipeline, stage).1 {
            return Ok(());
        }
        let (visible, scenery) = self.scenery(self.small_window(), &instances, pipeline, stage);
        Err(scenery.undefined(&visible).map(|cause| (Stage::Fragment, cause)))
    }
}
