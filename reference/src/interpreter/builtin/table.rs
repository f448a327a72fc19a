//! The signatures of the built-in functions.

use super::lookup;
use crate::interpreter::compile::{ParameterDirection, Signature};
use crate::interpreter::types::{Scalar, Type};
use std::collections::HashMap;
use std::sync::LazyLock;

/// Names, and for each way to call them the result's type and those of the parameters.
///
/// `G D I U B` are 1 to 4 components of `float double int uint bool`, the small letters 2 to 4, in one call all of one
/// length. `M N` are the matrices of `float double`. `>` stands before an `out` parameter.
const FUNCTIONS: [(&str, &str); 37] = [
    ("radians degrees sin cos tan asin acos sinh cosh tanh asinh acosh atanh exp log exp2 log2", "G G"),
    ("dFdx dFdy fwidth dFdxFine dFdyFine fwidthFine dFdxCoarse dFdyCoarse fwidthCoarse", "G G"),
    ("atan", "G G|G G G"),
    ("pow", "G G G"),
    ("sqrt inversesqrt floor trunc round roundEven ceil fract normalize", "G G|D D"),
    ("abs sign", "G G|D D|I I"),
    ("mod", "G G float|G G G|D D double|D D D"),
    ("modf", "G G >G|D D >D"),
    ("min max", "G G G|G G float|D D D|D D double|I I I|I I int|U U U|U U uint"),
    ("clamp", "G G G G|G G float float|D D D D|D D double double|I I I I|I I int int|U U U U|U U uint uint"),
    ("mix", "G G G G|G G G float|G G G B|D D D D|D D D double|D D D B|I I I B|U U U B|B B B B"),
    ("step", "G G G|G float G|D D D|D double D"),
    ("smoothstep", "G G G G|G float float G|D D D D|D double double D"),
    ("isnan isinf", "B G|B D"),
    ("floatBitsToInt", "I G"),
    ("floatBitsToUint", "U G"),
    ("intBitsToFloat", "G I"),
    ("uintBitsToFloat", "G U"),
    ("fma", "G G G G|D D D D"),
    ("frexp", "G G >I|D D >I"),
    ("ldexp", "G G I|D D I"),
    ("packUnorm2x16 packSnorm2x16 packHalf2x16", "uint vec2"),
    ("unpackUnorm2x16 unpackSnorm2x16 unpackHalf2x16", "vec2 uint"),
    ("packUnorm4x8 packSnorm4x8", "uint vec4"),
    ("unpackUnorm4x8 unpackSnorm4x8", "vec4 uint"),
    ("packDouble2x32", "double uvec2"),
    ("unpackDouble2x32", "uvec2 double"),
    ("length", "float G|double D"),
    ("distance dot", "float G G|double D D"),
    ("cross", "vec3 vec3 vec3|dvec3 dvec3 dvec3"),
    ("faceforward", "G G G G|D D D D"),
    ("reflect", "G G G|D D D"),
    ("refract", "G G G float|D D D double"),
    ("lessThan lessThanEqual greaterThan greaterThanEqual", "b g g|b i i|b u u|b d d"),
    ("equal notEqual", "b g g|b i i|b u u|b d d|b b b"),
    ("any all", "bool b"),
    ("matrixCompMult", "M M M|N N N"),
];

/// The rest, on integers.
const INTEGER_FUNCTIONS: [(&str, &str); 9] = [
    ("not", "b b"),
    ("uaddCarry usubBorrow", "U U U >U"),
    ("umulExtended", "void U U >U >U"),
    ("imulExtended", "void I I >I >I"),
    ("bitfieldExtract", "I I int int|U U int int"),
    ("bitfieldInsert", "I I I int int|U U U int int"),
    ("bitfieldReverse", "I I|U U"),
    ("bitCount findLSB findMSB", "I I|I U"),
    ("ftransform", ""),
];

