//! What a line of the rubric judges, known by the solution without it.

use crate::Assignment;
use crate::accepted::{AcceptedAnswer, Computed};
use crate::mistake::MistakeForm;
use crate::probes::ProbeSet;

/// The solution without what a line judges.
#[derive(Clone, Debug)]
pub enum Feature {
    /// Its equation with a definition that is 0.
    Term(MistakeForm),
    /// A program of its own.
    Program(AcceptedAnswer),
}

impl Assignment {
    /// The colour and the position that the solution without a feature computes at each probe.
    pub(crate) fn computed_without(&self, feature: &Feature, probes: &ProbeSet) -> Vec<Computed> {
        let form = match feature {
            Feature::Program(program) => return self.computed_by(program, probes),
            Feature::Term(form) => form,
        };
        let variant = self.equation.right().with(form, f64::NAN);
        let computed = |probe| {
            let outcome = variant.evaluate(probes.uniforms(probe), &probe.attributes);
            (outcome.colour(), outcome.position())
        };
        probes.iter().map(computed).collect()
    }
}
