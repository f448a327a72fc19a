//! The uniforms of a draw, set by path: each by itself, or as bytes of its block.

use super::{UniformValue, ValueKind, bytes};
use crate::ffi::opengl::{Driver, LinkedProgram};
use glow::HasContext;

impl Driver {
    /// Sets uniforms by path, those of blocks as well; gives the buffers of the blocks.
    pub(super) fn set_values(&self, program: LinkedProgram, uniforms: &[UniformValue]) -> Vec<glow::Buffer> {
        let gl = self.gl();
        let name = program.name();
        let mut blocks: Vec<Vec<u8>> = Vec::new();
        // SAFETY: see `scene`. A path that the program does not have is skipped.
        unsafe {
            let active: Vec<String> = (0..gl.get_active_uniforms(name))
                .map(|index| gl.get_active_uniform(name, index).map(|uniform| uniform.name).unwrap_or_default())
                .collect();
            for (path, kind, numbers) in uniforms {
                if let Some(location) = gl.get_uniform_location(name, path) {
                    self.set_value(&location, *kind, numbers);
                    continue;
                }
                let listed = active_element(&active, path).map(|found| (found, None));
                let of_several = || {
                    let (block, member) = member_of_several(path)?;
                    Some((active_element(&active, &member)?, gl.get_uniform_block_index(name, block)))
                };
                let Some(((index, element), own_block)) = listed.or_else(of_several) else { continue };
                let of = |what| gl.get_active_uniforms_parameter(name, &[index as u32], what)[0];
                let (block, offset, stride) =
                    (of(glow::UNIFORM_BLOCK_INDEX), of(glow::UNIFORM_OFFSET), of(glow::UNIFORM_MATRIX_STRIDE));
                let block = own_block.map_or(block, |own| own as i32);
                let (Ok(block), Ok(offset)) = (usize::try_from(block), usize::try_from(offset)) else { continue };
                let offset = offset + element * usize::try_from(of(glow::UNIFORM_ARRAY_STRIDE)).unwrap_or_default();
                let is_row_major = of(glow::UNIFORM_IS_ROW_MAJOR) != 0;
                let size = gl.get_active_uniform_block_parameter_i32(name, block as u32, glow::UNIFORM_BLOCK_DATA_SIZE);
                blocks.resize_with(blocks.len().max(block + 1), Vec::new);
                blocks[block].resize(usize::try_from(size).expect("a size"), 0);
                let (rows, stride) = match kind {
                    ValueKind::Matrix(_, rows) => (usize::from(*rows), usize::try_from(stride).expect("a stride")),
                    _ => (numbers.len(), 0),
                };
                let (rows, numbers) = match is_row_major {
                    true => (numbers.len() / rows, transposed(numbers, rows)),
                    false => (rows, numbers.clone()),
                };
                for (column, numbers) in numbers.chunks(rows).enumerate() {
                    let bytes = bytes(*kind, numbers);
                    let at = offset + column * stride;
                    blocks[block][at..at + bytes.len()].copy_from_slice(&bytes);
                }
            }
            blocks
                .into_iter()
                .zip(0..)
                .map(|(bytes, number)| {
                    let buffer = gl.create_buffer().expect("a buffer");
                    gl.bind_buffer(glow::UNIFORM_BUFFER, Some(buffer));
                    gl.buffer_data_u8_slice(glow::UNIFORM_BUFFER, &bytes, glow::STATIC_DRAW);
                    gl.uniform_block_binding(name, number, number);
                    gl.bind_buffer_base(glow::UNIFORM_BUFFER, number, Some(buffer));
                    buffer
                })
                .collect()
        }
    }

    fn set_value(&self, location: &glow::UniformLocation, kind: ValueKind, numbers: &[f64]) {
        let gl = self.gl();
        let at = Some(location);
        let floats: Vec<f32> = numbers.iter().map(|number| *number as f32).collect();
        let ints: Vec<i32> = numbers.iter().map(|number| *number as i32).collect();
        let uints: Vec<u32> = numbers.iter().map(|number| *number as u32).collect();
        // SAFETY: see `scene`. Each slice has the numbers of one value.
        unsafe {
            match kind {
                ValueKind::Float(1) => gl.uniform_1_f32_slice(at, &floats),
                ValueKind::Float(2) => gl.uniform_2_f32_slice(at, &floats),
                ValueKind::Float(3) => gl.uniform_3_f32_slice(at, &floats),
                ValueKind::Float(_) => gl.uniform_4_f32_slice(at, &floats),
                ValueKind::Int(1) | ValueKind::Bool(1) => gl.uniform_1_i32_slice(at, &ints),
                ValueKind::Int(2) | ValueKind::Bool(2) => gl.uniform_2_i32_slice(at, &ints),
                ValueKind::Int(3) | ValueKind::Bool(3) => gl.uniform_3_i32_slice(at, &ints),
                ValueKind::Int(_) | ValueKind::Bool(_) => gl.uniform_4_i32_slice(at, &ints),
                ValueKind::Uint(1) => gl.uniform_1_u32_slice(at, &uints),
                ValueKind::Uint(2) => gl.uniform_2_u32_slice(at, &uints),
                ValueKind::Uint(3) => gl.uniform_3_u32_slice(at, &uints),
                ValueKind::Uint(_) => gl.uniform_4_u32_slice(at, &uints),
                ValueKind::Matrix(2, 2) => gl.uniform_matrix_2_f32_slice(at, false, &floats),
                ValueKind::Matrix(3, 3) => gl.uniform_matrix_3_f32_slice(at, false, &floats),
                ValueKind::Matrix(4, 4) => gl.uniform_matrix_4_f32_slice(at, false, &floats),
                ValueKind::Matrix(2, 3) => gl.uniform_matrix_2x3_f32_slice(at, false, &floats),
                ValueKind::Matrix(2, _) => gl.uniform_matrix_2x4_f32_slice(at, false, &floats),
                ValueKind::Matrix(3, 2) => gl.uniform_matrix_3x2_f32_slice(at, false, &floats),
                ValueKind::Matrix(3, _) => gl.uniform_matrix_3x4_f32_slice(at, false, &floats),
                ValueKind::Matrix(_, 2) => gl.uniform_matrix_4x2_f32_slice(at, false, &floats),
                ValueKind::Matrix(..) => gl.uniform_matrix_4x3_f32_slice(at, false, &floats),
            }
        }
    }
}

/// The place of a path among the names that the driver lists, and the number of its element: of an array of a basic type the
/// driver lists the first element alone.
fn active_element(active: &[String], path: &str) -> Option<(usize, usize)> {
    if let Some(index) = active.iter().position(|own| own == path) {
        return Some((index, 0));
    }
    let (array, element) = path.strip_suffix(']')?.rsplit_once('[')?;
    let first = format!("{array}[0]");
    Some((active.iter().position(|own| *own == first)?, element.parse().ok()?))
}

/// The name of a block that is one of an array, and the member as the driver lists it, which does so once for all of them.
fn member_of_several(path: &str) -> Option<(&str, String)> {
    let (block, member) = path.split_once('.')?;
    let (name, _) = block.strip_suffix(']')?.split_once('[')?;
    Some((block, format!("{name}.{member}")))
}

/// Columns of so many rows as rows.
fn transposed(numbers: &[f64], rows: usize) -> Vec<f64> {
    (0..rows).flat_map(|row| numbers.iter().skip(row).step_by(rows).copied()).collect()
}
