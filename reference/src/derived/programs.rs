//! Slips of which each is a program of its own: of solutions that are no lists of definitions, and of functions beside `main`.

use super::{Derived, RESULT, definition, wording};
use crate::Assignment;
use crate::accepted::{AcceptedAnswer, Computed};
use crate::assignment::RubricItem;
use crate::equation::Reads;
use crate::fit::{Alternatives, Footprints, TOLERANCE, channel_agrees};
use crate::interpreter::{DISCARD, Operator, ProgramSlip, outline, program_slips, slips_of_variables};
use crate::mistake::{Condition, FoundMistake, Mistake};
use crate::probes::ProbeSet;
use std::collections::BTreeMap;

/// Probes under so many cameras tell most programs apart.
pub(crate) const FIRST: usize = 3;

/// What every program shows at the first probes of a set.
#[derive(Debug)]
pub(crate) struct Screen {
    seed: u64,
    /// The probes: those of some of the groups.
    places: Vec<usize>,
    shown: Vec<(FoundMistake, Vec<Computed>)>,
}

/// The mistakes of an assignment that are programs, the plainer ones first.
pub(super) fn mistakes(assignment: &Assignment) -> Vec<Mistake> {
    let mut grouped: BTreeMap<(Operator, String), Vec<(ProgramSlip, AcceptedAnswer)>> = BTreeMap::new();
    for file in &assignment.files {
        let is_part = |name: &str| assignment.equation.reads() == Reads::Outputs || name != "main";
        let own = outline::functions(&file.solution.text);
        let returns = |name: &str| own.iter().any(|function| function.name.text == name);
        let mut slips = program_slips(&file.solution.text, file.stage, &is_part).unwrap_or_default();
        if assignment.equation.reads() != Reads::Outputs {
            let only_moves = |name: &str| only_moves(assignment, name);
            slips.extend(slips_of_variables(&file.solution.text, file.stage, &only_moves).unwrap_or_default());
        }
        for slip in slips {
            let Some(mut answer) = assignment.linked_with(file, slip.program.clone(), &slip.text) else { continue };
            answer.slip = Some(Box::new((file.stage, slip.mark())));
            // What a function returns, and what decides what is thrown away, has a name where it is known what it is for.
            let is_variable = |name: &str| !returns(name) && name != DISCARD;
            let is_told = |name: &&String| is_variable(name) || assignment.is_told_apart(name);
            let name = slip.name.as_ref().filter(is_told).cloned().unwrap_or_else(|| RESULT.into());
            grouped.entry((slip.operator, name)).or_default().push((slip, answer));
        }
    }
    let mistake = |((operator, name), slips): ((Operator, String), Vec<(ProgramSlip, AcceptedAnswer)>)| {
        let (slips, answers): (Vec<_>, Vec<_>) = slips.into_iter().unzip();
        Mistake { variants: answers, ..wording::of_program(assignment, operator, &name, &slips) }
    };
    grouped.into_iter().map(mistake).collect()
}

/// Whether a variable of the solution only says where something stands, on the way to the position.
fn only_moves(assignment: &Assignment, name: &str) -> bool {
    let equation = &assignment.equation;
    let (Some(own), Some(position)) = (equation.index(name), equation.position) else { return false };
    own != position && equation.depends(position, own) && !equation.depends(equation.colour, own)
}

/// Adds mistakes to others, into those of the same name.
pub(super) fn add(all: &mut Vec<Mistake>, first: usize, more: Vec<Mistake>) {
    for mut mistake in more {
        let Some(known) = all[first..].iter_mut().find(|known| known.id == mistake.id) else {
            all.push(mistake);
            continue;
        };
        let before = known.ways();
        for (place, text) in mistake.instead.iter_mut().enumerate() {
            text.when = vec![Condition::Forms(vec![before + place])];
        }
        known.variants.append(&mut mistake.variants);
        known.instead.append(&mut mistake.instead);
    }
}

