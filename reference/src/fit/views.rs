//! Looking at one term alone, although a shader only ever shows the sum.
//!
//! A term is a number times a constant colour, K ⊗ L. So another term can be kept out of sight in several ways: where a right
//! one is 0 it is absent; its colour is projected out, whatever number the shader computes for it; a term that is the same
//! everywhere adds the same everywhere. One way for each of the others makes a view. What is wrong in another term spoils
//! some views of a term, hardly ever all of them: so a term that is right in one view is right.

mod term;

use crate::Assignment;
use crate::assignment::RubricItem;
use crate::probes::{ProbeSet, Region};
use glam::DVec3;
use term::{FAINT, TermValues};

/// Sums of a few numbers of magnitude 1 in f64 are this exact.
const ROUNDING: f64 = 1e-12;

/// A sample beyond this is not looked at: f32 has no digits left for the other terms.
const OVERFLOWING: f64 = 1e3;

/// So many samples must be left in a view of a term that varies, from its least value to this fraction of its greatest.
const ENOUGH: usize = 20;
const ENOUGH_OF_ITS_RANGE: f64 = 0.4;
const NEARLY_NOTHING: f64 = 0.05;

/// A term that is the same everywhere is right if it shows by itself in so many of the samples in a view, and in this fraction
/// of them: another light leaves some of them unlit, while a wrong value has the right one hardly anywhere.
const ENOUGH_OF_A_CONSTANT: usize = 8;
const FRACTION_ALONE: f64 = 0.1;
/// The same where it shows together with a term that varies, which might make up for it by chance.
const FRACTION_BESIDE: f64 = 0.3;

/// How another term is kept out of sight.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// Only where a right one is exactly 0.
    Absent,
    /// Only where a right one does not show, and one with another clamp neither.
    Faint,
    /// By the direction of its colour.
    Projected,
    /// It adds the same everywhere, whatever that is.
    Constant,
    /// It is known to be right.
    Right,
    /// It is right in some places, where nothing else shows.
    Beside,
}

/// The terms of a shader at all probes.
pub(super) struct Views<'a> {
    pub terms: Vec<TermValues<'a>>,
    regions: &'a [Region],
    probes: &'a ProbeSet,
    samples: &'a [DVec3],
    tolerance: f64,
}

impl<'a> Views<'a> {
    /// The terms that the rubric judges, in its order.
    pub fn new(assignment: &'a Assignment, probes: &'a ProbeSet, samples: &'a [DVec3], tolerance: f64) -> Self {
        let right = assignment.equation.right();
        let outcomes: Vec<_> = probes.iter().map(|p| right.evaluate(probes.uniforms(p), &p.attributes)).collect();
        let lines = assignment.rubric.iter().enumerate();
        let colour = assignment.equation.colour();
        let is_term = |line: &RubricItem| assignment.equation.index(&line.judges) != Some(colour);
        let lines = lines.filter(|(_, line)| !line.alone_in.is_empty() && is_term(line));
        // What a line's definition adds to the colour: itself, or what it is multiplied by on the way.
        let values = |place: usize, line: &RubricItem| -> Option<Vec<DVec3>> {
            let without = assignment.equation.right().with(assignment.terms[place].as_ref()?, f64::NAN);
            let adds: Vec<DVec3> = probes
                .iter()
                .zip(&outcomes)
                .map(|(p, right)| right.colour() - without.evaluate(probes.uniforms(p), &p.attributes).colour())
                .collect();
            let own = outcomes.iter().map(|right| right.get(&line.judges).map_or(DVec3::NAN, |value| value.vec3()));
            let own: Vec<DVec3> = own.collect();
            let is_itself = own.iter().zip(&adds).all(|(own, adds)| (*own - *adds).abs().max_element() < ROUNDING);
            Some(if is_itself { own } else { adds })
        };
        let terms =
            lines.filter_map(|(place, line)| Some(TermValues::new(place, line, values(place, line)?))).collect();
        Self { terms, regions: &assignment.regions, probes, samples, tolerance }
    }

    /// The lines whose term stands alone somewhere, all others being 0 or the same everywhere, and agrees wherever it does:
    /// the line's place in the rubric, and those places among `order`.
    pub fn agreeing(&self, order: &[usize]) -> Vec<(usize, Vec<usize>)> {
        let hides = |index: usize, place: usize| {
            let is_other = |other: &usize| *other != index && !self.terms[*other].is_constant;
            (0..self.terms.len()).filter(is_other).all(|other| self.is_hidden(other, Way::Absent, place))
        };
        let agrees = |place: &usize| {
            let off = self.samples[order[*place]] - self.probes.probes[order[*place]].colour;
            off.abs().max_element() <= self.tolerance
        };
        let alone = |index: usize| {
            let places: Vec<usize> = (0..order.len()).filter(|place| hides(index, order[*place])).collect();
            let agree = places.len() >= ENOUGH && places.iter().all(agrees);
            agree.then_some((self.terms[index].place, places))
        };
        (0..self.terms.len()).filter_map(alone).collect()
    }

