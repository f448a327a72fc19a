//! What the stages of a program are given at some probes.

use super::{Place, TracedProgram};
use crate::assignment::Input;
use crate::equation::Reads;
use crate::interpreter::{Interpolation, Prepared, Program, ProgramVariable, Scalar};
use crate::pipeline::{Pipeline, Varying, columns};
use crate::probes::Spot;
use crate::scene::Vertex;
use crate::{Assignment, Value};

/// The four pixels of a quad, row by row from below.
pub(super) const QUAD: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

/// A probe's fragment, and how far beside it a lane is.
type QuadLane<'p> = (&'p Spot, [f64; 2]);

/// The fragment stage at the probes, fed with all but what a vertex stage that is handed in hands over.
pub(super) fn fragment_run<'p>(
    assignment: &'p Assignment,
    program: &'p TracedProgram,
    places: &[Place<'p>],
    each: usize,
    fuel: u64,
) -> Option<Prepared<'p>> {
    let pipeline = program.pipeline.as_ref()?;
    let fragment: &'p Program = &program.fragment;
    let spots = places.iter().map(|place| place.probe.spot.as_deref()).collect::<Option<Vec<&'p Spot>>>()?;
    let lanes: Vec<QuadLane<'p>> =
        spots.iter().flat_map(|spot| QUAD[..each].iter().map(|beside| (*spot, *beside))).collect();
    let mut given: Vec<(&str, Vec<Vec<f64>>)> = Vec::new();
    for (number, input) in fragment.inputs().iter().enumerate() {
        let columns = match input.name.as_str() {
            "gl_FragCoord" => (0..4)
                .map(|axis| {
                    let at =
                        |(spot, beside): &QuadLane<'_>| spot.place[axis] + beside.get(axis).copied().unwrap_or(0.0);
                    lanes.iter().map(at).collect()
                })
                .collect(),
            "gl_FrontFacing" => vec![lanes.iter().map(|(spot, _)| f64::from(u8::from(spot.is_front))).collect()],
            _ => match pipeline.varyings.iter().find(|varying| varying.input == number) {
                Some(varying) => handed(pipeline, varying, input, &lanes),
                None => continue,
            },
        };
        given.push((&input.name, columns));
    }
    given.extend(uniforms(assignment, fragment, places, each));
    prepared(assignment, fragment, lanes.len(), &given, fuel)
}

/// What the probes' own vertex stage hands over to an input of the fragment stage; 0 where another stage does that later.
fn handed(pipeline: &Pipeline, varying: &Varying, input: &ProgramVariable, lanes: &[QuadLane<'_>]) -> Vec<Vec<f64>> {
    let output = &pipeline.vertex.outputs()[varying.output];
    let value = |(spot, at): &QuadLane<'_>| -> Option<Value> {
        let [right, above] = &spot.varyings_beside;
        let (here, right, above) = (written(&spot.varyings, output)?, written(right, output)?, written(above, output)?);
        if is_flat(output) {
            return Some(here.clone());
        }
        let beside = right.numbers().iter().zip(above.numbers());
        let numbers = here.numbers().iter().zip(beside);
        let numbers = numbers.map(|(here, (right, above))| pipeline.at_pixel(*here, [*right, *above], *at));
        Value::new(here.kind().clone(), numbers.collect())
    };
    let values: Option<Vec<Value>> = lanes.iter().map(value).collect();
    match values {
        Some(values) => columns(input, values.iter()),
        None => vec![vec![0.0; lanes.len()]; input.kind.slots().unwrap_or(0)],
    }
}

fn written<'a>(all: &'a [(String, Value)], output: &ProgramVariable) -> Option<&'a Value> {
    all.iter().find(|(name, _)| *name == output.name).map(|(_, value)| value)
}

fn is_flat(output: &ProgramVariable) -> bool {
    output.interpolation == Interpolation::Flat
        || !matches!(output.kind.scalar(), Some(Scalar::Float | Scalar::Double) | None)
}

/// The uniforms that a program has, a column for each scalar.
fn uniforms<'a>(
    assignment: &Assignment,
    program: &'a Program,
    places: &[Place<'_>],
    each: usize,
) -> Vec<(&'a str, Vec<Vec<f64>>)> {
    let own = assignment.interface.uniforms.iter().enumerate().filter_map(|(number, uniform)| {
        let variable = program.uniforms().iter().find(|own| uniform.is(own))?;
        let values = places.iter().flat_map(|place| std::iter::repeat_n(&place.uniforms[number], each));
        Some((variable.name.as_str(), columns(variable, values)))
    });
    own.collect()
}

/// The vertex stage at the probes: once for each, or for the three corners of its triangle.
pub(super) fn vertex_run<'p>(
    assignment: &'p Assignment,
    program: &'p Program,
    places: &[Place<'p>],
    fuel: u64,
) -> Option<Prepared<'p>> {
    let is_single = assignment.equation.reads() == Reads::Attributes;
    let corners = if is_single { 1 } else { 3 };
    let mut given: Vec<(&str, Vec<Vec<f64>>)> = Vec::new();
    for input in program.inputs() {
        let inputs = &assignment.interface.inputs;
        let place =
            Input::fed(inputs, program, input).and_then(|fed| inputs.iter().position(|own| own.name == fed.name));
        let columns = match place {
            Some(place) if is_single => columns(input, places.iter().map(|at| &at.probe.attributes[place])),
            Some(place) => {
                let own = &assignment.interface.inputs[place];
                let spots = places.iter().map(|at| at.probe.spot.as_deref()).collect::<Option<Vec<&Spot>>>()?;
                let corners = spots.iter().flat_map(|spot| &spot.corners);
                let values: Vec<Value> = corners.map(|vertex| own.stream.value(&own.kind, vertex)).collect();
                columns(input, values.iter())
            }
            None if let Some(number) = Vertex::number_by(&input.name) => {
                let number = |at: &Place<'_>| match at.probe.spot.as_deref() {
                    Some(spot) if !is_single => spot.corners.map(|vertex| f64::from(number(&vertex))).to_vec(),
                    _ => vec![f64::from(number(&at.probe.vertex))],
                };
                vec![places.iter().flat_map(number).collect()]
            }
            None => continue,
        };
        given.push((&input.name, columns));
    }
    given.extend(uniforms(assignment, program, places, corners));
    prepared(assignment, program, corners * places.len(), &given, fuel)
}

fn prepared<'p>(
    assignment: &'p Assignment,
    program: &'p Program,
    lanes: usize,
    given: &[(&str, Vec<Vec<f64>>)],
    fuel: u64,
) -> Option<Prepared<'p>> {
    let mut prepared = program.prepared(lanes, &assignment.textures, fuel);
    for (name, columns) in given {
        prepared.feed(name, columns).ok()?;
    }
    Some(prepared)
}
