//! The report as HTML: a page that needs nothing else (no network, no script, no other file), or a part of another page.

mod base;
mod body;
mod cache;
mod film;
mod listing;
mod map;
mod mark;
mod motion;
mod player;
pub(crate) mod rich;
mod sheet;
mod shots;
mod values;

pub(crate) use self::cache::PictureCache;
pub use self::film::{Film, FilmUse, PictureAddresses, TermFilm, expected_sheet};
pub use self::mark::Mark;
pub use self::motion::Motion;

use self::body::ReportBody;
use super::{Pictures, Report};
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::source::Source;
use askama::Template;
use reference::Assignment;

/// The script of the moving pictures, for a `Content-Security-Policy` that names it by its hash.
pub const SCRIPT: &str = include_str!("html/templates/report.js");
/// Colours, type and the elements that every page shares.
pub const BASE_STYLE: &str = include_str!("html/templates/base.css");
/// The look of a report.
pub const REPORT_STYLE: &str = include_str!("html/templates/report.css");
/// The signs that a page with a report refers to by id; they stand once in a page, before the report.
pub const SYMBOLS: &str = include_str!("html/templates/symbols.html");

/// What goes into a page; what is not there is left out of it.
#[derive(Clone, Copy, Debug)]
pub struct ReportPage<'a> {
    /// The homework.
    pub assignment: &'a Assignment,
    /// The report.
    pub report: &'a Report,
    /// The student's files as text, those that can be read so.
    pub sources: &'a [Source],
    /// What was drawn and what is expected.
    pub pictures: Option<&'a Pictures>,
    /// The language of every word.
    pub language: Language,
}

impl ReportPage<'_> {
    /// The page; a fault when the pictures do not go together.
    pub fn render(&self) -> Result<String, Fault> {
        let film = self
            .pictures
            .map(|pictures| Film::of(&pictures.yours, &pictures.expected, FilmUse::Embedded))
            .transpose()?
            .flatten();
        let gallery = match (&film, self.pictures) {
            (Some(film), Some(pictures)) => Some(film.embedded(pictures, values::still(self.report, pictures)?)?),
            _ => None,
        };
        let body = ReportBody::of(&ReportFragment {
            assignment: self.assignment,
            report: self.report,
            source: LineLinks::of(self.sources),
            gallery: gallery.as_ref(),
            language: self.language,
            level: 1,
            has_footer: true,
        });
        let motion = film.filter(|_| body.moves()).map(|film| film.motion.style(self.assignment.scene.cycle));
        ReportDocument { script: SCRIPT, motion, body }.render().map_err(unwritten)
    }
}

/// Where the lines of the student's files are shown, which messages link to as `#L12`, or `#F2L12` in the second file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineLinks<'a> {
    /// In the report: the files as text.
    Here(&'a [Source]),
    /// Elsewhere in the same page.
    Elsewhere,
    /// Not at all: messages do not link.
    Nowhere,
}

impl<'a> LineLinks<'a> {
    /// In the report, where there are files that can be read as text.
    pub fn of(sources: &'a [Source]) -> Self {
        if sources.is_empty() { Self::Nowhere } else { Self::Here(sources) }
    }
}

/// A report as a part of a larger page, which brings [`SYMBOLS`], the styles and the script.
#[derive(Clone, Copy, Debug)]
pub struct ReportFragment<'a> {
    /// The homework.
    pub assignment: &'a Assignment,
    /// The report.
    pub report: &'a Report,
    /// The student's files.
    pub source: LineLinks<'a>,
    /// Where the pictures are.
    pub gallery: Option<&'a PictureAddresses>,
    /// The language of every word.
    pub language: Language,
    /// Level of the report's own heading, 1 to 4.
    pub level: u8,
    /// Whether it says what graded it.
    pub has_footer: bool,
}

impl ReportFragment<'_> {
    /// The part, without an element around it.
    pub fn render(&self) -> Result<String, Fault> {
        ReportBody::of(self).render().map_err(unwritten)
    }
}

fn unwritten(error: askama::Error) -> Fault {
    Fault::new(Text::new(
        format!("The page could not be written: {error}."),
        format!("ページを生成できませんでした（{error}）。"),
    ))
}

/// The page around a report.
#[derive(Template)]
#[template(path = "report/html/templates/report.html")]
struct ReportDocument<'a> {
    body: ReportBody<'a>,
    script: &'static str,
    motion: Option<String>,
}

#[cfg(test)]
mod tests;
