//! Whole classes: a Moodle archive is uploaded and graded in the background; downloads in every format.

use super::super::frame::Frame;
use super::super::moment::Moment;
use super::super::shown;
use super::Place;
use super::class::{Filter, Row, row};
use super::people::people;
use crate::batch::formats::Format;
use crate::service::State;
use crate::service::api::archive::Archive;
use crate::service::api::batches::saved;
use crate::service::classes::{self, Whose};
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use crate::service::limits::Client;
use crate::service::store::{Batch, Progress};
use askama::Template;
use axum::extract::{Multipart, Path, Request, State as Shared};
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Redirect, Response};
use clap::ValueEnum;

#[derive(Template)]
#[template(path = "service/batches.html")]
struct List {
    frame: Frame,
    place: Place,
    csrf: String,
    archive_mib: u64,
    batches: Vec<Line>,
    regradings: Vec<Line>,
    formats: Vec<Offer>,
}

/// One archive, or one regrading, in its list.
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
    let here =
        all.filter(|format| **format != Format::MoodleWorksheet && (is_batch || **format != Format::MoodleFeedback));
    here.map(|format| Offer { id: format.id(), what: format.description().get(frame.language).replace('`', "") })
        .collect()
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
    let mut regradings = Vec::new();
    for regrading in state.store.regradings(&state.assignment.id).await? {
        let progress = state.store.regrading_progress(&regrading.id).await?;
        let at = Moment::of(regrading.created_at, frame.language);
        let title = match regrading.adopted_at {
            Some(_) => frame.say("adopted", "採用済み"),
            None => frame.say("not adopted", "未採用"),
        };
        let href = format!("/teacher/regradings/{}", regrading.id);
        regradings.push(Line { href, title: title.to_owned(), at, progress });
    }
    let (csrf, formats) = (teacher.csrf(&state), formats(&frame, false));
    let archive_mib = state.config.archive_mib;
    shown(List { frame, place: Place::Batches, csrf, archive_mib, batches, regradings, formats }.render())
}

/// `POST /teacher/batches`: stores an archive.
pub(in crate::service::pages) async fn upload(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    client: Client,
    headers: HeaderMap,
    request: Request,
) -> Result<Response, Problem> {
    let archive = Archive::read(request, &state).await?;
    teacher.check_csrf(&state, archive.fields.get("csrf").map(String::as_str).unwrap_or_default())?;
    let key = archive.key(&headers, &client)?;
    let batch = classes::submit(&state, archive.path.to_path_buf(), &archive.title(), key).await?;
    Ok(Redirect::to(&format!("/teacher/batches/{}", batch.id)).into_response())
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
            events: format!("/api/v1/batches/{id}/events"),
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

fn broken() -> Problem {
    Problem::bad_request("The upload broke off.", "アップロードが途中で切れました。")
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
    while let Some(field) = form.next_field().await.map_err(|_| broken())? {
        match field.name().unwrap_or_default() {
            "csrf" => csrf = field.text().await.map_err(|_| broken())?,
            "sheet" => sheet = field.bytes().await.map_err(|_| broken())?.to_vec(),
            _ => {}
        }
    }
    teacher.check_csrf(&state, &csrf)?;
    let file = classes::download(&state, Whose::Batch(batch), Format::MoodleWorksheet, Some(sheet), frame.language);
    saved(file.await?)
}
