//! Deleting: for teachers.

use super::caller::{Caller, check};
use super::refusals::{Errors, NotFound, Refusals};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::deletion;
use crate::service::errors::Problem;
use crate::service::identity::normal_number;
use crate::service::store::{Counts, DeletionTarget, StaffRole};
use axum::Json;
use axum::extract::{Path, State as Shared};
use axum::response::{IntoResponse, Response};

/// What an address names.
enum NamedRecord {
    /// A file, by its id.
    Submission(String),
    /// A class that was handed in, by its id.
    Batch(String),
    /// A student, by their number.
    Student(String),
}

/// Delete a file
///
/// With its report and its pictures, for good.
#[utoipa::path(
    delete, path = "/api/v1/submissions/{id}", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the submission")),
    responses((status = 200, description = "How much was deleted", body = Counts), NotFound, Refusals, Errors)
)]
pub(super) async fn delete_submission(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    deleted(&service, &caller, NamedRecord::Submission(id)).await
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
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    deleted(&service, &caller, NamedRecord::Batch(id)).await
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
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(number): Path<String>,
) -> Result<Response, Problem> {
    deleted(&service, &caller, NamedRecord::Student(number)).await
}

/// Deletes what is there under that name. A page's own script brings the token of its forms; a program brings the
/// teacher's.
async fn deleted(service: &Service, caller: &Caller, named: NamedRecord) -> Result<Response, Problem> {
    // Before anything is looked for: what is found would tell an assistant who reads pseudonyms whom there is.
    check(caller, service, StaffRole::Lecturer)?;
    let teacher = &caller.0;
    let store = &service.store;
    let found = match named {
        NamedRecord::Submission(id) => {
            let found = store.submission(&id).await?;
            found.map(|found| (DeletionTarget::Submission(found.id), Some(found.assignment)))
        }
        NamedRecord::Batch(id) => {
            let found = store.batch(&id).await?;
            found.map(|found| (DeletionTarget::Batch(found.id), Some(found.assignment)))
        }
        NamedRecord::Student(number) => match normal_number(&number) {
            Some(number) => {
                let found = store.student_by_number(&number).await?;
                found.map(|found| (DeletionTarget::Student(found.id), None))
            }
            None => None,
        },
    };
    let (target, assignment) = found.ok_or_else(Problem::not_found)?;
    if let Some(assignment) = &assignment {
        teacher.check(assignment)?;
    }
    teacher.may_delete(&target)?;
    let counts = deletion::delete(service, &target).await?;
    let detail = Detail { assignment, ..deletion::detail(&target, &counts) };
    Ok(detail.on(Json(counts).into_response()))
}
