//! Values as a program is given them, and as it computes them.

use crate::interpreter::{Scalar, Type};
use glam::{DMat4, DVec3, DVec4};

/// A value of a GLSL type, with every number held as f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    kind: Type,
    numbers: Vec<f64>,
}

impl Value {
    /// The value of type `kind` with these numbers (column-major for matrices); `None` when their count is wrong.
    pub fn new(kind: Type, numbers: Vec<f64>) -> Option<Self> {
        (kind.slots() == Some(numbers.len())).then_some(Self { kind, numbers })
    }

    /// The value of type `kind` with the first of these numbers; what they lack is 0.
    pub(crate) fn of(kind: Type, mut numbers: Vec<f64>) -> Self {
        numbers.resize(kind.slots().unwrap_or(0), 0.0);
        Self { kind, numbers }
    }

    /// The value's type.
    pub fn kind(&self) -> &Type {
        &self.kind
    }

    /// The value's numbers, column-major for matrices; a `bool` is 0 or 1.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// The numbers of a matrix or vector times these, one by one.
    pub fn scaled(&self, by: &[f64]) -> Self {
        let numbers = self.numbers.iter().zip(by).map(|(number, by)| number * by);
        Self { kind: self.kind.clone(), numbers: numbers.collect() }
    }

    /// Vectors and floats with the numbers that have no short binary fraction, and so are rounded wherever they are made, by so large a
    /// part greater.
    pub(crate) fn rounded_up(&self, by: f64) -> Self {
        let is_exact = |number: f64| (number * 1024.0).fract() == 0.0;
        let mut value = self.clone();
        if matches!(self.kind, Type::Vector(Scalar::Float, _)) {
            value.numbers.iter_mut().filter(|number| !is_exact(**number)).for_each(|number| *number *= 1.0 + by);
        }
        value
    }

    /// The value of a `float`, or the first component.
    pub fn float(&self) -> f64 {
        self.numbers.first().copied().unwrap_or(f64::NAN)
    }

    /// The value as a colour or position of four components; what a shorter vector lacks is 0.
    pub fn vec4(&self) -> DVec4 {
        vec4(&self.numbers)
    }

    /// The first three components, see [`Value::vec4`].
    pub fn vec3(&self) -> DVec3 {
        vec3(&self.numbers)
    }
}

/// A value as a uniform or an attribute holds it: floats of 32 bits.
pub(crate) fn rounded(mut value: Value) -> Value {
    if value.kind.scalar() == Some(Scalar::Float) {
        value.numbers.iter_mut().for_each(|number| *number = f64::from(*number as f32));
    }
    value
}

/// Values of one type, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// The type of each.
    pub kind: Type,
    /// All their numbers.
    pub numbers: Vec<f64>,
}

impl Values {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.numbers.len() / self.width().max(1)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// How many numbers each has.
    pub fn width(&self) -> usize {
        self.kind.slots().unwrap_or(0)
    }

    /// The numbers of each.
    pub fn iter(&self) -> std::slice::ChunksExact<'_, f64> {
        self.numbers.chunks_exact(self.width().max(1))
    }
}

/// Numbers as three components; what they lack is 0.
pub(crate) fn vec3(numbers: &[f64]) -> DVec3 {
    match *numbers {
        [x, y, z, ..] => DVec3::new(x, y, z),
        _ => vec4(numbers).truncate(),
    }
}

/// Numbers as four components; what they lack is 0.
pub(crate) fn vec4(numbers: &[f64]) -> DVec4 {
    DVec4::from_array(std::array::from_fn(|at| numbers.get(at).copied().unwrap_or(0.0)))
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self { kind: Type::FLOAT, numbers: vec![number] }
    }
}

impl From<DVec4> for Value {
    fn from(vector: DVec4) -> Self {
        Self { kind: Type::VEC4, numbers: vector.to_array().to_vec() }
    }
}

impl From<DMat4> for Value {
    fn from(matrix: DMat4) -> Self {
        Self { kind: Type::MAT4, numbers: matrix.to_cols_array().to_vec() }
    }
}
