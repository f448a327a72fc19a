//! The receipt of what was handed in: what came, when, and as which attempt.

use super::datetime::TimeElement;
use super::frame::PageFrame;
use super::report_fragment;
use crate::report::Report;
use crate::service::State;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::store::{Submission, SubmissionState as Progress};
use askama::Template;

#[derive(Template)]
#[template(path = "service/pages/templates/receipt.html")]
struct ReceiptPage<'a> {
    frame: &'a PageFrame,
    at: TimeElement,
    name: &'a str,
    attempt: String,
    score: String,
    /// Whether it counts for nobody, because there is a roster and it has no student number.
    is_nobodys: bool,
    /// The SHA-256 of each file, and its name.
    files: Vec<(String, String)>,
    address: String,
}

/// The receipt of a submission, without a page around it.
pub(super) async fn receipt(
    state: &State,
    frame: &PageFrame,
    submission: &Submission,
    report: Option<&Report>,
) -> Result<String, Problem> {
    let settings = state.store.assignment(&submission.assignment).await?;
    let number = state.store.attempt_number(submission).await?;
    let attempt = match (settings.attempts, frame.tag()) {
        (Some(most), "ja") => format!("{most} 回のうち {number} 回目"),
        (Some(most), _) => format!("{number} of {most}"),
        (None, "ja") => format!("{number} 回目"),
        (None, _) => number.to_string(),
    };
    let score = match (report, submission.state) {
        (Some(report), _) => {
            let (score, most) = (report_fragment::points(Some(report.score)), report_fragment::points(Some(report.max_score)));
            format!("{score} / {most} · {}", report_fragment::verdict(frame, report.verdict))
        }
        (None, Progress::Failed) => frame
            .say(
                "Grading failed on our side. What you handed in is kept and will be graded again soon; this costs no points.",
                "採点サーバ側の障害で採点できませんでした。提出は保存されており、まもなく再採点します。減点にはなりません。",
            )
            .to_owned(),
        (None, _) => frame.say("Being graded", "採点中").to_owned(),
    };
    let hand_in = state.store.hand_in(&submission.id).await?.unwrap_or_default();
    let files = hand_in.files.into_iter().map(|file| (file.sha256(), file.name)).collect();
    let view = ReceiptPage {
        frame,
        at: frame.exact_datetime(submission.received_at),
        name: &submission.name,
        attempt,
        score,
        is_nobodys: submission.student_id.is_none() && state.store.has_roster().await?,
        files,
        address: at(&format!("/r/{}", submission.id)),
    };
    view.render().map_err(|error| Problem::internal(&error))
}
