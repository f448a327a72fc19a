//! Everything of one student: for teachers.

use super::refusals::{Errors, NotFound, Refusals};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::download::saved;
use crate::service::errors::Problem;
use crate::service::export;
use crate::service::identity::{Teacher, normal_number};
use crate::service::store::StaffRole;
use axum::extract::{Path, State as Shared};
use axum::response::Response;

/// Everything that is kept of a student
///
/// A ZIP that opens without ggrade: `student.json` with who they are and whatever names them, and of each hand-in for all
/// homeworks the files and the report.
#[utoipa::path(
    get, operation_id = "export_student", path = "/api/v1/students/{number}/export", tag = "batches", security(("teacher" = [])),
    params(("number" = String, Path, description = "Student number")),
    responses(
        (status = 200, description = "The ZIP", body = Vec<u8>, content_type = "application/zip"), NotFound, Refusals, Errors
    )
)]
pub(super) async fn export_student(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Path(number): Path<String>,
) -> Result<Response, Problem> {
    teacher.check_role(StaffRole::Lecturer)?;
    teacher.check_course()?;
    let number = normal_number(&number).ok_or_else(Problem::not_found)?;
    let student = service.store.student_by_number(&number).await?.ok_or_else(Problem::not_found)?;
    let bytes = export::of_student(&service, &student).await?;
    Ok(Detail::about(&student.id).on(saved(&format!("{number}.zip"), "application/zip", bytes)))
}
