//! What a wrong answer computes on its way, line by line, at a few places.

use crate::language::Text;
use serde::{Deserialize, Serialize};

/// What a wrong answer computes on its way, at a few places.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OwnValues {
    /// The places: those that differ, then one that does not, where there is one.
    pub places: Vec<ValuePlace>,
    /// The statements that give a variable its value, in the order in which they run.
    pub lines: Vec<ValueLine>,
}

/// A vertex or a pixel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct ValuePlace {
    /// The number of the frame, from 0; none of a place that no picture shows.
    pub frame: Option<u32>,
    /// Where it is in the picture, as shares of its sides from the upper left corner.
    pub at: Option<[f64; 2]>,
    /// The pixel: column from the left, row from above, both from 0; none of a vertex.
    pub pixel: Option<[u32; 2]>,
    /// The colour that the answer computes there: red, green, blue. Empty where it throws the pixel away.
    pub yours: Vec<Option<f64>>,
    /// The right one.
    pub right: Vec<Option<f64>>,
    /// Whether the two, and the positions, are the same.
    pub agrees: bool,
}

/// A statement that gives a variable its value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ValueLine {
    /// The file, where there are several.
    pub file: Option<String>,
    /// The line of it, from 1.
    pub line: u32,
    /// The variable, or the part of it, as it is written; `return` where a function gives the value back.
    pub name: String,
    /// The function that the statement is in, other than `main`.
    pub function: Option<String>,
    /// How often it runs at the place where it does so most often; the values are those of the last time.
    pub times: u32,
    /// What it should be, in words, where that is known.
    pub means: Option<Text>,
    /// The value at each place; none where the statement is not reached.
    pub values: Vec<Option<ValueAt>>,
}

/// A value at a place. What is no number is null.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct ValueAt {
    /// Its numbers; those of a matrix column by column.
    pub value: Vec<Option<f64>>,
    /// What they should be, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub right: Option<Vec<Option<f64>>>,
    /// Whether they are, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub agrees: Option<bool>,
}

impl OwnValues {
    /// Leaves out all places but the first and the last.
    pub fn keep_ends(&mut self) {
        if self.places.len() > 2 {
            self.places.drain(1..self.places.len() - 1);
            self.lines.iter_mut().for_each(|line| drop(line.values.drain(1..line.values.len() - 1)));
        }
    }

    /// For each place the first line that is not what it should be, or of which the report says so, where nothing else is known of it.
    /// `is_said`: whether the report does.
    pub fn first_wrong(&self, is_said: impl Fn(&ValueLine) -> bool) -> Vec<Option<usize>> {
        let is_wrong = |line: &ValueLine, place: usize| {
            let agrees = line.values.get(place).and_then(Option::as_ref).map(|value| value.agrees);
            agrees.is_some_and(|agrees| agrees == Some(false) || agrees.is_none() && is_said(line))
        };
        let first = |(place, shown): (usize, &ValuePlace)| {
            let wrong = self.lines.iter().position(|line| is_wrong(line, place));
            wrong.filter(|_| !shown.agrees || self.lines.iter().any(|line| line.is_off(place)))
        };
        self.places.iter().enumerate().map(first).collect()
    }
}

impl ValueLine {
    /// Whether the value at a place is known not to be what it should be.
    pub fn is_off(&self, place: usize) -> bool {
        self.values.get(place).and_then(Option::as_ref).is_some_and(|value| value.agrees == Some(false))
    }
}

#[cfg(test)]
mod tests {
    use crate::report::samples;

    #[test]
    fn the_ends_are_kept_with_their_values() {
        let mut values = samples::own_values();
        values.places.insert(1, values.places[0].clone());
        values.lines.iter_mut().for_each(|line| line.values.insert(1, None));
        values.keep_ends();
        assert_eq!(values, samples::own_values());
        values.keep_ends();
        assert_eq!(values, samples::own_values());
    }

    #[test]
    fn the_first_wrong_line_is_known_or_the_one_that_the_report_speaks_of() {
        let values = samples::own_values();
        assert_eq!(values.first_wrong(|_| false), [Some(1), None]);
        // Nothing is known of line 10, and it is not reached at the second place.
        assert_eq!(values.first_wrong(|line| line.line == 10), [Some(0), None]);
    }
}