    /// Which terms are right. At least one is not: it is known that the sum is wrong.
    pub fn judge(&self) -> Vec<bool> {
        let all = 0..self.terms.len();
        let mut right: Vec<bool> = all.clone().map(|index| !self.terms[index].is_constant).collect();
        let judged: Vec<bool> =
            all.clone().map(|index| right[index] && self.is_right(index, None) == Some(true)).collect();
        right = judged;
        if let Some(blamed) = self.blamed(&right) {
            right[blamed] = false;
        }
        let shows_anything = self.samples.iter().any(|sample| !readable(*sample).is_nan_mask().all());
        for index in all.clone().filter(|index| self.terms[*index].is_constant) {
            let others_are_right = all.clone().all(|i| right[i] || self.terms[i].is_constant);
            // What cannot be seen because of what is wrong elsewhere is not blamed for it.
            right[index] = self.is_right(index, Some(&right)).unwrap_or(!others_are_right && shows_anything);
        }
        if let (true, Some(last)) = (right.iter().all(|right| *right), right.last_mut()) {
            *last = false;
        }
        right
    }

    /// Whether a term is right in some view; `None` if no view shows it. `known`: which others are right, where that is known.
    fn is_right(&self, index: usize, known: Option<&[bool]>) -> Option<bool> {
        let mut seen = None;
        let others: Vec<usize> = (0..self.terms.len()).filter(|other| *other != index).collect();
        let ways: Vec<&[Way]> = others.iter().map(|other| self.ways(index, *other, known)).collect();
        let count: usize = ways.iter().map(|ways| ways.len()).product();
        for mut choice in 0..count {
            let mut view = Vec::with_capacity(others.len());
            for (other, ways) in others.iter().zip(&ways) {
                view.push((*other, ways[choice % ways.len()]));
                choice /= ways.len();
            }
            match self.shows_right(index, &view) {
                Some(true) => return Some(true),
                Some(false) => seen = Some(false),
                None => {}
            }
        }
        seen
    }

    /// The term to blame where all that vary are right by themselves, and wrong beside one another: the one without which
    /// nothing is wrong, or else the one whose colour everything has that is wrong, or else the last that is added.
    fn blamed(&self, right: &[bool]) -> Option<usize> {
        let varying = || (0..self.terms.len()).filter(|index| !self.terms[*index].is_constant);
        let rest =
            |place: usize| self.samples[place] - varying().map(|index| self.terms[index].values[place]).sum::<DVec3>();
        let all: Vec<usize> = (0..self.samples.len()).collect();
        let is_constant = |places: &[usize]| {
            let constant = middle(places.iter().map(|place| readable(rest(*place))));
            places.iter().all(|place| off(readable(rest(*place)) - constant) <= self.tolerance)
        };
        if !varying().all(|index| right[index]) || is_constant(&all) {
            return None;
        }
        let is_nothing_without = |index: &usize| {
            let without: Vec<usize> =
                all.iter().copied().filter(|at| self.is_hidden(*index, Way::Absent, *at)).collect();
            is_constant(&without)
        };
        let mut alone = varying().filter(is_nothing_without);
        let has_the_colour = |index: &usize| {
            let direction = self.terms[*index].direction;
            let wrong = all.iter().map(|place| self.samples[*place] - self.probes.probes[*place].colour);
            let aside = |w: DVec3| (w - direction * w.dot(direction)).abs().max_element();
            wrong.filter(|w| w.is_finite()).all(|w| aside(w) <= self.tolerance)
        };
        match (alone.next(), alone.next()) {
            (Some(only), None) => Some(only),
            _ => varying().find(has_the_colour).or_else(|| varying().next_back()),
        }
    }

