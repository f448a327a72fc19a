//! What a rendering gives back.

use super::pixels::Pixel;
use super::scene::RenderScene;
use super::tiles::{TextureTile, Tiles};
use crate::report::{Area, Picture};
use std::sync::Arc;

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

/// The frames of a rendering, each as far as it is not background.
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
    tiles: Vec<TextureTile>,
    bytes_per_row: usize,
    bytes: Bytes,
}

/// The texture as it was read back.
#[derive(Clone, Debug)]
enum Bytes {
    Mapped(Arc<Mapped>),
    Copied(Vec<u8>),
}

impl Default for Bytes {
    fn default() -> Self {
        Self::Copied(Vec::new())
    }
}

/// The device's own memory, to be read in place for as long as this lives.
#[derive(Debug)]
pub(super) struct Mapped {
    /// None once it is given back.
    view: Option<wgpu::BufferView>,
    buffer: wgpu::Buffer,
}

impl Mapped {
    /// The bytes of a buffer that is mapped for reading.
    pub fn new(buffer: &wgpu::Buffer) -> Result<Self, wgpu::MapRangeError> {
        Ok(Self { view: Some(buffer.get_mapped_range(..)?), buffer: buffer.clone() })
    }

    pub fn bytes(&self) -> &[u8] {
        self.view.as_deref().unwrap_or_default()
    }
}

impl Drop for Mapped {
    fn drop(&mut self) {
        // The view borrows from the mapping.
        self.view = None;
        self.buffer.unmap();
    }
}

impl Frames {
    /// The frames of a scene from the texture that they are tiles of, whose rows run upwards.
    pub(super) fn new(scene: &RenderScene, tiles: Tiles, bytes: Arc<Mapped>) -> Self {
        Self {
            width: scene.width,
            height: scene.height,
            count: tiles.tiles.len() as u32,
            background: scene.background,
            bytes_per_row: tiles.bytes_per_row() as usize,
            tiles: tiles.tiles,
            bytes: Bytes::Mapped(bytes),
        }
    }

    /// Frames as they would be read back if these pictures had been drawn, each only within its area.
    pub fn of(background: [u8; 4], pictures: &[(Picture, Area)]) -> Self {
        let (width, height) = pictures.first().map_or((0, 0), |(picture, _)| (picture.width, picture.height));
        let bottom = |area: Area| height - area.y - area.height;
        let tile = |index: usize, area: Area| TextureTile { area, x: area.x, y: index as u32 * height + bottom(area) };
        let upwards = |picture: &Picture| -> Vec<u8> {
            picture.rgba.chunks_exact(width.max(1) as usize * 4).rev().flatten().copied().collect()
        };
        Self {
            width,
            height,
            count: pictures.len() as u32,
            background,
            tiles: pictures.iter().enumerate().map(|(index, (_, area))| tile(index, *area)).collect(),
            bytes_per_row: width as usize * 4,
            bytes: Bytes::Copied(pictures.iter().flat_map(|(picture, _)| upwards(picture)).collect()),
        }
    }

    fn bytes(&self) -> &[u8] {
        match &self.bytes {
            Bytes::Mapped(mapped) => mapped.bytes(),
            Bytes::Copied(bytes) => bytes,
        }
    }

    /// The part of frame `index` outside of which all is background.
    pub fn area(&self, index: u32) -> Area {
        self.tiles[index as usize].area
    }

    /// Row `y` of [`Frames::area`] of frame `index`, in RGBA8. Rows are counted from the top of the frame.
    ///
    /// # Panics
    /// Where the area has no such row.
    pub fn row(&self, index: u32, y: u32) -> &[u8] {
        let TextureTile { area, x, y: bottom } = self.tiles[index as usize];
        assert!((area.y..area.y + area.height).contains(&y), "row {y} of {area:?}");
        let start = (bottom + area.y + area.height - 1 - y) as usize * self.bytes_per_row + x as usize * 4;
        &self.bytes()[start..start + area.width as usize * 4]
    }

    /// A copy of frame `index`.
    pub fn picture(&self, index: u32) -> Picture {
        let mut rgba = self.background.repeat((self.width * self.height) as usize);
        let area = self.area(index);
        for y in area.y..area.y + area.height {
            let start = ((y * self.width + area.x) * 4) as usize;
            let row = self.row(index, y);
            rgba[start..start + row.len()].copy_from_slice(row);
        }
        Picture::whole(self.width, self.height, rgba)
    }
}

/// What a stage met while it ran.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Met {
    /// The loop that ran out of fuel.
    pub ran_out: Option<u32>,
    /// The line where a negative number was raised to a power.
    pub undefined: Option<u32>,
}

impl Met {
    /// What a header says.
    pub(super) fn of(header: &[u8]) -> Self {
        let word = |index: usize| {
            let bytes = header.get(index * 4..)?.first_chunk()?;
            Some(u32::from_le_bytes(*bytes)).filter(|number| *number != 0)
        };
        Self { ran_out: word(0), undefined: word(2) }
    }
}

/// Everything that a rendering gives back.
#[derive(Clone, Debug, Default)]
pub struct Rendering {
    /// The frames.
    pub frames: Frames,
    /// For each frame, its vertices.
    pub frame_samples: Vec<Vec<Sample>>,
    /// For each batch of probes, its vertices.
    pub probe_samples: Vec<Vec<Sample>>,
    /// For each batch of probes of a fragment stage, its pixels.
    pub pixels: Vec<Vec<Pixel>>,
    /// The loop that ran out of fuel, where one did: then nothing else here means anything. See
    /// [`Shader::out_of_fuel`](crate::translate::Shader::out_of_fuel).
    pub ran_out: Option<u32>,
    /// The line where a negative number was raised to a power, where one was; see
    /// [`NO_LINE`](crate::translate::NO_LINE).
    pub undefined: Option<u32>,
    /// The same two of the fragment stage, where that is handed in.
    pub of_fragments: Met,
}
