//! What types are, as GLSL declares them.

use super::code::SpirvCode;
use super::io;
use super::op::{self, decoration};
use super::textures::SamplerTypes;
use std::collections::HashMap;

/// A part of a uniform that the program sets: its path and its GLSL type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeclaredUniform {
    /// Such as `lights[1].colour`.
    pub path: String,
    /// Such as `vec3`.
    pub ty: String,
    /// Whether it is in a block of the student's own.
    pub is_in_block: bool,
    /// Where each of its numbers lies in that block as the student lays it out, in bytes: those of a matrix column by column.
    pub places: Vec<u32>,
}

/// Where a part of a block begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beginning {
    offset: u32,
    /// Bytes from one column of a matrix to the next, or from row to row.
    stride: u32,
    is_row_major: bool,
}

impl Beginning {
    /// That of a block.
    pub const OF_BLOCK: Self = Self { offset: 0, stride: 0, is_row_major: false };

    fn at(self, offset: u32) -> Self {
        Self { offset: self.offset.saturating_add(offset), ..self }
    }

    /// That of a member of a structure that begins here.
    fn of_member(self, code: &SpirvCode, structure: u32, number: u32) -> Self {
        let of = |what| code.decoration(&[structure, number], what);
        let word = |what| of(what).and_then(|words| words.first().copied()).unwrap_or(0);
        let is_row_major = of(decoration::ROW_MAJOR).is_some();
        Self { stride: word(decoration::MATRIX_STRIDE), is_row_major, ..self.at(word(decoration::OFFSET)) }
    }

    /// Where the numbers lie of a matrix, vector or scalar that begins here.
    fn numbers(self, code: &SpirvCode, ty: u32) -> Vec<u32> {
        let Some(declared) = code.global(ty) else { return Vec::new() };
        let operand = |at: usize| declared.operands.get(at).copied().unwrap_or_default();
        match declared.opcode {
            op::TYPE_VECTOR => {
                let each = width(code, operand(1));
                (0..operand(2)).map(|component| self.offset + component * each).collect()
            }
            op::TYPE_MATRIX => {
                let Some(column) = code.global(operand(1)) else { return Vec::new() };
                let [_, scalar, rows] = column.operands[..] else { return Vec::new() };
                let [column, row] = match self.is_row_major {
                    true => [width(code, scalar), self.stride],
                    false => [self.stride, width(code, scalar)],
                };
                let of_column = |number: u32| (0..rows).map(move |place| number * column + place * row);
                (0..operand(2)).flat_map(of_column).map(|behind| self.offset + behind).collect()
            }
            _ => vec![self.offset],
        }
    }
}

/// Bytes of a scalar.
fn width(code: &SpirvCode, scalar: u32) -> u32 {
    let bits = code.global(scalar).filter(|own| own.opcode == op::TYPE_FLOAT).and_then(|own| own.operands.get(1));
    bits.map_or(4, |bits| bits / 8)
}

/// Lists the parts of a type that are scalars, vectors and matrices. `begins`: where, in a block of the student's own.
pub(super) fn declare(
    code: &SpirvCode,
    samplers: &SamplerTypes,
    ty: u32,
    path: String,
    begins: Option<Beginning>,
    found: &mut Vec<DeclaredUniform>,
) {
    let Some(declared) = code.global(ty) else { return };
    match declared.opcode {
        op::TYPE_STRUCT => {
            let names: HashMap<u32, String> = io::member_names(code, ty).into_iter().collect();
            for (number, &member) in (0..).zip(&declared.operands[1..]) {
                let name = names.get(&number).map_or("", String::as_str);
                let begins = begins.map(|own| own.of_member(code, ty, number));
                declare(code, samplers, member, format!("{path}.{name}"), begins, found);
            }
        }
        op::TYPE_ARRAY => {
            let length = code.global(declared.operands[2]).and_then(|length| length.operands.get(2).copied());
            let stride = code.decoration(&[ty], decoration::ARRAY_STRIDE).and_then(|words| words.first().copied());
            for index in 0..length.unwrap_or(0) {
                let begins = begins.map(|own| own.at(index.saturating_mul(stride.unwrap_or(0))));
                declare(code, samplers, declared.operands[1], format!("{path}[{index}]"), begins, found);
            }
        }
        _ => found.push(DeclaredUniform {
            path,
            ty: samplers.name(ty).unwrap_or_else(|| glsl_name(code, ty)),
            is_in_block: begins.is_some(),
            places: begins.map(|own| own.numbers(code, ty)).unwrap_or_default(),
        }),
    }
}

