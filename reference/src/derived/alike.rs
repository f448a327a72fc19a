//! Forms that compute the same.

use super::Derived;
use crate::Value;
use crate::assignment::RubricItem;
use crate::equation::EquationVariant;
use crate::mistake::{Alternative, Condition, MistakeForm};
use glam::DVec3;
use std::cell::OnceCell;
use std::collections::HashMap;
use std::ops::Range;

/// So many places tell most forms apart.
const FIRST: usize = 12;

/// Relative to the colour; far above what computing in another order changes, and far below what probes tell.
const RELATIVE: f64 = 1e-6;

/// A number that a person would hardly write, for one that is free.
const SOME: f64 = 1.737;

/// What a form computes at the first places.
struct Known<'a> {
    /// `None` for what is right.
    form: Option<&'a MistakeForm>,
    colours: Vec<DVec3>,
    /// At all of them, once it was asked for: where little is lit, the first places tell little.
    all: OnceCell<Vec<DVec3>>,
}

impl<'a> Known<'a> {
    fn new(form: Option<&'a MistakeForm>, colours: Vec<DVec3>) -> Self {
        Self { form, colours, all: OnceCell::new() }
    }
}

impl Derived {
    /// Leaves out the derived forms that compute what is right, or what a form before them does. What a written mistake computes
    /// stays: another mistake beside it may be told only so.
    pub(super) fn leave_out_alike(&mut self) {
        let mut variant = self.assignment.equation.right();
        let right = Known::new(None, self.colours(&mut variant, None, self.few()));
        let mut known: HashMap<i64, Vec<Known<'_>>> = HashMap::new();
        let mut keep: Vec<Vec<bool>> = Vec::new();
        for mistake in &self.assignment.mistakes[self.first..] {
            let mut kept = Vec::new();
            for form in &mistake.forms {
                let own = Known::new(Some(form), self.colours(&mut variant, Some(form), self.few()));
                let alike = known.entry(bucket(&own.colours)).or_default();
                let mut others = std::iter::once(&right).chain(&*alike);
                let is_new = !others.any(|other| self.is_alike(&mut variant, &own, other))
                    && !self.is_another_constant(&mut variant, form);
                if is_new {
                    alike.push(own);
                }
                kept.push(is_new);
            }
            keep.push(kept);
        }
        for (mistake, keep) in self.assignment.mistakes.iter_mut().skip(self.first).zip(keep) {
            let forms = std::mem::take(&mut mistake.forms);
            let texts = std::mem::take(&mut mistake.instead);
            let kept = forms.into_iter().zip(texts).zip(keep).filter(|(_, keep)| *keep);
            for (place, ((form, text), _)) in kept.enumerate() {
                mistake.forms.push(form);
                mistake.instead.push(Alternative { when: vec![Condition::Forms(vec![place])], ..text });
            }
        }
        let first = self.first;
        let mut place = 0;
        self.assignment.mistakes.retain(|mistake| {
            place += 1;
            place <= first || !mistake.forms.is_empty()
        });
    }

    fn few(&self) -> Range<usize> {
        0..FIRST.min(self.places.len())
    }

