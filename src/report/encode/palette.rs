//! Palettes of at most 256 colours: those that there are, or, where there are more, the ones that stand for them best.

use png::BitDepth;
use std::borrow::Cow;
use std::ops::Range;

pub(super) type Rgb = [u8; 3];

/// Most colours of a palette.
const MOST: usize = 256;

/// Bits of a channel by which colours are told apart where there are too many: four neighbours of 256 count as one, which is the
/// tolerance of the comparison.
const BITS: u32 = 6;

/// The colours of some pictures, at most 256, in the order in which they come.
#[derive(Clone)]
pub(super) struct Palette {
    pub colours: Vec<Rgb>,
    /// Where the colours are found: four times as many places as colours, so that few collide.
    places: [Option<u8>; 1024],
    last: Option<(Rgb, u8)>,
}

impl Default for Palette {
    fn default() -> Self {
        Self { colours: Vec::new(), places: [None; 1024], last: None }
    }
}

impl Palette {
    /// The place of a colour among all; `None` for the 257th.
    pub fn index(&mut self, colour: Rgb) -> Option<u8> {
        if let Some((last, index)) = self.last
            && last == colour
        {
            return Some(index);
        }
        let [r, g, b] = colour.map(u32::from);
        // 2³² divided by the golden ratio, as a hash: the upper ten bits.
        let mut place = ((r << 16 | g << 8 | b).wrapping_mul(0x9E37_79B9) >> 22) as usize;
        let index = loop {
            match self.places[place] {
                Some(index) if self.colours[usize::from(index)] == colour => break index,
                Some(_) => place = (place + 1) % self.places.len(),
                None => {
                    let index = u8::try_from(self.colours.len()).ok()?;
                    self.colours.push(colour);
                    self.places[place] = Some(index);
                    break index;
                }
            }
        };
        self.last = Some((colour, index));
        Some(index)
    }
}

/// The bits that a place among so many colours needs.
pub(super) fn depth(colours: usize) -> BitDepth {
    match colours {
        0..=2 => BitDepth::One,
        3..=4 => BitDepth::Two,
        5..=16 => BitDepth::Four,
        _ => BitDepth::Eight,
    }
}

/// Places in a palette, or whole bytes, as a PNG of this depth holds them: each row begins with a new byte.
pub(super) fn packed(places: &[u8], width: usize, depth: BitDepth) -> Cow<'_, [u8]> {
    match depth {
        BitDepth::One => pack::<8>(places, width).into(),
        BitDepth::Two => pack::<4>(places, width).into(),
        BitDepth::Four => pack::<2>(places, width).into(),
        BitDepth::Eight | BitDepth::Sixteen => places.into(),
    }
}

/// So many places in a byte, the first in its highest bits.
fn pack<const IN_A_BYTE: usize>(places: &[u8], width: usize) -> Vec<u8> {
    let bits = 8 / IN_A_BYTE;
    let byte = |places: &[u8]| {
        let shifted = places.iter().enumerate().map(|(i, place)| place << (8 - bits * (i + 1)));
        shifted.fold(0, |byte, place| byte | place)
    };
    let mut bytes = Vec::with_capacity(places.len().div_ceil(IN_A_BYTE));
    for row in places.chunks_exact(width) {
        let (whole, rest) = row.as_chunks::<IN_A_BYTE>();
        bytes.extend(whole.iter().map(|places| byte(places)));
        bytes.extend((!rest.is_empty()).then(|| byte(rest)));
    }
    bytes
}

/// Colours that are told apart from others, and how many pixels have them.
#[derive(Clone, Copy, Debug, Default)]
struct ColourBucket {
    bucket: usize,
    sums: [u64; 3],
    pixels: u64,
}

impl ColourBucket {
    fn mean(&self) -> Rgb {
        self.sums.map(|sum| u8::try_from((sum + self.pixels / 2) / self.pixels.max(1)).unwrap_or(u8::MAX))
    }
}

/// Cells that one colour is to stand for.
struct Group {
    cells: Range<usize>,
    /// The channel in which they are farthest apart.
    channel: usize,
    /// How much there is to gain where they are divided.
    gain: f64,
}

impl Group {
    fn of(all: &[ColourBucket], cells: Range<usize>) -> Self {
        let extent = |channel: usize| {
            let values = all[cells.clone()].iter().map(|cell| cell.mean()[channel]);
            values.clone().max().unwrap_or(0) - values.min().unwrap_or(0)
        };
        let channel = (0..3).max_by_key(|channel| extent(*channel)).unwrap_or(0);
        let pixels: u64 = all[cells.clone()].iter().map(|cell| cell.pixels).sum();
        // A colour that few pixels have is seen all the same where it is far off.
        let gain = f64::from(extent(channel)).powi(2) * (pixels as f64).powf(0.3);
        Self { cells, channel, gain }
    }
}

