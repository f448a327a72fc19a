//! The students' personal codes: to be handed out, and replaced where one is lost.

use super::super::frame::PageFrame;
use super::super::shown;
use super::Tab;
use crate::class::formats::plain::cell;
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::download;
use crate::service::errors::Problem;
use crate::service::identity::{LecturerPage, course_link, personal_code, personal_link};
use crate::service::store::StudentRecord;
use askama::Template;
use axum::Form;
use axum::extract::{Query, State as Shared};
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/codes.html")]
struct CodesPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    has_roster: bool,
    students: Vec<(StudentRecord, String)>,
    /// Number of the student whose code was replaced.
    renewed: String,
}

/// A code that is to be replaced.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct LostCodeForm {
    csrf: String,
    student: String,
}

/// What has just been done.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct CodesQuery {
    renewed: String,
}

/// `GET /teacher/codes`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Query(CodesQuery { renewed }): Query<CodesQuery>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    let (has_roster, students) = (service.store.has_roster().await?, service.store.with_codes().await?);
    let with_code = |student: StudentRecord| {
        let code = personal_code(&service, &student);
        (student, code)
    };
    let students = students.into_iter().map(with_code).collect();
    let csrf = teacher.csrf(&service);
    shown(CodesPage { frame, place: Tab::Codes, csrf, has_roster, students, renewed }.render())
}

/// `POST /teacher/codes`: replaces a student's code; browsers that are bound by the old one are theirs no more.
pub(in crate::service::pages) async fn renew(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Form(lost): Form<LostCodeForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&service, &lost.csrf)?;
    teacher.check_course()?;
    let student = service.store.student_by_id(&lost.student).await?.ok_or_else(Problem::not_found)?;
    service.store.renew_code(&student.id).await?;
    let answer = Redirect::to(&format!("/teacher/codes?renewed={}", student.number)).into_response();
    Ok(Detail::about(&student.id).on(answer))
}

/// `GET /teacher/codes/file`: a CSV file for mails and slips of paper. Each link fills in its student's number and code.
pub(in crate::service::pages) async fn file(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    headers: HeaderMap,
    frame: PageFrame,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    let course_link = course_link(&service, &headers).await?;
    let heading = match frame.tag() {
        "ja" => ["学籍番号", "氏名", "個人コード", "リンク"],
        _ => ["Student number", "Name", "Personal code", "Link"],
    };
    let row = |student: StudentRecord| {
        let code = personal_code(&service, &student);
        let link = personal_link(&course_link, &student, &code);
        [cell(&student.number), cell(&student.name), code, link]
    };
    let rows = service.store.with_codes().await?.into_iter().map(row);
    download::table("personal-codes.csv", std::iter::once(heading.map(str::to_owned)).chain(rows))
}
