//! Pictures as bytes, small enough to be kept and sent.

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use reference::Assignment;
use reference::rasteriser::{Coverage, Frame};
use std::io::{self, Read, Write};
use std::sync::Arc;

/// Bytes of a run: its coverage, and its length.
const RUN: usize = 5;

/// The pictures of an assignment, packed. Cheap to clone.
#[derive(Clone, PartialEq, Eq)]
pub struct Pack(Arc<[u8]>);

impl std::fmt::Debug for Pack {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Pack({} bytes)", self.0.len())
    }
}

/// The bytes are not the pictures of the assignment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Damaged;

impl From<io::Error> for Damaged {
    fn from(_: io::Error) -> Self {
        Self
    }
}

impl Pack {
    /// What a [`Packer`] wrote, here or elsewhere.
    pub fn of_bytes(bytes: &[u8]) -> Self {
        Self(bytes.into())
    }

    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.0
    }

    /// The pictures, one at a time; the first that is damaged is the last.
    pub fn frames<'a>(&'a self, assignment: &'a Assignment) -> impl Iterator<Item = Result<Frame, Damaged>> + 'a {
        let scene = &assignment.scene;
        let mut input = DeflateDecoder::new(self.bytes());
        let mut left = super::count(assignment);
        std::iter::from_fn(move || {
            left = left.checked_sub(1)?;
            let mut frame = Frame::cleared(scene.width, scene.height, scene.background);
            let unpacked = unpack(&mut input, &mut frame).and_then(|()| match left {
                0 => at_end(&mut input),
                _ => Ok(()),
            });
            if unpacked.is_err() {
                left = 0;
            }
            Some(unpacked.map(|()| frame))
        })
    }
}

/// Packs pictures, one after the other.
#[derive(Debug)]
pub struct Packer(DeflateEncoder<Vec<u8>>);

impl Default for Packer {
    fn default() -> Self {
        Self(DeflateEncoder::new(Vec::new(), Compression::fast()))
    }
}

impl Packer {
    /// Adds the next picture: runs of alike coverage, row by row, each with its colours where there are any. A colour is
    /// written as its difference from its left neighbour, which is the same number in most of a smooth picture.
    pub fn add(&mut self, frame: &Frame) -> io::Result<()> {
        let mut row = Vec::new();
        let width = frame.width.max(1) as usize;
        for (coverage, pixels) in frame.coverage.chunks_exact(width).zip(frame.pixels.chunks_exact(width)) {
            row.clear();
            let mut pixels = pixels.iter();
            for alike in coverage.chunk_by(|a, b| a == b) {
                row.push(alike[0] as u8);
                row.extend((alike.len() as u32).to_le_bytes());
                let mut last = [0; 4];
                for colour in pixels.by_ref().take(alike.len()) {
                    if alike[0] != Coverage::Outside {
                        row.extend([0, 1, 2, 3].map(|channel| colour[channel].wrapping_sub(last[channel])));
                        last = *colour;
                    }
                }
            }
            self.0.write_all(&row)?;
        }
        Ok(())
    }

    /// All of them.
    pub fn finish(self) -> io::Result<Pack> {
        Ok(Pack(self.0.finish()?.into()))
    }
}

fn unpack(input: &mut impl Read, frame: &mut Frame) -> Result<(), Damaged> {
    let width = frame.width.max(1) as usize;
    let mut colours = Vec::new();
    for (coverages, pixels) in frame.coverage.chunks_exact_mut(width).zip(frame.pixels.chunks_exact_mut(width)) {
        let mut column = 0;
        while column < width {
            let mut head = [0; RUN];
            input.read_exact(&mut head)?;
            let [kind, length @ ..] = head;
            let length = u32::from_le_bytes(length) as usize;
            let coverage = coverage(kind).ok_or(Damaged)?;
            let end = column.checked_add(length).filter(|end| (column + 1..=width).contains(end)).ok_or(Damaged)?;
            coverages[column..end].fill(coverage);
            if coverage != Coverage::Outside {
                colours.resize(4 * length, 0);
                input.read_exact(&mut colours)?;
                let mut last = [0_u8; 4];
                for (pixel, difference) in pixels[column..end].iter_mut().zip(colours.as_chunks::<4>().0) {
                    last = [0, 1, 2, 3].map(|channel| last[channel].wrapping_add(difference[channel]));
                    *pixel = last;
                }
            }
            column = end;
        }
    }
    Ok(())
}

fn at_end(input: &mut impl Read) -> Result<(), Damaged> {
    if input.read(&mut [0])? == 0 { Ok(()) } else { Err(Damaged) }
}

fn coverage(kind: u8) -> Option<Coverage> {
    [Coverage::Outside, Coverage::Interior, Coverage::Silhouette].into_iter().find(|coverage| *coverage as u8 == kind)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expected;

    fn assignment() -> &'static Assignment {
        reference::assignment("ggsample06").expect("built in")
    }

    fn packed() -> Pack {
        let mut packer = Packer::default();
        expected::frames(assignment()).for_each(|frame| packer.add(&frame).expect("in memory"));
        packer.finish().expect("in memory")
    }

    #[test]
    fn pictures_come_back_as_they_were() {
        let pack = packed();
        let unpacked: Vec<Frame> = pack.frames(assignment()).collect::<Result<_, _>>().expect("whole");
        assert_eq!(unpacked, expected::frames(assignment()).collect::<Vec<_>>());
        assert_eq!(unpacked.len(), expected::count(assignment()));
    }

    #[test]
    fn damage_is_found_and_never_more() {
        let pack = packed();
        let is_whole = |bytes: &[u8]| Pack::of_bytes(bytes).frames(assignment()).all(|frame| frame.is_ok());
        assert!(is_whole(pack.bytes()));
        for length in [0, 1, pack.bytes().len() / 2, pack.bytes().len() - 1] {
            assert!(!is_whole(&pack.bytes()[..length]), "{length} bytes");
        }
        // Whatever a byte becomes, nothing panics.
        for at in (0..pack.bytes().len()).step_by(97) {
            let mut bytes = pack.bytes().to_vec();
            bytes[at] ^= 0x55;
            is_whole(&bytes);
        }
        let mut more = DeflateEncoder::new(Vec::new(), Compression::fast());
        io::copy(&mut DeflateDecoder::new(pack.bytes()), &mut more).expect("in memory");
        more.write_all(&[0]).expect("in memory");
        assert!(!is_whole(&more.finish().expect("in memory")), "bytes after the last picture");
    }
}
