//! The types of GLSL.

mod name;

use std::sync::Arc;

/// What one component is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scalar {
    /// `bool`
    Bool,
    /// `int`
    Int,
    /// `uint`
    Uint,
    /// `float`
    Float,
    /// `double`
    Double,
}

/// A type. A scalar is a vector of one component.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Type {
    /// No value.
    Void,
    /// Scalar or vector: 1 to 4 components.
    Vector(Scalar, u8),
    /// Matrix of columns × rows.
    Matrix(Scalar, u8, u8),
    /// Array; the length is none until a later declaration, an initialiser or an index gives it.
    Array(Arc<Type>, Option<usize>),
    /// Structure.
    Struct(Arc<Struct>),
    /// Sampler: the number of a texture.
    Sampler(Sampler),
}

/// A structure.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct Struct {
    /// Its name; empty where it has none.
    pub name: String,
    /// Tells structures of one name apart, which may stand in different scopes.
    pub id: usize,
    /// Members by name, in order.
    pub members: Vec<(String, Type)>,
    /// As of its [`Type::slots`]. Kept, because structures of structures are walked in exponential time.
    slots: Option<usize>,
    /// As of its [`Type::has_sampler`].
    has_sampler: bool,
}

impl Struct {
    /// A structure of these members; `id` tells it from others of its name.
    pub fn new(name: String, id: usize, members: Vec<(String, Type)>) -> Self {
        let slots = members.iter().try_fold(0_usize, |sum, (_, kind)| sum.checked_add(kind.slots()?));
        let has_sampler = members.iter().any(|(_, kind)| kind.has_sampler());
        Self { name, id, members, slots, has_sampler }
    }
}

/// What a sampler reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Its coordinates.
    pub dimension: Dimension,
    /// Whether it has layers.
    pub array: bool,
    /// Whether it compares.
    pub shadow: bool,
    /// `Float`, `Int` or `Uint`.
    pub texel: Scalar,
}

/// The coordinates of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dimension {
    /// One coordinate.
    One,
    /// Two coordinates.
    Two,
    /// Three coordinates.
    Three,
    /// A direction.
    Cube,
    /// Two coordinates in texels.
    Rectangle,
}

impl Scalar {
    /// Whether it counts in whole numbers.
    pub fn is_integer(self) -> bool {
        matches!(self, Self::Int | Self::Uint)
    }

    /// Whether it is `float` or `double`.
    pub fn is_floating(self) -> bool {
        matches!(self, Self::Float | Self::Double)
    }
}

impl Sampler {
    /// How many coordinates, layer included, a lookup takes.
    pub fn coordinates(self) -> u8 {
        self.dimension.count() + u8::from(self.array)
    }
}

impl Dimension {
    /// How many coordinates.
    pub fn count(self) -> u8 {
        match self {
            Self::One => 1,
            Self::Two | Self::Rectangle => 2,
            Self::Three | Self::Cube => 3,
        }
    }
}

impl Type {
    /// `bool`
    pub const BOOL: Self = Self::Vector(Scalar::Bool, 1);
    /// `int`
    pub const INT: Self = Self::Vector(Scalar::Int, 1);
    /// `uint`
    pub const UINT: Self = Self::Vector(Scalar::Uint, 1);
    /// `float`
    pub const FLOAT: Self = Self::Vector(Scalar::Float, 1);
    /// `double`
    pub const DOUBLE: Self = Self::Vector(Scalar::Double, 1);
    /// `vec3`
    pub const VEC3: Self = Self::Vector(Scalar::Float, 3);
    /// `vec4`
    pub const VEC4: Self = Self::Vector(Scalar::Float, 4);
    /// `mat4`
    pub const MAT4: Self = Self::Matrix(Scalar::Float, 4, 4);

    /// A vector of floats.
    pub const fn vector(components: u8) -> Self {
        Self::Vector(Scalar::Float, components)
    }

    /// An array of it.
    pub fn array(self, length: Option<usize>) -> Self {
        Self::Array(Arc::new(self), length)
    }

