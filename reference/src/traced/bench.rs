//! Runs a program at some probes, with values on its way looked at or changed.

use super::inputs::{QUAD, fragment_run, vertex_run};
use super::{Place, Seen, TracedProgram};
use crate::Assignment;
use crate::equation::{DISCARDED, Reads};
use crate::interpreter::trace::{Trace, ValueChange};
use crate::interpreter::{Outputs, Prepared, Stage, Undefined, UndefinedCause};
use crate::pipeline::{POSITION, positions, scalars};
use crate::probes::{FragmentInputs, Spot, handed_at};
use glam::{DVec3, DVec4};

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
            bench.fragment = Some(fragment_run(assignment, program, places, each, fuel)?);
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
        let mut undefined = None;
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
                let undefined = undefined_colour(&outputs, self.colour, 0..count);
                return Some(Seen { colours, positions, undefined: undefined.map(|cause| (Stage::Vertex, cause)) });
            }
            undefined = outputs.outputs.iter().find_map(|output| output.first_undefined(|_| true));
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
        let is_kept = |lane: &usize| !outputs.discarded[*lane];
        let lanes = (0..count).map(|probe| probe * self.each).filter(is_kept);
        let undefined = undefined_colour(&outputs, self.colour, lanes).map(|cause| match undefined {
            // What the vertex stage hands over is no number.
            Some(before) if cause.what == Undefined::NotANumber => (Stage::Vertex, before),
            _ => (Stage::Fragment, cause),
        });
        Some(Seen { colours: (0..count).map(shown).collect(), positions, undefined })
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
}

/// Why the colour of the first of these lanes is undefined that is.
fn undefined_colour(
    outputs: &Outputs,
    colour: usize,
    mut lanes: impl Iterator<Item = usize>,
) -> Option<UndefinedCause> {
    let colour = outputs.outputs.get(colour)?;
    let channels = colour.values.len().min(3);
    lanes.find_map(|lane| (0..channels).find_map(|channel| colour.undefined(channel, lane)))
}

fn colour(columns: &[Vec<f64>], lane: usize) -> DVec3 {
    let channel = |at: usize| columns.get(at).map_or(0.0, |column| column[lane]);
    DVec3::new(channel(0), channel(1), channel(2))
}
