//! Trying combinations of mistakes, the fewest first.

use super::columns::{Columns, Resolved, Rule, Set};
use super::digits::simpler;
use super::{MOST_MISTAKES, agrees};
use crate::Assignment;
use crate::mistake::{Form, Found, FreeParameter, Mistake, Override};
use crate::probes::ProbeSet;
use glam::DVec3;
use std::rc::Rc;

/// Halvings of the free parameter's range: 60 leave nothing of an f64's precision.
const HALVINGS: usize = 60;

/// So many samples are looked at for the one that determines a free parameter best; more where none of them depends on it
/// by so many times the tolerance.
const ENOUGH: usize = 32;
const CLEAR: f64 = 20.0;

/// How many colours are computed in search of three mistakes at once, before it is given up: some samples, such as those of
/// a shader that looks its colours up, agree with thousands of combinations at many probes. Usual searches need less than half.
const MOST_COLOURS: u64 = 800_000;

/// One form of one mistake.
struct Candidate<'a> {
    mistake: usize,
    form: usize,
    /// The definitions that are replaced.
    touches: Set,
    /// The rubric lines that it costs points, as bits.
    lines: u64,
    /// Whether nothing of the rubric's terms is left in the colour: such a mistake stands alone.
    whole: bool,
    replaced: Vec<(usize, Rule)>,
    free: Option<&'a FreeParameter>,
}

struct Search<'a> {
    assignment: &'a Assignment,
    columns: Columns<'a>,
    /// In the order of the definitions that they replace: what is replaced last has the least to recompute.
    candidates: Vec<Rc<Candidate<'a>>>,
    /// In the order in which they are tried.
    samples: Vec<DVec3>,
    tolerance: f64,
    /// How often the colour at a probe was computed.
    spent: u64,
    /// What may be spent on the combinations of the present number of mistakes.
    budget: u64,
    /// The most plausible explanation so far.
    best: Option<(Rank, Vec<Found>)>,
}

/// How plausible an explanation is among others of as many mistakes; less is more.
///
/// Mistakes that touch few lines of the rubric come before those that upset everything, and then the table's order decides: an
/// answer without diffuse and specular term is just that, and not one with a reversed light and a constant normal.
type Rank = (u32, Vec<usize>);

/// The mistakes that explain samples that are not all right; `None` if nothing explains them.
///
/// `order`: the places of all samples, in the order in which they are to be tried.
pub(super) fn search(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[DVec3],
    order: &[usize],
    tolerance: f64,
) -> Option<Vec<Found>> {
    let mut columns = Columns::new(assignment, probes, order);
    let right = columns.right();
    let mut search = Search {
        assignment,
        candidates: candidates(assignment, &mut columns),
        columns,
        samples: order.iter().map(|place| samples[*place]).collect(),
        tolerance,
        spent: 0,
        budget: u64::MAX,
        best: None,
    };
    for count in 1..=MOST_MISTAKES {
        for free in [false, true] {
            search.spent = 0;
            search.budget = if count == MOST_MISTAKES { MOST_COLOURS } else { u64::MAX };
            search.extend(&right, &mut Vec::new(), 0, count, free);
            if let Some((_, found)) = search.best {
                return Some(found);
            }
        }
    }
    None
}

fn candidates<'a>(assignment: &'a Assignment, columns: &mut Columns<'a>) -> Vec<Rc<Candidate<'a>>> {
    let mut all = Vec::new();
    for (index, mistake) in assignment.mistakes.iter().enumerate() {
        for (place, form) in mistake.forms.iter().enumerate() {
            let free = mistake.fit.as_ref().filter(|_| form.free);
            all.push(Rc::new(Candidate {
                mistake: index,
                form: place,
                touches: form.overrides.iter().map(|o| 1 << o.definition).sum(),
                lines: lines(assignment, mistake),
                whole: replaces_everything(assignment, form),
                replaced: rules(columns, form),
                free,
            }));
        }
    }
    // Stable: the table's order decides among forms that replace the same.
    all.sort_by_key(|c| c.replaced.first().map(|(d, _)| *d));
    all
}

fn rules<'a>(columns: &mut Columns<'a>, form: &'a Form) -> Vec<(usize, Rule)> {
    let rule = |o: &'a Override| (o.definition, columns.rule(&o.expression));
    form.overrides.iter().map(rule).collect()
}

fn lines(assignment: &Assignment, mistake: &Mistake) -> u64 {
    let rubric = assignment.rubric.iter().enumerate();
    let lost = rubric.filter(|(_, line)| mistake.keeps.iter().any(|(l, _)| *l == line.id));
    lost.map(|(place, _)| 1 << place).sum()
}

/// Whether the form's colour depends on no definition that the rubric judges.
fn replaces_everything(assignment: &Assignment, form: &Form) -> bool {
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
        let right = &equation.definitions[definition].expression;
        let slots = replaced.map_or(right, |o| &o.expression).slots();
        open.extend(slots.iter().filter_map(|s| equation.definition_in(*s)));
    }
    true
}

