//! The pictures of a grading as PNG files: each frame, and all of them as one animation.
//!
//! Alpha is not seen in the course's window: every file is opaque.

use super::difference::difference;
use super::{Picture, Pictures};
use crate::fault::Fault;
use crate::language::Text;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Seconds that the animation takes, as in the course's program.
pub const CYCLE_SECONDS: f64 = 5.0;
/// Pixels between the pictures of the animation, and their colour.
const GAP: usize = 8;
const GAP_COLOUR: Rgb = [0x80; 3];

type Rgb = [u8; 3];

/// An opaque picture, top row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Raster {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<Rgb>,
}

/// One pose: what was drawn, what is expected, and where they differ.
#[derive(Clone, Debug)]
pub(super) struct Pose {
    pub yours: Raster,
    pub expected: Raster,
    pub difference: Raster,
}

impl Raster {
    /// The picture without its alpha; a fault when its size and its bytes do not go together.
    pub fn opaque(picture: &Picture) -> Result<Self, Fault> {
        let (width, height) = (picture.width as usize, picture.height as usize);
        if width == 0 || height == 0 || picture.rgba.len() != width * height * 4 {
            return Err(mismatched());
        }
        let pixels = picture.rgba.chunks_exact(4).map(|p| [p[0], p[1], p[2]]);
        Ok(Self {
            width,
            height,
            pixels: pixels.collect(),
        })
    }

    fn rows(&self) -> impl Iterator<Item = &[Rgb]> {
        self.pixels.chunks_exact(self.width)
    }
}

impl Pose {
    /// The pose drawn from two pictures of one size.
    pub fn of(yours: &Picture, expected: &Picture) -> Result<Self, Fault> {
        if (yours.width, yours.height) != (expected.width, expected.height) {
            return Err(mismatched());
        }
        let (yours_raster, expected_raster) = (Raster::opaque(yours)?, Raster::opaque(expected)?);
        Ok(Self {
            difference: Raster {
                pixels: difference(yours, expected),
                ..expected_raster
            },
            expected: Raster::opaque(expected)?,
            yours: yours_raster,
        })
    }

    /// Every pose of a grading, in order.
    pub fn all(pictures: &Pictures) -> Result<Vec<Self>, Fault> {
        if pictures.yours.len() != pictures.expected.len() {
            return Err(mismatched());
        }
        let pairs = pictures.yours.iter().zip(&pictures.expected);
        pairs
            .map(|(yours, expected)| Self::of(yours, expected))
            .collect()
    }

    fn side_by_side(&self) -> Raster {
        let rows = self
            .yours
            .rows()
            .zip(self.expected.rows())
            .zip(self.difference.rows());
        let gap = [GAP_COLOUR; GAP];
        let pixels = rows
            .flat_map(|((a, b), c)| [a, &gap, b, &gap, c].concat())
            .collect();
        Raster {
            width: 3 * self.yours.width + 2 * GAP,
            height: self.yours.height,
            pixels,
        }
    }
}

/// Writes `yours-00.png`, `expected-00.png`, `difference-00.png` and so on into a directory, which
/// is made when it is missing, and `animation.png`: all poses side by side, as an animated PNG.
///
/// Returns the files that it wrote: none when nothing was drawn.
pub fn write(pictures: &Pictures, directory: &Path) -> Result<Vec<PathBuf>, Fault> {
    let poses = Pose::all(pictures)?;
    fs::create_dir_all(directory).map_err(|error| unwritable(directory, &error))?;
    let mut written = Vec::new();
    let mut save = |name: String, bytes: Vec<u8>| {
        let path = directory.join(name);
        let done = fs::write(&path, bytes).map_err(|error| unwritable(&path, &error));
        written.push(path);
        done
    };
    for (index, pose) in poses.iter().enumerate() {
        save(format!("yours-{index:02}.png"), encode(&[&pose.yours])?)?;
        save(
            format!("expected-{index:02}.png"),
            encode(&[&pose.expected])?,
        )?;
        save(
            format!("difference-{index:02}.png"),
            encode(&[&pose.difference])?,
        )?;
    }
    if !poses.is_empty() {
        save("animation.png".into(), animate(&poses)?)?;
    }
    Ok(written)
}

/// The poses as one animated PNG, which repeats for ever: yours, expected and difference, from the left.
pub fn animation(pictures: &Pictures) -> Result<Vec<u8>, Fault> {
    animate(&Pose::all(pictures)?)
}

/// One picture as an opaque PNG.
pub fn png(picture: &Picture) -> Result<Vec<u8>, Fault> {
    encode(&[&Raster::opaque(picture)?])
}

