//! What became of a student, in one line.

use crate::class::{ClassEntry, Outcome};
use crate::diagnostic::Severity;
use crate::language::Language;
use crate::report::labels::Labels;
use crate::report::text::number;
use crate::report::{Report, Verdict};

/// The one thing that a student or a teacher should know, in a line of text.
pub(super) fn summary(entry: &ClassEntry, language: Language) -> String {
    match &entry.outcome {
        Outcome::Graded(report) => summary_of(report, language),
        Outcome::NotGraded(reason) => reason.get(language).to_owned(),
        Outcome::Fault(fault) => fault.message.get(language).to_owned(),
    }
}

fn summary_of(report: &Report, language: Language) -> String {
    let labels = Labels::of(language);
    let headline = labels.headline(report.verdict);
    let line = match report.verdict {
        Verdict::Correct => report.advice.first().map(|advice| format!("{headline} {}", advice.message.get(language))),
        Verdict::Wrong => report.rubric.iter().find(|line| line.points < line.max_points).map(|line| {
            let points = format!("{} / {}", number(line.points), number(line.max_points));
            let (label, message) = (line.label.get(language), line.message.get(language));
            let dash = if language == Language::Ja { " — " } else { ": " };
            format!("{label} {points}{dash}{message}")
        }),
        Verdict::Rejected | Verdict::Stopped => {
            let error = report.diagnostics.iter().find(|diagnostic| diagnostic.severity == Severity::Error);
            error.map(|error| {
                let file = report.file_to_name(error.file.as_deref());
                let place = error.line.map(|line| labels.place(file, line, error.column) + ": ").unwrap_or_default();
                place + error.message.get(language)
            })
        }
    };
    line.map_or_else(|| headline.to_owned(), |line| line.replace('\n', " "))
}
