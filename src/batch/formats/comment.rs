//! The feedback as the piece of HTML that Moodle's feedback comments hold: one line, no quotes but those of one class.

use super::plain::html;
use crate::batch::class::{Class, Entry, Outcome};
use crate::batch::standing::Standing;
use crate::diagnostic::Severity;
use crate::language::Language;
use crate::report::html::rich::pieces;
use crate::report::labels::Labels;
use crate::report::text::number;
use crate::report::{Report, RubricLine};

/// Begins what is ours in a comment; what a teacher wrote before or behind it stays.
const OPEN: &str = "<div class=ggrade>";
/// Moodle's editor writes it with quotes when a teacher saves the comment there.
const OPEN_QUOTED: &str = "<div class=\"ggrade\">";
const CLOSE: &str = "</div>";

/// The comment on one student.
pub(super) fn render(entry: &Entry, class: &Class) -> String {
    let language = class.language;
    let title = Standing::of(&entry.outcome).word(language);
    let body = match &entry.outcome {
        Outcome::Graded(report) => graded(report, title, language),
        Outcome::NotGraded(reason) => format!("<p><strong>{title}</strong></p><p>{}</p>", rich(reason.get(language))),
        Outcome::Fault(_) => format!("<p><strong>{title}</strong></p>"),
    };
    format!("{OPEN}{body}{CLOSE}")
}

/// `existing` with our part replaced by `ours`, or with `ours` behind it.
pub(super) fn merge(existing: &str, ours: &str) -> String {
    for open in [OPEN, OPEN_QUOTED] {
        let Some((before, rest)) = existing.split_once(open) else { continue };
        let Some((_, after)) = rest.split_once(CLOSE) else { continue };
        return format!("{before}{ours}{after}");
    }
    format!("{existing}{ours}")
}

fn graded(report: &Report, title: &str, language: Language) -> String {
    let labels = Labels::of(language);
    let score = format!("{} / {}", number(report.score), number(report.max_score));
    let mut out = format!("<p><strong>{title}</strong> — {} {score}</p>", labels.score);
    let errors: Vec<String> = report
        .diagnostics
        .iter()
        .filter(|diagnostic| diagnostic.severity == Severity::Error)
        .map(|error| {
            let place = error.line.map(|line| labels.place(line, error.column) + ": ").unwrap_or_default();
            let hint = error.hint.as_ref().map(|hint| " ".to_owned() + &rich(hint.get(language))).unwrap_or_default();
            format!("<li>{place}{}{hint}</li>", rich(error.message.get(language)))
        })
        .collect();
    if errors.is_empty() {
        let lines: String = report.rubric.iter().map(|line| rubric(line, language)).collect();
        out.push_str(&format!("<ul>{lines}</ul>"));
    } else {
        out.push_str(&format!("<ul>{}</ul>", errors.concat()));
    }
    out
}

fn rubric(line: &RubricLine, language: Language) -> String {
    let label = html(line.label.get(language));
    let points = format!("{} / {}", number(line.points), number(line.max_points));
    if line.points >= line.max_points {
        format!("<li>○ {label} {points}</li>")
    } else {
        let sign = if line.points > 0.0 { "△" } else { "×" };
        format!("<li>{sign} <strong>{label} {points}</strong><br>{}</li>", rich(line.message.get(language)))
    }
}

/// A message with its code marked up and its line ends kept.
fn rich(message: &str) -> String {
    let line = |line: &str| -> String {
        let marked = pieces(line).into_iter().map(|piece| {
            let text = html(&piece.text);
            if piece.code { format!("<code>{text}</code>") } else { text }
        });
        marked.collect()
    };
    message.lines().map(line).collect::<Vec<_>>().join("<br>")
}
