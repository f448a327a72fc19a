//! Whole classes: a Moodle archive is uploaded and graded in the background; downloads in every format.

use super::super::frame::Frame;
use super::super::moment::Moment;
use super::super::result::attachment;
use super::super::shown;
use super::people::people;
use super::class::{Filter, Row, row};
use super::{Place, live};
use crate::batch::formats::Format;
use crate::service::State;
use crate::service::classes::{self, Whose};
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use crate::service::store::{Batch, Progress};
use askama::Template;
use axum::extract::multipart::Field;
use axum::extract::{Multipart, Path, State as Shared};
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Redirect, Response};
use clap::ValueEnum;
use std::io::Write;

#[derive(Template)]
#[template(path = "service/batches.html")]
struct List {
    frame: Frame,
    place: Place,
    csrf: String,
    archive_mib: u64,
    batches: Vec<Line>,
    formats: Vec<Offer>,
}

/// One archive in the list.
struct Line {
    href: String,
    title: String,
    at: Moment,
    progress: Progress,
}

/// A format to download.
struct Offer {
    id: &'static str,
    what: String,
}

#[derive(Template)]
#[template(path = "service/batch.html")]
struct One {
    frame: Frame,
    place: Place,
    csrf: String,
    title: String,
    at: Moment,
    events: String,
    progress: Progress,
    rows: Vec<Row>,
    notes: Vec<(String, String)>,
    refused: Vec<(String, String)>,
    id: String,
    formats: Vec<Offer>,
}

/// The formats, but for the worksheet, which needs a file of Moodle's first.
fn formats(frame: &Frame, is_batch: bool) -> Vec<Offer> {
    let all = Format::value_variants().iter();
    let here = all.filter(|format| {
        **format != Format::MoodleWorksheet && (is_batch || **format != Format::MoodleFeedback)
    });
    here.map(|format| Offer { id: format.id(), what: format.description().get(frame.language).to_owned() }).collect()
}

/// `GET /teacher/batches`.
pub(in crate::service::pages) async fn list(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    frame: Frame,
) -> Result<Response, Problem> {
    let mut batches = Vec::new();
    for batch in state.store.batches(&state.assignment.id).await? {
        let progress = state.store.progress(&batch.id).await?;
        let at = Moment::of(batch.created_at, frame.language);
        batches.push(Line { href: format!("/teacher/batches/{}", batch.id), title: batch.title, at, progress });
    }
    let (csrf, formats) = (teacher.csrf(&state), formats(&frame, false));
    shown(List { frame, place: Place::Batches, csrf, archive_mib: state.config.archive_mib, batches, formats }.render())
}

/// `POST /teacher/batches`: stores an archive.
pub(in crate::service::pages) async fn upload(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    mut form: Multipart,
) -> Result<Response, Problem> {
    let mut csrf = String::new();
    let mut archive = None;
    while let Some(field) = form.next_field().await.map_err(broken)? {
        match field.name().unwrap_or_default() {
            "csrf" => csrf = field.text().await.map_err(broken)?,
            "archive" => {
                teacher.check_csrf(&state, &csrf)?;
                let title = field.file_name().unwrap_or_default().to_owned();
                archive = Some((kept(field).await?, title));
            }
            _ => {}
        }
    }
    let Some((file, title)) = archive.filter(|(_, title)| !title.is_empty()) else {
        return Err(Problem::bad_request("Choose an archive first.", "先にアーカイブを選択してください。"));
    };
    let batch = classes::submit(&state, file.path().to_owned(), &title).await?;
    Ok(Redirect::to(&format!("/teacher/batches/{}", batch.id)).into_response())
}

fn broken(error: axum::extract::multipart::MultipartError) -> Problem {
    if error.status() == axum::http::StatusCode::PAYLOAD_TOO_LARGE {
        return Problem::new(
            error.status(),
            "too-large",
            "The archive is larger than this service takes (--archive-mib).",
            "アーカイブがこのサービスの上限（--archive-mib）を超えています。",
        );
    }
    Problem::bad_request("The upload arrived incomplete. Please send it again.", "アップロードが途中で切れました。もう一度送信してください。")
}

