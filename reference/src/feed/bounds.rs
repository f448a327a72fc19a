//! What a probe may draw at random for a uniform.

use crate::Value;
use crate::interpreter::{Scalar, Type};
use crate::value::rounded;

/// The least and the greatest number of each scalar.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    kind: Type,
    ranges: Vec<(f64, f64)>,
}

impl Bounds {
    /// Bounds of a type, of as many numbers as it has or of one for all; `None` where they do not fit.
    pub fn new(kind: &Type, least: &[f64], greatest: &[f64]) -> Option<Self> {
        let count = kind.slots()?;
        let at = |numbers: &[f64], index: usize| {
            if numbers.len() == 1 { numbers.first() } else { numbers.get(index) }.copied()
        };
        let fits = |numbers: &[f64]| numbers.len() == 1 || numbers.len() == count;
        let is_whole = kind.scalar().is_some_and(Scalar::is_integer);
        let range = |index: usize| {
            let range = (at(least, index)?, at(greatest, index)?);
            let is_whole = !is_whole || (range.0.fract() == 0.0 && range.1.fract() == 0.0);
            let is_number = range.0.is_finite() && range.1.is_finite() && range.0 <= range.1;
            (is_number && is_whole && (kind.scalar() != Some(Scalar::Uint) || range.0 >= 0.0)).then_some(range)
        };
        let ranges = (0..count).map(range).collect::<Option<Vec<_>>>()?;
        (fits(least) && fits(greatest) && kind.scalar().is_some()).then(|| Self { kind: kind.clone(), ranges })
    }

    /// Whether a value lies within.
    pub fn hold(&self, value: &Value) -> bool {
        let numbers = value.numbers();
        let is_within = |(number, (least, greatest)): (&f64, &(f64, f64))| (*least..=*greatest).contains(number);
        numbers.len() == self.ranges.len() && numbers.iter().zip(&self.ranges).all(is_within)
    }

    /// A value within; `random` gives numbers in [0, 1).
    pub fn draw(&self, mut random: impl FnMut() -> f64) -> Value {
        let is_whole = !self.kind.scalar().is_some_and(Scalar::is_floating);
        let number = |&(least, greatest): &(f64, f64)| match is_whole {
            true => (least + (random() * (greatest - least + 1.0)).floor()).min(greatest),
            false => least + (greatest - least) * random(),
        };
        let numbers: Vec<f64> = self.ranges.iter().map(number).collect();
        rounded(Value::of(self.kind.clone(), numbers))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_reach_both_ends() {
        let bounds = Bounds::new(&Type::INT, &[2.0], &[4.0]).expect("bounds");
        let drawn = |unit: f64| bounds.draw(|| unit).numbers()[0];
        assert_eq!([0.0, 0.4, 0.999].map(drawn), [2.0, 3.0, 4.0]);
    }

    #[test]
    fn bounds_fit_their_type() {
        assert!(Bounds::new(&Type::VEC4, &[0.0], &[1.0, 2.0, 3.0, 4.0]).is_some());
        assert!(Bounds::new(&Type::VEC4, &[0.0, 0.0], &[1.0]).is_none());
        assert!(Bounds::new(&Type::FLOAT, &[2.0], &[1.0]).is_none());
        assert!(Bounds::new(&Type::INT, &[0.5], &[1.0]).is_none());
        assert!(Bounds::new(&Type::UINT, &[-1.0], &[1.0]).is_none());
    }
}
