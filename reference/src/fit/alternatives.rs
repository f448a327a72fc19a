//! What is not the solution: the programs of mistakes, and the solution without each feature.

use crate::Assignment;
use crate::accepted::{AcceptedAnswer, Computed};
use crate::mistake::FoundMistake;
use crate::probes::ProbeSet;
use crate::together::has_name;
use std::cell::OnceCell;

/// What the alternatives of an assignment show at some probes. Each is run once, when it is first asked for.
#[derive(Debug)]
pub struct Alternatives<'a> {
    pub(crate) assignment: &'a Assignment,
    pub(crate) probes: &'a ProbeSet,
    programs: Vec<(FoundMistake, &'a AcceptedAnswer, OnceCell<Vec<Computed>>)>,
    features: Vec<OnceCell<Vec<Computed>>>,
}

impl<'a> Alternatives<'a> {
    /// Those of an assignment at its probes.
    pub fn new(assignment: &'a Assignment, probes: &'a ProbeSet) -> Self {
        let programs = assignment.mistakes.iter().flat_map(|mistake| {
            let ways = mistake.variants.iter().zip(mistake.forms.len()..);
            // One with a number is tried with the likeliest first.
            let parameter = |program: &AcceptedAnswer| {
                let fit = mistake.fit.as_ref()?;
                program.replaced.iter().any(|[_, to]| has_name(to, &fit.name)).then_some(fit.example)
            };
            ways.map(move |(program, form)| {
                let found = FoundMistake { id: mistake.id.clone(), form, parameter: parameter(program) };
                (found, program, OnceCell::new())
            })
        });
        let features = assignment.features.iter().map(|_| OnceCell::new());
        Self { assignment, probes, programs: programs.collect(), features: features.collect() }
    }

    /// The mistakes that are whole programs, in the assignment's order, with what each shows.
    pub(super) fn programs(&self) -> impl Iterator<Item = (&FoundMistake, &'a AcceptedAnswer, &[Computed])> {
        self.programs.iter().map(|(found, program, shown)| {
            let shown = shown.get_or_init(|| self.assignment.computed_by(program, self.probes));
            (found, *program, shown.as_slice())
        })
    }

    /// What the solution shows without the feature of a line of the rubric; `None` for a line without one.
    pub(crate) fn without(&self, line: usize) -> Option<&[Computed]> {
        let feature = self.assignment.features.get(line)?.as_ref()?;
        Some(self.features[line].get_or_init(|| self.assignment.computed_without(feature, self.probes)))
    }

    /// What is right.
    pub(super) fn right(&self) -> Vec<Computed> {
        self.probes.iter().map(|probe| (probe.colour, probe.position)).collect()
    }
}
