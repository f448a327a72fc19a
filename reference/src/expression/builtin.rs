//! The GLSL functions that an equation may call (GLSL 4.10 specification, chapter 8).

use super::value::{Type, Value};
use glam::{DMat3, DVec3};

/// A built-in function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Builtin {
    Dot,
    Cross,
    Normalize,
    Length,
    Distance,
    Reflect,
    Max,
    Min,
    Clamp,
    Mix,
    Step,
    Smoothstep,
    Pow,
    Abs,
    Sign,
    Floor,
    Fract,
    Sqrt,
    InverseSqrt,
    Sin,
    Cos,
    Acos,
    Exp,
    Exp2,
    Log,
    Log2,
    Inverse,
    Transpose,
}

impl Builtin {
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "dot" => Self::Dot,
            "cross" => Self::Cross,
            "normalize" => Self::Normalize,
            "length" => Self::Length,
            "distance" => Self::Distance,
            "reflect" => Self::Reflect,
            "max" => Self::Max,
            "min" => Self::Min,
            "clamp" => Self::Clamp,
            "mix" => Self::Mix,
            "step" => Self::Step,
            "smoothstep" => Self::Smoothstep,
            "pow" => Self::Pow,
            "abs" => Self::Abs,
            "sign" => Self::Sign,
            "floor" => Self::Floor,
            "fract" => Self::Fract,
            "sqrt" => Self::Sqrt,
            "inversesqrt" => Self::InverseSqrt,
            "sin" => Self::Sin,
            "cos" => Self::Cos,
            "acos" => Self::Acos,
            "exp" => Self::Exp,
            "exp2" => Self::Exp2,
            "log" => Self::Log,
            "log2" => Self::Log2,
            "inverse" => Self::Inverse,
            "transpose" => Self::Transpose,
            _ => return None,
        })
    }

    /// The type of the result for arguments of these types; `None` where GLSL has no such overload.
    pub(super) fn result(self, arguments: &[Type]) -> Option<Type> {
        let vector = |t: Type| t.width().is_some();
        match (self, arguments) {
            (Self::Dot | Self::Distance, [a, b]) if a == b && vector(*a) => Some(Type::Float),
            (Self::Cross, [Type::Vec3, Type::Vec3]) => Some(Type::Vec3),
            (Self::Length, [a]) if vector(*a) => Some(Type::Float),
            (Self::Reflect | Self::Pow, [a, b]) if a == b && vector(*a) => Some(*a),
            (Self::Max | Self::Min, [a, b]) if vector(*a) && (a == b || *b == Type::Float) => Some(*a),
            (Self::Step, [a, b]) if vector(*b) && (a == b || *a == Type::Float) => Some(*b),
            (Self::Clamp, [a, b, c]) if vector(*a) && b == c && (a == b || *b == Type::Float) => Some(*a),
            (Self::Smoothstep, [a, b, c]) if vector(*c) && a == b && (b == c || *b == Type::Float) => Some(*c),
            (Self::Mix, [a, b, c]) if vector(*a) && a == b && (a == c || *c == Type::Float) => Some(*a),
            (Self::Inverse | Self::Transpose, [a @ (Type::Mat3 | Type::Mat4)]) => Some(*a),
            (
                Self::Normalize
                | Self::Abs
                | Self::Sign
                | Self::Floor
                | Self::Fract
                | Self::Sqrt
                | Self::InverseSqrt
                | Self::Sin
                | Self::Cos
                | Self::Acos
                | Self::Exp
                | Self::Exp2
                | Self::Log
                | Self::Log2,
                [a],
            ) if vector(*a) => Some(*a),
            _ => None,
        }
    }

    /// The value of a function of one argument; `None` only for what [`Builtin::result`] refuses.
    pub(super) fn unary(self, a: &Value) -> Option<Value> {
        match (self, a) {
            (Self::Inverse, Value::Mat3(m)) => Some(Value::Mat3(Box::new(m.inverse()))),
            (Self::Inverse, Value::Mat4(m)) => Some(Value::Mat4(Box::new(m.inverse()))),
            (Self::Transpose, Value::Mat3(m)) => Some(Value::Mat3(Box::new(m.transpose()))),
            (Self::Transpose, Value::Mat4(m)) => Some(Value::Mat4(Box::new(m.transpose()))),
            (Self::Length, _) => Some(Value::Float(dot(a, a)?.sqrt())),
            (Self::Normalize, Value::Vec3(v)) => Some(Value::Vec3(v / v.length())),
            (Self::Normalize, _) => {
                let length = dot(a, a)?.sqrt();
                a.map(|x| x / length)
            }
            (Self::Abs, _) => a.map(f64::abs),
            (Self::Sign, _) => a.map(|x| if x == 0.0 { 0.0 } else { x.signum() }),
            (Self::Floor, _) => a.map(f64::floor),
            (Self::Fract, _) => a.map(|x| x - x.floor()),
            (Self::Sqrt, _) => a.map(f64::sqrt),
            (Self::InverseSqrt, _) => a.map(|x| 1.0 / x.sqrt()),
            (Self::Sin, _) => a.map(f64::sin),
            (Self::Cos, _) => a.map(f64::cos),
            (Self::Acos, _) => a.map(f64::acos),
            (Self::Exp, _) => a.map(f64::exp),
            (Self::Exp2, _) => a.map(f64::exp2),
            (Self::Log, _) => a.map(f64::ln),
            (Self::Log2, _) => a.map(f64::log2),
            _ => None,
        }
    }

    /// That of a function of two arguments.
    pub(super) fn binary(self, a: &Value, b: &Value) -> Option<Value> {
        // The common cases first: a search evaluates them by the hundred thousand.
        match (self, a, b) {
            (Self::Dot, Value::Vec3(v), Value::Vec3(w)) => return Some(Value::Float(v.dot(*w))),
            (Self::Max, Value::Float(x), Value::Float(y)) => return Some(Value::Float(max(*x, *y))),
            (Self::Pow, Value::Float(x), Value::Float(y)) => return Some(Value::Float(pow(*x, *y))),
            _ => {}
        }
        match self {
            Self::Dot => Some(Value::Float(dot(a, b)?)),
            Self::Distance => {
                let d = a.zip(b, |x, y| x - y)?;
                Some(Value::Float(dot(&d, &d)?.sqrt()))
            }
            Self::Cross => Some(Value::Vec3(vec3(a)?.cross(vec3(b)?))),
            Self::Reflect => {
                let twice = 2.0 * dot(b, a)?;
                a.zip(b, |i, n| i - twice * n)
            }
            Self::Max => a.zip(b, max),
            Self::Min => a.zip(b, min),
            Self::Step => a.zip(b, |edge, x| f64::from(u8::from(x >= edge))),
            Self::Pow => a.zip(b, pow),
            _ => None,
        }
    }

    /// That of a function of three arguments.
    pub(super) fn ternary(self, a: &Value, b: &Value, c: &Value) -> Option<Value> {
        match self {
            Self::Clamp => a.zip(b, max)?.zip(c, min),
            Self::Mix => {
                let from = a.zip(&c.map(|t| 1.0 - t)?, |x, t| x * t)?;
                from.zip(&b.zip(c, |y, t| y * t)?, |x, y| x + y)
            }
            Self::Smoothstep => {
                let width = b.zip(a, |hi, lo| hi - lo)?;
                let t = c.zip(a, |x, lo| x - lo)?.zip(&width, |x, w| x / w)?;
                t.map(|t| {
                    let t = t.clamp(0.0, 1.0);
                    t * t * (3.0 - 2.0 * t)
                })
            }
            _ => None,
        }
    }
}

fn dot(a: &Value, b: &Value) -> Option<f64> {
    let ((a, _), (b, _)) = (a.components()?, b.components()?);
    Some(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3])
}

fn vec3(a: &Value) -> Option<DVec3> {
    match a {
        Value::Vec3(v) => Some(*v),
        _ => None,
    }
}

/// GLSL leaves `max` of a NaN open; here what is undefined stays undefined, so that it can be named.
fn max(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

fn min(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) }
}

/// GLSL 4.10, 8.2: undefined if x < 0, and if x = 0 and y <= 0; never the even power that f64 would give.
fn pow(x: f64, y: f64) -> f64 {
    if x < 0.0 || (x == 0.0 && y <= 0.0) { f64::NAN } else { x.powf(y) }
}

/// Upper left 3×3 of a mat4, as `mat3(m)` does.
pub(super) fn upper_left(m: &glam::DMat4) -> DMat3 {
    DMat3::from_cols(m.x_axis.truncate(), m.y_axis.truncate(), m.z_axis.truncate())
}
