//! PNG files.

use super::TexturePicture;
use std::fmt;
use std::io::Cursor;

/// Bytes that the decoder may keep beside the picture: a row, and what the file says of itself.
const LIMIT: usize = 16 << 20;

/// Why a file is not a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BrokenPicture {
    /// It is something else, with its name.
    Not(&'static str),
    /// It is larger: width and height.
    TooLarge(u32, u32),
    /// It is damaged: what the decoder says.
    Damaged(String),
}

impl fmt::Display for BrokenPicture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Not(what) => write!(f, "is {what}"),
            Self::TooLarge(width, height) => write!(f, "is {width} × {height} pixels large"),
            Self::Damaged(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for BrokenPicture {}

/// What other files begin with.
const OTHERS: &[(&[u8], &str)] = &[
    (b"\xff\xd8\xff", "a JPEG file"),
    (b"GIF8", "a GIF file"),
    (b"BM", "a BMP file"),
    (b"RIFF", "a WebP file"),
    (b"DDS ", "a DDS file"),
    (b"\xabKTX", "a KTX file"),
    (b"#?RADIANCE", "a Radiance HDR file"),
    (b"version https://git-lfs", "a Git LFS pointer instead of the picture"),
];

/// The picture of a PNG file, the first row of the file first. A picture with a palette or with grey levels becomes RGBA as
/// `stb_image` makes it; of 16 bits the upper 8 are kept. Gamma and colour profiles are not applied.
///
/// # Errors
/// It is no PNG, or has more pixels than `most`.
pub fn read(bytes: &[u8], most: usize) -> Result<TexturePicture<u8>, BrokenPicture> {
    if let Some((_, what)) = OTHERS.iter().find(|(head, _)| bytes.starts_with(head)) {
        return Err(BrokenPicture::Not(what));
    }
    let damaged = |e: png::DecodingError| BrokenPicture::Damaged(e.to_string());
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: LIMIT });
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    decoder.ignore_checksums(false);
    let (width, height) = {
        let header = decoder.read_header_info().map_err(damaged)?;
        (header.width, header.height)
    };
    if width as usize as u64 * u64::from(height) > most as u64 {
        return Err(BrokenPicture::TooLarge(width, height));
    }
    let mut reader = decoder.read_info().map_err(damaged)?;
    let size = reader.output_buffer_size().ok_or(BrokenPicture::TooLarge(width, height))?;
    let mut buffer = vec![0; size];
    let info = reader.next_frame(&mut buffer).map_err(damaged)?;
    let pixels = &buffer[..info.buffer_size()];
    let texels = match info.color_type {
        png::ColorType::Grayscale => pixels.iter().map(|&grey| [grey, grey, grey, u8::MAX]).collect(),
        png::ColorType::GrayscaleAlpha => {
            pixels.as_chunks().0.iter().map(|&[grey, alpha]| [grey, grey, grey, alpha]).collect()
        }
        png::ColorType::Rgb => pixels.as_chunks().0.iter().map(|&[r, g, b]| [r, g, b, u8::MAX]).collect(),
        png::ColorType::Rgba => pixels.as_chunks().0.to_vec(),
        png::ColorType::Indexed => return Err(BrokenPicture::Damaged("its palette is missing".into())),
    };
    let picture = TexturePicture { width: info.width as usize, height: info.height as usize, texels };
    let is_whole = picture.texels.len() == picture.width * picture.height && !picture.texels.is_empty();
    is_whole.then_some(picture).ok_or_else(|| BrokenPicture::Damaged("it has not all of its rows".into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(colour: png::ColorType, depth: png::BitDepth, palette: &[u8], data: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(colour);
        encoder.set_depth(depth);
        if !palette.is_empty() {
            encoder.set_palette(palette);
            encoder.set_trns(&[255, 7][..]);
        }
        encoder.write_header().expect("a header").write_image_data(data).expect("a row");
        bytes
    }

    #[test]
    fn every_kind_of_png_becomes_rgba() {
        use png::BitDepth::{Eight, One, Sixteen};
        use png::ColorType::{Grayscale, GrayscaleAlpha, Indexed, Rgb, Rgba};
        for (colour, depth, palette, data, expected) in [
            (Grayscale, Eight, &[][..], &[3, 200][..], [[3, 3, 3, 255], [200, 200, 200, 255]]),
            (Grayscale, One, &[], &[0b0100_0000], [[0, 0, 0, 255], [255; 4]]),
            (GrayscaleAlpha, Eight, &[], &[3, 4, 200, 5], [[3, 3, 3, 4], [200, 200, 200, 5]]),
            (Rgb, Eight, &[], &[1, 2, 3, 4, 5, 6], [[1, 2, 3, 255], [4, 5, 6, 255]]),
            (Rgba, Eight, &[], &[1, 2, 3, 4, 5, 6, 7, 8], [[1, 2, 3, 4], [5, 6, 7, 8]]),
            (Indexed, One, &[1, 2, 3, 4, 5, 6], &[0b0100_0000], [[1, 2, 3, 255], [4, 5, 6, 7]]),
            // The upper byte of 0x12ff is 0x12.
            (Grayscale, Sixteen, &[], &[0x12, 0xff, 0xab, 0x00], [[0x12, 0x12, 0x12, 255], [0xab, 0xab, 0xab, 255]]),
        ] {
            let picture = read(&encoded(colour, depth, palette, data), 2).expect("a picture");
            assert_eq!((picture.width, picture.height), (2, 1));
            assert_eq!(picture.texels, expected, "{colour:?} {depth:?}");
        }
    }

    #[test]
    fn what_is_no_picture_is_named() {
        assert_eq!(read(b"\xff\xd8\xff\xe0", 9), Err(BrokenPicture::Not("a JPEG file")));
        assert!(matches!(read(b"", 9), Err(BrokenPicture::Damaged(_))));
        let whole = encoded(png::ColorType::Rgb, png::BitDepth::Eight, &[], &[1, 2, 3, 4, 5, 6]);
        assert_eq!(read(&whole, 1), Err(BrokenPicture::TooLarge(2, 1)));
        // A file that ends early, and one with another bit, at every place.
        for at in 0..whole.len() {
            if let Ok(picture) = read(&whole[..at], 9) {
                assert_eq!(picture, read(&whole, 9).expect("a picture"), "cut at {at}");
            }
            for bit in 0..8 {
                let mut other = whole.clone();
                other[at] ^= 1 << bit;
                if let Ok(picture) = read(&other, 9) {
                    assert_eq!(picture.texels.len(), 2, "{at}, {bit}");
                }
            }
        }
    }

    #[test]
    fn a_picture_of_unbelievable_size_is_refused_by_its_head() {
        let mut bytes = encoded(png::ColorType::Rgb, png::BitDepth::Eight, &[], &[1, 2, 3, 4, 5, 6]);
        // Width and height stand behind signature, length and name of the first chunk; the checksum behind them.
        bytes[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
        let checksum = crc(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&checksum.to_be_bytes());
        assert_eq!(read(&bytes, 1 << 22), Err(BrokenPicture::TooLarge(0x7fff_ffff, 0x7fff_ffff)));
    }

    /// The checksum of the PNG specification, section D, bit by bit.
    fn crc(bytes: &[u8]) -> u32 {
        let of = |sum: u32, byte: &u8| {
            (0..8).fold(sum ^ u32::from(*byte), |sum, _| sum >> 1 ^ if sum & 1 == 1 { 0xedb8_8320 } else { 0 })
        };
        !bytes.iter().fold(u32::MAX, of)
    }
}
