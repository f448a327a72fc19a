//! How values lie in a block of uniforms: arrays and structures by the rules of std140, truth values as integers.
//!
//! A block holds no `bool`, so a type with one has another type in memory, and what is loaded is converted. The same goes for
//! a matrix of two rows, whose columns lie 16 bytes apart: naga has no such matrix, and an array of columns in its place.

use super::code::{SpirvCode, SpirvInstruction};
use super::op::{self, decoration};
use std::collections::HashMap;

/// Alignment of structures and array elements in a block of uniforms, in bytes.
const UNIFORM_ALIGNMENT: u32 = 16;

/// The types in memory of the types of values.
#[derive(Debug, Default)]
pub(super) struct MemoryTypes(HashMap<u32, u32>);

impl MemoryTypes {
    /// The type in memory of `ty`, with the places of its parts declared.
    pub fn of(&mut self, code: &mut SpirvCode, ty: u32) -> u32 {
        if let Some(known) = self.0.get(&ty) {
            return *known;
        }
        let Some(declared) = code.global(ty).cloned() else { return ty };
        let operand = |at: usize| declared.operands.get(at).copied().unwrap_or_default();
        let own = match declared.opcode {
            op::TYPE_BOOL => code.ty(op::TYPE_INT, &[32, 0]),
            op::TYPE_VECTOR => match self.of(code, operand(1)) {
                same if same == operand(1) => ty,
                component => code.ty(op::TYPE_VECTOR, &[component, operand(2)]),
            },
            op::TYPE_MATRIX if rows(code, operand(1)) == Some(2) => {
                let uint = code.ty(op::TYPE_INT, &[32, 0]);
                let length = code.constant(op::CONSTANT, uint, &[operand(2)]);
                // One of its own: the student's arrays of such columns need not lie in a block.
                let own = code.fresh();
                code.globals.push(SpirvInstruction::new(op::TYPE_ARRAY, vec![own, operand(1), length]));
                let stride = stride(code, operand(1));
                code.decorate(&[own], &[decoration::ARRAY_STRIDE, stride]);
                own
            }
            op::TYPE_ARRAY => self.array(code, ty, operand(1), operand(2)),
            op::TYPE_STRUCT => self.structure(code, ty, &declared.operands[1..]),
            _ => ty,
        };
        self.0.insert(ty, own);
        own
    }

    fn array(&mut self, code: &mut SpirvCode, ty: u32, element: u32, length: u32) -> u32 {
        let inner = self.of(code, element);
        let own = if inner == element { ty } else { code.fresh() };
        if own != ty {
            code.globals.push(SpirvInstruction::new(op::TYPE_ARRAY, vec![own, inner, length]));
        }
        let stride = stride(code, inner);
        code.decorate(&[own], &[decoration::ARRAY_STRIDE, stride]);
        own
    }

    fn structure(&mut self, code: &mut SpirvCode, ty: u32, members: &[u32]) -> u32 {
        let inner: Vec<u32> = members.iter().map(|&member| self.of(code, member)).collect();
        let own = if inner == members { ty } else { code.fresh() };
        if own != ty {
            code.globals.push(SpirvInstruction::new(op::TYPE_STRUCT, [&[own], &inner[..]].concat()));
            let is_name = |opcode| matches!(opcode, op::NAME | op::MEMBER_NAME);
            let named = code.heads.iter().filter(|head| is_name(head.opcode) && head.operands[0] == ty);
            let copy = |head: &SpirvInstruction| (head.opcode, [&[own], &head.operands[1..]].concat());
            let names: Vec<_> = named.map(copy).collect();
            let at = code.heads.iter().position(|head| is_name(head.opcode)).unwrap_or(0);
            let names = names.into_iter().map(|(opcode, operands)| SpirvInstruction::new(opcode, operands));
            code.heads.splice(at..at, names);
            if is_block(code, ty) {
                code.decorate(&[own], &[decoration::BLOCK]);
            }
        }
        place_members(code, own, &inner);
        own
    }

    /// The type in memory of `ty`, where one was asked for before.
    pub fn known(&self, ty: u32) -> u32 {
        self.0.get(&ty).copied().unwrap_or(ty)
    }

