//! The search for the statement.

use super::points::{Points, fits, is_close, is_same};
use super::{Located, Role};
use crate::translate::{Site, Value};
use reference::Assignment;
use reference::mistake::{FoundMistake, Mistake};

/// What is searched for: one mistake among those that were found.
struct Search<'s, 'a> {
    points: &'s Points<'a>,
    /// The definitions that the mistake replaces, then those that follow from them, in the equation's order.
    replaced: Vec<usize>,
    following: Vec<usize>,
    /// The definitions at each point: without the mistake, and with it.
    right: Vec<Vec<Vec<f64>>>,
    wrong: Vec<Vec<Vec<f64>>>,
    /// The colour at each point without the mistake.
    wanted: Vec<[f64; 3]>,
    /// Whether the handed-out file has the mistake.
    handed_out: bool,
    /// Whether something is left out where a right value is used.
    at_use: bool,
}

impl Points<'_> {
    /// The place of the first of these definitions that is all there is to mend.
    pub fn place_of(&self, definitions: &[String]) -> Option<Located> {
        let equation = &self.assignment.equation;
        let right = self.definitions(&equation.right());
        let search = Search {
            points: self,
            replaced: definitions.iter().filter_map(|name| equation.index(name)).collect(),
            following: Vec::new(),
            wanted: colours(self.assignment, &right)?,
            wrong: right.clone(),
            right,
            handed_out: false,
            at_use: false,
        };
        let place = search.replaced.iter().find_map(|d| search.direct(*d))?;
        search.located(place, Role::Wrong)
    }

    /// Where mistake `index` of those that were found stands.
    pub fn locate(&self, found: &[FoundMistake], index: usize) -> Option<Located> {
        let search = Search::new(self, found, index)?;
        if search.is_zero() { search.missing() } else { search.wrong_value() }
    }
}

fn colours(assignment: &Assignment, definitions: &[Vec<Vec<f64>>]) -> Option<Vec<[f64; 3]>> {
    let equation = &assignment.equation;
    definitions.iter().map(|d| Some(equation.seen(d[equation.colour()].get(..3)?).to_array())).collect()
}

impl<'s, 'a> Search<'s, 'a> {
    fn new(points: &'s Points<'a>, found: &[FoundMistake], index: usize) -> Option<Self> {
        let found_one = found.get(index)?;
        let others: Vec<FoundMistake> = found.iter().filter(|other| *other != found_one).cloned().collect();
        let assignment = points.assignment;
        let mistake = assignment.mistake(&found_one.id)?;
        let right = points.definitions(&assignment.variant(&others)?);
        let wrong = points.definitions(&assignment.variant(found)?);
        let wanted = colours(assignment, &right)?;
        // What is as it should be already cannot be mended.
        if points.becomes(&wanted, &|_, _, _| None) {
            return None;
        }
        let replaced = Self::replaced(points, mistake, found_one, &others, &colours(assignment, &wrong)?)?;
        let colour = assignment.equation.colour();
        let judged = assignment.rubric.iter().filter_map(|line| assignment.equation.index(&line.judges));
        let last = judged.filter(|d| *d < colour).max();
        let differs = |d: usize| right.iter().zip(&wrong).any(|(right, wrong)| !is_same(&right[d], &wrong[d]));
        // The sum and what is made of it would always do, and says nothing of a mistake in one term.
        let following = (0..last.map_or(0, |last| last + 1)).filter(|d| !replaced.contains(d) && differs(*d)).collect();
        let Mistake { handed_out, at_use, .. } = *mistake;
        Some(Self { points, replaced, following, right, wrong, wanted, handed_out, at_use })
    }

    /// The definitions that the mistake replaces in the form in which it was found, and in those that come to the same.
    fn replaced(
        points: &Points<'_>,
        mistake: &Mistake,
        found: &FoundMistake,
        others: &[FoundMistake],
        wrong: &[[f64; 3]],
    ) -> Option<Vec<usize>> {
        let assignment = points.assignment;
        let is_equal = |form: usize| {
            let other = FoundMistake { form, ..found.clone() };
            let all: Vec<FoundMistake> = others.iter().cloned().chain([other]).collect();
            let colours = assignment.variant(&all).and_then(|v| colours(assignment, &points.definitions(&v)));
            colours.is_some_and(|colours| colours.iter().zip(wrong).all(|(a, b)| is_close(*b, a)))
        };
        let forms = (0..mistake.forms.len()).filter(|form| *form == found.form || is_equal(*form));
        let overrides = forms.flat_map(|form| mistake.forms[form].overrides.iter().map(|one| one.definition));
        let mut replaced: Vec<usize> = overrides.collect();
        replaced.sort_unstable();
        replaced.dedup();
        Some(replaced)
    }

