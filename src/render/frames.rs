//! What a rendering gives back.

use crate::report::Picture;

/// What the shader computed for one vertex.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Sample {
    /// Clip-space position, as in `gl_Position` (z in OpenGL's range [−w, w]).
    pub position: [f32; 4],
    /// The colour output, not clamped.
    pub colour: [f32; 4],
}

impl Sample {
    /// Red, green and blue.
    pub fn colour_f64(&self) -> [f64; 3] {
        let [r, g, b, _] = self.colour;
        [r, g, b].map(f64::from)
    }
}

/// Tiles of one texture: frame k stands in column k mod `columns` of row k div `columns`.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// Pixels in a row of one frame.
    pub width: u32,
    /// Rows of one frame.
    pub height: u32,
    /// How many frames there are.
    pub count: u32,
    /// The colour that each is cleared to, RGBA8.
    pub background: [u8; 4],
    pub(super) columns: u32,
    pub(super) bytes_per_row: u32,
    pub(super) bytes: Vec<u8>,
}

impl Frames {
    /// Row `y` (from the top) of frame `index`: `width` pixels of RGBA8.
    pub fn row(&self, index: u32, y: u32) -> &[u8] {
        let (column, row) = (index % self.columns, index / self.columns);
        let start = ((row * self.height + y) * self.bytes_per_row + column * self.width * 4) as usize;
        &self.bytes[start..start + self.width as usize * 4]
    }

    /// A copy of frame `index`.
    pub fn picture(&self, index: u32) -> Picture {
        let rgba = (0..self.height).flat_map(|y| self.row(index, y)).copied().collect();
        Picture { width: self.width, height: self.height, rgba }
    }
}

/// Everything that a rendering gives back.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// The frames.
    pub frames: Frames,
    /// For each frame, its vertices.
    pub frame_samples: Vec<Vec<Sample>>,
    /// For each batch of probes, its vertices.
    pub probe_samples: Vec<Vec<Sample>>,
    /// The loop that ran out of fuel, where one did: then nothing else here means anything. See
    /// [`Shader::out_of_fuel`](crate::translate::Shader::out_of_fuel).
    pub ran_out: Option<u32>,
    /// The line where a negative number was raised to a power, where one was; see
    /// [`NO_LINE`](crate::translate::NO_LINE).
    pub undefined: Option<u32>,
}
