//! What an instruction computes, with every float held as f64.

/// A value of the shader.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A truth value.
    Bool(bool),
    /// The bits of an integer, signed or not.
    Int(u32),
    /// A float of any width.
    Float(f64),
    /// A vector, the columns of a matrix, the elements of an array, the members of a structure.
    Composite(Vec<Value>),
    /// A place in memory: the variable, and the way into it.
    Pointer(usize, Vec<usize>),
}

impl Value {
    /// A float, or the vector of these floats.
    pub fn of_floats(floats: &[f64]) -> Self {
        match floats {
            [x] => Self::Float(*x),
            _ => Self::Composite(floats.iter().map(|x| Self::Float(*x)).collect()),
        }
    }

    /// The matrix with these columns, each of `rows` numbers.
    pub fn of_columns(numbers: &[f64], rows: usize) -> Self {
        Self::Composite(numbers.chunks(rows.max(1)).map(Self::of_floats).collect())
    }

    /// The numbers of a float or a vector of floats; none for anything else.
    pub fn floats(&self) -> Option<Vec<f64>> {
        match self {
            Self::Float(x) => Some(vec![*x]),
            Self::Composite(parts) => parts.iter().map(Self::float).collect(),
            _ => None,
        }
    }

    /// Whether it has one component.
    pub fn is_scalar(&self) -> bool {
        !matches!(self, Self::Composite(_))
    }

    pub(super) fn float(&self) -> Option<f64> {
        if let Self::Float(x) = self { Some(*x) } else { None }
    }

    pub(super) fn int(&self) -> Option<u32> {
        if let Self::Int(bits) = self { Some(*bits) } else { None }
    }

    pub(super) fn bool(&self) -> Option<bool> {
        if let Self::Bool(truth) = self { Some(*truth) } else { None }
    }

    pub(super) fn parts(&self) -> Option<&[Self]> {
        if let Self::Composite(parts) = self { Some(parts) } else { None }
    }

    /// The part at the end of `way`.
    pub(super) fn at(&self, way: &[usize]) -> Option<&Self> {
        way.iter().try_fold(self, |value, index| value.parts()?.get(*index))
    }

    /// The part at the end of `way`, to be changed.
    pub(super) fn at_mut(&mut self, way: &[usize]) -> Option<&mut Self> {
        way.iter().try_fold(self, |value, index| match value {
            Self::Composite(parts) => parts.get_mut(*index),
            _ => None,
        })
    }

    /// `f` of each component.
    pub(super) fn map(&self, f: &impl Fn(&Self) -> Option<Self>) -> Option<Self> {
        match self {
            Self::Composite(parts) => {
                Some(Self::Composite(parts.iter().map(|part| part.map(f)).collect::<Option<_>>()?))
            }
            scalar => f(scalar),
        }
    }

    /// `f` of each pair of components.
    pub(super) fn zip(&self, other: &Self, f: &impl Fn(&Self, &Self) -> Option<Self>) -> Option<Self> {
        match (self, other) {
            (Self::Composite(a), Self::Composite(b)) if a.len() == b.len() => {
                let parts = a.iter().zip(b).map(|(a, b)| a.zip(b, f));
                Some(Self::Composite(parts.collect::<Option<_>>()?))
            }
            (Self::Composite(_), _) | (_, Self::Composite(_)) => None,
            (a, b) => f(a, b),
        }
    }
}
