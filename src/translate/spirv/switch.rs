//! `switch` without falling through: naga's front end takes a case only where it ends by itself.

use super::code::{SpirvCode, SpirvInstruction};
use super::{Unworkable, op};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// How many words copies may make of the functions. A case of a hundred statements that is run into by ten others
/// stays far below.
const MAX_WORDS: usize = 1 << 20;

/// Gives every case that runs into the next a copy of that one, and takes the labels that share a block with `default`
/// out of their `switch`.
pub(super) fn separate_cases(code: &mut SpirvCode) -> Result<(), Unworkable> {
    // An inner switch stands behind its outer one, so that its cases are whole before they are copied.
    let mut before = code.functions.len();
    while let Some(at) = code.functions[..before].iter().rposition(|i| i.opcode == op::SWITCH) {
        before = at;
        separate(code, at)?;
    }
    Ok(())
}

/// A case: the label that it begins with, and its blocks.
struct CaseBlocks {
    label: u32,
    blocks: Range<usize>,
}

fn separate(code: &mut SpirvCode, at: usize) -> Result<(), Unworkable> {
    let switch = code.functions[at].operands.clone();
    let line = code.functions[at].line;
    let default = *switch.get(1).ok_or(Unworkable::Damaged)?;
    let shared = switch[2..].chunks_exact(2).filter(|pair| pair[1] != default).flatten().copied();
    code.functions[at].operands = switch[..2].iter().copied().chain(shared).collect();
    let merge = code.functions[..at].last().filter(|i| i.opcode == op::SELECTION_MERGE);
    let merge = *merge.and_then(|merge| merge.operands.first()).ok_or(Unworkable::Damaged)?;
    let cases = cases(&code.functions, at, &switch, merge).ok_or(Unworkable::Damaged)?;
    // What a case runs into is whole by then.
    let mut whole: HashMap<u32, Vec<SpirvInstruction>> = HashMap::new();
    for index in in_order(&code.functions, &cases) {
        let case = &cases[index];
        let mut blocks = Vec::new();
        for position in case.blocks.clone() {
            let mut instruction = code.functions[position].clone();
            let next = match (instruction.opcode, instruction.operands.first()) {
                (op::BRANCH, Some(target)) => whole.get(target),
                _ => None,
            };
            let Some(next) = next else {
                blocks.push(instruction);
                continue;
            };
            let next = copied(code, next);
            instruction.operands = vec![next[0].operands[0]];
            blocks.push(instruction);
            blocks.extend(next);
        }
        whole.insert(case.label, blocks);
        if whole.values().flatten().map(|i| i.operands.len() + 1).sum::<usize>() + code.function_words() > MAX_WORDS {
            return Err(Unworkable::Cases(line));
        }
    }
    let (Some(first), Some(last)) = (cases.first(), cases.last()) else { return Ok(()) };
    let all: Vec<SpirvInstruction> =
        cases.iter().filter_map(|case| whole.get(&case.label)).flatten().cloned().collect();
    code.functions.splice(first.blocks.start..last.blocks.end, all);
    Ok(())
}

/// The numbers of the cases, each behind the one that it runs into, if it does: in the order of the blocks, `default` stands
/// before all others, wherever it stands in the text.
fn in_order(functions: &[SpirvInstruction], cases: &[CaseBlocks]) -> Vec<usize> {
    let numbers: HashMap<u32, usize> = cases.iter().enumerate().map(|(number, case)| (case.label, number)).collect();
    let next = |number: usize| {
        let branches = functions[cases[number].blocks.clone()].iter().filter(|i| i.opcode == op::BRANCH);
        branches.filter_map(|i| numbers.get(i.operands.first()?).copied()).next()
    };
    let mut seen = vec![false; cases.len()];
    let mut order = Vec::with_capacity(cases.len());
    for first in 0..cases.len() {
        let unseen = |number: usize, seen: &mut Vec<bool>| !std::mem::replace(&mut seen[number], true);
        let mut way = Vec::new();
        let mut at = Some(first);
        while let Some(number) = at.filter(|&number| unseen(number, &mut seen)) {
            way.push(number);
            at = next(number);
        }
        order.extend(way.into_iter().rev());
    }
    order
}

/// The cases of the switch at `at` in the order of their blocks.
fn cases(functions: &[SpirvInstruction], at: usize, switch: &[u32], merge: u32) -> Option<Vec<CaseBlocks>> {
    let targets: HashSet<u32> =
        std::iter::once(switch[1]).chain(switch[2..].chunks_exact(2).map(|pair| pair[1])).collect();
    let mut cases: Vec<CaseBlocks> = Vec::new();
    for (position, instruction) in functions.iter().enumerate().skip(at + 1) {
        let label = match instruction.opcode {
            op::LABEL => instruction.operands[0],
            op::FUNCTION_END => return None,
            _ => continue,
        };
        if let Some(open) = cases.last_mut().filter(|_| label == merge || targets.contains(&label)) {
            open.blocks.end = position;
        }
        if label == merge {
            return Some(cases);
        }
        if targets.contains(&label) {
            cases.push(CaseBlocks { label, blocks: position..position });
        }
    }
    None
}

/// A copy of blocks in which everything that they define has a new id.
fn copied(code: &mut SpirvCode, blocks: &[SpirvInstruction]) -> Vec<SpirvInstruction> {
    let mut new = HashMap::new();
    for instruction in blocks {
        let defined = match instruction.opcode {
            op::LABEL => Some(instruction.operands[0]),
            _ => instruction.result().map(|(_, id)| id),
        };
        if let Some(id) = defined {
            new.insert(id, code.fresh());
        }
    }
    let renamed = |instruction: &SpirvInstruction| {
        let mut instruction = instruction.clone();
        let opcode = instruction.opcode;
        for (at, operand) in instruction.operands.iter_mut().enumerate() {
            if !is_literal(opcode, at)
                && let Some(id) = new.get(operand)
            {
                *operand = *id;
            }
        }
        instruction
    };
    blocks.iter().map(renamed).collect()
}

/// Whether the operand at `at` is a number by itself, not an id.
fn is_literal(opcode: u16, at: usize) -> bool {
    match opcode {
        op::EXT_INST => at == 3,
        op::LOAD | op::COMPOSITE_EXTRACT => at > 2,
        op::STORE | op::LOOP_MERGE => at > 1,
        op::COMPOSITE_INSERT | op::VECTOR_SHUFFLE => at > 3,
        op::ARRAY_LENGTH => at == 3,
        op::SELECTION_MERGE => at > 0,
        op::BRANCH_CONDITIONAL => at > 2,
        op::SWITCH => at > 1 && at.is_multiple_of(2),
        // The mask of image operands; it stands one later where there is a reference or component.
        89 | 90 | 93 | 94 | 96 | 97 => at == 5,
        op::IMAGE_SAMPLE_FIRST..=op::IMAGE_LAST => at == 4,
        _ => false,
    }
}
