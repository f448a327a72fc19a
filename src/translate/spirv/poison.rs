//! Makes visible what depends on an undefined result.

use super::code::{SpirvCode, SpirvInstruction};
use super::lower::{InstructionBuilder, NumberType, rewrite};
use super::{op, op::glsl};

/// A base below this is negative; what rounding makes of 0 is not.
pub(in crate::translate) const NEGATIVE: f32 = -1e-5;
/// What `pow` of a negative base gives in a poisoned shader: a number that no right colour hides in.
const POISON: f64 = 12_345.678;

/// Has `pow` give [`POISON`] wherever its base is negative.
pub(super) fn poison(code: &mut SpirvCode) {
    rewrite(code, poisoned);
}

fn poisoned(builder: &mut InstructionBuilder<'_>, instruction: &SpirvInstruction) -> Option<()> {
    let [ty, id, set, glsl::POW, base, exponent] = instruction.operands[..] else { return None };
    if instruction.opcode != op::EXT_INST {
        return None;
    }
    let NumberType { size, .. } = builder.shape(ty)?;
    let limit = builder.float(ty, f64::from(NEGATIVE));
    let bools = builder.bools(size);
    let is_negative = builder.op(op::F_ORD_LESS_THAN, bools, &[base, limit]);
    let power = builder.op(op::EXT_INST, ty, &[set, glsl::POW, base, exponent]);
    let poison = builder.float(ty, POISON);
    builder.op_as(id, op::SELECT, ty, &[is_negative, poison, power]);
    Some(())
}
