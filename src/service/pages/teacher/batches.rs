//! Whole classes as archives: one is uploaded and graded in the background, and comes back in every format.

use super::super::datetime::TimeElement;
use super::super::frame::PageFrame;
use super::super::shown;
use super::downloads::{DownloadOffer, formats};
use super::table::{StudentTable, TableFilter};
use super::worksheets::filled;
use super::{Tab, refused};
use crate::service::State;
use crate::service::acts::Detail;
use crate::service::api::archive::UploadedArchive;
use crate::service::classes::{self, DownloadSelection, Person, of_batch};
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::{LecturerPage, Teacher, TeacherPage};
use crate::service::limits::Client;
use crate::service::store::{Batch, Progress};
use askama::Template;
use axum::extract::multipart::MultipartRejection;
use axum::extract::{Multipart, Path, Query, Request, State as Shared};
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Redirect, Response};

#[derive(Template)]
#[template(path = "service/pages/templates/batches.html")]
struct BatchesPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    /// What is wrong with the archive that was sent.
    problem: Option<String>,
    archive_mib: u64,
    batches: Vec<BatchLine>,
    regradings: Vec<BatchLine>,
}

/// One archive, or one regrading, in its list.
struct BatchLine {
    id: String,
    title: String,
    at: TimeElement,
    progress: Progress,
}

#[derive(Template)]
#[template(path = "service/pages/templates/batch.html")]
struct BatchPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    title: String,
    at: TimeElement,
    events: String,
    progress: Progress,
    table: StudentTable,
    refused: Vec<(String, String)>,
    id: String,
    formats: Vec<DownloadOffer>,
    /// Where the files of the formats are, and the batch that they are of.
    files: String,
    of_batch: String,
    query: &'static str,
    /// Where the form for Moodle's worksheet leads.
    worksheet: String,
    /// What is wrong with the worksheet that was sent.
    problem: Option<String>,
}

/// `GET /teacher/batches`.
pub(in crate::service::pages) async fn list(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view_list(&state, &teacher, frame, None).await
}

async fn view_list(
    state: &State,
    teacher: &Teacher,
    frame: PageFrame,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let mut batches = Vec::new();
    for batch in state.store.batches(&state.assignment.id).await? {
        let progress = state.store.progress(&batch.id).await?;
        let at = frame.datetime(batch.created_at);
        batches.push(BatchLine { id: batch.id, title: batch.title, at, progress });
    }
    let mut regradings = Vec::new();
    for regrading in state.store.regradings(&state.assignment.id).await? {
        let progress = state.store.regrading_progress(&regrading.id).await?;
        let at = frame.datetime(regrading.created_at);
        let title = match regrading.adopted_at {
            Some(_) => frame.say("adopted", "採用済み"),
            None => frame.say("not adopted", "未採用"),
        };
        regradings.push(BatchLine { id: regrading.id, title: title.to_owned(), at, progress });
    }
    let (csrf, archive_mib) = (teacher.csrf(state), state.config.archive_mib);
    shown(BatchesPage { frame, place: Tab::Batches, csrf, problem, archive_mib, batches, regradings }.render())
}

/// `POST /teacher/batches`: stores an archive. One that cannot be read leads back to the form.
pub(in crate::service::pages) async fn upload(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    client: Client,
    headers: HeaderMap,
    frame: PageFrame,
    request: Request,
) -> Result<Response, Problem> {
    match stored(&state, &teacher, (&headers, &client), request).await {
        Ok(batch) => {
            let answer = Redirect::to(&format!("{}/batches/{}", frame.teacher(), batch.id)).into_response();
            Ok(Detail::of(batch.title).on(answer))
        }
        Err(problem) if problem.status.is_client_error() => {
            let detail = problem.detail.get(frame.language).replace('`', "");
            Ok(refused(view_list(&state, &teacher, frame, Some(detail)).await?, problem.status))
        }
        Err(problem) => Err(problem),
    }
}

async fn stored(
    state: &State,
    teacher: &Teacher,
    (headers, client): (&HeaderMap, &Client),
    request: Request,
) -> Result<Batch, Problem> {
    let archive = UploadedArchive::read(request, state).await?;
    teacher.check_csrf(state, archive.fields.get("csrf").map(String::as_str).unwrap_or_default())?;
    let key = archive.key(&state.assignment.id, headers, client)?;
    classes::submit(state, archive.path.to_path_buf(), &archive.title(), key).await
}

/// The archive with this id, where it is of this homework.
pub(super) async fn found(state: &State, id: &str) -> Result<Batch, Problem> {
    let of_this = |batch: &Batch| batch.assignment == state.assignment.id;
    state.store.batch(id).await?.filter(of_this).ok_or_else(Problem::not_found)
}

/// `GET /teacher/batches/{id}`.
pub(in crate::service::pages) async fn one(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
    Query(filter): Query<TableFilter>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let batch = found(&state, &id).await?;
    view_one(&state, &teacher, frame, batch, &filter, None).await
}

async fn view_one(
    state: &State,
    teacher: &Teacher,
    frame: PageFrame,
    batch: Batch,
    filter: &TableFilter,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let people = of_batch(state, &batch.id).await?;
    let everyone: Vec<&Person> = people.iter().collect();
    let said = |text: &crate::language::Text| text.get(frame.language).replace('`', "");
    shown(
        BatchPage {
            place: Tab::Batches,
            csrf: teacher.csrf(state),
            at: frame.datetime(batch.created_at),
            events: at(&format!("/api/v1/batches/{}/events", batch.id)),
            progress: state.store.progress(&batch.id).await?,
            table: StudentTable::of(&frame, &everyone, filter),
            refused: batch.refused.iter().map(|refused| (refused.path.clone(), said(&refused.reason))).collect(),
            formats: formats(&frame),
            files: at(&format!("/api/v1/batches/{}/files", batch.id)),
            of_batch: batch.id.clone(),
            query: "",
            worksheet: format!("{}/batches/{}/worksheet", frame.teacher(), batch.id),
            title: batch.title,
            id: batch.id,
            problem,
            frame,
        }
        .render(),
    )
}

/// `POST /teacher/batches/{id}/worksheet`: Moodle's worksheet, filled in, or the reports for the participants in it, behind
/// a page that says what could not be filled in. A worksheet that cannot be read leads back to the form.
pub(in crate::service::pages) async fn worksheet(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
    frame: PageFrame,
    form: Result<Multipart, MultipartRejection>,
) -> Result<Response, Problem> {
    let batch = found(&state, &id).await?;
    let back = format!("{}/batches/{id}", frame.teacher());
    let whose = DownloadSelection::Batch(batch.clone());
    match filled(&state, &teacher, whose, frame.course.language, back, form).await {
        Err(problem) if problem.status.is_client_error() => {
            let detail = problem.detail.get(frame.language).replace('`', "");
            let page = view_one(&state, &teacher, frame, batch, &TableFilter::default(), Some(detail)).await?;
            Ok(refused(page, problem.status))
        }
        answer => answer,
    }
}
