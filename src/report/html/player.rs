//! The moving pictures, their strip and their numbers.

use super::sheet::{Grid, Step, address};
use crate::fault::Fault;
use crate::language::Language;
use crate::report::difference::{BANDS, band_of};
use crate::report::encode::{CYCLE_SECONDS, Raster};
use crate::report::labels::Labels;
use crate::report::pictures::Pose;
use crate::report::text::number;
use crate::report::{FrameResult, Pictures, Report, TermPictures};

/// Bytes of a page's moving pictures. A right answer takes about 150 kB; a shader that draws noise
/// would take 20 MB, and is shown at a lower resolution instead.
const BUDGET: usize = 900_000;
/// Factors by which the pictures are reduced in turn until they fit.
const REDUCTIONS: [usize; 4] = [1, 2, 4, 8];

/// What the page needs for its moving pictures.
pub(super) struct Player {
    pub columns: usize,
    pub steps: Vec<Step>,
    pub cycle: f64,
    pub last: usize,
    pub panels: [Panel; 3],
    pub is_reduced: bool,
}

/// One of the moving pictures.
pub(super) struct Panel {
    pub id: &'static str,
    pub label: &'static str,
    pub address: String,
    pub width: usize,
    pub height: usize,
}

impl Player {
    /// None when nothing was drawn.
    pub fn of(pictures: &Pictures, labels: &'static Labels) -> Result<Option<Self>, Fault> {
        let poses = Pose::all(pictures)?;
        if poses.is_empty() {
            return Ok(None);
        }
        let grid = Grid::of(poses.len());
        let mut fitting = None;
        for factor in REDUCTIONS {
            let panels = panels(&poses, grid, factor, labels)?;
            let bytes: usize = panels.iter().map(|panel| panel.address.len()).sum();
            fitting = Some((panels, factor));
            if bytes <= BUDGET {
                break;
            }
        }
        Ok(fitting.map(|(panels, factor)| Self {
            columns: grid.columns,
            steps: grid.steps(),
            cycle: CYCLE_SECONDS,
            last: poses.len() - 1,
            panels,
            is_reduced: factor > 1,
        }))
    }
}

fn panels(poses: &[Pose], grid: Grid, factor: usize, labels: &'static Labels) -> Result<[Panel; 3], Fault> {
    let panel = |id, label, part: fn(&Pose) -> &Raster| {
        let sheet = grid.sheet(&poses.iter().map(part).collect::<Vec<_>>(), factor);
        Ok(Panel {
            id,
            label,
            address: address(&sheet)?,
            width: sheet.width / grid.columns,
            height: sheet.height / grid.rows,
        })
    };
    Ok([
        panel("yours", labels.yours, |pose| &pose.yours)?,
        panel("expected", labels.expected, |pose| &pose.expected)?,
        panel("difference", labels.difference, |pose| &pose.difference)?,
    ])
}

/// One frame in the strip and in the table.
pub(super) struct FrameView {
    pub number: usize,
    pub t: String,
    pub agrees: bool,
    /// Height of its bar, in percent: its band among all bands.
    pub height: usize,
    pub max_difference: String,
    pub mean_difference: String,
    pub mismatched_pixels: u32,
    pub coverage_mismatches: u32,
    /// The frame in one sentence.
    pub caption: String,
}

/// The frames of a report.
pub(super) fn frames(report: &Report, labels: &Labels) -> Vec<FrameView> {
    let frames = report.frames.iter().enumerate();
    frames.map(|(index, frame)| view(index, frame, report.frames.len(), labels)).collect()
}

fn view(index: usize, frame: &FrameResult, count: usize, labels: &Labels) -> FrameView {
    let agrees = frame.agrees();
    let band =
        band_of(frame.max_difference).map_or(0, |band| BANDS.iter().position(|other| *other == band).unwrap_or(0));
    let max_difference = number(frame.max_difference);
    let word = if agrees { labels.agrees } else { labels.differs };
    let mut caption = format!("t = {} · {}/{count} · {word}", number(frame.t), index + 1);
    if !agrees {
        caption += &format!(" · {} {max_difference}/255", labels.max_difference);
    }
    FrameView {
        number: index + 1,
        t: number(frame.t),
        agrees,
        height: if agrees { 0 } else { (band + 1) * 100 / BANDS.len() },
        max_difference,
        mean_difference: number(frame.mean_difference),
        mismatched_pixels: frame.mismatched_pixels,
        coverage_mismatches: frame.coverage_mismatches,
        caption,
    }
}

/// One step of the difference picture's legend.
pub(super) struct Swatch {
    pub colour: String,
    pub range: String,
}

/// The legend of the difference picture.
pub(super) fn legend() -> Vec<Swatch> {
    let swatch = |band: &crate::report::difference::Band| {
        let [r, g, b] = band.colour;
        Swatch { colour: format!("#{r:02x}{g:02x}{b:02x}"), range: band.range() }
    };
    BANDS.iter().map(swatch).collect()
}

/// One term of the equation on its own.
pub(super) struct TermView {
    pub label: String,
    pub t: String,
    pub yours: Option<String>,
    pub expected: String,
    pub width: u32,
    pub height: u32,
}

/// The terms that have pictures, under the names of their rubric lines.
pub(super) fn terms(pictures: &Pictures, report: &Report, language: Language) -> Result<Vec<TermView>, Fault> {
    let view = |term: &TermPictures| {
        let line = report.rubric.iter().find(|line| line.id == term.id);
        let yours = term.yours.as_ref().map(|picture| address(&Raster::opaque(picture)?));
        Ok(TermView {
            label: line.map_or(term.id.as_str(), |line| line.label.get(language)).to_owned(),
            t: number(term.t),
            yours: yours.transpose()?,
            expected: address(&Raster::opaque(&term.expected)?)?,
            width: term.expected.width,
            height: term.expected.height,
        })
    };
    pictures.terms.iter().map(view).collect()
}
