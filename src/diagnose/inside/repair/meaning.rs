//! What a change of the text means: which definition of the right answer it concerns.

use super::marks::{
    computed_from_the_mark, is_count, is_marked, is_number_too_many, is_of_use, made_for, reached_values,
};
use super::{RepairAttempt, RepairStep, Repaired};
use crate::diagnose::columns::{is_colour, is_constant, is_equal, is_same};
use crate::diagnose::inside::candidates::Mend;
use crate::diagnose::inside::chain::Link;
use crate::diagnose::inside::quantities::Quantity;
use crate::diagnose::inside::search::Search;
use crate::diagnose::inside::{Finding, Flaw, variable};
use crate::diagnose::locate::{Located, MistakeOrigin};
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges};
use crate::source::words;
use reference::equation::DISCARDED;
use reference::interpreter::trace::{Event, Trace, What};
use reference::interpreter::{DISCARD, Operator, Program, ProgramRepair, Stage};
use reference::mistake::Mistake;
use reference::traced::{Bench, Seen, TracedProgram};

/// So many values that come of a change are looked for in the solution.
const MOST_REACHED: usize = 200;

impl Search<'_, '_> {
    /// What is known of a change.
    pub(super) fn repaired(&self, attempt: &RepairAttempt, step: &RepairStep) -> Option<Repaired> {
        let (marked, seen, trace) = self.marked(attempt, step)?;
        let (stage, repair) = step;
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
        let marks = program.sites().iter().position(|site| site.line == ProgramRepair::MARK);
        // Where a loop begins and ends is no part of what it computes first.
        let is_of_loop = marks.is_some_and(|site| is_count(program.sites(), site));
        let definition = definition.filter(|_| !is_of_loop);
        let definition = definition.or_else(|| self.decides_what_is_drawn(attempt, &seen).then(|| DISCARD.to_owned()));
        let terms = self.changed_terms(&attempt.program, &marked).unwrap_or_default();
        let definition = definition.filter(|name| self.goes_into_all(name, &terms));
        // What stands in the text of one line's feature is not called after another line.
        let is_of_another = |name: &String| {
            let own = self.assignment.only_line_with(&repair.texts[1]);
            let mut about = self.assignment.lines_about(name).peekable();
            own.is_some_and(|own| about.peek().is_some() && about.all(|line| line.id != own.id))
        };
        let definition = definition.filter(|name| !is_of_another(name));
        let mistake = self.assignment.repaired(operator, definition.as_deref(), repair.is_bound_by_zero);
        // What another value stands for is what it is used for.
        let is_used = definition.is_none() || is_of_use(repair.mistake);
        let name_of = if is_used { made_for } else { variable };
        let name = marks.and_then(|site| name_of(program.sites(), site));
        let left = left_behind(&repair.texts);
        let role = if left.is_some() { MistakeOrigin::LeftBehind } else { MistakeOrigin::Wrong };
        let name = left.or(name);
        Some(Repaired {
            mistake,
            operator: Some(operator),
            located: Some(Located { line: repair.line, name, role, stage: Some(*stage) }),
            texts: repair.texts.clone(),
            numbers: None,
            lines: if is_of_loop { Vec::new() } else { self.lines_that_it_is_in(program, &trace, repair.mistake) },
            moves: self.stands_elsewhere(&attempt.seen) && self.is_in_place(&seen),
            touches: definition.map_or_else(Vec::new, |name| self.quantities.spoilt_by(*stage, &name)),
            terms,
            written_over: self.held_before(*stage, program, &trace),
        })
    }

    /// The names of what a variable holds where a change gives it another value; of a sum that has none those of its addends.
    fn held_before(&self, stage: Stage, program: &Program, trace: &Trace) -> Vec<String> {
        let what = |event: &Event| &program.sites()[event.site].what;
        let gives = |event: &Event| is_marked(program, event) && matches!(what(event), What::Assign { .. });
        let own = trace.events.iter().position(gives).and_then(|at| {
            let What::Assign { name: given, .. } = what(&trace.events[at]) else { return None };
            let holds =
                |event: &&Event| matches!(what(event), What::Read(name) | What::Assign { name, .. } if name == given);
            trace.events[..at].iter().rev().find(holds)
        });
        let named = own.and_then(|own| self.named(stage, own, true));
        let sum = || own.and_then(|own| self.quantities.equal_to(stage, own));
        let addends = || sum().into_iter().flat_map(|sum| &sum.addends).filter_map(|(name, _)| name.clone()).collect();
        named.map_or_else(addends, |name| vec![name])
    }

