//! Textures of which no program ever binds one: what a shader reads from them is known.
//!
//! A sampler without a texture reads (0, 0, 0, 1) (OpenGL 4.1, section 3.9.2: an incomplete texture), an image
//! without one reads 0, and the size of both is 0.

use super::code::SpirvCode;
use super::lower::InstructionBuilder;
use super::op::{self, storage};

/// The capabilities that have nothing to do with images: Matrix, Shader, Float64, Int64, ClipDistance, CullDistance.
const CAPABILITIES: [u32; 6] = [0, 1, 10, 11, 32, 33];

/// Makes the types of samplers and images plain ones, so that variables of them are as any other.
pub(super) fn plain_types(code: &mut SpirvCode) {
    code.heads.retain(|i| i.opcode != op::CAPABILITY || CAPABILITIES.contains(&i.operands[0]));
    let mut plain = Vec::new();
    for declared in &mut code.globals {
        let first = |at: usize| declared.operands.get(at).copied().unwrap_or_default();
        match declared.opcode {
            op::TYPE_IMAGE | op::TYPE_SAMPLED_IMAGE => {
                plain.push(first(0));
                declared.opcode = op::TYPE_STRUCT;
                declared.operands.truncate(2);
            }
            op::TYPE_ARRAY if plain.contains(&first(1)) => plain.push(first(0)),
            op::TYPE_POINTER if plain.contains(&first(2)) => declared.operands[1] = storage::PRIVATE,
            _ => {}
        }
    }
}

/// Writes what stands for an instruction on images; `None` where it is none.
pub(super) fn lowered(b: &mut InstructionBuilder<'_>, opcode: u16, id: u32, ty: u32) -> Option<()> {
    let value = match opcode {
        op::IMAGE_SAMPLE_FIRST..op::IMAGE_READ => texel(b, ty),
        op::SAMPLED_IMAGE | op::IMAGE_READ..=op::IMAGE_LAST => b.code.null(ty),
        _ => return None,
    };
    b.op_as(id, op::COPY_OBJECT, ty, &[value]);
    Some(())
}

/// (0, 0, 0, 1) where it has four components, else 0.
fn texel(b: &mut InstructionBuilder<'_>, ty: u32) -> u32 {
    let Some(shape) = b.shape(ty).filter(|shape| shape.size == 4) else { return b.code.null(ty) };
    let is_float = b.code.global(shape.scalar).is_some_and(|declared| declared.opcode == op::TYPE_FLOAT);
    let zero = b.splat(shape.scalar, &[0]);
    let one = b.splat(shape.scalar, &[if is_float { 1.0f32.to_bits() } else { 1 }]);
    b.code.constant(op::CONSTANT_COMPOSITE, ty, &[zero, zero, zero, one])
}
