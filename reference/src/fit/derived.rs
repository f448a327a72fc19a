//! Looking for derived mistakes, where the written ones explain nothing: alone, then two at once, one of which may be written.

use super::candidates::{Candidate, fits};
use super::columns::Resolved;
use super::search::MistakeSearch;
use super::slips::program;
use super::{agrees, alternating, padded};
use crate::Assignment;
use crate::accepted::Computed;
use crate::derived::Derived;
use crate::equation::Equation;
use crate::mistake::FoundMistake;
use crate::probes::ProbeSet;
use glam::{DVec3, DVec4};
use std::rc::Rc;

/// What is computed in search of two mistakes without numbers, before it is given up; with numbers, see
/// [`super::columns::RuleColumns::work`]. Some 0.2 s in all.
const WORK_FOR_TWO: u64 = 12_000_000;
const WORK_FOR_NUMBERS: u64 = 3_000_000;

/// Where a pair in different terms is tried by adding up what each changes.
const SUMMED_AT: usize = 3;

/// Looks for so many mistakes, one or two, that explain `samples`, at least one of them derived, see [`super::explain`].
///
/// `is_there`: whether a sample's position is a given one.
pub fn explain_derived(
    count: usize,
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> Option<Vec<FoundMistake>> {
    let derived = assignment.derived();
    if derived.mistakes().is_empty() {
        return None;
    }
    let samples = padded(probes, samples);
    // Nearly everything explains what is nearly nowhere a number.
    if 2 * samples.iter().filter(|sample| sample.is_finite()).count() < samples.len() {
        return None;
    }
    // What is the same everywhere is computed from nothing.
    if samples.iter().all(|sample| agrees(samples[0], *sample, tolerance)) {
        return None;
    }
    let is_right = |place: &usize| agrees(probes.probes[*place].colour, samples[*place], tolerance);
    let (rest, wrong): (Vec<_>, Vec<_>) = (0..samples.len()).partition(is_right);
    let order = alternating(&wrong, &rest);
    let (search, right) = MistakeSearch::new(&derived.assignment, probes, &samples, &order, tolerance);
    let mut pairs = Pairs::new(derived, search, right);
    let moves = |found: &Vec<FoundMistake>| moves_as_seen(&derived.assignment, found, probes, is_there);
    let shows = |place: usize, (colour, position): &Computed| {
        agrees(*colour, samples[place], tolerance) && is_there(place, *position)
    };
    match count {
        1 => {
            pairs.alone().filter(moves).or_else(|| program(derived, probes, &shows, &|_| true).map(|found| vec![found]))
        }
        _ => pairs.together().filter(moves),
    }
}

/// Whether the positions are those that a right answer with these mistakes has, as far as the mistakes change them.
fn moves_as_seen(
    assignment: &Assignment,
    found: &[FoundMistake],
    probes: &ProbeSet,
    is_there: &dyn Fn(usize, DVec4) -> bool,
) -> bool {
    let equation = &assignment.equation;
    let Some(position) = equation.position else { return true };
    let forms = || found.iter().filter_map(|one| assignment.mistake(&one.id)?.forms.get(one.form));
    let mut replaced = forms().flat_map(|form| form.overrides.iter().map(|one| one.definition));
    if !replaced.any(|definition| equation.depends(position, definition)) {
        return true;
    }
    let Some(variant) = assignment.variant(found) else { return false };
    let expected = |probe| variant.evaluate(probes.uniforms(probe), &probe.attributes).position();
    probes.iter().enumerate().all(|(place, probe)| is_there(place, expected(probe)))
}

struct Pairs<'a> {
    derived: &'a Derived,
    search: MistakeSearch<'a>,
    right: Resolved,
}

/// What a candidate without a free number adds to the colour at the first places, and to which terms.
struct Contribution {
    terms: u64,
    colours: [DVec3; SUMMED_AT],
}

