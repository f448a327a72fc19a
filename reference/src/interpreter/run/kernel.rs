//! The scalar operations, over columns.

use crate::interpreter::code::{ArithmeticClass, Operation};
use crate::interpreter::run::rounding::{DoublePrecision, Exact, Noisy, Precision, Rounding, SinglePrecision};
use crate::interpreter::run::{bits, undefined};

/// Does one operation for all lanes of the columns, which have one length.
pub fn run(operation: Operation, class: ArithmeticClass, precision: Precision, to: &mut [f64], [a, b, c]: [&[f64]; 3]) {
    match (class, precision) {
        // A driver need not round a large whole number to a float before it is an integer again.
        (ArithmeticClass::Int | ArithmeticClass::Uint, Precision::Noisy(_)) if operation == Operation::Truncate => {
            run(Operation::TruncateDouble, class, Precision::Exact, to, [a, b, c]);
        }
        (ArithmeticClass::Float, Precision::Noisy(_)) if operation == Operation::Narrow => {
            each1(to, a, |a| if a.trunc() == a { a } else { f64::from(a as f32) });
        }
        (ArithmeticClass::Int, _) => integer(operation, to, [a, b, c], |x| f64::from(x as i32)),
        (ArithmeticClass::Uint, _) => integer(operation, to, [a, b, c], |x| f64::from(x as u32)),
        (ArithmeticClass::Double, _) => floating::<DoublePrecision>(operation, to, [a, b, c]),
        (ArithmeticClass::Float, Precision::Exact) => floating::<Exact>(operation, to, [a, b, c]),
        (ArithmeticClass::Float, Precision::Noisy(0)) => floating::<Noisy<0>>(operation, to, [a, b, c]),
        (ArithmeticClass::Float, Precision::Noisy(1)) => floating::<Noisy<1>>(operation, to, [a, b, c]),
        (ArithmeticClass::Float, Precision::Noisy(2)) => floating::<Noisy<2>>(operation, to, [a, b, c]),
        (ArithmeticClass::Float, Precision::Noisy(_)) => floating::<Noisy<3>>(operation, to, [a, b, c]),
        (ArithmeticClass::Float, Precision::Single) => floating::<SinglePrecision>(operation, to, [a, b, c]),
    }
}

/// One operation on three numbers.
#[inline(always)]
pub fn scalar(operation: Operation, class: ArithmeticClass, [a, b, c]: [f64; 3]) -> f64 {
    let mut to = [0.0];
    let of: [&[f64]; 3] = [&[a], &[b], &[c]];
    match class {
        ArithmeticClass::Int => integer(operation, &mut to, of, |x| f64::from(x as i32)),
        ArithmeticClass::Uint => integer(operation, &mut to, of, |x| f64::from(x as u32)),
        ArithmeticClass::Double => floating::<DoublePrecision>(operation, &mut to, of),
        ArithmeticClass::Float => floating::<Exact>(operation, &mut to, of),
    }
    to[0]
}

/// One operation on three numbers, where what GLSL leaves undefined is not a number, and so is what is computed from it.
/// What no float holds stays a number: how large it is tells more than that it is infinite.
#[inline(always)]
pub fn defined(operation: Operation, class: ArithmeticClass, [a, b, c]: [f64; 3]) -> f64 {
    match operation {
        // What is not a number stays that by itself.
        Operation::Add if class == ArithmeticClass::Float => a + b,
        Operation::Subtract if class == ArithmeticClass::Float => a - b,
        Operation::Multiply if class == ArithmeticClass::Float => a * b,
        Operation::Divide if class == ArithmeticClass::Float => a / b,
        Operation::MultiplyAdd if class == ArithmeticClass::Float => a * b + c,
        // The operand that is not chosen, or does not decide, does not count.
        Operation::Select => match a {
            _ if a.is_nan() => a,
            0.0 => c,
            _ => b,
        },
        Operation::And if a == 0.0 => 0.0,
        Operation::Or if a != 0.0 && !a.is_nan() => 1.0,
        _ if a.is_nan() || b.is_nan() || c.is_nan() || undefined::is(operation, class, [a, b, c]) => f64::NAN,
        _ => {
            scalar(operation, if class == ArithmeticClass::Float { ArithmeticClass::Double } else { class }, [a, b, c])
        }
    }
}

#[inline(always)]
fn each1(to: &mut [f64], a: &[f64], f: impl Fn(f64) -> f64) {
    for (to, &a) in to.iter_mut().zip(a) {
        *to = f(a);
    }
}

#[inline(always)]
fn each2(to: &mut [f64], a: &[f64], b: &[f64], f: impl Fn(f64, f64) -> f64) {
    for ((to, &a), &b) in to.iter_mut().zip(a).zip(b) {
        *to = f(a, b);
    }
}

