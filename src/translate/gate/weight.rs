//! What one expression costs the driver to compile, by what was measured.

use naga::{AddressSpace, ArraySize, BinaryOperator, Expression, Handle, MathFunction, Module, TypeInner};

// Weights: the driver's compile time of each, as a multiple of a scalar multiply-add's.

/// Reading or writing one element of an array at an index that is computed, for each scalar of the array: the driver
/// makes a ladder of branches of it. Measured: 512 scalars, 0.5 s; 1,024, 6 s.
pub(super) const INDEXED_SCALAR: u64 = 20;
/// `pow`, `sin` and their like. Measured: 400 of `pow`, 0.6 s.
const TRANSCENDENTAL: u64 = 15;
/// Dividing integers, with the checks against zero and overflow.
const INTEGER_DIVISION: u64 = 6;
/// An `if`, or a case of a `switch`.
pub(super) const BRANCH: u64 = 8;
/// Measured: 100 loops, 0.2 s; 400 loops, 3.4 s.
pub(super) const LOOP: u64 = 50;
/// For each loop in a loop, however deep, on top. Measured: 40 loops in each other, 0.2 s; 80, 1.3 s.
pub(super) const LOOP_IN_LOOP: u64 = 4;
/// Measured: 1,000 calls, 0.2 s; 2,000 calls, 2.2 s.
pub(super) const CALL: u64 = 10;

/// A lookup in a texture where it is run: what kind it is, is known where it stands, so that a tenth of the function is left. A
/// filtered value of four texels has 60 operations for each and as many to find their place.
pub(super) const LOOK_UP: u64 = 300;
/// The same where it is compiled: there is no more than one of its kind. Measured: 26 behind a choice between two textures, 1 s.
pub(super) const COMPILED_LOOK_UP: u64 = 120;

/// How many scalars a value of this type has.
pub(super) fn scalars(module: &Module, ty: &TypeInner) -> u64 {
    let of = |ty| scalars(module, &module.types[ty].inner);
    match *ty {
        TypeInner::Vector { size, scalar } => size as u64 * width(scalar),
        TypeInner::Matrix { columns, rows, scalar } => columns as u64 * rows as u64 * width(scalar),
        TypeInner::Array { base, size: ArraySize::Constant(length), .. } => {
            of(base).saturating_mul(length.get().into())
        }
        TypeInner::Struct { ref members, .. } => {
            members.iter().map(|member| of(member.ty)).fold(0, u64::saturating_add)
        }
        TypeInner::Pointer { base, .. } => of(base),
        TypeInner::ValuePointer { size, scalar, .. } => size.map_or(1, |size| size as u64) * width(scalar),
        TypeInner::Scalar(scalar) => width(scalar),
        _ => 1,
    }
}

/// A double counts as two.
fn width(scalar: naga::Scalar) -> u64 {
    u64::from(scalar.width).div_ceil(4)
}

/// How many scalars of an element are read or written at once: the driver keeps each member of structures in an array of its own.
fn at_once(module: &Module, ty: &TypeInner) -> u64 {
    match *ty {
        TypeInner::Pointer { base, .. } => at_once(module, &module.types[base].inner),
        TypeInner::Struct { ref members, .. } => {
            members.iter().map(|member| at_once(module, &module.types[member.ty].inner)).max().unwrap_or(1)
        }
        _ => scalars(module, ty),
    }
}

/// What an expression costs whose value has `own` scalars; `size` gives the scalars of its operands.
pub(super) fn weight(
    module: &Module,
    expression: &Expression,
    ty: &TypeInner,
    own: u64,
    size: &dyn Fn(Handle<Expression>) -> u64,
) -> u64 {
    let is_integer = !matches!(ty.scalar_kind(), Some(naga::ScalarKind::Float));
    match *expression {
        Expression::Access { base, .. } => match ty.pointer_space() {
            Some(AddressSpace::Uniform | AddressSpace::Storage { .. }) => 1,
            // As many elements, each with what is read of it.
            Some(_) => (size(base) / own.max(1)).saturating_mul(at_once(module, ty)).saturating_mul(INDEXED_SCALAR),
            None => size(base).saturating_mul(INDEXED_SCALAR),
        },
        // Two matrices: a dot product of one's row and the other's column for each scalar.
        Expression::Binary { op: BinaryOperator::Multiply, left, right } if size(left).max(size(right)) > 4 => {
            own.saturating_mul(4)
        }
        Expression::Binary { op: BinaryOperator::Divide | BinaryOperator::Modulo, .. } if is_integer => {
            own.saturating_mul(INTEGER_DIVISION)
        }
        Expression::Math { fun, arg, .. } => own.max(size(arg)).saturating_mul(math(fun)),
        Expression::AccessIndex { .. } | Expression::CallResult(_) => 1,
        _ => own,
    }
}

fn math(fun: MathFunction) -> u64 {
    use MathFunction as F;
    match fun {
        F::Abs | F::Min | F::Max | F::Floor | F::Ceil | F::Fract | F::Fma | F::Sqrt | F::InverseSqrt => 1,
        F::Sin | F::Cos | F::Tan | F::Asin | F::Acos | F::Atan | F::Atan2 | F::Sinh | F::Cosh | F::Tanh => {
            TRANSCENDENTAL
        }
        F::Asinh | F::Acosh | F::Atanh | F::Pow | F::Exp | F::Exp2 | F::Log | F::Log2 => TRANSCENDENTAL,
        F::Inverse | F::Determinant => 12,
        _ => 4,
    }
}
