//! Deleting: for teachers.

use super::batches::CSRF;
use super::schema::{Errors, NotFound, Refusals};
use crate::service::State;
use crate::service::deletion::delete;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, normal_number};
use crate::service::store::{Counts, Target};
use axum::Json;
use axum::extract::{Path, State as Shared};
use axum::http::HeaderMap;

/// Delete a file
///
/// With its report and its pictures, for good.
#[utoipa::path(
    delete, path = "/api/v1/submissions/{id}", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the submission")),
    responses((status = 200, description = "How much was deleted", body = Counts), NotFound, Refusals, Errors)
)]
pub(super) async fn delete_submission(
    teacher: Teacher,
    Shared(state): Shared<State>,
    Path(id): Path<String>,
    headers: HeaderMap,
) -> Result<Json<Counts>, Problem> {
    check(&state, &teacher, &headers)?;
    state.store.submission(&id).await?.ok_or_else(Problem::not_found)?;
    delete(&state, &Target::Submission(id)).await.map(Json)
}

/// Delete a class that was handed in
///
/// With all its files, their reports and their pictures, for good.
#[utoipa::path(
    delete, path = "/api/v1/batches/{id}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the batch")),
    responses((status = 200, description = "How much was deleted", body = Counts), NotFound, Refusals, Errors)
)]
pub(super) async fn delete_batch(
    teacher: Teacher,
    Shared(state): Shared<State>,
    Path(id): Path<String>,
    headers: HeaderMap,
) -> Result<Json<Counts>, Problem> {
    check(&state, &teacher, &headers)?;
    state.store.batch(&id).await?.ok_or_else(Problem::not_found)?;
    delete(&state, &Target::Batch(id)).await.map(Json)
}

/// Delete a student
///
/// With the line of the roster, every file, draft and report, the entries in archives, and the browsers that know the
/// number; for good.
#[utoipa::path(
    delete, path = "/api/v1/students/{number}", tag = "batches", security(("teacher" = [])),
    params(("number" = String, Path, description = "Student number")),
    responses((status = 200, description = "How much was deleted", body = Counts), NotFound, Refusals, Errors)
)]
pub(super) async fn delete_student(
    teacher: Teacher,
    Shared(state): Shared<State>,
    Path(number): Path<String>,
    headers: HeaderMap,
) -> Result<Json<Counts>, Problem> {
    check(&state, &teacher, &headers)?;
    let number = normal_number(&number).ok_or_else(Problem::not_found)?;
    let student = state.store.student_by_number(&number).await?.ok_or_else(Problem::not_found)?;
    delete(&state, &Target::Student(student.id)).await.map(Json)
}

/// A page's own script brings the token of its forms; a program brings the teacher's.
fn check(state: &State, teacher: &Teacher, headers: &HeaderMap) -> Result<(), Problem> {
    teacher.check_csrf(state, headers.get(CSRF).and_then(|value| value.to_str().ok()).unwrap_or_default())
}
