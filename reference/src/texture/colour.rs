//! Colours as a folder writes them.

use schemars::JsonSchema;
use serde::Deserialize;

/// Three or four numbers; alpha is 1 where it is not said.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(try_from = "Vec<f64>")]
pub struct Colour(pub [f64; 4]);

impl TryFrom<Vec<f64>> for Colour {
    type Error = &'static str;

    fn try_from(numbers: Vec<f64>) -> Result<Self, Self::Error> {
        let is_finite = numbers.iter().all(|number| (*number as f32).is_finite());
        match numbers[..] {
            [red, green, blue] if is_finite => Ok(Self([red, green, blue, 1.0])),
            [red, green, blue, alpha] if is_finite => Ok(Self([red, green, blue, alpha])),
            _ => Err("a colour is three or four numbers, such as [1, 0.5, 0]"),
        }
    }
}

impl Colour {
    pub(super) const fn grey(level: f64) -> Self {
        Self([level, level, level, 1.0])
    }

    /// So far on the way from one to another.
    pub(super) fn mixed(from: Self, to: Self, share: f64) -> Self {
        Self(std::array::from_fn(|channel| from.0[channel] * (1.0 - share) + to.0[channel] * share))
    }
}