/// The name that GLSL gives to a scalar, vector or matrix.
fn glsl_name(code: &SpirvCode, ty: u32) -> String {
    let Some(declared) = code.global(ty) else { return String::new() };
    let operand = |at: usize| declared.operands.get(at).copied().unwrap_or_default();
    let prefix = |scalar: u32| match glsl_name(code, scalar).as_str() {
        "double" => "d",
        "int" => "i",
        "uint" => "u",
        "bool" => "b",
        _ => "",
    };
    match declared.opcode {
        op::TYPE_BOOL => "bool".into(),
        op::TYPE_INT if operand(2) == 1 => "int".into(),
        op::TYPE_INT => "uint".into(),
        op::TYPE_FLOAT if operand(1) == 64 => "double".into(),
        op::TYPE_FLOAT => "float".into(),
        op::TYPE_VECTOR => format!("{}vec{}", prefix(operand(1)), operand(2)),
        op::TYPE_MATRIX => {
            let column = code.global(operand(1)).map_or(&[][..], |column| &column.operands[..]);
            let (scalar, rows) = (column.get(1).copied().unwrap_or(0), column.get(2).copied().unwrap_or(0));
            let sides = if rows == operand(2) { rows.to_string() } else { format!("{}x{rows}", operand(2)) };
            format!("{}mat{sides}", prefix(scalar))
        }
        _ => "struct".into(),
    }
}

/// What an array of arrays has in it, or the type itself where it is none.
pub(super) fn element(code: &SpirvCode, mut ty: u32) -> u32 {
    while let Some(array) = code.global(ty).filter(|declared| declared.opcode == op::TYPE_ARRAY) {
        ty = array.operands[1];
    }
    ty
}

/// Whether it has a size, so that a private variable can hold it.
pub(super) fn has_size(code: &SpirvCode, ty: u32) -> bool {
    code.global(ty).is_some_and(|declared| match declared.opcode {
        op::TYPE_RUNTIME_ARRAY => false,
        op::TYPE_ARRAY => has_size(code, declared.operands[1]),
        op::TYPE_STRUCT => declared.operands[1..].iter().all(|&member| has_size(code, member)),
        _ => true,
    })
}

/// Whether a block can hold it, as it is or with integers for truth values.
pub(super) fn fits_block(code: &SpirvCode, ty: u32) -> bool {
    code.global(ty).is_some_and(|declared| match declared.opcode {
        op::TYPE_BOOL | op::TYPE_INT | op::TYPE_FLOAT => true,
        op::TYPE_VECTOR | op::TYPE_MATRIX | op::TYPE_ARRAY => fits_block(code, declared.operands[1]),
        op::TYPE_STRUCT => declared.operands[1..].iter().all(|&member| fits_block(code, member)),
        _ => false,
    })
}

/// The short name of a type that no block of the program can hold.
pub(super) fn short_name(code: &SpirvCode, ty: u32) -> &'static str {
    match code.global(ty).map(|declared| (declared.opcode, declared.operands.get(2).copied().unwrap_or(0))) {
        Some((op::TYPE_BOOL, _)) => "bool",
        Some((op::TYPE_VECTOR, 2)) => "bvec2",
        Some((op::TYPE_VECTOR, 3)) => "bvec3",
        Some((op::TYPE_VECTOR, 4)) => "bvec4",
        Some((op::TYPE_ARRAY, _)) => "array",
        _ => "struct",
    }
}
