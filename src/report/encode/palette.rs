//! Palettes of at most 256 colours: those that there are, or, where there are more, the ones that stand for them best.

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
    /// The place of a colour among all; none for the 257th.
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
    fn a_rare_colour_stays_itself_beside_many() {
        let mut pixels: Vec<Rgb> = (0..40_000).map(|i| [(i % 200) as u8, (i / 200) as u8, 40]).collect();
        pixels.push([255, 0, 255]);
        let (colours, indices) = reduced(&pixels);
        assert_eq!(colours.len(), MOST);
        assert_eq!(colours[usize::from(indices[40_000])], [255, 0, 255]);
    }
}
