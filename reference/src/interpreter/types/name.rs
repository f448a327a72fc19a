//! The names of types, read and written.

use super::{Dimension, Sampler, Scalar, Type};
use std::fmt;

impl Type {
    /// The built-in type with this name.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "void" => Self::Void,
            "bool" => Self::BOOL,
            "int" => Self::INT,
            "uint" => Self::UINT,
            "float" => Self::FLOAT,
            "double" => Self::DOUBLE,
            _ => return vector(name).or_else(|| matrix(name)).or_else(|| sampler(name).map(Self::Sampler)),
        })
    }
}

fn vector(name: &str) -> Option<Type> {
    let (scalar, length) = name.split_once("vec")?;
    let scalar = match scalar {
        "" => Scalar::Float,
        "b" => Scalar::Bool,
        "i" => Scalar::Int,
        "u" => Scalar::Uint,
        "d" => Scalar::Double,
        _ => return None,
    };
    Some(Type::Vector(scalar, side(length)?))
}

fn matrix(name: &str) -> Option<Type> {
    let (scalar, sides) = name.split_once("mat")?;
    let scalar = match scalar {
        "" => Scalar::Float,
        "d" => Scalar::Double,
        _ => return None,
    };
    let (columns, rows) = sides.split_once('x').unwrap_or((sides, sides));
    Some(Type::Matrix(scalar, side(columns)?, side(rows)?))
}

fn side(text: &str) -> Option<u8> {
    match text {
        "2" => Some(2),
        "3" => Some(3),
        "4" => Some(4),
        _ => None,
    }
}

fn sampler(name: &str) -> Option<Sampler> {
    let (texel, rest) = name.split_once("sampler")?;
    let texel = match texel {
        "" => Scalar::Float,
        "i" => Scalar::Int,
        "u" => Scalar::Uint,
        _ => return None,
    };
    let (rest, shadow) = rest.strip_suffix("Shadow").map_or((rest, false), |rest| (rest, true));
    let (rest, array) = rest.strip_suffix("Array").map_or((rest, false), |rest| (rest, true));
    let dimension = match rest {
        "1D" => Dimension::One,
        "2D" => Dimension::Two,
        "3D" => Dimension::Three,
        "Cube" => Dimension::Cube,
        "2DRect" => Dimension::Rectangle,
        _ => return None,
    };
    Some(Sampler { dimension, array, shadow, texel })
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = |scalar: Scalar| match scalar {
            Scalar::Bool => "b",
            Scalar::Int => "i",
            Scalar::Uint => "u",
            Scalar::Float => "",
            Scalar::Double => "d",
        };
        match self {
            Self::Void => f.write_str("void"),
            Self::Vector(scalar, 1) => f.write_str(match scalar {
                Scalar::Bool => "bool",
                Scalar::Int => "int",
                Scalar::Uint => "uint",
                Scalar::Float => "float",
                Scalar::Double => "double",
            }),
            Self::Vector(scalar, n) => write!(f, "{}vec{n}", prefix(*scalar)),
            Self::Matrix(scalar, columns, rows) if columns == rows => write!(f, "{}mat{rows}", prefix(*scalar)),
            Self::Matrix(scalar, columns, rows) => write!(f, "{}mat{columns}x{rows}", prefix(*scalar)),
            Self::Array(element, Some(length)) => write!(f, "{element}[{length}]"),
            Self::Array(element, None) => write!(f, "{element}[]"),
            Self::Struct(structure) => f.write_str(&structure.name),
            Self::Sampler(Sampler { dimension, array, shadow, texel }) => {
                let dimension = match dimension {
                    Dimension::One => "1D",
                    Dimension::Two => "2D",
                    Dimension::Three => "3D",
                    Dimension::Cube => "Cube",
                    Dimension::Rectangle => "2DRect",
                };
                let suffix = |holds: bool, word| if holds { word } else { "" };
                let (array, shadow) = (suffix(*array, "Array"), suffix(*shadow, "Shadow"));
                write!(f, "{}sampler{dimension}{array}{shadow}", prefix(*texel))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_types_belong_together() {
        for name in "bool int uint float double vec2 bvec3 ivec4 uvec2 dvec3 mat2 mat3x4 mat4 dmat2x3 \
                     sampler2D isampler1DArray sampler2DRectShadow samplerCubeArrayShadow"
            .split(' ')
        {
            assert_eq!(Type::named(name).expect(name).to_string(), name);
        }
        assert_eq!(Type::named("mat3x3"), Type::named("mat3"));
        for name in ["vec5", "vec", "mat1", "imat3", "floats", "image2D"] {
            assert_eq!(Type::named(name), None, "{name}");
        }
    }
}
