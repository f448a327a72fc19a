//! The smallest change of the student's own text by which all becomes right.
//!
//! It is looked for where the mistake was found to stand, then wherever else a value is not right yet: the slips of what is
//! written there, and what the right answer is made of. What makes every judging probe right, and those that nobody knows
//! beforehand, names the mistake exactly. Where no change does, one that makes more right and nothing wrong is taken, and the
//! next one is looked for in the text with it.

mod repaired;

pub(in crate::diagnose) use repaired::Repaired;

use super::search::{Search, is_in_place, is_right};
use super::{Finding, Place, Seen, Stage, TracedProgram, variable};
use crate::compare::{COLOUR_TOLERANCE, POSITION_TOLERANCE};
use crate::diagnose::columns::{is_colour, is_same};
use crate::diagnose::locate::{Located, MistakeOrigin};
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges};
use crate::translate;
use glam::DVec3;
use reference::interpreter::trace::{Event, Trace, What};
use reference::interpreter::{Ingredients, Operator, Program, ProgramRepair, Repairable};
use reference::traced::Bench;

/// So many changes are tried for one repair, and so many for a second one. Each is compiled, and run at the chosen probes: a hundred
/// take some 30 ms. Measured on 223 slips: half of the repairs are among the first 77.
const MOST_TRIED: usize = 450;
const MOST_TRIED_AFTER: usize = 200;

/// So many are tried to find the line of a mistake that is known.
const MOST_SLIPS: usize = 300;

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
}

/// A change of the text of a stage.
type RepairStep = (Stage, ProgramRepair);

/// What became of trying.
enum RepairOutcome {
    Right(RepairStep),
    /// These make more right, and nothing wrong; those that make most right first.
    Better(Vec<(RepairStep, Seen)>),
}

impl Search<'_, '_> {
    /// The changes that make all right together.
    pub fn repairs(&mut self, findings: &[Finding], goes_on: &mut dyn FnMut() -> bool) -> Vec<Repaired> {
        // What stands elsewhere is another affair.
        if !is_in_place(self.wanted, self.own, self.count) {
            return Vec::new();
        }
        let first = self.first_attempt();
        let right = self.ingredients();
        let lines = self.lines(findings);
        let steps = self.steps(&first, &lines, &right, goes_on).unwrap_or_default();
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
        found
    }

    /// The one slip of the text without which all is right.
    pub fn slip(&self, findings: &[Finding]) -> Option<Located> {
        if !is_in_place(self.wanted, self.own, self.count) {
            return None;
        }
        let attempt = self.first_attempt();
        let lines = self.lines(findings);
        match self.step(&attempt, &lines, &self.ingredients(), MOST_SLIPS, &|repair| repair.is_slip) {
            RepairOutcome::Right(step) => Some(self.repaired(&attempt, &step)?.located),
            RepairOutcome::Better(_) => None,
        }
    }

    fn first_attempt(&self) -> RepairAttempt {
        let texts = self.evidence.sources.iter().filter_map(|(stage, source)| {
            let text = translate::plain_lines(&source.text);
            Some((*stage, Repairable::read(&text, *stage).ok()?))
        });
        RepairAttempt { program: self.theirs.clone(), texts: texts.collect(), seen: self.own.clone() }
    }

    fn ingredients(&self) -> Ingredients {
        let solution: Vec<&str> = self.assignment.files.iter().map(|file| file.solution.text.as_str()).collect();
        Ingredients::of(&solution)
    }

