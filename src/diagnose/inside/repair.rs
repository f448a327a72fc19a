//! The smallest change of the student's own text by which all becomes right.
//!
//! It is looked for where the mistake was found to stand, then wherever else the student wrote something: the slips of what is
//! written there, and what the right answer is made of. The smallest come first, wherever they stand. What makes every judging probe right, and those that nobody knows
//! beforehand, names the mistake exactly. Where no change does, one that makes more right and nothing wrong is taken, and the
//! next one is looked for in the text with it.

mod chained;
mod ingredients;
mod marks;
mod meaning;
mod repaired;
mod verified;

pub(in crate::diagnose) use repaired::Repaired;

use chained::Mending;

use super::search::{Search, is_right};
use super::{Finding, Place, Seen, Stage, TracedProgram};
use crate::compare::COLOUR_TOLERANCE;
use crate::diagnose::locate::Located;
use crate::diagnose::trials::{FIRST, FUEL_OF_TRACE, StageChanges};
use crate::translate;
use reference::interpreter::{Ingredients, Operator, ProgramRepair, Repairable};
use reference::traced::Bench;

/// So many changes are tried for one repair, and so many for a second one. Each is compiled, and run at a few places first: a hundred
/// take some 15 ms.
const MOST_TRIED: usize = 1_200;
const MOST_TRIED_AFTER: usize = 300;

/// So many are tried to find the line of a mistake that is known.
const MOST_SLIPS: usize = 2_200;

/// The steps of a try at the first places, and at all: a loop may have no end by it.
const FUEL_OF_FIRST: u64 = 200_000;
const FUEL_OF_TRY: u64 = 1_000_000;

/// So many of the changes that make more right are taken as the first of two.
const MOST_BEGINNINGS: usize = 2;

/// So many changes that are right at the chosen probes are run at all of them.
const MOST_VERIFIED: usize = 8;

/// The student's program with some changes.
#[derive(Clone)]
struct RepairAttempt {
    program: TracedProgram,
    texts: Vec<(Stage, Repairable)>,
    seen: Seen,
    /// What has to be seen of it while other mistakes are still there, see [`Link::seen`]; `None` where all has to be right.
    part: Option<[Seen; 2]>,
}

impl RepairAttempt {
    fn text(&self, stage: Stage) -> Option<&Repairable> {
        self.texts.iter().find(|(own, _)| *own == stage).map(|(_, text)| text)
    }

    /// The changes of its texts, in the order in which they are tried.
    fn changes<'t>(&'t self, scope: RepairScope<'t>) -> impl Iterator<Item = RepairStep> {
        scope.lines.iter().flat_map(move |StageLines { stage, lines, near }| {
            let all = self.text(*stage).map(|text| text.repairs(lines, *near, scope.right));
            let is_known = move |repair: &ProgramRepair| match scope.aim {
                RepairAim::Slip => repair.is_of_its_line(),
                RepairAim::Condition => repair.mistake == Operator::Gated,
                RepairAim::Body => repair.mistake.is_of_a_body(),
                RepairAim::More | RepairAim::All => true,
            };
            let all = all.into_iter().flatten().filter(is_known);
            all.map(|repair| (*stage, repair))
        })
    }

    /// The program with one more change; `None` where that is no program.
    fn with(&self, (stage, repair): &RepairStep) -> Option<TracedProgram> {
        self.program.with(*stage, self.text(*stage)?.program(repair)?)
    }
}

/// A change of the text of a stage.
type RepairStep = (Stage, ProgramRepair);

/// What became of trying.
enum RepairOutcome {
    Right(RepairStep),
    /// These make more right, and nothing wrong; those that make most right first.
    Better(Vec<(RepairStep, Seen)>),
}

/// The lines of a stage to look at; in the first `near` ones something was found.
struct StageLines {
    stage: Stage,
    lines: Vec<u32>,
    near: usize,
}

/// Which changes are tried, and how many.
#[derive(Clone, Copy)]
struct RepairScope<'l> {
    lines: &'l [StageLines],
    right: &'l Ingredients,
    most: usize,
    aim: RepairAim,
}

