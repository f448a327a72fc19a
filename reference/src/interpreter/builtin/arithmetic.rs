//! Functions that work component by component (GLSL 4.60, sections 8.1 to 8.3).

use crate::interpreter::code::{ArithmeticClass, Operation, Slot};
use crate::interpreter::compile::CodeBuilder;
use std::f64::consts::PI;

/// Writes the function; `None` where it is not one of these.
pub fn write(builder: &mut CodeBuilder, name: &str, class: ArithmeticClass, of: &[&[Slot]]) -> Option<Vec<Vec<Slot>>> {
    let operation = match (name, of.len()) {
        ("sin", 1) => Operation::Sin,
        ("cos", 1) => Operation::Cos,
        ("tan", 1) => Operation::Tan,
        ("asin", 1) => Operation::Asin,
        ("acos", 1) => Operation::Acos,
        ("atan", 1) => Operation::Atan,
        ("atan", 2) => Operation::Atan2,
        ("sinh", 1) => Operation::Sinh,
        ("cosh", 1) => Operation::Cosh,
        ("tanh", 1) => Operation::Tanh,
        ("asinh", 1) => Operation::Asinh,
        ("acosh", 1) => Operation::Acosh,
        ("atanh", 1) => Operation::Atanh,
        ("pow", 2) => Operation::Power,
        ("exp", 1) => Operation::Exp,
        ("log", 1) => Operation::Log,
        ("exp2", 1) => Operation::Exp2,
        ("log2", 1) => Operation::Log2,
        ("sqrt", 1) => Operation::SquareRoot,
        ("inversesqrt", 1) => Operation::InverseSquareRoot,
        ("abs", 1) => Operation::Abs,
        ("sign", 1) => Operation::Sign,
        ("floor", 1) => Operation::Floor,
        ("trunc", 1) => Operation::Trunc,
        ("round", 1) => Operation::Round,
        ("roundEven", 1) => Operation::RoundEven,
        ("ceil", 1) => Operation::Ceil,
        ("fract", 1) => Operation::Fract,
        ("mod", 2) => Operation::Mod,
        ("min", 2) => Operation::Minimum,
        ("max", 2) => Operation::Maximum,
        ("isnan", 1) => Operation::IsNan,
        ("isinf", 1) => Operation::IsInf,
        ("fma", 3) => Operation::Fma,
        ("ldexp", 2) => Operation::LoadExponent,
        ("matrixCompMult", 2) => Operation::Multiply,
        _ => return composed(builder, name, class, of),
    };
    Some(vec![match *of {
        [a] => builder.each1(operation, class, a),
        [a, b] => builder.each2(operation, class, a, b),
        [a, b, c] => builder.each3(operation, class, [a, b, c]),
        _ => return None,
    }])
}

/// Functions of more than one instruction.
fn composed(builder: &mut CodeBuilder, name: &str, class: ArithmeticClass, of: &[&[Slot]]) -> Option<Vec<Vec<Slot>>> {
    let result = match (name, of) {
        ("radians", [a]) => {
            let factor = builder.number(class, PI / 180.0);
            builder.each2(Operation::Multiply, class, a, &[factor])
        }
        ("degrees", [a]) => {
            let factor = builder.number(class, 180.0 / PI);
            builder.each2(Operation::Multiply, class, a, &[factor])
        }
        ("clamp", [a, low, high]) => {
            let low = builder.each2(Operation::AtMost, class, low, high);
            let raised = builder.each2(Operation::Maximum, class, a, &low);
            builder.each2(Operation::Minimum, class, &raised, high)
        }
        ("mix", [a, b, share]) => mix(builder, class, [a, b, share]),
        // 1 where the edge is not above.
        ("step", [edge, a]) => builder.each2(Operation::LessEqual, class, edge, a),
        ("smoothstep", [low, high, a]) => smoothstep(builder, class, [low, high, a]),
        ("modf", [a]) => {
            let whole = builder.each1(Operation::Trunc, class, a);
            let rest = builder.each2(Operation::Subtract, class, a, &whole);
            return Some(vec![rest, whole]);
        }
        ("frexp", [a]) => {
            let significand = builder.each1(Operation::Significand, class, a);
            return Some(vec![significand, builder.each1(Operation::Exponent, class, a)]);
        }
        _ => return None,
    };
    Some(vec![result])
}

fn mix(builder: &mut CodeBuilder, class: ArithmeticClass, [a, b, share]: [&[Slot]; 3]) -> Vec<Slot> {
    let one = builder.number(class, 1.0);
    let rest = builder.each2(Operation::Subtract, class, &[one], share);
    let first = builder.each2(Operation::Multiply, class, a, &rest);
    builder.each3(Operation::MultiplyAdd, class, [b, share, &first])
}

/// `t² (3 − 2t)` for `t = clamp((a − low) / (high − low), 0, 1)`.
fn smoothstep(builder: &mut CodeBuilder, class: ArithmeticClass, [low, high, a]: [&[Slot]; 3]) -> Vec<Slot> {
    let [zero, one, two, three] = [0.0, 1.0, 2.0, 3.0].map(|value| builder.number(class, value));
    let low = builder.each2(Operation::Below, class, low, high);
    let above = builder.each2(Operation::Subtract, class, a, &low);
    let span = builder.each2(Operation::Subtract, class, high, &low);
    let t = builder.each2(Operation::Divide, class, &above, &span);
    let t = builder.each2(Operation::Maximum, class, &t, &[zero]);
    let t = builder.each2(Operation::Minimum, class, &t, &[one]);
    let twice = builder.each2(Operation::Multiply, class, &[two], &t);
    let rest = builder.each2(Operation::Subtract, class, &[three], &twice);
    let square = builder.each2(Operation::Multiply, class, &t, &t);
    builder.each2(Operation::Multiply, class, &square, &rest)
}