    /// One or two changes that make all right together.
    fn steps(
        &self,
        attempt: &RepairAttempt,
        lines: &[(Stage, u32)],
        right: &Ingredients,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<RepairStep>> {
        let better = match self.step(attempt, lines, right, MOST_TRIED, &|_| true) {
            RepairOutcome::Right(step) => return Some(vec![step]),
            RepairOutcome::Better(better) => better,
        };
        if !goes_on() {
            return None;
        }
        better.into_iter().take(MOST_BEGINNINGS).find_map(|(first, seen)| {
            let next = RepairAttempt { seen, ..self.after(attempt, &first)? };
            match self.step(&next, lines, right, MOST_TRIED_AFTER, &|_| true) {
                RepairOutcome::Right(second) => Some(vec![first, second]),
                RepairOutcome::Better(_) => None,
            }
        })
    }

    /// Tries so many changes once.
    fn step(
        &self,
        attempt: &RepairAttempt,
        lines: &[(Stage, u32)],
        right: &Ingredients,
        most: usize,
        is_taken: &dyn Fn(&ProgramRepair) -> bool,
    ) -> RepairOutcome {
        let mut better: Vec<(usize, RepairStep, Seen)> = Vec::new();
        let before = self.right_channels(&attempt.seen);
        let (mut tried, mut verified) = (0, 0);
        let mut stages: Vec<Stage> = lines.iter().map(|(stage, _)| *stage).collect();
        stages.dedup();
        for stage in stages {
            let Some((_, text)) = attempt.texts.iter().find(|(own, _)| *own == stage) else { continue };
            let own: Vec<u32> = lines.iter().filter(|(of, _)| *of == stage).map(|(_, line)| *line).collect();
            for repair in text.repairs(&own, right).into_iter().filter(is_taken) {
                tried += 1;
                if tried > most {
                    break;
                }
                let Some(program) = text.program(&repair).and_then(|own| attempt.program.with(stage, own)) else {
                    continue;
                };
                let Some(seen) = self.shown(&program, self.places) else { continue };
                if is_right(self.wanted, &seen, self.count) {
                    verified += 1;
                    if verified <= MOST_VERIFIED && self.holds_everywhere(&program) {
                        return RepairOutcome::Right((stage, repair));
                    }
                    continue;
                }
                let now = self.right_channels(&seen);
                let is_worse = before.iter().zip(&now).any(|(before, now)| *before && !now);
                let gained = before.iter().zip(&now).filter(|(before, now)| !**before && **now).count();
                if !is_worse && gained > 0 && is_in_place(self.wanted, &seen, self.count) {
                    better.push((gained, (stage, repair), seen));
                }
            }
        }
        better.sort_by_key(|(gained, ..)| std::cmp::Reverse(*gained));
        RepairOutcome::Better(better.into_iter().map(|(_, step, seen)| (step, seen)).collect())
    }

    fn after(&self, attempt: &RepairAttempt, (stage, repair): &RepairStep) -> Option<RepairAttempt> {
        let mut next = attempt.clone();
        let (_, text) = next.texts.iter_mut().find(|(own, _)| own == stage)?;
        let program = text.program(repair)?;
        *text = text.with(repair);
        next.program = attempt.program.with(*stage, program)?;
        Some(next)
    }

    /// The lines to look at: those of what was found, then those of all that is not right yet, then the rest that it is made of.
    fn lines(&self, findings: &[Finding]) -> Vec<(Stage, u32)> {
        let mut lines: Vec<(Stage, u32)> = findings.iter().map(|finding| (finding.stage, finding.line)).collect();
        let mut stages = vec![Stage::Vertex, Stage::Fragment];
        stages.sort_by_key(|stage| !findings.iter().any(|finding| finding.stage == *stage));
        for stage in stages {
            let suspects = self.suspects(stage);
            let own = suspects.iter().filter(|one| self.is_students(stage, one));
            let (wrong, right): (Vec<_>, Vec<_>) = own.partition(|one| !one.is_right && !one.gives_right);
            lines.extend(wrong.into_iter().chain(right).map(|one| (stage, self.site(stage, one).line)));
        }
        let mut known = std::collections::HashSet::new();
        lines.retain(|(stage, line)| known.insert((*stage as usize, *line)));
        lines.sort_by_key(|(stage, _)| lines_of_stage(findings, *stage));
        lines
    }

    fn shown(&self, program: &TracedProgram, places: &[Place<'_>]) -> Option<Seen> {
        Bench::new(self.assignment, program, places, self.in_quads, FUEL_OF_TRACE)?.with(&StageChanges::default())
    }

    /// For each place and channel whether it is right.
    fn right_channels(&self, seen: &Seen) -> Vec<bool> {
        let pairs = seen.colours.iter().zip(&self.wanted.colours);
        let channels = pairs.flat_map(|(own, wanted)| own.to_array().into_iter().zip(wanted.to_array()));
        channels.map(|(own, wanted)| (own - wanted).abs() <= COLOUR_TOLERANCE * wanted.abs().max(1.0)).collect()
    }

    /// Whether a program is right at every judging probe, and not elsewhere another one.
    fn holds_everywhere(&self, program: &TracedProgram) -> bool {
        let all = [self.evidence.probes, self.evidence.fresh.probes];
        let [judging, fresh] = all.map(|probes| {
            let places: Vec<Place<'_>> =
                probes.iter().map(|probe| Place { probe, uniforms: probes.uniforms(probe) }).collect();
            let seen = self.shown(program, &places)?;
            let is_right = |(place, (colour, position)): (&Place<'_>, (&DVec3, &glam::DVec4))| {
                let largest = place.probe.position.abs().max_element().max(f64::MIN_POSITIVE);
                let is_there = self.assignment.equation.reads() != reference::equation::Reads::Attributes
                    || (*position - place.probe.position).abs().max_element() <= POSITION_TOLERANCE * largest;
                is_colour(place.probe.colour, *colour) && is_there
            };
            let pairs = places.iter().zip(seen.colours.iter().zip(&seen.positions));
            Some(pairs.map(is_right).collect::<Vec<bool>>())
        });
        let (Some(judging), Some(fresh)) = (judging, fresh) else { return false };
        judging.iter().all(|is| *is) && !self.evidence.fresh.is_contradicted(|place| !fresh[place])
    }

    /// What is known of a change.
    fn repaired(&self, attempt: &RepairAttempt, (stage, repair): &RepairStep) -> Option<Repaired> {
        let (_, text) = attempt.texts.iter().find(|(own, _)| own == stage)?;
        let marked = attempt.program.with(*stage, text.traced(repair)?)?;
        let (_, mut traces) = Bench::new(self.assignment, &marked, self.places, self.in_quads, FUEL_OF_TRACE)?
            .trace(&StageChanges::default())?;
        let trace = traces[*stage as usize].take()?;
        let program = marked.stage(*stage);
        let added = repair.added.as_deref().and_then(|name| self.meant_by(*stage, program, &trace, name));
        let judged = |name: &String| self.assignment.rubric.iter().any(|line| line.judges == *name);
        let (operator, definition) = match added.filter(judged) {
            // What the text has already is not left out: it is short of another part.
            Some(term) if repair.mistake == Operator::AddendLeftOut && !self.computes(&term) => {
                (Operator::LeftOut, Some(term))
            }
            _ => match self.definition_at(*stage, program, &trace, repair.mistake) {
                // A factor of a part is none of the whole.
                found if is_number_too_many(repair) && !matches!(found, Some((_, true))) => {
                    (Operator::OtherNumber, found.map(|(name, _)| name))
                }
                found => (repair.mistake, found.map(|(name, _)| name)),
            },
        };
        let mistake = self.assignment.repaired(operator, definition.as_deref(), repair.is_bound_by_zero);
        let marks = program.sites().iter().position(|site| site.line == ProgramRepair::MARK);
        let name = marks.and_then(|site| variable(program.sites(), site));
        Some(Repaired {
            mistake,
            located: Located { line: repair.line, name, role: MistakeOrigin::Wrong, stage: Some(*stage) },
            texts: repair.texts.clone(),
            touches: definition.map_or_else(Vec::new, |name| self.quantities.spoilt_by(*stage, &name)),
        })
    }

    /// The definition of the right answer that a value comes to first which is computed from what was changed, and whether it is
    /// what was changed itself.
    fn definition_at(
        &self,
        stage: Stage,
        program: &Program,
        trace: &Trace,
        mistake: Operator,
    ) -> Option<(String, bool)> {
        let sites = program.sites();
        // Another value is the wrong one in what is made of it.
        let is_of_use = matches!(
            mistake,
            Operator::OtherValue | Operator::OtherMatrix | Operator::OtherComponents | Operator::OtherNumber
        );
        let mut is_reached = vec![false; trace.events.len()];
        for (number, event) in trace.events.iter().enumerate() {
            let is_marked = sites[event.site].line == ProgramRepair::MARK;
            is_reached[number] = is_marked || event.from.iter().any(|from| is_reached[*from]);
            if !is_reached[number] || is_marked && is_of_use {
                continue;
            }
            let is_given = matches!(sites[event.site].what, What::Assign { .. });
            if let Some(name) = self.named(stage, event, is_given) {
                return Some((name, is_marked));
            }
        }
        None
    }

    /// The definition that a name of the text or of the right answer stands for.
    fn meant_by(&self, stage: Stage, program: &Program, trace: &Trace, name: &str) -> Option<String> {
        if self.quantities.all.iter().any(|own| own.stage == stage && own.names.iter().any(|own| own == name)) {
            return Some(name.to_owned());
        }
        let gives =
            |event: &&Event| matches!(&program.sites()[event.site].what, What::Assign { name: own, .. } if own == name);
        trace.events.iter().filter(gives).find_map(|event| self.named(stage, event, true))
    }

    /// The definition that a value is. `is_given`: a value that is the same everywhere counts as well.
    fn named(&self, stage: Stage, event: &Event, is_given: bool) -> Option<String> {
        let is_it = |own: &&super::quantities::Quantity| {
            own.stage == stage
                && !own.names.is_empty()
                && (is_given || !own.is_constant)
                && own.turns.iter().any(|turn| is_same(event, turn))
        };
        self.quantities.all.iter().find(is_it)?.names.first().cloned()
    }
}

/// Whether a number goes that something is multiplied by, or that is added to it.
fn is_number_too_many(repair: &ProgramRepair) -> bool {
    let [before, after] = &repair.texts;
    let is_number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    let mut gone = before.split(|c: char| !(c.is_ascii_alphanumeric() || "_.".contains(c)));
    matches!(repair.mistake, Operator::Scaled | Operator::Shifted)
        && gone.all(|word| word.is_empty() || after.contains(word) || is_number(word))
}

/// Stages in which something was found come first.
fn lines_of_stage(findings: &[Finding], stage: Stage) -> (bool, usize) {
    (!findings.iter().any(|finding| finding.stage == stage), stage as usize)
}
