//! What the driver computed held against what the interpreter does, value by value.

use crate::language::Text;
use crate::report::{CrossCheck, Opinion};
use reference::interpreter::{Outputs, Precision, Undefined};

/// Largest difference of a value, relative to it where it is more than 1: x^80 in f32 loses five of seven digits at worst.
pub(super) const TOLERANCE: f64 = 1e-3;
/// A value that rounding to f32 moves may be this many times as far off: drivers round other steps than we do.
const ROUNDING_SLACK: f64 = 16.0;
/// Values from here on may be infinite for a driver: a quarter of the largest float.
const NEARLY_INFINITE: f64 = 8e37;

/// What is said of one value, the stronger last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Relation {
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
fn relation(driver: f32, exact: f64, single: f64) -> Relation {
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

/// What the driver computed.
#[derive(Clone, Debug)]
pub struct DriverOutput<'a> {
    /// Outputs of four scalars by name, of every vertex or fragment.
    pub outputs: Vec<(&'a str, Vec<[f32; 4]>)>,
    /// Which fragments it threw away; empty for vertices.
    pub discarded: Vec<bool>,
}

/// Compares what the driver computed with what `run` does, which is asked in as many ways of rounding as it takes to tell
/// what differs from what depends on rounding.
pub fn compare(drawn: &DriverOutput<'_>, run: impl Fn(Precision) -> Result<Outputs, CrossCheck>) -> CrossCheck {
    match run(Precision::Exact).and_then(|exact| Ok((exact, run(Precision::Single)?))) {
        Ok((exact, single)) => {
            let mut judged = judge(drawn, &exact, &single);
            // What depends on the last bits of a result, as a sine of a large number does, is no difference.
            for way in 0..4 {
                if judged.iter().any(|one| one.relation == Relation::Differs)
                    && let Ok(noisy) = run(Precision::Noisy(way))
                {
                    settle(&mut judged, drawn, &exact, &noisy);
                }
            }
            summed_up(judged)
        }
        Err(not_run) => not_run,
    }
}

/// What is said of one vertex, and its first value that differs.
pub(super) struct VertexOpinion {
    pub relation: Relation,
    pub message: Option<Text>,
}

fn judge(drawn: &DriverOutput<'_>, exact: &Outputs, single: &Outputs) -> Vec<VertexOpinion> {
    let judge_one = |index: usize| {
        let mut judged = VertexOpinion { relation: Relation::Agrees, message: None };
        let is_discarded = exact.discarded[index];
        let agrees = drawn.discarded.get(index).is_none_or(|discarded| *discarded == is_discarded);
        for (name, values) in &drawn.outputs {
            let (Some(exact), Some(single)) = (exact.get(name), single.get(name)) else { continue };
            for (scalar, (&driver, column)) in values[index].iter().zip(&exact.values).enumerate() {
                let value = column[index];
                let cause = exact.undefined(scalar, index).or(single.undefined(scalar, index));
                let relation = match cause {
                    // Of what is thrown away nothing is seen.
                    _ if is_discarded && agrees => Relation::Agrees,
                    Some(cause) if agrees || cause.what != Undefined::Unwritten => Relation::Undefined,
                    None if agrees => relation(driver, value, single.values[scalar][index]),
                    _ => Relation::Differs,
                };
                if relation == Relation::Differs && judged.message.is_none() {
                    judged.message = Some(Text::new(
                        format!(
                            "vertex {index}: {name}[{scalar}] is {driver} for the driver and {value} for the interpreter"
                        ),
                        format!(
                            "頂点 {index}: {name}[{scalar}] はドライバーでは {driver}, インタープリターでは {value} です"
                        ),
                    ));
                }
                judged.relation = judged.relation.max(relation);
            }
        }
        judged
    };
    (0..exact.discarded.len()).map(judge_one).collect()
}

/// What noise in the last bits moves is no difference between driver and interpreter.
fn settle(judged: &mut [VertexOpinion], drawn: &DriverOutput<'_>, exact: &Outputs, noisy: &Outputs) {
    for (index, one) in judged.iter_mut().enumerate().filter(|(_, one)| one.relation == Relation::Differs) {
        let moves = |name: &str| {
            let (Some(exact), Some(noisy)) = (exact.get(name), noisy.get(name)) else { return false };
            exact.values.iter().zip(&noisy.values).enumerate().any(|(scalar, (exact, values))| {
                let (exact, moved) = (exact[index], (exact[index] - values[index]).abs());
                noisy.undefined(scalar, index).is_some()
                    || moved.is_nan() && exact.to_bits() != values[index].to_bits()
                    || moved > TOLERANCE * exact.abs().max(1.0)
            })
        };
        // What one of the two threw away has no values that could move.
        let is_thrown_by_one = drawn.discarded.get(index).is_some_and(|discarded| *discarded != exact.discarded[index]);
        let is_moved = !is_thrown_by_one && drawn.outputs.iter().any(|(name, _)| moves(name));
        if is_moved || exact.discarded[index] != noisy.discarded[index] {
            *one = VertexOpinion { relation: Relation::Unsettled, message: None };
        }
    }
}

/// The opinion on all of them.
pub(super) fn summed_up(judged: Vec<VertexOpinion>) -> CrossCheck {
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
    use reference::interpreter::{Program, Stage};

    #[test]
    fn what_is_thrown_away_is_compared_by_that_alone() {
        let text = "in float p; out vec4 c; void main() { if (p > 0.5) discard; c = vec4(p); }";
        let program = Program::compile(text, Stage::Fragment).unwrap();
        let column = [0.25, 0.75, 0.25, 0.75];
        let compared = |discarded: [bool; 4]| {
            let outputs = vec![("c", vec![[0.25; 4]; 4])];
            let drawn = DriverOutput { outputs, discarded: discarded.into() };
            compare(&drawn, |precision| {
                Ok(program.run(4).input("p", &[&column]).unwrap().precision(precision).outputs().unwrap())
            })
        };
        assert_eq!(compared([false, true, false, true]).agreeing, 4);
        let wrong = compared([false, false, true, true]);
        assert_eq!((wrong.opinion, wrong.differing, wrong.agreeing), (Opinion::Differs, 2, 2));
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
