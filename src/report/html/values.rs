//! What a wrong answer computes line by line, for the place that a reader picks.

use super::ReportFragment;
use super::film::PictureAddresses;
use super::sheet::SheetGrid;
use crate::fault::Fault;
use crate::language::Language;
use crate::report::encode::{Raster, encode};
use crate::report::labels::Labels;
use crate::report::text::number;
use crate::report::{OwnValues, Pictures, Report, RubricLine, ValueAt, ValueLine, ValuePlace};
use reference::Assignment;

/// A picture inside of a page takes at most so many bytes, before it is written as text. Where it would take more, it gets smaller.
const MOST_BYTES: usize = 4_000;

/// Widths of that picture, in pixels, which are tried in turn: each in its own colours, then in steps of 16. It only shows where a place is.
const WIDTHS: [usize; 4] = [240, 160, 120, 80];

/// The columns of a matrix, by the count of its numbers.
const MATRICES: [(usize, usize); 2] = [(9, 3), (16, 4)];

/// What the page shows of the values.
pub(super) struct ValuesView {
    pub title: &'static str,
    pub about: &'static str,
    /// What the signs of right values mean.
    pub legend: &'static str,
    pub heads: [&'static str; 4],
    /// Whether anything is known of what values should be.
    pub has_right: bool,
    pub places: Vec<PlaceView>,
    pub still: Option<Still>,
    pub lines: Vec<LineView>,
}

/// A place that can be picked.
pub(super) struct PlaceView {
    pub label: String,
    pub is_right: bool,
    /// What is seen there.
    pub seen: String,
    /// In the picture's pixels.
    pub mark: Option<[f64; 2]>,
}

/// The picture of the frame that the places are in.
pub(super) struct Still {
    pub address: String,
    pub alt: String,
    /// The picture, and where the image lies that holds it.
    pub size: [u32; 2],
    pub image: [i64; 4],
    pub radius: f64,
}

/// A statement.
pub(super) struct LineView {
    /// The file, where another one begins.
    pub file: Option<String>,
    pub anchor: String,
    pub line: u32,
    pub name: String,
    /// The function that it is in, and how often it runs.
    pub aside: Option<String>,
    pub is_called: bool,
    pub means: Option<String>,
    pub cells: Vec<ValueCell>,
}

/// A value at a place, and what it should be.
pub(super) struct ValueCell {
    pub value: String,
    pub right: String,
    /// Whether it is not right, and the first one that is not.
    pub is_wrong: bool,
    pub is_first: bool,
}

impl ValuesView {
    pub fn of(part: &ReportFragment<'_>, values: &OwnValues, anchor: impl Fn(&ValueLine) -> Option<String>) -> Self {
        let ReportFragment { assignment, report, language, .. } = *part;
        let labels = Labels::of(language);
        let say = |en: &'static str, ja: &'static str| if language == Language::En { en } else { ja };
        let is_said = |line: &ValueLine| {
            let is_it = |said: &RubricLine| {
                let file = line.file.is_none() || said.file == line.file;
                said.points < said.max_points && said.line == Some(line.line) && file
            };
            report.rubric.iter().any(is_it)
        };
        let first = values.first_wrong(is_said);
        let all = || values.lines.iter().flat_map(|line| &line.values).flatten();
        let places = values.places.iter().enumerate();
        Self {
            title: say("Your values, line by line", "1 行ずつ見る計算の値"),
            about: say(
                "Pick a place: the table has what each line computes there, in the order in which the lines run.",
                "場所を選ぶと、そこで各行が計算した値を実行の順に表示します。",
            ),
            legend: say(
                "✓ is what it should be. Where nothing stands, there may be several ways.",
                "✓ は正しい値です。空欄の行は、書き方によって値が変わることがあるものです。",
            ),
            heads: [say("Line", "行"), say("Variable", "変数"), labels.yours, say("Should be", "本来の値")],
            has_right: all().any(|value| value.right.is_some()),
            places: places.map(|(at, place)| PlaceView::of(assignment, report, at, place, language)).collect(),
            still: part.gallery.and_then(|gallery| Still::of(assignment, report, gallery, values, language)),
            lines: values
                .lines
                .iter()
                .enumerate()
                .map(|(at, line)| {
                    let before = at.checked_sub(1).map(|before| &values.lines[before].file);
                    let file = line.file.clone().filter(|_| before != Some(&line.file));
                    LineView { file, ..LineView::of(line, anchor(line), at, &first, language) }
                })
                .collect(),
        }
    }
}

impl PlaceView {
    fn of(assignment: &Assignment, report: &Report, at: usize, place: &ValuePlace, language: Language) -> Self {
        let labels = Labels::of(language);
        let english = language == Language::En;
        let what = match (place.pixel, place.at, english) {
            (Some([x, y]), _, true) => format!("Pixel ({x}, {y})"),
            (Some([x, y]), _, false) => format!("画素 ({x}, {y})"),
            (None, Some(_), true) => "Vertex".into(),
            (None, Some(_), false) => "頂点".into(),
            (None, None, true) => "Probe".into(),
            (None, None, false) => "検査点".into(),
        };
        let colour = |all: &[Option<f64>]| if all.is_empty() { "discard".into() } else { written(all) };
        let frame = place.frame.and_then(|frame| report.frames.get(frame as usize));
        let moment = frame.map_or_else(String::new, |frame| format!("t = {} · ", number(frame.t)));
        let [yours, right] = [&place.yours, &place.right].map(|all| colour(all));
        let size = [assignment.scene.width, assignment.scene.height].map(f64::from);
        let word = if place.agrees { labels.agrees } else { labels.differs };
        Self {
            label: format!("{} · {what} · {word}", at + 1),
            is_right: place.agrees,
            seen: format!("{moment}RGB · {} {yours} · {} {right}", labels.yours, labels.expected),
            mark: place.at.map(|[x, y]| [(x * size[0]).round(), (y * size[1]).round()]),
        }
    }
}

impl Still {
    fn of(
        assignment: &Assignment,
        report: &Report,
        gallery: &PictureAddresses,
        values: &OwnValues,
        language: Language,
    ) -> Option<Self> {
        let frame = values.places.iter().find_map(|place| place.frame)? as usize;
        let [width, height] = [assignment.scene.width, assignment.scene.height];
        let grid = SheetGrid::of(report.frames.len().max(1));
        let [across, down] = [i64::from(width), i64::from(height)];
        let (address, image) = match &gallery.still {
            Some(still) => (still.clone(), [0, 0, across, down]),
            // A sheet inside of the page would stand in it twice.
            None if gallery.yours.starts_with("data:") => return None,
            None => {
                let [column, row] = [(frame % grid.columns) as i64, (frame / grid.columns) as i64];
                let size = [grid.columns as i64 * across, grid.rows as i64 * down];
                (gallery.yours.clone(), [-column * across, -row * down, size[0], size[1]])
            }
        };
        let t = number(report.frames.get(frame)?.t);
        let alt = match language {
            Language::En => format!("What your shader draws at t = {t}, with the places in it."),
            Language::Ja => format!("t = {t} で提出したシェーダが描く画像と、選べる場所。"),
        };
        Some(Self { address, alt, size: [width, height], image, radius: f64::from(width) / 36.0 })
    }
}

/// The picture of the frame that the values are from, small enough to stand in a page beside the others.
pub(super) fn still(report: &Report, pictures: &Pictures) -> Result<Option<Vec<u8>>, Fault> {
    let place = report.own_values.iter().flat_map(|values| &values.places).find_map(|place| place.frame);
    let Some(picture) = place.and_then(|frame| pictures.yours.get(frame as usize)) else { return Ok(None) };
    let whole = Raster::opaque(picture)?;
    for width in WIDTHS {
        let mut small = whole.reduced(whole.width.div_ceil(width).max(1));
        let png = encode(&small)?;
        if png.len() <= MOST_BYTES {
            return Ok(Some(png));
        }
        small.pixels.as_flattened_mut().iter_mut().for_each(|channel| *channel = *channel & 0xf0 | *channel >> 4);
        let coarse = encode(&small)?;
        if coarse.len() <= MOST_BYTES {
            return Ok(Some(coarse));
        }
    }
    Ok(None)
}

impl LineView {
    fn of(line: &ValueLine, anchor: Option<String>, at: usize, first: &[Option<usize>], language: Language) -> Self {
        let times = match (line.times, language) {
            (0 | 1, _) => None,
            (times, Language::En) => Some(format!("last of {times} times")),
            (times, Language::Ja) => Some(format!("{times} 回のうち最後")),
        };
        let function = line.function.as_ref().map(|function| format!("{function}()"));
        let aside: Vec<String> = function.into_iter().chain(times).collect();
        let cell = |(place, value): (usize, &Option<ValueAt>)| match value {
            None => ValueCell { value: "–".into(), right: String::new(), is_wrong: false, is_first: false },
            Some(value) => ValueCell {
                value: written(&value.value),
                right: match value.agrees {
                    None => String::new(),
                    Some(true) => "✓".into(),
                    Some(false) => value.right.as_deref().map(written).unwrap_or_default(),
                },
                is_wrong: value.agrees == Some(false),
                is_first: first.get(place) == Some(&Some(at)),
            },
        };
        Self {
            file: None,
            anchor: anchor.unwrap_or_default(),
            line: line.line,
            name: line.name.clone(),
            aside: (!aside.is_empty()).then(|| aside.join(" · ")),
            is_called: line.function.is_some(),
            means: line.means.as_ref().map(|means| means.get(language).to_owned()),
            cells: line.values.iter().enumerate().map(cell).collect(),
        }
    }
}

/// Numbers with four significant places; what is no number is called so. The columns of a matrix are parted.
fn written(all: &[Option<f64>]) -> String {
    let numbers: Vec<String> = all.iter().map(|number| number.map_or_else(|| "NaN".into(), short)).collect();
    let columns = MATRICES.iter().find(|(count, _)| *count == all.len()).map(|(_, each)| *each);
    match (columns, numbers.as_slice()) {
        (_, [only]) => only.clone(),
        (None, all) => format!("({})", all.join(", ")),
        (Some(each), all) => {
            let columns: Vec<String> = all.chunks(each).map(|column| column.join(", ")).collect();
            format!("({})", columns.join(" | "))
        }
    }
}

/// Beyond these a number is written with a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-4..1e6;

fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".into();
    }
    if !PLAIN.contains(&size) {
        return format!("{value:.2e}");
    }
    let scale = 10_f64.powi(3 - size.log10().floor() as i32).clamp(1.0, 1e6);
    format!("{}", (value * scale).round() / scale).replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_matrices_are_parted() {
        let some = |all: &[f64]| written(&all.iter().copied().map(Some).collect::<Vec<_>>());
        assert_eq!(some(&[0.333333]), "0.3333");
        assert_eq!(some(&[-1.0, 123456.0, 0.0]), "(−1, 123456, 0)");
        assert_eq!(some(&[1.5e-7]), "1.50e-7");
        assert_eq!(some(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]), "(1, 0, 0 | 0, 1, 0 | 0, 0, 1)");
        assert_eq!(written(&[None, Some(2.0)]), "(NaN, 2)");
    }
}
