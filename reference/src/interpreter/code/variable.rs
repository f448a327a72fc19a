//! The variables of a program that its host sees: what they are called, where they lie, how they are interpolated.

use super::Slot;
use crate::interpreter::std140;
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
    /// Whether the rows of a matrix lie before its columns.
    pub is_row_major: bool,
}

impl BlockPlace {
    /// Where each number of a scalar, vector or matrix lies that begins here, in bytes: those of a matrix column by column.
    pub fn numbers(&self, kind: &Type) -> Vec<u32> {
        std140::numbers(kind, self.is_row_major).into_iter().map(|behind| self.offset + behind).collect()
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
