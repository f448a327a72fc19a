//! Finding the numbers that are free in mistakes.

use super::candidates::Candidate;
use super::columns::{Replaced, Resolved};
use super::digits::simpler;
use super::search::MistakeSearch;
use super::{MOST_MISTAKES, agrees, channel_agrees};
use crate::mistake::FreeParameter;
use std::rc::Rc;

/// Halvings of the free parameter's range: 60 leave nothing of an f64's precision.
const HALVINGS: usize = 60;

/// So many samples are looked at for the one that determines a free parameter best; more where none of them depends on it
/// by so many times the tolerance.
const ENOUGH: usize = 32;
const CLEAR: f64 = 20.0;

/// So many steps are made through the range of a parameter with which the colour may rise and fall again, at so many probes.
const STEPS: i32 = 32;
const PROBES_TO_SCAN: usize = 4;

/// A colour that changes by no more than this fraction of the tolerance over the whole range of a parameter does not depend on
/// it.
const UNMOVED: f64 = 0.1;

/// Each candidate with its number.
type Solved<'a> = Vec<(Rc<Candidate<'a>>, Option<f64>)>;

impl<'a> MistakeSearch<'a> {
    /// The numbers with which these candidates together explain every sample.
    ///
    /// One of them is found first where the others do not show, and then the rest on top of it.
    pub(super) fn solve_all(&mut self, base: &Resolved, open: &[Rc<Candidate<'a>>]) -> Option<Solved<'a>> {
        for (place, candidate) in open.iter().enumerate() {
            let mut others = open.to_vec();
            others.remove(place);
            let Some(value) = self.solve(base, candidate, &others) else { continue };
            let solved = vec![(Rc::clone(candidate), Some(value))];
            if others.is_empty() {
                return Some(solved);
            }
            let resolved = self.columns.derive(base, &candidate.with(value));
            if let Some(rest) = self.solve_all(&resolved, &others) {
                return Some([solved, rest].concat());
            }
        }
        None
    }

    /// The parameter with which a candidate explains every sample, as far as it does not depend on the parameters of others.
    fn solve(&mut self, base: &Resolved, candidate: &Candidate<'a>, others: &[Rc<Candidate<'a>>]) -> Option<f64> {
        let parameter = candidate.free?;
        let exact = if parameter.turns {
            self.scan(base, candidate, parameter, others)?
        } else {
            let at = self.pivot(base, candidate, parameter, others)?;
            let exact = self.bisect(base, candidate, at, [parameter.from, parameter.to]);
            self.explains_beside(base, &candidate.with(exact), others).then_some(exact)?
        };
        let simplest = simpler(exact).into_iter().find(|x| self.explains_beside(base, &candidate.with(*x), others));
        Some(simplest.unwrap_or(exact))
    }

    /// The parameter between two that gives the sample of a probe in a channel.
    fn bisect(
        &mut self,
        base: &Resolved,
        candidate: &Candidate<'a>,
        (probe, channel): (usize, usize),
        ends: [f64; 2],
    ) -> f64 {
        let mut value = |x: f64| self.columns.colour_with(base, &candidate.with(x), probe)[channel];
        let target = self.samples[probe][channel];
        let rising = value(ends[0]) < value(ends[1]);
        let (mut low, mut high) = (ends[0].ln(), ends[1].ln());
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if (value(middle.exp()) < target) == rising {
                low = middle;
            } else {
                high = middle;
            }
        }
        f64::midpoint(low, high).exp()
    }

