//! Students who ask for another look at a line of the rubric: for teachers.

use super::batches::OfQuery;
use super::body::unkept;
use super::caller::Caller;
use super::judgements::{judged, noted};
use super::members::read;
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::time;
use crate::service::Service;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::judgement::{Handling, handle};
use crate::service::store::Appeal;
use axum::Json;
use axum::extract::rejection::{JsonRejection, QueryRejection};
use axum::extract::{Path, Query, State as Shared};
use axum::http::StatusCode;
use axum::response::Response;
use serde::{Deserialize, Serialize};
use serde_json::Value;

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

impl AppealJson {
    pub(super) fn of(appeal: Appeal) -> Self {
        Self {
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
        }
    }
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
pub(super) async fn list(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    of: Result<Query<OfQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(of) = of.map_err(super::body::other)?;
    let state = service.named(of.assignment.as_deref())?;
    teacher.check(&state.assignment.id)?;
    let appeals = state.store.appeals(&state.assignment.id).await?.into_iter().map(AppealJson::of).collect();
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
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    let AnswerWish { answer } = read(wish)?;
    handled(&service, &caller, &id, Handling::Answer(&answer), &answer).await
}

/// Handle a request for another look
///
/// The student sees who does. Who handled it before does no more.
#[utoipa::path(
    put, operation_id = "take_appeal", path = "/api/v1/appeals/{id}/handler", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the appeal")),
    responses((status = 204, description = "The owner of the token handles it"), NotFound, Refusals, Errors)
)]
pub(super) async fn take(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    handled(&service, &caller, &id, Handling::Take, "take").await
}

/// Give a request for another look back
#[utoipa::path(
    delete, operation_id = "release_appeal", path = "/api/v1/appeals/{id}/handler", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the appeal")),
    responses((status = 204, description = "Nobody handles it"), NotFound, Refusals, Errors)
)]
pub(super) async fn release(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    handled(&service, &caller, &id, Handling::Release, "release").await
}

/// Does something about an appeal; `said` is what the log says of it.
async fn handled(
    service: &Service,
    caller: &Caller,
    id: &str,
    handling: Handling<'_>,
    said: &str,
) -> Result<Response, Problem> {
    let appeal = service.store.appeal(id).await?.ok_or_else(Problem::not_found)?;
    let stored = judged(service, caller, &appeal.submission_id).await?;
    handle(service, &caller.0, &appeal, handling).await?;
    Ok(noted(stored, said.to_owned(), StatusCode::NO_CONTENT))
}
