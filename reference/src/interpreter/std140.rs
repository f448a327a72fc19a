//! Where the parts of a block of uniforms lie: OpenGL's layout `std140` (section 7.6.2.2 of its specification).

use super::types::{Scalar, Type};

/// Alignment of structures, array elements and columns of matrices, in bytes.
const ALIGNMENT: u32 = 16;

/// A member of a block, and what layouts say of it.
#[derive(Clone, Debug)]
pub struct BlockMember {
    /// Its type.
    pub kind: Type,
    /// `layout(offset = …)`.
    pub offset: Option<u32>,
    /// `layout(align = …)`.
    pub align: Option<u32>,
    /// Whether the rows of its matrices lie before their columns.
    pub is_row_major: bool,
}

/// How many bytes a type takes, and what its place is a multiple of.
struct Room {
    size: u32,
    alignment: u32,
}

/// Where each scalar, vector and matrix of a block begins, in bytes, and whether it is a matrix whose rows lie before its columns: part by
/// part, in the order of the members. Their rules are those of GLSL 4.40, section 4.4.5, where a layout says more than the types.
pub fn places(members: &[BlockMember]) -> Vec<(u32, bool)> {
    let mut found = Vec::new();
    let mut end = 0;
    for member in members {
        let Room { size, alignment } = room(&member.kind, member.is_row_major);
        let alignment = alignment.max(member.align.unwrap_or(1)).max(1);
        let own = member.offset.unwrap_or(end).next_multiple_of(alignment);
        place(&member.kind, own, member.is_row_major, &mut found);
        end = own.saturating_add(size);
    }
    found
}

/// Where each number of a scalar, vector or matrix lies behind its beginning, in bytes: those of a matrix column by column.
pub fn numbers(kind: &Type, is_row_major: bool) -> Vec<u32> {
    let (Some(each), Some(count)) = (kind.scalar().map(bytes), kind.slots()) else { return Vec::new() };
    let [rows, of_column, of_row] = match *kind {
        Type::Matrix(scalar, columns, rows) if is_row_major => {
            [u32::from(rows), each, column(scalar, columns).alignment]
        }
        Type::Matrix(scalar, _, rows) => [u32::from(rows), column(scalar, rows).alignment, each],
        _ => [count as u32, 0, each],
    };
    (0..count as u32).map(|number| number / rows * of_column + number % rows * of_row).collect()
}

fn bytes(scalar: Scalar) -> u32 {
    if scalar == Scalar::Double { 8 } else { 4 }
}

fn vector(scalar: Scalar, count: u8) -> Room {
    let padded = if count == 3 { 4 } else { u32::from(count) };
    Room { size: bytes(scalar) * u32::from(count), alignment: bytes(scalar) * padded }
}

fn column(scalar: Scalar, rows: u8) -> Room {
    let Room { size, alignment } = vector(scalar, rows);
    Room { size, alignment: alignment.max(ALIGNMENT) }
}

fn room(kind: &Type, is_row_major: bool) -> Room {
    match kind {
        Type::Vector(scalar, count) => vector(*scalar, *count),
        Type::Matrix(scalar, columns, rows) => {
            let [count, length] = if is_row_major { [*rows, *columns] } else { [*columns, *rows] };
            let Room { alignment, .. } = column(*scalar, length);
            Room { size: alignment * u32::from(count), alignment }
        }
        Type::Array(element, length) => {
            let (stride, alignment) = elements(element, is_row_major);
            Room { size: stride.saturating_mul(length.unwrap_or(1) as u32), alignment }
        }
        Type::Struct(structure) => {
            let (mut end, mut alignment) = (0_u32, ALIGNMENT);
            for (_, member) in &structure.members {
                let own = room(member, is_row_major);
                end = end.next_multiple_of(own.alignment).saturating_add(own.size);
                alignment = alignment.max(own.alignment);
            }
            Room { size: end.next_multiple_of(alignment), alignment }
        }
        _ => Room { size: 4, alignment: 4 },
    }
}

/// Bytes from one element of an array to the next, and the alignment of the array.
fn elements(element: &Type, is_row_major: bool) -> (u32, u32) {
    let Room { size, alignment } = room(element, is_row_major);
    let alignment = alignment.max(ALIGNMENT);
    (size.next_multiple_of(alignment), alignment)
}