    /// Writes the value `id` of type `ty` that `loaded`, of its type in memory, stands for.
    pub fn value(
        &self,
        code: &mut SpirvCode,
        out: &mut Vec<SpirvInstruction>,
        line: Option<u32>,
        (ty, id): (u32, u32),
        loaded: u32,
    ) {
        let own = self.known(ty);
        let Some(declared) = code.global(ty).cloned() else { return };
        let parts: Vec<u32> = match declared.opcode {
            op::TYPE_ARRAY => {
                let length = code.global(declared.operands[2]).and_then(|length| length.operands.get(2).copied());
                vec![declared.operands[1]; length.unwrap_or(0) as usize]
            }
            op::TYPE_STRUCT => declared.operands[1..].to_vec(),
            op::TYPE_MATRIX => vec![declared.operands[1]; declared.operands[2] as usize],
            _ => {
                let zero = code.null(own);
                out.push(SpirvInstruction { opcode: op::I_NOT_EQUAL, operands: vec![ty, id, loaded, zero], line });
                return;
            }
        };
        let mut values = Vec::with_capacity(parts.len());
        for (at, part) in (0..).zip(parts) {
            let inner = self.known(part);
            let extracted = code.fresh();
            let operands = vec![inner, extracted, loaded, at];
            out.push(SpirvInstruction { opcode: op::COMPOSITE_EXTRACT, operands, line });
            let value = if inner == part { extracted } else { code.fresh() };
            if inner != part {
                self.value(code, out, line, (part, value), extracted);
            }
            values.push(value);
        }
        out.push(SpirvInstruction {
            opcode: op::COMPOSITE_CONSTRUCT,
            operands: [&[ty, id], &values[..]].concat(),
            line,
        });
    }
}

/// Forgets where the parts of a type lie in the student's own block: they are laid out anew, columns after columns.
pub(super) fn forget_places(code: &mut SpirvCode, ty: u32) {
    let Some(declared) = code.global(ty).cloned() else { return };
    let parts = match declared.opcode {
        op::TYPE_ARRAY => &declared.operands[1..2],
        op::TYPE_STRUCT => &declared.operands[1..],
        _ => return,
    };
    let is_block = is_block(code, ty);
    code.undecorate(ty);
    if is_block {
        code.decorate(&[ty], &[decoration::BLOCK]);
    }
    parts.iter().for_each(|part| forget_places(code, *part));
}

/// Whether a structure is that of a block.
fn is_block(code: &SpirvCode, ty: u32) -> bool {
    code.heads.iter().any(|head| head.opcode == op::DECORATE && head.operands == [ty, decoration::BLOCK])
}

/// The rows of a matrix with such columns of `float`.
fn rows(code: &SpirvCode, column: u32) -> Option<u32> {
    let column = code.global(column)?;
    let is_float = code.global(*column.operands.get(1)?)?.operands.get(1) == Some(&32);
    column.operands.get(2).copied().filter(|_| is_float)
}

/// Says where the members of a structure lie in a block.
pub(super) fn place_members(code: &mut SpirvCode, structure: u32, members: &[u32]) {
    let mut offset = 0;
    for (number, &ty) in (0..).zip(members) {
        let Layout { size, alignment, column } = layout(code, ty);
        offset = u32::next_multiple_of(offset, alignment);
        code.decorate(&[structure, number], &[decoration::OFFSET, offset]);
        if let Some(stride) = column {
            code.decorate(&[structure, number], &[decoration::COL_MAJOR]);
            code.decorate(&[structure, number], &[decoration::MATRIX_STRIDE, stride]);
        }
        offset = offset.saturating_add(size);
    }
}

/// How a type lies in a block, in bytes; `column` is the stride of a matrix.
struct Layout {
    size: u32,
    alignment: u32,
    column: Option<u32>,
}

fn layout(code: &SpirvCode, ty: u32) -> Layout {
    let scalar = Layout { size: 4, alignment: 4, column: None };
    let Some(declared) = code.global(ty) else { return scalar };
    let operand = |at: usize| declared.operands.get(at).copied().unwrap_or_default();
    match declared.opcode {
        op::TYPE_INT | op::TYPE_FLOAT => Layout { size: operand(1) / 8, alignment: operand(1) / 8, column: None },
        op::TYPE_VECTOR => {
            let Layout { size, .. } = layout(code, operand(1));
            let padded = if operand(2) == 2 { 2 } else { 4 };
            Layout { size: size * operand(2), alignment: size * padded, column: None }
        }
        op::TYPE_MATRIX => {
            let Layout { alignment, .. } = layout(code, operand(1));
            Layout { size: alignment * operand(2), alignment, column: Some(alignment) }
        }
        op::TYPE_ARRAY => {
            let element = layout(code, operand(1));
            let length = code.global(operand(2)).and_then(|length| length.operands.get(2).copied()).unwrap_or(1);
            Layout {
                size: stride(code, operand(1)).saturating_mul(length),
                alignment: element.alignment.max(UNIFORM_ALIGNMENT),
                column: element.column,
            }
        }
        op::TYPE_STRUCT => {
            let members = declared.operands[1..].iter().map(|&member| layout(code, member));
            let (end, alignment) = members.fold((0_u32, UNIFORM_ALIGNMENT), |(end, alignment), member| {
                let start = end.next_multiple_of(member.alignment);
                (start.saturating_add(member.size), alignment.max(member.alignment))
            });
            Layout { size: end.next_multiple_of(alignment), alignment, column: None }
        }
        _ => scalar,
    }
}

/// Bytes from one element of an array of `element` to the next.
fn stride(code: &SpirvCode, element: u32) -> u32 {
    let Layout { size, alignment, .. } = layout(code, element);
    size.next_multiple_of(alignment.max(UNIFORM_ALIGNMENT))
}
