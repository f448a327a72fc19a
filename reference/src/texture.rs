//! The pictures of textures: read from PNG files, or computed.
//!
//! The first row of texels is the lowest one, as OpenGL has it: texture coordinate (0, 0) is the lower left corner.

mod colour;
mod file;
mod generator;
mod noise;
mod sky;

pub use colour::Colour;
pub use file::{BrokenPicture, read};
pub use generator::Generator;

/// The texels of one picture, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct TexturePicture<T> {
    /// Texels of a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green, blue and alpha of each.
    pub texels: Vec<[T; 4]>,
}

impl<T: Copy> TexturePicture<T> {
    /// The same picture with the last row first.
    pub fn flipped(mut self) -> Self {
        self.texels = self.texels.chunks_exact(self.width.max(1)).rev().flatten().copied().collect();
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flipped_picture_has_its_last_row_first() {
        let picture = TexturePicture { width: 2, height: 2, texels: vec![[1; 4], [2; 4], [3; 4], [4; 4]] };
        assert_eq!(picture.flipped().texels, [[3; 4], [4; 4], [1; 4], [2; 4]]);
    }
}