    /// Whether the mistake makes something 0 everywhere that should not be.
    fn is_zero(&self) -> bool {
        let [d] = self.replaced[..] else { return false };
        self.wrong.iter().all(|wrong| wrong[d].iter().take(3).all(|x| *x == 0.0))
    }

    /// The place of a value that is not right.
    fn wrong_value(&self) -> Option<Located> {
        // Of definitions that would all do, the one that is computed first: the others follow from it.
        let direct = self.replaced.iter().filter_map(|d| self.direct(*d)).min_by_key(|place| self.order(*place));
        let place = direct.or_else(|| self.replaced.iter().find_map(|d| self.everywhere(*d)));
        let place = place.or_else(|| self.following.iter().find_map(|d| self.direct(*d)));
        let place = place.or_else(|| self.condition()).or_else(|| self.factor())?;
        self.located(self.outside_of_helper(place), Role::Wrong)
    }

    /// When a value is computed.
    fn order(&self, place: Site) -> usize {
        self.points.points[0].values.iter().position(|(at, _)| *at == place).unwrap_or(usize::MAX)
    }

    fn located(&self, place: Site, role: Role) -> Option<Located> {
        let interpreter = self.points.interpreter;
        let name = interpreter.variable(place).map(str::to_owned);
        Some(Located { line: interpreter.line(place)?, name, role, stage: None })
    }

    /// The values at the first point, which is a wrong one.
    fn values(&self) -> impl DoubleEndedIterator<Item = (Site, Vec<f64>)> {
        self.points.points[0].values.iter().filter_map(|(place, value)| Some((*place, value.floats()?)))
    }

    /// The first value that mends the colour when it is what definition `d` should be.
    fn direct(&self, d: usize) -> Option<Site> {
        let mut places = self.mending(d);
        if self.at_use {
            return places.last();
        }
        let first = places.next()?;
        // Where it is right further down, and made wrong again after that, what stands before is not to blame.
        let is_right = |place: &Site| self.is_definition(*place, d) && self.order(*place) > self.order(first);
        let Some((right, _)) = self.values().rfind(|(place, _)| place.operand == 0 && is_right(place)) else {
            return Some(first);
        };
        let later = places.find(|place| self.order(*place) > self.order(right) && self.depends(*place, right));
        later.or(Some(first))
    }

    fn mending(&self, d: usize) -> impl Iterator<Item = Site> {
        let candidates = self.values().filter(move |(place, value)| {
            fits(value, &self.right[0][d])
                && (self.handed_out || self.points.is_own(*place))
                && !self.points.interpreter.is_initial(*place)
                && !self.is_start_of_sum(*place)
                && (self.is_zero() || !self.is_zero_at_all_points(*place))
        });
        candidates.map(|(place, _)| place).filter(move |place| {
            self.mends(&|point, at, value| (at == *place).then(|| put(value, &self.right[point][d]))?)
        })
    }

    fn mends(&self, change: &dyn Fn(usize, Site, &Value) -> Option<Value>) -> bool {
        self.points.becomes(&self.wanted, change)
    }

    /// The first of the values that mend the colour when each that is the wrong definition `d` becomes the right one:
    /// something that is computed anew wherever it is needed.
    fn everywhere(&self, d: usize) -> Option<Site> {
        let is_wrong = |point: usize, value: &[f64]| {
            is_same(value, &self.wrong[point][d]) && !is_same(value, &self.right[point][d])
        };
        if self.wrong.iter().all(|wrong| is_same(&wrong[d], &self.wrong[0][d])) {
            return None;
        }
        let change = |point: usize, _: Site, value: &Value| {
            let floats = value.floats()?;
            is_wrong(point, &floats).then(|| put(value, &self.right[point][d]))?
        };
        if !self.mends(&change) {
            return None;
        }
        let interpreter = self.points.interpreter;
        let mut places = self.values().filter(|(place, value)| !interpreter.is_copy(*place) && is_wrong(0, value));
        let (first, _) = places.next()?;
        places.all(|(place, _)| interpreter.line(place) == interpreter.line(first)).then_some(first)
    }

