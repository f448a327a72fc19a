//! `/api/v1/platforms`: the learning platforms from which people come.

use super::body::unkept;
use super::caller::{Caller, check_course, check_reader};
use super::members::read;
use super::refusals::{Errors, NotFound, Refusals};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, new_id};
use crate::service::lti::known::{self, KnownPlatform};
use crate::service::lti::memberships::{self, FetchedRoster};
use crate::service::lti::{contexts, registration};
use crate::service::store::{Deployment, Platform, PlatformCourse, StaffRole};
use axum::Json;
use axum::extract::rejection::JsonRejection;
use axum::extract::{Path, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A learning platform.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct PlatformJson {
    /// Id.
    id: String,
    /// What people call it.
    name: String,
    /// Its name for itself.
    issuer: String,
    /// Its name for this service.
    client_id: String,
    /// Whether launches from it are taken.
    is_active: bool,
    /// Where the tool is deployed in it.
    deployments: Vec<DeploymentJson>,
    /// Its courses from which somebody came.
    courses: Vec<PlatformCourseJson>,
    /// How many scores have not arrived, and are sent again by themselves; of all courses where an administrator asks the first one.
    waiting_scores: i64,
    /// What it answered to one of these.
    problem: Option<String>,
}

/// A deployment.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct DeploymentJson {
    /// The platform's id of it.
    id: String,
    /// Whether launches from it are taken.
    is_approved: bool,
}

/// A course of a platform.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct PlatformCourseJson {
    /// The platform's id of it.
    context: String,
    /// What the platform calls it.
    title: String,
    /// Short name of the course here to which it belongs, `""` for the one with which the platform is registered; null: none.
    course: Option<String>,
}

/// The platforms.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct PlatformsJson {
    /// The oldest first.
    platforms: Vec<PlatformJson>,
}

/// A platform that is registered by hand.
#[derive(Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PlatformWish {
    /// What people call it.
    #[serde(default)]
    name: String,
    /// Its name for itself.
    issuer: String,
    /// Its name for this service.
    client_id: String,
    /// Where a launch goes to be vouched for.
    auth_url: String,
    /// Where tokens for its services are.
    token_url: String,
    /// Where its public keys are.
    keys_url: String,
    /// Who a request for a token is addressed to (`aud`), where that is not the address itself, as with Brightspace.
    #[serde(default)]
    token_audience: String,
    /// Id of a deployment.
    #[serde(default)]
    deployment: String,
}

/// A registration link.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct RegistrationJson {
    /// To be opened in the platform; it works once, for a day.
    link: String,
}

/// A change of a platform: of whatever is named.
#[derive(Default, Deserialize, utoipa::ToSchema)]
#[serde(default, deny_unknown_fields)]
pub(super) struct PlatformChange {
    /// Whether launches from it are taken.
    is_active: Option<bool>,
    /// Id of a deployment that is approved.
    approve_deployment: Option<String>,
}

/// To which course a platform's course belongs.
#[derive(Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ConnectionWish {
    /// The platform's id of its course.
    context: String,
    /// Short name of the course here, `""` for the one with which the platform is registered; null: none.
    course: Option<String>,
}

/// A roster that is fetched.
#[derive(Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FetchWish {
    /// The platform's id of its course.
    context: String,
}

fn json(known: KnownPlatform) -> PlatformJson {
    let KnownPlatform { platform, deployments, courses, stuck, .. } = known;
    let deployment = |one: Deployment| DeploymentJson { id: one.deployment_id, is_approved: one.is_approved != 0 };
    let course =
        |one: PlatformCourse| PlatformCourseJson { context: one.context, title: one.title, course: one.course };
    PlatformJson {
        deployments: deployments.into_iter().map(deployment).collect(),
        courses: courses.into_iter().map(course).collect(),
        waiting_scores: stuck.as_ref().map_or(0, |(count, _)| *count),
        problem: stuck.map(|(_, why)| why),
        is_active: platform.is_active != 0,
        id: platform.id,
        name: platform.name,
        issuer: platform.issuer,
        client_id: platform.client_id,
    }
}

/// A platform as it stands.
async fn standing(service: &Service, teacher: &Teacher, id: &str) -> Result<Json<PlatformJson>, Problem> {
    let known = known::platforms(service, teacher).await?.into_iter().find(|known| known.platform.id == id);
    Ok(Json(json(known.ok_or_else(Problem::not_found)?)))
}

/// A platform that is registered with this very course.
async fn own(service: &Service, id: &str) -> Result<Platform, Problem> {
    let platform = service.store.platform(id).await?.ok_or_else(Problem::not_found)?;
    if contexts::is_elsewheres(service, id).await? { Err(Problem::not_found()) } else { Ok(platform) }
}

