//! Whether words are what a compiler writes, as far as the passes rely on it: they read a file's words without asking
//! at each whether the compiler, which the file may have upset, was right.

use super::code::{SpirvCode, SpirvInstruction};
use super::op;
use std::collections::HashSet;

/// Most ids that a module may have (SPIR-V specification, section 2.17, universal limits).
const MAX_BOUND: u32 = 4_194_303;

/// Whether every instruction has the operands that its opcode needs, types and constants consist of what stands
/// before them, and numbers have sizes that GLSL knows.
pub(super) fn is_sound(code: &SpirvCode) -> bool {
    let all = || code.heads.iter().chain(&code.globals).chain(&code.functions);
    code.bound() <= MAX_BOUND && all().all(|i| i.operands.len() >= fewest_operands(i.opcode)) && are_globals_sound(code)
}

/// How many words an instruction has at least behind its first (SPIR-V specification, section 3.42), for those into
/// whose operands a pass looks.
fn fewest_operands(opcode: u16) -> usize {
    match opcode {
        op::TYPE_IMAGE => 8,
        op::EXT_INST | op::FUNCTION | op::ARRAY_LENGTH => 4,
        op::MEMBER_NAME
        | op::ENTRY_POINT
        | op::TYPE_INT
        | op::TYPE_VECTOR
        | op::TYPE_MATRIX
        | op::TYPE_ARRAY
        | op::TYPE_POINTER
        | op::CONSTANT
        | op::VARIABLE
        | op::LOAD
        | op::ACCESS_CHAIN
        | op::IN_BOUNDS_ACCESS_CHAIN
        | op::MEMBER_DECORATE
        | op::COPY_OBJECT
        | op::LOOP_MERGE
        | op::BRANCH_CONDITIONAL => 3,
        op::UNDEF
        | op::NAME
        | op::EXECUTION_MODE
        | op::TYPE_FLOAT
        | op::TYPE_SAMPLED_IMAGE
        | op::TYPE_RUNTIME_ARRAY
        | op::TYPE_FUNCTION
        | op::CONSTANT_COMPOSITE
        | op::CONSTANT_NULL
        | op::FUNCTION_PARAMETER
        | op::STORE
        | op::DECORATE
        | op::SELECTION_MERGE
        | op::SWITCH => 2,
        op::CAPABILITY | op::TYPE_VOID..=op::TYPE_FUNCTION | op::LABEL | op::BRANCH => 1,
        _ => 0,
    }
}

fn are_globals_sound(code: &SpirvCode) -> bool {
    let mut known: HashSet<u32> = HashSet::new();
    code.globals.iter().all(|global| {
        let (id, parts) = match (global.opcode, &global.operands[..]) {
            (op::TYPE_VECTOR | op::TYPE_MATRIX | op::TYPE_ARRAY | op::TYPE_RUNTIME_ARRAY, [id, part, ..]) => {
                (id, std::slice::from_ref(part))
            }
            (op::TYPE_STRUCT, [id, parts @ ..]) | (op::CONSTANT_COMPOSITE, [_, id, parts @ ..]) => (id, parts),
            (op::TYPE_VOID..=op::TYPE_FUNCTION, [id, ..]) | (_, [_, id, ..]) => (id, &[][..]),
            _ => return true,
        };
        let is_sound = parts.iter().all(|part| known.contains(part)) && has_a_size(global);
        known.insert(*id);
        is_sound
    })
}

fn has_a_size(ty: &SpirvInstruction) -> bool {
    match ty.opcode {
        op::TYPE_INT | op::TYPE_FLOAT => matches!(ty.operands[1], 8 | 16 | 32 | 64),
        op::TYPE_VECTOR | op::TYPE_MATRIX => (2..=4).contains(&ty.operands[2]),
        _ => true,
    }
}
