//! A second opinion: what the interpreter of `reference` computes for a file, held against what the driver computed.
//!
//! The two share no compiler and no translator. The driver's values are what is judged; where the interpreter has
//! others, a teacher is told. It meets the student's text, and is called in a worker only.

use crate::language::Text;
use crate::render::{Batch, Sample};
use reference::interpreter::{Mismatch, Outputs, Precision, Program, Run, Stage, Stopped};
use serde::{Deserialize, Serialize};

/// Steps that one run may take: a tenth of a second or two, so that a second opinion does not make a grading late. That is
/// 90,000 operations for each vertex of ggsample06, of which a usual answer takes 300.
const FUEL: u64 = 60_000_000;
/// Largest difference of a value, relative to it where it is more than 1: x^80 in f32 loses five of seven digits at worst.
const TOLERANCE: f64 = 1e-3;
/// A value that rounding to f32 moves may be this many times as far off: drivers round other steps than we do.
const ROUNDING_SLACK: f64 = 16.0;
/// Values from here on may be infinite for a driver: a quarter of the largest float.
const NEARLY_INFINITE: f64 = 8e37;

/// The output that every vertex stage has.
const POSITION: &str = "gl_Position";

/// How the two opinions relate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Opinion {
    /// All defined values agree.
    Agrees,
    /// Some defined values differ: one of the two is wrong.
    Differs,
    /// The interpreter does not know something that the file uses, or used up its steps.
    NotRun,
}

/// The second opinion on one file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CrossCheck {
    /// How the two relate.
    pub opinion: Opinion,
    /// How many vertices agree.
    pub agreeing: u32,
    /// How many vertices have a value that GLSL leaves undefined, all others agreeing.
    pub undefined: u32,
    /// How many have a value that depends on how the driver rounds, all others agreeing.
    pub unsettled: u32,
    /// How many differ.
    pub differing: u32,
    /// The first difference, or why nothing was run.
    pub message: Option<Text>,
    /// The line of the student's file that the message is about, from 1.
    pub line: Option<u32>,
}

/// What is said of one value, the stronger last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Relation {
    /// They agree.
    Agrees,
    /// It depends on how a driver rounds.
    Unsettled,
    /// GLSL leaves it undefined.
    Undefined,
    /// They differ.
    Differs,
}

/// Holds a driver's value against the interpreter's, computed in f64 and rounded to f32 after each step.
pub fn relation(driver: f32, exact: f64, single: f64) -> Relation {
    let driver = f64::from(driver);
    let is_near = |a: f64, b: f64| (a - b).abs() <= TOLERANCE * b.abs().max(1.0) || a == b;
    let is_huge = |a: f64| a.abs() >= NEARLY_INFINITE;
    if is_near(driver, exact) || is_near(driver, single) || (is_huge(driver) && is_huge(exact)) {
        return Relation::Agrees;
    }
    let moved = (exact - single).abs();
    if !moved.is_finite()
        || moved > TOLERANCE * exact.abs().max(1.0)
        || (driver - exact).abs() <= ROUNDING_SLACK * moved
    {
        return Relation::Unsettled;
    }
    Relation::Differs
}

/// Runs the file's text on the vertices that the driver had, and compares colours and positions.
pub fn check(text: &str, output: &str, batches: &[&Batch], samples: &[&[Sample]]) -> CrossCheck {
    let program = match Program::compile(text, Stage::Vertex) {
        Ok(program) => program,
        Err(refusal) => return CrossCheck::not_run(&refusal.to_string(), Some(refusal.line)),
    };
    let vertices = Vertices::new(batches, samples);
    let run = |precision| vertices.run(&program, precision);
    match run(Precision::Exact).and_then(|exact| Ok((exact, run(Precision::Single)?))) {
        Ok((exact, single)) => {
            let mut judged = judge(&vertices, output, &exact, &single);
            // What hangs on the last bits of a result, as a sine of a large number does, is no difference.
            for way in 0..4 {
                if judged.iter().any(|one| one.relation == Relation::Differs)
                    && let Ok(noisy) = run(Precision::Noisy(way))
                {
                    settle(&mut judged, output, &exact, &noisy);
                }
            }
            summed_up(judged)
        }
        Err(not_run) => not_run,
    }
}

impl CrossCheck {
    fn not_run(why: &str, line: Option<u32>) -> Self {
        let message = Text::new(
            format!("the interpreter did not run this file: {why}"),
            format!("インタープリターでは実行できませんでした: {why}"),
        );
        Self {
            opinion: Opinion::NotRun,
            agreeing: 0,
            undefined: 0,
            unsettled: 0,
            differing: 0,
            message: Some(message),
            line: line.filter(|&line| line > 0),
        }
    }
}

