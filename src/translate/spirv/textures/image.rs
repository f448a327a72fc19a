//! What samplers and images are, and how the texels of each are counted.

use crate::translate::spirv::code::SpirvCode;
use crate::translate::spirv::op::{self, storage};
use std::collections::HashMap;

/// What a sampler's or image's type is made of (SPIR-V specification, `OpTypeImage`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageType {
    pub(super) dimension: u32,
    pub(super) has_layers: bool,
    pub(super) compares: bool,
    pub(super) scalar: Texel,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Texel {
    Float,
    Int,
    Uint,
}

pub(super) const CUBE: u32 = 3;
pub(super) const RECTANGLE: u32 = 4;

impl ImageType {
    /// How many coordinates there are, layers aside.
    pub(super) fn axes(self) -> u32 {
        match self.dimension {
            0 => 1,
            2 => 3,
            _ => 2,
        }
    }

    /// As `textures.glsl` has it.
    pub(super) fn mode(self) -> u32 {
        let bit = |is: bool, bit: u32| if is { bit } else { 0 };
        self.axes()
            | bit(self.has_layers, 4)
            | bit(self.dimension == CUBE, 8)
            | bit(self.compares, 16)
            | bit(self.dimension == RECTANGLE, 32)
    }

    /// The name that GLSL gives to its sampler.
    pub(super) fn name(self) -> String {
        let prefix = match self.scalar {
            Texel::Float => "",
            Texel::Int => "i",
            Texel::Uint => "u",
        };
        let dimension = ["1D", "2D", "3D", "Cube", "2DRect", "Buffer"].get(self.dimension as usize).unwrap_or(&"");
        let array = if self.has_layers { "Array" } else { "" };
        format!("{prefix}sampler{dimension}{array}{}", if self.compares { "Shadow" } else { "" })
    }
}

/// The types that were samplers and images, by id.
#[derive(Clone, Debug, Default)]
pub struct SamplerTypes(pub(super) HashMap<u32, ImageType>);

impl SamplerTypes {
    /// The name of the type, where it is one of these.
    pub fn name(&self, ty: u32) -> Option<String> {
        self.0.get(&ty).map(|kind| kind.name())
    }

    /// Makes numbers of them. Buffers, and what has several samples, are none.
    pub fn take(code: &mut SpirvCode) -> Self {
        let mut found: HashMap<u32, ImageType> = HashMap::new();
        let scalars: HashMap<u32, Texel> = code
            .globals
            .iter()
            .filter_map(|i| match (i.opcode, &i.operands[..]) {
                (op::TYPE_FLOAT, [id, ..]) => Some((*id, Texel::Float)),
                (op::TYPE_INT, [id, _, 1]) => Some((*id, Texel::Int)),
                (op::TYPE_INT, [id, ..]) => Some((*id, Texel::Uint)),
                _ => None,
            })
            .collect();
        for declared in &mut code.globals {
            let kind = match (declared.opcode, &declared.operands[..]) {
                (op::TYPE_IMAGE, &[_, texel, dimension @ 0..=RECTANGLE, depth, layers, 0, 1, ..]) => {
                    let scalar = scalars.get(&texel).copied().unwrap_or(Texel::Float);
                    Some(ImageType { dimension, has_layers: layers == 1, compares: depth == 1, scalar })
                }
                (op::TYPE_SAMPLED_IMAGE, [_, image, ..]) => found.get(image).copied(),
                _ => None,
            };
            if let Some(kind) = kind {
                found.insert(declared.operands[0], kind);
                declared.opcode = op::TYPE_INT;
                declared.operands = vec![declared.operands[0], 32, 0];
            }
        }
        for pointer in code.globals.iter_mut().filter(|i| i.opcode == op::TYPE_POINTER) {
            if found.contains_key(&pointer.operands[2]) {
                pointer.operands[1] = storage::PRIVATE;
            }
        }
        Self(found)
    }
}