/// Which changes count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::diagnose) enum RepairAim {
    /// Those that make more right.
    More,
    /// Those that make all right.
    All,
    /// Those of them that are known to be on their line.
    Slip,
    /// Those of them that take a condition away.
    Condition,
    /// Those of them that concern how a function is written.
    Body,
}

impl Search<'_, '_> {
    /// The changes that make all right together.
    pub fn repairs(&mut self, findings: &[Finding], goes_on: &mut dyn FnMut() -> bool) -> Vec<Repaired> {
        let first = self.first_attempt();
        let Mending { steps, written, left } = self.steps(&first, findings, goes_on).unwrap_or_default();
        let mut attempt = first;
        let mut found = Vec::new();
        for step in steps {
            let Some(mut repaired) = self.repaired(&attempt, &step) else { return Vec::new() };
            // What is written anew a second time was not made right by the first.
            if let Some(before) = found.pop_if(|before: &mut Repaired| repaired.undoes(before)) {
                repaired.texts[0] = repaired.texts[0].replacen(&before.texts[1], &before.texts[0], 1);
            }
            found.push(repaired);
            let Some(next) = self.after(&attempt, &step) else { return Vec::new() };
            attempt = next;
        }
        found.extend(written);
        found.extend(left.iter().map(|link| self.computed_otherwise(link)));
        found
    }

    /// The one slip of the text without which all is right.
    pub fn slip(&self, findings: &[Finding]) -> Option<Located> {
        self.only(findings, RepairAim::Slip)?.located
    }

    /// The one change of a kind by which all is right.
    pub fn only(&self, findings: &[Finding], aim: RepairAim) -> Option<Repaired> {
        let attempt = self.first_attempt();
        let (lines, right) = (&self.lines(findings), &self.ingredients());
        match self.step(&attempt, RepairScope { lines, right, most: MOST_SLIPS, aim }) {
            RepairOutcome::Right(step) => self.repaired(&attempt, &step),
            RepairOutcome::Better(_) => None,
        }
    }

    fn first_attempt(&self) -> RepairAttempt {
        let texts = self.evidence.sources.iter().filter_map(|(stage, source)| {
            let text = translate::plain_lines(&source.text);
            Some((*stage, Repairable::read(&text, *stage).ok()?))
        });
        RepairAttempt { program: self.theirs.clone(), texts: texts.collect(), seen: self.own.clone(), part: None }
    }

    /// One or more changes that make all right together, perhaps with what is left besides.
    fn steps(
        &self,
        attempt: &RepairAttempt,
        findings: &[Finding],
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Option<Mending<'_>> {
        let (lines, right) = (&self.lines(findings), &self.ingredients());
        let scope = RepairScope { lines, right, most: MOST_TRIED, aim: RepairAim::More };
        let mended = |steps: Vec<RepairStep>| Some(Mending { steps, ..Mending::default() });
        let better = match self.step(attempt, scope) {
            RepairOutcome::Right(step) => return mended(vec![step]),
            RepairOutcome::Better(better) => better,
        };
        if !goes_on() {
            return None;
        }
        let chained = self.chained(attempt, right);
        if chained.as_ref().is_some_and(|chained| !chained.steps.is_empty() && chained.left.is_empty()) {
            return chained;
        }
        let two = better.into_iter().take(MOST_BEGINNINGS).find_map(|(first, seen)| {
            let next = RepairAttempt { seen, ..self.after(attempt, &first)? };
            match self.step(&next, RepairScope { most: MOST_TRIED_AFTER, ..scope }) {
                RepairOutcome::Right(second) => mended(vec![first, second]),
                RepairOutcome::Better(_) => None,
            }
        });
        two.or_else(|| chained.filter(|chained| self.are_known(chained.left)))
    }