fn place(kind: &Type, start: u32, is_row_major: bool, found: &mut Vec<(u32, bool)>) {
    match kind {
        Type::Struct(structure) => {
            let mut end = start;
            for (_, member) in &structure.members {
                let Room { size, alignment } = room(member, is_row_major);
                let own = end.next_multiple_of(alignment);
                place(member, own, is_row_major, found);
                end = own.saturating_add(size);
            }
        }
        Type::Array(element, length) => {
            let (stride, _) = elements(element, is_row_major);
            (0..length.unwrap_or(1) as u32)
                .for_each(|index| place(element, start + index * stride, is_row_major, found));
        }
        _ => found.push((start, is_row_major && matches!(kind, Type::Matrix(..)))),
    }
}

#[cfg(test)]
mod tests {
    use crate::interpreter::{Program, Stage};

    /// The paths of a block's parts with their places, as the interpreter has them.
    fn places(block: &str) -> Vec<(String, u32)> {
        let text = format!("#version 410\n{block}\nout vec4 c; void main() {{ c = vec4(0.0); }}");
        let program = Program::compile(&text, Stage::Fragment).expect(block);
        let place =
            |own: &crate::interpreter::ProgramVariable| (own.name.clone(), own.place.as_ref().expect("one").offset);
        program.uniforms().iter().map(place).collect()
    }

    #[test]
    fn parts_lie_where_the_example_of_the_specification_has_them() {
        // The example of section 7.6.2.2, with the offsets that its comments give.
        let found = places(
            "struct F { int d; bvec2 e; }; struct O { uvec3 j; vec2 k; float l[2]; vec2 m; mat3 n[2]; };\n\
             layout(std140) uniform Example { float a; vec2 b; vec3 c; F f; float g; float h[2]; mat2x3 i; O o[2]; };",
        );
        let at = |path: &str| found.iter().find(|(own, _)| own == path).map(|(_, offset)| *offset);
        for (path, offset) in [
            ("a", 0),
            ("b", 8),
            ("c", 16),
            ("f.d", 32),
            ("f.e", 40),
            ("g", 48),
            ("h[0]", 64),
            ("h[1]", 80),
            ("i", 96),
            ("o[0].j", 128),
            ("o[0].k", 144),
            ("o[0].l[0]", 160),
            ("o[0].l[1]", 176),
            ("o[0].m", 192),
            ("o[0].n[0]", 208),
            ("o[0].n[1]", 256),
            ("o[1].j", 304),
            ("o[1].n[1]", 432),
        ] {
            assert_eq!(at(path), Some(offset), "{path}");
        }
    }

    #[test]
    fn layouts_of_members_place_them() {
        // Rows of two numbers take 16 bytes each, as columns of three do: three rows, and two columns.
        let block =
            "layout(std140, row_major) uniform B { mat2x3 a; float b; layout(column_major) mat2x3 c; float d; };";
        let found: Vec<u32> = places(block).into_iter().map(|(_, offset)| offset).collect();
        assert_eq!(found, [0, 48, 64, 96]);
        let block =
            "layout(std140) uniform B { float a; layout(offset = 32) float b; layout(align = 64) float c; float d; };";
        let found: Vec<u32> = places(block).into_iter().map(|(_, offset)| offset).collect();
        assert_eq!(found, [0, 32, 64, 68]);
    }

    #[test]
    fn numbers_of_a_matrix_lie_in_columns_of_16_bytes() {
        use crate::interpreter::Type;
        assert_eq!(super::numbers(&Type::VEC3, false), [0, 4, 8]);
        assert_eq!(super::numbers(&Type::named("mat2").expect("a type"), false), [0, 4, 16, 20]);
        assert_eq!(super::numbers(&Type::named("mat2x3").expect("a type"), false), [0, 4, 8, 16, 20, 24]);
        // Three rows of two numbers, 16 bytes each.
        assert_eq!(super::numbers(&Type::named("mat2x3").expect("a type"), true), [0, 16, 32, 4, 20, 36]);
    }
}
