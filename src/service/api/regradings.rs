//! `/api/v1/regradings`: grading everything again, and what that would change.

use super::batches::OfQuery;
use super::body::{other, unkept};
use super::caller::{Caller, check};
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::time;
use crate::report::Verdict;
use crate::service::acts::Detail;
use crate::service::courses::at;
use crate::service::errors::{Problem, ProblemJson};
use crate::service::identity::Teacher;
use crate::service::regrade::{self, differs};
use crate::service::store::{Compared, LineAgain, OverriddenAgain, Progress, Regrading, StaffRole};
use crate::service::{Service, State};
use axum::Json;
use axum::extract::rejection::QueryRejection;
use axum::extract::{Path, Query, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};

/// A regrading.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct RegradingJson {
    /// Id.
    id: String,
    /// Id of the homework.
    assignment: String,
    /// When it began.
    #[schema(format = DateTime)]
    begun_at: String,
    /// How far it is.
    progress: Progress,
    /// When its results took the place of the reports; null: they have not.
    #[schema(format = DateTime)]
    adopted_at: Option<String>,
    /// What it changes, as far as it is.
    changes: Vec<ChangeJson>,
    /// Lines that somebody overrode, and that are graded otherwise now. The points that somebody gave stay, as the same share of a
    /// line whose maximum changes.
    overridden: Vec<OverriddenJson>,
}

/// A submission that is graded otherwise now.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct ChangeJson {
    /// Address of the submission.
    submission: String,
    /// Student number.
    student: Option<String>,
    /// As it stands.
    before: EarnedJson,
    /// As it is graded again.
    after: EarnedJson,
}

/// What a submission got.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct EarnedJson {
    /// The verdict.
    #[schema(inline)]
    verdict: Verdict,
    /// Points.
    score: f64,
    /// Ids of its mistakes.
    mistakes: Vec<String>,
}

/// A line that somebody overrode.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct OverriddenJson {
    /// Address of the submission.
    submission: String,
    /// Id of the line of the rubric.
    line: String,
    /// The points that somebody gave.
    points: f64,
    /// What the line gave at most then; null: nobody knows any more.
    max_points: Option<f64>,
    /// What the grading gave then,
    graded: f64,
    /// and gives now; null: there is no such line any more.
    graded_again: Option<f64>,
    /// What the line gives at most now.
    max_points_again: Option<f64>,
    /// The points when this is adopted: the same share of the line.
    points_again: Option<f64>,
}

/// How everything is to be graded again.
#[derive(Default, Deserialize, utoipa::IntoParams)]
#[serde(default)]
#[into_params(parameter_in = Query)]
pub(super) struct SeedQuery {
    /// Whether another seed is drawn for the fresh probes.
    new_seed: bool,
}

fn submission(id: &str) -> String {
    at(&format!("/api/v1/submissions/{id}"))
}

fn change(row: Compared) -> Option<ChangeJson> {
    let earned = |(verdict, score, mistakes)| EarnedJson { verdict, score, mistakes };
    let after = row.after.filter(|after| differs(&row.before, after))?;
    Some(ChangeJson {
        submission: submission(&row.submission.id),
        student: row.number,
        before: earned(row.before),
        after: earned(after),
    })
}

async fn json(state: &State, regrading: Regrading) -> Result<RegradingJson, Problem> {
    let overridden = state.store.overridden_again(&regrading.id).await?.into_iter();
    let line = |line: OverriddenAgain| OverriddenJson {
        points_again: line.points(),
        graded_again: line.again.map(|LineAgain { graded, .. }| graded),
        max_points_again: line.again.map(|LineAgain { most, .. }| most),
        submission: submission(&line.overridden.submission_id),
        line: line.overridden.line,
        points: line.overridden.points,
        max_points: line.overridden.most,
        graded: line.overridden.graded,
    };
    Ok(RegradingJson {
        progress: state.store.regrading_progress(&regrading.id).await?,
        changes: state.store.compared(&regrading.id).await?.into_iter().filter_map(change).collect(),
        overridden: overridden.filter(OverriddenAgain::is_changed).map(line).collect(),
        begun_at: time(regrading.created_at),
        adopted_at: regrading.adopted_at.map(time),
        id: regrading.id,
        assignment: regrading.assignment,
    })
}

/// The regrading with this id, and its homework.
async fn found(service: &Service, teacher: &Teacher, id: &str) -> Result<(State, Regrading), Problem> {
    let regrading = service.store.regrading(id).await?.ok_or_else(Problem::not_found)?;
    teacher.check(&regrading.assignment)?;
    Ok((service.homework_of(&regrading.assignment)?, regrading))
}

/// Grade everything again
///
/// In the background, behind all else; the reports stay what they are until the results are adopted.
#[utoipa::path(
    post, operation_id = "start_regrading", path = "/api/v1/regradings", tag = "batches", security(("teacher" = [])),
    params(OfQuery, SeedQuery),
    responses((status = 202, description = "It begins", body = RegradingJson), NotFound, Refusals, Errors)
)]
pub(super) async fn start(
    caller: Caller,
    Shared(service): Shared<Service>,
    of: Result<Query<OfQuery>, QueryRejection>,
    seed: Result<Query<SeedQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    check(&caller, &service, StaffRole::Lecturer)?;
    let (Query(of), Query(seed)) = (of.map_err(other)?, seed.map_err(other)?);
    let state = service.named(of.assignment.as_deref())?;
    caller.0.check(&state.assignment.id)?;
    let regrading = regrade::start(&state, seed.new_seed, None).await?;
    let detail = Detail { assignment: Some(regrading.assignment.clone()), ..Detail::default() };
    Ok(detail.on((StatusCode::ACCEPTED, Json(json(&state, regrading).await?)).into_response()))
}

/// How far a regrading is, and what it changes
#[utoipa::path(
    get, operation_id = "read_regrading", path = "/api/v1/regradings/{id}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the regrading")),
    responses((status = 200, description = "As it stands", body = RegradingJson), NotFound, Refusals, Errors)
)]
pub(super) async fn read(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    let (state, regrading) = found(&service, &teacher, &id).await?;
    Ok(unkept(json(&state, regrading).await?))
}

/// Let the results take the place of the reports
#[utoipa::path(
    post, operation_id = "adopt_regrading", path = "/api/v1/regradings/{id}/adoption", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the regrading")),
    responses(
        (status = 200, description = "They have", body = RegradingJson),
        (status = 409, description = "Not everything is graded again yet", body = ProblemJson, content_type = "application/problem+json"),
        NotFound, Refusals, Errors
    )
)]
pub(super) async fn adopt(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    check(&caller, &service, StaffRole::Lecturer)?;
    let (state, _) = found(&service, &caller.0, &id).await?;
    regrade::adopt(&state, &id).await?;
    let (state, regrading) = found(&service, &caller.0, &id).await?;
    let detail = Detail { assignment: Some(regrading.assignment.clone()), ..Detail::default() };
    Ok(detail.on(Json(json(&state, regrading).await?).into_response()))
}
