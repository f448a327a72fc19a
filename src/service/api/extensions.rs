//! `/api/v1/extensions`: for teachers.

use super::batches::OfQuery;
use super::body::unkept;
use super::caller::{Caller, check};
use super::members::read;
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::time;
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::errors::Problem;
use crate::service::extensions::{beneficiary, grant};
use crate::service::identity::Teacher;
use crate::service::store::{Beneficiary, NamedExtension, StaffRole};
use axum::Json;
use axum::extract::rejection::{JsonRejection, QueryRejection};
use axum::extract::{Query, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A deadline in place of that of the class.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct ExtensionJson {
    /// Student number; none where it is a group's.
    student: Option<String>,
    /// Name of the group; none where it is a student's.
    group: Option<String>,
    /// When the homework is due for them.
    #[schema(format = DateTime)]
    due_at: String,
    /// Why, for those who teach.
    reason: String,
}

/// The deadlines of a homework that are not the class's.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct ExtensionsJson {
    /// Groups first.
    extensions: Vec<ExtensionJson>,
}

/// A deadline to be set.
#[derive(Debug, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ExtensionWish {
    /// Number of a student, or name of a group of the roster.
    whose: String,
    /// When the homework is due for them, in RFC 3339; null or nothing takes their own deadline away.
    #[serde(default)]
    #[schema(value_type = Option<String>, format = DateTime)]
    due_at: Option<jiff::Timestamp>,
    /// Why, for those who teach.
    #[serde(default)]
    reason: String,
}

/// The deadlines of students and groups
///
/// Those in place of the class's.
#[utoipa::path(
    get, operation_id = "list_extensions", path = "/api/v1/extensions", tag = "batches", security(("teacher" = [])),
    params(OfQuery),
    responses((status = 200, description = "Each with its reason", body = ExtensionsJson), NotFound, Refusals, Errors)
)]
pub(super) async fn list(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    of: Result<Query<OfQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(of) = of.map_err(super::body::other)?;
    let state = service.named(of.assignment.as_deref())?;
    teacher.check(&state.assignment.id)?;
    teacher.check_role(StaffRole::Lecturer)?;
    let json = |extension: NamedExtension| ExtensionJson {
        group: extension.number.is_none().then_some(extension.key),
        student: extension.number,
        due_at: time(extension.closes_at),
        reason: extension.reason,
    };
    let extensions = state.store.extensions(&state.assignment.id).await?.into_iter().map(json).collect();
    Ok(unkept(ExtensionsJson { extensions }))
}

/// Set the deadline of a student or a group
///
/// It must be later than that of the class. Of several the latest counts.
#[utoipa::path(
    put, operation_id = "set_extension", path = "/api/v1/extensions", tag = "batches", security(("teacher" = [])),
    params(OfQuery), request_body = ExtensionWish,
    responses((status = 204, description = "Set, or taken away"), NotFound, Refusals, Errors)
)]
pub(super) async fn set(
    caller: Caller,
    Shared(service): Shared<Service>,
    of: Result<Query<OfQuery>, QueryRejection>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check(&caller, &service, StaffRole::Lecturer)?;
    let Query(of) = of.map_err(super::body::other)?;
    let wish: ExtensionWish = read(wish)?;
    let state = service.named(of.assignment.as_deref())?;
    caller.0.check(&state.assignment.id)?;
    let to = beneficiary(&state, &wish.whose).await?;
    let reason = grant(&state, &to, wish.due_at.map(jiff::Timestamp::as_millisecond), &wish.reason).await?;
    let until = wish.due_at.map_or_else(|| "–".to_owned(), |at| at.to_string());
    let assignment = Some(state.assignment.id.clone());
    let detail = match &to {
        Beneficiary::Student(id) => Detail { text: format!("{until} {reason}"), ..Detail::about(id) },
        Beneficiary::Group(group) => Detail::of(format!("{group}: {until} {reason}")),
    };
    Ok(Detail { assignment, ..detail }.on(StatusCode::NO_CONTENT.into_response()))
}