/// All vertices as columns.
struct Vertices<'a> {
    /// By name, x, y, z and 1.
    attributes: Vec<(&'a str, [Vec<f64>; 4])>,
    /// By name, the scalars of a matrix.
    uniforms: Vec<(&'a str, Vec<Vec<f64>>)>,
    /// The number of each vertex in its draw.
    numbers: Vec<f64>,
    /// Attributes that nobody sets are 0, 0, 0, 1.
    zeros: Vec<f64>,
    ones: Vec<f64>,
    samples: Vec<&'a Sample>,
}

impl<'a> Vertices<'a> {
    fn new(batches: &[&'a Batch], samples: &[&'a [Sample]]) -> Self {
        let samples: Vec<&Sample> = samples.iter().copied().flatten().collect();
        let mut vertices = Self {
            attributes: Vec::new(),
            uniforms: Vec::new(),
            numbers: Vec::new(),
            zeros: vec![0.0; samples.len()],
            ones: vec![1.0; samples.len()],
            samples,
        };
        let Some(first) = batches.first() else { return vertices };
        let length = |batch: &Batch| batch.attributes.first().map_or(0, |(_, values)| values.len());
        for (index, (name, _)) in first.attributes.iter().enumerate() {
            let values = || batches.iter().flat_map(|batch| &batch.attributes[index].1);
            let column = |axis: usize| values().map(|xyz| f64::from(xyz[axis])).collect();
            vertices.attributes.push((name, [column(0), column(1), column(2), vertices.ones.clone()]));
        }
        for (index, (name, _)) in first.uniforms.iter().enumerate() {
            let column = |scalar: usize| {
                let each =
                    |batch: &&Batch| std::iter::repeat_n(f64::from(batch.uniforms[index].1[scalar]), length(batch));
                batches.iter().flat_map(each).collect()
            };
            vertices.uniforms.push((name, (0..16).map(column).collect()));
        }
        vertices.numbers = batches.iter().flat_map(|batch| (0..length(batch)).map(|number| number as f64)).collect();
        vertices
    }

    /// The outputs of all vertices, or why there are none.
    fn run(&self, program: &Program, precision: Precision) -> Result<Outputs, CrossCheck> {
        let fed = self.feed(program).map_err(|mismatch| CrossCheck::not_run(&mismatch.to_string(), None))?;
        let stopped = |at: Stopped| CrossCheck::not_run("the interpreter used up its steps", Some(at.line));
        fed.precision(precision).fuel(FUEL).outputs().map_err(stopped)
    }

    fn feed<'b>(&'b self, program: &'b Program) -> Result<Run<'b>, Mismatch> {
        let mut run = program.run(self.samples.len());
        for input in program.inputs() {
            let given = self.attributes.iter().find(|(name, _)| *name == input.name);
            let count = input.kind.slots().unwrap_or(0);
            let columns: Vec<&[f64]> = match given {
                _ if input.name == "gl_VertexID" => vec![&self.numbers],
                _ if input.name.starts_with("gl_") => continue,
                Some((_, columns)) => columns.iter().take(count).map(Vec::as_slice).collect(),
                None => {
                    [&self.zeros, &self.zeros, &self.zeros, &self.ones].map(Vec::as_slice).repeat(count.div_ceil(4))
                }
            };
            run = run.input(&input.name, &columns[..count.min(columns.len())])?;
        }
        for (name, columns) in &self.uniforms {
            if program.uniforms().iter().any(|uniform| uniform.name == *name) {
                let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
                run = run.uniform_of_each(name, &columns)?;
            }
        }
        Ok(run)
    }
}

/// What is said of one vertex, and its first value that differs.
struct Judged {
    relation: Relation,
    message: Option<Text>,
}

fn judge(vertices: &Vertices<'_>, output: &str, exact: &Outputs, single: &Outputs) -> Vec<Judged> {
    let judge_one = |(index, sample): (usize, &&Sample)| {
        let mut judged = Judged { relation: Relation::Agrees, message: None };
        for (name, values) in [(output, &sample.colour), (POSITION, &sample.position)] {
            let (Some(exact), Some(single)) = (exact.get(name), single.get(name)) else { continue };
            for (scalar, (&driver, column)) in values.iter().zip(&exact.values).enumerate() {
                let value = column[index];
                let relation = match exact.undefined(scalar, index).or(single.undefined(scalar, index)) {
                    Some(_) => Relation::Undefined,
                    None => relation(driver, value, single.values[scalar][index]),
                };
                if relation == Relation::Differs && judged.message.is_none() {
                    let place = format!("{name}[{scalar}]");
                    judged.message = Some(Text::new(
                        format!("vertex {index}: {place} is {driver} for the driver and {value} for the interpreter"),
                        format!("頂点 {index}: {place} はドライバーでは {driver}, インタープリターでは {value} です"),
                    ));
                }
                judged.relation = judged.relation.max(relation);
            }
        }
        judged
    };
    vertices.samples.iter().enumerate().map(judge_one).collect()
}

/// What noise in the last bits moves is no difference between driver and interpreter.
fn settle(judged: &mut [Judged], output: &str, exact: &Outputs, noisy: &Outputs) {
    for (index, one) in judged.iter_mut().enumerate().filter(|(_, one)| one.relation == Relation::Differs) {
        let moves = |name: &&str| {
            let (Some(exact), Some(noisy)) = (exact.get(name), noisy.get(name)) else { return false };
            exact.values.iter().zip(&noisy.values).any(|(exact, noisy)| {
                let (exact, moved) = (exact[index], (exact[index] - noisy[index]).abs());
                moved.is_nan() || moved > TOLERANCE * exact.abs().max(1.0)
            })
        };
        if [output, POSITION].iter().any(moves) {
            *one = Judged { relation: Relation::Unsettled, message: None };
        }
    }
}

fn summed_up(judged: Vec<Judged>) -> CrossCheck {
    let count = |relation| judged.iter().filter(|one| one.relation == relation).count() as u32;
    let differing = count(Relation::Differs);
    CrossCheck {
        opinion: if differing > 0 { Opinion::Differs } else { Opinion::Agrees },
        agreeing: count(Relation::Agrees),
        undefined: count(Relation::Undefined),
        unsettled: count(Relation::Unsettled),
        differing,
        message: judged.into_iter().find_map(|one| one.message),
        line: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn batch(x: &[f32]) -> Batch {
        Batch {
            uniforms: vec![("m".into(), std::array::from_fn(|n| n as f32))],
            attributes: vec![("p".into(), x.iter().map(|&x| [x, 2.0, 3.0]).collect())],
        }
    }

    fn sample(colour: [f32; 4]) -> Sample {
        Sample { position: [0.0; 4], colour }
    }

    const TEXT: &str = "in vec4 p; uniform mat4 m; out vec4 c;\n\
        void main() { c = vec4(p.x, m[1].x, p.w, gl_VertexID); gl_Position = vec4(0.0); }";

    #[test]
    fn vertices_have_their_attributes_matrices_and_numbers() {
        let batches = [batch(&[5.0, 6.0]), batch(&[7.0])];
        let samples =
            [vec![sample([5.0, 4.0, 1.0, 0.0]), sample([6.0, 4.0, 1.0, 1.0])], vec![sample([7.0, 4.0, 1.0, 0.0])]];
        let found = check(TEXT, "c", &batches.each_ref(), &samples.each_ref().map(Vec::as_slice));
        assert_eq!((found.opinion, found.agreeing, found.message), (Opinion::Agrees, 3, None));
    }

    #[test]
    fn a_value_that_differs_is_named() {
        let found = check(TEXT, "c", &[&batch(&[5.0])], &[&[sample([5.0, 4.5, 1.0, 0.0])]]);
        assert_eq!((found.opinion, found.differing), (Opinion::Differs, 1));
        assert_eq!(found.message.unwrap().en, "vertex 0: c[1] is 4.5 for the driver and 4 for the interpreter");
    }

    #[test]
    fn what_is_undefined_or_not_known_is_no_difference() {
        let text = "in vec4 p; out vec4 c; void main() { float u; c = vec4(u); gl_Position = vec4(0.0); }";
        let found = check(text, "c", &[&batch(&[5.0])], &[&[sample([1.0; 4])]]);
        assert_eq!((found.opinion, found.undefined), (Opinion::Agrees, 1));
        let found = check("out vec4 c;\nvoid main() {\n c = noise4(1.0); }", "c", &[], &[]);
        assert_eq!((found.opinion, found.line), (Opinion::NotRun, Some(3)));
        let text = "out vec4 c; void main() { while (true) ; }";
        assert_eq!(check(text, "c", &[&batch(&[5.0])], &[&[sample([0.0; 4])]]).opinion, Opinion::NotRun);
    }

    #[test]
    fn what_hangs_on_the_last_bits_is_no_difference() {
        let text = "in vec4 p; out vec4 c; void main() { c = vec4(sin(p.x * 1e9)); gl_Position = vec4(0.0); }";
        let found = check(text, "c", &[&batch(&[1.7])], &[&[sample([0.25; 4])]]);
        assert_eq!((found.opinion, found.unsettled), (Opinion::Agrees, 1));
    }

    #[test]
    fn rounding_may_move_a_value_as_far_as_it_moves_ours() {
        assert_eq!(relation(1.000_5, 1.0, 1.0), Relation::Agrees);
        assert_eq!(relation(1.002, 1.0, 1.0), Relation::Differs);
        assert_eq!(relation(1.004, 1.0, 1.000_5), Relation::Unsettled);
        // A step function beside its edge.
        assert_eq!(relation(1.0, 0.0, 1.0), Relation::Agrees);
        assert_eq!(relation(f32::INFINITY, 3e38, 3e38), Relation::Agrees);
        assert_eq!(relation(f32::NAN, 1.0, 1.0), Relation::Differs);
    }
}