    /// Tries so many changes once.
    fn step(&self, attempt: &RepairAttempt, scope: RepairScope<'_>) -> RepairOutcome {
        let mut better: Vec<(usize, RepairStep, Seen)> = Vec::new();
        let before = self.right_channels(&attempt.seen);
        let first = &self.places[..self.places.len().min(FIRST)];
        let is_worse = |now: &[bool]| before.iter().zip(now).any(|(before, now)| *before && !now);
        let mut verified = 0;
        let wanted = attempt.part.as_ref().map_or(self.wanted, |[seen, _]| seen);
        // Statements in another order are few, and come last.
        let is_tried = |(number, (_, repair)): &(usize, RepairStep)| *number < scope.most || repair.is_of_order();
        for (_, step) in attempt.changes(scope).enumerate().filter(is_tried) {
            let Some(program) = attempt.with(&step) else { continue };
            let Some(seen) = self.shown(&program, first, FUEL_OF_FIRST) else { continue };
            let is_no_use = match scope.aim {
                RepairAim::More => is_worse(&self.right_channels(&seen)),
                _ => !is_right(wanted, &seen, first.len()),
            };
            if is_no_use {
                continue;
            }
            let Some(seen) = self.shown(&program, self.places, FUEL_OF_TRY) else { continue };
            if is_right(wanted, &seen, self.count) {
                verified += 1;
                if verified <= MOST_VERIFIED && self.is_verified(attempt, &step, &program) {
                    return RepairOutcome::Right(step);
                }
                continue;
            }
            let now = self.right_channels(&seen);
            let gained = before.iter().zip(&now).filter(|(before, now)| !**before && **now).count();
            if !is_worse(&now) && gained > 0 && self.is_in_place(&seen) {
                better.push((gained, step, seen));
            }
        }
        better.sort_by_key(|(gained, ..)| std::cmp::Reverse(*gained));
        RepairOutcome::Better(better.into_iter().map(|(_, step, seen)| (step, seen)).collect())
    }

    fn after(&self, attempt: &RepairAttempt, (stage, repair): &RepairStep) -> Option<RepairAttempt> {
        let mut next = attempt.clone();
        let (_, text) = next.texts.iter_mut().find(|(own, _)| own == stage)?;
        *text = text.with(repair);
        next.program = attempt.program.with(*stage, text.as_it_is()?)?;
        Some(next)
    }

    /// The lines to look at, of a stage in which something was found first: those of what was found, then those of all that is not right
    /// yet, then the others that it is made of, then the rest of what the student wrote.
    fn lines(&self, findings: &[Finding]) -> Vec<StageLines> {
        let found_in = |stage: Stage| findings.iter().filter(move |finding| finding.stage == stage);
        let mut stages = vec![Stage::Vertex, Stage::Fragment];
        stages.sort_by_key(|stage| found_in(*stage).next().is_none());
        let of_stage = |stage: Stage| {
            let mut known = std::collections::HashSet::new();
            let mut lines: Vec<u32> = found_in(stage).map(|finding| finding.line).collect();
            lines.retain(|line| known.insert(*line));
            let near = lines.len();
            let suspects = self.suspects(stage);
            let own = suspects.iter().filter(|one| self.is_students(stage, one));
            let (wrong, right): (Vec<_>, Vec<_>) = own.partition(|one| !one.is_right && !one.gives_right);
            let suspected = wrong.into_iter().chain(right).map(|one| self.site(stage, one).line);
            lines.extend(suspected.chain(self.students_lines(stage)).filter(|line| known.insert(*line)));
            StageLines { stage, lines, near }
        };
        stages.into_iter().map(of_stage).collect()
    }

    fn shown(&self, program: &TracedProgram, places: &[Place<'_>], fuel: u64) -> Option<Seen> {
        Bench::new(self.assignment, program, places, self.in_quads, fuel)?.with(&StageChanges::default())
    }

    /// For each place and channel whether it is right.
    fn right_channels(&self, seen: &Seen) -> Vec<bool> {
        let pairs = seen.colours.iter().zip(&self.wanted.colours);
        let channels = pairs.flat_map(|(own, wanted)| own.to_array().into_iter().zip(wanted.to_array()));
        channels.map(|(own, wanted)| (own - wanted).abs() <= COLOUR_TOLERANCE * wanted.abs().max(1.0)).collect()
    }
}
