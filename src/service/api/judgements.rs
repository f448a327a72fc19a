//! What people judge beside the grading: for teachers.

use super::caller::{Caller, check_page};
use super::members::read;
use super::refusals::{Errors, NotFound, Refusals};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::errors::Problem;
use crate::service::judgement;
use crate::service::store::{StoredComment, StoredSubmission};
use axum::Json;
use axum::extract::rejection::JsonRejection;
use axum::extract::{Path, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The submission with its report, for a teacher who may see it.
pub(super) async fn judged(
    service: &Service,
    (teacher, headers): &Caller,
    id: &str,
) -> Result<StoredSubmission, Problem> {
    check_page(teacher, headers, service)?;
    let (_, stored) = service.stored(id).await?;
    teacher.check(&stored.submission.assignment)?;
    Ok(stored)
}

/// An answer with a line for the log, where something is said there.
fn noted_where(stored: StoredSubmission, text: Option<String>, response: impl IntoResponse) -> Response {
    match text {
        Some(text) => noted(stored, text, response),
        None => response.into_response(),
    }
}

/// An answer with a line for the log.
pub(super) fn noted(stored: StoredSubmission, text: String, response: impl IntoResponse) -> Response {
    let assignment = Some(stored.submission.assignment);
    Detail { student_id: stored.submission.student_id, assignment, text }.on(response.into_response())
}

/// Points of a line of the rubric in place of the grading's.
#[derive(Debug, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct OverrideWish {
    /// The points.
    points: f64,
    /// Why; the student reads it.
    #[schema(min_length = 1, max_length = 2000)]
    reason: String,
}

/// Override a line of the rubric
///
/// It holds when everything is graded again. The report has the grading's own points in `graded_points`.
#[utoipa::path(
    put, operation_id = "override_line", path = "/api/v1/submissions/{id}/rubric/{line}", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the submission"), ("line" = String, Path, description = "Id of the line")),
    request_body = OverrideWish,
    responses((status = 204, description = "Overridden"), NotFound, Refusals, Errors)
)]
pub(super) async fn override_line(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path((id, line)): Path<(String, String)>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    let OverrideWish { points, reason } = read(wish)?;
    let stored = judged(&service, &caller, &id).await?;
    let said = judgement::override_line(&service, &caller.0, &stored, &line, Some((points, &reason))).await?;
    Ok(noted_where(stored, said, StatusCode::NO_CONTENT))
}

/// Let the grading's points of a line count again
#[utoipa::path(
    delete, operation_id = "clear_override", path = "/api/v1/submissions/{id}/rubric/{line}", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the submission"), ("line" = String, Path, description = "Id of the line")),
    responses((status = 204, description = "The grading's points count"), NotFound, Refusals, Errors)
)]
pub(super) async fn clear_override(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path((id, line)): Path<(String, String)>,
) -> Result<Response, Problem> {
    let stored = judged(&service, &caller, &id).await?;
    let said = judgement::override_line(&service, &caller.0, &stored, &line, None).await?;
    Ok(noted_where(stored, said, StatusCode::NO_CONTENT))
}

/// A comment on a line of a file.
#[derive(Debug, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CommentWish {
    /// Name of the file; where there is one only, it may be left out.
    #[serde(default)]
    file: String,
    /// Line of the file, from 1.
    line: u32,
    /// What is said; the student reads it.
    #[schema(min_length = 1, max_length = 2000)]
    text: String,
}

/// A comment that is kept.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct CommentJson {
    /// Its id, by which it is removed.
    id: String,
    /// Name of the file.
    file: String,
    /// Line of the file, from 1.
    line: i64,
    /// What is said.
    text: String,
}

impl CommentJson {
    fn of(StoredComment { id, file, line, text, .. }: StoredComment) -> Self {
        Self { id, file, line, text }
    }
}

/// Comment on a line of a file
///
/// The report has every comment in `comments`.
#[utoipa::path(
    post, operation_id = "add_comment", path = "/api/v1/submissions/{id}/comments", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the submission")), request_body = CommentWish,
    responses((status = 201, description = "Kept", body = CommentJson), NotFound, Refusals, Errors)
)]
pub(super) async fn add_comment(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    let CommentWish { file, line, text } = read(wish)?;
    let stored = judged(&service, &caller, &id).await?;
    let comment = judgement::comment(&service, &caller.0, &stored, (&file, line), &text).await?;
    let said = format!("{}:{}: {}", comment.file, comment.line, comment.text);
    Ok(noted(stored, said, (StatusCode::CREATED, Json(CommentJson::of(comment)))))
}

/// Remove a comment
#[utoipa::path(
    delete, operation_id = "remove_comment", path = "/api/v1/submissions/{id}/comments/{comment}", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the submission"), ("comment" = String, Path, description = "Id of the comment")),
    responses((status = 204, description = "Removed"), NotFound, Refusals, Errors)
)]
pub(super) async fn remove_comment(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path((id, comment)): Path<(String, String)>,
) -> Result<Response, Problem> {
    let stored = judged(&service, &caller, &id).await?;
    if !service.store.remove_comment(&id, &comment).await? {
        return Err(Problem::not_found());
    }
    Ok(noted(stored, "–".to_owned(), StatusCode::NO_CONTENT))
}
