//! `/api/v1/gradebook` and `/api/v1/log`: what everybody has, and what was done.

use super::body::{other, unkept};
use super::caller::check_reader;
use super::refusals::{Errors, Refusals};
use super::schema::time;
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::gradebook::{Gradebook, GradebookPerson, HomeworkColumn};
use crate::service::identity::Teacher;
use crate::service::language::Lang;
use crate::service::store::{NamedAct, StaffRole};
use axum::extract::rejection::QueryRejection;
use axum::extract::{Query, State as Shared};
use axum::response::Response;
use serde::{Deserialize, Serialize};

/// The gradebook of a course.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct GradebookJson {
    /// The homeworks, in the order of the course.
    assignments: Vec<GradebookColumnJson>,
    /// Everybody of the class who has a student number, by it.
    students: Vec<GradebookLineJson>,
}

/// A homework of the gradebook.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct GradebookColumnJson {
    /// Id.
    id: String,
    /// Title.
    title: String,
    /// What it counts in the course.
    points: f64,
}

/// One student of the gradebook.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct GradebookLineJson {
    /// Student number.
    number: String,
    /// Name.
    name: String,
    /// Points in each homework; null where nothing is graded.
    points: Vec<Option<f64>>,
    /// Their sum.
    total: f64,
}

/// The gradebook
///
/// Of everybody the hand-in that counts of each homework, with what lateness takes off, in proportion to what the homework counts.
#[utoipa::path(
    get, operation_id = "read_gradebook", path = "/api/v1/gradebook", tag = "courses", security(("teacher" = [])),
    params(super::submissions::LangQuery),
    responses((status = 200, description = "As it stands", body = GradebookJson), Refusals, Errors)
)]
pub(super) async fn gradebook(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Lang(language): Lang,
) -> Result<Response, Problem> {
    check_reader(&teacher, StaffRole::Assistant)?;
    let book = Gradebook::of(&service, language).await?;
    let column = |HomeworkColumn { id, title, points }| GradebookColumnJson { id, title, points };
    let line = |line: GradebookPerson| GradebookLineJson {
        total: line.total(),
        number: line.number,
        name: line.name,
        points: line.points,
    };
    let json = GradebookJson {
        assignments: book.homeworks.into_iter().map(column).collect(),
        students: book.lines.into_iter().map(line).collect(),
    };
    Ok(unkept(json))
}

/// The log of what teachers did.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct LogJson {
    /// How many acts there are.
    total: usize,
    /// The newest first.
    acts: Vec<ActJson>,
}

/// What a teacher did.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct ActJson {
    /// When.
    #[schema(format = DateTime)]
    at: String,
    /// Login of who did it; null: a program or a person with a secret of the service.
    login: Option<String>,
    /// How they came in: `account`, `password` or `token`.
    way: String,
    /// What, in a word.
    act: String,
    /// Id of the homework that it was about.
    assignment: Option<String>,
    /// Number of the student whom it was about.
    student: Option<String>,
    /// More about it.
    detail: String,
}

/// Which part of the log.
#[derive(Deserialize, utoipa::IntoParams)]
#[serde(default)]
#[into_params(parameter_in = Query)]
pub(super) struct LogQuery {
    /// How many of the newest are left out.
    skip: usize,
    /// How many are told, at most 500.
    limit: usize,
}

/// Most acts that are told at once.
const MOST_ACTS: usize = 500;

impl Default for LogQuery {
    fn default() -> Self {
        Self { skip: 0, limit: MOST_ACTS }
    }
}

/// The log of what teachers did
#[utoipa::path(
    get, operation_id = "read_log", path = "/api/v1/log", tag = "courses", security(("teacher" = [])),
    params(LogQuery),
    responses((status = 200, description = "The newest first", body = LogJson), Refusals, Errors)
)]
pub(super) async fn log(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    part: Result<Query<LogQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    teacher.check_role(StaffRole::Lecturer)?;
    let Query(part) = part.map_err(other)?;
    let total = service.store.count_acts(teacher.homework()).await?;
    let acts = service.store.acts(teacher.homework(), part.skip, part.limit.min(MOST_ACTS)).await?;
    let act = |NamedAct { act, login, number }| ActJson {
        at: time(act.at),
        login,
        way: act.way,
        act: act.act,
        assignment: act.assignment,
        student: number,
        detail: act.detail,
    };
    let acts = acts.into_iter().map(act).collect();
    Ok(unkept(LogJson { total, acts }))
}