fn animate(poses: &[Pose]) -> Result<Vec<u8>, Fault> {
    let frames: Vec<Raster> = poses.iter().map(Pose::side_by_side).collect();
    encode(&frames.iter().collect::<Vec<_>>())
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

fn write_frames(
    frames: &[&Raster],
    palette: Option<&Palette>,
    out: &mut Vec<u8>,
) -> Result<(), png::EncodingError> {
    let (width, height) = frames
        .first()
        .map_or((0, 0), |frame| (frame.width, frame.height));
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
        let mut palette = Self {
            colours: Vec::new(),
            index: HashMap::new(),
        };
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

fn mismatched() -> Fault {
    Fault::new(Text::new(
        "The pictures of the grading do not go together.",
        "採点の画像の大きさまたは枚数が一致していません。",
    ))
}

fn unwritable(path: &Path, error: &std::io::Error) -> Fault {
    let path = path.display();
    Fault::new(Text::new(
        format!("Cannot write {path}: {error}."),
        format!("{path} に書き込めません（{error}）。"),
    ))
    .remedy(Text::new(
        "Name a directory that you may write to, on a disk with room.",
        "書き込みができ、空き容量のあるディレクトリを指定してください。",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples::{self, HEIGHT, WIDTH};

    fn decoded(bytes: &[u8]) -> Raster {
        let image = image::load_from_memory(bytes).expect("a PNG");
        assert!(!image.color().has_alpha());
        let rgb = image.to_rgb8();
        Raster {
            width: rgb.width() as usize,
            height: rgb.height() as usize,
            pixels: rgb.pixels().map(|p| p.0).collect(),
        }
    }

    /// Every pixel another colour: too many for a palette.
    fn colourful() -> Picture {
        let rgba = (0..400u32).flat_map(|i| [(i % 256) as u8, (i / 256) as u8, 9, 0]);
        Picture {
            width: 20,
            height: 20,
            rgba: rgba.collect(),
        }
    }

    #[test]
    fn a_picture_comes_back_without_its_alpha() {
        for picture in [&samples::pictures().yours[0], &colourful()] {
            let expected = Raster::opaque(picture).expect("a sound picture");
            assert_eq!(decoded(&png(picture).expect("a PNG")), expected);
        }
    }

    #[test]
    fn the_animation_has_every_pose_and_takes_the_cycle() {
        let pictures = samples::pictures();
        let bytes = animation(&pictures).expect("a PNG");
        let decoder = png::Decoder::new(std::io::Cursor::new(&bytes));
        let mut reader = decoder.read_info().expect("a header");
        let control = reader.info().animation_control.expect("an animation");
        assert_eq!((control.num_frames, control.num_plays), (25, 0));
        // Three pictures of 80 pixels and two gaps of 8.
        assert_eq!(reader.info().size(), (3 * WIDTH + 16, HEIGHT));
        let mut milliseconds = 0;
        for _ in 0..25 {
            let mut buffer = vec![0; reader.output_buffer_size().expect("a size")];
            reader.next_frame(&mut buffer).expect("a frame");
            let control = reader.info().frame_control.expect("a frame control");
            assert_eq!(control.delay_den, 1000);
            milliseconds += u32::from(control.delay_num);
        }
        assert_eq!(milliseconds, 5000);
    }

    #[test]
    fn the_files_are_those_of_every_pose() {
        let directory = tempfile::tempdir().expect("a directory");
        let target = directory.path().join("new/frames");
        let pictures = samples::pictures();
        let written = write(&pictures, &target).expect("files");
        assert_eq!(written.len(), 25 * 3 + 1);
        let read = |name: &str| decoded(&fs::read(target.join(name)).expect(name));
        let expected = |picture| Raster::opaque(picture).expect("a sound picture");
        assert_eq!(read("yours-07.png"), expected(&pictures.yours[7]));
        assert_eq!(read("expected-24.png"), expected(&pictures.expected[24]));
        assert_ne!(read("difference-00.png"), read("yours-00.png"));
        assert_eq!(read("animation.png").width, 3 * WIDTH as usize + 16);
    }

    #[test]
    fn nothing_drawn_writes_nothing() {
        let directory = tempfile::tempdir().expect("a directory");
        assert_eq!(
            write(&Pictures::default(), directory.path()).expect("no fault"),
            [] as [PathBuf; 0]
        );
        assert!(animation(&Pictures::default()).is_err());
    }

    #[test]
    fn an_unwritable_place_is_a_fault_with_its_path() {
        let directory = tempfile::tempdir().expect("a directory");
        let file = directory.path().join("occupied");
        fs::write(&file, "").expect("a file");
        let fault = write(&samples::pictures(), &file).expect_err("a fault");
        assert!(fault.message.ja.contains("occupied") && fault.message.en.contains("occupied"));
        assert!(fault.remedy.is_some());
    }

    #[test]
    fn pictures_that_do_not_go_together_are_a_fault() {
        let mut one_short = samples::pictures();
        one_short.yours.pop();
        assert!(animation(&one_short).is_err());
        let mut other_size = samples::pictures();
        other_size.yours[3] = colourful();
        assert!(animation(&other_size).is_err());
        let mut truncated = samples::pictures();
        truncated.yours[3].rgba.pop();
        assert!(animation(&truncated).is_err());
    }
}