/// An archive on its way in, in a file that goes away by itself.
async fn kept(mut field: Field<'_>) -> Result<tempfile::NamedTempFile, Problem> {
    let failed = |error: std::io::Error| Problem::internal(&error);
    let mut file = tempfile::Builder::new().suffix(".zip").tempfile().map_err(failed)?;
    while let Some(chunk) = field.chunk().await.map_err(broken)? {
        file.write_all(&chunk).map_err(failed)?;
    }
    file.flush().map_err(failed)?;
    Ok(file)
}

async fn found(state: &State, id: &str) -> Result<Batch, Problem> {
    state.store.batch(id).await?.ok_or_else(Problem::not_found)
}

/// `GET /teacher/batches/{id}`.
pub(in crate::service::pages) async fn one(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
    frame: Frame,
) -> Result<Response, Problem> {
    let batch = found(&state, &id).await?;
    let mut people = people(&state, Some(&id)).await?;
    people.sort_by(|a, b| (&a.number, &a.name).cmp(&(&b.number, &b.name)));
    let entries = state.store.batch_entries(&id).await?;
    let said = |text: &crate::language::Text| text.get(frame.language).to_owned();
    let notes = entries.iter().filter_map(|entry| Some((entry.student.name.clone(), said(entry.note.as_ref()?))));
    let filter = Filter::default();
    shown(
        One {
            place: Place::Batches,
            csrf: teacher.csrf(&state),
            at: Moment::of(batch.created_at, frame.language),
            events: format!("/teacher/batches/{id}/events"),
            progress: state.store.progress(&id).await?,
            rows: people.iter().enumerate().map(|(index, person)| row(&frame, &filter, index, person)).collect(),
            notes: notes.collect(),
            refused: batch.refused.iter().map(|refused| (refused.path.clone(), said(&refused.reason))).collect(),
            formats: formats(&frame, true),
            title: batch.title,
            id,
            frame: frame.of(&state.assignment.id),
        }
        .render(),
    )
}

/// `GET /teacher/batches/{id}/events`: how far it is, as it goes on.
pub(in crate::service::pages) async fn events(
    Shared(state): Shared<State>,
    _: TeacherPage,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    found(&state, &id).await?;
    Ok(live::events(&state, live::What::Batch(id)))
}

/// `GET /teacher/download/{format}`: everyone.
pub(in crate::service::pages) async fn download_class(
    Shared(state): Shared<State>,
    _: TeacherPage,
    Path(format): Path<String>,
    frame: Frame,
) -> Result<Response, Problem> {
    saved(&state, Whose::Students(classes::Pick::Best), &format, None, &frame).await
}

/// `GET /teacher/batches/{id}/download/{format}`.
pub(in crate::service::pages) async fn download(
    Shared(state): Shared<State>,
    _: TeacherPage,
    Path((id, format)): Path<(String, String)>,
    frame: Frame,
) -> Result<Response, Problem> {
    let batch = found(&state, &id).await?;
    saved(&state, Whose::Batch(batch), &format, None, &frame).await
}

/// `POST /teacher/batches/{id}/worksheet`: Moodle's worksheet, filled in.
pub(in crate::service::pages) async fn worksheet(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
    frame: Frame,
    mut form: Multipart,
) -> Result<Response, Problem> {
    let batch = found(&state, &id).await?;
    let (mut csrf, mut sheet) = (String::new(), Vec::new());
    while let Some(field) = form.next_field().await.map_err(broken)? {
        match field.name().unwrap_or_default() {
            "csrf" => csrf = field.text().await.map_err(broken)?,
            "sheet" => sheet = field.bytes().await.map_err(broken)?.to_vec(),
            _ => {}
        }
    }
    teacher.check_csrf(&state, &csrf)?;
    saved(&state, Whose::Batch(batch), Format::MoodleWorksheet.id(), Some(sheet), &frame).await
}

async fn saved(
    state: &State,
    whose: Whose,
    format: &str,
    sheet: Option<Vec<u8>>,
    frame: &Frame,
) -> Result<Response, Problem> {
    let format = Format::from_str(format, false).map_err(|_| Problem::not_found())?;
    let file = classes::download(state, whose, format, sheet, frame.language).await?;
    let headers = [
        (header::CONTENT_TYPE, HeaderValue::from_static(file.kind)),
        (header::CONTENT_DISPOSITION, attachment(&file.name)),
        (header::CACHE_CONTROL, HeaderValue::from_static("no-store")),
    ];
    Ok((headers, file.bytes).into_response())
}