    /// The first condition that mends the colour when it always holds, or never.
    fn condition(&self) -> Option<Site> {
        let conditions = self.points.points.iter().flat_map(|point| &point.values);
        let mut conditions = conditions.filter(|(_, value)| matches!(value, Value::Bool(_))).map(|(place, _)| *place);
        conditions.find(|place| {
            [true, false].into_iter().any(|truth| self.mends(&|_, at, _| (at == *place).then_some(Value::Bool(truth))))
        })
    }

    /// The last value on its way into a product that mends the colour when it is scaled as the mistake scales; where
    /// that is right by itself, what it is added to.
    fn factor(&self) -> Option<Site> {
        let interpreter = self.points.interpreter;
        let all = self.replaced.iter().chain(&self.following);
        for d in all {
            let scaled: Vec<Site> = self
                .values()
                .map(|(place, _)| place)
                .filter(|place| !interpreter.is_copy(*place))
                .filter(|place| {
                    self.mends(&|point, at, value| {
                        (at == *place).then(|| scale(value, &self.right[point][*d], &self.wrong[point][*d]))?
                    })
                })
                .collect();
            let Some(last) = scaled.last() else { continue };
            if !self.is_right(*last) {
                return Some(*last);
            }
            if let Some(sum) = self.sums(*d).find(|sum| self.depends(*sum, *last)) {
                return Some(sum);
            }
        }
        None
    }

    /// Whether a value is made of another.
    fn depends(&self, place: Site, on: Site) -> bool {
        // Neither 0 nor 1.
        const OTHER: f64 = 1.7;
        let point = &self.points.points[0];
        let before = point.values.iter().find(|(at, _)| *at == place).map(|(_, value)| value);
        let mut after = None;
        let look = &mut |at: Site, value: &Value| {
            if at == place {
                after = Some(value.clone());
            }
            let floats = (at == on).then(|| value.floats())??;
            Some(Value::of_floats(&floats.iter().map(|x| x * OTHER + 0.1).collect::<Vec<_>>()))
        };
        self.points.interpreter.run(&point.given, self.points.output, look).is_some() && after.as_ref() != before
    }

    /// Whether a value is that of some definition of the right equation, at every point.
    fn is_right(&self, place: Site) -> bool {
        (0..self.right[0].len()).any(|d| self.is_definition(place, d))
    }

    /// Whether a value is that of definition `d` at every point.
    fn is_definition(&self, place: Site, d: usize) -> bool {
        self.at_all_points(place, |value, point| is_same(value, &self.right[point][d]))
    }

    fn is_zero_at_all_points(&self, place: Site) -> bool {
        self.at_all_points(place, |value, _| value.iter().take(3).all(|x| *x == 0.0))
    }

    /// Whether something holds of a value wherever it is computed.
    fn at_all_points(&self, place: Site, holds: impl Fn(&[f64], usize) -> bool) -> bool {
        self.points.points.iter().enumerate().all(|(index, point)| {
            let value = point.values.iter().find(|(at, _)| *at == place).and_then(|(_, value)| value.floats());
            value.is_none_or(|value| holds(&value, index))
        })
    }

    /// The sums that mend the colour when what definition `d` lacks is added.
    fn sums(&self, d: usize) -> impl Iterator<Item = Site> {
        let sums = self.values().filter(|(place, _)| self.points.interpreter.is_sum(*place));
        sums.map(|(place, _)| place).filter(move |place| {
            self.mends(&|point, at, value| {
                (at == *place).then(|| add(value, &self.right[point][d], &self.wrong[point][d]))?
            })
        })
    }

    /// Where a term is that is 0 everywhere, or else the sum in which it does not appear.
    fn missing(&self) -> Option<Located> {
        let d = self.replaced[0];
        let zero = self.mending(d).next().and_then(|place| self.located(place, Role::Zero));
        // What is 0 at the points may be another term.
        if let Some(zero) = zero.filter(|_| self.has_constants_of(d)) {
            return Some(zero);
        }
        let role = if self.has_influence(d) { Role::Lost } else { Role::Absent };
        if let Some(sum) = self.sums(d).last() {
            return self.located(sum, role);
        }
        let store = self.points.interpreter.last_store(self.points.output)?;
        Some(Located { line: self.points.interpreter.line(store)?, name: None, role, stage: None })
    }

