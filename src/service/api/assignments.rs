//! `/api/v1/assignments`: the homeworks of the service.

use super::refusals::Errors;
use crate::service::language::Lang;
use crate::service::{Service, State};
use axum::Json;
use axum::extract::State as Shared;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// A homework that the service takes files for.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct AssignmentJson {
    /// Its id: what `assignment` takes.
    id: String,
    /// The digest of its folder: a homework that was changed has another.
    digest: String,
    /// Its title, in the language of the request.
    title: String,
    /// The names of its files, in order.
    files: Vec<String>,
    /// Where else to look.
    links: AssignmentLinks,
}

/// Addresses of one homework.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct AssignmentLinks {
    /// The student's page.
    page: String,
    /// The handed-out file; several as a ZIP, and each by itself with `?file=` and its name.
    starter: String,
}

/// The homeworks of the service.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct AssignmentsJson {
    /// In the order in which the service was given them.
    assignments: Vec<AssignmentJson>,
}

/// The homeworks of the service
#[utoipa::path(
    get, operation_id = "list_assignments", path = "/api/v1/assignments", tag = "submissions",
    params(super::submissions::LangQuery),
    responses((status = 200, description = "Each with its id", body = AssignmentsJson), Errors)
)]
pub(super) async fn list(Shared(service): Shared<Service>, Lang(language): Lang) -> Response {
    let assignment = |state: State| AssignmentJson {
        id: state.assignment.id.clone(),
        digest: state.assignment.digest.clone(),
        title: language.of(&state.assignment.title).to_owned(),
        files: state.assignment.files.iter().map(|file| file.name.clone()).collect(),
        links: AssignmentLinks { page: state.page(), starter: format!("{}/starter", state.page()) },
    };
    let assignments = service.homeworks().map(assignment).collect();
    ([(header::CACHE_CONTROL, "no-store")], Json(AssignmentsJson { assignments })).into_response()
}
