//! Several mistakes, each of them mended in the text where it stands.

use super::{MOST_TRIED_AFTER, RepairAim, RepairAttempt, RepairOutcome, RepairScope, RepairStep, StageLines};
use crate::diagnose::inside::TracedProgram;
use crate::diagnose::inside::chain::Link;
use crate::diagnose::inside::search::{Search, is_right};
use crate::diagnose::trials::StageChanges;
use reference::interpreter::Ingredients;

impl Search<'_, '_> {
    /// A change in each place of several mistakes, as far as there are such: the places after these are left.
    pub(super) fn chained(&self, attempt: &RepairAttempt, right: &Ingredients) -> (Vec<RepairStep>, &[Link]) {
        let links = self.chain();
        let mut attempt = attempt.clone();
        let mut steps = Vec::new();
        for (number, Link { mend, lines, seen, .. }) in links.iter().enumerate() {
            attempt.part = seen.clone();
            let lines = [StageLines { stage: mend.stage, lines: lines.clone(), near: 1 }];
            let scope = RepairScope { lines: &lines, right, most: MOST_TRIED_AFTER, aim: RepairAim::All };
            let RepairOutcome::Right(step) = self.step(&attempt, scope) else { return (steps, &links[number..]) };
            let Some(next) = self.after(&attempt, &step) else { return (steps, &links[number..]) };
            attempt = next;
            steps.push(step);
        }
        (steps, &[])
    }

    /// Whether what makes all right does so at every probe. What is seen with other mistakes is known at the chosen ones only, and is
    /// looked at without the bounds of a colour, which hide much of it.
    pub(super) fn is_verified(
        &self,
        attempt: &RepairAttempt,
        (stage, repair): &RepairStep,
        program: &TracedProgram,
    ) -> bool {
        let Some([_, unclamped]) = &attempt.part else { return self.holds_everywhere(program) };
        // What is bounded is bounded alike only where both can be traced.
        let traced = attempt.text(*stage).and_then(|text| program.with(*stage, text.traced(repair)?));
        let seen = traced.and_then(|program| self.unclamped(&program, &StageChanges::default()));
        seen.is_some_and(|seen| is_right(unclamped, &seen, self.count))
    }
}