impl Derived {
    /// The mistakes that are programs, in their order.
    fn programs(&self) -> impl Iterator<Item = (FoundMistake, &AcceptedAnswer)> {
        self.mistakes().iter().flat_map(|mistake| {
            let ways = mistake.variants.iter().zip(mistake.forms.len()..);
            ways.map(|(program, form)| (FoundMistake { id: mistake.id.clone(), form, parameter: None }, program))
        })
    }

    /// The programs that may show what is shown at the first of these probes: `shows` says whether they do at a place.
    pub(crate) fn likely(&self, probes: &ProbeSet, shows: &dyn Fn(usize, &Computed) -> bool) -> Vec<FoundMistake> {
        let compute = || {
            let (places, part) = probes.part(FIRST);
            let programs = self.programs();
            let shown = programs.map(|(found, program)| (found, self.assignment.computed_by(program, &part)));
            Screen { seed: probes.seed, places, shown: shown.collect() }
        };
        let known = self.screen.get_or_init(compute);
        let other;
        let screen = if known.seed == probes.seed {
            known
        } else {
            other = compute();
            &other
        };
        let is_likely = |shown: &[Computed]| screen.places.iter().zip(shown).all(|(place, own)| shows(*place, own));
        screen.shown.iter().filter(|(_, shown)| is_likely(shown)).map(|(found, _)| found.clone()).collect()
    }

    /// What a mistake that is a program shows at probes.
    pub(crate) fn shown(&self, found: &FoundMistake, probes: &ProbeSet) -> Option<Vec<Computed>> {
        let program = self.assignment.mistake(&found.id)?.program(found.form)?;
        Some(self.assignment.computed_by(program, probes))
    }

    /// Whether a line is touched by a program: it is about what is given a value there, and is not where what it judges shows by
    /// itself, and is right there.
    pub(super) fn program_touches(&self, found: &FoundMistake, line: &RubricItem) -> bool {
        let judges_position = self.assignment.judges_position(line);
        let probes = self.judging();
        let Some(shown) = self.shown(found, probes) else { return true };
        let pairs = || probes.iter().zip(&shown);
        if judges_position {
            return pairs().any(|(probe, (_, position))| (probe.position - *position).abs().max_element() > TOLERANCE);
        }
        let is_right = |(at, channel): (usize, usize)| {
            channel_agrees(probes.probes[at].colour[channel], shown[at].0[channel], TOLERANCE)
        };
        let alternatives = Alternatives::new(&self.assignment, probes);
        let judged = Footprints::of(&alternatives, TOLERANCE).judged(&is_right);
        let about = self.lines_about(found);
        let rubric = self.assignment.rubric.iter().enumerate();
        let mut colours = rubric.filter(|(_, own)| {
            !self.assignment.judges_position(own) && (about.is_empty() || about.contains(&own.id.as_str()))
        });
        let is_touched = |number: usize| {
            let own = judged.iter().find(|judged| judged.line == number);
            own.is_none_or(|judged| !judged.is_right)
        };
        // What nothing shows by itself is wrong where it is made of what is wrong, and the others with it.
        let is_hidden = |(number, own): (usize, &RubricItem)| {
            self.assignment.judges_the_rest(own) && !judged.iter().any(|judged| judged.line == number)
        };
        if let Some((_, hidden)) = colours.clone().find(|own| is_hidden(*own)) {
            return hidden.id == line.id;
        }
        // Where every line is right by itself, it is what they have in common.
        let is_any = colours.clone().any(|(number, _)| is_touched(number));
        colours.any(|(number, own)| own.id == line.id && (!is_any || is_touched(number)))
    }

    /// Probes that judge.
    pub(super) fn judging(&self) -> &ProbeSet {
        self.judging.get_or_init(|| self.assignment.judging_probes())
    }

    /// The lines of the colour that are about what a mistake is in.
    pub(super) fn lines_about(&self, found: &FoundMistake) -> Vec<&str> {
        let about = definition(&found.id).into_iter().flat_map(|name| self.assignment.lines_owning(name));
        about.filter(|line| !self.assignment.judges_position(line)).map(|line| line.id.as_str()).collect()
    }
}
