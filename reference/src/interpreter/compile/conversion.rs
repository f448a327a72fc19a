//! Implicit conversions, and which function a call means (GLSL 4.60, sections 4.1.10 and 6.1).

use super::{CompiledValue, Compiler};
use crate::interpreter::Refusal;
use crate::interpreter::types::{Scalar, Type};
use crate::text::both;

/// How a parameter is passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterDirection {
    /// In.
    In,
    /// Out.
    Out,
    /// Both.
    InOut,
}

/// What a function takes and gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Signature {
    /// Its parameters.
    pub parameters: Vec<(ParameterDirection, Type)>,
    /// What it returns.
    pub result: Type,
}

/// How good a conversion is; the best is the smallest.
type ConversionRank = u8;

/// The rank of a conversion of values; `None` where there is no such conversion without asking for it.
pub fn rank(from: &Type, to: &Type, version: u32) -> Option<ConversionRank> {
    if from == to {
        return Some(0);
    }
    let (a, b) = (from.scalar()?, to.scalar()?);
    if from.with_scalar(b) != *to {
        return None;
    }
    match (a, b) {
        _ if version < 120 => None,
        (Scalar::Float, Scalar::Double) => Some(1),
        (Scalar::Int | Scalar::Uint, Scalar::Float) => Some(2),
        (Scalar::Int, Scalar::Uint) if version >= 400 => Some(2),
        (Scalar::Int | Scalar::Uint, Scalar::Double) => Some(3),
        _ => None,
    }
}

/// The function that a call means, by its number.
pub fn resolve(candidates: &[&Signature], arguments: &[Type], version: u32) -> Option<usize> {
    let ranks = |signature: &&Signature| -> Option<Vec<ConversionRank>> {
        if signature.parameters.len() != arguments.len() {
            return None;
        }
        let one = |((direction, parameter), argument): (&(ParameterDirection, Type), &Type)| match direction {
            ParameterDirection::In => rank(argument, parameter, version),
            ParameterDirection::Out => rank(parameter, argument, version),
            ParameterDirection::InOut => (parameter == argument).then_some(0),
        };
        signature.parameters.iter().zip(arguments).map(one).collect()
    };
    let fitting: Vec<(usize, Vec<ConversionRank>)> =
        candidates.iter().enumerate().filter_map(|(index, signature)| Some((index, ranks(signature)?))).collect();
    let is_better = |a: &[ConversionRank], b: &[ConversionRank]| {
        a.iter().zip(b).all(|(a, b)| a <= b) && a.iter().zip(b).any(|(a, b)| a < b)
    };
    // The first of equals: own functions stand before built-in ones.
    let best = fitting.iter().find(|(_, ranks)| fitting.iter().all(|(_, other)| !is_better(other, ranks)));
    best.map(|(index, _)| *index)
}

impl Compiler {
    /// A value as another type, where that needs not be asked for.
    pub(super) fn implicit(&mut self, value: CompiledValue, kind: &Type) -> Result<CompiledValue, Refusal> {
        if value.kind == *kind {
            return Ok(value);
        }
        // Versions before 1.20 convert nothing; drivers that take a file nevertheless convert as later ones.
        if rank(&value.kind, kind, self.version.max(400)).is_none() {
            return Err(self.invalid(both(
                format!("{} is not {kind}", value.kind),
                format!("{} は {kind} ではありません", value.kind),
            )));
        }
        let (Some(from), Some(to)) = (value.kind.scalar(), kind.scalar()) else { return Ok(value) };
        Ok(CompiledValue { kind: kind.clone(), slots: self.converted(&value.slots, from, to) })
    }

    /// Scalars as another type.
    pub(super) fn converted(&mut self, slots: &[u32], from: Scalar, to: Scalar) -> Vec<u32> {
        slots.iter().map(|&slot| self.builder.convert(slot, from, to)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signature(parameters: &str) -> Signature {
        let parameters =
            parameters.split(' ').map(|name| (ParameterDirection::In, Type::named(name).expect(name))).collect();
        Signature { parameters, result: Type::Void }
    }

    fn chosen(candidates: &[&str], arguments: &str, version: u32) -> Option<usize> {
        let signatures: Vec<_> = candidates.iter().map(|one| signature(one)).collect();
        let arguments: Vec<_> = arguments.split(' ').filter_map(Type::named).collect();
        resolve(&signatures.iter().collect::<Vec<_>>(), &arguments, version)
    }

    #[test]
    fn the_best_conversion_is_chosen() {
        assert_eq!(chosen(&["float", "int"], "int", 410), Some(1));
        assert_eq!(chosen(&["double", "float"], "int", 410), Some(1));
        assert_eq!(chosen(&["float float", "double double"], "int float", 410), Some(0));
        assert_eq!(chosen(&["vec2", "vec3"], "ivec3", 330), Some(1));
        // 3.30 knows no conversion from int to uint.
        assert_eq!(chosen(&["uint", "float"], "int", 330), Some(1));
        assert_eq!(chosen(&["int"], "float", 410), None);
    }
}
