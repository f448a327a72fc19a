//! The variables of a program that its host sees: what they are called, where they lie, how they are interpolated.

use super::Slot;
use crate::interpreter::types::Type;

/// A variable that the host sees.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramVariable {
    /// Its name, or the path `block.member`, `lights[1].colour` of a uniform's leaf.
    pub name: String,
    /// What the text calls it: `instance.member` of a block that goes from stage to stage.
    pub written: String,
    /// Its type.
    pub kind: Type,
    /// Its first slot.
    pub slot: Slot,
    /// Where it is declared.
    pub line: u32,
    /// How it is interpolated between vertices.
    pub interpolation: Interpolation,
    /// Its location, where the program gives it.
    pub location: Option<u32>,
    /// Of a part of a block of uniforms, where it lies in it.
    pub place: Option<BlockPlace>,
}

/// A place in a block of uniforms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockPlace {
    /// The block's name.
    pub block: String,
    /// How many bytes lie before it by the layout `std140`.
    pub offset: u32,
    /// Whether the program says that the block has this layout.
    pub is_std140: bool,
}

impl BlockPlace {
    /// Its place in a block of this name.
    pub fn offset_in(&self, block: &str) -> Option<u32> {
        (self.block == block).then_some(self.offset)
    }
}

/// How a variable is interpolated between vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// As on the triangle itself.
    #[default]
    Smooth,
    /// Not at all: the last vertex has the value.
    Flat,
    /// As in the picture.
    NoPerspective,
}
