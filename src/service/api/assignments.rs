//! `/api/v1/assignments`: the homeworks of the service.

use super::body::unkept;
use super::refusals::Errors;
use super::schema::time;
use crate::language::Language;
use crate::service::counting::Counting;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::language::Lang;
use crate::service::store::{AssignmentSettings, LateSpan};
use crate::service::{Service, State};
use axum::extract::State as Shared;
use axum::response::Response;
use serde::Serialize;

/// A homework that the service takes files for.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct AssignmentJson {
    /// Its id: what `assignment` takes.
    id: String,
    /// The digest of its folder: a homework that was changed has another.
    digest: String,
    /// Its title, in the language of the request.
    title: String,
    /// The names of its files, in order.
    files: Vec<String>,
    /// When handing in begins, where that is set.
    #[schema(format = DateTime)]
    opens_at: Option<String>,
    /// When it is due for the class; whoever hands in later is late once `grace_minutes` are over.
    #[schema(format = DateTime)]
    due_at: Option<String>,
    /// How long after that a hand-in is still in time.
    grace_minutes: f64,
    /// When handing in ends, late hand-ins included.
    #[schema(format = DateTime)]
    ends_at: Option<String>,
    /// Percent of all points that a late hand-in loses for each `late_span` that has begun since the due date,
    late_percent: f64,
    /// `day` or `hour`,
    late_span: LateSpan,
    /// and what that leaves at least, in percent of all points.
    late_floor: f64,
    /// How often one student may hand in.
    attempts: Option<u64>,
    /// Which of a student's submissions counts: the `best`, the `last`, or the one that is `chosen`.
    counting: Counting,
    /// Where else to look.
    links: AssignmentLinks,
}

impl AssignmentJson {
    fn of(state: &State, rules: &AssignmentSettings, language: Language) -> Self {
        Self {
            id: state.assignment.id.clone(),
            digest: state.assignment.digest.clone(),
            title: language.of(&state.assignment.title).to_owned(),
            files: state.assignment.files.iter().map(|file| file.name.clone()).collect(),
            opens_at: rules.opens_at.map(time),
            due_at: rules.closes_at.map(time),
            grace_minutes: rules.late.grace as f64 / 60_000.0,
            ends_at: rules.ends_at().map(time),
            late_percent: rules.late.percent,
            late_span: rules.late.span,
            late_floor: rules.late.floor,
            attempts: rules.attempts,
            counting: rules.counting,
            links: AssignmentLinks { page: state.page(), starter: format!("{}/starter", state.page()) },
        }
    }
}

/// Addresses of one homework.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct AssignmentLinks {
    /// The student's page.
    page: String,
    /// The handed-out file; several as a ZIP, and each by itself with `?file=` and its name.
    starter: String,
}

/// The homeworks of the service.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct AssignmentsJson {
    /// In the order of the course. Those that students do not see yet are there for their teachers only.
    assignments: Vec<AssignmentJson>,
}

/// The homeworks of the course
#[utoipa::path(
    get, operation_id = "list_assignments", path = "/api/v1/assignments", tag = "submissions",
    params(super::submissions::LangQuery),
    responses((status = 200, description = "Each with its id", body = AssignmentsJson), Errors)
)]
pub(super) async fn list(
    Shared(service): Shared<Service>,
    teacher: Option<Teacher>,
    Lang(language): Lang,
) -> Result<Response, Problem> {
    let mut assignments = Vec::new();
    for state in service.homeworks() {
        let rules = state.store.assignment(&state.assignment.id).await?;
        let is_theirs = teacher.as_ref().is_some_and(|teacher| teacher.may_see(&rules.id));
        if !rules.is_shown(service.clock.now()) && !is_theirs {
            continue;
        }
        assignments.push(AssignmentJson::of(&state, &rules, language));
    }
    Ok(unkept(AssignmentsJson { assignments }))
}
