//! Opaque pictures and their PNG encoding.

mod palette;

use super::Picture;
use crate::fault::Fault;
use crate::language::Text;
use palette::{Palette, Rgb};
use png::{BitDepth, ColorType, DeflateCompression, Encoder, Filter};

/// How hard a picture is compressed, and what is done to its rows before.
#[derive(Clone, Copy, Debug)]
struct Compression {
    /// Of 9.
    effort: u8,
    filter: Filter,
}

/// Numbers in a palette are no levels, so a difference of two says nothing: a sheet of 256 colours that stand for more has 42 kB
/// as it is and 49 kB as differences, a single picture of 103 colours 27 kB and 39 kB.
const AS_IT_IS: Compression = Compression { effort: 5, filter: Filter::NoFilter };
/// Edges of triangles of few colours go on from row to row: a sheet of 25 frames of ggsample06 has 54 kB after 4 ms; 57 kB after 6 ms
/// as it is.
const BY_ROWS: Compression = Compression { effort: 5, filter: Filter::Up };
/// For what is made once for a class: 40 kB in place of 54, after 70 ms.
const HARDEST: u8 = 9;

/// An opaque picture, top row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Raster {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<Rgb>,
}

impl Raster {
    /// The picture without its alpha; a fault when its size and its bytes do not go together.
    pub fn opaque(picture: &Picture) -> Result<Self, Fault> {
        let (width, height) = (picture.width as usize, picture.height as usize);
        if !picture.is_sound() {
            return Err(mismatched());
        }
        let pixels = picture.pixels().iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
        Ok(Self { width, height, pixels })
    }

    /// Every so manieth pixel of every so manieth row: no colour is invented.
    pub fn reduced(&self, factor: usize) -> Self {
        let rows: Vec<_> = self.rows().step_by(factor).collect();
        let pixels = rows.iter().flat_map(|row| row.iter().step_by(factor).copied()).collect();
        Self { width: self.width.div_ceil(factor), height: rows.len(), pixels }
    }

    /// Row by row, from the top.
    pub fn rows(&self) -> impl Iterator<Item = &[Rgb]> {
        self.pixels.chunks_exact(self.width)
    }
}

/// One frame as a PNG.
pub(super) fn encode(frame: &Raster) -> Result<Vec<u8>, Fault> {
    encode_animated(&[frame], 0.0)
}

/// One frame as a small PNG: where it has more colours than a palette, nearly the same ones stand for them.
pub(super) fn encode_small(frame: &Raster) -> Result<Vec<u8>, Fault> {
    let size = (frame.width, frame.height);
    let mut palette = Palette::default();
    let indices = frame.pixels.iter().map(|colour| palette.index(*colour)).collect::<Option<Vec<u8>>>();
    let (colours, indices) = match indices {
        Some(indices) => (palette.colours, indices),
        None => palette::reduced(&frame.pixels),
    };
    write(size, Some(&colours), &[&indices], 0.0, AS_IT_IS)
}

/// Frames of one size as a PNG; several as an animated one that takes `cycle` seconds.
///
/// Up to 256 colours go into a palette: a third of the size, and of the time.
pub(super) fn encode_animated(frames: &[&Raster], cycle: f64) -> Result<Vec<u8>, Fault> {
    let size = frames.first().map_or((0, 0), |frame| (frame.width, frame.height));
    let mut palette = Palette::default();
    let indices = frames.iter().map(|frame| frame.pixels.iter().map(|colour| palette.index(*colour)).collect());
    match indices.collect::<Option<Vec<Vec<u8>>>>() {
        Some(indices) => {
            let frames: Vec<&[u8]> = indices.iter().map(Vec::as_slice).collect();
            write(size, Some(&palette.colours), &frames, cycle, AS_IT_IS)
        }
        None => {
            let frames: Vec<&[u8]> = frames.iter().map(|frame| frame.pixels.as_flattened()).collect();
            write(size, None, &frames, cycle, BY_ROWS)
        }
    }
}

/// A picture that is painted piece by piece: in a palette for as long as 256 colours are enough.
#[derive(Clone)]
pub(super) struct Canvas {
    pub width: usize,
    pub height: usize,
    palette: Palette,
    pixels: CanvasPixels,
}

#[derive(Clone)]
enum CanvasPixels {
    Indexed(Vec<u8>),
    Full(Vec<Rgb>),
}

