//! `/api/v1/courses`, and `/api/v1/course`: the courses of the service, and what a course sets for all its homeworks.

use super::body::{other, unkept};
use super::caller::{Caller, check_course, check_reader};
use super::members::{self, patched};
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::time;
use crate::language::Language;
use crate::service::Service;
use crate::service::acts::{Detail, changes};
use crate::service::course::Course;
use crate::service::courses;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, course_link, renew_course_secret};
use crate::service::rules::on_or_off;
use crate::service::store::{StaffRole, word};
use axum::Json;
use axum::extract::State as Shared;
use axum::extract::rejection::JsonRejection;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A course of the service.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct CourseOfServiceJson {
    /// Its short name; null: the first course.
    id: Option<String>,
    /// What it is called.
    title: String,
    /// What its addresses begin with: nothing, or `/c/` and the short name.
    root: String,
    /// Ids of its homeworks, in its order.
    assignments: Vec<String>,
    /// When it was archived; null: it is not.
    #[schema(format = DateTime)]
    archived_at: Option<String>,
}

/// The courses.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct CoursesJson {
    /// The first one first.
    courses: Vec<CourseOfServiceJson>,
}

/// A course to be made.
#[derive(Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CourseWish {
    /// Its short name, which stands in addresses.
    #[schema(pattern = "^[a-z0-9][a-z0-9-]{0,31}$")]
    id: String,
    /// What it is called.
    #[serde(default)]
    title: String,
    /// Short name of the course that it is a copy of, `""` for the first one; null: it begins empty.
    #[serde(default)]
    copy_of: Option<String>,
    /// By how many days the dates of a copy are shifted; null: it has none.
    #[serde(default)]
    days: Option<i64>,
}

async fn of(service: &Service) -> Result<CourseOfServiceJson, Problem> {
    Ok(CourseOfServiceJson {
        id: service.course_id().map(str::to_owned),
        title: service.store.course().await?.title,
        root: service.root().to_owned(),
        assignments: service.ids(),
        archived_at: service.store.archived_at().await?.map(time),
    })
}

/// The courses of the service
///
/// Those of which one is a teacher. Asked of the first course only.
#[utoipa::path(
    get, operation_id = "list_courses", path = "/api/v1/courses", tag = "courses", security(("teacher" = [])),
    responses((status = 200, description = "Each with its homeworks", body = CoursesJson), NotFound, Refusals, Errors)
)]
pub(super) async fn list(
    teacher: Teacher,
    headers: HeaderMap,
    Shared(service): Shared<Service>,
) -> Result<Response, Problem> {
    only_first(&service)?;
    teacher.check_course()?;
    let mut courses = Vec::new();
    for course in service.everywhere() {
        if Teacher::of(&course, &headers).await?.is_some() {
            courses.push(of(&course).await?);
        }
    }
    Ok(unkept(CoursesJson { courses }))
}

/// Make a course
///
/// Empty, or with the homeworks, order, points, rules and folders of another one. For administrators, and asked of the first course
/// only.
#[utoipa::path(
    post, operation_id = "create_course", path = "/api/v1/courses", tag = "courses", security(("teacher" = [])),
    request_body = CourseWish,
    responses((status = 201, description = "It is there", body = CourseOfServiceJson), NotFound, Refusals, Errors)
)]
pub(super) async fn create(
    caller: Caller,
    Shared(service): Shared<Service>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    only_first(&service)?;
    check_course(&caller, &service, StaffRole::Administrator)?;
    let wish: CourseWish = members::read(wish)?;
    let made = match &wish.copy_of {
        None => courses::make(&service, &wish.id, &wish.title).await?,
        Some(from) => {
            let from = service.course_or_this(from).ok_or_else(Problem::not_found)?;
            courses::copy(&service, &from, (&wish.id, &wish.title), wish.days).await?
        }
    };
    let from = wish.copy_of.map(|from| format!(" = {from}")).unwrap_or_default();
    let detail = Detail::of(format!("make {}{from}", wish.id));
    Ok(detail.on((StatusCode::CREATED, Json(of(&made).await?)).into_response()))
}

/// Courses are made by way of the first one, where the accounts are.
fn only_first(service: &Service) -> Result<(), Problem> {
    if service.is_beside() { Err(Problem::not_found()) } else { Ok(()) }
}

