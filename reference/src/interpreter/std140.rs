//! Where the parts of a block of uniforms lie: OpenGL's layout `std140` (section 7.6.2.2 of its specification).

use super::types::{Scalar, Type};

/// Alignment of structures, array elements and columns of matrices, in bytes.
const ALIGNMENT: u32 = 16;

/// How many bytes a type takes, and what its place is a multiple of.
struct Room {
    size: u32,
    alignment: u32,
}

/// Where each scalar, vector and matrix of a block begins, in bytes: part by part, in the order of the members.
pub fn offsets(members: &[(String, Type)]) -> Vec<u32> {
    let mut found = Vec::new();
    place_members(members, 0, &mut found);
    found
}

/// Where each number of a scalar, vector or matrix lies behind its beginning, in bytes: those of a matrix column by column.
pub fn numbers(kind: &Type) -> Vec<u32> {
    let (Some(each), Some(count)) = (kind.scalar().map(bytes), kind.slots()) else { return Vec::new() };
    let (rows, stride) = match kind {
        Type::Matrix(scalar, _, rows) => (u32::from(*rows), column(*scalar, *rows).alignment),
        _ => (count as u32, 0),
    };
    (0..count as u32).map(|number| number / rows * stride + number % rows * each).collect()
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

fn room(kind: &Type) -> Room {
    match kind {
        Type::Vector(scalar, count) => vector(*scalar, *count),
        Type::Matrix(scalar, columns, rows) => {
            let Room { alignment, .. } = column(*scalar, *rows);
            Room { size: alignment * u32::from(*columns), alignment }
        }
        Type::Array(element, length) => {
            let (stride, alignment) = elements(element);
            Room { size: stride.saturating_mul(length.unwrap_or(1) as u32), alignment }
        }
        Type::Struct(structure) => {
            let (mut end, mut alignment) = (0_u32, ALIGNMENT);
            for (_, member) in &structure.members {
                let own = room(member);
                end = end.next_multiple_of(own.alignment).saturating_add(own.size);
                alignment = alignment.max(own.alignment);
            }
            Room { size: end.next_multiple_of(alignment), alignment }
        }
        _ => Room { size: 4, alignment: 4 },
    }
}

/// Bytes from one element of an array to the next, and the alignment of the array.
fn elements(element: &Type) -> (u32, u32) {
    let Room { size, alignment } = room(element);
    let alignment = alignment.max(ALIGNMENT);
    (size.next_multiple_of(alignment), alignment)
}

fn place_members(members: &[(String, Type)], start: u32, found: &mut Vec<u32>) {
    let mut end = start;
    for (_, member) in members {
        let Room { size, alignment } = room(member);
        let own = end.next_multiple_of(alignment);
        place(member, own, found);
        end = own.saturating_add(size);
    }
}

fn place(kind: &Type, start: u32, found: &mut Vec<u32>) {
    match kind {
        Type::Struct(structure) => place_members(&structure.members, start, found),
        Type::Array(element, length) => {
            let (stride, _) = elements(element);
            (0..length.unwrap_or(1) as u32).for_each(|index| place(element, start + index * stride, found));
        }
        _ => found.push(start),
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
    fn numbers_of_a_matrix_lie_in_columns_of_16_bytes() {
        use crate::interpreter::Type;
        assert_eq!(super::numbers(&Type::VEC3), [0, 4, 8]);
        assert_eq!(super::numbers(&Type::named("mat2").expect("a type")), [0, 4, 16, 20]);
        assert_eq!(super::numbers(&Type::named("mat2x3").expect("a type")), [0, 4, 8, 16, 20, 24]);
    }
}