#[inline(always)]
fn each3(to: &mut [f64], [a, b, c]: [&[f64]; 3], f: impl Fn(f64, f64, f64) -> f64) {
    for (((to, &a), &b), &c) in to.iter_mut().zip(a).zip(b).zip(c) {
        *to = f(a, b, c);
    }
}

#[inline(always)]
fn truth(yes: bool) -> f64 {
    if yes { 1.0 } else { 0.0 }
}

/// Operations that mean the same for all classes.
#[inline(always)]
fn common(operation: Operation, to: &mut [f64], [a, b, c]: [&[f64]; 3]) {
    match operation {
        Operation::Less => each2(to, a, b, |a, b| truth(a < b)),
        Operation::LessEqual => each2(to, a, b, |a, b| truth(a <= b)),
        Operation::Equal => each2(to, a, b, |a, b| truth(a == b)),
        Operation::NotEqual => each2(to, a, b, |a, b| truth(a != b)),
        Operation::And => each2(to, a, b, |a, b| truth((a != 0.0) & (b != 0.0))),
        Operation::Or => each2(to, a, b, |a, b| truth((a != 0.0) | (b != 0.0))),
        Operation::Xor => each2(to, a, b, |a, b| truth((a != 0.0) != (b != 0.0))),
        Operation::Not => each1(to, a, |a| truth(a == 0.0)),
        Operation::Select => each3(to, [a, b, c], |a, b, c| if a != 0.0 { b } else { c }),
        // As GLSL words them, which is what they do with a NaN.
        Operation::Minimum => each2(to, a, b, |a, b| if b < a { b } else { a }),
        Operation::Maximum => each2(to, a, b, |a, b| if a < b { b } else { a }),
        Operation::IsNan => each1(to, a, |a| truth(a.is_nan())),
        Operation::IsInf => each1(to, a, |a| truth(a.is_infinite())),
        Operation::Copy | Operation::AtMost | Operation::Below => to.copy_from_slice(a),
        // Every other operation belongs to integers or floats, and has no meaning here.
        _ => to.fill(f64::NAN),
    }
}

#[allow(clippy::too_many_lines, reason = "a table")]
#[inline(always)]
fn floating<R: Rounding>(operation: Operation, to: &mut [f64], [a, b, c]: [&[f64]; 3]) {
    let one = |to: &mut [f64], f: fn(f64) -> f64| each1(to, a, |x| R::round(f(x)));
    match operation {
        Operation::Add => each2(to, a, b, |a, b| R::round(a + b)),
        Operation::Subtract => each2(to, a, b, |a, b| R::round(a - b)),
        Operation::Multiply => each2(to, a, b, |a, b| R::round(a * b)),
        Operation::Divide => each2(to, a, b, |a, b| R::round(a / b)),
        Operation::Reciprocal => each1(to, a, |a| R::round(1.0 / a)),
        Operation::MultiplyAdd => each3(to, [a, b, c], |a, b, c| R::round(R::round(a * b) + c)),
        Operation::Fma => each3(to, [a, b, c], |a, b, c| R::round(a.mul_add(b, c))),
        Operation::Negate => each1(to, a, |a| -a),
        Operation::Abs => each1(to, a, f64::abs),
        Operation::Sign => each1(to, a, |a| truth(a > 0.0) - truth(a < 0.0)),
        Operation::Floor => each1(to, a, f64::floor),
        Operation::Ceil => each1(to, a, f64::ceil),
        Operation::Trunc => each1(to, a, f64::trunc),
        // Of a half GLSL leaves the direction to the driver; all that are known go to the even one.
        Operation::Round | Operation::RoundEven => each1(to, a, f64::round_ties_even),
        Operation::Fract => each1(to, a, |a| R::round(a - a.floor())),
        Operation::Mod => each2(to, a, b, |a, b| R::round(a - b * (R::round(a / b)).floor())),
        Operation::SquareRoot => one(to, f64::sqrt),
        Operation::InverseSquareRoot => one(to, |a| 1.0 / a.sqrt()),
        Operation::Power => each2(to, a, b, |a, b| R::round(a.powf(b))),
        Operation::Exp => one(to, f64::exp),
        Operation::Log => one(to, f64::ln),
        Operation::Exp2 => one(to, f64::exp2),
        Operation::Log2 => one(to, f64::log2),
        Operation::Sin => one(to, |a| R::angle(a).sin()),
        Operation::Cos => one(to, |a| R::angle(a).cos()),
        Operation::Tan => one(to, |a| R::angle(a).tan()),
        Operation::Asin => one(to, f64::asin),
        Operation::Acos => one(to, f64::acos),
        Operation::Atan => one(to, f64::atan),
        Operation::Atan2 => each2(to, a, b, |a, b| R::round(a.atan2(b))),
        Operation::Sinh => one(to, f64::sinh),
        Operation::Cosh => one(to, f64::cosh),
        Operation::Tanh => one(to, f64::tanh),
        Operation::Asinh => one(to, f64::asinh),
        Operation::Acosh => one(to, f64::acosh),
        Operation::Atanh => one(to, f64::atanh),
        Operation::LoadExponent => each2(to, a, b, |a, b| R::round(bits::scaled(a, b))),
        Operation::Significand => each1(to, a, |a| bits::split(a).0),
        Operation::Exponent => each1(to, a, |a| bits::split(a).1),
        Operation::Narrow => each1(to, a, |a| R::given(f64::from(a as f32))),
        Operation::BitsFloat => each1(to, a, |a| R::given(f64::from(f32::from_bits(a as i64 as u32)))),
        Operation::BitsHalf => each1(to, a, |a| bits::of_half(a as i64 as u16)),
        Operation::BitsDouble => {
            each2(to, a, b, |low, high| f64::from_bits(u64::from(low as u32) | u64::from(high as u32) << 32));
        }
        other => common(other, to, [a, b, c]),
    }
}

