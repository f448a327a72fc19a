//! What a vertex stage hands over to the fragment stage, mixed between the corners of triangles.

use super::Spot;
use crate::equation::Reads;
use crate::interpreter::{Interpolation, Program, ProgramVariable, Scalar};
use crate::pipeline::{Pipeline, UniformsOf, positions, scalars};
use crate::scene::Vertex;
use crate::{Assignment, Value};
use glam::{DVec3, DVec4};

/// What is handed over at each of some fragments: by output of the vertex stage, scalar and fragment.
pub(crate) type FragmentInputs = Vec<Vec<Vec<f64>>>;

/// The same there, at the pixels to the right, and at those above; nothing of the last two where nobody looks at them.
pub(crate) type HandedAround = [FragmentInputs; 3];

impl Assignment {
    /// Positions and outputs of a vertex stage.
    pub(super) fn handed_by(
        &self,
        program: &Program,
        uniforms: UniformsOf<'_>,
        vertices: &[Vertex],
    ) -> Option<(Vec<DVec4>, FragmentInputs)> {
        let outputs = self.run_vertices(program, uniforms, vertices)?;
        let written = (0..program.outputs().len()).map(|place| scalars(&outputs, place)).collect();
        Some((positions(&outputs, vertices.len()), written))
    }

    /// What the equation reads at a fragment.
    pub(super) fn read_at(&self, at: usize, handed: &FragmentInputs, colour: DVec3, position: DVec4) -> Vec<Value> {
        match self.equation.reads {
            Reads::Outputs => vec![Value::from(colour.extend(1.0)), Value::from(position)],
            Reads::Attributes | Reads::Varyings => {
                let pipeline = &self.pipeline;
                let value = |(place, input): (usize, &ProgramVariable)| {
                    let varying = pipeline.varyings.iter().find(|varying| varying.input == place);
                    let numbers = varying.map_or_else(Vec::new, |varying| {
                        handed[varying.output].iter().map(|column| column[at]).collect()
                    });
                    Value::new(input.kind.clone(), numbers)
                        .unwrap_or_else(|| Value::of(input.kind.clone(), vec![0.0; input.kind.slots().unwrap_or(0)]))
                };
                pipeline.fragment.inputs().iter().enumerate().map(value).collect()
            }
        }
    }
}

/// What the right vertex stage hands over at fragments, and at the pixels beside them where somebody looks at these.
pub(super) fn known(pipeline: &Pipeline, spots: &[&Spot]) -> HandedAround {
    let at = |values: &dyn Fn(&Spot) -> &[(String, Value)]| -> FragmentInputs {
        let scalar = |output: usize, scalar: usize| {
            spots.iter().map(|spot| values(spot)[output].1.numbers()[scalar]).collect::<Vec<f64>>()
        };
        let outputs = pipeline.vertex.outputs().iter().map(|output| output.kind.slots().unwrap_or(0)).enumerate();
        outputs.map(|(output, count)| (0..count).map(|number| scalar(output, number)).collect()).collect()
    };
    let beside = |pixel: usize| match pipeline.has_derivatives() {
        true => at(&|spot| &spot.varyings_beside[pixel]),
        false => FragmentInputs::new(),
    };
    [at(&|spot| &spot.varyings), beside(0), beside(1)]
}

/// What is interpolated at fragments, and at the pixels beside them where somebody looks at these. `positions`: those of the corners,
/// in clip space.
pub(crate) fn handed_at(
    pipeline: &Pipeline,
    written: &FragmentInputs,
    positions: &[DVec4],
    spots: &[&Spot],
    with_beside: bool,
) -> HandedAround {
    let mixed = |weights: &dyn Fn(&Spot) -> [f64; 3]| {
        let shares: Vec<_> = spots.iter().map(|spot| weights(spot)).enumerate().collect();
        mixed(pipeline, written, positions, &shares)
    };
    let beside = |pixel: usize| match with_beside {
        true => mixed(&|spot| spot.weights_beside[pixel]),
        false => FragmentInputs::new(),
    };
    [mixed(&|spot| spot.weights), beside(0), beside(1)]
}

/// What is interpolated at fragments: the number of each triangle, and the shares of its corners. How, the fragment stage
/// says. `positions` are those of the corners, in clip space.
pub(super) fn mixed(
    pipeline: &Pipeline,
    written: &FragmentInputs,
    positions: &[DVec4],
    shares: &[(usize, [f64; 3])],
) -> FragmentInputs {
    let linear: Vec<_> = shares
        .iter()
        .map(|(triangle, weights)| {
            (*triangle, linear(*weights, std::array::from_fn(|corner| positions[3 * triangle + corner].w)))
        })
        .collect();
    let output = |((place, output), columns): ((usize, &ProgramVariable), &Vec<Vec<f64>>)| {
        let read = pipeline.varyings.iter().find(|varying| varying.output == place);
        let interpolation = match output.kind.scalar() {
            Some(Scalar::Float | Scalar::Double) | None => read.map_or(output.interpolation, |read| read.interpolation),
            _ => Interpolation::Flat,
        };
        let shares = if interpolation == Interpolation::NoPerspective { &linear } else { shares };
        let at = |column: &Vec<f64>, (triangle, weights): &(usize, [f64; 3])| match interpolation {
            Interpolation::Flat => column[3 * triangle + 2],
            _ => (0..3).map(|corner| weights[corner] * column[3 * triangle + corner]).sum(),
        };
        columns.iter().map(|column| shares.iter().map(|share| at(column, share)).collect()).collect()
    };
    pipeline.vertex.outputs().iter().enumerate().zip(written).map(output).collect()
}

/// Shares of three corners in the window, where `noperspective` mixes, from those in space; `w` is that of the corners in
/// clip space.
pub fn linear(shares: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    let seen: [f64; 3] = std::array::from_fn(|corner| shares[corner] * w[corner]);
    let sum: f64 = seen.iter().sum();
    seen.map(|share| share / sum)
}
