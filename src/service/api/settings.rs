//! `/api/v1/assignments/{id}/settings`, and `/api/v1/plan`: what a lecturer sets for the homeworks of a course.

use super::body::{other, unkept};
use super::caller::{Caller, check, check_course};
use super::members::{self, patched};
use super::refusals::{Errors, NotFound, Refusals};
use crate::language::Text;
use crate::report::Hints;
use crate::service::acts::{Detail, changes};
use crate::service::clock::Millis;
use crate::service::counting::Counting;
use crate::service::courses;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::rules::{self, MINUTE};
use crate::service::store::{AssignmentSettings, Audience, CoursePlace, LateRules, LateSpan, StaffRole};
use crate::service::{Service, State};
use axum::Json;
use axum::extract::rejection::JsonRejection;
use axum::extract::{Path, State as Shared};
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// What a lecturer sets for a homework.
#[derive(Serialize, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SettingsJson {
    /// When handing in begins; null: at once.
    #[schema(value_type = Option<String>, format = DateTime)]
    opens_at: Option<Timestamp>,
    /// When it is due; null: never.
    #[schema(value_type = Option<String>, format = DateTime)]
    due_at: Option<Timestamp>,
    /// Minutes after the due date in which a hand-in is still in time.
    grace_minutes: f64,
    /// Until when late hand-ins are taken; null: none are.
    #[schema(value_type = Option<String>, format = DateTime)]
    late_until: Option<Timestamp>,
    /// Percent of all points that go for each `late_span` that has begun.
    late_percent: f64,
    /// The span.
    #[schema(inline)]
    late_span: LateSpan,
    /// What lateness leaves at least, in percent of all points.
    late_floor: f64,
    /// How often a student may hand in; null: as often as they like.
    attempts: Option<u64>,
    /// Which hand-in counts.
    #[schema(inline)]
    counting: Counting,
    /// The most that messages may help.
    #[schema(inline)]
    hints: Hints,
    /// Who may hand in: `open` anybody, `number` whoever is known as a student.
    #[schema(inline)]
    audience: Audience,
    /// Whether what is typed is still graded after the end.
    practice: bool,
    /// What it counts in the course; null: as many points as its rubric has.
    points: Option<f64>,
    /// Whether students do not see it.
    is_hidden: bool,
    /// From when on they see it; null: now.
    #[schema(value_type = Option<String>, format = DateTime)]
    shown_from: Option<Timestamp>,
}

/// The homeworks of a course, in its order.
#[derive(Serialize, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PlanJson {
    /// Ids of the homeworks that it has.
    assignments: Vec<String>,
    /// Ids of those that it can choose as well; not to be changed.
    #[serde(default)]
    offered: Vec<String>,
}

fn timestamp(at: Option<Millis>) -> Option<Timestamp> {
    at.and_then(|at| Timestamp::from_millisecond(at).ok())
}

impl SettingsJson {
    fn of(rules: &AssignmentSettings, place: &CoursePlace) -> Self {
        Self {
            opens_at: timestamp(rules.opens_at),
            due_at: timestamp(rules.closes_at),
            grace_minutes: rules.late.grace as f64 / MINUTE as f64,
            late_until: timestamp(rules.late.until),
            late_percent: rules.late.percent,
            late_span: rules.late.span,
            late_floor: rules.late.floor,
            attempts: rules.attempts,
            counting: rules.counting,
            hints: rules.hints,
            audience: rules.audience,
            practice: rules.practice,
            points: place.points,
            is_hidden: place.is_hidden != 0,
            shown_from: timestamp(place.shown_from),
        }
    }

    /// The same in the place of what is set.
    fn read(self, rules: AssignmentSettings, place: CoursePlace) -> Result<(AssignmentSettings, CoursePlace), Problem> {
        let millis = |at: Option<Timestamp>| at.map(Timestamp::as_millisecond);
        let rules = AssignmentSettings {
            opens_at: millis(self.opens_at),
            closes_at: millis(self.due_at),
            attempts: self.attempts,
            hints: self.hints,
            audience: self.audience,
            practice: self.practice,
            counting: self.counting,
            late: LateRules {
                grace: (self.grace_minutes * MINUTE as f64).round() as Millis,
                until: millis(self.late_until),
                percent: self.late_percent,
                span: self.late_span,
                floor: self.late_floor,
            },
            ..rules
        };
        let refused = |wrong: Text| Problem::unprocessable(wrong.en, wrong.ja);
        rules::check(&rules).map_err(refused)?;
        rules::check_date(millis(self.shown_from)).map_err(refused)?;
        let points = self.points.map(rules::check_points).transpose().map_err(refused)?;
        let shown_from = millis(self.shown_from).filter(|_| !self.is_hidden);
        let place = CoursePlace { points, is_hidden: i64::from(self.is_hidden), shown_from, ..place };
        Ok((rules, place))
    }
}

