//! What the formats of autograders say in common: one explanation for each outcome, places, points.

use super::untrusted;
use crate::class::{ClassEntry, Outcome};
use crate::diagnostic::Diagnostic;
use crate::language::{Language, Text};
use crate::report::labels::Labels;
use crate::report::text::number;
use crate::report::{Report, RubricLine};

/// What a student is told about the outcome as a whole.
pub fn explanation(entry: &ClassEntry, language: Language) -> String {
    match &entry.outcome {
        Outcome::Graded(report) => {
            let advice = report.advice.iter().map(|advice| untrusted::visible(advice.message.get(language)));
            let headline = Labels::of(language).headline(report.verdict).to_owned();
            let comments = report.comment_lines(language).into_iter().map(|line| untrusted::visible(&line));
            let lines = std::iter::once(headline).chain(advice).chain(comments);
            lines.chain(report.lateness_lines(language)).collect::<Vec<_>>().join("\n")
        }
        Outcome::NotGraded(why) => untrusted::visible(why.get(language)),
        Outcome::Fault(_) => autograder_failed().get(language).to_owned(),
    }
}

/// What a student is told about a failure of ours.
pub fn autograder_failed() -> Text {
    Text::new(
        "The autograder failed. It is no fault of your file and costs no points; please tell the course's staff.",
        "採点システムに障害が起きました。提出されたファイルが原因ではなく、減点にもなりません。授業の担当者に知らせてください。",
    )
}

/// What the staff is told about a failure of ours; `None` for every other outcome.
pub fn fault(entry: &ClassEntry, language: Language) -> Option<String> {
    let Outcome::Fault(fault) = &entry.outcome else { return None };
    let remedy = fault.remedy.as_ref().map(|remedy| format!("\n{}", remedy.get(language))).unwrap_or_default();
    Some(untrusted::visible(&format!("{}{remedy}", fault.message.get(language))))
}

/// What to do first, where there is something to do.
pub fn next_step(entry: &ClassEntry, language: Language) -> Option<String> {
    Labels::of(language).next_step(entry.report()?, language)
}

/// `Specular 20 / 40`.
pub fn rubric_title(line: &RubricLine, language: Language) -> String {
    format!("{} {}", untrusted::one_line(line.label.get(language)), points(line.points, line.max_points))
}

/// `20 / 40`.
pub fn points(points: f64, max_points: f64) -> String {
    format!("{} / {}", number(points), number(max_points))
}

/// `60 / 100`, or with what lateness takes off `40 / 100 (60 − 20)`.
pub fn result(report: &Report) -> String {
    let total = points(report.total(), report.max_score);
    match report.lateness {
        Some(lateness) => format!("{total} ({} − {})", number(report.score), number(lateness.penalty)),
        None => total,
    }
}

/// `error · line 11, column 12`; without a line the stage that speaks.
pub fn place(report: &Report, diagnostic: &Diagnostic, language: Language) -> String {
    let labels = Labels::of(language);
    let place = match diagnostic.line {
        Some(line) => {
            let file = report.file_to_name(diagnostic.file.as_deref());
            untrusted::one_line(&labels.place(file, line, diagnostic.column))
        }
        None => labels.stage(diagnostic.stage).to_owned(),
    };
    format!("{} · {place}", labels.severity(diagnostic.severity))
}

/// Message and hint, a line each.
pub fn message(diagnostic: &Diagnostic, language: Language) -> String {
    let hint = diagnostic.hint.as_ref().map(|hint| format!("\n→ {}", hint.get(language))).unwrap_or_default();
    untrusted::visible(&format!("{}{hint}", diagnostic.message.get(language)))
}

/// Whether every point of the line is earned.
pub fn is_full(line: &RubricLine) -> bool {
    line.points >= line.max_points
}
