//! Several mistakes, each of them mended in the text where it stands.

use super::{
    FUEL_OF_TRACE, MOST_TRIED_AFTER, RepairAim, RepairAttempt, RepairOutcome, RepairScope, RepairStep, Repaired,
    StageLines,
};
use crate::compare::COLOUR_TOLERANCE;
use crate::diagnose::Evidence;
use crate::diagnose::cause::{is_there, leaves_little};
use crate::diagnose::inside::chain::Link;
use crate::diagnose::inside::search::Search;
use crate::diagnose::inside::{Place, Recorded, find};
use crate::render::Sample;
use glam::DVec3;
use reference::fit::{Alternatives, programs_showing};
use reference::interpreter::Ingredients;

/// What mends several mistakes together.
#[derive(Default)]
pub(super) struct Mending<'l> {
    /// Changes of the text, one after the other.
    pub steps: Vec<RepairStep>,
    /// The mistake of the homework that is left with these.
    pub written: Option<Repaired>,
    /// The places that are left with these.
    pub left: &'l [Link],
}

impl Search<'_, '_> {
    /// A change in each place of several mistakes, as far as there are such: then a mistake of the homework is left, or the other places
    /// are. `None` where that is not all.
    pub(super) fn chained(&self, attempt: &RepairAttempt, right: &Ingredients) -> Option<Mending<'_>> {
        let chain = self.chain();
        let mut attempt = attempt.clone();
        let mut steps = Vec::new();
        for (number, Link { mend, lines, seen, .. }) in chain.links.iter().enumerate() {
            attempt.part = seen.clone();
            let lines = [StageLines { stage: mend.stage, lines: lines.clone(), near: 1 }];
            let scope = RepairScope { lines: &lines, right, most: MOST_TRIED_AFTER, aim: RepairAim::All };
            let RepairOutcome::Right(step) = self.step(&attempt, scope) else { break };
            let Some(next) = self.after(&attempt, &step) else { break };
            attempt = next;
            steps.push(step);
            let is_last = chain.is_whole && number + 1 == chain.links.len();
            let next = chain.links.get(number + 1);
            let written = if is_last { None } else { self.written_beside(&attempt, next) };
            if written.is_some() {
                return Some(Mending { steps, written, left: &[] });
            }
        }
        let left = &chain.links[steps.len()..];
        chain.is_whole.then_some(Mending { steps, written: None, left })
    }

    /// The mistake of the homework that is left in the text after some changes, where it is one alone. `next`: the place where the next
    /// mistake stands.
    fn written_beside(&self, attempt: &RepairAttempt, next: Option<&Link>) -> Option<Repaired> {
        let Evidence { assignment, probes, .. } = *self.evidence;
        let seen = self.shown(&attempt.program, &Place::all(probes), FUEL_OF_TRACE)?;
        let sample = |(colour, position): (&DVec3, &glam::DVec4)| Sample {
            position: position.as_vec4().to_array(),
            colour: colour.extend(1.0).as_vec4().to_array(),
        };
        let samples: Vec<Sample> = seen.colours.iter().zip(&seen.positions).map(sample).collect();
        let recorded = Recorded::default();
        let evidence =
            Evidence { samples: &samples, traced: Some(&attempt.program), recorded: &recorded, ..*self.evidence };
        let colours: Vec<[f64; 3]> = samples.iter().map(Sample::colour_f64).collect();
        let alternatives = Alternatives::new(assignment, probes);
        let is_there = is_there(&evidence);
        let mut shown = programs_showing(&alternatives, &colours, &is_there, COLOUR_TOLERANCE);
        let found = shown.next()?;
        // What several show that cost other lines is none of them for sure. Where little is left, much shows the same.
        if leaves_little(assignment, &found) || shown.any(|other| !assignment.share_a_line(&found, &other)) {
            return None;
        }
        let finding = find(&evidence).into_iter().next().or_else(|| Some(next?.finding.clone()))?;
        let mistake = assignment.mistake(&found.id)?.clone();
        Some(self.known_at(mistake, &finding))
    }
}
