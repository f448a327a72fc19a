//! Pictures of the animation, as a right answer or a known mistake draws them.

use crate::equation::{EquationVariant, Reads};
use crate::feature::Feature;
use crate::interpreter::{NotedLookup, Program, Texels};
use crate::mistake::FoundMistake;
use crate::pipeline::{Pipeline, ShadedVertices, UniformsOf, positions, scalars};
use crate::rasteriser::{ClipVertex, Frame, Surface, Visible};
use crate::scene::{Instance, Pose};
use crate::shading::{Scenery, ShadedDraw};
use crate::{Assignment, Value};
use glam::DVec4;
use std::collections::HashMap;

/// What the vertex stage of a picture is.
#[derive(Clone, Copy)]
pub(crate) enum VertexStage<'a> {
    /// A program.
    Program(&'a Program),
    /// The equation with some definitions replaced, and with the value of a definition in place of the colour.
    Equation(&'a EquationVariant<'a>, usize),
}

impl Assignment {
    /// The right picture at `pose`.
    pub fn right_frame(&self, pose: &Pose) -> Frame {
        match self.equation.reads {
            Reads::Attributes => self.frame(pose, &self.equation.right()),
            Reads::Varyings | Reads::Outputs => {
                let right = self.picture(pose, &self.pipeline, VertexStage::Program(&self.pipeline.vertex));
                self.without_unjudged(pose, right)
            }
        }
    }

    /// The picture that `variant` of a vertex stage's equation draws at `pose`.
    pub fn frame(&self, pose: &Pose, variant: &EquationVariant<'_>) -> Frame {
        self.picture(pose, &self.pipeline, VertexStage::Equation(variant, self.equation.colour))
    }

    /// The picture of one term: the definition called `term` in place of the colour. `None` if there is no such definition of
    /// a vertex stage.
    pub fn term_frame(&self, pose: &Pose, variant: &EquationVariant<'_>, term: &str) -> Option<Frame> {
        if self.equation.reads != Reads::Attributes {
            return None;
        }
        Some(self.picture(pose, &self.pipeline, VertexStage::Equation(variant, self.equation.index(term)?)))
    }

    /// The right pictures of all poses.
    pub fn frames(&self) -> Vec<Frame> {
        self.at_all_poses(|pose| self.right_frame(pose))
    }

    /// The pictures of all poses by the solution without a feature. A term of a fragment stage is known at probes only.
    pub fn frames_without(&self, feature: &Feature) -> Option<Vec<Frame>> {
        match feature {
            Feature::Program(program) => Some(self.at_all_poses(|pose| self.drawn_by(program, pose))),
            Feature::Term(form) => self.frames_of(&self.equation.right().with(form, f64::NAN)),
        }
    }

    /// The pictures of all poses with a mistake. What is another definition of a fragment stage is known at probes only.
    pub fn frames_with(&self, found: &FoundMistake) -> Option<Vec<Frame>> {
        match self.mistake(&found.id)?.program(found.form) {
            Some(program) => Some(self.at_all_poses(|pose| self.drawn_by(program, pose))),
            None => self.frames_of(&self.variant(std::slice::from_ref(found))?),
        }
    }

    fn frames_of(&self, variant: &EquationVariant<'_>) -> Option<Vec<Frame>> {
        (self.equation.reads == Reads::Attributes).then(|| self.at_all_poses(|pose| self.frame(pose, variant)))
    }

    fn at_all_poses(&self, draw: impl Fn(&Pose) -> Frame) -> Vec<Frame> {
        self.scene.all_poses().iter().map(draw).collect()
    }

    /// The triangles of that picture, with the term in place of the colour.
    pub fn term_corners(&self, pose: &Pose, variant: &EquationVariant<'_>, term: &str) -> Option<Vec<[ClipVertex; 3]>> {
        let shown = self.equation.index(term).filter(|_| self.equation.reads == Reads::Attributes)?;
        let mut corners = Vec::new();
        for Instance { draw, moment } in self.scene.instances(pose) {
            let uniforms = self.uniform_values(&moment);
            let vertices = draw.mesh.vertices.iter().map(|vertex| {
                let outcome = variant.evaluate(&uniforms, &self.attribute_values(vertex));
                ClipVertex { position: outcome.position(), colour: outcome.vec3(shown) }
            });
            let vertices: Vec<ClipVertex> = vertices.collect();
            corners.extend(draw.mesh.triangles.iter().map(|triangle| triangle.map(|vertex| vertices[vertex as usize])));
        }
        Some(corners)
    }

