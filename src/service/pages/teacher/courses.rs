//! The courses of the service: those that somebody may see; an administrator makes, copies and archives them.

use super::super::datetime::TimeElement;
use super::super::frame::PageFrame;
use super::super::shown;
use super::{refused, said_of};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::courses;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, TeacherPage};
use crate::service::store::StaffRole;
use askama::Template;
use axum::Form;
use axum::extract::State as Shared;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/courses.html")]
struct CoursesPage {
    frame: PageFrame,
    csrf: String,
    /// Of the course by which they log out: what its addresses begin with, and the token of its forms.
    way_out: (String, String),
    courses: Vec<CourseLine>,
    /// Whether it is an administrator, who makes courses.
    may_make: bool,
    typed: CourseForm,
    problem: Option<String>,
}

/// A course.
struct CourseLine {
    /// Id; empty of the first one.
    id: String,
    root: String,
    title: String,
    homeworks: usize,
    archived: Option<TimeElement>,
}

/// The forms of the page: `wish` is `make`, `copy`, `archive` or `open`.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct CourseForm {
    csrf: String,
    wish: String,
    /// The course that it is about; empty: the first one.
    of: String,
    id: String,
    title: String,
    /// Days by which dates are shifted in a copy; empty: the copy has no dates.
    days: String,
}

/// The course as its teachers know it.
async fn line(frame: &PageFrame, service: &Service) -> Result<CourseLine, Problem> {
    let id = service.course_id().unwrap_or_default().to_owned();
    let title = service.store.course().await?.title;
    let untitled = if id.is_empty() { frame.say("The first course", "最初の授業").to_owned() } else { id.clone() };
    Ok(CourseLine {
        title: if title.is_empty() { untitled } else { title },
        root: service.root().to_owned(),
        homeworks: service.ids().len(),
        archived: service.store.archived_at().await?.map(|at| frame.datetime(at)),
        id,
    })
}

async fn view(
    service: &Service,
    frame: PageFrame,
    headers: &HeaderMap,
    typed: CourseForm,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let (mut lines, mut way_out) = (Vec::new(), None);
    for course in service.everywhere() {
        if let Some(teacher) = Teacher::of(&course, headers).await? {
            way_out.get_or_insert_with(|| (course.root().to_owned(), teacher.csrf(&course)));
            lines.push(line(&frame, &course).await?);
        }
    }
    let Some(way_out) = way_out else { return Ok(Redirect::to("/teacher/login").into_response()) };
    let own = Teacher::of(service, headers).await?;
    let csrf = own.as_ref().map(|teacher| teacher.csrf(service)).unwrap_or_default();
    let may_make = own.is_some_and(|teacher| teacher.role() == StaffRole::Administrator && teacher.has_course());
    shown(CoursesPage { frame, csrf, way_out, courses: lines, may_make, typed, problem }.render())
}

/// `GET /teacher/courses`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    headers: HeaderMap,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view(&service, frame, &headers, CourseForm::default(), None).await
}

/// `POST /teacher/courses`.
pub(in crate::service::pages) async fn change(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    headers: HeaderMap,
    frame: PageFrame,
    Form(form): Form<CourseForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&service, &form.csrf)?;
    teacher.check_course()?;
    teacher.check_role(StaffRole::Administrator)?;
    let detail = Detail::of(format!("{} {} {}", form.wish, form.of, form.id));
    match done(&service, &form).await {
        Ok(page) => Ok(detail.on(Redirect::to(&page).into_response())),
        Err(problem) => {
            let said = Some(said_of(problem, &frame)?);
            Ok(refused(view(&service, frame, &headers, form, said).await?, StatusCode::UNPROCESSABLE_ENTITY))
        }
    }
}

/// Does what a form asks for, and says where to go on.
async fn done(service: &Service, form: &CourseForm) -> Result<String, Problem> {
    let of = || service.course_or_this(&form.of).ok_or_else(Problem::not_found);
    let to_plan = |course: &Service| format!("{}/teacher/plan", course.root());
    match form.wish.as_str() {
        "make" => Ok(to_plan(&courses::make(service, &form.id, &form.title).await?)),
        "copy" => {
            let days = match form.days.trim() {
                "" => None,
                days => Some(days.parse().map_err(|_| {
                    Problem::unprocessable(
                        "Days: a whole number, or nothing for a copy without dates.",
                        "日数は整数で入力してください。空欄にすると、日時のない授業になります。",
                    )
                })?),
            };
            Ok(to_plan(&courses::copy(service, &of()?, (&form.id, &form.title), days).await?))
        }
        "archive" | "open" => {
            let at = (form.wish == "archive").then(|| service.clock.now());
            of()?.store.set_archived(at).await?;
            Ok("/teacher/courses".to_owned())
        }
        _ => Err(Problem::unprocessable("There is no such change.", "その操作はありません。")),
    }
}
