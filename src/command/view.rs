//! How a report is shown, whichever command shows it.

use super::width;
use crate::cli::Reading;
use crate::excerpt;
use crate::fault::Fault;
use crate::language::Language;
use crate::report::html::Page;
use crate::report::{Pictures, Report, json, text};
use crate::source::{self, Source};
use reference::typeset::Typeset;
use std::io::IsTerminal;

/// Everything that a report is shown with.
pub(super) struct View<'a> {
    /// The report.
    pub report: &'a Report,
    /// The file as text, where it can be read as text.
    pub source: Option<&'a Source>,
    /// The equation that the rubric judges.
    pub equation: Option<&'a Typeset>,
    /// What was drawn, where it is wanted.
    pub pictures: Option<&'a Pictures>,
    /// The language of every word.
    pub language: Language,
}

impl View<'_> {
    /// The report in a format.
    pub fn document(&self, format: Reading, colour: bool) -> Result<String, Fault> {
        match format {
            Reading::Json => Ok(json::render(self.report, self.language)),
            Reading::Html => Page {
                report: self.report,
                source: self.source.map(|source| source.text.as_str()),
                pictures: self.pictures,
                equation: self.equation,
                language: self.language,
            }
            .render(),
            Reading::Text => {
                let excerpts = excerpt::excerpt(self.source, &self.report.diagnostics, self.language, colour);
                Ok(text::render(
                    self.report,
                    &text::Options {
                        language: self.language,
                        width: width(std::io::stdout().is_terminal()),
                        colour,
                        excerpts: Some(&excerpts),
                    },
                ))
            }
        }
    }
}

/// The file as text, for excerpts; none where it cannot be read as text.
pub(super) fn readable(name: &str, bytes: &[u8]) -> Option<Source> {
    match source::read(name, bytes) {
        Ok(source) => Some(source),
        Err(refusal) => refusal.source,
    }
}

/// Whether standard output takes colour.
pub(super) fn has_colour() -> bool {
    anstream::AutoStream::choice(&std::io::stdout()) != anstream::ColorChoice::Never
}