impl Canvas {
    /// A canvas of one colour.
    pub fn new(width: usize, height: usize, blank: Rgb) -> Self {
        let mut palette = Palette::default();
        let first = palette.index(blank).unwrap_or_default();
        Self { width, height, palette, pixels: CanvasPixels::Indexed(vec![first; width * height]) }
    }

    /// Paints pixels from the `start`th on, counted row by row.
    pub fn put(&mut self, start: usize, colours: impl Iterator<Item = Rgb> + Clone) {
        if let CanvasPixels::Indexed(indices) = &mut self.pixels {
            let mut cells = indices[start..].iter_mut().zip(colours.clone());
            let fits = cells.all(|(cell, colour)| self.palette.index(colour).map(|index| *cell = index).is_some());
            if fits {
                return;
            }
            let full = indices.iter().map(|index| self.palette.colours[usize::from(*index)]);
            self.pixels = CanvasPixels::Full(full.collect());
        }
        if let CanvasPixels::Full(pixels) = &mut self.pixels {
            pixels[start..].iter_mut().zip(colours).for_each(|(cell, colour)| *cell = colour);
        }
    }

    /// Whether a palette was enough so far.
    pub fn is_indexed(&self) -> bool {
        matches!(self.pixels, CanvasPixels::Indexed(_))
    }

    /// It as a PNG. Where it has more colours than a palette, nearly the same ones stand for them: a third of the size, and seldom
    /// seen.
    pub fn encode(&self) -> Result<Vec<u8>, Fault> {
        self.compressed(BY_ROWS.effort)
    }

    /// The same in as few bytes as can be, for what is made once and shown in many pages.
    pub fn encode_hardest(&self) -> Result<Vec<u8>, Fault> {
        self.compressed(HARDEST)
    }

    fn compressed(&self, effort: u8) -> Result<Vec<u8>, Fault> {
        let size = (self.width, self.height);
        match &self.pixels {
            CanvasPixels::Indexed(indices) => {
                write(size, Some(&self.palette.colours), &[indices], 0.0, Compression { effort, ..BY_ROWS })
            }
            CanvasPixels::Full(pixels) => {
                let (colours, indices) = palette::reduced(pixels);
                write(size, Some(&colours), &[&indices], 0.0, Compression { effort, ..AS_IT_IS })
            }
        }
    }
}

/// Frames of bytes as a PNG: places in a palette, or red, green and blue where there is none.
fn write(
    size: (usize, usize),
    palette: Option<&[Rgb]>,
    frames: &[&[u8]],
    cycle: f64,
    compression: Compression,
) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    write_frames(size, palette, frames, cycle, compression, &mut bytes).map_err(|error| {
        Fault::new(Text::new(
            format!("A picture could not be encoded: {error}."),
            format!("画像を PNG にできませんでした（{error}）。"),
        ))
    })?;
    Ok(bytes)
}

fn write_frames(
    (width, height): (usize, usize),
    palette: Option<&[Rgb]>,
    frames: &[&[u8]],
    cycle: f64,
    compression: Compression,
    out: &mut Vec<u8>,
) -> Result<(), png::EncodingError> {
    let mut encoder = Encoder::new(out, width as u32, height as u32);
    encoder.set_deflate_compression(DeflateCompression::Level(compression.effort));
    encoder.set_filter(compression.filter);
    let depth = palette.map_or(BitDepth::Eight, |colours| palette::depth(colours.len()));
    encoder.set_depth(depth);
    match palette {
        Some(colours) => {
            encoder.set_color(ColorType::Indexed);
            encoder.set_palette(colours.as_flattened().to_vec());
        }
        None => encoder.set_color(ColorType::Rgb),
    }
    if frames.len() > 1 {
        let delay = cycle * 1000.0 / frames.len() as f64;
        encoder.set_animated(frames.len() as u32, 0)?;
        encoder.set_frame_delay(delay.round() as u16, 1000)?;
    }
    let mut writer = encoder.write_header()?;
    for frame in frames {
        writer.write_image_data(&palette::packed(frame, width, depth))?;
    }
    writer.finish()
}

/// Pictures without a size, of unlike sizes, or of unlike numbers.
pub(super) fn mismatched() -> Fault {
    Fault::new(Text::new(
        "The pictures of the grading do not go together.",
        "採点の画像の大きさまたは枚数が一致していません。",
    ))
}
