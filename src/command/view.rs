//! How a report is shown, whichever command shows it.

use super::width;
use crate::cli::ViewFormat;
use crate::excerpt;
use crate::fault::Fault;
use crate::language::Language;
use crate::report::html::ReportPage;
use crate::report::{Pictures, Report, json, text};
use crate::source::Source;
use reference::Assignment;
use std::io::IsTerminal;

/// Everything that a report is shown with.
pub(super) struct ReportView<'a> {
    /// The homework.
    pub assignment: &'a Assignment,
    /// The report.
    pub report: &'a Report,
    /// The files that can be read as text.
    pub sources: &'a [Source],
    /// What was drawn, where it is wanted.
    pub pictures: Option<&'a Pictures>,
    /// The language of every word.
    pub language: Language,
}

impl ReportView<'_> {
    /// The report in a format.
    pub fn document(&self, format: ViewFormat, colour: bool) -> Result<String, Fault> {
        match format {
            ViewFormat::Json => Ok(json::render(self.report, self.language)),
            ViewFormat::Html => ReportPage {
                assignment: self.assignment,
                report: self.report,
                sources: self.sources,
                pictures: self.pictures,
                language: self.language,
            }
            .render(),
            ViewFormat::Text => {
                let excerpts = excerpt::excerpt(self.sources, &self.report.diagnostics, self.language, colour);
                Ok(text::render(
                    self.report,
                    &text::TextOptions {
                        assignment: self.assignment,
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

/// Whether standard output takes colour.
pub(super) fn has_colour() -> bool {
    anstream::AutoStream::choice(&std::io::stdout()) != anstream::ColorChoice::Never
}
