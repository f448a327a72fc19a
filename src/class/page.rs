//! The page of each student: the full report with its pictures.

use crate::fault::Fault;
use crate::language::Language;
use crate::pictures;
use crate::report::html::ReportPage;
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

    /// The page of one report; `sources` are the files that can be read as text, and `frames` what is drawn.
    pub fn page(&self, report: &Report, sources: &[Source], frames: &Arc<[Picture]>) -> Result<String, Fault> {
        let pictures = (!frames.is_empty()).then(|| Pictures {
            yours: Arc::clone(frames),
            expected: pictures::expected_pictures(&self.assignment),
            terms: pictures::term_pictures(&self.assignment, report.explanation.as_deref(), sources.first()),
            cycle: self.assignment.scene.cycle,
        });
        let (assignment, language) = (&*self.assignment, self.language);
        ReportPage { assignment, report, sources, pictures: pictures.as_ref(), language }.render()
    }
}