    /// The program with a change on the line [`ProgramRepair::MARK`], what is seen of it, and the values of the stage that is changed.
    fn marked(&self, attempt: &RepairAttempt, (stage, repair): &RepairStep) -> Option<(TracedProgram, Seen, Trace)> {
        let marked = attempt.program.with(*stage, attempt.text(*stage)?.traced(repair)?)?;
        let mut bench = Bench::new(self.assignment, &marked, self.places, self.in_quads, FUEL_OF_TRACE)?;
        let (seen, mut traces) = bench.trace(&StageChanges::default())?;
        let trace = traces[*stage as usize].take()?;
        Some((marked, seen, trace))
    }

    /// Whether another value, or its direction, is right by chance only: a function makes of it what is the same everywhere, as of any
    /// unit vector its length.
    pub(super) fn is_by_chance(&self, attempt: &RepairAttempt, step: &RepairStep) -> bool {
        let (stage, repair) = step;
        let Some((marked, _, trace)) = self.marked(attempt, step) else { return false };
        let program = marked.stage(*stage);
        let is_computed = computed_from_the_mark(program, &trace);
        let varies = |from: &usize| !is_constant(&trace.events[*from].values);
        let is_level = |event: &Event| {
            let is_of_function = matches!(program.sites()[event.site].what, What::Call(_));
            is_of_function && is_constant(&event.values)
        };
        // A function that is put there leaves nothing of a value.
        if trace
            .events
            .iter()
            .any(|event| is_marked(program, event) && is_level(event) && event.from.iter().any(varies))
        {
            return true;
        }
        if !matches!(repair.mistake, Operator::OtherValue | Operator::OtherNumber | Operator::NormalizeLeftOut) {
            return false;
        }
        let is_made_of = |from: &usize| is_computed[*from] && varies(from);
        trace.events.iter().any(|event| is_level(event) && event.from.iter().any(is_made_of))
            || self.levels(&attempt.program, &marked)
    }

    /// Whether a function gives the same everywhere with a change, and not without it.
    fn levels(&self, before: &TracedProgram, after: &TracedProgram) -> bool {
        let traces = |program: &TracedProgram| {
            let mut bench = Bench::new(self.assignment, program, self.places, self.in_quads, FUEL_OF_TRACE)?;
            Some(bench.trace(&StageChanges::default())?.1)
        };
        let Some((own, changed)) = traces(before).zip(traces(after)) else { return false };
        [Stage::Vertex, Stage::Fragment].into_iter().any(|stage| {
            let Some((own, changed)) = own[stage as usize].as_ref().zip(changed[stage as usize].as_ref()) else {
                return false;
            };
            let sites = after.stage(stage).sites();
            let is_level = |(own, changed): (&Event, &Event)| {
                let is_of_function = own.site == changed.site && matches!(sites[changed.site].what, What::Call(_));
                is_of_function && is_constant(&changed.values) && !is_constant(&own.values)
            };
            own.events.len() == changed.events.len() && own.events.iter().zip(&changed.events).any(is_level)
        })
    }

    /// The lines of the rubric within whose features a change is, by the values that come of it.
    fn lines_that_it_is_in(&self, program: &Program, trace: &Trace, mistake: Operator) -> Vec<String> {
        self.lines_around(reached_values(program, trace, mistake).into_iter().take(MOST_REACHED))
    }

    /// Whether a place by itself says what is wrong: something is computed there from what is right, and is one of the values of the
    /// right answer.
    fn is_known_alone(&self, link: &Link) -> bool {
        let Finding { is_whole, flaw, serves, .. } = &link.finding;
        link.is_computed && !is_whole && *flaw == Flaw::Value && serves.is_some()
    }

    /// Whether places by themselves say what is wrong: each stands on a line of its own.
    pub(super) fn are_known(&self, links: &[Link]) -> bool {
        let place = |link: &Link| (link.mend.stage as usize, link.finding.line);
        let is_twice = |(number, link): (usize, &Link)| links[..number].iter().any(|own| place(own) == place(link));
        links.iter().all(|link| self.is_known_alone(link)) && !links.iter().enumerate().any(is_twice)
    }

