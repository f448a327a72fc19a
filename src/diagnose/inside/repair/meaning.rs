//! What a change of the text means: which definition of the right answer it concerns.

use super::{RepairAttempt, RepairStep, Repaired};
use crate::diagnose::columns::is_same;
use crate::diagnose::inside::quantities::Quantity;
use crate::diagnose::inside::search::Search;
use crate::diagnose::inside::variable;
use crate::diagnose::locate::{Located, MistakeOrigin};
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges};
use reference::interpreter::trace::{Event, Trace, What};
use reference::interpreter::{Operator, Program, ProgramRepair, Stage};
use reference::traced::Bench;

impl Search<'_, '_> {
    /// What is known of a change.
    pub(super) fn repaired(&self, attempt: &RepairAttempt, (stage, repair): &RepairStep) -> Option<Repaired> {
        let marked = attempt.program.with(*stage, attempt.text(*stage)?.traced(repair)?)?;
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
        let is_it = |own: &&Quantity| {
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
