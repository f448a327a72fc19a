//! Which value has to be another one for all that is seen to be right.

use super::around::FeatureWay;
use super::candidates::Mend;
use super::chain::Chain;
use super::quantities::Quantity;
use super::walk::{Suspect, made_of, roots, suspects};
use super::*;
use crate::diagnose::trials::{StageChanges, Trials};
use crate::source::Source;
use glam::DVec4;
use reference::interpreter::{Program, Scalar};
use std::cell::OnceCell;

/// What makes no difference to a product or a sum.
pub(super) const ONES: [f64; 2] = [1.0, 0.0];

/// So many values are put in the places where a wrong one may begin.
const MOST_BEGINNINGS: usize = 200;

pub(super) struct Search<'s, 'a> {
    pub evidence: &'s Evidence<'a>,
    pub assignment: &'s Assignment,
    /// The mistakes that a right answer has.
    pub others: &'s [FoundMistake],
    pub places: &'s [Place<'s>],
    pub in_quads: bool,
    pub theirs: &'s TracedProgram,
    pub traces: &'s [Option<Trace>; 2],
    pub own: &'s Seen,
    pub wanted: &'s Seen,
    pub quantities: &'s Quantities,
    pub trials: Trials<'s>,
    pub count: usize,
    /// What is changed already.
    pub base: StageChanges,
    /// The places of several mistakes, once they were looked for.
    pub chain: &'s OnceCell<Chain>,
    /// What the lines' features are made of, once it was asked for.
    pub features: &'s OnceCell<Vec<FeatureWay>>,
}

impl Search<'_, '_> {
    pub fn findings(&mut self) -> Vec<Finding> {
        let found = self.places();
        if !found.is_empty() {
            return found;
        }
        let chain = self.chain();
        let is_known = chain.is_whole && chain.links.iter().all(|link| link.finding.is_settled);
        let links = if is_known { &chain.links[..] } else { &[] };
        links.iter().map(|link| link.finding.clone()).collect()
    }

    /// The places that mend everything each by itself, or each beside the other.
    pub fn places(&mut self) -> Vec<Finding> {
        if let Some(declared) = self.otherwise_interpolated() {
            return vec![declared];
        }
        let mend = self.mend_but(None);
        if let Some(mend) = mend.as_ref().filter(|mend| self.is_telling(mend)) {
            return self.finding(mend).into_iter().collect();
        }
        // What goes out can always be mended: that is no place. Several places further back are.
        self.several().iter().filter_map(|mend| self.finding(mend)).collect()
    }

    pub fn trace(&self, stage: Stage) -> Option<&Trace> {
        self.traces[stage as usize].as_ref()
    }

    /// Whether values on the way of what is seen are what the right answer computes by this name, in each stage that has it.
    pub fn computes(&self, definition: &str) -> bool {
        let is_it = |own: &Quantity| own.names.iter().any(|name| name == definition);
        let has_it = |stage: &Stage| self.quantities.all.iter().any(|own| own.computed_in == *stage && is_it(own));
        const STAGES: [Stage; 2] = [Stage::Vertex, Stage::Fragment];
        let is_computed_in = |stage: Stage, of: Stage| {
            let Some(trace) = self.trace(stage) else { return false };
            let mut way = made_of(trace, &roots(trace)).into_iter();
            let is_it = |own: &Quantity| own.computed_in == of && is_it(own);
            way.any(|event| self.quantities.equals_any(stage, &trace.events[event], is_it))
        };
        let is_computed = |of: Stage| STAGES.into_iter().any(|stage| is_computed_in(stage, of));
        let stages: Vec<Stage> = STAGES.into_iter().filter(has_it).collect();
        !stages.is_empty() && stages.into_iter().all(is_computed)
    }

    /// The suspects of a stage.
    pub fn suspects(&self, stage: Stage) -> Vec<Suspect> {
        let Some(trace) = self.trace(stage) else { return Vec::new() };
        let program = self.theirs.stage(stage);
        suspects(program, trace, &|event| self.quantities.equal_to(stage, event).is_some())
    }