/// What a course sets for all its homeworks.
#[derive(Serialize, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CourseJson {
    /// What it is called.
    title: String,
    /// Time zone of its dates, by its name in the tz database.
    zone: String,
    /// Language of what students read through other systems.
    #[schema(inline)]
    language: Language,
    /// Whether assistants read pseudonyms in place of names.
    pseudonyms: bool,
    /// Whether it is archived. Only an administrator changes that.
    is_archived: bool,
    /// The course link; not to be changed here. Null for a token of the scope `read` or `submit`.
    link: Option<String>,
}

impl CourseJson {
    /// In the words of the log of acts. The title is last: it says whatever somebody wrote.
    fn described(&self) -> [(&'static str, String); 5] {
        [
            ("zone", self.zone.clone()),
            ("language", word(&self.language)),
            ("pseudonyms", on_or_off(self.pseudonyms)),
            ("archived", on_or_off(self.is_archived)),
            ("title", self.title.clone()),
        ]
    }
}

async fn course_json(service: &Service, teacher: &Teacher, headers: &HeaderMap) -> Result<CourseJson, Problem> {
    let course = service.store.course().await?;
    Ok(CourseJson {
        zone: course.zone_name().to_owned(),
        language: course.language,
        title: course.title,
        pseudonyms: service.store.has_pseudonyms().await?,
        is_archived: service.store.archived_at().await?.is_some(),
        link: match teacher.sees_secrets() {
            true => Some(course_link(service, headers).await?),
            false => None,
        },
    })
}

/// What the course sets for all its homeworks
#[utoipa::path(
    get, operation_id = "read_course", path = "/api/v1/course", tag = "courses", security(("teacher" = [])),
    responses((status = 200, description = "As it stands", body = CourseJson), Refusals, Errors)
)]
pub(super) async fn read(
    teacher: Teacher,
    headers: HeaderMap,
    Shared(service): Shared<Service>,
) -> Result<Response, Problem> {
    check_reader(&teacher, StaffRole::Lecturer)?;
    let json = course_json(&service, &teacher, &headers).await?;
    Ok(unkept(json))
}

/// Change the course
///
/// Only the members of the object that are sent change (RFC 7396). Of an archived course only `is_archived` does.
#[utoipa::path(
    patch, operation_id = "change_course", path = "/api/v1/course", tag = "courses", security(("teacher" = [])),
    request_body(content = Object, description = "Members of a `CourseJson`"),
    responses((status = 200, description = "As it stands now", body = CourseJson), Refusals, Errors)
)]
pub(super) async fn change(
    caller: Caller,
    Shared(service): Shared<Service>,
    patch: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    let Json(patch) = patch.map_err(other)?;
    let before = course_json(&service, &caller.0, &caller.1).await?;
    let (was_archived, link, said) = (before.is_archived, before.link.clone(), before.described());
    let after: CourseJson = patched(&before, &patch)?;
    if after.is_archived != was_archived {
        caller.0.check_role(StaffRole::Administrator)?;
    }
    if was_archived && after.is_archived {
        return Err(courses::archived());
    }
    let course = Course::new(&after.zone, after.language).filter(|_| after.link == link).ok_or_else(|| {
        Problem::unprocessable(
            "`zone` is a name of the tz database, such as Asia/Tokyo, and `link` is changed by POST /api/v1/course/link.",
            "`zone` には Asia/Tokyo のような tz データベースの名前を指定してください。`link` は POST /api/v1/course/link で変更します。",
        )
    })?;
    service.store.set_course(&course.titled(&after.title)?).await?;
    service.store.set_pseudonyms(after.pseudonyms).await?;
    service.store.set_archived(after.is_archived.then(|| service.clock.now())).await?;
    let json = course_json(&service, &caller.0, &caller.1).await?;
    Ok(Detail::of(changes(&said, &json.described())).on(Json(json).into_response()))
}

/// Make a new course link
///
/// The old one opens nothing any more.
#[utoipa::path(
    post, operation_id = "renew_course_link", path = "/api/v1/course/link", tag = "courses", security(("teacher" = [])),
    responses((status = 200, description = "The course with its new link", body = CourseJson), Refusals, Errors)
)]
pub(super) async fn renew_link(caller: Caller, Shared(service): Shared<Service>) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    renew_course_secret(&service).await?;
    let json = course_json(&service, &caller.0, &caller.1).await?;
    Ok(Detail::default().on(Json(json).into_response()))
}
