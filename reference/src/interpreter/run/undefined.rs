//! Where GLSL leaves the result of an operation open.

use crate::interpreter::code::{ArithmeticClass, Operation};

/// Why a value may be anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Undefined {
    /// A variable is read before it has a value.
    Uninitialised,
    /// An output has no value at the end.
    Unwritten,
    /// A function ends without `return`.
    NoResult,
    /// An index is out of range.
    Index,
    /// `pow` of a negative base, or 0 to a power that is not positive.
    Power,
    /// A function outside of its domain, as the root of a negative number.
    Domain,
    /// A division by zero, or of the least integer by −1. Of floats as well: “treatment of conditions such as divide by 0
    /// may lead to an unspecified result” (GLSL 4.10, section 4.1.4), and drivers have lost the sign of the infinity.
    Division,
    /// `%` of a negative integer.
    Remainder,
    /// A shift by less than 0 or more than 31 bits.
    Shift,
    /// A field of bits that is not within 32.
    Bitfield,
    /// A number that the integer type cannot hold.
    Conversion,
    /// A value that is not a number, which drivers need not keep.
    NotANumber,
    /// `round` of a number in the middle between two whole ones.
    Half,
    /// `smoothstep` and `clamp` with bounds in the wrong order.
    Bounds,
    /// A derivative where not all four pixels run.
    Derivative,
    /// A texture that the host has not bound, or a lookup that it does not allow.
    Texture,
}

impl Undefined {
    /// What it is and how to avoid it, in English and Japanese.
    pub fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Uninitialised => ("a variable is read before it has a value", "値を入れる前の変数を読んでいます"),
            Self::Unwritten => ("an output is never given a value", "出力変数に値を代入していません"),
            Self::NoResult => ("a function ends without `return`", "関数が `return` なしで終わっています"),
            Self::Index => ("an index is out of range", "添字が範囲の外にあります"),
            Self::Power => (
                "GLSL gives `pow` no value where the base is negative, even for a square, or where it is 0 and the exponent is not positive. \
             For a square write `x * x`",
                "GLSL の `pow` は、底が負のとき (2 乗でも)、また底が 0 で指数が正でないときは値が決まりません。2 乗は `x * x` と書いてください",
            ),
            Self::Domain => (
                "a function has no value there: the root of a negative number, the logarithm of what is not positive, `asin` and `acos` \
             beyond 1, `normalize` of nothing",
                "関数の値が決まらない引数です (負の数の平方根、正でない数の対数、1 を超える `asin` や `acos`、長さ 0 の `normalize`)",
            ),
            Self::Division => ("a division by 0", "0 で割っています"),
            Self::Remainder => ("`%` of a negative whole number", "負の整数に `%` を使っています"),
            Self::Shift => {
                ("a shift by less than 0 or more than 31 bits", "0 より小さいか 31 を超えるビット数のシフトです")
            }
            Self::Bitfield => ("a field of bits that is not within 32", "32 ビットに収まらないビットフィールドです"),
            Self::Conversion => {
                ("a number that the type of whole numbers cannot hold", "整数の型に収まらない数を変換しています")
            }
            Self::NotANumber => ("a value that is no number", "数でない値 (NaN) です"),
            Self::Half => (
                "`round` of a number in the middle between two whole ones",
                "2 つの整数のちょうど中間の数に `round` を使っています",
            ),
            Self::Bounds => (
                "the first edge of `smoothstep`, or the first bound of `clamp`, is not the smaller one",
                "`smoothstep` や `clamp` の 1 つ目の端が、2 つ目より小さくありません",
            ),
            Self::Derivative => {
                ("a derivative where not all four pixels run", "4 画素がそろわないところで微分を求めています")
            }
            Self::Texture => ("a lookup that OpenGL leaves open", "OpenGL で結果の決まらないテクスチャ参照です"),
        }
    }
}

/// Whether the operation's result is undefined for these operands.
#[inline(always)]
pub fn is(operation: Operation, class: ArithmeticClass, operands: [f64; 3]) -> bool {
    table(operation, class, SingleOperands(operands))
}

/// In which lanes the operation's result is undefined, and why; `None` where it is defined in all of them.
pub fn lanes(operation: Operation, class: ArithmeticClass, operands: [&[f64]; 3]) -> Option<(Undefined, Vec<bool>)> {
    table(operation, class, LaneOperands(operands))
}

/// What is asked where an operation may be undefined.
trait Ask {
    type Answer;
    /// The operation is always defined.
    const NONE: Self::Answer;
    fn found(self, why: Undefined, is_undefined: impl Fn(f64, f64, f64) -> bool) -> Self::Answer;
}

struct SingleOperands([f64; 3]);
struct LaneOperands<'a>([&'a [f64]; 3]);

impl Ask for SingleOperands {
    type Answer = bool;
    const NONE: bool = false;

    #[inline(always)]
    fn found(self, _: Undefined, is_undefined: impl Fn(f64, f64, f64) -> bool) -> bool {
        let [a, b, c] = self.0;
        is_undefined(a, b, c)
    }
}

