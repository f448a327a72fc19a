//! What a test draws, as meshes.

use crate::interpreter::{Scalar, Type};

/// What is drawn at once.
pub(super) enum TestDraw {
    /// x, y, width and height in clip space.
    Rectangle([f64; 4]),
    /// Rows of the vertex data.
    Arrays { mode: Primitive, first: u32, count: u32 },
}

/// How rows become triangles.
#[derive(Clone, Copy)]
pub(super) enum Primitive {
    Triangles,
    Strip,
    Fan,
    Quads,
}

pub(super) fn primitive(name: &str) -> Option<Primitive> {
    Some(match name {
        "GL_TRIANGLES" => Primitive::Triangles,
        "GL_TRIANGLE_STRIP" => Primitive::Strip,
        "GL_TRIANGLE_FAN" => Primitive::Fan,
        "GL_QUADS" => Primitive::Quads,
        _ => return None,
    })
}

/// A number of a test: decimal, hexadecimal, `inf` excluded.
pub(super) fn number(word: &str) -> Option<f64> {
    let word = word.trim_matches(['(', ')', ',']);
    let hexadecimal = word.strip_prefix("0x").and_then(|digits| u32::from_str_radix(digits, 16).ok());
    hexadecimal.map(f64::from).or_else(|| word.parse().ok()).filter(|number: &f64| number.is_finite())
}

/// A number as GLSL has it.
pub(super) fn literal(value: f64, kind: &Type) -> String {
    match kind.scalar() {
        Some(Scalar::Int) => format!("{value}"),
        Some(Scalar::Uint) => format!("{value}u"),
        Some(Scalar::Bool) => (value != 0.0).to_string(),
        _ => format!("{value:?}"),
    }
}

/// The attributes of the vertices, row by row.
#[derive(Default)]
pub(super) struct VertexData {
    /// Names, and how many numbers each has.
    columns: Vec<(String, usize)>,
    rows: Vec<Vec<f64>>,
}

impl VertexData {
    /// Reads a line; an error is what is not known.
    pub fn line(&mut self, line: &str) -> Result<(), String> {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.is_empty() {
            return Ok(());
        }
        if self.columns.is_empty() {
            self.columns = words.iter().map(|word| column(word)).collect::<Result<_, _>>()?;
            return Ok(());
        }
        let wanted: usize = self.columns.iter().map(|(_, count)| count).sum();
        let row: Option<Vec<f64>> = words.iter().map(|word| number(word)).collect();
        match row.filter(|row| row.len() == wanted) {
            Some(row) => self.rows.push(row),
            None => return Err(line.trim().to_owned()),
        }
        Ok(())
    }

    fn column(&self, at: usize) -> impl Iterator<Item = &[f64]> {
        let first: usize = self.columns[..at].iter().map(|(_, count)| count).sum();
        let count = self.columns[at].1;
        self.rows.iter().map(move |row| &row[first..first + count])
    }

    /// An attribute as a list, each value of as many numbers as the shader's type has; what is not written is as OpenGL has it.
    pub fn attribute(&self, name: &str, count: usize) -> Option<String> {
        let at = self.columns.iter().position(|(known, _)| known == name)?;
        let number = |row: &[f64], at: usize| row.get(at).copied().unwrap_or(if at == 3 { 1.0 } else { 0.0 });
        let whole = |row: &[f64]| -> Vec<f64> { (0..count).map(|at| number(row, at)).collect() };
        let rows: Vec<String> = self.column(at).map(|row| list(&whole(row))).collect();
        Some(format!("[{}]", rows.join(", ")))
    }

    /// The positions: the first attribute that can be one.
    fn positions(&self) -> Vec<[f64; 3]> {
        let Some(at) = self.columns.iter().position(|(_, count)| *count >= 2) else {
            return vec![[0.0; 3]; self.rows.len()];
        };
        let point = |numbers: &[f64]| [numbers[0], numbers[1], numbers.get(2).copied().unwrap_or(0.0)];
        self.column(at).map(point).collect()
    }
}

/// `name/vec3`, `name/float/3`, `name/float/vec3`.
fn column(word: &str) -> Result<(String, usize), String> {
    let mut parts = word.split('/');
    let (Some(name), Some(kind)) = (parts.next(), parts.next()) else { return Err(word.to_owned()) };
    let last = parts.next();
    let known = Type::named(last.unwrap_or(kind)).and_then(|kind| kind.slots()).filter(|count| (1..=4).contains(count));
    let counted = last.and_then(|last| last.parse().ok()).filter(|count| (1..=4).contains(count));
    match (known.or(counted), parts.next()) {
        (Some(count), None) => Ok((name.to_owned(), count)),
        _ => Err(word.to_owned()),
    }
}

fn list(numbers: &[f64]) -> String {
    let each: Vec<String> = numbers.iter().map(|number| format!("{number:?}")).collect();
    if each.len() == 1 { each[0].clone() } else { format!("[{}]", each.join(", ")) }
}

impl TestDraw {
    /// The mesh as TOML.
    pub fn mesh(&self, data: &VertexData) -> String {
        let (positions, triangles) = match self {
            Self::Rectangle([x, y, width, height]) => {
                let (right, top) = (x + width, y + height);
                (vec![[*x, *y, 0.0], [right, *y, 0.0], [right, top, 0.0], [*x, top, 0.0]], vec![[0, 1, 2], [0, 2, 3]])
            }
            Self::Arrays { mode, first, count } => (data.positions(), triangles(*mode, *first, *count)),
        };
        let positions: Vec<_> = positions.iter().map(|point| list(point)).collect();
        let triangles: Vec<_> = triangles.iter().map(|[a, b, c]| format!("[{a}, {b}, {c}]")).collect();
        format!("{{ vertices = {{ positions = [{}], triangles = [{}] }} }}", positions.join(", "), triangles.join(", "))
    }
}

fn triangles(mode: Primitive, first: u32, count: u32) -> Vec<[u32; 3]> {
    let all = match mode {
        Primitive::Triangles => (0..count / 3).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect(),
        Primitive::Strip => {
            (2..count).map(|at| if at % 2 == 0 { [at - 2, at - 1, at] } else { [at - 1, at - 2, at] }).collect()
        }
        Primitive::Fan => (2..count).map(|at| [0, at - 1, at]).collect(),
        Primitive::Quads => (0..count / 4)
            .flat_map(|at| [[4 * at, 4 * at + 1, 4 * at + 2], [4 * at, 4 * at + 2, 4 * at + 3]])
            .collect::<Vec<_>>(),
    };
    all.into_iter().map(|triangle: [u32; 3]| triangle.map(|at| at + first)).collect()
}