    /// Whether the right colour of some vertex jumps where one of its attributes differs by very little: rounding, or another
    /// number of digits, then decides what the picture at `pose` shows.
    pub fn has_a_step_at(&self, pose: &Pose) -> bool {
        // A right answer that is written in other words is off by less. The steepest highlight changes by 0.06.
        const NUDGE: f64 = 1e-3;
        const JUMP: f64 = 0.1;
        let right = self.equation.right();
        self.scene.instances(pose).iter().any(|instance| {
            let uniforms = self.uniform_values(&instance.moment);
            instance.draw.mesh.vertices.iter().any(|vertex| {
                let attributes = self.attribute_values(vertex);
                let colour = right.evaluate(&uniforms, &attributes).colour();
                let nudged = |at: usize, number: usize, by: f64| {
                    let mut numbers = attributes[at].numbers().to_vec();
                    numbers[number] += by * numbers[number].abs().max(1.0);
                    let mut nudged = attributes.clone();
                    nudged[at] = Value::of(attributes[at].kind().clone(), numbers);
                    right.evaluate(&uniforms, &nudged).colour()
                };
                let places = attributes
                    .iter()
                    .enumerate()
                    .flat_map(|(at, value)| (0..value.numbers().len()).map(move |n| (at, n)));
                places
                    .flat_map(|place| [(place, NUDGE), (place, -NUDGE)])
                    .any(|((at, number), by)| (nudged(at, number, by) - colour).abs().max_element() > JUMP)
            })
        })
    }

    /// The picture that two stages draw.
    pub(crate) fn picture(&self, pose: &Pose, pipeline: &Pipeline, stage: VertexStage<'_>) -> Frame {
        let (width, height) = (self.scene.width, self.scene.height);
        self.picture_of_size([width, height], pose, pipeline, stage).0
    }

    /// The same in a window of another size, and whether all colours are defined.
    pub(crate) fn picture_of_size(
        &self,
        [width, height]: [u32; 2],
        pose: &Pose,
        pipeline: &Pipeline,
        stage: VertexStage<'_>,
    ) -> (Frame, bool) {
        let instances = self.scene.instances(pose);
        let mut frame = Frame::cleared(width, height, self.scene.background);
        let (mut visible, scenery) = self.scenery([width, height], &instances, pipeline, stage);
        let is_defined = scenery.shade(&mut visible, &mut frame);
        (frame, is_defined)
    }

    /// Where a program looks up textures that a pass draws, for the pixel of a picture, counted from above.
    pub fn lookups_of(&self, pose: &Pose, pipeline: &Pipeline, pixel: [u32; 2]) -> Vec<NotedLookup> {
        let size = [self.scene.width, self.scene.height];
        let instances = self.scene.instances(pose);
        let stage = VertexStage::Program(&pipeline.vertex);
        let (visible, scenery) = self.scenery(size, &instances, pipeline, stage);
        let mut all = scenery.lookups(&visible, pixel[1] * size[0] + pixel[0]);
        all.retain(|one| self.drawn_map(one.texture).is_some());
        all
    }

    /// The texels of a texture that a pass draws: width, height, and the depths row by row, the lowest first.
    pub fn drawn_map(&self, texture: usize) -> Option<([usize; 2], Vec<f32>)> {
        let level = self.textures.get(texture)?.levels.first()?;
        let Texels::Depths(depths) = &level.texels else { return None };
        let [width, height, _] = level.size;
        Some(([width, height], depths.drawn().chunks(depths.each()).map(|texel| texel[0]).collect()))
    }

