//! What a shader reads of a texture, by the reference's own sampler.

use super::Value;
use crate::translate::spirv::op;
use reference::interpreter::{Lookup, Texture};

/// Image operands that are known (SPIR-V specification, section 3.14); they follow in this order.
const BIAS: u32 = 1;
const LOD: u32 = 2;
const CONST_OFFSET: u32 = 8;

/// The four numbers that a lookup gives. `operands`: which of the image operands there are; `operand`: the value of one, by its
/// number from 1. None for what is not known here: gradients, comparisons, layers beyond the first level.
pub(super) fn read(
    textures: &[Texture],
    opcode: u16,
    sampler: &Value,
    coordinates: &Value,
    operands: Option<u32>,
    operand: &dyn Fn(usize) -> Option<Value>,
) -> Option<Value> {
    let texture = textures.get(sampler.float().filter(|number| *number >= 0.0)? as usize)?;
    let operands = operands.unwrap_or(0);
    if operands & !(BIAS | LOD | CONST_OFFSET) != 0 || texture.compare.is_some() {
        return None;
    }
    let mut next = 0;
    let mut given = |flag: u32| {
        next += usize::from(operands & flag != 0);
        (operands & flag != 0).then(|| operand(next))
    };
    let level = [given(BIAS), given(LOD)].into_iter().flatten().next();
    let offset = given(CONST_OFFSET);
    let whole = |value: Value| -> Option<Vec<f64>> {
        let parts = value.parts().map_or_else(|| vec![value.clone()], <[Value]>::to_vec);
        parts.iter().map(|part| part.int().map(|bits| f64::from(bits as i32))).collect()
    };
    let mut lookup = Lookup::default();
    if let Some(offset) = offset {
        lookup.offset.iter_mut().zip(whole(offset?)?).for_each(|(to, from)| *to = from);
    }
    let found = match opcode {
        op::IMAGE_FETCH => {
            lookup.coordinates.iter_mut().zip(whole(coordinates.clone())?).for_each(|(to, from)| *to = from);
            lookup.level = level.map_or(Some(0.0), |level| whole(level?)?.first().copied())?;
            texture.fetch(&lookup)?
        }
        // Without levels, what is near and what is far is read alike.
        op::IMAGE_SAMPLE_IMPLICIT_LOD | op::IMAGE_SAMPLE_EXPLICIT_LOD
            if texture.levels.len() == 1 && texture.magnify == texture.minify =>
        {
            lookup.coordinates.iter_mut().zip(coordinates.floats()?).for_each(|(to, from)| *to = from);
            texture.sample(&lookup)
        }
        _ => return None,
    };
    Some(Value::of_floats(&found))
}
