//! A small, exact subset of GLSL expressions: parsed and typed once, evaluated in f64.
//!
//! An equation written as data stays readable for whoever knows the shading language, and the same text is valid in a
//! shader. Type errors are found when the text is parsed, with their place.

mod builtin;
mod parse;
mod value;

use builtin::{Builtin, upper_left};
pub use value::{Type, Value};

use glam::{DMat3, DMat4, DVec3, DVec4};
use std::fmt;

/// Why a text is not an expression of this subset.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpressionError {
    /// Column in the text, from 1, in characters.
    pub column: usize,
    /// What is wrong there.
    pub message: String,
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "column {}: {}", self.column, self.message)
    }
}

impl std::error::Error for ExpressionError {}

/// The names that an expression may use, each with its type; a name's slot is its place in the list.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    names: Vec<(String, Type)>,
}

impl Scope {
    /// Adds a name and returns its slot; `None` if the name is taken or means something in GLSL already.
    pub fn declare(&mut self, name: &str, kind: Type) -> Option<usize> {
        let taken = self.slot(name).is_some() || Builtin::named(name).is_some() || Type::from_glsl(name).is_some();
        if taken || !parse::is_identifier(name) {
            return None;
        }
        self.names.push((name.to_owned(), kind));
        Some(self.names.len() - 1)
    }

    /// The slot of a name.
    pub fn slot(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|(n, _)| n == name)
    }

    /// Name and type in a slot.
    pub fn get(&self, slot: usize) -> Option<(&str, Type)> {
        self.names.get(slot).map(|(n, t)| (n.as_str(), *t))
    }
}

