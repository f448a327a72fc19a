//! How a report is shown, whichever command shows it.

use super::{file_fault, writing};
use crate::cli::Format;
use crate::excerpt;
use crate::fault::Fault;
use crate::language::Language;
use crate::report::html::Page;
use crate::report::{Equation, Pictures, Report, json, text};
use crate::source::{self, Source};
use std::io::{IsTerminal, Write};
use std::path::Path;

/// Everything that a report is shown with.
pub(super) struct View<'a> {
    /// The report.
    pub report: &'a Report,
    /// The file as text, where it can be read as text.
    pub source: Option<&'a Source>,
    /// What was drawn, where it is wanted.
    pub pictures: Option<&'a Pictures>,
    /// The language of every word.
    pub language: Language,
}

impl View<'_> {
    /// Writes the report to a file, or else to standard output.
    pub fn write(&self, format: Format, output: Option<&Path>) -> Result<(), Fault> {
        match output {
            Some(path) => {
                let document = self.document(format, false)?;
                std::fs::write(path, document).map_err(|error| file_fault(&writing(), path, &error))
            }
            None => {
                let document = self.document(format, has_colour())?;
                // A reader that closes the pipe early, such as `head`, has what it wanted.
                let _ = std::io::stdout().lock().write_all(document.as_bytes());
                Ok(())
            }
        }
    }

    /// The report in a format.
    pub fn document(&self, format: Format, colour: bool) -> Result<String, Fault> {
        match format {
            Format::Json => Ok(json::render(self.report, self.language)),
            Format::Html => Page {
                report: self.report,
                source: self.source.map(|source| source.text.as_str()),
                pictures: self.pictures,
                equation: Some(&Equation::illumination()),
                language: self.language,
            }
            .render(),
            Format::Text => {
                let excerpts = excerpt::excerpt(self.source, &self.report.diagnostics, self.language, colour);
                Ok(text::render(
                    self.report,
                    &text::Options { language: self.language, width: width(), colour, excerpts: Some(&excerpts) },
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

/// Columns of the terminal; a file or pipe is as wide as a usual page.
pub(super) fn width() -> usize {
    const PAGE: usize = 100;
    if !std::io::stdout().is_terminal() {
        return PAGE;
    }
    terminal_size::terminal_size().map_or(PAGE, |(width, _)| usize::from(width.0))
}
