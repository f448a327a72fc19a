//! Values → the bytes of uniform blocks, as one shader lays them out.

use super::scene::DrawCall;
use crate::translate::{UniformBlock, UniformMember};
use naga::{Scalar, ScalarKind, TypeInner, VectorSize};
use reference::interpreter::Type;
use std::collections::HashMap;

/// The bytes of one block for all batches, `stride` bytes each; what the program does not set is zero, as in OpenGL.
pub(super) fn fill(block: &UniformBlock, stride: usize, batches: &[&DrawCall]) -> Vec<u8> {
    let mut bytes = vec![0; stride * batches.len().max(1)];
    let members: HashMap<&str, &UniformMember> =
        block.members.iter().flat_map(|member| member.paths().map(move |path| (path, member))).collect();
    for (batch, chunk) in batches.iter().zip(bytes.chunks_mut(stride)) {
        for (path, value) in &batch.uniforms {
            set(&members, chunk, path, value.kind(), value.numbers());
        }
    }
    bytes
}

/// Writes a value, or each part of it that the shader has.
fn set(members: &HashMap<&str, &UniformMember>, bytes: &mut [u8], path: &str, kind: &Type, numbers: &[f64]) {
    match kind {
        Type::Struct(structure) => {
            let mut rest = numbers;
            for (name, kind) in &structure.members {
                let (own, others) = rest.split_at(kind.slots().unwrap_or(0).min(rest.len()));
                set(members, bytes, &format!("{path}.{name}"), kind, own);
                rest = others;
            }
        }
        Type::Array(element, _) => {
            let slots = element.slots().unwrap_or(0).max(1);
            for (index, own) in numbers.chunks(slots).enumerate() {
                set(members, bytes, &format!("{path}[{index}]"), element, own);
            }
        }
        _ => {
            // The columns of a matrix may lie in an array, and each number of a vector by itself.
            if !members.contains_key(path)
                && let Some((element, count)) = kind.element()
            {
                return set(members, bytes, path, &element.array(count), numbers);
            }
            // An array without an index is its first element.
            let member = members.get(path).copied().or_else(|| members.get(format!("{path}[0]").as_str()).copied());
            if let Some(place) = member.and_then(|member| Some((member, bytes.get_mut(member.offset as usize..)?))) {
                write(&place.0.ty, numbers, place.1);
            }
        }
    }
}

/// Writes the numbers of a scalar, vector or matrix. A column of three takes the room of four.
fn write(ty: &TypeInner, numbers: &[f64], bytes: &mut [u8]) {
    match *ty {
        TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. } => {
            let each = bytes.chunks_exact_mut(usize::from(scalar.width)).zip(numbers);
            let size = if let TypeInner::Vector { size, .. } = ty { *size as usize } else { 1 };
            each.take(size).for_each(|(place, number)| write_number(scalar, *number, place));
        }
        TypeInner::Matrix { columns, rows, scalar } => {
            let room = if rows == VectorSize::Tri { 4 } else { rows as usize };
            let stride = room * usize::from(scalar.width);
            let columns = bytes.chunks_exact_mut(stride).zip(numbers.chunks(rows as usize)).take(columns as usize);
            for (column, numbers) in columns {
                write(&TypeInner::Vector { size: rows, scalar }, numbers, column);
            }
        }
        _ => {}
    }
}

fn write_number(scalar: Scalar, number: f64, place: &mut [u8]) {
    match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 8) => place.copy_from_slice(&number.to_ne_bytes()),
        (ScalarKind::Float, _) => place.copy_from_slice(&(number as f32).to_ne_bytes()),
        (ScalarKind::Sint, _) => place.copy_from_slice(&(number as i32).to_ne_bytes()),
        // What has a sign has it in the bits.
        _ => place.copy_from_slice(&(number as i64 as u32).to_ne_bytes()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use reference::Value;

    const F32: Scalar = Scalar::F32;

    fn block(members: &[(&str, u32, TypeInner)]) -> UniformBlock {
        let member = |(path, offset, ty): &(&str, u32, TypeInner)| UniformMember {
            path: (*path).into(),
            offset: *offset,
            ty: ty.clone(),
            alias: None,
        };
        UniformBlock {
            name: String::new(),
            binding: 0,
            size: 256,
            is_default: true,
            members: members.iter().map(member).collect(),
        }
    }

    fn filled(block: &UniformBlock, uniforms: &[(&str, Type, &[f64])]) -> Vec<u32> {
        let value = |(path, kind, numbers): &(&str, Type, &[f64])| {
            ((*path).into(), Value::new(kind.clone(), numbers.to_vec()).expect("as many numbers as the type has"))
        };
        let batch = DrawCall { uniforms: uniforms.iter().map(value).collect(), ..DrawCall::default() };
        bytemuck::pod_collect_to_vec(&fill(block, 256, &[&batch]))
    }

    #[test]
    fn columns_of_three_have_the_room_of_four() {
        let ty = TypeInner::Matrix { columns: VectorSize::Tri, rows: VectorSize::Tri, scalar: F32 };
        let kind = Type::named("mat3").unwrap();
        let words = filled(&block(&[("m", 16, ty)]), &[("m", kind, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])]);
        let floats: Vec<f32> = words[4..16].iter().map(|word| f32::from_bits(*word)).collect();
        assert_eq!(floats, [1.0, 2.0, 3.0, 0.0, 4.0, 5.0, 6.0, 0.0, 7.0, 8.0, 9.0, 0.0]);
    }

    #[test]
    fn parts_are_set_by_path_and_whole_values_part_by_part() {
        let vec3 = TypeInner::Vector { size: VectorSize::Tri, scalar: F32 };
        let block = block(&[
            ("l[0].on", 0, TypeInner::Scalar(Scalar::U32)),
            ("l[0].at", 16, vec3.clone()),
            ("l[1].on", 32, TypeInner::Scalar(Scalar::U32)),
            ("l[1].at", 48, vec3),
            ("count", 64, TypeInner::Scalar(Scalar::I32)),
        ]);
        let vec3 = Type::named("vec3").unwrap();
        let members =
            vec![("on".to_owned(), Type::BOOL), ("gone".to_owned(), Type::FLOAT), ("at".to_owned(), vec3.clone())];
        let light = Type::Struct(std::sync::Arc::new(reference::interpreter::Struct::new("L".into(), 0, members)));
        let whole: &[f64] = &[1.0, 9.0, 2.0, 3.0, 4.0, 0.0, 9.0, 5.0, 6.0, 7.0];
        let words = filled(
            &block,
            &[
                ("l", light.array(Some(2)), whole),
                ("l[1].at", vec3, &[-1.0, -2.0, -3.0]),
                ("count", Type::INT, &[-4.0]),
            ],
        );
        let float = |at: usize| f32::from_bits(words[at]);
        assert_eq!((words[0], words[8]), (1, 0));
        assert_eq!([4, 5, 6].map(float), [2.0, 3.0, 4.0]);
        assert_eq!([12, 13, 14].map(float), [-1.0, -2.0, -3.0]);
        assert_eq!(words[16].cast_signed(), -4);
    }
}