    fn is_alike<'a>(&'a self, variant: &mut EquationVariant<'a>, own: &Known<'a>, other: &Known<'a>) -> bool {
        let is_free = |known: &Known<'_>| known.form.is_some_and(|form| form.free);
        let is_comparable = other.form.is_none() || is_free(own) == is_free(other);
        is_comparable && same(&own.colours, &other.colours) && {
            let own = self.all_colours(variant, own);
            same(own, self.all_colours(variant, other))
        }
    }

    fn all_colours<'a, 'k>(&'a self, variant: &mut EquationVariant<'a>, known: &'k Known<'a>) -> &'k [DVec3] {
        known.all.get_or_init(|| self.colours(variant, known.form, 0..self.places.len()))
    }

    /// Whether a form replaces what is the same everywhere by something else that is: nothing shows how it was made. Of what a line
    /// judges it is told all the same.
    fn is_another_constant<'a>(&'a self, variant: &mut EquationVariant<'a>, form: &'a MistakeForm) -> bool {
        let equation = &self.assignment.equation;
        let [replaced] = &form.overrides[..] else { return false };
        let is_judged = |line: &RubricItem| equation.index(&line.judges) == Some(replaced.definition);
        if self.assignment.rubric.iter().any(is_judged) {
            return false;
        }
        let mut is_constant = |form: Option<&'a MistakeForm>| {
            variant.instead(form, SOME);
            let value = |(uniforms, attributes): &(Vec<Value>, Vec<Value>)| {
                variant.evaluate(uniforms, attributes).numbers(replaced.definition).to_vec()
            };
            let mut values = self.places[self.few()].iter().map(value);
            let first = values.next().unwrap_or_default();
            values.all(|other| other.iter().zip(&first).all(|(a, b)| (a - b).abs() <= RELATIVE))
        };
        is_constant(None) && is_constant(Some(form))
    }

    /// The colours with a form in the equation at some of the places, not clamped; a number that is free has some value.
    fn colours<'a>(
        &'a self,
        variant: &mut EquationVariant<'a>,
        form: Option<&'a MistakeForm>,
        places: Range<usize>,
    ) -> Vec<DVec3> {
        let equation = &self.assignment.equation;
        let is_free = form.is_some_and(|form| form.free);
        variant.instead(form, if is_free { SOME } else { f64::NAN });
        let colour = |(uniforms, attributes): &(Vec<Value>, Vec<Value>)| {
            variant.evaluate(uniforms, attributes).vec3(equation.colour)
        };
        self.places[places].iter().map(colour).collect()
    }

    /// The definitions that lines of the rubric judge, as bits, if the colour is the sum of what each of them gives: what becomes
    /// of it when two are 0 is what becomes of it when each is.
    pub(super) fn summed(&self) -> u64 {
        let equation = &self.assignment.equation;
        let judged = self.assignment.rubric.iter().filter_map(|line| equation.index(&line.judges));
        let mut terms: Vec<usize> =
            judged.filter(|term| *term != equation.colour && equation.depends(equation.colour, *term)).collect();
        terms.sort_unstable();
        terms.dedup();
        let is_nested = |term: &usize| terms.iter().any(|other| other != term && equation.depends(*term, *other));
        if terms.len() < 2 || terms.iter().any(is_nested) {
            return 0;
        }
        let colour = |moved: &[usize], at: usize| {
            let (uniforms, attributes) = &self.places[at];
            let variant: EquationVariant<'_> = equation.right();
            variant.moved(uniforms, attributes, moved, [0.31, 0.37, 0.41])
        };
        let is_sum = |at: usize| {
            let pairs = terms.iter().enumerate().flat_map(|(place, a)| terms[..place].iter().map(move |b| (*a, *b)));
            pairs.into_iter().all(|(a, b)| {
                let both = colour(&[a, b], at);
                (both - colour(&[a], at) - colour(&[b], at)).abs().max_element() <= RELATIVE * both.abs().max_element()
            })
        };
        if (0..FIRST.min(self.places.len())).all(is_sum) { terms.iter().map(|term| 1 << term).sum() } else { 0 }
    }
}

fn same(a: &[DVec3], b: &[DVec3]) -> bool {
    let channel = |a: f64, b: f64| (a - b).abs() <= RELATIVE * a.abs().max(1.0) || a.is_nan() && b.is_nan() || a == b;
    a.iter().zip(b).all(|(a, b)| (0..3).all(|at| channel(a[at], b[at])))
}

/// Forms that compute the same are in one bucket, but for those at its edge.
fn bucket(colours: &[DVec3]) -> i64 {
    let sum: DVec3 = colours.iter().filter(|colour| colour.is_finite()).sum();
    ((sum.x + 1.7 * sum.y + 2.3 * sum.z) * 1e4).round() as i64
}
