//! What people judge beside the grading: for teachers.

use super::batches::OfQuery;
use super::body::unkept;
use super::caller::{Caller, check_page};
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::time;
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::judgement::{self, Handling, handle};
use crate::service::store::{Appeal, StoredComment, StoredSubmission};
use axum::Json;
use axum::extract::rejection::{JsonRejection, QueryRejection};
use axum::extract::{Path, Query, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};

/// The submission with its report, for a teacher who may see it.
async fn judged(service: &Service, (teacher, headers): &Caller, id: &str) -> Result<StoredSubmission, Problem> {
    check_page(teacher, headers, service)?;
    let (_, stored) = service.stored(id).await?;
    teacher.check(&stored.submission.assignment)?;
    Ok(stored)
}

/// An answer with a line for the log.
fn noted(stored: StoredSubmission, text: String, response: impl IntoResponse) -> Response {
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
    wish: Result<Json<OverrideWish>, JsonRejection>,
) -> Result<Response, Problem> {
    let Json(OverrideWish { points, reason }) = wish.map_err(super::body::other)?;
    let stored = judged(&service, &caller, &id).await?;
    let said = judgement::override_line(&service, &caller.0, &stored, &line, Some((points, &reason))).await?;
    Ok(noted(stored, said, StatusCode::NO_CONTENT))
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
    Ok(noted(stored, said, StatusCode::NO_CONTENT))
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
    wish: Result<Json<CommentWish>, JsonRejection>,
) -> Result<Response, Problem> {
    let Json(CommentWish { file, line, text }) = wish.map_err(super::body::other)?;
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

/// What a student asks to be looked at again.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct AppealJson {
    /// Its id.
    id: String,
    /// Id of the submission.
    submission: String,
    /// Student number, where it is known.
    student: Option<String>,
    /// Id of the line of the rubric.
    line: String,
    /// What they ask.
    question: String,
    /// When.
    #[schema(format = DateTime)]
    asked_at: String,
    /// When somebody began to handle it,
    #[schema(format = DateTime)]
    taken_at: Option<String>,
    /// and who; none for a program.
    handler: Option<String>,
    /// The answer,
    answer: Option<String>,
    /// and when it was given.
    #[schema(format = DateTime)]
    answered_at: Option<String>,
}

/// What the students of a homework ask.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct AppealsJson {
    /// What is not answered first.
    appeals: Vec<AppealJson>,
}

/// Requests for another look
///
/// Each student may ask once in a homework, about a line of the rubric.
#[utoipa::path(
    get, operation_id = "list_appeals", path = "/api/v1/appeals", tag = "submissions", security(("teacher" = [])),
    params(OfQuery),
    responses((status = 200, description = "What they ask", body = AppealsJson), NotFound, Refusals, Errors)
)]
pub(super) async fn appeals(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    of: Result<Query<OfQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(of) = of.map_err(super::body::other)?;
    let state = service.named(of.assignment.as_deref())?;
    teacher.check(&state.assignment.id)?;
    let json = |appeal: Appeal| AppealJson {
        id: appeal.id,
        submission: at(&format!("/api/v1/submissions/{}", appeal.submission_id)),
        student: appeal.number,
        line: appeal.line,
        question: appeal.question,
        asked_at: time(appeal.asked_at),
        taken_at: appeal.taken_at.map(time),
        handler: appeal.handler,
        answer: appeal.answer,
        answered_at: appeal.answered_at.map(time),
    };
    let appeals = state.store.appeals(&state.assignment.id).await?.into_iter().map(json).collect();
    Ok(unkept(AppealsJson { appeals }))
}

/// The answer to an appeal.
#[derive(Debug, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct AnswerWish {
    /// The student reads it.
    #[schema(min_length = 1, max_length = 2000)]
    answer: String,
}

/// Answer a request for another look
#[utoipa::path(
    put, operation_id = "answer_appeal", path = "/api/v1/appeals/{id}/answer", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the appeal")), request_body = AnswerWish,
    responses((status = 204, description = "Answered"), NotFound, Refusals, Errors)
)]
pub(super) async fn answer(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    wish: Result<Json<AnswerWish>, JsonRejection>,
) -> Result<Response, Problem> {
    let Json(AnswerWish { answer }) = wish.map_err(super::body::other)?;
    let appeal = service.store.appeal(&id).await?.ok_or_else(Problem::not_found)?;
    let stored = judged(&service, &caller, &appeal.submission_id).await?;
    handle(&service, &caller.0, &appeal, Handling::Answer(&answer)).await?;
    Ok(noted(stored, answer, StatusCode::NO_CONTENT))
}
