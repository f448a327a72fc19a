//! `/api/v1/class/files`: the class as a file, for teachers.

use super::batches::{OfQuery, made};
use super::caller::check_page;
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::{FilledFormatName, FormatName};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::classes::{DownloadSelection, Pick};
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::language::Lang;
use crate::service::store::StaffRole;
use axum::body::Bytes;
use axum::extract::rejection::{BytesRejection, QueryRejection};
use axum::extract::{Path, Query, State as Shared};
use axum::http::{HeaderMap, Uri};
use axum::response::Response;
use serde::Deserialize;

/// Which submissions of students count.
#[derive(Clone, Copy, Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(default)]
#[into_params(parameter_in = Query)]
pub(super) struct PickQuery {
    /// `counted` (by the rules of the homework), `best` or `latest`.
    #[param(inline)]
    pick: Pick,
}

/// The class in a format of `ggrade batch`
///
/// Everyone of the roster, also who handed in nothing; without a roster, whoever handed in as somebody. Formats that
/// students read are in the course's language, unless `lang` asks for another.
#[utoipa::path(
    get, operation_id = "read_class_file", path = "/api/v1/class/files/{format}", tag = "batches", security(("teacher" = [])),
    params(("format" = FormatName, Path, description = "Name of the format"), PickQuery, OfQuery),
    responses((status = 200, description = "The file", body = Vec<u8>, content_type = "application/octet-stream"), NotFound, Refusals, Errors)
)]
pub(super) async fn read(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Lang(language): Lang,
    Path(format): Path<String>,
    (pick, of): (Result<Query<PickQuery>, QueryRejection>, Result<Query<OfQuery>, QueryRejection>),
    uri: Uri,
) -> Result<Response, Problem> {
    let Query(PickQuery { pick }) = pick.map_err(super::body::other)?;
    let Query(OfQuery { assignment }) = of.map_err(super::body::other)?;
    let state = service.named(assignment.as_deref())?;
    teacher.check(&state.assignment.id)?;
    made(&state, DownloadSelection::Students(pick), &format, None, (&uri, language)).await
}

/// The class for Moodle, by its worksheet
///
/// `moodle-worksheet` is the worksheet filled in, `moodle-feedback` everyone's report for the participants in it. Whose each row is
/// the roster says: by student number, by Moodle's number, by name.
#[utoipa::path(
    post, operation_id = "fill_class_file", path = "/api/v1/class/files/{format}", tag = "batches", security(("teacher" = [])),
    params(("format" = FilledFormatName, Path, description = "`moodle-worksheet` or `moodle-feedback`"), PickQuery, OfQuery),
    request_body(content = String, content_type = "text/csv", description = "The worksheet that Moodle gives"),
    responses((status = 200, description = "The file", body = Vec<u8>, content_type = "application/octet-stream"), NotFound, Refusals, Errors)
)]
pub(super) async fn filled(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Lang(language): Lang,
    Path(format): Path<String>,
    (pick, of): (Result<Query<PickQuery>, QueryRejection>, Result<Query<OfQuery>, QueryRejection>),
    (headers, uri): (HeaderMap, Uri),
    sheet: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    check_page(&teacher, &headers, &service)?;
    teacher.check_role(StaffRole::Lecturer)?;
    let Query(PickQuery { pick }) = pick.map_err(super::body::other)?;
    let Query(OfQuery { assignment }) = of.map_err(super::body::other)?;
    let sheet = sheet.map_err(super::body::other)?;
    let state = service.named(assignment.as_deref())?;
    teacher.check(&state.assignment.id)?;
    let file = made(&state, DownloadSelection::Students(pick), &format, Some(sheet.into()), (&uri, language)).await?;
    let assignment = Some(state.assignment.id.clone());
    Ok(Detail { assignment, ..Detail::of(format) }.on(file))
}
