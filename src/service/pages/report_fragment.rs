//! A report as a part of a page, with what the editor needs of it.

use super::assets;
use super::frame::{PageFrame, picture};
use super::terms;
use crate::diagnostic::Severity;
use crate::fault::Fault;
use crate::language::Text;
use crate::report::html::{LineLinks, Mark, PictureAddresses, ReportFragment};
use crate::report::text::number;
use crate::report::{Report, Verdict};
use crate::service::State;
use crate::source::Source;
use askama::Template;
use reference::Assignment;
use serde::Serialize;

#[derive(Template)]
#[template(path = "service/pages/templates/report_fragment.html")]
struct FragmentPage {
    label: &'static str,
    mark: Mark,
    is_drawn: bool,
    summary: String,
    marks: String,
    body: String,
}

/// A line of a file that something is said about.
#[derive(Debug, Serialize)]
struct LineMark {
    /// Which of the homework's files, counted from 0.
    file: usize,
    line: u32,
    column: Option<u32>,
    length: u32,
    kind: &'static str,
}

/// A report with its pictures at the addresses of a submission; none where it has no pictures to show.
pub(super) fn render(
    assignment: &Assignment,
    frame: &PageFrame,
    report: &Report,
    source: LineLinks<'_>,
    gallery: Option<&PictureAddresses>,
    level: u8,
) -> Result<String, Fault> {
    let has_footer = level == 1;
    let part = ReportFragment { assignment, report, source, gallery, language: frame.language, level, has_footer };
    let view = FragmentPage {
        label: frame.say("Result", "採点結果"),
        mark: Mark::of_verdict(report.verdict, report.score),
        is_drawn: report.verdict.is_drawn(),
        summary: summary(frame, report),
        marks: serde_json::to_string(&marks(report)).unwrap_or_default(),
        body: part.render()?,
    };
    view.render().map_err(|error| Fault::new(Text::verbatim(error.to_string())))
}

/// The result in one sentence, as a screen reader says it.
fn summary(frame: &PageFrame, report: &Report) -> String {
    let verdict = verdict(frame, report.verdict);
    let said = format!("{verdict}: {} / {}", number(report.score), number(report.max_score));
    let mut errors = report.diagnostics.iter().filter(|d| d.severity == Severity::Error);
    match errors.next().and_then(|first| Some((report.file_to_name(first.file.as_deref()), first.line?))) {
        Some((file, line)) => {
            let more = match errors.count() {
                0 => String::new(),
                more => format!(" (+{more})"),
            };
            let file = file.map(|file| format!("{file}: ")).unwrap_or_default();
            format!("{said} · {file}{} {line}{more}", frame.say("error in line", "エラーの行:"))
        }
        None => said,
    }
}

/// Points in a table, a dash where there are none yet.
pub(super) fn points(points: Option<f64>) -> String {
    points.map_or_else(|| "–".to_owned(), number)
}

/// A verdict in words.
pub(super) fn verdict(frame: &PageFrame, verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Correct => frame.say("Correct", "正解"),
        Verdict::Wrong => frame.say("Not right yet", "修正が必要"),
        Verdict::Rejected => frame.say("Not accepted", "受理できません"),
        Verdict::Stopped => frame.say("Stopped", "実行を中断"),
    }
}

fn marks(report: &Report) -> Vec<LineMark> {
    let file = |name: &Option<String>| {
        let index = report.sources.iter().position(|source| Some(&source.name) == name.as_ref());
        index.unwrap_or_default()
    };
    let diagnostics = report.diagnostics.iter().filter_map(|diagnostic| {
        let kind = match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => return None,
        };
        let (line, file) = (diagnostic.line?, file(&diagnostic.file));
        Some(LineMark { file, line, column: diagnostic.column, length: diagnostic.length.max(1), kind })
    });
    let rubric = report.rubric.iter().filter(|line| line.points < line.max_points).filter_map(|line| {
        Some(LineMark { file: file(&line.file), line: line.line?, column: None, length: 0, kind: "rubric" })
    });
    diagnostics.chain(rubric).collect()
}

/// Where the pictures of a submission are; `sources` are its files.
pub(super) fn gallery(state: &State, id: &str, report: &Report, sources: &[Source]) -> Option<PictureAddresses> {
    if report.frames.is_empty() {
        return None;
    }
    Some(PictureAddresses {
        yours: picture(Some(&state.assignment), id, "yours"),
        expected: assets::expected(&state.assignment).into(),
        difference: picture(Some(&state.assignment), id, "difference"),
        is_reduced: false,
        still: None,
        terms: terms::addresses(state, id, report, sources),
    })
}
