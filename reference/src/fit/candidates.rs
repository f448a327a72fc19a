//! What a search puts into the equation: the forms of the mistakes.

use super::columns::{Replaced, Resolved, RuleColumns, Set};
use super::{MOST_MISTAKES, agrees};
use crate::Assignment;
use crate::mistake::{FreeParameter, Mistake, MistakeForm};
use std::rc::Rc;

/// One form of one mistake.
pub(super) struct Candidate<'a> {
    pub mistake: usize,
    pub form: usize,
    /// The definitions that are replaced.
    pub touches: Set,
    /// The rubric lines that it costs points, as bits.
    pub lines: u64,
    /// The rubric lines of which it leaves nothing.
    empties: u64,
    /// Whether it is in what becomes of all terms.
    pub is_of_all: bool,
    /// Whether nothing of the rubric's terms is left in the colour: such a mistake stands alone.
    pub whole: bool,
    pub replaced: Vec<Replaced>,
    pub free: Option<&'a FreeParameter>,
}

impl Candidate<'_> {
    /// What it replaces, with a number for what is free in it.
    pub(super) fn with(&self, parameter: f64) -> Vec<Replaced> {
        self.replaced.iter().map(|replaced| Replaced { parameter, ..*replaced }).collect()
    }
}

/// A candidate of an explanation, and the value of what is free in it.
pub(super) type ChosenCandidate<'a> = (Rc<Candidate<'a>>, Option<f64>);

/// All forms of all mistakes, in the order in which they are tried.
pub(super) fn candidates<'a>(assignment: &'a Assignment, columns: &mut RuleColumns<'a>) -> Vec<Rc<Candidate<'a>>> {
    let mut all = Vec::new();
    for (index, mistake) in assignment.mistakes.iter().enumerate() {
        for (place, form) in mistake.forms.iter().enumerate() {
            let free = mistake.fit.as_ref().filter(|_| form.free);
            all.push(Rc::new(Candidate {
                mistake: index,
                form: place,
                touches: form.overrides.iter().map(|o| 1 << o.definition).sum(),
                lines: lines(assignment, mistake, form, 1.0),
                empties: lines(assignment, mistake, form, f64::MIN_POSITIVE),
                is_of_all: is_of_all(assignment, form),
                whole: replaces_everything(assignment, form),
                replaced: rules(columns, form),
                free,
            }));
        }
    }
    // Stable: the table's order decides among forms that replace the same.
    all.sort_by_key(|c| c.replaced.first().map(|r| r.definition));
    all
}

fn rules<'a>(columns: &mut RuleColumns<'a>, form: &'a MistakeForm) -> Vec<Replaced> {
    let overrides = form.overrides.iter();
    overrides
        .map(|o| Replaced { definition: o.definition, rule: columns.rule(&o.formula), parameter: f64::NAN })
        .collect()
}

/// Whether a candidate of this line alone changes what is seen to be right, even if another could make up for it.
///
/// `places`: where the line's term stands alone and agrees, as places in the order of the columns.
pub(super) fn is_refuted(
    candidate: &Candidate<'_>,
    line: usize,
    places: &[usize],
    columns: &mut RuleColumns<'_>,
    right: &Resolved,
    tolerance: f64,
) -> bool {
    let parameters = candidate.free.map_or([f64::NAN; 2], |free| [free.from, free.to]);
    !candidate.is_of_all
        && candidate.lines == 1 << line
        && parameters.into_iter().all(|parameter| {
            let replaced = candidate.with(parameter);
            places.iter().any(|place| {
                let expected = columns.colour(columns.colour_column(right), *place);
                !agrees(expected, columns.colour_with(right, &replaced, *place), tolerance)
            })
        })
}

/// The lines of which less is kept than this, as bits.
fn lines(assignment: &Assignment, mistake: &Mistake, form: &MistakeForm, fraction: f64) -> u64 {
    let rubric = assignment.rubric.iter().enumerate();
    let lost = rubric.filter(|(_, line)| mistake.keeps(&line.id) < fraction && assignment.reaches(form, line));
    lost.map(|(place, _)| 1 << place).sum()
}

/// Whether the form replaces nothing before a term.
fn is_of_all(assignment: &Assignment, form: &MistakeForm) -> bool {
    let equation = &assignment.equation;
    let judged = || assignment.rubric.iter().filter_map(|line| equation.index(&line.judges));
    let replaced = form.overrides.iter().map(|o| o.definition);
    !replaced
        .clone()
        .any(|definition| judged().any(|term| Some(term) != equation.position && equation.depends(term, definition)))
}

/// Whether the form's colour depends on no definition that the rubric judges.
fn replaces_everything(assignment: &Assignment, form: &MistakeForm) -> bool {
    let equation = &assignment.equation;
    let judged = |d: usize| {
        let name = &equation.definitions[d].name;
        assignment.rubric.iter().any(|line| line.judges == *name)
    };
    let mut open = vec![equation.colour];
    while let Some(definition) = open.pop() {
        if judged(definition) {
            return false;
        }
        let replaced = form.overrides.iter().find(|o| o.definition == definition);
        let right = &equation.definitions[definition].formula;
        open.extend(equation.used(replaced.map_or(right, |o| &o.formula)));
    }
    true
}

/// Whether a candidate goes with the chosen ones: another mistake, in other definitions, and not the third in one line of the
/// rubric, for no term with three mistakes in it can be named with confidence. What is missing is not wrong as well.
///
/// `free`: one of the mistakes is to have a free parameter. Then not even two of three are in the same lines, and none is in
/// what becomes of all terms, because a number to choose makes up for nearly anything.
pub(super) fn fits(chosen: &[ChosenCandidate<'_>], new: &Candidate<'_>, free: bool) -> bool {
    let is_last = chosen.len() + 1 == MOST_MISTAKES;
    let clash = |(c, _): &ChosenCandidate| {
        let empty = c.empties & new.lines == new.lines || new.empties & c.lines == c.lines;
        c.mistake == new.mistake || c.touches & new.touches != 0 || empty
    };
    let shared = chosen.iter().fold(new.lines, |lines, (c, _)| lines & c.lines);
    let crowded = |(c, _): &ChosenCandidate| c.lines == new.lines || c.is_of_all || new.is_of_all;
    !chosen.iter().any(clash) && !(is_last && (shared != 0 || free && chosen.iter().any(crowded)))
}
