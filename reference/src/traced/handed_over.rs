//! What a vertex stage hands to a fragment stage that is fixed: there each output has its name, and is judged by itself.

use super::inputs::vertex_run;
use super::{Place, TracedProgram};
use crate::Assignment;
use crate::assignment::Stage;
use crate::equation::Reads;
use crate::feature::Feature;
use crate::interpreter::Program;
use crate::pipeline::{POSITION, scalars};
use std::collections::{BTreeMap, BTreeSet};

/// What each output holds at the vertices of the probes, a column for each scalar.
type Written = BTreeMap<String, Vec<Vec<f64>>>;

/// The lines of a rubric that outputs tell about, by their places.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ToldByOutputs {
    /// All that they change is right.
    pub right: Vec<usize>,
    /// Something that no other line changes is wrong, although all stands where it should.
    pub wrong: Vec<usize>,
}

impl Assignment {
    /// The lines that a program's outputs tell about: a line is known by what the solution without it writes otherwise, and one without a
    /// feature by all that no feature changes. None where the fragment stage is handed in as well, or all outputs are right.
    pub fn told_by_outputs(&self, program: &TracedProgram, places: &[Place<'_>], fuel: u64) -> ToldByOutputs {
        self.told(program, places, fuel).unwrap_or_default()
    }

    fn told(&self, program: &TracedProgram, places: &[Place<'_>], fuel: u64) -> Option<ToldByOutputs> {
        let is_fixed = self.fixed.iter().any(|fixed| fixed.stage == Stage::Fragment);
        if !is_fixed || self.equation.reads() == Reads::Attributes {
            return None;
        }
        let right = self.written(&self.pipeline.vertex, places, fuel)?;
        let own = self.written(&program.vertex, places, fuel)?;
        let mut wrong = differing(&right, &own);
        // What is computed from another place is no mistake of its own.
        let is_placed = !wrong.remove(POSITION);
        let mut changed: Vec<Option<BTreeSet<&str>>> = Vec::new();
        for feature in &self.features {
            changed.push(match feature {
                Some(Feature::Program(answer)) => {
                    let without = self.written(&answer.pipeline.vertex, places, fuel)?;
                    Some(differing(&right, &without).into_iter().filter(|name| *name != POSITION).collect())
                }
                Some(Feature::Term(_)) => return None,
                None => None,
            });
        }
        let by_features: BTreeSet<&str> = changed.iter().flatten().flatten().copied().collect();
        // What no feature changes is judged by the line that says so.
        for (line, changed) in self.rubric.iter().zip(&mut changed) {
            let said = right.keys().map(String::as_str).filter(|name| line.variables.iter().any(|own| own == name));
            if let Some(changed) = changed {
                changed.extend(said.filter(|name| !by_features.contains(name)));
            }
        }
        let by_features: BTreeSet<&str> = changed.iter().flatten().flatten().copied().collect();
        let rest: BTreeSet<&str> =
            right.keys().map(String::as_str).filter(|name| !by_features.contains(name) && *name != POSITION).collect();
        let own = |line: usize| changed[line].as_ref().unwrap_or(&rest);
        let lines: Vec<usize> =
            (0..self.rubric.len()).filter(|line| !self.judges_position(&self.rubric[*line])).collect();
        let is_alone =
            |name: &&str, line: usize| lines.iter().all(|other| *other == line || !own(*other).contains(*name));
        let mut told = ToldByOutputs::default();
        for line in lines.iter().copied().filter(|line| !wrong.is_empty() && !own(*line).is_empty()) {
            if own(line).is_disjoint(&wrong) {
                told.right.push(line);
            } else if is_placed && own(line).intersection(&wrong).any(|name| is_alone(name, line)) {
                told.wrong.push(line);
            }
        }
        Some(told)
    }

    fn written(&self, vertex: &Program, places: &[Place<'_>], fuel: u64) -> Option<Written> {
        let outputs = vertex_run(self, vertex, places, fuel)?.outputs(&[]).ok()?;
        let named = vertex.outputs().iter().enumerate();
        Some(named.map(|(place, output)| (output.name.clone(), scalars(&outputs, place))).collect())
    }
}

/// The outputs of a right answer that another program writes otherwise.
fn differing<'w>(right: &'w Written, other: &Written) -> BTreeSet<&'w str> {
    /// What is computed in another order differs by rounding, and constants are f32.
    const RELATIVE: f64 = 1e-4;
    let is_number = |a: f64, b: f64| a.is_nan() || (a - b).abs() <= RELATIVE * a.abs().max(b.abs()).max(1e-3);
    let is_same = |own: &[Vec<f64>], other: &[Vec<f64>]| {
        own.len() == other.len()
            && own.iter().flatten().zip(other.iter().flatten()).all(|(own, other)| is_number(*own, *other))
    };
    let differs = |(name, own): &(&String, &Vec<Vec<f64>>)| !other.get(*name).is_some_and(|other| is_same(own, other));
    right.iter().filter(differs).map(|(name, _)| name.as_str()).collect()
}