    /// The parameter of a candidate whose colours may rise and fall again: looked for from step to step of its range, at the
    /// first probes that change with it.
    fn scan(
        &mut self,
        base: &Resolved,
        candidate: &Candidate<'a>,
        parameter: &FreeParameter,
        others: &[Rc<Candidate<'a>>],
    ) -> Option<f64> {
        // It costs too much on top of every two mistakes.
        if self.count == MOST_MISTAKES {
            return None;
        }
        let ratio = (parameter.to / parameter.from).powf(1.0 / f64::from(STEPS));
        let steps: Vec<f64> = (0..=STEPS).map(|step| parameter.from * ratio.powi(step)).collect();
        let few = [steps[0], steps[steps.len() / 2], parameter.to];
        let is_hopeless = |search: &mut Self, probe: usize| {
            let [a, b, c] = few.map(|x| search.columns.colour_with(base, &candidate.with(x), probe));
            let is_still = (a - b).abs().max((b - c).abs()).max_element() <= UNMOVED * search.tolerance;
            is_still && others.is_empty() && !agrees(a, search.samples[probe], search.tolerance)
        };
        if (0..ENOUGH.min(self.samples.len())).any(|probe| is_hopeless(self, probe)) {
            return None;
        }
        let mut looked_at = 0;
        for probe in 0..self.samples.len() {
            let unmoved = self.unmoved(base, others, probe);
            let values: Vec<_> =
                steps.iter().map(|x| self.columns.colour_with(base, &candidate.with(*x), probe)).collect();
            let moves = |c: usize| values.iter().any(|v| (v[c] - values[0][c]).abs() > CLEAR * self.tolerance);
            let Some(channel) = (0..3).find(|channel| unmoved[*channel] && moves(*channel)) else { continue };
            let above: Vec<bool> = values.iter().map(|value| value[channel] > self.samples[probe][channel]).collect();
            for (ends, above) in steps.windows(2).zip(above.windows(2)) {
                if above[0] != above[1] {
                    let exact = self.bisect(base, candidate, (probe, channel), [ends[0], ends[1]]);
                    if self.explains_beside(base, &candidate.with(exact), others) {
                        return Some(exact);
                    }
                }
            }
            looked_at += 1;
            if looked_at == PROBES_TO_SCAN {
                break;
            }
        }
        None
    }

    /// Whether every sample is reproduced, as far as it does not depend on the parameters of `others`.
    fn explains_beside(&mut self, base: &Resolved, replaced: &[Replaced], others: &[Rc<Candidate<'a>>]) -> bool {
        if others.is_empty() {
            return self.explains(base, replaced);
        }
        (0..self.samples.len()).all(|probe| {
            let expected = self.columns.colour_with(base, replaced, probe);
            agrees(expected, self.samples[probe], self.tolerance) || {
                let unmoved = self.unmoved(base, others, probe);
                let agrees = |c: usize| channel_agrees(expected[c], self.samples[probe][c], self.tolerance);
                (0..3).all(|channel| !unmoved[channel] || agrees(channel))
            }
        })
    }

    /// The channels of a probe that do not depend on the parameters of these candidates.
    fn unmoved(&mut self, base: &Resolved, candidates: &[Rc<Candidate<'a>>], probe: usize) -> [bool; 3] {
        let mut unmoved = [true; 3];
        for candidate in candidates {
            let Some(parameter) = candidate.free else { continue };
            let [a, b] =
                [parameter.from, parameter.to].map(|x| self.columns.colour_with(base, &candidate.with(x), probe));
            for channel in 0..3 {
                unmoved[channel] &= (a[channel] - b[channel]).abs() <= UNMOVED * self.tolerance;
            }
        }
        unmoved
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
        others: &[Rc<Candidate<'a>>],
    ) -> Option<(usize, usize)> {
        let mut best = None;
        let mut reach = self.tolerance;
        for probe in 0..self.samples.len() {
            let unmoved = self.unmoved(base, others, probe);
            if unmoved == [false; 3] {
                continue;
            }
            let sample = self.samples[probe];
            let mut end = |x: f64| self.columns.colour_with(base, &candidate.with(x), probe);
            let (a, b) = (end(parameter.from), end(parameter.to));
            for channel in (0..3).filter(|channel| unmoved[*channel]) {
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