/// At most 256 colours that stand for those of the pixels, and the place among them for each pixel: of a group of colours that is
/// divided at the middle again and again, the mean.
pub(super) fn reduced(pixels: &[Rgb]) -> (Vec<Rgb>, Vec<u8>) {
    let mut table = vec![ColourBucket::default(); 1 << (3 * BITS)];
    // Most pixels are what their neighbour is.
    for run in pixels.chunk_by(|a, b| a == b) {
        let cell = &mut table[bucket(run[0])];
        cell.pixels += run.len() as u64;
        cell.sums.iter_mut().zip(run[0]).for_each(|(sum, level)| *sum += run.len() as u64 * u64::from(level));
    }
    let found = table.iter().enumerate().filter(|(_, cell)| cell.pixels > 0);
    let mut cells: Vec<ColourBucket> = found.map(|(bucket, cell)| ColourBucket { bucket, ..*cell }).collect();
    let mut groups = vec![Group::of(&cells, 0..cells.len())];
    while groups.len() < MOST {
        let widest = groups.iter().enumerate().max_by(|(_, a), (_, b)| a.gain.total_cmp(&b.gain));
        let Some((place, Group { cells: range, channel, .. })) = widest.filter(|(_, group)| group.gain > 0.0) else {
            break;
        };
        let (range, channel) = (range.clone(), *channel);
        let level = |cell: &ColourBucket| cell.mean()[channel];
        let group = &mut cells[range.clone()];
        group.sort_unstable_by_key(level);
        let middle = u16::from(level(&group[0])).midpoint(u16::from(level(&group[group.len() - 1])));
        let at = range.start + group.partition_point(|cell| u16::from(level(cell)) <= middle);
        groups[place] = Group::of(&cells, range.start..at);
        groups.push(Group::of(&cells, at..range.end));
    }
    let mut places = vec![0; table.len()];
    let mut colours = Vec::with_capacity(groups.len());
    for (place, group) in (0..=u8::MAX).zip(&groups) {
        let mut all = ColourBucket::default();
        for cell in &cells[group.cells.clone()] {
            places[cell.bucket] = place;
            all.pixels += cell.pixels;
            all.sums.iter_mut().zip(cell.sums).for_each(|(sum, own)| *sum += own);
        }
        colours.push(all.mean());
    }
    let indices = pixels.iter().map(|pixel| places[bucket(*pixel)]).collect();
    (colours, indices)
}

fn bucket(colour: Rgb) -> usize {
    colour.iter().fold(0, |bucket, level| bucket << BITS | usize::from(*level) >> (8 - BITS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_colours_as_a_palette_has_are_kept_within_the_tolerance() {
        let pixels: Vec<Rgb> = (0..=u8::MAX).flat_map(|level| [[level, 0, 255 - level]; 3]).collect();
        let (colours, indices) = reduced(&pixels);
        for (pixel, index) in pixels.iter().zip(indices) {
            let off = pixel.iter().zip(colours[usize::from(index)]).map(|(a, b)| a.abs_diff(b)).max();
            assert!(off <= Some(2), "{pixel:?} became {:?}", colours[usize::from(index)]);
        }
    }

    #[test]
    fn places_are_packed_row_by_row_from_the_highest_bits() {
        // Two rows of five pixels of four colours: 00 01 10 11 | 01…, 11 10 01 00 | 10…
        let places = [0, 1, 2, 3, 1, 3, 2, 1, 0, 2];
        assert_eq!(depth(4), BitDepth::Two);
        assert_eq!(packed(&places, 5, depth(4)), [0b0001_1011, 0b0100_0000, 0b1110_0100, 0b1000_0000].as_slice());
        assert_eq!(packed(&places, 5, depth(17)), places.as_slice());
    }

    #[test]
    fn a_rare_colour_stays_itself_beside_many() {
        let mut pixels: Vec<Rgb> = (0..40_000).map(|i| [(i % 200) as u8, (i / 200) as u8, 40]).collect();
        pixels.push([255, 0, 255]);
        let (colours, indices) = reduced(&pixels);
        assert_eq!(colours.len(), MOST);
        assert_eq!(colours[usize::from(indices[40_000])], [255, 0, 255]);
    }
}
