//! The feedback as the piece of HTML that Moodle's feedback comments hold: one line, no quotes but those of one class.
//!
//! Moodle's worksheet gives comments back without their tags. So what is ours begins and ends with words that are text:
//! by them [`existing`] finds it in a worksheet, and a new grading takes its place.

mod existing;
mod exported;
mod former;

use super::plain::html;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry, Outcome};
use crate::diagnostic::Severity;
use crate::language::Language;
use crate::report::html::rich::pieces;
use crate::report::labels::Labels;
use crate::report::text::number;
use crate::report::{Report, RubricLine};
use former::Former;

/// Begins what is ours in a comment; what a teacher wrote before or behind it stays.
const OPEN: &str = "<div class=ggrade>";
/// Moodle's editor writes it with quotes when a teacher saves the comment there.
const OPEN_QUOTED: &str = "<div class=\"ggrade\">";
const CLOSE: &str = "</div>";

const LANGUAGES: [Language; 2] = [Language::En, Language::Ja];

/// The words that begin what is ours, and those that end it. Both are in Shift_JIS, as Excel in Japan saves a worksheet.
const fn marks(language: Language) -> [&'static str; 2] {
    match language {
        Language::En => ["▼ Automatic feedback by ggrade", "▲ End of automatic feedback"],
        Language::Ja => ["▼ ggrade による自動採点", "▲ 自動採点ここまで"],
    }
}

/// A comment for a cell of the worksheet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct WorksheetComment {
    /// The cell's content: ours, and what a teacher wrote around it.
    pub html: String,
    /// Whether the end of an older version's comment had to be guessed: words that a teacher wrote right behind it, in
    /// the same line, are gone with it.
    pub is_end_guessed: bool,
}

/// The comment on one student in place of the one that is in the cell, and behind a teacher's words where there is none.
pub(super) fn merge(cell: &str, entry: &ClassEntry, class: &Class) -> WorksheetComment {
    existing::replaced(cell, &render(entry, class.language), &Former::of(entry, class))
}

/// The comment on one student.
fn render(entry: &ClassEntry, language: Language) -> String {
    let [begin, end] = marks(language);
    format!("{OPEN}<p>{begin}</p>{}<p>{end}</p>{CLOSE}", body(entry, language))
}

/// What a comment says.
fn body(entry: &ClassEntry, language: Language) -> String {
    let title = Standing::of(&entry.outcome).word(language);
    match &entry.outcome {
        Outcome::Graded(report) => graded(report, title, language),
        Outcome::NotGraded(reason) => format!("<p><strong>{title}</strong></p><p>{}</p>", rich(reason.get(language))),
        Outcome::Fault(_) => format!("<p><strong>{title}</strong></p>"),
    }
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
            let file = report.file_to_name(error.file.as_deref());
            let place = error.line.map(|line| html(&labels.place(file, line, error.column)) + ": ").unwrap_or_default();
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
    for lines in [report.comment_lines(language), report.lateness_lines(language)] {
        let lines: Vec<String> = lines.iter().map(|line| html(line)).collect();
        if !lines.is_empty() {
            out.push_str(&format!("<p>{}</p>", lines.join("<br>")));
        }
    }
    out
}

fn rubric(line: &RubricLine, language: Language) -> String {
    let label = html(line.label.get(language));
    let points = format!("{} / {}", number(line.points), number(line.max_points));
    if line.points >= line.max_points && line.graded.is_none() {
        format!("<li>○ {label} {points}</li>")
    } else {
        let sign = match line.points {
            points if points >= line.max_points => "○",
            points if points > 0.0 => "△",
            _ => "×",
        };
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