impl<'a> Search<'a> {
    /// Adds `count` more candidates, from `next` on, to the chosen ones; `free`: the last one has a free parameter.
    fn extend(&mut self, base: &Resolved, chosen: &mut Vec<Rc<Candidate<'a>>>, next: usize, count: usize, free: bool) {
        if self.spent > self.budget {
            return;
        }
        if count == 1 && free {
            self.fit(base, chosen);
            return;
        }
        for index in next..self.candidates.len() {
            let candidate = &self.candidates[index];
            let alone = count == 1 && chosen.is_empty();
            if candidate.free.is_some() || (candidate.whole && !alone) || !fits(chosen, candidate) {
                continue;
            }
            let candidate = Rc::clone(candidate);
            if count == 1 {
                if self.explains(base, &candidate.replaced, f64::NAN) {
                    self.keep(chosen, &candidate, None);
                }
                continue;
            }
            let resolved = self.columns.derive(base, &candidate.replaced);
            chosen.push(candidate);
            self.extend(&resolved, chosen, index + 1, count - 1, free);
            chosen.pop();
        }
    }

    /// Whether `base` with some definitions replaced reproduces every sample.
    fn explains(&mut self, base: &Resolved, replaced: &[(usize, Rule)], parameter: f64) -> bool {
        (0..self.samples.len()).all(|i| {
            self.spent += 1;
            let expected = self.columns.colour_with(base, replaced, parameter, i);
            agrees(expected, self.samples[i], self.tolerance)
        })
    }

    /// Tries every candidate with a free parameter on top of the chosen ones.
    fn fit(&mut self, base: &Resolved, chosen: &[Rc<Candidate<'a>>]) {
        for index in 0..self.candidates.len() {
            let candidate = Rc::clone(&self.candidates[index]);
            let Some(parameter) = candidate.free.filter(|_| fits(chosen, &candidate)) else {
                continue;
            };
            if let Some(value) = self.solve(base, &candidate, parameter) {
                self.keep(chosen, &candidate, Some(value));
            }
        }
    }

    /// Keeps an explanation if it is the most plausible so far.
    fn keep(&mut self, chosen: &[Rc<Candidate<'a>>], last: &Rc<Candidate<'a>>, parameter: Option<f64>) {
        let mut all = [chosen, std::slice::from_ref(last)].concat();
        all.sort_by_key(|c| (c.mistake, c.form));
        let lines = all.iter().map(|c| c.lines.count_ones()).sum();
        let rank = (lines, all.iter().map(|c| c.mistake).collect());
        if self.best.as_ref().is_some_and(|(best, _)| *best <= rank) {
            return;
        }
        let one = |candidate: &Rc<Candidate>| Found {
            id: self.assignment.mistakes[candidate.mistake].id.clone(),
            form: candidate.form,
            parameter: parameter.filter(|_| candidate.free.is_some()),
        };
        self.best = Some((rank, all.iter().map(one).collect()));
    }

    /// The parameter with which a candidate explains every sample.
    fn solve(&mut self, base: &Resolved, candidate: &Candidate<'a>, parameter: &FreeParameter) -> Option<f64> {
        let (probe, channel) = self.pivot(base, candidate, parameter)?;
        let replaced = &candidate.replaced;
        let mut value = |x: f64| self.columns.colour_with(base, replaced, x, probe)[channel];
        let target = self.samples[probe][channel];
        let rising = value(parameter.from) < value(parameter.to);
        let (mut low, mut high) = (parameter.from.ln(), parameter.to.ln());
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if (value(middle.exp()) < target) == rising {
                low = middle;
            } else {
                high = middle;
            }
        }
        let exact = f64::midpoint(low, high).exp();
        if !self.explains(base, replaced, exact) {
            return None;
        }
        let simplest = simpler(exact).into_iter().find(|x| self.explains(base, replaced, *x));
        Some(simplest.unwrap_or(exact))
    }

    /// The probe and channel that determine a free parameter best.
    ///
    /// The colour is monotonic in the parameter, so every sample lies between the colours for its least and greatest value
    /// (else there is no solution), and the sample that is furthest from both depends on it most. Not all of them are looked
    /// at: that would be nearly all that a search does.
    fn pivot(
        &mut self,
        base: &Resolved,
        candidate: &Candidate<'a>,
        parameter: &FreeParameter,
    ) -> Option<(usize, usize)> {
        let mut best = None;
        let mut reach = self.tolerance;
        for probe in 0..self.samples.len() {
            self.spent += 2;
            let sample = self.samples[probe];
            let mut end = |x: f64| self.columns.colour_with(base, &candidate.replaced, x, probe);
            let (a, b) = (end(parameter.from), end(parameter.to));
            for channel in 0..3 {
                let (low, high) = (a[channel].min(b[channel]), a[channel].max(b[channel]));
                let y = sample[channel];
                if a[channel].is_nan() && b[channel].is_nan() {
                    if y.is_finite() {
                        return None;
                    }
                    continue;
                }
                let slack = self.tolerance * high.abs().max(low.abs()).max(1.0);
                if !(y >= low - slack && y <= high + slack) {
                    return None;
                }
                let inside = (y - low).min(high - y);
                if inside > reach {
                    reach = inside;
                    best = Some((probe, channel));
                }
            }
            // A sample on which it depends clearly determines it well enough; whether all agree is asked next.
            if probe >= ENOUGH && reach > CLEAR * self.tolerance {
                break;
            }
        }
        best
    }
}

/// Whether a candidate goes with the chosen ones: another mistake, in other definitions, and not the third in one line of the
/// rubric, for no term with three mistakes in it can be named with confidence.
fn fits(chosen: &[Rc<Candidate<'_>>], new: &Candidate<'_>) -> bool {
    let clash = |c: &Rc<Candidate>| c.mistake == new.mistake || c.touches & new.touches != 0;
    let shared = chosen.iter().fold(new.lines, |lines, c| lines & c.lines);
    !chosen.iter().any(clash) && (chosen.len() + 1 < MOST_MISTAKES || shared == 0)
}
