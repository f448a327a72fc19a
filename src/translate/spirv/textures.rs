//! Textures that the program sets: a sampler is the number of a texture, and every lookup a call of a function that reads
//! it in plain arithmetic (`textures.glsl`).
//!
//! So samplers may stand in structures and arrays, be chosen by an index and be handed to functions, which naga takes in
//! no other way; what a lookup gives is that of the reference's rules, and depends on no driver.

mod description;
mod image;
mod library;

use super::code::{SpirvCode, SpirvInstruction};
use super::lower::{InstructionBuilder, rewrite};
use super::op::{self};
pub use description::{CommonTexture, DESCRIPTION, descriptions};
pub use image::SamplerTypes;
use image::{ImageType, Texel};
use library::splice;
use std::collections::HashMap;

/// What the names of the functions end with that read textures; no GLSL has such a name.
const OURS: &str = "@ours";

/// Whether a function is one of ours.
pub fn is_ours(function: &naga::Function) -> bool {
    function.name.as_ref().is_some_and(|name| name.ends_with(OURS))
}

/// Bind group and binding of the textures.
pub const TEXTURES: (u32, u32) = (1, 1);

/// Replaces the lookups; gives whether there are any. `alike`: what all textures have in common, where they do.
pub(super) fn lower(
    code: &mut SpirvCode,
    samplers: &SamplerTypes,
    is_fragment: bool,
    alike: Option<CommonTexture>,
) -> bool {
    let is_lookup = |i: &SpirvInstruction| (op::IMAGE_SAMPLE_FIRST..=op::IMAGE_LAST).contains(&i.opcode);
    if samplers.0.is_empty() || !code.functions.iter().any(is_lookup) {
        return false;
    }
    let Some(functions) = splice(code, is_fragment, alike) else { return false };
    rewrite(code, |builder, instruction| {
        let mut look = LookUp { b: builder, samplers, functions: &functions };
        look.lowered(instruction)
    });
    true
}

struct LookUp<'a, 'b> {
    b: &'a mut InstructionBuilder<'b>,
    samplers: &'a SamplerTypes,
    /// By name: the id, and the type of the result.
    functions: &'a HashMap<String, (u32, u32)>,
}

/// The optional operands of an instruction on images (SPIR-V specification, section 3.14).
#[derive(Default)]
struct Operands {
    bias: Option<u32>,
    level: Option<u32>,
    gradient: Option<[u32; 2]>,
    offset: Option<u32>,
}

impl Operands {
    fn read(words: &[u32]) -> Self {
        let mut read = Self::default();
        let Some((mask, mut rest)) = words.split_first() else { return read };
        let mut next = || {
            let (first, others) = rest.split_first()?;
            rest = others;
            Some(*first)
        };
        if mask & 1 != 0 {
            read.bias = next();
        }
        if mask & 2 != 0 {
            read.level = next();
        }
        if mask & 4 != 0 {
            read.gradient = next().zip(next()).map(|(x, y)| [x, y]);
        }
        if mask & 24 != 0 {
            read.offset = next();
        }
        read
    }
}

impl LookUp<'_, '_> {
    fn lowered(&mut self, instruction: &SpirvInstruction) -> Option<()> {
        if !(op::IMAGE_SAMPLE_FIRST..=op::IMAGE_LAST).contains(&instruction.opcode) {
            return None;
        }
        let [ty, id, texture, rest @ ..] = &instruction.operands[..] else { return None };
        let (ty, id, texture) = (*ty, *id, *texture);
        let kind = self.samplers.0.get(&self.b.type_of(texture)?).copied()?;
        match (instruction.opcode, rest) {
            (op::IMAGE, _) => {
                self.b.op_as(id, op::COPY_OBJECT, ty, &[texture]);
            }
            (first @ op::IMAGE_SAMPLE_FIRST..op::IMAGE_FETCH, [at, rest @ ..]) => {
                let number = first - op::IMAGE_SAMPLE_FIRST;
                let (is_compared, is_projected) = (number & 2 != 0, number & 4 != 0);
                let (reference, rest) =
                    if is_compared { (rest.first().copied(), rest.get(1..)?) } else { (None, rest) };
                let (at, reference) = self.place(kind, *at, reference, is_projected)?;
                let operands = Operands::read(rest);
                let detail = self.detail(kind, texture, at, &operands)?;
                let (offset, mode) = (self.offset(operands.offset), self.int(kind.mode()));
                let reference = reference.unwrap_or_else(|| self.float(0.0));
                let found = self.call("look_up", &[texture, at, detail, offset, reference, mode])?;
                self.give(kind, id, ty, found, is_compared);
            }
            (op::IMAGE_FETCH, [at, rest @ ..]) => {
                let operands = Operands::read(rest);
                let mut at = self.ivec3(*at);
                if let Some(offset) = operands.offset {
                    let by = self.ivec3(offset);
                    let ivec3 = self.b.ints(3, true);
                    at = self.b.op(op::I_ADD, ivec3, &[at, by]);
                }
                let level = operands.level.unwrap_or_else(|| self.int(0));
                let found = self.call("fetch", &[texture, at, level])?;
                self.give(kind, id, ty, found, false);
            }
            (op::IMAGE_GATHER | op::IMAGE_DREF_GATHER, [at, third, rest @ ..]) => {
                let is_compared = instruction.opcode == op::IMAGE_DREF_GATHER;
                let operands = Operands::read(rest);
                let (at, _) = self.place(kind, *at, None, false)?;
                let (offset, mode) = (self.offset(operands.offset), self.int(kind.mode()));
                let (reference, component) =
                    if is_compared { (*third, self.int(0)) } else { (self.float(0.0), *third) };
                let found = self.call("gather", &[texture, at, offset, reference, component, mode])?;
                self.give(kind, id, ty, found, false);
            }
            (op::IMAGE_QUERY_SIZE_LOD | op::IMAGE_QUERY_SIZE, _) => {
                let mode = self.int(kind.mode());
                let found = self.call("extent", &[texture, mode])?;
                let size = self.b.shape(ty)?.size;
                if size == 1 {
                    self.b.op_as(id, op::COMPOSITE_EXTRACT, ty, &[found, 0]);
                } else {
                    let order: Vec<u32> = (0..size).collect();
                    self.b.op_as(id, op::VECTOR_SHUFFLE, ty, &[&[found, found], &order[..]].concat());
                }
            }
            (op::IMAGE_QUERY_LOD, [at, ..]) => {
                let (at, _) = self.place(kind, *at, None, false)?;
                let detail = self.detail(kind, texture, at, &Operands::default())?;
                let none = self.float(0.0);
                self.b.op_as(id, op::COMPOSITE_CONSTRUCT, ty, &[none, detail]);
            }
            // Levels and samples: one.
            _ => {
                let one = self.int(1);
                self.b.op_as(id, op::COPY_OBJECT, ty, &[one]);
            }
        }
        Some(())
    }

