//! A statement with its values, as a report keeps them.

use super::standing::{Counterpart, StatementStanding};
use super::variable;
use crate::diagnose::columns::ScalarColumns;
use crate::diagnose::inside::Stage;
use crate::diagnose::inside::search::Search;
use crate::report::{ValueAt, ValueLine};
use reference::interpreter::trace::Trace;

/// Numbers are kept with so many significant digits; beyond that they are the machine's.
const DIGITS: i32 = 6;

impl Search<'_, '_> {
    /// A statement at the places from `first` on; `None` where it is not reached there.
    pub(super) fn line(
        &self,
        stage: Stage,
        site: usize,
        events: &[usize],
        standing: &StatementStanding,
        first: usize,
    ) -> Option<ValueLine> {
        let trace: &Trace = self.trace(stage)?;
        let own = &self.theirs.stage(stage).sites()[site];
        let (name, is_part) = variable(own);
        let (_, source) = self.evidence.sources.iter().find(|(known, _)| *known == stage)?;
        let reached = |place: usize| {
            let lane = move |event: usize| self.lane(stage, &trace.events[event], place);
            events.iter().enumerate().filter(move |(_, event)| trace.events[**event].lanes[lane(**event)])
        };
        let value = |place: usize| {
            let (turn, event) = reached(place).next_back()?;
            let event = &trace.events[*event];
            let lane = self.lane(stage, event, place);
            let at = |columns: &ScalarColumns| -> Vec<f64> { columns.iter().map(|column| column[lane]).collect() };
            let value = at(&event.values);
            let right = match standing {
                StatementStanding::Unknown => None,
                StatementStanding::Right(_) => Some(value.clone()),
                StatementStanding::Wrong(counterpart) => Some(at(&counterpart.values[turn])),
            };
            let agrees = right.as_ref().map(|right| looks_same(&value, right));
            Some(ValueAt { value: numbers(&value), right: right.map(|right| numbers(&right)), agrees })
        };
        let values: Vec<Option<ValueAt>> = (first..self.count).map(value).collect();
        let times = (first..self.count).map(|place| reached(place).count()).max().filter(|times| *times > 0)?;
        let text = source.text.lines().nth(own.line as usize - 1);
        Some(ValueLine {
            file: (self.evidence.sources.len() > 1).then(|| source.facts.name.clone()),
            line: own.line,
            name: text.filter(|_| is_part).and_then(|text| written(text, name)).unwrap_or_else(|| name.to_owned()),
            function: own.function.clone().filter(|function| function != "main"),
            times: times as u32,
            means: match standing {
                StatementStanding::Unknown => None,
                StatementStanding::Right(means) | StatementStanding::Wrong(Counterpart { means, .. }) => means.clone(),
            },
            values,
        })
    }
}

/// Whether two values look the same to a reader.
///
/// Noise: what is computed in another order differs by 1e-6. Defect to catch: the faintest known mistake changes a colour by 1e-2.
fn looks_same(own: &[f64], right: &[f64]) -> bool {
    const OF_LARGEST: f64 = 1e-4;
    const LEAST: f64 = 0.1;
    let largest = right.iter().filter(|number| number.is_finite()).fold(LEAST, |most, number| most.max(number.abs()));
    let is_one = |(own, right): (&f64, &f64)| match right.is_finite() {
        true => (own - right).abs() <= OF_LARGEST * largest,
        false => !own.is_finite(),
    };
    own.iter().zip(right).all(is_one)
}

/// The part of a variable as a line writes it before `=`: `c.rgb`, `lights[1]`.
fn written(text: &str, name: &str) -> Option<String> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let begins = text
        .match_indices(name)
        .map(|(at, _)| at)
        .find(|at| !text[..*at].ends_with(is_word) && text[at + name.len()..].starts_with(['.', '[']))?;
    let rest = &text[begins..];
    let mut depth = 0_i32;
    let end = rest.find(|c: char| {
        depth += i32::from(c == '[') - i32::from(c == ']');
        depth == 0 && !is_word(c) && !matches!(c, '.' | ']')
    })?;
    Some(rest[..end].to_owned())
}

/// Numbers as a report keeps them.
pub(super) fn numbers(all: &[f64]) -> Vec<Option<f64>> {
    let number = |number: &f64| {
        if *number == 0.0 || !number.is_finite() {
            return number.is_finite().then_some(0.0);
        }
        let scale = 10_f64.powi(DIGITS - 1 - number.abs().log10().floor() as i32);
        let rounded = (number * scale).round() / scale;
        Some(if rounded.is_finite() { rounded } else { *number })
    };
    all.iter().map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_named_as_it_is_written() {
        let part = |text, name| written(text, name);
        assert_eq!(part("  c.rgb = a.c.x;", "c").as_deref(), Some("c.rgb"));
        assert_eq!(part("vc.x += c[i + 1].y;", "c").as_deref(), Some("c[i + 1].y"));
        assert_eq!(part("lights[i + 1].colour *= 2.0;", "lights").as_deref(), Some("lights[i + 1].colour"));
        assert_eq!(part("abc.x = 1.0;", "bc"), None);
    }

    #[test]
    fn numbers_have_six_digits_and_what_is_none_is_null() {
        assert_eq!(
            numbers(&[1.0 / 3.0, -123_456.7, 0.0, -0.0, f64::NAN, f64::INFINITY, 1e-320]),
            [Some(0.333333), Some(-123457.0), Some(0.0), Some(0.0), None, None, Some(1e-320)]
        );
    }
}