    /// Whether another program means the same type: structures of one name and with the same members are one there.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Struct(own), Self::Struct(other)) => {
                let is_same = |((name, kind), (other_name, other)): (&(String, Self), &(String, Self))| {
                    name == other_name && kind.is_like(other)
                };
                own.name == other.name
                    && own.members.len() == other.members.len()
                    && own.members.iter().zip(&other.members).all(is_same)
            }
            (Self::Array(own, length), Self::Array(other, other_length)) => {
                length == other_length && own.is_like(other)
            }
            (own, other) => own == other,
        }
    }

    /// How many scalars a value has; `None` where a length is not known, or beyond all bounds.
    pub fn slots(&self) -> Option<usize> {
        match self {
            Self::Void => Some(0),
            Self::Vector(_, n) => Some(usize::from(*n)),
            Self::Matrix(_, columns, rows) => Some(usize::from(*columns) * usize::from(*rows)),
            Self::Array(element, length) => element.slots()?.checked_mul((*length)?),
            Self::Struct(structure) => structure.slots,
            Self::Sampler(_) => Some(1),
        }
    }

    /// What its components are, for scalars, vectors and matrices.
    pub fn scalar(&self) -> Option<Scalar> {
        match self {
            Self::Vector(scalar, _) | Self::Matrix(scalar, _, _) => Some(*scalar),
            _ => None,
        }
    }

    /// The same shape of other components.
    pub fn with_scalar(&self, scalar: Scalar) -> Self {
        match self {
            Self::Vector(_, n) => Self::Vector(scalar, *n),
            Self::Matrix(_, columns, rows) => Self::Matrix(scalar, *columns, *rows),
            other => other.clone(),
        }
    }

    /// Whether it is a single number or truth value.
    pub fn is_scalar(&self) -> bool {
        matches!(self, Self::Vector(_, 1))
    }

    /// What an index selects, and how many there are of it.
    pub fn element(&self) -> Option<(Self, Option<usize>)> {
        match self {
            Self::Vector(scalar, n) if *n > 1 => Some((Self::Vector(*scalar, 1), Some(usize::from(*n)))),
            Self::Matrix(scalar, columns, rows) => Some((Self::Vector(*scalar, *rows), Some(usize::from(*columns)))),
            Self::Array(element, length) => Some(((**element).clone(), *length)),
            _ => None,
        }
    }

    /// The scalar of each slot, in order.
    pub fn flat(&self) -> Vec<Scalar> {
        match self {
            Self::Void => Vec::new(),
            Self::Vector(scalar, _) | Self::Matrix(scalar, _, _) => vec![*scalar; self.slots().unwrap_or(0)],
            Self::Array(element, length) => element.flat().repeat(length.unwrap_or(0)),
            Self::Struct(structure) => structure.members.iter().flat_map(|(_, kind)| kind.flat()).collect(),
            Self::Sampler(_) => vec![Scalar::Int],
        }
    }

    /// The scalars and vectors that a variable of this type consists of, each with its path.
    pub fn parts(&self, name: &str) -> Vec<(String, Self)> {
        match self {
            Self::Struct(own) => {
                own.members.iter().flat_map(|(member, kind)| kind.parts(&format!("{name}.{member}"))).collect()
            }
            Self::Vector(..) => vec![(name.to_owned(), self.clone())],
            _ => match self.element() {
                Some((kind, Some(count))) => (0..count).flat_map(|at| kind.parts(&format!("{name}[{at}]"))).collect(),
                _ => vec![(name.to_owned(), self.clone())],
            },
        }
    }

    /// Whether a value holds a sampler somewhere.
    pub fn has_sampler(&self) -> bool {
        match self {
            Self::Sampler(_) => true,
            Self::Array(element, _) => element.has_sampler(),
            Self::Struct(structure) => structure.has_sampler,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_is_its_columns() {
        let kind = Type::named("mat2x3").expect("a type");
        assert_eq!(kind.slots(), Some(6));
        assert_eq!(kind.element(), Type::named("vec3").map(|column| (column, Some(2))));
    }
}
