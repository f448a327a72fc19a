//! Integers, bits, comparisons of vectors and derivatives (GLSL 4.60, sections 8.3, 8.4, 8.7, 8.8, 8.14).

use super::BuiltinCall;
use crate::interpreter::Stage;
use crate::interpreter::code::{ArithmeticClass, DerivativeAxis, Node, Operation, Slot};
use crate::interpreter::compile::{CodeBuilder, class};
use crate::interpreter::types::Scalar;

/// Writes the function; `None` where it is not one of these.
pub fn write(builder: &mut CodeBuilder, name: &str, scalar: Scalar, of: &[&[Slot]]) -> Option<Vec<Vec<Slot>>> {
    relation(builder, name, class(scalar), of)
        .or_else(|| carry(builder, name, of))
        .or_else(|| field(builder, name, scalar, of).or_else(|| packing(builder, name, of)).map(|result| vec![result]))
}

fn relation(builder: &mut CodeBuilder, name: &str, class: ArithmeticClass, of: &[&[Slot]]) -> Option<Vec<Vec<Slot>>> {
    let result = match (name, of) {
        ("lessThan", [a, b]) => builder.each2(Operation::Less, class, a, b),
        ("lessThanEqual", [a, b]) => builder.each2(Operation::LessEqual, class, a, b),
        ("greaterThan", [a, b]) => builder.each2(Operation::Less, class, b, a),
        ("greaterThanEqual", [a, b]) => builder.each2(Operation::LessEqual, class, b, a),
        ("equal", [a, b]) => builder.each2(Operation::Equal, class, a, b),
        ("notEqual", [a, b]) => builder.each2(Operation::NotEqual, class, a, b),
        ("not", [a]) => builder.each1(Operation::Not, class, a),
        ("any" | "all", [a]) => {
            let operation = if name == "any" { Operation::Or } else { Operation::And };
            let joined = a.iter().copied().reduce(|before, one| builder.emit(operation, class, &[before, one]));
            vec![joined?]
        }
        _ => return None,
    };
    Some(vec![result])
}

/// Functions with a second half of the result.
fn carry(builder: &mut CodeBuilder, name: &str, of: &[&[Slot]]) -> Option<Vec<Vec<Slot>>> {
    let [a, b] = of else { return None };
    let (unsigned, signed) = (ArithmeticClass::Uint, ArithmeticClass::Int);
    match name {
        "uaddCarry" => {
            let sum = builder.each2(Operation::Add, unsigned, a, b);
            // A sum that came round is less than either operand; a truth value is 0 or 1.
            let carry = builder.each2(Operation::Less, unsigned, &sum, a);
            Some(vec![sum, carry])
        }
        "usubBorrow" => {
            let difference = builder.each2(Operation::Subtract, unsigned, a, b);
            Some(vec![difference, builder.each2(Operation::Less, unsigned, a, b)])
        }
        "umulExtended" | "imulExtended" => {
            let class = if name == "umulExtended" { unsigned } else { signed };
            let high = builder.each2(Operation::MultiplyHigh, class, a, b);
            Some(vec![Vec::new(), high, builder.each2(Operation::Multiply, class, a, b)])
        }
        _ => None,
    }
}

fn field(builder: &mut CodeBuilder, name: &str, scalar: Scalar, of: &[&[Slot]]) -> Option<Vec<Slot>> {
    let class = class(scalar);
    Some(match (name, of) {
        ("bitfieldExtract", [a, offset, count]) => builder.each3(Operation::BitfieldExtract, class, [a, offset, count]),
        ("bitfieldInsert", [base, insert, offset, count]) => {
            let mask = builder.each2(Operation::BitfieldMask, class, offset, count);
            let outside = builder.each1(Operation::BitNot, class, &mask);
            let kept = builder.each2(Operation::BitAnd, class, base, &outside);
            // A distance of 32 goes with a mask of nothing.
            let limit = builder.whole(31.0);
            let distance = builder.each2(Operation::Minimum, class, offset, &[limit]);
            let moved = builder.each2(Operation::ShiftLeft, class, insert, &distance);
            let moved = builder.each2(Operation::BitAnd, class, &moved, &mask);
            builder.each2(Operation::BitOr, class, &kept, &moved)
        }
        ("bitfieldReverse", [a]) => builder.each1(Operation::BitfieldReverse, class, a),
        ("bitCount", [a]) => builder.each1(Operation::BitCount, class, a),
        ("findLSB", [a]) => builder.each1(Operation::FindLowest, ArithmeticClass::Int, a),
        ("findMSB", [a]) => builder.each1(Operation::FindHighest, ArithmeticClass::Int, a),
        ("floatBitsToInt", [a]) => builder.each1(Operation::FloatBits, ArithmeticClass::Int, a),
        ("floatBitsToUint", [a]) => builder.each1(Operation::FloatBits, ArithmeticClass::Uint, a),
        ("intBitsToFloat" | "uintBitsToFloat", [a]) => builder.each1(Operation::BitsFloat, ArithmeticClass::Float, a),
        _ => return None,
    })
}

/// The fixed-point formats: bits, the largest whole number, and whether there is a sign.
fn format(name: &str) -> Option<(u32, f64, bool)> {
    Some(match name {
        "Unorm2x16" => (16, 65_535.0, false),
        "Snorm2x16" => (16, 32_767.0, true),
        "Unorm4x8" => (8, 255.0, false),
        "Snorm4x8" => (8, 127.0, true),
        _ => return None,
    })
}

