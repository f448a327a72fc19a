//! Integer instructions that naga does not know, whose operands it wants of one sign, or whose divisor it wants not to be
//! zero.

use super::lower::InstructionBuilder;
use super::op;

/// Writes what stands for an integer instruction; `None` where it stays as it is.
pub(super) fn lowered(b: &mut InstructionBuilder<'_>, opcode: u16, id: u32, ty: u32, operands: &[u32]) -> Option<()> {
    let &first = operands.first()?;
    let first_ty = b.type_of(first)?;
    match (opcode, operands) {
        (op::U_DIV | op::S_DIV | op::S_REM | op::S_MOD | op::U_MOD, &[x, y]) => {
            return divided(b, opcode, id, ty, [x, y]);
        }
        (op::I_ADD_CARRY, &[x, y]) => {
            let sum = b.op(op::I_ADD, first_ty, &[x, y]);
            let carry = flag(b, first_ty, [sum, x])?;
            b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &[sum, carry]);
        }
        (op::I_SUB_BORROW, &[x, y]) => {
            let difference = b.op(op::I_SUB, first_ty, &[x, y]);
            let borrow = flag(b, first_ty, [x, y])?;
            b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &[difference, borrow]);
        }
        (op::U_MUL_EXTENDED, &[x, y]) => {
            let low = b.op(op::I_MUL, first_ty, &[x, y]);
            let high = high_word(b, first_ty, x, y);
            b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &[low, high]);
        }
        (op::S_MUL_EXTENDED, &[x, y]) => {
            let low = b.op(op::I_MUL, first_ty, &[x, y]);
            let high = signed_high_word(b, first_ty, x, y)?;
            b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &[low, high]);
        }
        (op::BIT_COUNT | op::BIT_REVERSE, &[x]) if first_ty != ty => {
            let found = b.op(opcode, first_ty, &[x]);
            b.op_as(id, op::BITCAST, ty, &[found]);
        }
        _ => return None,
    }
    Some(())
}

/// A division or remainder by what is not zero.
///
/// GLSL leaves a division by zero undefined; here it divides by one. naga's back end sees to that for what it cannot know,
/// and its validator refuses a zero that it can see.
fn divided(b: &mut InstructionBuilder<'_>, opcode: u16, id: u32, ty: u32, [x, y]: [u32; 2]) -> Option<()> {
    let divisor = divisor(b, y)?;
    // GLSL leaves the sign of a remainder open; drivers take that of the dividend.
    let lowered = if opcode == op::S_MOD { op::S_REM } else { opcode };
    if (lowered, divisor) == (opcode, y) {
        return None;
    }
    b.op_as(id, lowered, ty, &[x, divisor]);
    Some(())
}

/// The divisor with ones in place of zeros, where it is a constant or may have one among its components.
fn divisor(b: &mut InstructionBuilder<'_>, id: u32) -> Option<u32> {
    let ty = b.type_of(id)?;
    let size = b.shape(ty)?.size;
    let Some(constant) = b.code.global(id).cloned() else {
        if size == 1 {
            return Some(id);
        }
        let (zero, one, bools) = (b.splat(ty, &[0]), b.splat(ty, &[1]), b.bools(size));
        let is_zero = b.op(op::I_EQUAL, bools, &[id, zero]);
        return Some(b.op(op::SELECT, ty, &[is_zero, one, id]));
    };
    match (constant.opcode, &constant.operands[2..]) {
        (op::CONSTANT_NULL, _) | (op::CONSTANT, [0]) => Some(b.splat(ty, &[1])),
        (op::CONSTANT_COMPOSITE, parts) => {
            let parts: Option<Vec<u32>> = parts.iter().map(|&part| divisor(b, part)).collect();
            Some(b.code.constant(op::CONSTANT_COMPOSITE, ty, &parts?))
        }
        _ => Some(id),
    }
}

/// 1 where the left is less than the right, as unsigned numbers, else 0.
fn flag(b: &mut InstructionBuilder<'_>, ty: u32, operands: [u32; 2]) -> Option<u32> {
    let size = b.shape(ty)?.size;
    let bools = b.bools(size);
    let (one, zero) = (b.splat(ty, &[1]), b.splat(ty, &[0]));
    let is_less = b.op(op::U_LESS_THAN, bools, &operands);
    Some(b.op(op::SELECT, ty, &[is_less, one, zero]))
}

/// The upper 32 of the 64 bits of an unsigned product, from the products of 16-bit halves.
fn high_word(b: &mut InstructionBuilder<'_>, ty: u32, x: u32, y: u32) -> u32 {
    let sixteen = b.splat(ty, &[16]);
    let mask = b.splat(ty, &[0xffff]);
    let low = |b: &mut InstructionBuilder<'_>, word| b.op(op::BITWISE_AND, ty, &[word, mask]);
    let high = |b: &mut InstructionBuilder<'_>, word| b.op(op::SHIFT_RIGHT_LOGICAL, ty, &[word, sixteen]);
    let product = |b: &mut InstructionBuilder<'_>, x, y| b.op(op::I_MUL, ty, &[x, y]);
    let sum = |b: &mut InstructionBuilder<'_>, x, y| b.op(op::I_ADD, ty, &[x, y]);
    let ([x0, x1], [y0, y1]) = ([low(b, x), high(b, x)], [low(b, y), high(b, y)]);
    let (p00, p01, p10, p11) = (product(b, x0, y0), product(b, x0, y1), product(b, x1, y0), product(b, x1, y1));
    // At most 3 · 0xffff, so no carry is lost.
    let carried = high(b, p00);
    let (p01_low, p10_low) = (low(b, p01), low(b, p10));
    let middle = sum(b, carried, p01_low);
    let middle = sum(b, middle, p10_low);
    let (p01_high, p10_high, middle) = (high(b, p01), high(b, p10), high(b, middle));
    let total = sum(b, p11, p01_high);
    let total = sum(b, total, p10_high);
    sum(b, total, middle)
}

/// The upper 32 bits of a signed product: a negative factor counts 2³² too much as an unsigned one.
fn signed_high_word(b: &mut InstructionBuilder<'_>, ty: u32, x: u32, y: u32) -> Option<u32> {
    let size = b.shape(ty)?.size;
    let (uints, bools) = (b.ints(size, false), b.bools(size));
    let (ux, uy) = (b.op(op::BITCAST, uints, &[x]), b.op(op::BITCAST, uints, &[y]));
    let high = high_word(b, uints, ux, uy);
    let (signed_zero, zero) = (b.splat(ty, &[0]), b.splat(uints, &[0]));
    let excess = |b: &mut InstructionBuilder<'_>, factor, other| {
        let is_negative = b.op(op::S_LESS_THAN, bools, &[factor, signed_zero]);
        b.op(op::SELECT, uints, &[is_negative, other, zero])
    };
    let (of_x, of_y) = (excess(b, x, uy), excess(b, y, ux));
    let high = b.op(op::I_SUB, uints, &[high, of_x]);
    let high = b.op(op::I_SUB, uints, &[high, of_y]);
    Some(b.op(op::BITCAST, ty, &[high]))
}
