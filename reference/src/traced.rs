//! A program run at some probes, with every value on its way looked at or changed.
//!
//! A stage that is handed in is compiled so that it can be traced; a fixed one runs as it is. Where the fragment stage is all
//! that is handed in, it is given exactly what the probes' own vertex stage hands over.

use crate::Text;
use crate::equation::{DISCARDED, Reads};
use crate::interpreter::trace::{Trace, ValueChange};
use crate::interpreter::{Interpolation, Outputs, Prepared, Program, ProgramVariable, Scalar, Stage};
use crate::pipeline::{POSITION, Pipeline, Varying, columns, positions, scalars};
use crate::probes::{FragmentInputs, Probe, Spot, handed_at};
use crate::{Assignment, Value};
use glam::{DVec3, DVec4};
use std::sync::Arc;

/// The four pixels of a quad, row by row from below.
const QUAD: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

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

/// What is seen of a program at each probe.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The colour as the homework's target holds it; [`DISCARDED`] where it is thrown away, no number where it is undefined.
    pub colours: Vec<DVec3>,
    /// The position of the vertex, or of the triangle's first corner, where a vertex stage is handed in.
    pub positions: Vec<DVec4>,
}

/// A program at some probes.
#[derive(Debug)]
pub struct Bench<'p> {
    program: &'p TracedProgram,
    reads: Reads,
    spots: Vec<Option<&'p Spot>>,
    vertex: Option<Prepared<'p>>,
    fragment: Option<Prepared<'p>>,
    /// How many lanes of the fragment stage a probe takes.
    each: usize,
    colour: usize,
    /// Whether colours are held in fixed point, from 0 to 1.
    clamps: bool,
    /// Whether what GLSL leaves undefined is no number.
    is_strict: bool,
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

    /// The program of the right answer.
    ///
    /// # Errors
    /// Why it cannot be run.
    pub fn solution(assignment: &Assignment) -> Result<Self, Text> {
        let texts: Vec<(Stage, &str)> =
            assignment.files.iter().map(|file| (file.stage.into(), file.solution.text.as_str())).collect();
        Self::new(assignment, &texts)
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

    /// The output of the vertex stage, by its place, that an input of the fragment stage is interpolated from.
    pub fn interpolated_from(&self, input: &str) -> Option<usize> {
        let pipeline = self.pipeline.as_ref()?;
        let is_it = |varying: &&Varying| pipeline.fragment.inputs()[varying.input].name == input;
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

impl<'p> Bench<'p> {
    /// Makes ready. `fuel`: the steps of all runs together.
    pub fn new(
        assignment: &'p Assignment,
        program: &'p TracedProgram,
        places: &[Place<'p>],
        in_quads: bool,
        fuel: u64,
    ) -> Option<Self> {
        let reads = assignment.equation.reads();
        let each = if in_quads { 4 } else { 1 };
        let mut bench = Self {
            program,
            reads,
            spots: places.iter().map(|place| place.probe.spot.as_deref()).collect(),
            vertex: None,
            fragment: None,
            each,
            clamps: reads != Reads::Attributes,
            is_strict: true,
            colour: program.pipeline.as_ref().map_or(0, |pipeline| pipeline.colour),
        };
        if reads == Reads::Attributes {
            let name = &assignment.interface.outputs.first()?.name;
            bench.colour = program.vertex.outputs().iter().position(|output| output.name == *name)?;
        }
        if program.handed_in[0] || reads == Reads::Attributes {
            bench.vertex = Some(vertex_run(assignment, &program.vertex, places, fuel)?);
        }
        if reads != Reads::Attributes {
            bench.fragment = Some(bench.fragment_run(assignment, places, fuel)?);
        }
        Some(bench)
    }

    /// The same where colours are seen as they are written, and what is no number or beyond `most` becomes 0 wherever it is computed.
    pub fn bounded(mut self, most: f64) -> Self {
        self.clamps = false;
        self.vertex.iter_mut().chain(&mut self.fragment).for_each(|prepared| prepared.bound(most));
        self
    }

    /// The same where what GLSL leaves undefined is what f64 computes, as a driver shows something.
    pub fn lenient(mut self) -> Self {
        self.is_strict = false;
        self
    }

    /// Runs it with some values changed and every value recorded: what is seen, and the traces of the stages that are handed in.
    pub fn trace(&mut self, changes: &[Vec<ValueChange>; 2]) -> Option<(Seen, [Option<Trace>; 2])> {
        let mut traces = [None, None];
        let seen = self.go(&mut |stage, prepared| {
            let (outputs, trace) = prepared.trace(&changes[stage as usize]).ok()??;
            traces[stage as usize] = Some(trace);
            Some(outputs)
        })?;
        for (trace, is_handed_in) in traces.iter_mut().zip(self.program.handed_in) {
            if !is_handed_in {
                *trace = None;
            }
        }
        Some((seen, traces))
    }

    /// What is seen when some values of the stages are others.
    pub fn with(&mut self, changes: &[Vec<ValueChange>; 2]) -> Option<Seen> {
        self.go(&mut |stage, prepared| prepared.outputs(&changes[stage as usize]).ok())
    }

    fn go(&mut self, run: &mut dyn FnMut(Stage, &mut Prepared<'p>) -> Option<Outputs>) -> Option<Seen> {
        let count = self.spots.len();
        let mut positions = vec![DVec4::W; count];
        if let Some(vertex) = &mut self.vertex {
            let outputs = run(Stage::Vertex, vertex)?;
            let corners = if self.reads == Reads::Attributes { 1 } else { 3 };
            let place = self.program.vertex.outputs().iter().position(|output| output.name == POSITION);
            if let Some(columns) = place.map(|place| scalars(&outputs, place)) {
                let of = |lane: usize| DVec4::from_array(std::array::from_fn(|axis| columns[axis][lane]));
                positions = (0..count).map(|probe| of(corners * probe)).collect();
            }
            if self.reads == Reads::Attributes {
                let columns = self.columns(&outputs);
                let colours = (0..count).map(|lane| colour(&columns, lane)).collect();
                return Some(Seen { colours, positions });
            }
            self.hand_over(&outputs)?;
        }
        let outputs = run(Stage::Fragment, self.fragment.as_mut()?)?;
        let columns = self.columns(&outputs);
        let shown = |probe: usize| match outputs.discarded[probe * self.each] {
            true => DISCARDED,
            false if !self.clamps => colour(&columns, probe * self.each),
            false => colour(&columns, probe * self.each).map(|channel| {
                // What is no number stays that.
                if channel.is_nan() { channel } else { channel.clamp(0.0, 1.0) }
            }),
        };
        Some(Seen { colours: (0..count).map(shown).collect(), positions })
    }

    fn columns(&self, outputs: &Outputs) -> Vec<Vec<f64>> {
        match outputs.outputs.get(self.colour) {
            Some(colour) if !self.is_strict => colour.values.clone(),
            _ => scalars(outputs, self.colour),
        }
    }

    /// Gives the fragment stage what the vertex stage wrote.
    fn hand_over(&mut self, outputs: &Outputs) -> Option<()> {
        let pipeline = self.program.pipeline.as_ref()?;
        let fragment = self.fragment.as_mut()?;
        let spots = self.spots.iter().copied().collect::<Option<Vec<&Spot>>>()?;
        let written = (0..pipeline.vertex.outputs().len()).map(|place| scalars(outputs, place)).collect();
        let positions = positions(outputs, 3 * spots.len());
        let [here, right, above] = handed_at(pipeline, &written, &positions, &spots, self.each > 1);
        for varying in &pipeline.varyings {
            let input = &pipeline.fragment.inputs()[varying.input];
            let of_scalar = |(scalar, own): (usize, &Vec<f64>)| {
                let beside =
                    |pixel: &FragmentInputs, at: usize| pixel.get(varying.output).map_or(0.0, |own| own[scalar][at]);
                let in_quad = |at: usize| {
                    let beside = [beside(&right, at), beside(&above, at)];
                    QUAD[..self.each].iter().map(move |pixel| pipeline.at_pixel(own[at], beside, *pixel))
                };
                (0..spots.len()).flat_map(in_quad).collect()
            };
            let columns: Vec<Vec<f64>> = here[varying.output].iter().enumerate().map(of_scalar).collect();
            fragment.feed(&input.name, &columns).ok()?;
        }
        Some(())
    }

    fn fragment_run(&self, assignment: &'p Assignment, places: &[Place<'p>], fuel: u64) -> Option<Prepared<'p>> {
        let pipeline = self.program.pipeline.as_ref()?;
        let program: &'p Program = &self.program.fragment;
        let spots = self.spots.iter().copied().collect::<Option<Vec<&'p Spot>>>()?;
        let quad = &QUAD[..self.each];
        let lanes: Vec<(&'p Spot, [f64; 2])> =
            spots.iter().flat_map(|spot| quad.iter().map(|beside| (*spot, *beside))).collect();
        let mut given: Vec<(&str, Vec<Vec<f64>>)> = Vec::new();
        for (number, input) in program.inputs().iter().enumerate() {
            let columns = match input.name.as_str() {
                "gl_FragCoord" => (0..4)
                    .map(|axis| {
                        let at = |(spot, beside): &(&Spot, [f64; 2])| {
                            spot.place[axis] + beside.get(axis).copied().unwrap_or(0.0)
                        };
                        lanes.iter().map(at).collect()
                    })
                    .collect(),
                "gl_FrontFacing" => vec![lanes.iter().map(|(spot, _)| f64::from(u8::from(spot.is_front))).collect()],
                _ => {
                    let Some(varying) = pipeline.varyings.iter().find(|varying| varying.input == number) else {
                        continue;
                    };
                    let output = &pipeline.vertex.outputs()[varying.output].name;
                    let value = |(spot, at): &(&'p Spot, [f64; 2])| -> Option<Value> {
                        let own = |all: &'p [(String, Value)]| all.iter().find(|(name, _)| name == output);
                        let [right, above] = &spot.varyings_beside;
                        let (here, right, above) = (own(&spot.varyings)?, own(right)?, own(above)?);
                        if is_flat(&pipeline.vertex.outputs()[varying.output]) {
                            return Some(here.1.clone());
                        }
                        let beside = right.1.numbers().iter().zip(above.1.numbers());
                        let numbers = here.1.numbers().iter().zip(beside);
                        let numbers =
                            numbers.map(|(here, (right, above))| pipeline.at_pixel(*here, [*right, *above], *at));
                        Value::new(here.1.kind().clone(), numbers.collect())
                    };
                    let values: Option<Vec<Value>> = lanes.iter().map(value).collect();
                    match values {
                        Some(values) => columns(input, values.iter()),
                        // The vertex stage hands it over later.
                        None => vec![vec![0.0; lanes.len()]; input.kind.slots().unwrap_or(0)],
                    }
                }
            };
            given.push((&input.name, columns));
        }
        given.extend(uniforms(assignment, program, places, self.each));
        prepared(assignment, program, lanes.len(), &given, fuel)
    }
}

fn is_flat(output: &ProgramVariable) -> bool {
    output.interpolation == Interpolation::Flat
        || !matches!(output.kind.scalar(), Some(Scalar::Float | Scalar::Double) | None)
}

fn colour(columns: &[Vec<f64>], lane: usize) -> DVec3 {
    let channel = |at: usize| columns.get(at).map_or(0.0, |column| column[lane]);
    DVec3::new(channel(0), channel(1), channel(2))
}

/// The uniforms that a program has, a column for each scalar.
fn uniforms<'a>(
    assignment: &'a Assignment,
    program: &Program,
    places: &[Place<'_>],
    each: usize,
) -> Vec<(&'a str, Vec<Vec<f64>>)> {
    let own = assignment.interface.uniforms.iter().enumerate().filter_map(|(number, uniform)| {
        let variable = program.uniforms().iter().find(|own| own.name == uniform.path)?;
        let values = places.iter().flat_map(|place| std::iter::repeat_n(&place.uniforms[number], each));
        Some((uniform.path.as_str(), columns(variable, values)))
    });
    own.collect()
}

fn vertex_run<'p>(
    assignment: &'p Assignment,
    program: &'p Program,
    places: &[Place<'p>],
    fuel: u64,
) -> Option<Prepared<'p>> {
    let is_single = assignment.equation.reads() == Reads::Attributes;
    let corners = if is_single { 1 } else { 3 };
    let mut given: Vec<(&str, Vec<Vec<f64>>)> = Vec::new();
    for input in program.inputs() {
        let place = assignment.interface.inputs.iter().position(|own| own.name == input.name);
        let columns = match place {
            Some(place) if is_single => columns(input, places.iter().map(|at| &at.probe.attributes[place])),
            Some(place) => {
                let own = &assignment.interface.inputs[place];
                let spots = places.iter().map(|at| at.probe.spot.as_deref()).collect::<Option<Vec<&Spot>>>()?;
                let corners = spots.iter().flat_map(|spot| &spot.corners);
                let values: Vec<Value> = corners.map(|vertex| own.stream.value(&own.kind, vertex)).collect();
                columns(input, values.iter())
            }
            None if input.name == "gl_VertexID" => {
                let number = |at: &Place<'_>| match at.probe.spot.as_deref() {
                    Some(spot) if !is_single => spot.corners.map(|vertex| f64::from(vertex.number)).to_vec(),
                    _ => vec![f64::from(at.probe.vertex.number)],
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
