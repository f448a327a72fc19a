//! What a program is compiled to: scalar instructions over slots, and structured control flow around them.
//!
//! A slot holds one scalar of every sample (of every *lane*), as f64; so vectors, matrices, arrays and structures are
//! consecutive slots, a swizzle costs nothing, and one instruction works on a column of lanes. Every variable has its
//! slots for itself: GLSL has no recursion, so that no stack is needed.

mod variable;

pub use variable::{BlockPlace, Interpolation, ProgramVariable};

use super::run::Undefined;
use super::texture::Query;
use super::trace::Site;

/// Number of a column.
pub type Slot = u32;

/// How the result of an arithmetic instruction is rounded or wrapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ArithmeticClass {
    /// 32 bits of floating point, computed in 64.
    Float,
    /// 64 bits of floating point.
    Double,
    /// 32 bits with a sign.
    Int,
    /// 32 bits without.
    Uint,
}

/// A scalar operation on at most three operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "they are what they are called in GLSL")]
pub enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
    /// `a * b + c`, rounded after each.
    MultiplyAdd,
    /// `a * b + c`, rounded once.
    Fma,
    /// Of integers: the sign is the dividend's.
    Remainder,
    Negate,
    Abs,
    Sign,
    Floor,
    Ceil,
    Trunc,
    Round,
    RoundEven,
    Fract,
    Minimum,
    Maximum,
    Mod,
    SquareRoot,
    InverseSquareRoot,
    Power,
    Exp,
    Log,
    Exp2,
    Log2,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    IsNan,
    IsInf,
    LoadExponent,
    Significand,
    Exponent,
    Less,
    LessEqual,
    Equal,
    NotEqual,
    And,
    Or,
    Xor,
    Not,
    /// `a ? b : c`
    Select,
    BitAnd,
    BitOr,
    BitXor,
    BitNot,
    ShiftLeft,
    ShiftRight,
    /// Bits of `a` from bit `b` on, `c` of them.
    BitfieldExtract,
    /// A mask of `b` bits from bit `a` on.
    BitfieldMask,
    BitfieldReverse,
    BitCount,
    FindLowest,
    FindHighest,
    /// The upper 32 bits of the product.
    MultiplyHigh,
    /// To the class, from floating point of 32 bits.
    Truncate,
    /// To the class, from floating point of 64 bits.
    TruncateDouble,
    /// To the class, from an integer of the other sign.
    Reinterpret,
    /// To floating point of 32 bits, from an integer or 64 bits.
    Narrow,
    FloatBits,
    BitsFloat,
    HalfBits,
    BitsHalf,
    DoubleLow,
    DoubleHigh,
    /// A double of its lower and upper 32 bits.
    BitsDouble,
    /// A copy.
    Copy,
    /// `a`, which must be at most `b`.
    AtMost,
    /// `a`, which must be less than `b`.
    Below,
    /// `1 / a`, where `a` must not be 0.
    Reciprocal,
}

/// One instruction: `to = operation(a, b, c)`; an operand that the operation has not is any slot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instruction {
    /// What is done.
    pub operation: Operation,
    /// Of which numbers.
    pub class: ArithmeticClass,
    /// Where the result goes: never one of the operands.
    pub to: Slot,
    /// The operands.
    pub of: [Slot; 3],
    /// The line that asks for it.
    pub line: u32,
}

/// Slots that an index selects among.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indexed {
    /// The first of all slots.
    pub base: Slot,
    /// A column of distances from there; not a number where an index is out of range.
    pub offset: Slot,
}

/// Which neighbour of the 2 × 2 pixels a derivative is taken to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DerivativeAxis {
    /// The one beside.
    X,
    /// The one above.
    Y,
}

/// Something to be done.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// An instruction; it writes a slot that only this statement reads, so that lanes need no mask.
    Do(Instruction),
    /// `to = from` in the lanes that are running.
    Store { to: Slot, from: Slot },
    /// A variable without a value: from here on it is undefined in the lanes that are running.
    Undefine { base: Slot, count: u32, what: Undefined, line: u32 },
    /// `to += index * stride`, not a number where the index is out of range.
    Offset { to: Slot, before: Option<Slot>, index: Slot, count: u32, stride: u32, line: u32 },
    /// `to = indexed`
    Gather { to: Slot, from: Indexed, line: u32 },
    /// `indexed = from` in the lanes that are running.
    Scatter { to: Indexed, from: Slot, line: u32 },
    /// Two branches.
    If { condition: Slot, yes: Vec<Node>, no: Vec<Node>, line: u32 },
    /// A loop; `test` gives the condition, and is done first or, in `do … while`, last.
    Loop { test: Vec<Node>, condition: Option<Slot>, body: Vec<Node>, step: Vec<Node>, test_first: bool, line: u32 },
    /// Cases in their order, with what labels them (none: `default`).
    Switch { selector: Slot, cases: Vec<(Vec<Option<f64>>, Vec<Node>)>, line: u32 },
    /// A function, whose parameters are set.
    Call { function: usize, line: u32 },
    /// `break`
    Break,
    /// `continue`
    Continue,
    /// `return`
    Return,
    /// `discard`
    Discard,
    /// The difference to the neighbour.
    Derivative { to: Slot, of: Slot, direction: DerivativeAxis, coarse: bool, line: u32 },
    /// A texture lookup.
    Texture(Box<Query>),
    /// A value that is looked at.
    Record(Box<ObservedValue>),
    /// Slots that have been given the last value of a site.
    Wrote { site: usize, base: Slot, count: u32 },
    /// A slot that has been given what another one was.
    HandedOn { to: Slot, from: Slot },
}

/// A value that is looked at, and may be changed before it is used.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservedValue {
    /// The number of its site.
    pub site: usize,
    /// Where it is.
    pub slots: Vec<Slot>,
    /// Where it was read.
    pub sources: Vec<Slot>,
}

/// A number that the program knows before it runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CodeConstant {
    /// The number.
    pub value: f64,
    /// Whether it is a `float`, which has 32 bits on a driver.
    pub is_float: bool,
}

/// A compiled program.
#[derive(Clone, Debug, Default)]
pub struct Code {
    /// The value of each slot that holds a constant; `None` for the others.
    pub constants: Vec<Option<CodeConstant>>,
    /// First values of uniforms.
    pub defaults: Vec<(Slot, f64)>,
    /// What is done for each sample before `main`.
    pub start: Vec<Node>,
    /// What each function does.
    pub functions: Vec<Vec<Node>>,
    /// Which of them is `main`.
    pub main: usize,
    /// Scalars and leaves that are the same for all samples.
    pub uniforms: Vec<ProgramVariable>,
    /// What each sample has for itself.
    pub inputs: Vec<ProgramVariable>,
    /// What each sample computes.
    pub outputs: Vec<ProgramVariable>,
    /// Variables of `main`, outside of inner blocks.
    pub locals: Vec<ProgramVariable>,
    /// Where values are looked at, in a program that is traced.
    pub sites: Vec<Site>,
}