/// The learning platforms
#[utoipa::path(
    get, operation_id = "list_platforms", path = "/api/v1/platforms", tag = "courses", security(("teacher" = [])),
    responses((status = 200, description = "The oldest first", body = PlatformsJson), Refusals, Errors)
)]
pub(super) async fn list(teacher: Teacher, Shared(service): Shared<Service>) -> Result<Response, Problem> {
    check_reader(&teacher, StaffRole::Lecturer)?;
    let platforms = known::platforms(&service, &teacher).await?.into_iter().map(json).collect();
    Ok(unkept(PlatformsJson { platforms }))
}

/// Register a platform by hand
///
/// Where it has no dynamic registration. One with the same issuer and client is replaced.
#[utoipa::path(
    post, operation_id = "add_platform", path = "/api/v1/platforms", tag = "courses", security(("teacher" = [])),
    request_body = PlatformWish,
    responses((status = 201, description = "It is known", body = PlatformJson), Refusals, Errors)
)]
pub(super) async fn add(
    caller: Caller,
    Shared(service): Shared<Service>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Administrator)?;
    let wish: PlatformWish = read(wish)?;
    let platform = Platform {
        id: new_id(),
        name: wish.name,
        issuer: wish.issuer,
        client_id: wish.client_id,
        auth_url: wish.auth_url,
        token_url: wish.token_url,
        keys_url: wish.keys_url,
        token_audience: registration::audience(&wish.token_audience),
        is_active: 1,
    };
    let platform = registration::keep(&service, platform, Some(wish.deployment.trim())).await?;
    let detail = Detail::of(format!("add {} {}", platform.issuer, wish.deployment));
    Ok(detail.on((StatusCode::CREATED, standing(&service, &caller.0, &platform.id).await?).into_response()))
}

/// Make a registration link
///
/// For a platform with dynamic registration. An earlier link opens nothing any more.
#[utoipa::path(
    post, operation_id = "make_registration_link", path = "/api/v1/platforms/registration", tag = "courses", security(("teacher" = [])),
    responses((status = 201, description = "The link", body = RegistrationJson), Refusals, Errors)
)]
pub(super) async fn register(caller: Caller, Shared(service): Shared<Service>) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Administrator)?;
    let link = registration::new_link(&service).await?;
    Ok(Detail::of("link").on((StatusCode::CREATED, Json(RegistrationJson { link })).into_response()))
}

/// Switch a platform on or off, or approve a deployment
#[utoipa::path(
    patch, operation_id = "change_platform", path = "/api/v1/platforms/{id}", tag = "courses", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the platform")),
    request_body = PlatformChange,
    responses((status = 200, description = "As it stands now", body = PlatformJson), NotFound, Refusals, Errors)
)]
pub(super) async fn change(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Administrator)?;
    let wish: PlatformChange = read(wish)?;
    let platform = own(&service, &id).await?;
    let mut said = platform.issuer.clone();
    if let Some(is_active) = wish.is_active {
        contexts::set_active(&service, &platform, is_active).await?;
        said += if is_active { " on" } else { " off" };
    }
    if let Some(deployment) = &wish.approve_deployment {
        service.store.note_deployment(&platform.id, deployment, true).await?;
        said += &format!(" approve {deployment}");
    }
    Ok(Detail::of(said).on(standing(&service, &caller.0, &id).await?.into_response()))
}

/// Connect a platform's course with a course here
///
/// Who comes from it comes into that course. What was linked from it to another course before is forgotten there.
#[utoipa::path(
    put, operation_id = "connect_platform_course", path = "/api/v1/platforms/{id}/courses", tag = "courses", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the platform")),
    request_body = ConnectionWish,
    responses((status = 200, description = "As it stands now", body = PlatformJson), NotFound, Refusals, Errors)
)]
pub(super) async fn connect(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Administrator)?;
    let wish: ConnectionWish = read(wish)?;
    let platform = own(&service, &id).await?;
    contexts::connect(&service, &platform, &wish.context, wish.course.as_deref()).await?;
    let course = wish.course.as_deref().unwrap_or("–");
    let detail = Detail::of(format!("connect {} {} {course}", platform.issuer, wish.context));
    Ok(detail.on(standing(&service, &caller.0, &id).await?.into_response()))
}

/// Fetch the roster of a platform's course
///
/// Its students are added to the roster; who stands on it already stays.
#[utoipa::path(
    post, operation_id = "fetch_roster", path = "/api/v1/platforms/{id}/roster", tag = "courses", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the platform")),
    request_body = FetchWish,
    responses((status = 200, description = "Fetched", body = FetchedRoster), NotFound, Refusals, Errors)
)]
pub(super) async fn fetch(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    let wish: FetchWish = read(wish)?;
    let platform = service.store.platform(&id).await?.ok_or_else(Problem::not_found)?;
    let links = service.store.links().await?;
    let link = links
        .into_iter()
        .find(|link| link.platform_id == platform.id && link.context == wish.context && link.memberships.is_some());
    let fetched = memberships::import(&service, &platform, &link.ok_or_else(Problem::not_found)?).await?;
    Ok(Detail::of(fetched.students.to_string()).on(Json(fetched).into_response()))
}
