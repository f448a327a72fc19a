//! Values of a program at several probes, a column for each scalar.

use crate::compare::COLOUR_TOLERANCE;
use glam::DVec3;
use reference::Value;
use reference::interpreter::trace::Event;

/// The scalars of a value, each for all samples.
pub(super) type ScalarColumns = Vec<Vec<f64>>;

/// The columns of what has one of these values at each place, which has so many samples `each`.
pub(super) fn of_places(values: &[Value], each: usize) -> ScalarColumns {
    let count = values.first().map_or(0, |value| value.numbers().len());
    let column = |scalar: usize| {
        let numbers = values.iter().map(|value| value.numbers()[scalar]);
        numbers.flat_map(|number| std::iter::repeat_n(number, each)).collect()
    };
    (0..count).map(column).collect()
}

/// Whether two numbers are the same but for rounding.
pub(super) fn is_number(a: f64, b: f64) -> bool {
    // What is computed in another order differs by rounding, and constants are f32.
    const RELATIVE: f64 = 1e-4;
    (a - b).abs() <= RELATIVE * a.abs().max(b.abs()).max(1e-3)
}

/// Whether two colours are the same; all that is no number is.
pub(super) fn is_colour(wanted: DVec3, found: DVec3) -> bool {
    let is_channel = |wanted: f64, found: f64| match wanted.is_finite() {
        true => (found - wanted).abs() <= COLOUR_TOLERANCE * wanted.abs().max(1.0),
        false => !found.is_finite(),
    };
    wanted.to_array().into_iter().zip(found.to_array()).all(|(wanted, found)| is_channel(wanted, found))
}

/// Whether a value is the same at all places.
pub(super) fn is_constant(columns: &ScalarColumns) -> bool {
    columns.iter().all(|column| column.iter().all(|value| is_number(*value, column[0])))
}

/// Whether two values are the same everywhere.
pub(super) fn is_equal(a: &ScalarColumns, b: &ScalarColumns) -> bool {
    let is_one = |(a, b): (&f64, &f64)| a.is_nan() && b.is_nan() || is_number(*a, *b);
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.len() == b.len() && a.iter().zip(b).all(is_one))
}

/// Whether a value fits a quantity by its shape: a colour may have three components instead of four.
pub(super) fn fits(value: usize, quantity: usize) -> bool {
    value == quantity || value == 3 && quantity == 4 || value == 4 && quantity == 3
}

/// Whether a value equals a quantity wherever both are there.
pub(super) fn is_same(event: &Event, quantity: &[Vec<f64>]) -> bool {
    if !fits(event.values.len(), quantity.len()) {
        return false;
    }
    let is_lane = |lane: usize, own: &f64, right: &f64| !event.lanes[lane] || right.is_nan() || is_number(*own, *right);
    let columns = event.values.iter().zip(quantity);
    let is_column = |(own, right): (&Vec<f64>, &Vec<f64>)| {
        own.len() == right.len()
            && own.iter().zip(right).enumerate().all(|(lane, (own, right))| is_lane(lane, own, right))
    };
    columns.into_iter().all(is_column)
}

/// Whether no colour of it is anything but 0, where it is computed.
pub(super) fn is_zero(event: &Event) -> bool {
    let is_zero = |column: &Vec<f64>| column.iter().zip(&event.lanes).all(|(value, lane)| !lane || *value == 0.0);
    event.values.iter().take(3).all(is_zero)
}

/// A quantity in the shape of a value: what it has not stays as it is.
pub(super) fn shaped(event: &Event, quantity: &[Vec<f64>]) -> ScalarColumns {
    let own = event.values.iter().enumerate();
    own.map(|(scalar, own)| quantity.get(scalar).unwrap_or(own).clone()).collect()
}
