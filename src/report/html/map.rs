//! The map that a pass draws, and where it is looked up for a pixel that is wrong.

use crate::language::Language;
use crate::report::encode::{Raster, encode};
use crate::report::{MapLookup, MapPlace};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use reference::Assignment;

/// The picture of a map is at most so many pixels wide and high.
const LARGEST: usize = 400;

/// Marks stay so far within the picture, in hundredths of its sides.
const MARGIN: f64 = 2.5;

/// What a report shows of a lookup.
pub(super) struct MapView {
    /// The picture, inside the page.
    pub address: String,
    pub width: usize,
    pub height: usize,
    /// In hundredths of the picture's sides from its upper left corner.
    pub yours: Vec<[f64; 2]>,
    pub right: Vec<[f64; 2]>,
    pub title: &'static str,
    /// What is seen in the picture.
    pub alt: String,
    pub about: String,
    pub told_yours: String,
    pub told_right: String,
}

impl MapView {
    /// `None` where the homework draws no such map.
    pub fn of(assignment: &Assignment, lookup: &MapLookup, language: Language) -> Option<Self> {
        let (size, depths) = assignment.drawn_map(lookup.texture as usize)?;
        let picture = picture(size, &depths);
        let address = format!("data:image/png;base64,{}", STANDARD.encode(encode(&picture).ok()?));
        let [x, y] = lookup.pixel;
        let frame = lookup.frame + 1;
        let say = |en: String, ja: String| if language == Language::En { en } else { ja };
        Some(Self {
            address,
            width: picture.width,
            height: picture.height,
            yours: lookup.yours.iter().map(mark).collect(),
            right: lookup.right.iter().map(mark).collect(),
            title: if language == Language::En { "The lookup of the map" } else { "マップの参照位置" },
            alt: say(
                "The map as the program draws it: what is near is dark. Marks show where it is read.".into(),
                "プログラムが描いたマップ。近いところほど暗く、参照した位置に印があります。".into(),
            ),
            about: say(
                format!(
                    "Frame {frame}, the pixel in column {x} and row {y} (from above, from 0), amid those that differ most. What is near to the light is dark."
                ),
                format!(
                    "フレーム {frame} の、正解と異なる領域の中ほどの画素（左から {x}、上から {y}、0 から数えて）についての図です。光源に近いところほど暗く描いています。"
                ),
            ),
            told_yours: sentence(&lookup.yours, language),
            told_right: sentence(&lookup.right, language),
        })
    }
}

/// The map in greys, smaller where it is large: black is nearest, white what nothing was drawn to.
fn picture([width, height]: [usize; 2], depths: &[f32]) -> Raster {
    let step = width.max(height).div_ceil(LARGEST).max(1);
    let drawn = depths.iter().copied().filter(|depth| *depth < 1.0);
    let nearest = drawn.clone().fold(1.0, f32::min);
    let farthest = drawn.fold(nearest, f32::max);
    // What is drawn is never as bright as what is not.
    let grey = |depth: f32| match depth {
        depth if depth >= 1.0 => 255,
        depth => (200.0 * (depth - nearest) / (farthest - nearest).max(1e-6)).clamp(0.0, 200.0) as u8,
    };
    let [columns, rows] = [width, height].map(|side| (side / step).max(1));
    let pixel = |place: usize| {
        let (column, row) = (place % columns * step, (rows - 1 - place / columns) * step);
        [grey(depths.get(row * width + column).copied().unwrap_or(1.0)); 3]
    };
    Raster { width: columns, height: rows, pixels: (0..columns * rows).map(pixel).collect() }
}

/// A place in hundredths from the upper left corner; what is outside lies at the edge.
fn mark(place: &MapPlace) -> [f64; 2] {
    let [x, y] = [place.at[0], 1.0 - place.at[1]].map(|side| (100.0 * side).clamp(MARGIN, 100.0 - MARGIN));
    [x, y].map(|side| (side * 100.0).round() / 100.0)
}

fn is_outside(place: &MapPlace) -> bool {
    !place.at.iter().all(|side| (0.0..=1.0).contains(side))
}

/// Where it is looked up, in words.
fn sentence(places: &[MapPlace], language: Language) -> String {
    let english = language == Language::En;
    let [first, others @ ..] = places else {
        return if english { "does not read the map here" } else { "ここではマップを参照していません" }.into();
    };
    let number = |number: f64| format!("{number:.4}");
    let at = format!("({}, {})", number(first.at[0]), number(first.at[1]));
    let outside = match (is_outside(first), english) {
        (false, _) => "",
        (true, true) => ", outside of the map",
        (true, false) => "（マップの外）",
    };
    let several = match (others.len(), english) {
        (0, _) => String::new(),
        (more, true) => format!(", and {more} more"),
        (more, false) => format!(" ほか {more} か所"),
    };
    let stored = number(first.stored);
    match (first.depth.map(number), english) {
        (Some(depth), true) => format!("{at}{outside}{several}: {depth} is compared with {stored}"),
        (Some(depth), false) => format!("{at}{outside}{several}: {depth} を {stored} と比較"),
        (None, true) => format!("{at}{outside}{several}: {stored} is read"),
        (None, false) => format!("{at}{outside}{several}: {stored} を取得"),
    }
}
