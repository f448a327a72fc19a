//! A report as a part of a page, with what the editor needs of it.

use super::assets;
use super::frame::Frame;
use crate::fault::Fault;
use crate::diagnostic::Severity;
use crate::report::html::{Gallery, Lines, Mark, Part};
use crate::report::{Equation, Report, Verdict};
use crate::language::Text;
use askama::Template;
use serde::Serialize;

#[derive(Template)]
#[template(path = "service/part.html")]
struct View {
    label: &'static str,
    mark: Mark,
    summary: String,
    marks: String,
    body: String,
}

/// A line of the file that something is said about.
#[derive(Debug, Serialize)]
struct LineMark {
    line: u32,
    column: Option<u32>,
    length: u32,
    kind: &'static str,
}

/// A report with its pictures at the addresses of a submission; none where it has no pictures to show.
pub(super) fn part(
    frame: &Frame,
    report: &Report,
    source: Lines<'_>,
    gallery: Option<&Gallery>,
    level: u8,
) -> Result<String, Fault> {
    let equation = Equation::illumination();
    let has_footer = level == 1;
    let part =
        Part { report, source, gallery, equation: Some(&equation), language: frame.language, level, has_footer };
    let view = View {
        label: frame.say("Result", "採点結果"),
        mark: Mark::of_report(report),
        summary: summary(frame, report),
        marks: serde_json::to_string(&marks(report)).unwrap_or_default(),
        body: part.render()?,
    };
    view.render().map_err(|error| Fault::new(Text::verbatim(error.to_string())))
}

/// The result in one sentence, as a screen reader says it.
fn summary(frame: &Frame, report: &Report) -> String {
    let score = format!("{} / {}", report.score.round(), report.max_score.round());
    let verdict = verdict(frame, report.verdict);
    let errors = report.diagnostics.iter().filter(|d| d.severity == Severity::Error).count();
    let first = report.diagnostics.iter().find(|d| d.severity == Severity::Error).and_then(|d| d.line);
    match (errors, first) {
        (0, _) => format!("{verdict}: {score}"),
        (1, Some(line)) => format!("{verdict}: {score}. {}", line_words(frame, line)),
        (_, Some(line)) => format!("{verdict}: {score}. {} (+{})", line_words(frame, line), errors - 1),
        _ => format!("{verdict}: {score}"),
    }
}

fn line_words(frame: &Frame, line: u32) -> String {
    match frame.language {
        crate::language::Language::En => format!("Error in line {line}"),
        crate::language::Language::Ja => format!("{line} 行目にエラー"),
    }
}

/// A verdict in words.
pub(super) fn verdict(frame: &Frame, verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Correct => frame.say("Correct", "正解"),
        Verdict::Wrong => frame.say("Not right yet", "修正が必要"),
        Verdict::Rejected => frame.say("Not accepted", "受理できません"),
        Verdict::Stopped => frame.say("Stopped", "実行を中断"),
    }
}

fn marks(report: &Report) -> Vec<LineMark> {
    let diagnostics = report.diagnostics.iter().filter_map(|diagnostic| {
        let kind = match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => return None,
        };
        Some(LineMark { line: diagnostic.line?, column: diagnostic.column, length: diagnostic.length.max(1), kind })
    });
    let rubric = report.rubric.iter().filter(|line| line.points < line.max_points);
    let rubric = rubric.filter_map(|line| Some(LineMark { line: line.line?, column: None, length: 0, kind: "rubric" }));
    diagnostics.chain(rubric).collect()
}

/// Where the pictures of a submission are.
pub(super) fn gallery(id: &str, report: &Report) -> Option<Gallery> {
    if report.frames.is_empty() {
        return None;
    }
    Some(Gallery {
        yours: format!("/r/{id}/yours.png"),
        expected: assets::address(&assets::expected_name(&report.assignment)).to_owned(),
        difference: format!("/r/{id}/difference.png"),
        is_reduced: false,
        terms: Vec::new(),
    })
}