impl<'a> Pairs<'a> {
    fn new(derived: &'a Derived, search: MistakeSearch<'a>, right: Resolved) -> Self {
        Self { derived, search, right }
    }

    fn is_derived(&self, candidate: &Candidate<'_>) -> bool {
        candidate.mistake >= self.derived.first
    }

    fn found(&mut self) -> Option<Vec<FoundMistake>> {
        self.search.best.take().map(|(_, found)| found)
    }

    /// One derived mistake: one without a number first.
    fn alone(&mut self) -> Option<Vec<FoundMistake>> {
        self.search.count = 1;
        let candidates: Vec<_> =
            self.search.candidates.iter().filter(|one| self.is_derived(one) && !one.whole).map(Rc::clone).collect();
        let (free, fixed): (Vec<_>, Vec<_>) = candidates.into_iter().partition(|one| one.free.is_some());
        for candidate in fixed {
            if self.search.explains(&self.right, &candidate.replaced) {
                self.search.keep(&[], &[(candidate, None)]);
            }
        }
        if self.search.best.is_some() {
            return self.found();
        }
        for candidate in free {
            if let Some(solved) = self.search.solve_all(&self.right, &[candidate]) {
                self.search.keep(&[], &solved);
            }
        }
        self.found()
    }

    /// Two mistakes.
    fn together(&mut self) -> Option<Vec<FoundMistake>> {
        self.search.count = 2;
        self.search.allow(WORK_FOR_TWO);
        let is_usual =
            |one: &&Rc<Candidate<'_>>| !one.whole && (!self.is_derived(one) || self.derived.is_usual(one.mistake));
        let all: Vec<_> = self.search.candidates.iter().filter(is_usual).map(Rc::clone).collect();
        let (free, fixed): (Vec<_>, Vec<_>) = all.into_iter().partition(|one| one.free.is_some());
        let added: Vec<Contribution> = fixed.iter().map(|one| self.added(one)).collect();
        self.in_different_terms(&fixed, &added);
        self.one_after_the_other(&fixed, &added);
        if self.search.best.is_some() {
            return self.found();
        }
        self.search.allow(WORK_FOR_NUMBERS);
        self.with_a_number(&fixed, &free);
        if self.search.best.is_none() {
            self.with_two_numbers(&free);
        }
        self.found()
    }

    fn added(&mut self, candidate: &Candidate<'_>) -> Contribution {
        let equation = &self.derived.assignment.equation;
        let mut colours = [DVec3::ZERO; SUMMED_AT];
        for (place, colour) in colours.iter_mut().enumerate().take(self.search.samples.len()) {
            let columns = &mut self.search.columns;
            let with = columns.unclamped_with(&self.right, &candidate.replaced, place);
            *colour = with - columns.unclamped_with(&self.right, &[], place);
        }
        Contribution { terms: terms(equation, self.derived.terms, candidate), colours }
    }

