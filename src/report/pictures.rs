//! The pictures of a grading as PNG files: each frame, and all of them as one animation.
//!
//! Alpha is not seen in the course's window: every file is opaque.

use super::difference::difference;
use super::encode::{Raster, encode, encode_animated, mismatched};
use super::{Picture, Pictures};
use crate::fault::Fault;
use crate::language::Text;
use std::fs;
use std::path::{Path, PathBuf};

/// Pixels between the pictures of the animation, and their colour.
const GAP: usize = 8;
const GAP_COLOUR: [u8; 3] = [0x80; 3];

/// One pose: what was drawn, what is expected, and where they differ.
#[derive(Clone, Debug)]
struct PosePictures {
    yours: Raster,
    expected: Raster,
    difference: Raster,
}

impl PosePictures {
    /// The pose of two pictures of one size.
    fn of(yours: &Picture, expected: &Picture) -> Result<Self, Fault> {
        let (yours_raster, expected_raster) = (Raster::opaque(yours)?, Raster::opaque(expected)?);
        Ok(Self {
            difference: Raster { pixels: difference(yours, expected), ..expected_raster },
            expected: Raster::opaque(expected)?,
            yours: yours_raster,
        })
    }

    /// Every pose of a grading, in order; a fault unless all pictures have one size.
    fn all(pictures: &Pictures) -> Result<Vec<Self>, Fault> {
        fit(&pictures.yours, &pictures.expected)?;
        let pairs = pictures.yours.iter().zip(pictures.expected.iter());
        pairs.map(|(yours, expected)| Self::of(yours, expected)).collect()
    }

    fn side_by_side(&self) -> Raster {
        let rows = self.yours.rows().zip(self.expected.rows()).zip(self.difference.rows());
        let gap = [GAP_COLOUR; GAP];
        let pixels = rows.flat_map(|((a, b), c)| [a, &gap, b, &gap, c].concat()).collect();
        Raster { width: 3 * self.yours.width + 2 * GAP, height: self.yours.height, pixels }
    }
}

/// A fault unless there are as many pictures of each kind, all whole and of one size.
pub(super) fn fit(yours: &[Picture], expected: &[Picture]) -> Result<(), Fault> {
    let size = |picture: &Picture| (picture.width, picture.height);
    let first = yours.first().map(size);
    let is_sound = |picture: &Picture| Some(size(picture)) == first && picture.is_sound();
    let fits = yours.len() == expected.len() && yours.iter().chain(expected).all(is_sound);
    if fits { Ok(()) } else { Err(mismatched()) }
}

/// Writes `yours-00.png`, `expected-00.png`, `difference-00.png` and so on into a directory, which
/// is made when it is missing, and `animation.png`: all poses side by side, as an animated PNG.
///
/// Returns the files that it wrote: none when nothing was drawn.
pub fn write(pictures: &Pictures, directory: &Path) -> Result<Vec<PathBuf>, Fault> {
    let poses = PosePictures::all(pictures)?;
    fs::create_dir_all(directory).map_err(|error| unwritable(directory, &error))?;
    let mut written = Vec::new();
    let mut save = |name: String, bytes: Vec<u8>| {
        let path = directory.join(name);
        let done = fs::write(&path, bytes).map_err(|error| unwritable(&path, &error));
        written.push(path);
        done
    };
    for (index, pose) in poses.iter().enumerate() {
        save(format!("yours-{index:02}.png"), encode(&pose.yours)?)?;
        save(format!("expected-{index:02}.png"), encode(&pose.expected)?)?;
        save(format!("difference-{index:02}.png"), encode(&pose.difference)?)?;
    }
    if !poses.is_empty() {
        save("animation.png".into(), animate(&poses, pictures.cycle)?)?;
    }
    Ok(written)
}

/// The poses as one animated PNG, which repeats for ever: yours, expected and difference, from the left.
pub fn animation(pictures: &Pictures) -> Result<Vec<u8>, Fault> {
    animate(&PosePictures::all(pictures)?, pictures.cycle)
}

/// One picture as an opaque PNG.
pub fn png(picture: &Picture) -> Result<Vec<u8>, Fault> {
    encode(&Raster::opaque(picture)?)
}

/// Where two pictures of one size differ, as a PNG.
pub fn difference_png(yours: &Picture, expected: &Picture) -> Result<Vec<u8>, Fault> {
    encode(&PosePictures::of(yours, expected)?.difference)
}

/// Some pictures of one size as one animated PNG, which takes `cycle` seconds and repeats for ever.
pub fn animated(pictures: &[Picture], cycle: f64) -> Result<Vec<u8>, Fault> {
    let frames = pictures.iter().map(Raster::opaque).collect::<Result<Vec<_>, _>>()?;
    encode_animated(&frames.iter().collect::<Vec<_>>(), cycle)
}

/// The picture in a PNG of ours.
pub fn decode(png: &[u8]) -> Result<Picture, Fault> {
    let image = image::load_from_memory_with_format(png, image::ImageFormat::Png).map_err(|_| mismatched())?.to_rgba8();
    Ok(Picture::whole(image.width(), image.height(), image.into_raw()))
}

fn animate(poses: &[PosePictures], cycle: f64) -> Result<Vec<u8>, Fault> {
    let frames: Vec<Raster> = poses.iter().map(PosePictures::side_by_side).collect();
    encode_animated(&frames.iter().collect::<Vec<_>>(), cycle)
}

fn unwritable(path: &Path, error: &std::io::Error) -> Fault {
    let path = path.display();
    Fault::new(Text::new(format!("Cannot write {path}: {error}."), format!("{path} に書き込めません（{error}）。")))
        .remedy(Text::new(
            "Name a directory that you may write to, on a disk with room.",
            "書き込みができ、空き容量のあるディレクトリを指定してください。",
        ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples::{self, HEIGHT, WIDTH};
    use std::sync::Arc;

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
        Picture::whole(20, 20, rgba.collect())
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
        assert_eq!(write(&Pictures::default(), directory.path()).expect("no fault"), [] as [PathBuf; 0]);
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
        one_short.yours = one_short.yours[1..].into();
        assert!(animation(&one_short).is_err());
        let mut other_size = samples::pictures();
        Arc::make_mut(&mut other_size.yours)[3] = colourful();
        assert!(animation(&other_size).is_err());
        let mut truncated = samples::pictures();
        Arc::make_mut(&mut truncated.yours)[3].rgba.pop();
        assert!(animation(&truncated).is_err());
    }
}
