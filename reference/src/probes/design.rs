//! Where a probe lies and how its normal stands, by the angles that matter to the equation.

use super::{ProbeGroup, Random};
use crate::assignment::{Feed, Stream};
use crate::interpreter::Registers;
use crate::scene::{Matrices, Vertex};
use crate::{Assignment, value};
use glam::{DMat4, DVec3, DVec4};
use std::ops::RangeInclusive;

/// How often a design is tried before it is taken as it comes; each try succeeds in one of about ten cases.
const TRIES: usize = 2000;

/// Values of a number.
type ValueRange = RangeInclusive<f64>;

/// How the vertices of a group are placed. Directions are definitions of the solution, in eye space.
#[derive(Clone, Debug)]
pub(crate) struct Aim {
    /// The definition from which the direction to a vertex has its angle.
    pub axis: usize,
    /// The definition around which normals stand; it does not depend on them.
    pub lobe: usize,
    /// The constant to whose power the cosine between normal and lobe is raised: its place among the constants. Only
    /// [`Normal::Raised`] needs it.
    pub power: Option<usize>,
    /// What each vertex shows.
    pub designs: Vec<Design>,
}

/// What a probe shows.
#[derive(Clone, Debug)]
pub(crate) struct Design {
    /// Angle at the eye between the axis and the direction from the vertex, in degrees.
    pub angle: ValueRange,
    /// Distance from the eye.
    pub distance: ValueRange,
    /// How the normal is chosen.
    pub normal: Normal,
    /// Values that definitions may have.
    pub within: Vec<(usize, ValueRange)>,
}

#[derive(Clone, Debug)]
pub(crate) enum Normal {
    /// Where the cosine of its angle from the lobe, raised to the power, is in this range.
    Raised(ValueRange),
    /// Where that cosine is in this range.
    Cosine(ValueRange),
}

/// Chooses vertices in eye space: what is drawn stands there, so that model-view and normal matrix are the identity.
pub(super) struct EyeSpace<'a> {
    aim: &'a Aim,
    point: SolutionAtPoint<'a>,
    /// The axis at the eye, and what it is computed from.
    axis: DVec3,
    to_axis: Vec<usize>,
    power: f64,
    /// What the lobe is computed from, and it.
    lobe: Vec<usize>,
    /// The same of each design's conditions, as far as it is not among those.
    conditions: Vec<Vec<usize>>,
}

/// The solution at a point in eye space.
struct SolutionAtPoint<'a> {
    assignment: &'a Assignment,
    registers: Registers,
}

impl<'a> EyeSpace<'a> {
    pub(super) fn of(assignment: &'a Assignment, aim: &'a Aim) -> Self {
        let equation = &assignment.equation;
        let power = aim
            .power
            .and_then(|power| assignment.constants.get(power))
            .map_or(f64::NAN, |constant| constant.value.float());
        let needed = |definitions: &[usize]| -> Vec<usize> {
            let is_needed = |on: &usize| definitions.iter().any(|of| equation.depends(*of, *on));
            (0..equation.definitions.len()).filter(is_needed).collect()
        };
        let lobe = needed(&[aim.lobe]);
        let conditions = aim.designs.iter().map(|design| {
            let definitions: Vec<usize> = design.within.iter().map(|(definition, _)| *definition).collect();
            needed(&definitions).into_iter().filter(|definition| !lobe.contains(definition)).collect()
        });
        Self {
            aim,
            point: SolutionAtPoint { assignment, registers: equation.registers() },
            axis: DVec3::ZERO,
            to_axis: needed(&[aim.axis]),
            power,
            conditions: conditions.collect(),
            lobe,
        }
    }

