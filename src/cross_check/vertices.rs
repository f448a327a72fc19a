//! What the driver was given, as the interpreter takes it.

use crate::language::Text;
use crate::render::DrawCall;
use crate::report::CrossCheck;
use reference::assignment::{Input, Interface};
use reference::interpreter::{Mismatch, Outputs, Precision, Program, Run, Stopped};
use reference::pipeline::{LACKING, UniformSource};

/// Steps that one run may take: a tenth of a second or two, so that a second opinion does not make a grading late. That is
/// 90,000 operations for each vertex of ggsample06, of which a usual answer takes 300.
const FUEL: u64 = 60_000_000;

/// All vertices as columns.
pub(super) struct VertexColumns<'a> {
    /// By name, x, y, z and w.
    attributes: Vec<(&'a str, [Vec<f64>; 4])>,
    /// The scalars of each, in the order of the interface.
    uniforms: Vec<Vec<Vec<f64>>>,
    /// The number of each vertex in its draw.
    numbers: Vec<f64>,
    /// Attributes that nobody sets are 0, 0, 0, 1.
    zeros: Vec<f64>,
    ones: Vec<f64>,
}

impl<'a> VertexColumns<'a> {
    pub fn new(batches: &[&'a DrawCall]) -> Self {
        let length = |batch: &DrawCall| batch.attributes.first().map_or(0, |(_, values)| values.len());
        let count = batches.iter().map(|batch| length(batch)).sum();
        let mut vertices = Self {
            attributes: Vec::new(),
            uniforms: Vec::new(),
            numbers: Vec::new(),
            zeros: vec![0.0; count],
            ones: vec![1.0; count],
        };
        let Some(first) = batches.first() else { return vertices };
        for (index, (name, _)) in first.attributes.iter().enumerate() {
            let values = || batches.iter().flat_map(|batch| batch.attributes[index].1.iter());
            let of = |numbers: &[f64], axis: usize| numbers.get(axis).copied().unwrap_or(LACKING[axis]);
            let column = |axis: usize| values().map(|numbers| of(numbers, axis)).collect();
            vertices.attributes.push((name, std::array::from_fn(column)));
        }
        for (index, (_, value)) in first.uniforms.iter().enumerate() {
            let column = |scalar: usize| {
                let each =
                    |batch: &&DrawCall| std::iter::repeat_n(batch.uniforms[index].1.numbers()[scalar], length(batch));
                batches.iter().flat_map(each).collect()
            };
            vertices.uniforms.push((0..value.numbers().len()).map(column).collect());
        }
        vertices.numbers = batches.iter().flat_map(|batch| (0..length(batch)).map(|number| number as f64)).collect();
        vertices
    }

    /// The outputs of all vertices, or why there are none.
    pub fn run(&self, program: &Program, interface: &Interface, precision: Precision) -> Result<Outputs, CrossCheck> {
        let fed = self
            .feed(program, interface)
            .map_err(|mismatch| CrossCheck::not_run(Text::verbatim(mismatch.to_string()), None))?;
        let used_up = || Text::new("the interpreter used up its steps", "実行ステップ数の上限に達しました");
        let stopped = |at: Stopped| CrossCheck::not_run(used_up(), Some(at.line));
        fed.precision(precision).fuel(FUEL).outputs().map_err(stopped)
    }

    fn feed<'b>(&'b self, program: &'b Program, interface: &Interface) -> Result<Run<'b>, Mismatch> {
        let mut run = program.run(self.numbers.len());
        for input in program.inputs() {
            let fed = Input::fed(&interface.inputs, program, input).map_or(&input.name, |fed| &fed.name);
            let given = self.attributes.iter().find(|(name, _)| name == fed);
            let count = input.kind.slots().unwrap_or(0);
            let columns: Vec<&[f64]> = match given {
                _ if input.name == "gl_VertexID" => vec![&self.numbers],
                None if input.name.starts_with("gl_") => continue,
                Some((_, columns)) => columns.iter().take(count).map(Vec::as_slice).collect(),
                None => {
                    [&self.zeros, &self.zeros, &self.zeros, &self.ones].map(Vec::as_slice).repeat(count.div_ceil(4))
                }
            };
            run = run.input(&input.name, &columns[..count.min(columns.len())])?;
        }
        for own in program.uniforms() {
            let zeros = &self.zeros;
            let column = |place: usize, number: usize| {
                self.uniforms.get(place).and_then(|columns| columns.get(number)).unwrap_or(zeros).as_slice()
            };
            run = match interface.source(own) {
                None => run,
                Some(UniformSource::Whole(place)) => {
                    let count = own.kind.slots().unwrap_or(0);
                    run.uniform_of_each(&own.name, (0..count).map(|number| column(place, number)))?
                }
                Some(UniformSource::Numbers(numbers)) => {
                    let numbers = numbers.iter().map(|at| at.map_or(zeros.as_slice(), |(place, at)| column(place, at)));
                    run.uniform_of_each(&own.name, numbers)?
                }
            };
        }
        Ok(run)
    }
}
