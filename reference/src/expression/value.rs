//! Values of GLSL expressions, with every float held as f64.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

/// A GLSL type that an expression may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Type {
    /// `bool`
    Bool,
    /// `float`
    Float,
    /// `vec2`
    Vec2,
    /// `vec3`
    Vec3,
    /// `vec4`
    Vec4,
    /// `mat3`
    Mat3,
    /// `mat4`
    Mat4,
}

impl Type {
    const ALL: [Self; 7] = [Self::Bool, Self::Float, Self::Vec2, Self::Vec3, Self::Vec4, Self::Mat3, Self::Mat4];

    /// The type's name in GLSL.
    pub const fn glsl(self) -> &'static str {
        match self {
            Self::Bool => "bool",
            Self::Float => "float",
            Self::Vec2 => "vec2",
            Self::Vec3 => "vec3",
            Self::Vec4 => "vec4",
            Self::Mat3 => "mat3",
            Self::Mat4 => "mat4",
        }
    }

    /// The type with this name in GLSL.
    pub fn from_glsl(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|t| t.glsl() == name)
    }

    /// How many numbers a value of this type holds.
    pub const fn numbers(self) -> usize {
        match self {
            Self::Bool | Self::Float => 1,
            Self::Vec2 => 2,
            Self::Vec3 => 3,
            Self::Vec4 => 4,
            Self::Mat3 => 9,
            Self::Mat4 => 16,
        }
    }

    /// The vector (or `float`) of `width` components.
    pub(super) const fn of_width(width: usize) -> Option<Self> {
        match width {
            1 => Some(Self::Float),
            2 => Some(Self::Vec2),
            3 => Some(Self::Vec3),
            4 => Some(Self::Vec4),
            _ => None,
        }
    }

    /// Number of components of a `float` or vector; `None` for the other types.
    pub(super) const fn width(self) -> Option<usize> {
        match self {
            Self::Float => Some(1),
            Self::Vec2 => Some(2),
            Self::Vec3 => Some(3),
            Self::Vec4 => Some(4),
            _ => None,
        }
    }
}

/// A value of one of the [`Type`]s. Matrices are column-major, as in GLSL; they are boxed, so that the others stay small.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `bool`
    Bool(bool),
    /// `float`
    Float(f64),
    /// `vec2`
    Vec2(DVec2),
    /// `vec3`
    Vec3(DVec3),
    /// `vec4`
    Vec4(DVec4),
    /// `mat3`
    Mat3(Box<DMat3>),
    /// `mat4`
    Mat4(Box<DMat4>),
}

impl Value {
    /// The value's type.
    pub const fn kind(&self) -> Type {
        match self {
            Self::Bool(_) => Type::Bool,
            Self::Float(_) => Type::Float,
            Self::Vec2(_) => Type::Vec2,
            Self::Vec3(_) => Type::Vec3,
            Self::Vec4(_) => Type::Vec4,
            Self::Mat3(_) => Type::Mat3,
            Self::Mat4(_) => Type::Mat4,
        }
    }

    /// The value of type `kind` with these numbers (column-major for matrices); `None` when their count is wrong.
    pub fn from_numbers(kind: Type, numbers: &[f64]) -> Option<Self> {
        if numbers.len() != kind.numbers() {
            return None;
        }
        Some(match kind {
            Type::Bool => return None,
            Type::Float => Self::Float(numbers[0]),
            Type::Vec2 => Self::Vec2(DVec2::from_slice(numbers)),
            Type::Vec3 => Self::Vec3(DVec3::from_slice(numbers)),
            Type::Vec4 => Self::Vec4(DVec4::from_slice(numbers)),
            Type::Mat3 => Self::Mat3(Box::new(DMat3::from_cols_slice(numbers))),
            Type::Mat4 => Self::Mat4(Box::new(DMat4::from_cols_slice(numbers))),
        })
    }

    /// The value's numbers, column-major for matrices; a `bool` is 0 or 1.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Bool(b) => vec![f64::from(u8::from(*b))],
            Self::Float(x) => vec![*x],
            Self::Vec2(v) => v.to_array().to_vec(),
            Self::Vec3(v) => v.to_array().to_vec(),
            Self::Vec4(v) => v.to_array().to_vec(),
            Self::Mat3(m) => m.to_cols_array().to_vec(),
            Self::Mat4(m) => m.to_cols_array().to_vec(),
        }
    }

    /// The value of a `float`, or the first component; NaN for anything else.
    pub fn float(&self) -> f64 {
        self.components().map_or(f64::NAN, |(c, _)| c[0])
    }

    /// The value as a colour or position of four components; what a shorter vector lacks is 0.
    pub fn vec4(&self) -> DVec4 {
        self.components().map_or(DVec4::NAN, |(c, _)| DVec4::from_array(c))
    }

    /// The first three components, see [`Value::vec4`].
    pub fn vec3(&self) -> DVec3 {
        self.vec4().truncate()
    }

    /// Components and width of a `float` or vector.
    pub(super) fn components(&self) -> Option<([f64; 4], usize)> {
        match self {
            Self::Float(x) => Some(([*x, 0.0, 0.0, 0.0], 1)),
            Self::Vec2(v) => Some(([v.x, v.y, 0.0, 0.0], 2)),
            Self::Vec3(v) => Some(([v.x, v.y, v.z, 0.0], 3)),
            Self::Vec4(v) => Some((v.to_array(), 4)),
            Self::Bool(_) | Self::Mat3(_) | Self::Mat4(_) => None,
        }
    }

    /// The `float` or vector of the first `width` components.
    pub(super) fn from_components(c: [f64; 4], width: usize) -> Self {
        match width {
            1 => Self::Float(c[0]),
            2 => Self::Vec2(DVec2::new(c[0], c[1])),
            3 => Self::Vec3(DVec3::new(c[0], c[1], c[2])),
            _ => Self::Vec4(DVec4::from_array(c)),
        }
    }

    /// `change` applied to every component.
    pub(super) fn map(&self, change: impl Fn(f64) -> f64) -> Option<Self> {
        let (c, width) = self.components()?;
        Some(Self::from_components(c.map(change), width))
    }

    /// `join` applied component by component; a `float` goes with every component of a vector.
    pub(super) fn zip(&self, other: &Self, join: impl Fn(f64, f64) -> f64) -> Option<Self> {
        let (a, wide_a) = self.components()?;
        let (b, wide_b) = other.components()?;
        let width = wide_a.max(wide_b);
        let mut c = [0.0; 4];
        for (i, slot) in c.iter_mut().enumerate().take(width) {
            *slot = join(a[if wide_a == 1 { 0 } else { i }], b[if wide_b == 1 { 0 } else { i }]);
        }
        Some(Self::from_components(c, width))
    }
}
