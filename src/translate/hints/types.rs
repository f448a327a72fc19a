//! Numeric types, by name and in the compiler's phrases.

use super::vocabulary;
use std::fmt;

/// A scalar, vector or matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numeric {
    /// `f` float, `d` double, `i` int, `u` uint, `b` bool.
    pub base: char,
    /// Columns of a matrix, otherwise 1.
    pub columns: u8,
    /// Components of a vector or of a matrix's column; 1 for a scalar.
    pub rows: u8,
}

impl Numeric {
    pub const FLOAT: Self = Self { base: 'f', columns: 1, rows: 1 };

    /// Whether it is a vector.
    pub fn is_vector(self) -> bool {
        self.columns == 1 && self.rows > 1
    }

    /// Whether it is a scalar.
    pub fn is_scalar(self) -> bool {
        self.columns == 1 && self.rows == 1
    }

    /// The numeric type called `name`.
    pub fn named(name: &str) -> Option<Self> {
        if !vocabulary::is_type(name) {
            return None;
        }
        let scalar = |base| Some(Self { base, ..Self::FLOAT });
        match name {
            "float" => return scalar('f'),
            "double" => return scalar('d'),
            "int" => return scalar('i'),
            "uint" => return scalar('u'),
            "bool" => return scalar('b'),
            _ => {}
        }
        let (base, shape) = match name.strip_prefix(['d', 'i', 'u', 'b']) {
            Some(rest) => (name.chars().next()?, rest),
            None => ('f', name),
        };
        let digit = |text: &str| text.parse::<u8>().ok();
        if let Some(size) = shape.strip_prefix("vec") {
            return Some(Self { base, columns: 1, rows: digit(size)? });
        }
        let size = shape.strip_prefix("mat")?;
        let (columns, rows) = size.split_once('x').unwrap_or((size, size));
        Some(Self { base, columns: digit(columns)?, rows: digit(rows)? })
    }

    pub fn with_base_of(self, other: Self) -> Self {
        let rank = |base| "biufd".find(base).unwrap_or(0);
        if rank(other.base) > rank(self.base) { Self { base: other.base, ..self } } else { self }
    }
}

impl fmt::Display for Numeric {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = if self.base == 'f' { String::new() } else { self.base.to_string() };
        match (self.base, self.columns, self.rows) {
            ('f', 1, 1) => out.write_str("float"),
            ('d', 1, 1) => out.write_str("double"),
            ('i', 1, 1) => out.write_str("int"),
            ('u', 1, 1) => out.write_str("uint"),
            (_, 1, 1) => out.write_str("bool"),
            (_, 1, rows) => write!(out, "{prefix}vec{rows}"),
            (_, columns, rows) if columns == rows => write!(out, "{prefix}mat{rows}"),
            (_, columns, rows) => write!(out, "{prefix}mat{columns}x{rows}"),
        }
    }
}

/// The GLSL name of a type that the compiler puts in words, such as ` temp 3-component vector of float`.
pub fn from_phrase(phrase: &str) -> String {
    if phrase.contains("structure{") || phrase.contains("block{") {
        return "struct".to_owned();
    }
    if let Some((_, element)) = phrase.split_once("-element array of") {
        return format!("{}[]", from_phrase(element));
    }
    let words: Vec<_> = phrase.split_ascii_whitespace().collect();
    let scalar = words.iter().rev().find_map(|word| Numeric::named(word).filter(|ty| ty.is_scalar()));
    let Some(scalar) = scalar else {
        return words.last().map_or_else(String::new, |word| (*word).to_owned());
    };
    let sized = words.iter().enumerate().find_map(|(index, word)| {
        if let Some(rows) = word.strip_suffix("-component") {
            return Some(Numeric { rows: rows.parse().ok()?, ..scalar });
        }
        let (columns, rows) = word.split_once('X').filter(|_| words.get(index + 1) == Some(&"matrix"))?;
        Some(Numeric { columns: columns.parse().ok()?, rows: rows.parse().ok()?, ..scalar })
    });
    sized.unwrap_or(scalar).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_phrases_of_the_compiler() {
        for (phrase, name) in [
            (" temp 3-component vector of float", "vec3"),
            (" const float", "float"),
            (" smooth out 4-component vector of float", "vec4"),
            (" uniform 4X4 matrix of float", "mat4"),
            (" temp 2X3 matrix of double", "dmat2x3"),
            (" gl_Position 4-component vector of float Position", "vec4"),
            (" temp structure{ temp float a}", "struct"),
            (" temp 3-element array of 2-component vector of int", "ivec2[]"),
            (" temp bool", "bool"),
            (" uniform sampler2D", "sampler2D"),
        ] {
            assert_eq!(from_phrase(phrase), name, "{phrase}");
        }
    }
}