#[allow(clippy::too_many_lines, reason = "a table")]
#[inline(always)]
fn integer(operation: Operation, to: &mut [f64], [a, b, c]: [&[f64]; 3], wrap: impl Fn(i64) -> f64 + Copy) {
    let one = |to: &mut [f64], f: fn(u32) -> i64| each1(to, a, |x| wrap(f(x as i64 as u32)));
    let two = |to: &mut [f64], f: fn(i64, i64) -> i64| each2(to, a, b, |x, y| wrap(f(x as i64, y as i64)));
    match operation {
        Operation::Add => two(to, i64::wrapping_add),
        Operation::Subtract => two(to, i64::wrapping_sub),
        Operation::Multiply => two(to, i64::wrapping_mul),
        Operation::MultiplyHigh => two(to, |a, b| a.wrapping_mul(b) >> 32),
        Operation::Divide => two(to, |a, b| if b == 0 { -1 } else { a / b }),
        Operation::Remainder => two(to, |a, b| if b == 0 { a } else { a % b }),
        Operation::Negate => each1(to, a, |a| wrap(-(a as i64))),
        Operation::Abs => each1(to, a, |a| wrap((a as i64).abs())),
        Operation::Sign => each1(to, a, |a| wrap((a as i64).signum())),
        Operation::BitAnd => two(to, |a, b| a & b),
        Operation::BitOr => two(to, |a, b| a | b),
        Operation::BitXor => two(to, |a, b| a ^ b),
        Operation::BitNot => each1(to, a, |a| wrap(!(a as i64))),
        // Drivers take the lower five bits of a distance that GLSL leaves undefined.
        Operation::ShiftLeft => two(to, |a, b| a << (b & 31)),
        Operation::ShiftRight => two(to, |a, b| a >> (b & 31)),
        Operation::BitfieldExtract => {
            let signed = wrap(-1) < 0.0;
            each3(to, [a, b, c], |a, b, c| wrap(bits::field(a, b, c, signed)));
        }
        Operation::BitfieldMask => two(to, |a, b| ((1_i64 << b.clamp(0, 32)) - 1) << a.clamp(0, 31)),
        Operation::BitfieldReverse => one(to, |a| i64::from(a.reverse_bits())),
        Operation::BitCount => one(to, |a| i64::from(a.count_ones())),
        Operation::FindLowest => one(to, |a| if a == 0 { -1 } else { i64::from(a.trailing_zeros()) }),
        // Of a negative number, the highest bit that is 0.
        Operation::FindHighest => each1(to, a, |a| {
            let pattern = if a < 0.0 { !(a as i64 as u32) } else { a as i64 as u32 };
            wrap(31 - i64::from(pattern.leading_zeros()))
        }),
        // A value that the float of 32 bits would round to a whole number is that number.
        Operation::Truncate => each1(to, a, |a| wrap(f64::from(a as f32).trunc() as i64)),
        Operation::TruncateDouble => each1(to, a, |a| wrap(a.trunc() as i64)),
        Operation::Reinterpret => each1(to, a, |a| wrap(a as i64)),
        Operation::FloatBits => each1(to, a, |a| wrap(i64::from((a as f32).to_bits()))),
        Operation::HalfBits => each1(to, a, |a| wrap(i64::from(bits::half(a as f32)))),
        Operation::DoubleLow => each1(to, a, |a| wrap((a.to_bits() & 0xFFFF_FFFF).cast_signed())),
        Operation::DoubleHigh => each1(to, a, |a| wrap((a.to_bits() >> 32).cast_signed())),
        other => common(other, to, [a, b, c]),
    }
}
