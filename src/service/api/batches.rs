//! `/api/v1/batches` and `/api/v1/class`: for teachers.

use super::archive::UploadedArchive;
use super::body::unkept;
use super::caller::check_page;
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::{BatchJson, FilledFormatName, FormatName, IdempotencyKey};
use crate::class::formats::ClassFormat;
use crate::language::Language;
use crate::service::acts::Detail;
use crate::service::classes::{self, Download, DownloadOptions, DownloadSelection};
use crate::service::download::attachment;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::language::{Lang, asked};
use crate::service::limits::Client;
use crate::service::store::{Batch, StaffRole};
use crate::service::{Service, State};
use axum::Json;
use axum::body::Bytes;
use axum::extract::rejection::{BytesRejection, QueryRejection};
use axum::extract::{Path, Query, Request, State as Shared};
use axum::http::{HeaderMap, HeaderValue, StatusCode, Uri, header};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use clap::ValueEnum;
use futures_util::Stream;
use serde::Deserialize;
use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

/// How often who watches a batch is told.
const TICK: Duration = Duration::from_millis(400);

/// A form with an archive.
#[derive(Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only its description is used")]
pub(super) struct ArchiveForm {
    /// A ZIP: Moodle's download, or a folder for each student.
    #[schema(content_media_type = "application/zip", min_length = 1)]
    file: String,
    /// Id of the assignment; where the service has one only, it may be left out.
    #[schema(nullable = false)]
    assignment: Option<String>,
    /// In place of the header `Idempotency-Key`.
    #[schema(nullable = false, pattern = "^[!-~]([ -~]{0,253}[!-~])?$")]
    idempotency_key: Option<String>,
}

/// Hand in a whole class
///
/// The archive is stored; its files are graded in the background, behind every student who hands in. Where no answer
/// comes, send it again with the same `Idempotency-Key`: it is stored once.
#[utoipa::path(
    post, operation_id = "create_batch", path = "/api/v1/batches", tag = "batches", params(OfQuery, IdempotencyKey), security(("teacher" = [])),
    request_body(content((ArchiveForm = "multipart/form-data"), (Vec<u8> = "application/zip"))),
    responses(
        (status = 202, description = "Stored", body = BatchJson, headers(("Location" = String, description = "The batch"))),
        Refusals, Errors
    )
)]
pub(super) async fn create(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Lang(language): Lang,
    (client, headers): (Client, HeaderMap),
    of: Result<Query<OfQuery>, QueryRejection>,
    request: Request,
) -> Result<Response, Problem> {
    check_page(&teacher, &headers, &service)?;
    teacher.check_role(StaffRole::Lecturer)?;
    let Query(of) = of.map_err(super::body::other)?;
    let archive = UploadedArchive::read(request, &service).await?;
    let of = archive.fields.get("assignment").cloned().or(of.assignment);
    let state = service.named(of.as_deref())?;
    teacher.check(&state.assignment.id)?;
    let key = archive.key(&state.assignment.id, &headers, &client)?;
    let batch = classes::submit(&state, archive.path.to_path_buf(), &archive.title(), key).await?;
    let title = batch.title.clone();
    let body = shown(&state, batch, language).await?;
    let location = body.links.itself.clone();
    let mut response = (StatusCode::ACCEPTED, Json(body)).into_response();
    if let Ok(location) = HeaderValue::from_str(&location) {
        response.headers_mut().insert(header::LOCATION, location);
    }
    Ok(Detail { assignment: Some(state.assignment.id.clone()), ..Detail::of(title) }.on(response))
}

async fn shown(service: &Service, batch: Batch, language: Language) -> Result<BatchJson, Problem> {
    let progress = service.store.progress(&batch.id).await?;
    let entries = service.store.batch_entries(&batch.id).await?;
    Ok(BatchJson::of(batch, progress, entries, language))
}

/// The batch with this id, for a teacher who may see it, and its homework.
async fn find(service: &Service, teacher: &Teacher, id: &str) -> Result<(State, Batch), Problem> {
    let batch = service.store.batch(id).await?.ok_or_else(Problem::not_found)?;
    teacher.check(&batch.assignment)?;
    Ok((service.homework_of(&batch.assignment)?, batch))
}

/// A batch and how far it is
#[utoipa::path(
    get, operation_id = "read_batch", path = "/api/v1/batches/{id}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the batch")),
    responses((status = 200, description = "How far it is", body = BatchJson), NotFound, Refusals, Errors)
)]
pub(super) async fn read(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Lang(language): Lang,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    let (state, batch) = find(&service, &teacher, &id).await?;
    Ok(unkept(shown(&state, batch, language).await?))
}

/// How far a batch is, as it goes on
///
/// Server-sent events `progress`, whose data is the object of that name; the last one is `done`.
#[utoipa::path(
    get, operation_id = "watch_batch", path = "/api/v1/batches/{id}/events", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the batch")),
    responses(
        (status = 200, description = "Events", body = String, content_type = "text/event-stream"), NotFound, Refusals, Errors
    )
)]
pub(super) async fn events(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    find(&service, &teacher, &id).await?;
    let stream = progress(&service, WatchedJob::Batch(id));
    Ok(Sse::new(stream).keep_alive(KeepAlive::default()).into_response())
}