    /// Whether a constant is what a sum begins with, and not a term.
    fn is_start_of_sum(&self, place: Site) -> bool {
        let interpreter = self.points.interpreter;
        if place.operand == 0 || !self.is_zero_at_all_points(place) {
            return false;
        }
        if interpreter.stores_in(place, self.points.output) {
            return true;
        }
        let Some(name) = interpreter.variable(place) else { return false };
        let mut loads = self.values().filter(|(at, _)| at.operand == 0 && interpreter.is_load_of(*at, name));
        loads.next_back().is_some_and(|(_, value)| value.iter().take(3).any(|x| *x != 0.0))
    }

    /// Whether the text uses a constant that the definition is made of, or none is.
    fn has_constants_of(&self, d: usize) -> bool {
        let used = self.points.assignment.equation.constants_in(d);
        let count = |name: &str| self.points.source.words().filter(|(_, word)| *word == name).count();
        used.is_empty() || used.iter().any(|name| count(name) > 1)
    }

    /// Whether the colour changes with one of the constants that the definition is made of.
    fn has_influence(&self, d: usize) -> bool {
        // Neither 0 nor what a clamp hides.
        const BRIGHTER: f64 = 1.7;
        let used = self.points.assignment.equation.constants_in(d);
        let constants =
            self.points.assignment.constants.iter().filter(|constant| used.contains(&constant.name.as_str()));
        constants.into_iter().any(|constant| {
            let numbers: Vec<f64> = constant.value.numbers().iter().map(|x| x * BRIGHTER + 0.1).collect();
            !self.points.is_unchanged_with(&constant.name, &Value::of_floats(&numbers))
        })
    }

    /// A function or a macro that computes something right where it is used elsewhere is not to blame: what it is given
    /// here is, or else what is made of it.
    fn outside_of_helper(&self, place: Site) -> Site {
        let interpreter = self.points.interpreter;
        let is_other_use = |at: &Site| {
            let is_shared = at.instruction == place.instruction
                || self.points.is_in_macro(place) && interpreter.is_alike(*at, place);
            *at != place && at.operand == 0 && is_shared && self.is_right(*at)
        };
        if !self.values().any(|(at, _)| is_other_use(&at)) {
            return place;
        }
        let is_outside = |at: &Site| {
            interpreter.line(*at) != interpreter.line(place)
                && interpreter.function(*at) == interpreter.function_of_main()
        };
        let given = self.replaced.iter().flat_map(|d| 0..*d).filter(|d| self.right[0][*d].len() == 3);
        let given = given.filter_map(|d| self.mending(d).find(is_outside)).min_by_key(|at| self.order(*at));
        let made = || self.replaced.iter().chain(&self.following).find_map(|d| self.mending(*d).find(is_outside));
        given.or_else(made).unwrap_or(place)
    }
}

/// `right` in the shape of `value`.
fn put(value: &Value, right: &[f64]) -> Option<Value> {
    let own = value.floats()?;
    let taken = own.iter().enumerate().map(|(at, own)| right.get(at).copied().unwrap_or(*own));
    Some(Value::of_floats(&taken.collect::<Vec<_>>()))
}

/// `value` by as much as `right` is of `wrong`.
fn scale(value: &Value, right: &[f64], wrong: &[f64]) -> Option<Value> {
    let mut own = value.floats()?;
    let ratios: Vec<Option<f64>> =
        right.iter().zip(wrong).take(3).map(|(r, w)| (*w != 0.0).then(|| r / w).filter(|x| x.is_finite())).collect();
    for (at, number) in own.iter_mut().enumerate().take(3) {
        let ratio = if ratios.len() == 1 || value.is_scalar() {
            ratios.iter().flatten().next()
        } else {
            ratios.get(at)?.as_ref()
        };
        *number *= ratio.copied().unwrap_or(1.0);
    }
    Some(Value::of_floats(&own))
}

/// `value` and what `wrong` lacks of `right`.
fn add(value: &Value, right: &[f64], wrong: &[f64]) -> Option<Value> {
    let mut own = value.floats()?;
    if !fits(&own, right) {
        return None;
    }
    for ((own, right), wrong) in own.iter_mut().zip(right).zip(wrong).take(3) {
        *own += right - wrong;
    }
    Some(Value::of_floats(&own))
}
