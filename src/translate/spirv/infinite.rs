//! Constants that are no finite numbers, which naga takes nowhere and the compiler makes of `1.0 / 0.0`.
//!
//! Such a constant is made from its bits at the start of each function instead, under its own id, so that the functions
//! stay as they are. (An id that has a value in each function is no valid SPIR-V, but naga reads function by function.)

use super::code::{SpirvCode, SpirvInstruction};
use super::op::{self, storage};
use std::collections::HashMap;

/// Takes the constants out of the globals.
pub(super) fn rework(code: &mut SpirvCode) {
    let mut scalars = HashMap::new();
    for constant in code.globals.iter().filter(|i| i.opcode == op::CONSTANT) {
        if let Some(kind) = kind(code, constant) {
            scalars.insert(constant.operands[1], kind);
        }
    }
    if scalars.is_empty() {
        return;
    }
    let mut start = Vec::new();
    let mut made: Vec<u32> = Vec::new();
    // A composite stands behind its parts.
    let mut stored = Vec::new();
    for mut global in std::mem::take(&mut code.globals) {
        match (global.opcode, &mut global.operands[..]) {
            (op::CONSTANT, [ty, id, ..]) if scalars.contains_key(id) => {
                start.push((*ty, *id, None));
                made.push(*id);
            }
            (op::CONSTANT_COMPOSITE, [ty, id, parts @ ..]) if parts.iter().any(|part| made.contains(part)) => {
                start.push((*ty, *id, Some(parts.to_vec())));
                made.push(*id);
            }
            (op::VARIABLE, &mut [_, id, _, initial]) if made.contains(&initial) => {
                stored.push((id, initial));
                global.operands.truncate(3);
                code.globals.push(global);
            }
            _ => code.globals.push(global),
        }
    }
    let start: Vec<SpirvInstruction> =
        start.into_iter().flat_map(|(ty, id, parts)| written(code, ty, id, parts, scalars.get(&id))).collect();
    let first = stores(&stored);
    insert(code, &start, &made, &first);
}

/// What a number is that is not finite.
#[derive(Clone, Copy, Debug)]
struct NonFinite {
    /// The bits of a float of 32 bits that is the same.
    bits: u32,
    is_double: bool,
}

fn kind(code: &SpirvCode, constant: &SpirvInstruction) -> Option<NonFinite> {
    let float = code.global(*constant.operands.first()?).filter(|ty| ty.opcode == op::TYPE_FLOAT)?;
    let bits = match (float.operands.get(1)?, constant.operands.get(2..)?) {
        (32, &[bits]) => f32::from_bits(bits),
        (64, &[low, high]) => {
            let number = f64::from_bits(u64::from(high) << 32 | u64::from(low));
            // A large double is a finite one, and an infinite float.
            if number.is_finite() { 0.0 } else { number as f32 }
        }
        _ => return None,
    };
    (!bits.is_finite()).then(|| NonFinite { bits: bits.to_bits(), is_double: float.operands.get(1) == Some(&64) })
}

/// The instructions that make one of them.
fn written(
    code: &mut SpirvCode,
    ty: u32,
    id: u32,
    parts: Option<Vec<u32>>,
    kind: Option<&NonFinite>,
) -> Vec<SpirvInstruction> {
    let instruction =
        |opcode, id: u32, ty: u32, operands: &[u32]| SpirvInstruction::new(opcode, [&[ty, id], operands].concat());
    match (parts, kind) {
        (Some(parts), _) => vec![instruction(op::COMPOSITE_CONSTRUCT, id, ty, &parts)],
        (None, Some(NonFinite { bits, is_double })) => {
            let uint = code.ty(op::TYPE_INT, &[32, 0]);
            let bits = code.constant(op::CONSTANT, uint, &[*bits]);
            if !is_double {
                return vec![instruction(op::BITCAST, id, ty, &[bits])];
            }
            let (float, single) = (code.ty(op::TYPE_FLOAT, &[32]), code.fresh());
            vec![instruction(op::BITCAST, single, float, &[bits]), instruction(op::F_CONVERT, id, ty, &[single])]
        }
        (None, None) => Vec::new(),
    }
}

fn stores(stored: &[(u32, u32)]) -> Vec<SpirvInstruction> {
    stored.iter().map(|&(variable, value)| SpirvInstruction::new(op::STORE, vec![variable, value])).collect()
}

/// Puts `start` behind the variables of every function, and behind it, in the entry point, `first`.
fn insert(code: &mut SpirvCode, start: &[SpirvInstruction], made: &[u32], first: &[SpirvInstruction]) {
    let entry = code.heads.iter().find(|i| i.opcode == op::ENTRY_POINT).and_then(|i| i.operands.get(1).copied());
    let mut is_entry = false;
    // Whether the block of the function's variables is being read, and those that begin with such a constant.
    let mut begins = false;
    let mut stored = Vec::new();
    let mut out = Vec::with_capacity(code.functions.len() + start.len());
    for mut instruction in std::mem::take(&mut code.functions) {
        match (instruction.opcode, &instruction.operands[..]) {
            (op::FUNCTION, [_, id, ..]) => is_entry = Some(*id) == entry,
            (op::VARIABLE, &[_, id, storage::FUNCTION, initial]) if made.contains(&initial) => {
                stored.push((id, initial));
                instruction.operands.truncate(3);
            }
            (op::VARIABLE | op::LABEL, _) => {}
            _ if begins => {
                begins = false;
                out.extend_from_slice(start);
                out.extend(stores(&std::mem::take(&mut stored)));
                out.extend_from_slice(if is_entry { first } else { &[] });
            }
            _ => {}
        }
        // The label after the head and the parameters is the first block's.
        if matches!(instruction.opcode, op::FUNCTION) {
            begins = false;
        }
        let is_first_label = instruction.opcode == op::LABEL
            && out
                .last()
                .is_some_and(|last: &SpirvInstruction| matches!(last.opcode, op::FUNCTION | op::FUNCTION_PARAMETER));
        begins |= is_first_label;
        out.push(instruction);
    }
    code.functions = out;
}