    /// A mistake for which there is no change of the text, at the place where it stands.
    pub(super) fn known_at(&self, mistake: Mistake, finding: &Finding) -> Repaired {
        let written =
            self.texts(finding.stage).map_or_else(String::new, |(_, source)| source.line(finding.line).into());
        Repaired {
            located: Some(finding.located()),
            texts: [written, String::new()],
            touches: finding.touches.clone(),
            ..Repaired::of(mistake)
        }
    }

    /// What is known of a place for which there is no change of the text.
    pub(super) fn computed_otherwise(&self, Link { mend, finding, .. }: &Link) -> Repaired {
        let own = finding.quantity.as_ref().or(finding.serves.as_ref());
        let is_judged = |name: &&String| self.assignment.is_judged(name);
        let definition = own.filter(is_judged).cloned().or_else(|| self.judged_operand(mend)).or(own.cloned());
        let mistake = self.assignment.repaired(Operator::Otherwise, definition.as_deref(), false);
        let lines = self.lines_around(self.mended(mend));
        Repaired { numbers: finding.numbers(), lines, ..self.known_at(mistake, finding) }
    }

    /// The one variable that a value is computed from at once and that a line of the rubric is about.
    fn judged_operand(&self, mend: &Mend) -> Option<String> {
        let all = &self.quantities.all;
        let operands = self.quantities.made_from(&all[mend.quantity?]);
        let is_operand = |own: &&Quantity| own.turns.iter().any(|turn| operands.iter().any(|one| is_equal(one, turn)));
        let names = all.iter().filter(is_operand).flat_map(|own| &own.names);
        let mut judged: Vec<&String> = names.filter(|name| self.assignment.is_judged(name)).collect();
        judged.sort_unstable();
        judged.dedup();
        if let [name] = judged[..] { Some(name.clone()) } else { None }
    }

    /// Whether a change only decides what is drawn and what is thrown away. `seen`: with it.
    fn decides_what_is_drawn(&self, attempt: &RepairAttempt, seen: &Seen) -> bool {
        let Some(before) = self.shown(&attempt.program, self.places, FUEL_OF_TRACE) else { return false };
        let mut moved = before.colours.iter().zip(&seen.colours).filter(|(a, b)| !is_colour(**a, **b)).peekable();
        moved.peek().is_some() && moved.all(|(a, b)| (*a == DISCARDED) != (*b == DISCARDED))
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
        let is_of_use = is_of_use(mistake);
        let mut is_reached = vec![false; trace.events.len()];
        for (number, event) in trace.events.iter().enumerate() {
            let is_marked = sites[event.site].line == ProgramRepair::MARK;
            is_reached[number] = is_marked || event.from.iter().any(|from| is_reached[*from]);
            if !is_reached[number] || is_marked && is_of_use {
                continue;
            }
            let is_given = matches!(sites[event.site].what, What::Assign { .. });
            // What the text has right without the change is not what it concerns: it is only handed over beside it.
            if let Some(name) = self.named(stage, event, is_given).filter(|name| is_marked || !self.has(stage, name)) {
                return Some((name, is_marked));
            }
        }
        None
    }

    /// Whether the student's text as it is computes a definition.
    fn has(&self, stage: Stage, name: &str) -> bool {
        let is_it = |own: &Quantity| own.names.iter().any(|own| own == name);
        let events = self.trace(stage).into_iter().flat_map(|trace| &trace.events);
        events.into_iter().any(|event| self.quantities.equals_any(stage, event, is_it))
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
        let is_it = |own: &&Quantity| {
            own.stage == stage
                && !own.names.is_empty()
                && (is_given || !own.is_constant)
                && own.turns.iter().any(|turn| is_same(event, turn))
        };
        self.quantities.all.iter().find(is_it)?.names.first().cloned()
    }
}

/// The variable of an assignment that has to go, where that does not make something of what the variable holds.
fn left_behind([written, instead]: &[String; 2]) -> Option<String> {
    let (to, from) = written.split_once('=').filter(|_| instead.is_empty())?;
    let makes_something = to.trim_end().ends_with(['+', '-', '*', '/']);
    let (_, name) = words(to).next().filter(|_| !makes_something)?;
    (!words(from).any(|(_, word)| word == name)).then(|| name.to_owned())
}
