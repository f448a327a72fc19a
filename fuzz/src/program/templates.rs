//! The expressions of each type: what the file calls its variables, and how larger ones are made of smaller ones.

/// The types of which there are expressions.
#[derive(Clone, Copy, PartialEq)]
pub enum Type {
    Bool,
    Int,
    Uint,
    Float,
    Vec2,
    Vec3,
    Vec4,
    Mat3,
    IVec3,
    UVec2,
    BVec3,
    Mat2x3,
    Double,
}

impl Type {
    /// The type that a letter stands for which stands alone in a template.
    pub fn of_letter(letter: char) -> Option<Self> {
        Some(match letter {
            'B' => Self::Bool,
            'I' => Self::Int,
            'U' => Self::Uint,
            'F' => Self::Float,
            '²' => Self::Vec2,
            '³' => Self::Vec3,
            '⁴' => Self::Vec4,
            'M' => Self::Mat3,
            'J' => Self::IVec3,
            'E' => Self::UVec2,
            'C' => Self::BVec3,
            'W' => Self::Mat2x3,
            'D' => Self::Double,
            _ => return None,
        })
    }
}

/// A variable of this type.
pub fn leaf(kind: Type) -> &'static str {
    match kind {
        Type::Bool => "b",
        Type::Int => "i",
        Type::Uint => "k",
        Type::Float => "u",
        Type::Vec2 => "d",
        Type::Vec3 => "n",
        Type::Vec4 => "q",
        Type::Mat3 => "m",
        Type::IVec3 => "j",
        Type::UVec2 => "e",
        Type::BVec3 => "c",
        Type::Mat2x3 => "w",
        Type::Double => "r",
    }
}