    /// The first place that mends everything by itself, other than one site.
    ///
    /// That is the first value which is not right. What it is made of is to blame in its place where that is right, but not
    /// finished: a vector that is not normalised, a cosine that is not clamped; or where it is the wrong one of its kind.
    pub fn mend_but(&mut self, but: Option<usize>) -> Option<Mend> {
        let all = [Stage::Vertex, Stage::Fragment].map(|stage| (stage, self.suspects(stage)));
        let all: Vec<(Stage, Suspect)> =
            all.into_iter().flat_map(|(stage, own)| own.into_iter().map(move |one| (stage, one))).collect();
        let all: Vec<(Stage, Suspect)> = all.into_iter().filter(|(_, one)| Some(one.site) != but).collect();
        let (own, handed_out): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|(stage, one)| self.is_students(*stage, one));
        let wrong = |(_, one): &&(Stage, Suspect)| !one.is_right && !one.gives_right;
        // What a loop computes right at first goes wrong by something else.
        let (late, early): (Vec<_>, Vec<_>) =
            own.iter().filter(wrong).partition(|(stage, one)| self.begins_right(*stage, one));
        let first = early.into_iter().chain(late).find_map(|(stage, one)| self.mend_at(*stage, one));
        // Where a value begins the same everywhere, and a condition decides what becomes of it, the condition counts.
        let first = match first {
            Some(first) if self.is_number(&first) => {
                let is_bool = |(stage, one): &&(Stage, Suspect)| self.is_bool(*stage, one);
                let conditions: Vec<(Stage, Suspect)> = own.iter().filter(is_bool).cloned().collect();
                let condition = conditions.iter().find_map(|(stage, one)| self.mend_at(*stage, one));
                Some(condition.unwrap_or(first))
            }
            first => first,
        };
        let is_literal = |mend: &Mend| self.site(mend.stage, &mend.suspect).what == What::Literal;
        if let Some(literal) = first.as_ref().filter(|mend| is_literal(mend)) {
            return Some(literal.clone());
        }
        // A sum that lacks terms is to blame, and not what it has, to which they could be added.
        let lack = if first.is_none() { self.lacking_sum(&own) } else { None };
        if lack.is_some() {
            return lack;
        }
        let givers = own.iter().filter(|(stage, one)| one.gives_right && self.is_assignment(*stage, one));
        let givers: Vec<(Stage, Suspect)> = givers.cloned().collect();
        let giver = givers.iter().find_map(|(stage, one)| self.mend_at(*stage, one));
        // Where the next step makes of it what it should be, and fails, that step is to blame.
        let is_same_end = |giver: &Mend| first.as_ref().is_some_and(|first| first.quantity == giver.quantity);
        let is_lack = first.as_ref().is_some_and(|first| self.missing_in(first).is_some());
        if let Some(giver) = giver.filter(|giver| !is_same_end(giver) && !is_lack) {
            return Some(self.beginning(&giver).unwrap_or(giver));
        }
        if let Some(first) = first {
            let found = self.operand(&first, &own).unwrap_or(first);
            return Some(self.beginning(&found).unwrap_or(found));
        }
        let rest = own.iter().filter(|(stage, one)| self.is_assignment(*stage, one)).chain(&handed_out);
        let rest: Vec<(Stage, Suspect)> = rest.cloned().collect();
        rest.iter().find_map(|(stage, one)| self.any_mend_at(*stage, one))
    }

    fn is_bool(&self, stage: Stage, suspect: &Suspect) -> bool {
        self.site(stage, suspect).kind.scalar() == Some(Scalar::Bool)
    }

    fn begins_right(&self, stage: Stage, suspect: &Suspect) -> bool {
        let first = suspect.events.first().zip(self.trace(stage)).map(|(event, trace)| &trace.events[*event]);
        suspect.events.len() > 1 && first.is_some_and(|first| self.quantities.equal_to(stage, first).is_some())
    }

    pub(super) fn is_assignment(&self, stage: Stage, suspect: &Suspect) -> bool {
        matches!(self.site(stage, suspect).what, What::Assign { .. })
    }

    /// A variable that a place reads, that is right, and that is the wrong one of its kind there. An argument counts before the
    /// parameter that it becomes.
    fn operand(&mut self, mend: &Mend, all: &[(Stage, Suspect)]) -> Option<Mend> {
        let near = self.operands(mend)?;
        let is_read = |(stage, one): &&(Stage, Suspect)| {
            let is_near = *stage == mend.stage && one.events.iter().any(|event| near.contains(event));
            is_near && (one.is_right || one.gives_right) && matches!(self.site(*stage, one).what, What::Read(_))
        };
        let reads: Vec<Suspect> = all.iter().filter(is_read).map(|(_, one)| one.clone()).collect();
        reads.into_iter().find_map(|one| self.mend_at(mend.stage, &one))
    }

    /// Where it begins that a place has the value of another one of its kind: the first variable on its way that is given what another
    /// place computes by itself, and with which another value, computed apart from it, makes all right.
    fn beginning(&mut self, mend: &Mend) -> Option<Mend> {
        let trace = self.trace(mend.stage)?;
        let sites = self.theirs.stage(mend.stage).sites();
        let named = |own: &&Quantity| !own.names.is_empty() && own.turns.len() == 1;
        let mut tried = Vec::new();
        for event in made_of(trace, &mend.suspect.events) {
            let site = trace.events[event].site;
            let is_only = trace.events.iter().filter(|other| other.site == site).count() == 1;
            let is_given = matches!(sites[site].what, What::Assign { is_part: false, .. });
            let right = self.quantities.equal_to(mend.stage, &trace.events[event]).filter(named);
            let Some(right) = right.filter(|_| is_only && is_given && site != mend.suspect.site) else { continue };
            let suspect = Suspect { site, events: vec![event], is_right: true, gives_right: true };
            let is_other = |own: &Mend| {
                let other = own.quantity.map(|number| &self.quantities.all[number]).filter(named);
                other.is_some_and(|other| {
                    other.turns[0].len() == right.turns[0].len() && self.quantities.are_apart(other, right)
                })
            };
            if self.is_students(mend.stage, &suspect) {
                let all = self.candidates(mend.stage, &suspect).into_iter().filter(is_other);
                tried.extend(all.filter(|own| self.is_computed_twice(own, trace)));
            }
        }
        tried.into_iter().take(MOST_BEGINNINGS).find(|own| self.mends(own))
    }

    pub fn site(&self, stage: Stage, suspect: &Suspect) -> &Site {
        let program: &Program = self.theirs.stage(stage);
        &program.sites()[suspect.site]
    }

    /// Whether the student wrote the line: what was handed out is right.
    pub fn is_students(&self, stage: Stage, suspect: &Suspect) -> bool {
        let line = self.site(stage, suspect).line;
        let Some((starter, source)) = self.texts(stage) else { return true };
        line == 0 || line > source.line_count() || !is_handed_out(source, line, starter)
    }

    /// The lines of a stage that the student wrote, the last first: less is made of what they compute.
    pub fn students_lines(&self, stage: Stage) -> impl Iterator<Item = u32> {
        let texts = self.texts(stage);
        let count = texts.map_or(0, |(_, source)| source.line_count());
        (1..=count)
            .rev()
            .filter(move |line| texts.is_some_and(|(starter, source)| !is_handed_out(source, *line, starter)))
    }

    /// What was handed out of a stage, and what was handed in.
    pub fn texts(&self, stage: Stage) -> Option<(&str, &Source)> {
        let starter = self.evidence.assignment.files.iter().find(|file| file.stage == stage)?;
        let (_, source) = self.evidence.sources.iter().find(|(own, _)| *own == stage)?;
        Some((starter.starter_shader(), source))
    }

    /// What has to stand in a place for all to be right, where the place is to blame.
    pub(super) fn mend_at(&mut self, stage: Stage, suspect: &Suspect) -> Option<Mend> {
        let all = self.candidates(stage, suspect);
        let all: Vec<Mend> = all.into_iter().filter(|mend| self.is_to_blame(mend)).collect();
        let found = all.into_iter().find(|mend| self.mends(mend))?;
        // A number that is computed or has a name is not wrong where any use of it would be right without it.
        let is_number = self.is_number(&found) && ONES.into_iter().any(|one| self.mends(&found.with_number(one)));
        (!is_number).then_some(found)
    }

    /// What has to stand in a place for all to be right.
    fn any_mend_at(&mut self, stage: Stage, suspect: &Suspect) -> Option<Mend> {
        let all = self.candidates(stage, suspect);
        let is_possible = |mend: &Mend| self.trace(stage).is_some_and(|trace| !self.is_right_elsewhere(mend, trace));
        let all: Vec<Mend> = all.into_iter().filter(is_possible).collect();
        all.into_iter().find(|mend| self.mends(mend))
    }

    /// Whether all that is seen is right with this in its place.
    pub fn mends(&mut self, mend: &Mend) -> bool {
        let changes = self.changes(mend);
        let wanted = self.wanted;
        self.trials.holds(&changes, &|seen, count| is_right(wanted, seen, count))
    }

    /// The colours at the first places with this in its place.
    pub fn seen_with(&mut self, mend: &Mend) -> Option<Vec<DVec3>> {
        let changes = self.changes(mend);
        Some(self.trials.at_first(&changes)?.colours)
    }

    /// The colours at all places with this in its place.
    pub fn seen_everywhere(&mut self, mend: &Mend) -> Option<Vec<DVec3>> {
        let changes = self.changes(mend);
        Some(self.trials.at_all(&changes)?.colours)
    }

    /// Whether everything stands where it should.
    pub fn is_in_place(&self, seen: &Seen) -> bool {
        is_in_place(self.wanted, seen, self.count)
    }

    /// Whether something stands where it should not. What is no number here may be drawn in its place all the same, as behind a branch
    /// that nobody defines.
    pub fn stands_elsewhere(&self, seen: &Seen) -> bool {
        let mut positions = seen.positions.iter().zip(&self.wanted.positions).filter(|(own, _)| own.is_finite());
        positions.any(|(own, wanted)| !is_same_place(*own, *wanted))
    }

    fn changes(&self, mend: &Mend) -> StageChanges {
        let mut changes = self.base.clone();
        changes[mend.stage as usize].push(mend.change());
        changes
    }
}

/// Whether what is seen at the first places is what should be.
pub(super) fn is_right(wanted: &Seen, seen: &Seen, count: usize) -> bool {
    let mut colours = seen.colours.iter().zip(&wanted.colours).take(count);
    colours.all(|(own, wanted)| is_colour(*wanted, *own)) && is_in_place(wanted, seen, count)
}

/// Whether everything stands where it should.
fn is_in_place(wanted: &Seen, seen: &Seen, count: usize) -> bool {
    let mut positions = seen.positions.iter().zip(&wanted.positions).take(count);
    positions.all(|(own, wanted)| is_same_place(*own, *wanted))
}

fn is_same_place(own: DVec4, wanted: DVec4) -> bool {
    let largest = wanted.abs().max_element().max(f64::MIN_POSITIVE);
    (own - wanted).abs().max_element() <= POSITION_TOLERANCE * largest
}
