//! What a submission is drawn with.

use reference::{Value, Values};

/// A draw: its vertices, and the uniforms that hold for them.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Uniforms by path.
    pub uniforms: Vec<(String, Value)>,
    /// Attributes by name; all of one length.
    pub attributes: Vec<(String, Values)>,
}

impl Batch {
    pub(super) fn vertices(&self) -> u32 {
        self.attributes.first().map_or(0, |(_, values)| values.len() as u32)
    }

    /// How many are drawn: a driver leaves out the vertices of a triangle that is not complete, so the last one is
    /// repeated until it is.
    pub(super) fn drawn(&self) -> u32 {
        self.vertices().next_multiple_of(3)
    }
}

/// What is drawn: frames, which are seen, and probes, of which only the vertices count.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Pixels in a row of a frame.
    pub width: u32,
    /// Rows of a frame.
    pub height: u32,
    /// Colour that a frame is cleared to, RGBA8.
    pub background: [u8; 4],
    /// One batch a frame.
    pub frames: Vec<Batch>,
    /// The probes.
    pub probes: Vec<Batch>,
}

impl Scene {
    /// The frames, then the probes.
    pub(super) fn batches(&self) -> impl Iterator<Item = &Batch> {
        self.frames.iter().chain(&self.probes)
    }

    /// How many vertices are drawn in all.
    pub(super) fn drawn(&self) -> u32 {
        self.batches().map(Batch::drawn).sum()
    }
}