/// The ways to call a built-in function; none where there is no such function.
pub fn signatures(name: &str) -> &'static [Signature] {
    static TABLE: LazyLock<HashMap<&'static str, Vec<Signature>>> = LazyLock::new(table);
    TABLE.get(name).map_or(&[], Vec::as_slice)
}

fn table() -> HashMap<&'static str, Vec<Signature>> {
    let mut table: HashMap<&'static str, Vec<Signature>> = HashMap::new();
    for (names, patterns) in FUNCTIONS.iter().chain(&INTEGER_FUNCTIONS) {
        let all: Vec<Signature> = patterns.split('|').flat_map(expanded).collect();
        for name in names.split(' ').filter(|_| !all.is_empty()) {
            table.entry(name).or_default().extend(all.iter().cloned());
        }
    }
    for scalar in [Scalar::Float, Scalar::Double] {
        matrices(&mut table, scalar);
    }
    lookup::signatures(&mut table);
    table
}

/// One signature for each length that the letters of a pattern stand for.
fn expanded(pattern: &str) -> Vec<Signature> {
    let words: Vec<&str> = pattern.split(' ').collect();
    let variants: Vec<u8> = match words.iter().find_map(|word| letter(word)) {
        None if pattern.is_empty() => Vec::new(),
        None => vec![1],
        Some('M' | 'N') => (0..9).collect(),
        Some(letter) if letter.is_ascii_uppercase() => (1..=4).collect(),
        Some(_) => (2..=4).collect(),
    };
    let signature = |variant: u8| {
        let mut kinds = words.iter().map(|word| parameter(word, variant));
        let result = kinds.next().map_or(Type::Void, |(_, kind)| kind);
        Signature { result, parameters: kinds.collect() }
    };
    variants.into_iter().map(signature).collect()
}

fn letter(word: &str) -> Option<char> {
    let word = word.trim_start_matches('>');
    word.chars().next().filter(|_| word.len() == 1)
}

fn parameter(word: &str, variant: u8) -> (ParameterDirection, Type) {
    let (direction, word) = match word.strip_prefix('>') {
        Some(word) => (ParameterDirection::Out, word),
        None => (ParameterDirection::In, word),
    };
    let kind = match letter(word) {
        Some('M') => Type::Matrix(Scalar::Float, variant / 3 + 2, variant % 3 + 2),
        Some('N') => Type::Matrix(Scalar::Double, variant / 3 + 2, variant % 3 + 2),
        Some('G' | 'g') => Type::Vector(Scalar::Float, variant),
        Some('D' | 'd') => Type::Vector(Scalar::Double, variant),
        Some('I' | 'i') => Type::Vector(Scalar::Int, variant),
        Some('U' | 'u') => Type::Vector(Scalar::Uint, variant),
        Some('B' | 'b') => Type::Vector(Scalar::Bool, variant),
        _ => Type::named(word).unwrap_or(Type::Void),
    };
    (direction, kind)
}

/// Functions whose result has another shape than their parameters.
fn matrices(table: &mut HashMap<&'static str, Vec<Signature>>, scalar: Scalar) {
    let of = |result: Type, parameters: Vec<Type>| Signature {
        result,
        parameters: parameters.into_iter().map(|kind| (ParameterDirection::In, kind)).collect(),
    };
    let mut add = |name: &'static str, signature| table.entry(name).or_default().push(signature);
    for a in 2..=4 {
        let square = Type::Matrix(scalar, a, a);
        add("determinant", of(Type::Vector(scalar, 1), vec![square.clone()]));
        add("inverse", of(square.clone(), vec![square]));
        for b in 2..=4 {
            add("transpose", of(Type::Matrix(scalar, b, a), vec![Type::Matrix(scalar, a, b)]));
            let (column, row) = (Type::Vector(scalar, b), Type::Vector(scalar, a));
            add("outerProduct", of(Type::Matrix(scalar, a, b), vec![column, row]));
        }
    }
}