    fn call(&mut self, name: &str, arguments: &[u32]) -> Option<u32> {
        let &(function, ty) = self.functions.get(name)?;
        Some(self.b.op(op::FUNCTION_CALL, ty, &[&[function], arguments].concat()))
    }

    fn int(&mut self, value: u32) -> u32 {
        let int = self.b.ints(1, true);
        self.b.code.constant(op::CONSTANT, int, &[value])
    }

    fn float(&mut self, value: f64) -> u32 {
        let float = self.b.code.ty(op::TYPE_FLOAT, &[32]);
        self.b.float(float, value)
    }

    /// Coordinates as four floats and the reference, both divided where they are projected.
    fn place(
        &mut self,
        kind: ImageType,
        at: u32,
        reference: Option<u32>,
        is_projected: bool,
    ) -> Option<(u32, Option<u32>)> {
        let float = self.b.code.ty(op::TYPE_FLOAT, &[32]);
        let given = self.b.shape(self.b.type_of(at)?)?.size;
        let mut parts: Vec<u32> = if given == 1 {
            vec![at]
        } else {
            (0..given).map(|axis| self.b.op(op::COMPOSITE_EXTRACT, float, &[at, axis])).collect()
        };
        let mut reference = reference;
        if is_projected {
            let by = *parts.get(kind.axes() as usize)?;
            parts.truncate(kind.axes() as usize);
            for part in parts.iter_mut().chain(&mut reference) {
                *part = self.b.op(op::F_DIV, float, &[*part, by]);
            }
        }
        let zero = self.float(0.0);
        parts.resize(4, zero);
        let vec4 = self.b.sized(float, 4);
        Some((self.b.op(op::COMPOSITE_CONSTRUCT, vec4, &parts), reference))
    }

    /// The level of detail. Outside of fragments it is 0 where none is given.
    fn detail(&mut self, kind: ImageType, texture: u32, at: u32, operands: &Operands) -> Option<u32> {
        let float = self.b.code.ty(op::TYPE_FLOAT, &[32]);
        if let Some(level) = operands.level {
            return Some(level);
        }
        let mode = self.int(kind.mode());
        let mut detail = match operands.gradient {
            Some(gradient) => {
                let [(x, _), (y, _)] =
                    [self.place(kind, gradient[0], None, false)?, self.place(kind, gradient[1], None, false)?];
                self.call("detail_along", &[texture, x, y, mode])?
            }
            None if self.functions.contains_key("detail_here") => self.call("detail_here", &[texture, at, mode])?,
            None => self.float(0.0),
        };
        if let Some(bias) = operands.bias {
            detail = self.b.op(op::F_ADD, float, &[detail, bias]);
        }
        Some(detail)
    }

    /// Whole numbers as three.
    fn ivec3(&mut self, value: u32) -> u32 {
        let int = self.b.ints(1, true);
        let size = self.b.type_of(value).and_then(|ty| self.b.shape(ty)).map_or(1, |shape| shape.size);
        let mut parts: Vec<u32> = match size {
            1 => vec![value],
            _ => (0..size).map(|axis| self.b.op(op::COMPOSITE_EXTRACT, int, &[value, axis])).collect(),
        };
        let zero = self.int(0);
        parts.resize(3, zero);
        let ivec3 = self.b.ints(3, true);
        self.b.op(op::COMPOSITE_CONSTRUCT, ivec3, &parts)
    }

    fn offset(&mut self, offset: Option<u32>) -> u32 {
        match offset {
            Some(offset) => self.ivec3(offset),
            None => {
                let ivec3 = self.b.ints(3, true);
                self.b.code.null(ivec3)
            }
        }
    }

    /// Gives four floats as what the instruction gives.
    fn give(&mut self, kind: ImageType, id: u32, ty: u32, found: u32, is_single: bool) {
        match (is_single, kind.scalar) {
            (true, _) => self.b.op_as(id, op::COMPOSITE_EXTRACT, ty, &[found, 0]),
            (false, Texel::Float) => self.b.op_as(id, op::COPY_OBJECT, ty, &[found]),
            (false, Texel::Int) => self.b.op_as(id, op::CONVERT_F_TO_S, ty, &[found]),
            (false, Texel::Uint) => self.b.op_as(id, op::CONVERT_F_TO_U, ty, &[found]),
        };
    }
}
