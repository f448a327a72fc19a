//! What a preview shows its teacher: beside the student's page what the folder's own files score, and in its place what is
//! wrong with a folder that cannot be used.

use super::frame::PageFrame;
use super::report_fragment;
use crate::language::Text;
use crate::report::html::Mark;
use crate::report::html::rich::{MessagePiece, pieces};
use crate::report::{Report, Verdict};
use crate::service::State;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::preview::OwnFiles;
use crate::service::submit::Receipt;
use askama::Template;
use axum::http::{StatusCode, header};
use axum::response::{Html, IntoResponse, Response};

/// What the teacher sees above the page that students will see.
pub(super) struct PreviewPanel {
    pub version: u64,
    pub is_graded: bool,
    pub own: Vec<OwnFile>,
    /// The pictures of a right answer.
    pub frames: Vec<String>,
}

/// One of the folder's own hand-ins.
pub(super) struct OwnFile {
    pub label: &'static str,
    pub mark: &'static str,
    pub score: String,
    pub verdict: String,
    pub href: String,
    /// What is wrong about that.
    pub complaint: Option<String>,
}

/// The panel, where the service is a preview.
pub(super) fn panel(state: &State, frame: &PageFrame) -> Option<PreviewPanel> {
    let shown = state.preview.get()?;
    let own = shown.own.get();
    Some(PreviewPanel {
        version: shown.version,
        is_graded: own.is_some(),
        own: own.map(|own| own_files(frame, own)).unwrap_or_default(),
        frames: own.map(|own| frames(frame, &own.solution)).unwrap_or_default(),
    })
}

fn own_files(frame: &PageFrame, own: &OwnFiles) -> Vec<OwnFile> {
    let file = |label, receipt: &Receipt, is_as_wanted: fn(&Report) -> bool, complaint: &str| {
        let href = at(&format!("/r/{}", receipt.submission.id));
        let Some(report) = receipt.report() else {
            // Our own failure: the service tries again.
            let fault = receipt.fault().map(|fault| fault.message.get(frame.language).to_owned());
            return OwnFile {
                label, mark: "none", score: "–".into(), verdict: String::new(), href, complaint: fault
            };
        };
        let points = |points| report_fragment::points(Some(points));
        OwnFile {
            label,
            mark: Mark::of_verdict(report.verdict, report.score).id(),
            score: format!("{} / {}", points(report.score), points(report.max_score)),
            verdict: report_fragment::verdict(frame, report.verdict).to_owned(),
            href,
            complaint: (!is_as_wanted(report)).then(|| complaint.to_owned()),
        }
    };
    let solution = file(
        frame.say("The solution", "解答"),
        &own.solution,
        |report| report.verdict == Verdict::Correct,
        frame.say(
            "It has to have full marks: its report says what is missing.",
            "満点でなければなりません。レポートを確認してください。",
        ),
    );
    let starter = file(
        frame.say("What is handed out", "配布ファイル"),
        &own.starter,
        |report| report.verdict == Verdict::Wrong,
        frame.say("It has to run, and not to be right.", "実行でき、かつ正解ではないものにしてください。"),
    );
    vec![solution, starter]
}

/// The addresses of the pictures of a right answer, which stand beside those of the solution.
fn frames(frame: &PageFrame, solution: &Receipt) -> Vec<String> {
    let count = solution.report().map_or(0, |report| report.frames.len());
    let address =
        |index| format!("{}&view=expected", frame.picture(&solution.submission.id, &format!("frames/{index}")));
    (0..count).map(address).collect()
}

#[derive(Template)]
#[template(path = "service/pages/templates/broken_folder.html")]
struct BrokenFolder {
    frame: PageFrame,
    why: Vec<MessagePiece>,
    version: u64,
}

/// The page in place of all others while the folder cannot be used. A page that is open waits, as for a busy service.
pub fn broken_folder(frame: PageFrame, why: &Text, version: u64) -> Result<Response, Problem> {
    let why = pieces(why.get(frame.language));
    let page = BrokenFolder { frame, why, version }.render().map_err(|error| Problem::internal(&error))?;
    let headers = [(header::CACHE_CONTROL, "no-store"), (header::RETRY_AFTER, "1")];
    Ok((StatusCode::SERVICE_UNAVAILABLE, headers, Html(page)).into_response())
}