fn packing(builder: &mut CodeBuilder, name: &str, of: &[&[Slot]]) -> Option<Vec<Slot>> {
    match (name, of) {
        ("packHalf2x16", [a]) => {
            let halves = builder.each1(Operation::HalfBits, ArithmeticClass::Uint, a);
            Some(vec![joined(builder, &halves, 16)])
        }
        ("unpackHalf2x16", [a]) => {
            let halves = parts(builder, ArithmeticClass::Uint, a[0], 16);
            Some(builder.each1(Operation::BitsHalf, ArithmeticClass::Float, &halves))
        }
        ("packDouble2x32", [a]) => {
            Some(vec![builder.emit(Operation::BitsDouble, ArithmeticClass::Double, &[a[0], a[1]])])
        }
        ("unpackDouble2x32", [a]) => Some(vec![
            builder.emit(Operation::DoubleLow, ArithmeticClass::Uint, &[a[0]]),
            builder.emit(Operation::DoubleHigh, ArithmeticClass::Uint, &[a[0]]),
        ]),
        (_, [a]) => match name.strip_prefix("pack") {
            Some(name) => packed(builder, format(name)?, a),
            None => unpacked(builder, format(name.strip_prefix("unpack")?)?, a[0]),
        },
        _ => None,
    }
}

fn packed(builder: &mut CodeBuilder, (bits, most, signed): (u32, f64, bool), a: &[Slot]) -> Option<Vec<Slot>> {
    let float = ArithmeticClass::Float;
    let [least, one, most] = [if signed { -1.0 } else { 0.0 }, 1.0, most].map(|value| builder.float(value));
    let a = builder.each2(Operation::Maximum, float, a, &[least]);
    let a = builder.each2(Operation::Minimum, float, &a, &[one]);
    let a = builder.each2(Operation::Multiply, float, &a, &[most]);
    let a = builder.each1(Operation::RoundEven, float, &a);
    let a = builder.each1(Operation::Truncate, ArithmeticClass::Int, &a);
    let a = builder.each1(Operation::Reinterpret, ArithmeticClass::Uint, &a);
    let mask = builder.whole(f64::from((1_u32 << bits) - 1));
    let a = builder.each2(Operation::BitAnd, ArithmeticClass::Uint, &a, &[mask]);
    Some(vec![joined(builder, &a, bits)])
}

fn unpacked(builder: &mut CodeBuilder, (bits, most, signed): (u32, f64, bool), a: Slot) -> Option<Vec<Slot>> {
    let float = ArithmeticClass::Float;
    let class = if signed { ArithmeticClass::Int } else { ArithmeticClass::Uint };
    let whole = parts(builder, class, a, bits);
    let [most, least] = [most, -1.0].map(|value| builder.float(value));
    let a = builder.each2(Operation::Divide, float, &whole, &[most]);
    // The least whole number of a signed format is a little less than −1.
    Some(if signed { builder.each2(Operation::Maximum, float, &a, &[least]) } else { a })
}

/// Fields of so many bits in one word, the first one lowest.
fn joined(builder: &mut CodeBuilder, fields: &[Slot], bits: u32) -> Slot {
    let mut word = fields[0];
    for (index, &field) in fields.iter().enumerate().skip(1) {
        let distance = builder.whole(index as f64 * f64::from(bits));
        let moved = builder.emit(Operation::ShiftLeft, ArithmeticClass::Uint, &[field, distance]);
        word = builder.emit(Operation::BitOr, ArithmeticClass::Uint, &[word, moved]);
    }
    word
}

/// The fields of a word, with their signs where the class has one.
fn parts(builder: &mut CodeBuilder, class: ArithmeticClass, word: Slot, bits: u32) -> Vec<Slot> {
    let part = |index: u32| {
        let (offset, count) = (builder.whole(f64::from(index * bits)), builder.whole(f64::from(bits)));
        builder.emit(Operation::BitfieldExtract, class, &[word, offset, count])
    };
    (0..32 / bits).map(part).collect()
}

impl BuiltinCall<'_> {
    /// Derivatives; `None` where it is not one of these, or not in a fragment stage.
    pub(super) fn derivative(&self, builder: &mut CodeBuilder, of: &[&[Slot]]) -> Option<Vec<Vec<Slot>>> {
        let [a] = of else { return None };
        if self.stage != Stage::Fragment {
            return None;
        }
        let coarse = self.name.ends_with("Coarse");
        let name = self.name.trim_end_matches("Coarse").trim_end_matches("Fine");
        let along = |builder: &mut CodeBuilder, direction: DerivativeAxis| -> Vec<Slot> {
            let one = |&of: &Slot| {
                let (to, line) = (builder.temporary(), builder.line);
                builder.push(Node::Derivative { to, of, direction, coarse, line });
                to
            };
            a.iter().map(one).collect()
        };
        let result = match name {
            "dFdx" => along(builder, DerivativeAxis::X),
            "dFdy" => along(builder, DerivativeAxis::Y),
            "fwidth" => {
                let [x, y] = [DerivativeAxis::X, DerivativeAxis::Y].map(|direction| along(builder, direction));
                let x = builder.each1(Operation::Abs, ArithmeticClass::Float, &x);
                let y = builder.each1(Operation::Abs, ArithmeticClass::Float, &y);
                builder.each2(Operation::Add, ArithmeticClass::Float, &x, &y)
            }
            _ => return None,
        };
        Some(vec![result])
    }
}
