//! Trying combinations of mistakes, the fewest first.

use super::columns::{Columns, Resolved, Rule};
use super::{MOST_MISTAKES, agrees};
use crate::Assignment;
use crate::mistake::{Form, Found, FreeParameter};
use crate::probes::ProbeSet;
use glam::DVec3;
use std::collections::HashSet;

/// Halvings of the free parameter's range: 60 leave nothing of an f64's precision.
const HALVINGS: usize = 60;

/// Significant digits to which a free parameter is rounded if that still explains every sample: what a person would write.
const DIGITS: [i32; 3] = [1, 2, 3];

/// One form of one mistake.
struct Candidate<'a> {
    mistake: usize,
    form: usize,
    /// What is replaced; for a form with a free parameter, with its least and greatest value.
    replaced: Vec<(usize, Rule)>,
    greatest: Vec<(usize, Rule)>,
    free: Option<(&'a FreeParameter, &'a Form)>,
}

struct Search<'a> {
    assignment: &'a Assignment,
    columns: Columns<'a>,
    candidates: Vec<Candidate<'a>>,
    samples: &'a [DVec3],
    tolerance: f64,
    /// Columns that were tried already: combinations that compute the same thing are one hypothesis.
    tried: HashSet<u32>,
}

/// The mistakes that explain the samples; an empty list if they are right, `None` if nothing explains them.
pub(super) fn search(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[DVec3],
    tolerance: f64,
) -> Option<Vec<Found>> {
    let mut columns = Columns::new(assignment, probes);
    let right = columns.right();
    let candidates = candidates(assignment, &mut columns);
    let mut search = Search {
        assignment,
        columns,
        candidates,
        samples,
        tolerance,
        tried: HashSet::new(),
    };
    if search.explains(&right) {
        return Some(Vec::new());
    }
    for count in 1..=MOST_MISTAKES {
        for free in [false, true] {
            let found = search.extend(&right, &mut Vec::new(), 0, count, free);
            if found.is_some() {
                return found;
            }
        }
    }
    None
}

fn candidates<'a>(assignment: &'a Assignment, columns: &mut Columns<'a>) -> Vec<Candidate<'a>> {
    let mut all = Vec::new();
    for (index, mistake) in assignment.mistakes.iter().enumerate() {
        for (place, form) in mistake.forms.iter().enumerate() {
            let free = mistake.fit.as_ref().filter(|_| form.free);
            let (least, greatest) = free.map_or((f64::NAN, f64::NAN), |f| (f.from, f.to));
            all.push(Candidate {
                mistake: index,
                form: place,
                replaced: rules(columns, form, least),
                greatest: rules(columns, form, greatest),
                free: free.map(|f| (f, form)),
            });
        }
    }
    all
}

fn rules<'a>(columns: &mut Columns<'a>, form: &'a Form, parameter: f64) -> Vec<(usize, Rule)> {
    let rule =
        |o: &'a crate::mistake::Override| (o.definition, columns.rule(&o.expression, parameter));
    form.overrides.iter().map(rule).collect()
}

impl<'a> Search<'a> {
    /// Adds `count` more candidates, from `next` on, to the chosen ones; `free`: the last one has a free parameter.
    fn extend(
        &mut self,
        base: &Resolved,
        chosen: &mut Vec<usize>,
        next: usize,
        count: usize,
        free: bool,
    ) -> Option<Vec<Found>> {
        if count == 1 && free {
            return self.fit(base, chosen);
        }
        for index in next..self.candidates.len() {
            if self.candidates[index].free.is_some() || self.clashes(chosen, index) {
                continue;
            }
            let resolved = self.columns.derive(base, &self.candidates[index].replaced);
            chosen.push(index);
            let found = if count > 1 {
                self.extend(&resolved, chosen, index + 1, count - 1, free)
            } else if self.explains(&resolved) {
                Some(self.found(chosen, None))
            } else {
                None
            };
            if found.is_some() {
                return found;
            }
            chosen.pop();
        }
        None
    }

    /// Whether a candidate is another form of a chosen mistake, or replaces what a chosen one replaces.
    fn clashes(&self, chosen: &[usize], index: usize) -> bool {
        let new = &self.candidates[index];
        chosen.iter().any(|c| {
            let old = &self.candidates[*c];
            let shared = |(d, _): &(usize, Rule)| new.replaced.iter().any(|(n, _)| n == d);
            old.mistake == new.mistake || old.replaced.iter().any(shared)
        })
    }