async fn standing(state: &State) -> Result<(AssignmentSettings, CoursePlace), Problem> {
    let id = &state.assignment.id;
    let place = state.store.places().await?.into_iter().find(|place| place.id == *id);
    Ok((state.store.assignment(id).await?, place.ok_or_else(Problem::not_found)?))
}

/// What is set for a homework
#[utoipa::path(
    get, operation_id = "read_settings", path = "/api/v1/assignments/{id}/settings", tag = "courses", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the homework")),
    responses((status = 200, description = "As it stands", body = SettingsJson), NotFound, Refusals, Errors)
)]
pub(super) async fn read(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    let state = service.homework_of(&id)?;
    teacher.check(&id)?;
    let (rules, place) = standing(&state).await?;
    let json = SettingsJson::of(&rules, &place);
    Ok(unkept(json))
}

/// Set something for a homework
///
/// Only the members of the object that are sent change (RFC 7396); null takes a date or a limit away.
#[utoipa::path(
    patch, operation_id = "change_settings", path = "/api/v1/assignments/{id}/settings", tag = "courses", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the homework")),
    request_body(content = Object, description = "Members of a `SettingsJson`"),
    responses((status = 200, description = "As it stands now", body = SettingsJson), NotFound, Refusals, Errors)
)]
pub(super) async fn change(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    patch: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check(&caller, &service, StaffRole::Lecturer)?;
    let state = service.homework_of(&id)?;
    caller.0.check(&id)?;
    let Json(patch) = patch.map_err(other)?;
    let zone = state.store.course().await?.zone().clone();
    let said = |rules: &AssignmentSettings, place: &CoursePlace| {
        [rules::described(rules, &zone).as_slice(), &rules::described_place(place, &zone)].concat()
    };
    let (rules, place) = standing(&state).await?;
    let before = said(&rules, &place);
    let (rules, place) = patched(&SettingsJson::of(&rules, &place), &patch)?.read(rules, place)?;
    state.store.set_assignment(&rules).await?;
    state.store.set_places(std::slice::from_ref(&place)).await?;
    let json = Json(SettingsJson::of(&rules, &place));
    Ok(Detail { assignment: Some(id), ..Detail::of(changes(&before, &said(&rules, &place))) }.on(json.into_response()))
}

fn plan_json(service: &Service) -> PlanJson {
    let assignments = service.ids();
    let offered = if service.is_beside() { service.offered() } else { &[] };
    let offered = offered.iter().map(|one| one.id.clone()).filter(|id| !assignments.contains(id));
    PlanJson { offered: offered.collect(), assignments }
}

/// The homeworks of the course, in its order
#[utoipa::path(
    get, operation_id = "read_plan", path = "/api/v1/plan", tag = "courses", security(("teacher" = [])),
    responses((status = 200, description = "As it stands", body = PlanJson), Refusals, Errors)
)]
pub(super) async fn plan(teacher: Teacher, Shared(service): Shared<Service>) -> Result<Response, Problem> {
    teacher.check_course()?;
    Ok(unkept(plan_json(&service)))
}

/// Choose and order the homeworks of the course
///
/// Another course than the first has those that are named, of what is offered. What is named there and has a folder must be among
/// them. What was handed in for a homework that is left out stays in the database.
#[utoipa::path(
    put, operation_id = "set_plan", path = "/api/v1/plan", tag = "courses", security(("teacher" = [])),
    request_body = PlanJson,
    responses((status = 200, description = "As it stands now", body = PlanJson), Refusals, Errors)
)]
pub(super) async fn set_plan(
    caller: Caller,
    Shared(service): Shared<Service>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    let wish: PlanJson = members::read(wish)?;
    let order = || [("order", service.ids().join(" "))];
    let before = order();
    courses::arrange(&service, &wish.assignments).await?;
    Ok(Detail::of(changes(&before, &order())).on(Json(plan_json(&service)).into_response()))
}
