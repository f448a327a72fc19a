//! `/api/v1/roster` and `/api/v1/codes`: who the class is, and by what each of them proves it.

use super::body::{other, unkept};
use super::caller::{Caller, check_course, check_reader};
use super::refusals::{Errors, NotFound, Refusals};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, course_link, normal_number, personal_code, personal_link};
use crate::service::roster::{self, RosterFile};
use crate::service::store::{StaffRole, StudentRecord};
use axum::Json;
use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, State as Shared};
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// Somebody of the roster.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct RosterStudentJson {
    /// Student number.
    number: String,
    /// Name; empty where it is not known.
    name: String,
    /// Group; empty where there is none.
    group: String,
    /// Mail address; empty where the roster says none.
    email: String,
    /// The number by which Moodle's files name them.
    moodle: Option<i64>,
}

/// The roster.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct RosterJson {
    /// By number; empty where there is no roster.
    students: Vec<RosterStudentJson>,
}

/// A roster that was taken.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct ImportedRosterJson {
    /// By number.
    students: Vec<RosterStudentJson>,
    /// How many of them have a group.
    with_group: usize,
    /// The names of the file's columns that were not taken.
    columns_left_aside: Vec<String>,
}

/// A student's personal code.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct CodeJson {
    /// Student number.
    number: String,
    /// Name.
    name: String,
    /// The code.
    code: String,
    /// A link that fills in number and code.
    link: String,
}

/// Everybody's code.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct CodesJson {
    /// By number.
    codes: Vec<CodeJson>,
}

async fn json(service: &Service) -> Result<RosterJson, Problem> {
    let student = |student: StudentRecord| RosterStudentJson {
        number: student.number,
        name: student.name,
        group: student.group_name,
        email: student.email,
        moodle: student.moodle,
    };
    Ok(RosterJson { students: service.store.roster().await?.into_iter().map(student).collect() })
}

/// The roster
#[utoipa::path(
    get, operation_id = "read_roster", path = "/api/v1/roster", tag = "courses", security(("teacher" = [])),
    responses((status = 200, description = "By number", body = RosterJson), Refusals, Errors)
)]
pub(super) async fn read(teacher: Teacher, Shared(service): Shared<Service>) -> Result<Response, Problem> {
    check_reader(&teacher, StaffRole::Assistant)?;
    Ok(unkept(json(&service).await?))
}

/// Take a roster in the place of the last one
///
/// A CSV file as a spreadsheet or Moodle saves it, in UTF-8 or Shift_JIS. A file with a mistake in it changes nothing.
#[utoipa::path(
    put, operation_id = "set_roster", path = "/api/v1/roster", tag = "courses", security(("teacher" = [])),
    request_body(content = String, content_type = "text/csv"),
    responses((status = 200, description = "As it stands now", body = ImportedRosterJson), Refusals, Errors)
)]
pub(super) async fn set(
    caller: Caller,
    Shared(service): Shared<Service>,
    file: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    let RosterFile { lines, left_aside } = roster::read(&file.map_err(other)?)?;
    roster::import(&service, &lines).await?;
    let RosterJson { students } = json(&service).await?;
    let with_group = students.iter().filter(|student| !student.group.is_empty()).count();
    let imported = ImportedRosterJson { students, with_group, columns_left_aside: left_aside };
    Ok(Detail::of(lines.len().to_string()).on(Json(imported).into_response()))
}

fn code(service: &Service, course_link: &str, student: StudentRecord) -> CodeJson {
    let code = personal_code(service, &student);
    let link = personal_link(course_link, &student, &code);
    CodeJson { number: student.number, name: student.name, code, link }
}

/// The students' personal codes
///
/// A token must have the scope `all`.
#[utoipa::path(
    get, operation_id = "list_codes", path = "/api/v1/codes", tag = "courses", security(("teacher" = [])),
    responses((status = 200, description = "Of the roster; without one of whoever gave a number", body = CodesJson), Refusals, Errors)
)]
pub(super) async fn codes(
    teacher: Teacher,
    headers: HeaderMap,
    Shared(service): Shared<Service>,
) -> Result<Response, Problem> {
    check_reader(&teacher, StaffRole::Lecturer)?;
    let link = course_link(&service, &headers).await?;
    let students = service.store.with_codes().await?;
    let codes = students.into_iter().map(|student| code(&service, &link, student)).collect();
    Ok(unkept(CodesJson { codes }))
}

/// Replace a student's code
///
/// Browsers that are bound by the old one are theirs no more.
#[utoipa::path(
    post, operation_id = "renew_code", path = "/api/v1/codes/{number}", tag = "courses", security(("teacher" = [])),
    params(("number" = String, Path, description = "Student number")),
    responses((status = 200, description = "The new code", body = CodeJson), NotFound, Refusals, Errors)
)]
pub(super) async fn renew(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(number): Path<String>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    let number = normal_number(&number).ok_or_else(Problem::not_found)?;
    let student = service.store.student_by_number(&number).await?.ok_or_else(Problem::not_found)?;
    service.store.renew_code(&student.id).await?;
    let student = service.store.student_by_id(&student.id).await?.ok_or_else(Problem::not_found)?;
    let detail = Detail::about(&student.id);
    let json = code(&service, &course_link(&service, &caller.1).await?, student);
    Ok(detail.on(Json(json).into_response()))
}
