//! Opaque pictures and their PNG encoding.

use super::Picture;
use crate::fault::Fault;
use crate::language::Text;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};
use std::collections::HashMap;

type Rgb = [u8; 3];

/// Seconds that an animation takes, as in the course's program.
pub(super) const CYCLE_SECONDS: f64 = 5.0;

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
        if width == 0 || height == 0 || picture.rgba.len() != width * height * 4 {
            return Err(mismatched());
        }
        let pixels = picture.rgba.chunks_exact(4).map(|p| [p[0], p[1], p[2]]);
        Ok(Self { width, height, pixels: pixels.collect() })
    }

    /// Row by row, from the top.
    pub fn rows(&self) -> impl Iterator<Item = &[Rgb]> {
        self.pixels.chunks_exact(self.width)
    }
}

/// One frame as a PNG, or several of one size as an animated PNG.
///
/// Up to 256 colours go into a palette: a third of the size, and of the time.
pub(super) fn encode(frames: &[&Raster]) -> Result<Vec<u8>, Fault> {
    let palette = Palette::of(frames);
    let mut bytes = Vec::new();
    write_frames(frames, palette.as_ref(), &mut bytes).map_err(|error| {
        Fault::new(Text::new(
            format!("A picture could not be encoded: {error}."),
            format!("画像を PNG にできませんでした（{error}）。"),
        ))
    })?;
    Ok(bytes)
}

fn write_frames(frames: &[&Raster], palette: Option<&Palette>, out: &mut Vec<u8>) -> Result<(), png::EncodingError> {
    let (width, height) = frames.first().map_or((0, 0), |frame| (frame.width, frame.height));
    let mut encoder = Encoder::new(out, width as u32, height as u32);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    match palette {
        Some(palette) => {
            encoder.set_color(ColorType::Indexed);
            encoder.set_palette(palette.colours.as_flattened().to_vec());
            encoder.set_filter(Filter::NoFilter);
        }
        None => {
            encoder.set_color(ColorType::Rgb);
            encoder.set_filter(Filter::Up);
        }
    }
    if frames.len() > 1 {
        let delay = CYCLE_SECONDS * 1000.0 / frames.len() as f64;
        encoder.set_animated(frames.len() as u32, 0)?;
        encoder.set_frame_delay(delay.round() as u16, 1000)?;
    }
    let mut writer = encoder.write_header()?;
    for frame in frames {
        match palette {
            Some(palette) => writer.write_image_data(&palette.indices(frame))?,
            None => writer.write_image_data(frame.pixels.as_flattened())?,
        }
    }
    writer.finish()
}

/// The colours of some pictures, where there are at most 256 of them.
struct Palette {
    colours: Vec<Rgb>,
    index: HashMap<Rgb, u8>,
}

impl Palette {
    fn of(frames: &[&Raster]) -> Option<Self> {
        let mut palette = Self { colours: Vec::new(), index: HashMap::new() };
        let mut last = None;
        for &colour in frames.iter().flat_map(|frame| &frame.pixels) {
            if last != Some(colour) {
                palette.add(colour)?;
                last = Some(colour);
            }
        }
        Some(palette)
    }

    fn add(&mut self, colour: Rgb) -> Option<()> {
        if !self.index.contains_key(&colour) {
            let next = u8::try_from(self.colours.len()).ok()?;
            self.colours.push(colour);
            self.index.insert(colour, next);
        }
        Some(())
    }

    fn indices(&self, frame: &Raster) -> Vec<u8> {
        let mut last = ([0; 3], self.index.get(&[0; 3]).copied().unwrap_or(0));
        let index = |&colour: &Rgb| {
            if last.0 != colour {
                last = (colour, self.index.get(&colour).copied().unwrap_or(0));
            }
            last.1
        };
        frame.pixels.iter().map(index).collect()
    }
}

/// Pictures without a size, of unlike sizes, or of unlike numbers.
pub(super) fn mismatched() -> Fault {
    Fault::new(Text::new(
        "The pictures of the grading do not go together.",
        "採点の画像の大きさまたは枚数が一致していません。",
    ))
}
