//! What a vertex stage hands to a fragment stage that is fixed: there each output has its name, and is judged by itself.

use super::inputs::vertex_run;
use super::{Place, TracedProgram};
use crate::Assignment;
use crate::equation::Reads;
use crate::feature::Feature;
use crate::interpreter::{Program, Stage};
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
        if wrong.is_empty() {
            return None;
        }
        let changed = self.changed_outputs(&right, places, fuel)?;
        let lines: Vec<usize> =
            (0..self.rubric.len()).filter(|line| !self.judges_position(&self.rubric[*line])).collect();
        let is_alone =
            |name: &&str, line: usize| lines.iter().all(|other| *other == line || !changed[*other].contains(*name));
        let mut told = ToldByOutputs::default();
        for line in lines.iter().copied().filter(|line| !changed[*line].is_empty()) {
            if changed[line].is_disjoint(&wrong) {
                told.right.push(line);
            } else if is_placed && changed[line].intersection(&wrong).any(|name| is_alone(name, line)) {
                told.wrong.push(line);
            }
        }
        Some(told)
    }

    /// The outputs that each line of the rubric tells about: those that its feature changes, or that no feature changes and it names
    /// itself; of a line without a feature, all others. `None` where lines are known by definitions.
    fn changed_outputs<'w>(
        &self,
        right: &'w Written,
        places: &[Place<'_>],
        fuel: u64,
    ) -> Option<Vec<BTreeSet<&'w str>>> {
        let outputs = || right.keys().map(String::as_str).filter(|name| *name != POSITION);
        let mut changed: Vec<Option<BTreeSet<&str>>> = Vec::new();
        for feature in &self.features {
            changed.push(match feature {
                Some(Feature::Program(answer)) => {
                    let mut own = differing(right, &self.written(&answer.pipeline.vertex, places, fuel)?);
                    own.remove(POSITION);
                    Some(own)
                }
                Some(Feature::Term(_)) => return None,
                None => None,
            });
        }
        let by_features: BTreeSet<&str> = changed.iter().flatten().flatten().copied().collect();
        for (line, own) in self.rubric.iter().zip(&mut changed) {
            let is_said = |name: &&str| !by_features.contains(name) && line.variables.iter().any(|said| said == name);
            if let Some(own) = own {
                own.extend(outputs().filter(is_said));
            }
        }
        let told: BTreeSet<&str> = changed.iter().flatten().flatten().copied().collect();
        let rest: BTreeSet<&str> = outputs().filter(|name| !told.contains(name)).collect();
        Some(changed.into_iter().map(|own| own.unwrap_or_else(|| rest.clone())).collect())
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
