//! What students do by a program with what they handed in: they let it count, and ask for another look.

use super::appeals::AppealJson;
use super::body::{other, unkept};
use super::caller::check;
use super::members::read;
use super::refusals::{Errors, NotFound, Refusals};
use super::submissions::with_course;
use crate::service::acts::Detail;
use crate::service::counting;
use crate::service::errors::{Problem, ProblemJson};
use crate::service::identity::{Identity, Teacher, Visitor, is_own_page};
use crate::service::judgement::{self, asker};
use crate::service::store::{StaffRole, Submission};
use crate::service::{Service, State};
use axum::Json;
use axum::extract::rejection::{JsonRejection, QueryRejection};
use axum::extract::{Path, Query, State as Shared};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::Value;

/// Which student asks.
#[derive(Clone, Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(default)]
#[into_params(parameter_in = Query)]
pub(super) struct StudentQuery {
    /// Number of the student, with `course` and `code`; without it, it is whose browser it is.
    #[param(pattern = "^[A-Za-z0-9._-]{1,32}$")]
    student: Option<String>,
    /// Secret of the course link.
    course: Option<String>,
    /// Personal code of the student.
    code: Option<String>,
}

impl StudentQuery {
    /// Who that is.
    async fn identity(&self, state: &State, visitor: Visitor, headers: &HeaderMap) -> Result<Identity, Problem> {
        let code = self.code.as_deref().unwrap_or_default();
        match &self.student {
            Some(number) => with_course(state, number, self.course.as_deref().unwrap_or_default(), code).await,
            None if is_own_page(state, headers) => Ok(visitor.identity),
            None => Ok(Identity::Nobody),
        }
    }
}

/// Let a submission count
///
/// Of homeworks in which the one counts that is chosen (409 in others); the latest choice holds. A student chooses among their own
/// until handing in ends, a lecturer at any time.
#[utoipa::path(
    post, operation_id = "choose_submission", path = "/api/v1/submissions/{id}/choice", tag = "submissions", security((), ("teacher" = [])),
    params(("id" = String, Path, description = "Id of the submission"), StudentQuery),
    responses((status = 204, description = "It counts"), (status = 409, description = "Nobody chooses in this homework", body = ProblemJson, content_type = "application/problem+json"), NotFound, Refusals, Errors)
)]
pub(super) async fn choose(
    Shared(service): Shared<Service>,
    teacher: Option<Teacher>,
    visitor: Visitor,
    headers: HeaderMap,
    Path(id): Path<String>,
    who: Result<Query<StudentQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(who) = who.map_err(other)?;
    let (state, submission) = service.submission(&id).await?;
    if let Some(teacher) = teacher.filter(|_| who.student.is_none()) {
        return choose_for(&state, (teacher, headers), submission).await;
    }
    let identity = who.identity(&state, visitor, &headers).await?;
    counting::choose_own(&state, &identity, &submission).await?;
    Ok(StatusCode::NO_CONTENT.into_response())
}

async fn choose_for(state: &State, caller: (Teacher, HeaderMap), submission: Submission) -> Result<Response, Problem> {
    check(&caller, state, StaffRole::Lecturer)?;
    caller.0.check(&submission.assignment)?;
    counting::choose(state, &submission).await?;
    let assignment = Some(submission.assignment);
    let detail = Detail { assignment, student_id: submission.student_id, ..Detail::default() };
    Ok(detail.on(StatusCode::NO_CONTENT.into_response()))
}

/// What a student asks about a line of the rubric.
#[derive(Debug, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct QuestionWish {
    /// Id of the line.
    line: String,
    /// Why another look is due.
    #[schema(min_length = 1, max_length = 2000)]
    question: String,
}

/// Ask for another look
///
/// About a line of the rubric of one's own submission; once in a homework (409).
#[utoipa::path(
    post, operation_id = "ask", path = "/api/v1/submissions/{id}/appeal", tag = "submissions", security(()),
    params(("id" = String, Path, description = "Id of the submission"), StudentQuery), request_body = QuestionWish,
    responses((status = 201, description = "Asked", body = AppealJson), (status = 409, description = "They have asked before", body = ProblemJson, content_type = "application/problem+json"), NotFound, Refusals, Errors)
)]
pub(super) async fn ask(
    Shared(service): Shared<Service>,
    visitor: Visitor,
    headers: HeaderMap,
    Path(id): Path<String>,
    who: Result<Query<StudentQuery>, QueryRejection>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    let Query(who) = who.map_err(other)?;
    let QuestionWish { line, question } = read(wish)?;
    let (state, stored) = service.stored(&id).await?;
    let identity = who.identity(&state, visitor, &headers).await?;
    let appeal = judgement::ask(&state, &identity, &stored, &line, &question).await?;
    Ok((StatusCode::CREATED, Json(AppealJson::of(appeal))).into_response())
}

/// What was asked, and how far it is
#[utoipa::path(
    get, operation_id = "read_appeal", path = "/api/v1/submissions/{id}/appeal", tag = "submissions", security(()),
    params(("id" = String, Path, description = "Id of the submission"), StudentQuery),
    responses((status = 200, description = "What its student asked about it", body = AppealJson), NotFound, Refusals, Errors)
)]
pub(super) async fn asked(
    Shared(service): Shared<Service>,
    visitor: Visitor,
    headers: HeaderMap,
    Path(id): Path<String>,
    who: Result<Query<StudentQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(who) = who.map_err(other)?;
    let (state, submission) = service.submission(&id).await?;
    let identity = who.identity(&state, visitor, &headers).await?;
    let asker = asker(&submission).filter(|_| identity.has_handed_in(&submission)).ok_or_else(Problem::not_found)?;
    let appeal = state.store.appeal_of(&submission.assignment, asker).await?;
    let appeal = appeal.filter(|appeal| appeal.submission_id == submission.id).ok_or_else(Problem::not_found)?;
    Ok(unkept(AppealJson::of(appeal)))
}