impl Ask for LaneOperands<'_> {
    type Answer = Option<(Undefined, Vec<bool>)>;
    const NONE: Self::Answer = None;

    /// Asks all lanes at once first: hardly ever is there one.
    #[inline(always)]
    fn found(self, why: Undefined, is_undefined: impl Fn(f64, f64, f64) -> bool) -> Self::Answer {
        let [a, b, c] = self.0;
        let each = || a.iter().zip(b).zip(c).map(|((&a, &b), &c)| is_undefined(a, b, c));
        each().fold(false, |any, one| any | one).then(|| (why, each().collect()))
    }
}

/// When which operation is undefined.
#[inline(always)]
fn table<A: Ask>(operation: Operation, class: ArithmeticClass, ask: A) -> A::Answer {
    let floating = matches!(class, ArithmeticClass::Float | ArithmeticClass::Double);
    match operation {
        Operation::Less | Operation::LessEqual | Operation::Equal | Operation::NotEqual if floating => {
            ask.found(Undefined::NotANumber, |a, b, _| a.is_nan() | b.is_nan())
        }
        Operation::Minimum | Operation::Maximum if floating => {
            ask.found(Undefined::NotANumber, |a, b, _| a.is_nan() | b.is_nan())
        }
        Operation::Divide | Operation::Mod if floating => ask.found(Undefined::Division, |_, b, _| b == 0.0),
        Operation::Sign | Operation::IsNan if floating => ask.found(Undefined::NotANumber, |a, _, _| a.is_nan()),
        Operation::AtMost => ask.found(Undefined::Bounds, |a, b, _| a > b),
        Operation::Below => ask.found(Undefined::Bounds, |a, b, _| a >= b),
        Operation::Reciprocal => ask.found(Undefined::Domain, |a, _, _| a == 0.0),
        Operation::Power => ask.found(Undefined::Power, |a, b, _| {
            // It is `exp2(b * log2(a))`, which has no value for 1 and infinity, nor for infinity and 0.
            (a < 0.0) | ((a == 0.0) & (b <= 0.0)) | !a.is_finite() | !b.is_finite()
        }),
        Operation::SquareRoot => ask.found(Undefined::Domain, |a, _, _| a < 0.0),
        Operation::InverseSquareRoot | Operation::Log | Operation::Log2 => {
            ask.found(Undefined::Domain, |a, _, _| a <= 0.0)
        }
        Operation::Asin | Operation::Acos => ask.found(Undefined::Domain, |a, _, _| a.abs() > 1.0),
        Operation::Acosh => ask.found(Undefined::Domain, |a, _, _| a < 1.0),
        Operation::Atanh => ask.found(Undefined::Domain, |a, _, _| a.abs() >= 1.0),
        Operation::Atan2 => ask.found(Undefined::Domain, |a, b, _| (a == 0.0) & (b == 0.0)),
        Operation::Round => ask.found(Undefined::Half, |a, _, _| (a - a.trunc()).abs() == 0.5),
        Operation::LoadExponent => ask.found(Undefined::Domain, |_, b, _| b > 128.0),
        Operation::Significand | Operation::Exponent => ask.found(Undefined::Domain, |a, _, _| !a.is_finite()),
        Operation::Truncate | Operation::TruncateDouble if class == ArithmeticClass::Int => {
            // 2^31 is the first that does not fit; anything above −2^31 − 1 is cut off to fit.
            ask.found(Undefined::Conversion, |a, _, _| !((a < 2_147_483_648.0) & (a > -2_147_483_649.0)))
        }
        Operation::Truncate | Operation::TruncateDouble => {
            ask.found(Undefined::Conversion, |a, _, _| !((a < 4_294_967_296.0) & (a > -1.0)))
        }
        Operation::FloatBits | Operation::HalfBits => ask.found(Undefined::NotANumber, |a, _, _| a.is_nan()),
        Operation::BitsFloat | Operation::BitsHalf | Operation::BitsDouble => A::NONE,
        _ if floating => A::NONE,
        Operation::Divide => {
            ask.found(Undefined::Division, |a, b, _| (b == 0.0) | ((a == -2_147_483_648.0) & (b == -1.0)))
        }
        Operation::Remainder => ask.found(Undefined::Remainder, |a, b, _| (b <= 0.0) | (a < 0.0)),
        Operation::ShiftLeft | Operation::ShiftRight => {
            ask.found(Undefined::Shift, |_, b, _| !(0.0..=31.0).contains(&b))
        }
        Operation::BitfieldExtract => ask.found(Undefined::Bitfield, |_, b, c| (b < 0.0) | (c < 0.0) | (b + c > 32.0)),
        Operation::BitfieldMask => ask.found(Undefined::Bitfield, |a, b, _| (a < 0.0) | (b < 0.0) | (a + b > 32.0)),
        _ => A::NONE,
    }
}