    fn explains(&mut self, resolved: &Resolved) -> bool {
        let column = self.columns.colour_column(resolved);
        self.tried.insert(column)
            && (0..self.samples.len()).all(|i| {
                let expected = self.columns.colour(column, i);
                agrees(expected, self.samples[i], self.tolerance)
            })
    }

    /// Tries every candidate with a free parameter on top of the chosen ones.
    fn fit(&mut self, base: &Resolved, chosen: &mut Vec<usize>) -> Option<Vec<Found>> {
        for index in 0..self.candidates.len() {
            let Some((parameter, form)) = self.candidates[index].free else {
                continue;
            };
            if self.clashes(chosen, index) {
                continue;
            }
            if let Some(value) = self.solve(base, index, parameter, form) {
                chosen.push(index);
                return Some(self.found(chosen, Some(value)));
            }
        }
        None
    }

    /// The parameter with which a candidate explains every sample.
    fn solve(
        &mut self,
        base: &Resolved,
        index: usize,
        parameter: &FreeParameter,
        form: &Form,
    ) -> Option<f64> {
        let least = self.columns.derive(base, &self.candidates[index].replaced);
        let greatest = self.columns.derive(base, &self.candidates[index].greatest);
        let least = self.columns.colour_column(&least);
        let greatest = self.columns.colour_column(&greatest);
        let (probe, channel) = self.pivot(least, greatest)?;
        let target = self.samples[probe][channel];
        let rising = self.columns.colour(least, probe)[channel]
            < self.columns.colour(greatest, probe)[channel];
        let (mut low, mut high) = (parameter.from.ln(), parameter.to.ln());
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            let colour = self.columns.colour_with(base, form, middle.exp(), probe);
            if (colour[channel] < target) == rising {
                low = middle;
            } else {
                high = middle;
            }
        }
        let exact = f64::midpoint(low, high).exp();
        if !self.explains_with(base, form, exact) {
            return None;
        }
        let rounded = DIGITS.map(|digits| significant(exact, digits));
        let simplest = rounded
            .into_iter()
            .find(|x| self.explains_with(base, form, *x));
        Some(simplest.unwrap_or(exact))
    }

    /// The probe and channel that determine a free parameter best.
    ///
    /// The colour is monotonic in the parameter, so every sample lies between the colours for its least and greatest value
    /// (else there is no solution), and the sample that is furthest from both depends on it most.
    fn pivot(&mut self, least: u32, greatest: u32) -> Option<(usize, usize)> {
        let mut best = None;
        let mut reach = self.tolerance;
        for (probe, sample) in self.samples.iter().enumerate() {
            let a = self.columns.colour(least, probe);
            let b = self.columns.colour(greatest, probe);
            for channel in 0..3 {
                let (low, high) = (a[channel].min(b[channel]), a[channel].max(b[channel]));
                let slack = self.tolerance * high.abs().max(low.abs()).max(1.0);
                let y = sample[channel];
                if a[channel].is_nan() || b[channel].is_nan() {
                    continue;
                }
                if !(y >= low - slack && y <= high + slack) {
                    return None;
                }
                let inside = (y - low).min(high - y);
                if inside > reach {
                    reach = inside;
                    best = Some((probe, channel));
                }
            }
        }
        best
    }

    fn explains_with(&mut self, base: &Resolved, form: &Form, parameter: f64) -> bool {
        (0..self.samples.len()).all(|i| {
            let expected = self.columns.colour_with(base, form, parameter, i);
            agrees(expected, self.samples[i], self.tolerance)
        })
    }

    fn found(&self, chosen: &[usize], parameter: Option<f64>) -> Vec<Found> {
        let mut chosen = chosen.to_vec();
        chosen.sort_unstable();
        let one = |index: &usize| {
            let candidate = &self.candidates[*index];
            Found {
                id: self.assignment.mistakes[candidate.mistake].id.clone(),
                form: candidate.form,
                parameter: parameter.filter(|_| candidate.free.is_some()),
            }
        };
        chosen.iter().map(one).collect()
    }
}

/// `x` rounded to so many significant digits.
fn significant(x: f64, digits: i32) -> f64 {
    let step = 10f64.powi(x.abs().log10().floor() as i32 + 1 - digits);
    if step < 1.0 {
        // Dividing by a power of ten keeps 0.3 exact where multiplying by 0.1 does not.
        let steps = (1.0 / step).round();
        (x * steps).round() / steps
    } else {
        (x / step).round() * step
    }
}
