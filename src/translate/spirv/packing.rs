//! Packing that Mesa's Vulkan driver folds wrongly where the operands are constants, in plain arithmetic.

use super::lower::InstructionBuilder;
use super::op::{self, glsl};

/// `packSnorm4x8` and `packSnorm2x16` (GLSL 4.20, section 8.4): round(clamp(c, −1, 1) · (2ⁿ⁻¹ − 1)), the first
/// component lowest.
pub(super) fn pack_signed(b: &mut InstructionBuilder<'_>, id: u32, ty: u32, argument: u32) -> Option<()> {
    let argument_ty = b.type_of(argument)?;
    let size = b.shape(argument_ty)?.size;
    let width = 32 / size;
    let mask = u32::MAX >> (32 - width);
    let (low, high) = (b.float(argument_ty, -1.0), b.float(argument_ty, 1.0));
    let scale = b.float(argument_ty, f64::from(mask >> 1));
    let clamped = b.glsl(glsl::F_CLAMP, argument_ty, &[argument, low, high]);
    let scaled = b.op(op::F_MUL, argument_ty, &[clamped, scale]);
    let rounded = b.glsl(glsl::ROUND_EVEN, argument_ty, &[scaled]);
    let (ints, uints) = (b.ints(size, true), b.ints(size, false));
    let signed = b.op(op::CONVERT_F_TO_S, ints, &[rounded]);
    let bits = b.op(op::BITCAST, uints, &[signed]);
    let mask = b.splat(uints, &[mask]);
    let fields = b.op(op::BITWISE_AND, uints, &[bits, mask]);
    let mut packed = b.op(op::COMPOSITE_EXTRACT, ty, &[fields, 0]);
    for at in 1..size {
        let field = b.op(op::COMPOSITE_EXTRACT, ty, &[fields, at]);
        let shift = b.splat(ty, &[at * width]);
        let shifted = b.op(op::SHIFT_LEFT_LOGICAL, ty, &[field, shift]);
        packed = b.op(op::BITWISE_OR, ty, &[packed, shifted]);
    }
    b.op_as(id, op::COPY_OBJECT, ty, &[packed]);
    Some(())
}

/// `unpackHalf2x16` (GLSL 4.20, section 8.4), the component in the lower half first.
pub(super) fn unpack_half(b: &mut InstructionBuilder<'_>, id: u32, ty: u32, argument: u32) -> Option<()> {
    let uint = b.type_of(argument)?;
    let float = b.shape(ty)?.scalar;
    let sixteen = b.splat(uint, &[16]);
    let upper = b.op(op::SHIFT_RIGHT_LOGICAL, uint, &[argument, sixteen]);
    let components = [argument, upper].map(|word| half(b, float, uint, word));
    b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &components);
    Some(())
}

/// The half-precision number in the lower 16 bits: sign, 5 bits of exponent with bias 15, 10 of fraction.
fn half(b: &mut InstructionBuilder<'_>, float: u32, uint: u32, word: u32) -> u32 {
    let bool = b.bools(1);
    let constant = |b: &mut InstructionBuilder<'_>, bits| b.splat(uint, &[bits]);
    let magnitude_bits = constant(b, 0x7fff);
    let magnitude = b.op(op::BITWISE_AND, uint, &[word, magnitude_bits]);
    let thirteen = constant(b, 13);
    let moved = b.op(op::SHIFT_LEFT_LOGICAL, uint, &[magnitude, thirteen]);
    // Biases of 127 and 15, and the largest exponents of 255 and 31, are 112 apart.
    let (rebias, infinite) = (constant(b, 112 << 23), constant(b, 0x7c00));
    let normal = b.op(op::I_ADD, uint, &[moved, rebias]);
    let beyond = b.op(op::I_ADD, uint, &[normal, rebias]);
    let is_finite = b.op(op::U_LESS_THAN, bool, &[magnitude, infinite]);
    let normal = b.op(op::SELECT, uint, &[is_finite, normal, beyond]);
    let normal = b.op(op::BITCAST, float, &[normal]);
    // Below the least normal number, 2⁻¹⁴, the fraction counts 2⁻²⁴.
    let (least, unit) = (constant(b, 0x0400), b.float(float, f64::from(2.0f32.powi(-24))));
    let count = b.op(op::CONVERT_U_TO_F, float, &[magnitude]);
    let subnormal = b.op(op::F_MUL, float, &[count, unit]);
    let is_subnormal = b.op(op::U_LESS_THAN, bool, &[magnitude, least]);
    let absolute = b.op(op::SELECT, float, &[is_subnormal, subnormal, normal]);
    let (sign_bit, zero) = (constant(b, 0x8000), constant(b, 0));
    let sign = b.op(op::BITWISE_AND, uint, &[word, sign_bit]);
    let is_positive = b.op(op::I_EQUAL, bool, &[sign, zero]);
    let negative = b.op(op::F_NEGATE, float, &[absolute]);
    b.op(op::SELECT, float, &[is_positive, absolute, negative])
}
