//! The moving pictures, their strip and their numbers.

use super::film::{PictureAddresses, TermFilm};
use crate::language::Language;
use crate::report::difference::{BANDS, agreeing, band_of};
use crate::report::labels::Labels;
use crate::report::text::number;
use crate::report::{FrameResult, Report};

/// What the page needs for its moving pictures.
pub(super) struct Player<'a> {
    pub last: usize,
    /// The pose that it starts at, where one differs.
    pub start: Option<usize>,
    /// What there is to say of pixels that one picture paints and the other does not.
    pub shape: Option<String>,
    pub panels: [Panel<'a>; 3],
    pub is_reduced: bool,
}

/// One of the moving pictures.
pub(super) struct Panel<'a> {
    pub id: &'static str,
    pub label: &'static str,
    pub address: &'a str,
}

impl<'a> Player<'a> {
    /// `None` when nothing was drawn.
    pub fn of(gallery: &'a PictureAddresses, frames: &[FrameResult], labels: &'static Labels) -> Option<Self> {
        let panel = |id, label, address| Panel { id, label, address };
        Some(Self {
            last: frames.len().checked_sub(1)?,
            start: FrameResult::differs_most(frames),
            shape: FrameResult::shape_mismatches(frames)
                .map(|(differing, most)| labels.shape_differs(differing, frames.len(), most)),
            panels: [
                panel("yours", labels.yours, &gallery.yours),
                panel("expected", labels.expected, &gallery.expected),
                panel("difference", labels.difference, &gallery.difference),
            ],
            is_reduced: gallery.is_reduced,
        })
    }
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
    let band = band_of(frame.largest_difference()).unwrap_or(0);
    let max_difference = number(frame.max_difference);
    let word = if agrees { labels.agrees } else { labels.differs };
    let mut caption = format!("t = {} · {}/{count} · {word}", number(frame.t), index + 1);
    if !agrees {
        caption += &format!(" · {} {max_difference}/255", labels.max_difference);
    }
    if frame.coverage_mismatches > 0 {
        caption += &format!(" · {} {}", labels.coverage_mismatches, frame.coverage_mismatches);
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

/// The legend of the difference picture: what is drawn as agreeing, and the steps from there.
pub(super) fn legend() -> (String, Vec<Swatch>) {
    let swatch = |band: &crate::report::difference::Band| {
        let [r, g, b] = band.colour;
        Swatch { colour: format!("#{r:02x}{g:02x}{b:02x}"), range: band.range() }
    };
    (agreeing(), BANDS.iter().map(swatch).collect())
}

/// One term of the equation on its own.
pub(super) struct TermView<'a> {
    pub label: &'a str,
    pub t: String,
    pub yours: Option<&'a str>,
    pub expected: &'a str,
}

/// The terms that have pictures, under the names of their rubric lines.
pub(super) fn terms<'a>(gallery: &'a PictureAddresses, report: &'a Report, language: Language) -> Vec<TermView<'a>> {
    let view = |term: &'a TermFilm| {
        let line = report.rubric.iter().find(|line| line.id == term.id);
        TermView {
            label: line.map_or(term.id.as_str(), |line| line.label.get(language)),
            t: number(term.t),
            yours: term.yours.as_deref(),
            expected: &term.expected,
        }
    };
    gallery.terms.iter().map(view).collect()
}