    /// What is seen in a picture, before it is coloured.
    pub(crate) fn scenery<'a>(
        &'a self,
        [width, height]: [u32; 2],
        instances: &'a [Instance<'a>],
        pipeline: &'a Pipeline,
        stage: VertexStage<'_>,
    ) -> (Visible, Scenery<'a>) {
        let shapes: Vec<ShadedDraw<'a>> = instances
            .iter()
            .map(|instance| {
                let uniforms = self.uniform_values(&instance.moment);
                let vertices = self.vertices(instance, &uniforms, pipeline, stage);
                ShadedDraw { uniforms, vertices, triangles: &instance.draw.mesh.triangles }
            })
            .collect();
        let same: Vec<Vec<u32>> = shapes.iter().map(|shape| same(&shape.vertices)).collect();
        let is_faceted = pipeline.is_faceted();
        let drawn: Vec<Surface<'_>> = instances
            .iter()
            .zip(&shapes)
            .zip(&same)
            .map(|((instance, shape), same)| Surface {
                positions: &shape.vertices.positions,
                same,
                triangles: shape.triangles,
                is_faceted,
                depth_test: instance.draw.depth_test,
                cull: instance.draw.cull,
            })
            .collect();
        let mut visible = Visible::new(width, height).with_depths_of_its_own(pipeline.depth.is_some());
        visible.draw(&drawn);
        drop(drawn);
        let scenery = Scenery { assignment: self, pipeline, shapes, local: None };
        scenery.settle(&mut visible);
        (visible, scenery)
    }

    /// The vertices of a draw after the vertex stage.
    fn vertices(
        &self,
        instance: &Instance<'_>,
        uniforms: &[Value],
        pipeline: &Pipeline,
        stage: VertexStage<'_>,
    ) -> ShadedVertices {
        let mesh = &instance.draw.mesh;
        let count = mesh.vertices.len();
        match stage {
            VertexStage::Program(program) => {
                let Some(outputs) = self.run_vertices(program, UniformsOf::All(uniforms), &mesh.vertices) else {
                    return ShadedVertices {
                        positions: vec![DVec4::NAN; count],
                        varyings: vec![vec![f64::NAN; count]; pipeline.width()],
                    };
                };
                let varyings = pipeline.varyings.iter().flat_map(|varying| scalars(&outputs, varying.output)).collect();
                ShadedVertices { positions: positions(&outputs, count), varyings }
            }
            VertexStage::Equation(variant, shown) => {
                let mut vertices = ShadedVertices {
                    positions: Vec::with_capacity(count),
                    varyings: vec![Vec::with_capacity(count); pipeline.width()],
                };
                // What each varying is given.
                let outputs = pipeline.vertex.outputs();
                let definition = |name: &str| {
                    self.equation.output(name).map(|at| if at == self.equation.colour { shown } else { at })
                };
                let given: Vec<Option<usize>> =
                    pipeline.varyings.iter().map(|varying| definition(&outputs[varying.output].name)).collect();
                for vertex in &mesh.vertices {
                    let outcome = variant.evaluate(uniforms, &self.attribute_values(vertex));
                    vertices.positions.push(outcome.position());
                    for (varying, given) in pipeline.varyings.iter().zip(&given) {
                        let numbers = given.map_or(&[][..], |given| outcome.numbers(given));
                        for (place, scalar) in varying.scalars.clone().enumerate() {
                            vertices.varyings[scalar].push(numbers.get(place).copied().unwrap_or(0.0));
                        }
                    }
                }
                vertices
            }
        }
    }
}

impl Pipeline {
    /// Whether neighbouring triangles differ although their vertices are the same.
    fn is_faceted(&self) -> bool {
        use crate::interpreter::Interpolation;
        let is_flat = self.varyings.iter().any(|varying| varying.interpolation == Interpolation::Flat);
        let counts = self.fragment.inputs().iter().any(|input| input.name == "gl_PrimitiveID");
        is_flat || counts || self.nature.derivatives
    }
}

/// For each vertex the first one that is the same, number by number.
fn same(vertices: &ShadedVertices) -> Vec<u32> {
    let mut first: HashMap<Vec<u64>, u32> = HashMap::new();
    let numbers = |vertex: usize| {
        let position = vertices.positions[vertex].to_array().into_iter();
        let varyings = vertices.varyings.iter().map(move |values| values[vertex]);
        // −0 is 0.
        position.chain(varyings).map(|number| (number + 0.0).to_bits()).collect::<Vec<u64>>()
    };
    (0..vertices.positions.len()).map(|vertex| *first.entry(numbers(vertex)).or_insert(vertex as u32)).collect()
}