/// What can be watched.
pub(in crate::service) enum WatchedJob {
    /// A batch, by its id.
    Batch(String),
    /// A regrading, by its id.
    Regrading(String),
    /// A download that is being made.
    Download(Arc<classes::DownloadJob>),
}

/// The events of a job until it is done, or the service ends.
pub(in crate::service) fn progress(
    service: &Service,
    job: WatchedJob,
) -> impl Stream<Item = Result<Event, Infallible>> + use<> {
    futures_util::stream::unfold((service.clone(), job, None, false), async |(service, job, mut last, is_over)| {
        if is_over {
            return None;
        }
        loop {
            if service.is_ending() {
                return None;
            }
            let progress = match &job {
                WatchedJob::Batch(id) => service.store.progress(id).await,
                WatchedJob::Regrading(id) => service.store.regrading_progress(id).await,
                WatchedJob::Download(job) => Ok(job.progress()),
            };
            // Who watches may come again; the log has what happened.
            let progress = progress.inspect_err(|error| tracing::error!(%error, "progress")).ok()?;
            if last != Some(progress) {
                last = Some(progress);
                let name = if progress.is_done() { "done" } else { "progress" };
                let event = Event::default().event(name).json_data(progress).unwrap_or_default();
                return Some((Ok(event), (service, job, last, progress.is_done())));
            }
            tokio::time::sleep(TICK).await;
        }
    })
}

/// A batch in a format of `ggrade batch`
///
/// Formats of several files come as a ZIP. `moodle-worksheet` needs the worksheet: POST it here. So does
/// `moodle-feedback` where groups hand in: without the worksheet it takes the numbers of the archive for participants'.
#[utoipa::path(
    get, operation_id = "read_batch_file", path = "/api/v1/batches/{id}/files/{format}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the batch"), ("format" = FormatName, Path, description = "Name of the format")),
    responses((status = 200, description = "The file", body = Vec<u8>, content_type = "application/octet-stream"), NotFound, Refusals, Errors)
)]
pub(super) async fn file(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Lang(language): Lang,
    Path((id, format)): Path<(String, String)>,
    uri: Uri,
) -> Result<Response, Problem> {
    let (state, batch) = find(&service, &teacher, &id).await?;
    made(&state, DownloadSelection::Batch(batch), &format, None, (&uri, language)).await
}

/// A class in the format of this name, in the language that the address asks for, or else that of its readers.
pub(super) async fn made(
    state: &State,
    whose: DownloadSelection,
    format: &str,
    sheet: Option<Vec<u8>>,
    (uri, reader): (&Uri, Language),
) -> Result<Response, Problem> {
    let format = named(format)?;
    let language = classes::language(state, format, asked(uri), reader).await?;
    let wanted = DownloadOptions { format, sheet, language, with_pages: false };
    saved(classes::download(state, whose, wanted, &Arc::default()).await?)
}

/// A batch for Moodle, by its worksheet
///
/// `moodle-worksheet` is the worksheet filled in, `moodle-feedback` everyone's report for the participants in it.
#[utoipa::path(
    post, operation_id = "fill_batch_file", path = "/api/v1/batches/{id}/files/{format}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the batch"), ("format" = FilledFormatName, Path, description = "`moodle-worksheet` or `moodle-feedback`")),
    request_body(content = String, content_type = "text/csv", description = "The worksheet that Moodle gives"),
    responses((status = 200, description = "The file", body = Vec<u8>, content_type = "application/octet-stream"), NotFound, Refusals, Errors)
)]
pub(super) async fn filled(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Lang(language): Lang,
    Path((id, format)): Path<(String, String)>,
    (headers, uri): (HeaderMap, Uri),
    sheet: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    check_page(&teacher, &headers, &service)?;
    teacher.check_role(StaffRole::Lecturer)?;
    let sheet = sheet.map_err(super::body::other)?;
    let (state, batch) = find(&service, &teacher, &id).await?;
    made(&state, DownloadSelection::Batch(batch), &format, Some(sheet.into()), (&uri, language)).await
}

/// Which homework.
#[derive(Clone, Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(default)]
#[into_params(parameter_in = Query)]
pub(super) struct OfQuery {
    /// Id of the assignment; where the service has one only, it may be left out.
    pub(super) assignment: Option<String>,
}

/// The format of this name.
pub(in crate::service) fn named(name: &str) -> Result<ClassFormat, Problem> {
    ClassFormat::from_str(name, false).map_err(|_| Problem::not_found())
}

/// A file to be saved, never to be shown: what students wrote is in it.
pub(in crate::service) fn saved(download: Download) -> Result<Response, Problem> {
    let mut response = download.bytes.into_response();
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("application/octet-stream"));
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("private, no-store"));
    if let Ok(disposition) = HeaderValue::from_str(&attachment(&download.name)) {
        headers.insert(header::CONTENT_DISPOSITION, disposition);
    }
    Ok(response)
}