    /// Pairs of which each is in a term of its own: what they add to the colour adds up.
    fn in_different_terms(&mut self, fixed: &[Rc<Candidate<'a>>], added: &[Contribution]) {
        let places = SUMMED_AT.min(self.search.samples.len());
        let equation = &self.derived.assignment.equation;
        let right: Vec<DVec3> =
            (0..places).map(|place| self.search.columns.unclamped_with(&self.right, &[], place)).collect();
        for (at, one) in fixed.iter().enumerate().filter(|(at, _)| added[*at].terms != 0) {
            for (before, other) in fixed[..at].iter().enumerate() {
                if added[before].terms == 0 || added[before].terms & added[at].terms != 0 {
                    continue;
                }
                let agrees = |place: usize| {
                    let sum = right[place] + added[at].colours[place] + added[before].colours[place];
                    agrees(equation.clamped(sum), self.search.samples[place], self.search.tolerance)
                };
                if (0..places).all(agrees) && (self.is_derived(one) || self.is_derived(other)) {
                    self.try_both(one, other);
                }
            }
        }
    }

    fn try_both(&mut self, one: &Rc<Candidate<'a>>, other: &Rc<Candidate<'a>>) {
        let chosen = [(Rc::clone(other), None)];
        if fits(&chosen, one, false) {
            let resolved = self.search.columns.derive(&self.right, &other.replaced);
            if self.search.explains(&resolved, &one.replaced) {
                self.search.keep(&chosen, &[(Rc::clone(one), None)]);
            }
        }
    }

    /// Pairs that act on the same terms.
    fn one_after_the_other(&mut self, fixed: &[Rc<Candidate<'a>>], added: &[Contribution]) {
        for (at, first) in fixed.iter().enumerate() {
            let chosen = [(Rc::clone(first), None)];
            let resolved = self.search.columns.derive(&self.right, &first.replaced);
            for (next, second) in fixed.iter().enumerate().skip(at + 1) {
                let is_apart =
                    added[at].terms != 0 && added[next].terms != 0 && added[at].terms & added[next].terms == 0;
                if is_apart || !(self.is_derived(first) || self.is_derived(second)) || !fits(&chosen, second, false) {
                    continue;
                }
                if self.search.is_spent() {
                    return;
                }
                if self.search.explains(&resolved, &second.replaced) {
                    self.search.keep(&chosen, &[(Rc::clone(second), None)]);
                }
            }
        }
    }

    /// A mistake and one with a number.
    fn with_a_number(&mut self, fixed: &[Rc<Candidate<'a>>], free: &[Rc<Candidate<'a>>]) {
        for first in fixed {
            let chosen = [(Rc::clone(first), None)];
            let resolved = self.search.columns.derive(&self.right, &first.replaced);
            for second in free {
                // A number makes nearly anything of what else is wrong in the same term.
                let makes_up = second.is_of_all || second.lines & first.lines != 0;
                if makes_up || !(self.is_derived(first) || self.is_derived(second)) || !fits(&chosen, second, true) {
                    continue;
                }
                if self.search.is_spent() {
                    return;
                }
                if let Some(solved) = self.search.solve_all(&resolved, &[Rc::clone(second)]) {
                    self.search.keep(&chosen, &solved);
                }
            }
        }
    }

    /// Two mistakes with numbers, each in lines of its own.
    fn with_two_numbers(&mut self, free: &[Rc<Candidate<'a>>]) {
        for (at, first) in free.iter().enumerate() {
            for second in &free[at + 1..] {
                let shares = first.lines & second.lines != 0 || first.touches & second.touches != 0;
                if shares || !(self.is_derived(first) || self.is_derived(second)) {
                    continue;
                }
                if self.search.is_spent() {
                    return;
                }
                if let Some(solved) = self.search.solve_all(&self.right, &[Rc::clone(first), Rc::clone(second)]) {
                    self.search.keep(&[], &solved);
                }
            }
        }
    }
}

/// The terms through which alone a candidate acts on the colour; none where it acts on it in another way.
fn terms(equation: &Equation, summed: u64, candidate: &Candidate<'_>) -> u64 {
    let is_term = |definition: usize| summed & (1 << definition) != 0;
    // What the colour uses beside the terms.
    let mut beside = vec![equation.colour];
    let mut seen: u64 = 0;
    while let Some(definition) = beside.pop() {
        if !is_term(definition) && seen & (1 << definition) == 0 {
            seen |= 1 << definition;
            beside.extend(equation.used(&equation.definitions[definition].formula));
        }
    }
    if summed == 0 || candidate.touches & seen != 0 {
        return 0;
    }
    let replaced = || candidate.replaced.iter().map(|replaced| replaced.definition);
    let reached = |term: &usize| replaced().any(|definition| equation.depends(*term, definition));
    (0..equation.definitions.len()).filter(|d| is_term(*d)).filter(reached).map(|term| 1 << term).sum()
}
