//! `/api/v1/staff`: who teaches in a course.

use super::body::{other, unkept};
use super::caller::{Caller, check_course, check_reader};
use super::members::{patched, read};
use super::refusals::{Errors, NotFound, Refusals};
use crate::service::Service;
use crate::service::acts::{Detail, changes};
use crate::service::errors::Problem;
use crate::service::identity::{self, Teacher, check_may_manage};
use crate::service::rules::on_or_off;
use crate::service::store::{StaffMember, StaffRole, word};
use axum::Json;
use axum::extract::rejection::JsonRejection;
use axum::extract::{Path, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Somebody who teaches.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct StaffMemberJson {
    /// Id.
    id: String,
    /// The name by which they log in.
    login: String,
    /// Their name.
    name: String,
    /// What they may do.
    #[schema(inline)]
    role: StaffRole,
    /// Whether they have chosen a password.
    has_password: bool,
    /// Whether they may log in.
    is_active: bool,
    /// The link by which they choose a password, where one was just made: it works once, for a week.
    link: Option<String>,
}

/// Everybody who teaches.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct StaffJson {
    /// By login.
    staff: Vec<StaffMemberJson>,
}

/// Somebody who is to be let in.
#[derive(Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct StaffWish {
    /// The name by which they log in.
    login: String,
    /// Their name.
    #[serde(default)]
    name: String,
    /// `assistant` or `lecturer`.
    #[schema(inline)]
    role: StaffRole,
}

/// What of an account can be changed.
#[derive(Serialize, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct StaffChange {
    /// `assistant` or `lecturer`.
    #[schema(inline)]
    role: StaffRole,
    /// Whether they may log in.
    is_active: bool,
}

fn json(member: StaffMember, link: Option<String>) -> StaffMemberJson {
    let StaffMember { id, login, name, role, has_password, is_active } = member;
    StaffMemberJson { id, login, name, role, has_password, is_active, link }
}

/// A program that leaks must not leave an administrator behind.
fn no_administrator(role: StaffRole) -> Result<(), Problem> {
    if role < StaffRole::Administrator {
        return Ok(());
    }
    Err(Problem::new(
        StatusCode::FORBIDDEN,
        "role",
        "Administrators are let in and changed on the page of the staff, by a person.",
        "管理者の追加と変更は、担当者ページで行ってください。",
    ))
}

/// Everybody who teaches in the course
#[utoipa::path(
    get, operation_id = "list_staff", path = "/api/v1/staff", tag = "courses", security(("teacher" = [])),
    responses((status = 200, description = "By login", body = StaffJson), Refusals, Errors)
)]
pub(super) async fn list(teacher: Teacher, Shared(service): Shared<Service>) -> Result<Response, Problem> {
    check_reader(&teacher, StaffRole::Lecturer)?;
    let staff = identity::people(&service).await?.into_iter().map(|member| json(member, None)).collect();
    Ok(unkept(StaffJson { staff }))
}

/// Let somebody in
///
/// As an assistant or a lecturer. Whoever has no account gets one, and a link by which they choose a password.
#[utoipa::path(
    post, operation_id = "add_staff", path = "/api/v1/staff", tag = "courses", security(("teacher" = [])),
    request_body = StaffWish,
    responses((status = 201, description = "They are in", body = StaffMemberJson), Refusals, Errors)
)]
pub(super) async fn add(
    caller: Caller,
    Shared(service): Shared<Service>,
    wish: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    let wish: StaffWish = read(wish)?;
    no_administrator(wish.role)?;
    check_may_manage(&caller.0, wish.role)?;
    let (member, secret) = identity::let_in(&service, &caller.0, (&wish.login, &wish.name), wish.role).await?;
    let detail = Detail::of(format!("{} {}", member.login, word(&member.role)));
    let link = secret.map(|secret| identity::invitation_link(&service, &caller.1, &secret));
    Ok(detail.on((StatusCode::CREATED, Json(json(member, link))).into_response()))
}

/// Change what somebody may do
///
/// Only the members of the object that are sent change. Closing an account ends its sessions and tokens at once.
#[utoipa::path(
    patch, operation_id = "change_staff", path = "/api/v1/staff/{id}", tag = "courses", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the account")),
    request_body(content = Object, description = "Members of a `StaffChange`"),
    responses((status = 200, description = "As it stands now", body = StaffMemberJson), NotFound, Refusals, Errors)
)]
pub(super) async fn change(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    patch: Result<Json<Value>, JsonRejection>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    let Json(patch) = patch.map_err(other)?;
    let member = service.store.course_member(&id).await?.ok_or_else(Problem::not_found)?;
    let StaffChange { role, is_active } =
        patched(&StaffChange { role: member.role, is_active: member.is_active }, &patch)?;
    for role in [member.role, role] {
        no_administrator(role)?;
        check_may_manage(&caller.0, role)?;
    }
    identity::set_staff(&service, &member, role, is_active).await?;
    let said = |role: StaffRole, is_active: bool| [("role", word(&role)), ("login", on_or_off(is_active))];
    let changes = changes(&said(member.role, member.is_active), &said(role, is_active));
    let detail = Detail::of(format!("{} {changes}", member.login));
    Ok(detail.on(Json(json(StaffMember { role, is_active, ..member }, None)).into_response()))
}

/// Give somebody a new link
///
/// To choose a password by, where they have none yet; who has one gets a link from a person, on the page of the staff (403).
#[utoipa::path(
    post, operation_id = "invite_staff", path = "/api/v1/staff/{id}/invitation", tag = "courses", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the account")),
    responses((status = 200, description = "With the link", body = StaffMemberJson), NotFound, Refusals, Errors)
)]
pub(super) async fn invite(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    check_course(&caller, &service, StaffRole::Lecturer)?;
    let people = identity::people(&service).await?;
    let member = people.into_iter().find(|member| member.id == id).ok_or_else(Problem::not_found)?;
    check_may_manage(&caller.0, member.role)?;
    no_administrator(if member.has_password { StaffRole::Administrator } else { member.role })?;
    identity::check_may_invite(&service, &caller.0).await?;
    let secret = identity::invite(&service, &member).await?;
    let link = identity::invitation_link(&service, &caller.1, &secret);
    Ok(Detail::of(format!("{} link", member.login)).on(Json(json(member, Some(link))).into_response()))
}