    /// Gives the solution what a group is given, but for its matrices.
    pub(super) fn enter(&mut self, group: &ProbeGroup) {
        let Assignment { equation, interface, scene, .. } = self.point.assignment;
        // What is drawn stands in eye space; what stands in world space is where the group's camera sees it.
        let view = group.matrices.view;
        let own = DMat4::IDENTITY;
        let world = Matrices::seen(view.inverse(), view, own);
        let here =
            scene.moment(group.t, Matrices { model_view: own, model_view_projection: own, normal: own, ..world });
        let uniforms = interface.uniforms.iter().zip(&group.uniforms);
        for (cell, (uniform, given)) in equation.uniforms.iter().zip(uniforms) {
            let own = matches!(uniform.feed, Feed::Role(_)).then(|| uniform.value(&here));
            let Some(cell) = cell else { continue };
            equation.sheet.set(*cell, own.as_ref().unwrap_or(given).numbers(), &mut self.point.registers);
        }
        self.point.stand(DVec3::ZERO, DVec3::Z);
        self.point.compute(&self.to_axis);
        self.axis = value::vec3(self.point.value(self.aim.axis));
    }

    /// The vertex in a group's `place`, carried back to object space; `position`: in object space, where it is given.
    pub(super) fn vertex(
        &mut self,
        random: &mut Random,
        place: usize,
        position: Option<DVec4>,
        matrices: &Matrices,
    ) -> Vertex {
        let given = position.map(|position| (matrices.model_view * position).truncate());
        let (p, n) = self.placed(random, place, given);
        let normal = matrices.normal.inverse().transform_vector3(n).normalize();
        match position {
            Some(position) => Vertex::new(position.truncate(), normal),
            None => Vertex::new(matrices.model_view.inverse().transform_point3(p), normal),
        }
    }

    /// Position and normal as designed; after [`TRIES`] tries, whatever the last one was.
    fn placed(&mut self, random: &mut Random, place: usize, given: Option<DVec3>) -> (DVec3, DVec3) {
        let place = place % self.aim.designs.len();
        let design = &self.aim.designs[place];
        let point = &mut self.point;
        let mut last = (DVec3::NEG_Z, DVec3::Z);
        for _ in 0..TRIES {
            let angle = random.within(&design.angle);
            let view = random.at_angle(self.axis, angle.to_radians());
            let there = -view * random.within(&design.distance);
            let p = given.unwrap_or(there);
            let cosine = match &design.normal {
                Normal::Raised(level) => random.within(level).powf(1.0 / self.power),
                Normal::Cosine(range) => random.within(range),
            };
            point.stand(p, DVec3::Z);
            point.compute(&self.lobe);
            let n = random.at_angle(value::vec3(point.value(self.aim.lobe)), cosine.acos());
            last = (p, n);
            point.stand(p, n);
            point.compute(&self.conditions[place]);
            let is_within = |(definition, range): &(usize, ValueRange)| range.contains(&point.value(*definition)[0]);
            if design.within.iter().all(is_within) {
                break;
            }
        }
        last
    }
}

impl SolutionAtPoint<'_> {
    /// Goes to a point with a normal.
    fn stand(&mut self, p: DVec3, n: DVec3) {
        let Assignment { equation, interface, .. } = self.assignment;
        let vertex = Vertex { position: p.extend(1.0), normal: n.extend(1.0), ..Vertex::new(p, n) };
        for (cell, input) in equation.attributes.iter().zip(&interface.inputs) {
            if let (Some(cell), Stream::Mesh(attribute)) = (cell, &input.stream) {
                let count = input.kind.slots().unwrap_or(0).min(4);
                equation.sheet.set(*cell, &attribute.at(&vertex).to_array()[..count], &mut self.registers);
            }
        }
    }

    fn compute(&mut self, definitions: &[usize]) {
        let equation = &self.assignment.equation;
        for definition in definitions {
            equation.sheet.compute(&equation.definitions[*definition].formula, &mut self.registers);
        }
    }

    fn value(&self, definition: usize) -> &[f64] {
        let equation = &self.assignment.equation;
        equation.sheet.get(equation.cell(definition), &self.registers)
    }
}
