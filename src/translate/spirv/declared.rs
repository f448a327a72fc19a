//! What types are, as GLSL declares them.

use super::code::SpirvCode;
use super::io;
use super::op;
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
}

/// Lists the parts of a type that are scalars, vectors and matrices.
pub(super) fn declare(
    code: &SpirvCode,
    samplers: &SamplerTypes,
    ty: u32,
    path: String,
    is_in_block: bool,
    found: &mut Vec<DeclaredUniform>,
) {
    let Some(declared) = code.global(ty) else { return };
    match declared.opcode {
        op::TYPE_STRUCT => {
            let names: HashMap<u32, String> = io::member_names(code, ty).into_iter().collect();
            for (number, &member) in (0..).zip(&declared.operands[1..]) {
                let name = names.get(&number).map_or("", String::as_str);
                declare(code, samplers, member, format!("{path}.{name}"), is_in_block, found);
            }
        }
        op::TYPE_ARRAY => {
            let length = code.global(declared.operands[2]).and_then(|length| length.operands.get(2).copied());
            for index in 0..length.unwrap_or(0) {
                declare(code, samplers, declared.operands[1], format!("{path}[{index}]"), is_in_block, found);
            }
        }
        _ => found.push(DeclaredUniform {
            path,
            ty: samplers.name(ty).unwrap_or_else(|| glsl_name(code, ty)),
            is_in_block,
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