/// Expressions of this type; a letter that stands alone is an expression of its type, see [`Type::of_letter`].
pub fn templates(kind: Type) -> &'static [&'static str] {
    match kind {
        Type::Bool => &[
            "b",
            "(F < F)",
            "!B",
            "(B && B)",
            "(B || B)",
            "(B ^^ B)",
            "(I == I)",
            "any(lessThan(³, ³))",
            "isnan(F)",
            "true",
            "any(C)",
            "all(C)",
            "(³ == ³)",
            "(D < D)",
            "C.y",
        ],
        Type::Int => &[
            "i",
            "7",
            "(I + I)",
            "I / I",
            "I % I",
            "(I << 3)",
            "(I >> I)",
            "~I",
            "int(F)",
            "many[i + I]",
            "(B ? I : I)",
            "abs(I)",
            "made.a[i - I]",
            "-2147483648",
            "J.z",
            "findMSB(I)",
            "bitCount(U)",
            "bitfieldExtract(I, 3, 7)",
            "clamp(I, -5, 9)",
            "int(U)",
            "sign(I)",
            "made.a.length()",
            "(I ^ I)",
            "max(I, I)",
        ],
        Type::Uint => &[
            "k",
            "9u",
            "(U * U)",
            "U / U",
            "U % U",
            "(U ^ U)",
            "uint(I)",
            "floatBitsToUint(F)",
            "bitfieldReverse(U)",
            "E.y",
            "bitfieldInsert(U, U, 4, 9)",
            "(U >> 3u)",
            "packUnorm4x8(⁴)",
            "packUnorm2x16(²)",
            "(B ? U : U)",
        ],
        Type::Float => &[
            "u",
            "0.5",
            "(F + F)",
            "(F * F)",
            "F / F",
            "dot(³, ³)",
            "max(F, 0.0)",
            "pow(F, F)",
            "sqrt(F)",
            "mod(F, F)",
            "³.y",
            "⁴[i ^ I]",
            "length(²)",
            "float(I)",
            "g",
            "intBitsToFloat(I)",
            "(B ? F : F)",
            "determinant(M)",
            "(u += F)",
            "exp(F)",
            "fract(F)",
            "smoothstep(0.0, 1.0, F)",
            "clamp(F, -1.0, 1.0)",
            "atan(F, F)",
            "sign(F)",
            "step(F, F)",
            "inversesqrt(F)",
            "float(U)",
            "log2(F)",
            "sin(F)",
            "tanh(F)",
            "float(D)",
            "distance(³, ³)",
            "fma(F, F, F)",
            "ldexp(F, 3)",
            "roundEven(F)",
            "degrees(F)",
            "float(B)",
            "W[1].x",
        ],
        Type::Vec2 => &[
            "d",
            "vec2(F)",
            "vec2(F, F)",
            "³.zx",
            "(² * F)",
            "floor(²)",
            "min(², ²)",
            "modf(², d)",
            "(³ * W)",
            "unpackUnorm2x16(U)",
            "vec2(E)",
        ],
        Type::Vec3 => &[
            "n",
            "vec3(F)",
            "vec3(², F)",
            "normalize(³)",
            "cross(³, ³)",
            "reflect(³, ³)",
            "(M * ³)",
            "(³ + ³)",
            "mix(³, ³, F)",
            "clamp(³, 0.0, 1.0)",
            "⁴.wzy",
            "M[i + I]",
            "refract(³, ³, F)",
            "faceforward(³, ³, ³)",
            "(W * ²)",
            "vec3(J)",
            "mix(³, ³, C)",
            "exp2(³)",
            "vec3(C)",
        ],
        Type::Vec4 => &[
            "q",
            "vec4(³, F)",
            "(mc * ⁴)",
            "field[i + I]",
            "(⁴ - ⁴)",
            "vec4(², ²)",
            "pv",
            "step(⁴, ⁴)",
            "unpackUnorm4x8(U)",
        ],
        Type::IVec3 => {
            &["j", "ivec3(I)", "(J + J)", "ivec3(³)", "(J & J)", "max(J, J)", "J.zxy", "abs(J)", "ivec3(C)", "(J << 2)"]
        }
        Type::UVec2 => &["e", "uvec2(U, U)", "(E * E)", "floatBitsToUint(²)", "uvec2(J)", "(E | E)"],
        Type::BVec3 => {
            &["c", "lessThan(³, ³)", "greaterThanEqual(J, J)", "not(C)", "bvec3(J)", "equal(J, J)", "bvec3(B, B, B)"]
        }
        Type::Mat2x3 => {
            &["w", "mat2x3(F)", "(M * W)", "mat2x3(³, ³)", "(W + W)", "matrixCompMult(W, W)", "outerProduct(³, ²)"]
        }
        Type::Double => &["r", "double(F)", "(D * D)", "sqrt(D)", "max(D, D)", "0.1lf", "(D - D)"],
        Type::Mat3 => &["m", "mat3(F)", "(M * M)", "transpose(M)", "inverse(M)", "outerProduct(³, ³)", "mat3(mg)"],
    }
}

/// What only fragments have, besides.
pub fn of_fragments(kind: Type) -> &'static [&'static str] {
    match kind {
        Type::Bool => &["gl_FrontFacing"],
        Type::Float => &["dFdx(F)", "dFdy(F)", "fwidth(F)", "texture(picture, ²).x", "gl_FragCoord.x"],
        Type::Vec2 => &["dFdx(²)", "gl_FragCoord.xy", "vec2(textureSize(picture, 0))"],
        Type::Vec3 => &["dFdy(³)", "textureProj(picture, ³).zyx", "textureOffset(picture, ², ivec2(1, -2)).xyz"],
        Type::Vec4 => &[
            "texture(picture, ²)",
            "textureLod(picture, ², F)",
            "textureGrad(picture, ², ², ²)",
            "texelFetch(picture, ivec2(²) & 3, 0)",
            "textureGather(picture, ², 2)",
            "gl_FragCoord",
            "fwidth(⁴)",
        ],
        _ => &[],
    }
}
