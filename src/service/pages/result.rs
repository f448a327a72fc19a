//! The page of a report, and its pictures.

use super::frame::PageFrame;
use super::judgement::Judgement;
use super::{internal, receipt, report_fragment, shown};
use crate::hand_in::HandIn;
use crate::report::Report;
use crate::report::html::LineLinks;
use crate::report::text::number;
use crate::service::courses::at;
use crate::service::download;
use crate::service::errors::Problem;
use crate::service::gallery::{self, PictureSet};
use crate::service::identity::{Teacher, Visitor};
use crate::service::store::{StoredSubmission, Submission, SubmissionState as Progress, Via};
use crate::service::{Service, State};
use askama::Template;
use axum::extract::{Path, Query, State as Shared};
use axum::http::{StatusCode, header};
use axum::response::{Html, IntoResponse, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/report.html")]
struct ResultPage {
    frame: PageFrame,
    title: String,
    back: String,
    back_name: &'static str,
    about: String,
    again: Option<String>,
    address: String,
    source: String,
    source_name: &'static str,
    receipt: Option<String>,
    part: String,
    /// Id of the submission, and what people judge of it.
    submission: String,
    judgement: Judgement,
}

#[derive(Template)]
#[template(path = "service/pages/templates/waiting.html")]
struct Waiting {
    frame: PageFrame,
    heading: &'static str,
    detail: String,
    address: String,
    refreshes: bool,
}

/// `GET /r/{id}`.
pub(super) async fn page(
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    teacher: Option<Teacher>,
    visitor: Visitor,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let (state, stored) = service.stored(&id).await?;
    let frame = frame.of(&state);
    let judgement = Judgement::of(&state, &frame, &stored, teacher.as_ref(), &visitor).await?;
    let StoredSubmission { submission, report, cross_check } = stored;
    gallery::drawn(&state).await?;
    let Some(mut report) = report else { return waiting(&state, frame, &submission).await };
    if teacher.is_some_and(|teacher| teacher.may_see(&submission.assignment)) {
        report.cross_check = cross_check;
    }
    let sources = state.store.hand_in(&id).await?.unwrap_or_default().readable();
    let gallery = report_fragment::gallery(&state, &id, &report, &sources);
    let part =
        report_fragment::render(&state.assignment, &frame, &report, LineLinks::of(&sources), gallery.as_ref(), 1);
    let part = part.map_err(internal)?;
    let receipt = match submission.via {
        Via::Page | Via::Api => Some(receipt::receipt(&state, &frame, &submission, Some(&report)).await?),
        Via::Editor | Via::Batch => None,
    };
    shown(
        ResultPage {
            title: format!("{} / {} · {}", number(report.score), number(report.max_score), submission.name),
            back: state.page(),
            back_name: frame.say("To the homework", "課題のページへ"),
            about: about(&frame, &submission),
            again: (sources.len() == state.assignment.files.len()).then(|| format!("{}?from={id}", state.page())),
            address: at(&format!("/r/{id}")),
            source: at(&format!("/r/{id}/source")),
            source_name: match report.sources.len() {
                0 | 1 => frame.say("The file", "ファイル"),
                _ => frame.say("The files (ZIP)", "ファイル (ZIP)"),
            },
            receipt,
            part,
            submission: id,
            judgement,
            frame,
        }
        .render(),
    )
}

fn about(frame: &PageFrame, submission: &Submission) -> String {
    let at = frame.datetime(submission.received_at).text;
    let what = match submission.via {
        Via::Editor => frame.say("A draft, not handed in", "下書き（未提出）"),
        Via::Page | Via::Api | Via::Batch => frame.say("Handed in", "提出"),
    };
    format!("{what} · {at}")
}

async fn waiting(state: &State, frame: PageFrame, submission: &Submission) -> Result<Response, Problem> {
    let failed = submission.state == Progress::Failed;
    let position = state.store.position(&submission.id, state.clock.now()).await?.unwrap_or(1);
    let detail = match (failed, frame.tag()) {
        (true, "ja") => {
            "採点サーバ側の障害で採点できませんでした。提出は保存されており、まもなく再採点します。減点にはなりません。"
                .into()
        }
        (true, _) => {
            "Grading failed on our side. What you handed in is kept and will be graded again soon; this costs no points.".into()
        }
        (false, "ja") => format!("提出は保存されました。順番: {position} 番目。結果が出るとこのページに表示されます。"),
        (false, _) => {
            format!("What you handed in is kept. Place in the queue: {position}. The report will appear on this page.")
        }
    };
    let heading = if failed {
        frame.say("Our fault", "サーバ側の障害です")
    } else {
        frame.say("Being graded", "採点中です")
    };
    let address = at(&format!("/r/{}", submission.id));
    let mut response = shown(Waiting { frame, heading, detail, address, refreshes: true }.render())?;
    *response.status_mut() = StatusCode::ACCEPTED;
    Ok(response)
}

/// `GET /r/{id}/part`: the report for the page with the editor.
pub(super) async fn part_of(
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let (state, stored) = service.stored(&id).await?;
    let frame = frame.of(&state);
    match stored {
        StoredSubmission { submission, report: Some(report), .. } => {
            draft_part(&state, &frame, &submission, &report).await
        }
        StoredSubmission { submission, .. } if submission.state == Progress::Failed => {
            Err(Problem::internal(&"grading a draft failed"))
        }
        StoredSubmission { .. } => Ok(come_back(&id)),
    }
}

/// A report as a part of the page with the editor, which shows the lines itself.
pub(super) async fn draft_part(
    state: &State,
    frame: &PageFrame,
    submission: &Submission,
    report: &Report,
) -> Result<Response, Problem> {
    let part = beside_editor(state, frame, submission, report).await?;
    Ok(([(header::CACHE_CONTROL, "no-store")], Html(part)).into_response())
}

async fn beside_editor(
    state: &State,
    frame: &PageFrame,
    submission: &Submission,
    report: &Report,
) -> Result<String, Problem> {
    let sources = state.store.hand_in(&submission.id).await?.unwrap_or_default().readable();
    let gallery = report_fragment::gallery(state, &submission.id, report, &sources);
    let part = report_fragment::render(&state.assignment, frame, report, LineLinks::Elsewhere, gallery.as_ref(), 2);
    part.map_err(internal)
}

/// A report with its homework and its files.
pub(super) async fn report_of(service: &Service, id: &str) -> Result<(State, Report, HandIn), Problem> {
    let (state, StoredSubmission { report, .. }) = service.stored(id).await?;
    let hand_in = state.store.hand_in(id).await?;
    let (report, hand_in) = report.zip(hand_in).ok_or_else(Problem::not_found)?;
    Ok((state, report, hand_in))
}

/// The receipt of what was handed in, with its report as soon as there is one, as parts of the page with the editor.
pub(super) async fn handed_in(
    state: &State,
    frame: &PageFrame,
    submission: &Submission,
    report: Option<&Report>,
) -> Result<Response, Problem> {
    let id = &submission.id;
    let receipt = receipt::receipt(state, frame, submission, report).await?;
    if let Some(report) = report {
        let part = beside_editor(state, frame, submission, report).await?;
        return Ok(([(header::CACHE_CONTROL, "no-store")], Html(receipt + &part)).into_response());
    }
    let headers = [
        (header::CACHE_CONTROL, "no-store".to_owned()),
        (header::LOCATION, format!("/r/{id}/receipt")),
        (header::RETRY_AFTER, if submission.state == Progress::Failed { "10" } else { "1" }.to_owned()),
    ];
    Ok((StatusCode::ACCEPTED, headers, Html(receipt)).into_response())
}

/// `GET /r/{id}/receipt`: the same later.
pub(super) async fn receipt_of(
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let (state, StoredSubmission { submission, report, .. }) = service.stored(&id).await?;
    handed_in(&state, &frame.of(&state), &submission, report.as_ref()).await
}

/// There is no report yet: where to ask for it, in a second.
pub(super) fn come_back(id: &str) -> Response {
    let headers = [(header::LOCATION, format!("/r/{id}/part")), (header::RETRY_AFTER, "1".to_owned())];
    (StatusCode::ACCEPTED, headers).into_response()
}

/// `GET /r/{id}/source`: the files as they were handed in, to be saved.
pub(super) async fn source(Shared(service): Shared<Service>, Path(id): Path<String>) -> Result<Response, Problem> {
    download::hand_in(&service, &id).await
}

pub(super) fn png(bytes: Vec<u8>) -> Response {
    // The address holds the id of one grading, whose pictures never change.
    let headers = [(header::CONTENT_TYPE, "image/png"), (header::CACHE_CONTROL, "private, max-age=86400, immutable")];
    (headers, bytes).into_response()
}

/// Which of the views of a picture.
#[derive(Debug, Default, Deserialize)]
pub(super) struct PictureQuery {
    #[serde(default)]
    view: PictureSet,
}

/// `GET /r/{id}/{picture}`: the sheets of the page, the portrait, the animation.
pub(super) async fn picture(
    Shared(service): Shared<Service>,
    Path((id, picture)): Path<(String, String)>,
    Query(asked): Query<PictureQuery>,
) -> Result<Response, Problem> {
    let (state, submission) = service.submission(&id).await?;
    let found = match picture.as_str() {
        "yours.png" => state.gallery.film(&state, &submission).await?.first().cloned(),
        "difference.png" => state.gallery.film(&state, &submission).await?.get(1).cloned(),
        "portrait.png" => state.gallery.portrait(&state, &submission).await?,
        "animation.png" => state.gallery.animation(&state, &submission, asked.view).await?,
        _ => None,
    };
    found.map(png).ok_or_else(Problem::not_found)
}

/// `GET /r/{id}/frames/{n}.png`.
pub(super) async fn frame(
    Shared(service): Shared<Service>,
    Path((id, picture)): Path<(String, String)>,
    Query(asked): Query<PictureQuery>,
) -> Result<Response, Problem> {
    let index = picture.strip_suffix(".png").and_then(|index| index.parse().ok()).ok_or_else(Problem::not_found)?;
    let (state, submission) = service.submission(&id).await?;
    let found = state.gallery.frame(&state, &submission, asked.view, index).await?;
    found.map(png).ok_or_else(Problem::not_found)
}
