//! The page of each student: the full report with its pictures.

use crate::fault::Fault;
use crate::language::Language;
use crate::pictures;
use crate::report::html::Page;
use crate::report::{Picture, Pictures, Report};
use crate::source::Source;
use reference::Assignment;
use std::sync::Arc;

/// Makes the pages of a class.
pub struct Pages {
    assignment: Arc<Assignment>,
    language: Language,
}

impl Pages {
    /// The pages for an assignment.
    pub fn new(assignment: Arc<Assignment>, language: Language) -> Self {
        Self { assignment, language }
    }

    /// The page of one report; `sources` are the files that can be read as text, and `frames` what is drawn, which is
    /// the same afterwards.
    pub fn page(&self, report: &Report, sources: &[Source], frames: &mut Vec<Picture>) -> Result<String, Fault> {
        let is_drawn = !frames.is_empty();
        let mut pictures = Pictures::default();
        if is_drawn {
            pictures = Pictures {
                yours: std::mem::take(frames),
                expected: pictures::expected_pictures(&self.assignment),
                terms: pictures::term_pictures(&self.assignment, report.explanation.as_deref(), sources.first()),
                cycle: self.assignment.scene.cycle,
            };
        }
        let page = Page {
            assignment: &self.assignment,
            report,
            sources,
            pictures: is_drawn.then_some(&pictures),
            language: self.language,
        }
        .render();
        if is_drawn {
            *frames = pictures.yours;
        }
        page
    }
}