    /// How the term `other` can be kept out of the sight of `index`.
    fn ways(&self, index: usize, other: usize, known: Option<&[bool]>) -> &'static [Way] {
        let (term, other_term) = (&self.terms[index], &self.terms[other]);
        let has_its_colour = term.direction.dot(other_term.direction) > 1.0 - 1e-9;
        match (other_term.is_constant, known.map(|right| right[other]), has_its_colour) {
            (_, Some(true), _) => &[Way::Right],
            (true, _, true) => &[Way::Constant],
            (true, _, false) => &[Way::Constant, Way::Projected],
            (false, Some(false), true) => &[Way::Absent, Way::Faint, Way::Beside],
            (false, _, true) => &[Way::Absent, Way::Faint],
            (false, _, false) => &[Way::Absent, Way::Faint, Way::Projected],
        }
    }

    fn shows_right(&self, index: usize, view: &[(usize, Way)]) -> Option<bool> {
        let term = &self.terms[index];
        let projected = view.iter().filter(|(_, way)| *way == Way::Projected);
        let basis = orthonormal(projected.map(|(other, _)| self.terms[*other].direction));
        let without = |v: DVec3| basis.iter().fold(v, |v, axis| v - *axis * v.dot(*axis));
        // What is left of a colour that is nearly the same as another tells nothing.
        if without(term.direction).length() < 0.1 {
            return None;
        }
        let shows: Vec<usize> = (0..3).filter(|c| without(term.direction)[*c].abs() > 0.1).collect();
        let rest = |place: usize| {
            let others = view.iter().filter(|(_, way)| matches!(way, Way::Right | Way::Beside));
            let others: DVec3 = others.map(|(other, _)| self.terms[*other].values[place]).sum();
            without(readable(self.samples[place])) - without(others + term.values[place])
        };
        let is_usable = |place: &usize| {
            let readable = readable(self.samples[*place]);
            shows.iter().any(|channel| without(readable)[*channel].is_finite())
                && view.iter().all(|(other, way)| self.is_hidden(*other, *way, *place))
        };
        let places: Vec<usize> = (0..self.samples.len()).filter(is_usable).collect();
        if term.is_constant {
            let is_beside = view.iter().any(|(_, way)| *way == Way::Beside);
            // Beside another term it can be right; if it is not, that may be the other's fault.
            if is_beside && view.iter().any(|(_, way)| matches!(way, Way::Faint | Way::Projected)) {
                return None;
            }
            let right = places.iter().filter(|place| off(rest(**place)) <= self.tolerance).count();
            let fraction = if is_beside { FRACTION_BESIDE } else { FRACTION_ALONE };
            let is_right = right >= ENOUGH_OF_A_CONSTANT && right as f64 >= fraction * places.len() as f64;
            return (places.len() >= ENOUGH_OF_A_CONSTANT && (is_right || !is_beside)).then_some(is_right);
        }
        let lengths = || places.iter().map(|place| term.values[*place].length());
        let (least, most) = lengths().fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
        if places.len() < ENOUGH
            || most < ENOUGH_OF_ITS_RANGE * term.amplitude
            || least > NEARLY_NOTHING * term.amplitude
        {
            return None;
        }
        let any_constant = view.iter().any(|(_, way)| *way == Way::Constant);
        let constant: DVec3 = if any_constant { middle(places.iter().map(|place| rest(*place))) } else { DVec3::ZERO };
        Some(places.iter().all(|place| off(rest(*place) - constant) <= self.tolerance))
    }

    /// Whether what is nothing here shows if a clamp is missing.
    fn shows_clamps(&self, place: usize) -> bool {
        let region = self.probes.probes[place].region.and_then(|region| self.regions.get(region));
        region.is_some_and(|region| region.shows_clamps)
    }

    fn is_hidden(&self, other: usize, way: Way, place: usize) -> bool {
        let value = self.terms[other].values[place];
        match way {
            Way::Absent => value == DVec3::ZERO,
            Way::Faint => value.abs().max_element() < FAINT && !self.shows_clamps(place),
            Way::Projected | Way::Constant | Way::Right | Way::Beside => true,
        }
    }
}

/// A sample without the channels that tell nothing.
fn readable(sample: DVec3) -> DVec3 {
    DVec3::from_array(sample.to_array().map(|x| if x.abs() < OVERFLOWING { x } else { f64::NAN }))
}

/// The largest difference; a channel that is no number costs nothing.
fn off(rest: DVec3) -> f64 {
    rest.to_array().into_iter().filter(|x| !x.is_nan()).fold(0.0, |most, x| most.max(x.abs()))
}

/// Unit vectors at right angles that span the same.
fn orthonormal(directions: impl Iterator<Item = DVec3>) -> Vec<DVec3> {
    let mut basis: Vec<DVec3> = Vec::new();
    for direction in directions {
        let rest = basis.iter().fold(direction, |v, axis| v - *axis * v.dot(*axis));
        basis.extend((rest.length() > 1e-6).then(|| rest.normalize()));
    }
    basis
}

/// Half way between the least and the greatest, channel by channel, of what is a number.
fn middle(values: impl Iterator<Item = DVec3>) -> DVec3 {
    let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    // `min` and `max` of a number and NaN are the number.
    let each = |(low, high): (DVec3, DVec3), v: DVec3| {
        let pick = |f: fn(f64, f64) -> f64, a: DVec3| DVec3::new(f(a.x, v.x), f(a.y, v.y), f(a.z, v.z));
        (pick(f64::min, low), pick(f64::max, high))
    };
    let (low, high) = values.fold(bounds, each);
    (low + high) / 2.0
}