/// A parsed expression, see the module.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    kind: Type,
    root: Node,
    slots: Vec<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Comparison {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

#[derive(Clone, Debug)]
enum Node {
    Literal(f64),
    Variable(usize),
    Negate(Box<Node>),
    Binary(Operator, Box<Node>, Box<Node>),
    Compare(Comparison, Box<Node>, Box<Node>),
    Choose(Box<Node>, Box<Node>, Box<Node>),
    Call(Builtin, Vec<Node>),
    Construct(Type, Vec<Node>),
    Swizzle(Box<Node>, [u8; 4], usize),
}

impl Expression {
    /// Parses `text` with the names of `scope`.
    pub fn parse(text: &str, scope: &Scope) -> Result<Self, ExpressionError> {
        let (root, kind, mut slots) = parse::parse(text, scope)?;
        slots.sort_unstable();
        slots.dedup();
        Ok(Self { text: text.to_owned(), kind, root, slots })
    }

    /// The expression as it was written: valid GLSL.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The type of its value.
    pub const fn kind(&self) -> Type {
        self.kind
    }

    /// The slots of the names that it uses, ascending.
    pub fn slots(&self) -> &[usize] {
        &self.slots
    }

    /// The expression's value, where `lookup` gives the value in a slot, of the type that the scope declares for it.
    ///
    /// What GLSL leaves undefined is NaN.
    pub fn evaluate(&self, lookup: &impl Fn(usize) -> Value) -> Value {
        self.root.evaluate(lookup)
    }
}

impl Node {
    fn evaluate(&self, lookup: &impl Fn(usize) -> Value) -> Value {
        match self {
            Self::Literal(x) => Value::Float(*x),
            Self::Variable(slot) => lookup(*slot),
            Self::Negate(a) => a.evaluate(lookup).negated(),
            Self::Binary(operator, a, b) => operator.apply(a.evaluate(lookup), b.evaluate(lookup)),
            Self::Compare(comparison, a, b) => {
                Value::Bool(comparison.holds(a.evaluate(lookup).float(), b.evaluate(lookup).float()))
            }
            Self::Choose(condition, yes, no) => match condition.evaluate(lookup) {
                Value::Bool(true) => yes.evaluate(lookup),
                _ => no.evaluate(lookup),
            },
            Self::Call(function, arguments) => {
                let value = match arguments.as_slice() {
                    [a] => function.unary(&a.evaluate(lookup)),
                    [a, b] => function.binary(&a.evaluate(lookup), &b.evaluate(lookup)),
                    [a, b, c] => function.ternary(&a.evaluate(lookup), &b.evaluate(lookup), &c.evaluate(lookup)),
                    _ => None,
                };
                value.unwrap_or(Value::Float(f64::NAN))
            }
            Self::Construct(kind, arguments) => construct(*kind, arguments, lookup),
            Self::Swizzle(a, places, width) => {
                let c = a.evaluate(lookup).vec4().to_array();
                let mut out = [0.0; 4];
                for (slot, place) in out.iter_mut().zip(places) {
                    *slot = c[usize::from(*place)];
                }
                Value::from_components(out, *width)
            }
        }
    }
}

impl Value {
    fn negated(self) -> Self {
        match self {
            Self::Mat3(m) => Self::Mat3(Box::new(-*m)),
            Self::Mat4(m) => Self::Mat4(Box::new(-*m)),
            other => other.map(|x| -x).unwrap_or(Self::Float(f64::NAN)),
        }
    }
}

impl Comparison {
    fn holds(self, a: f64, b: f64) -> bool {
        match self {
            Self::Less => a < b,
            Self::LessOrEqual => a <= b,
            Self::Greater => a > b,
            Self::GreaterOrEqual => a >= b,
        }
    }
}

impl Operator {
    /// GLSL 4.10, 5.9: component by component, except that `*` with a matrix is the linear-algebra product.
    fn apply(self, a: Value, b: Value) -> Value {
        use Value::{Float, Vec3, Vec4};
        match (self, &a, &b) {
            // The common cases by name: a search evaluates them by the hundred thousand.
            (Self::Add, Float(x), Float(y)) => Float(x + y),
            (Self::Subtract, Float(x), Float(y)) => Float(x - y),
            (Self::Multiply, Float(x), Float(y)) => Float(x * y),
            (Self::Divide, Float(x), Float(y)) => Float(x / y),
            (Self::Add, Vec3(v), Vec3(w)) => Vec3(v + w),
            (Self::Subtract, Vec3(v), Vec3(w)) => Vec3(v - w),
            (Self::Multiply, Vec3(v), Float(x)) | (Self::Multiply, Float(x), Vec3(v)) => Vec3(v * x),
            (Self::Divide, Vec3(v), Float(x)) => Vec3(v / x),
            (Self::Add, Vec4(v), Vec4(w)) => Vec4(v + w),
            (Self::Multiply, Vec4(v), Vec4(w)) => Vec4(v * w),
            (Self::Multiply, Vec4(v), Float(x)) | (Self::Multiply, Float(x), Vec4(v)) => Vec4(v * x),
            (Self::Add, a, b) => a.zip(b, |x, y| x + y).unwrap_or(Float(f64::NAN)),
            (Self::Subtract, a, b) => a.zip(b, |x, y| x - y).unwrap_or(Float(f64::NAN)),
            (Self::Divide, a, b) => a.zip(b, |x, y| x / y).unwrap_or(Float(f64::NAN)),
            (Self::Multiply, a, b) => {
                a.zip(b, |x, y| x * y).or_else(|| matrix_product(a, b)).unwrap_or(Float(f64::NAN))
            }
        }
    }

    /// The type of the result; `None` where GLSL (or this subset) has no such operation.
    fn result(self, a: Type, b: Type) -> Option<Type> {
        match (self, a, b) {
            (_, a, b) if a == b && a.width().is_some() => Some(a),
            (_, Type::Float, v) | (_, v, Type::Float) if v.width().is_some() => Some(v),
            (Self::Multiply, Type::Mat4, Type::Vec4) | (Self::Multiply, Type::Vec4, Type::Mat4) => Some(Type::Vec4),
            (Self::Multiply, Type::Mat3, Type::Vec3) | (Self::Multiply, Type::Vec3, Type::Mat3) => Some(Type::Vec3),
            (Self::Multiply, a @ (Type::Mat3 | Type::Mat4), b) if a == b || b == Type::Float => Some(a),
            (Self::Multiply, Type::Float, b @ (Type::Mat3 | Type::Mat4)) => Some(b),
            _ => None,
        }
    }
}

/// A product in which a matrix takes part.
fn matrix_product(a: &Value, b: &Value) -> Option<Value> {
    use Value::{Float, Mat3, Mat4, Vec3, Vec4};
    Some(match (a, b) {
        (Mat4(m), Vec4(v)) => Vec4(**m * *v),
        (Vec4(v), Mat4(m)) => Vec4(m.transpose() * *v),
        (Mat4(m), Mat4(n)) => Mat4(Box::new(**m * **n)),
        (Mat3(m), Vec3(v)) => Vec3(**m * *v),
        (Vec3(v), Mat3(m)) => Vec3(m.transpose() * *v),
        (Mat3(m), Mat3(n)) => Mat3(Box::new(**m * **n)),
        (Mat4(m), Float(x)) | (Float(x), Mat4(m)) => Mat4(Box::new(**m * *x)),
        (Mat3(m), Float(x)) | (Float(x), Mat3(m)) => Mat3(Box::new(**m * *x)),
        _ => return None,
    })
}

/// A constructor call: one matrix, one `float` for all components, or parts that fill the vector from the left.
fn construct(kind: Type, arguments: &[Node], lookup: &impl Fn(usize) -> Value) -> Value {
    let mut c = [0.0; 4];
    let mut filled = 0;
    for argument in arguments {
        match (argument.evaluate(lookup), kind) {
            (Value::Mat4(m), Type::Mat3) => return Value::Mat3(Box::new(upper_left(&m))),
            (Value::Mat3(m), Type::Mat4) => return Value::Mat4(Box::new(DMat4::from_mat3(*m))),
            (m @ (Value::Mat3(_) | Value::Mat4(_)), _) => return m,
            (Value::Float(x), Type::Mat3) => {
                return Value::Mat3(Box::new(DMat3::from_diagonal(DVec3::splat(x))));
            }
            (Value::Float(x), Type::Mat4) => {
                return Value::Mat4(Box::new(DMat4::from_diagonal(DVec4::splat(x))));
            }
            (part, _) => {
                let (values, width) = part.components().unwrap_or(([f64::NAN; 4], 4));
                for value in &values[..width] {
                    if let Some(slot) = c.get_mut(filled) {
                        *slot = *value;
                    }
                    filled += 1;
                }
            }
        }
    }
    if filled == 1 {
        c = [c[0]; 4];
    }
    Value::from_components(c, kind.width().unwrap_or(4))
}

#[cfg(test)]
mod tests;
