//! The archive of a term: for teachers.

use super::caller::{check_page, check_reader};
use super::refusals::{Errors, NotFound, Refusals};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::courses::at;
use crate::service::download::saved;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::store::StaffRole;
use axum::Json;
use axum::extract::{Path, State as Shared};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// An archive that is being made.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct ArchiveJson {
    /// Address of the archive.
    archive: String,
    /// How many steps are done,
    done: u64,
    /// and how many there are as far as is known.
    steps: u64,
}

fn waiting(id: &str, progress: (u64, u64)) -> Response {
    let archive = at(&format!("/api/v1/archive/{id}"));
    let location = HeaderValue::from_str(&archive).ok();
    let json = ArchiveJson { archive, done: progress.0, steps: progress.1 };
    let mut response = (StatusCode::ACCEPTED, [(header::RETRY_AFTER, "5")], Json(json)).into_response();
    if let Some(location) = location {
        response.headers_mut().insert(header::LOCATION, location);
    }
    response
}

/// Make the archive of the term
///
/// Of all homeworks: a ZIP that opens without ggrade, with `index.html`, the class pages, everyone's feedback page, everything that
/// was handed in, the grades as CSV and JSON, and the log. Ask for it at `Location`; the last eight are kept.
#[utoipa::path(
    post, operation_id = "make_archive", path = "/api/v1/archive", tag = "batches", security(("teacher" = [])),
    responses((status = 202, description = "It is being made", body = ArchiveJson), Refusals, Errors)
)]
pub(super) async fn make(
    teacher: Teacher,
    headers: HeaderMap,
    Shared(service): Shared<Service>,
) -> Result<Response, Problem> {
    check_page(&teacher, &headers, &service)?;
    check_reader(&teacher, StaffRole::Lecturer)?;
    let state = service.homeworks().next().ok_or_else(Problem::not_found)?;
    let language = service.store.course().await?.language;
    let job = service.downloads.archive(&state, language, at("/teacher/data"));
    Ok(Detail::of("term.zip").on(waiting(&job.id, (0, 1))))
}

/// The archive of the term
#[utoipa::path(
    get, operation_id = "read_archive", path = "/api/v1/archive/{id}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the archive")),
    responses(
        (status = 200, description = "The ZIP", body = Vec<u8>, content_type = "application/zip"),
        (status = 202, description = "It is being made", body = ArchiveJson), NotFound, Refusals, Errors
    )
)]
pub(super) async fn read(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    check_reader(&teacher, StaffRole::Lecturer)?;
    let job = service.downloads.get(&id).filter(|job| job.is_archive).ok_or_else(Problem::not_found)?;
    match job.made() {
        None => {
            let progress = job.progress();
            Ok(waiting(&id, (progress.graded, progress.files)))
        }
        Some(Err(problem)) => Err(problem.clone()),
        Some(Ok(made)) => {
            let bytes = tokio::fs::read(&made.path).await.map_err(|error| Problem::internal(&error))?;
            Ok(saved(&made.name, "application/zip", bytes))
        }
    }
}
