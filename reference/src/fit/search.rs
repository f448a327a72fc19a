//! Trying combinations of mistakes: the fewest first, and of as many those with the fewest free parameters.

use super::candidates::{Candidate, ChosenCandidate, candidates, fits, is_refuted};
use super::columns::{Replaced, Resolved, RuleColumns};
use super::views::Views;
use super::{MOST_MISTAKES, agrees};
use crate::Assignment;
use crate::mistake::FoundMistake;
use crate::probes::ProbeSet;
use glam::DVec3;
use std::ops::RangeInclusive;
use std::rc::Rc;

/// What is computed in search of two mistakes at once before it is given up, and in search of three with so many numbers, see
/// [`RuleColumns::work`]. Some samples, such as those of a shader that looks its colours up, agree with thousands of combinations at
/// many probes.
///
/// Measured on 223 slips in sixteen homeworks: three mistakes were found with 4 million at most. A million takes some 15 ms.
const WORK_FOR_TWO: u64 = 14_000_000;
const WORK_FOR_THREE: u64 = 4_500_000;

pub(super) struct MistakeSearch<'a> {
    pub assignment: &'a Assignment,
    pub columns: RuleColumns<'a>,
    /// In the order of the definitions that they replace: what is replaced last has the least to recompute.
    pub candidates: Vec<Rc<Candidate<'a>>>,
    /// In the order in which they are tried.
    pub samples: Vec<DVec3>,
    pub tolerance: f64,
    /// How many mistakes are looked for at present.
    pub count: usize,
    /// The work after which it is given up.
    budget: u64,
    /// The most plausible explanation so far.
    pub best: Option<(ExplanationRank, Vec<FoundMistake>)>,
}

/// How plausible an explanation is among others of as many mistakes; less is more.
///
/// Mistakes that touch few lines of the rubric come before those that upset everything, and then the table's order decides: an
/// answer without diffuse and specular term is just that, and not one with a reversed light and a constant normal.
pub(super) type ExplanationRank = (u32, Vec<usize>);

/// The mistakes that explain samples that are not all right; `None` if nothing explains them.
///
/// `order`: the places of all samples, in the order in which they are to be tried. `counts`: how many mistakes are looked for at once.
pub(super) fn search(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[DVec3],
    order: &[usize],
    tolerance: f64,
    counts: RangeInclusive<usize>,
) -> Option<Vec<FoundMistake>> {
    let (mut search, right) = MistakeSearch::new(assignment, probes, samples, order, tolerance);
    for count in counts {
        search.count = count;
        search.allow(if count == 1 { u64::MAX } else { WORK_FOR_TWO });
        for free in 0..=count {
            if count == MOST_MISTAKES {
                search.allow(WORK_FOR_THREE);
            }
            search.extend(&right, &mut Vec::new(), 0, count - free, free);
            if let Some((_, found)) = search.best {
                return Some(found);
            }
        }
    }
    None
}

impl<'a> MistakeSearch<'a> {
    /// A search that has found nothing yet, and the right equation. See [`search`].
    pub fn new(
        assignment: &'a Assignment,
        probes: &'a ProbeSet,
        samples: &[DVec3],
        order: &[usize],
        tolerance: f64,
    ) -> (Self, Resolved) {
        let mut columns = RuleColumns::new(assignment, probes, order);
        let right = columns.right();
        let mut candidates = candidates(assignment, &mut columns);
        let agreeing = Views::new(assignment, probes, samples, tolerance).agreeing(order);
        candidates.retain(|c| {
            !agreeing.iter().any(|(line, places)| is_refuted(c, *line, places, &mut columns, &right, tolerance))
        });
        let search = Self {
            assignment,
            candidates,
            columns,
            samples: order.iter().map(|place| samples[*place]).collect(),
            tolerance,
            count: 0,
            budget: u64::MAX,
            best: None,
        };
        (search, right)
    }

    /// Allows so much work from now on.
    pub fn allow(&mut self, work: u64) {
        self.budget = self.columns.work.saturating_add(work);
    }

    pub fn is_spent(&self) -> bool {
        self.columns.work > self.budget
    }

    /// Adds to the chosen ones `fixed` candidates without a free parameter, from `next` on, and `free` with one.
    fn extend(
        &mut self,
        base: &Resolved,
        chosen: &mut Vec<ChosenCandidate<'a>>,
        next: usize,
        fixed: usize,
        free: usize,
    ) {
        if self.is_spent() {
            return;
        }
        if fixed == 0 {
            self.extend_free(base, chosen, &mut Vec::new(), 0, free);
            return;
        }
        for index in next..self.candidates.len() {
            let candidate = &self.candidates[index];
            let alone = fixed == 1 && free == 0 && chosen.is_empty();
            if candidate.free.is_some() || (candidate.whole && !alone) || !fits(chosen, candidate, free > 0) {
                continue;
            }
            let candidate = Rc::clone(candidate);
            if fixed == 1 && free == 0 {
                if self.explains(base, &candidate.replaced) {
                    self.keep(chosen, &[(candidate, None)]);
                }
                continue;
            }
            let resolved = self.columns.derive(base, &candidate.replaced);
            chosen.push((candidate, None));
            self.extend(&resolved, chosen, index + 1, fixed - 1, free);
            chosen.pop();
        }
    }

    /// Adds `count` more candidates with a free parameter, from `next` on, each in lines of its own.
    fn extend_free(
        &mut self,
        base: &Resolved,
        chosen: &[ChosenCandidate<'a>],
        open: &mut Vec<Rc<Candidate<'a>>>,
        next: usize,
        count: usize,
    ) {
        if count == 0 {
            if let Some(solved) = self.solve_all(base, open) {
                self.keep(chosen, &solved);
            }
            return;
        }
        for index in next..self.candidates.len() {
            if self.is_spent() {
                return;
            }
            let candidate = &self.candidates[index];
            let shares = |other: &Rc<Candidate>| other.lines & candidate.lines != 0;
            if candidate.free.is_none() || !fits(chosen, candidate, true) || open.iter().any(shares) {
                continue;
            }
            open.push(Rc::clone(candidate));
            self.extend_free(base, chosen, open, index + 1, count - 1);
            open.pop();
        }
    }

    /// Whether `base` with some definitions replaced reproduces every sample.
    pub fn explains(&mut self, base: &Resolved, replaced: &[Replaced]) -> bool {
        (0..self.samples.len()).all(|i| {
            let expected = self.columns.colour_with(base, replaced, i);
            agrees(expected, self.samples[i], self.tolerance)
        })
    }

    /// Keeps an explanation if it is the most plausible so far.
    pub fn keep(&mut self, chosen: &[ChosenCandidate<'a>], last: &[ChosenCandidate<'a>]) {
        let mut all = [chosen, last].concat();
        all.sort_by_key(|(c, _)| (c.mistake, c.form));
        let lines = all.iter().map(|(c, _)| c.lines.count_ones()).sum();
        let rank = (lines, all.iter().map(|(c, _)| c.mistake).collect());
        if self.best.as_ref().is_some_and(|(best, _)| *best <= rank) {
            return;
        }
        let one = |(candidate, parameter): &ChosenCandidate| FoundMistake {
            id: self.assignment.mistakes[candidate.mistake].id.clone(),
            form: candidate.form,
            parameter: *parameter,
        };
        self.best = Some((rank, all.iter().map(one).collect()));
    }
}
