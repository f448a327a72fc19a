//! Who teaches: accounts, what they may do, and links by which they choose a password.

use super::super::frame::PageFrame;
use super::super::shown;
use super::{Tab, refused, said_of};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::errors::Problem;
use crate::service::identity::{self, LecturerPage, Teacher, check_may_manage};
use crate::service::store::{StaffMember, StaffRole};
use askama::Template;
use axum::Form;
use axum::extract::{Path, State as Shared};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/people.html")]
struct PeoplePage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    people: Vec<MemberLine>,
    /// The roles that this teacher may give.
    roles: Vec<(&'static str, &'static str)>,
    /// Whether nobody has an account yet.
    is_first: bool,
    /// Whether this teacher may give others a new link.
    may_invite: bool,
    typed: NewMember,
    problem: Option<String>,
    /// A link that was just made: for whom, and the address.
    link: Option<(String, String)>,
}

/// Somebody of the list.
struct MemberLine {
    member: StaffMember,
    role: &'static str,
    standing: &'static str,
    /// Whether this teacher may change anything of theirs.
    may_change: bool,
}

/// The form of a new account.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct NewMember {
    csrf: String,
    login: String,
    name: String,
    role: String,
}

/// A change of an account: `link`, `close`, `open`, or the name of a role.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct AccountChange {
    csrf: String,
    change: String,
}

/// The role of a word in a form.
fn role(word: &str) -> Option<StaffRole> {
    [StaffRole::Administrator, StaffRole::Lecturer, StaffRole::Assistant].into_iter().find(|role| id(*role) == word)
}

fn id(role: StaffRole) -> &'static str {
    match role {
        StaffRole::Administrator => "administrator",
        StaffRole::Lecturer => "lecturer",
        StaffRole::Assistant => "assistant",
    }
}

/// What a role is called.
pub(super) fn role_name(frame: &PageFrame, role: StaffRole) -> &'static str {
    match role {
        StaffRole::Administrator => frame.say("Administrator", "管理者"),
        StaffRole::Lecturer => frame.say("Lecturer", "担当教員"),
        StaffRole::Assistant => frame.say("Assistant", "アシスタント"),
    }
}

fn standing(frame: &PageFrame, member: &StaffMember) -> &'static str {
    match (member.is_active, member.has_password) {
        (false, _) => frame.say("closed", "停止中"),
        (true, true) => frame.say("active", "有効"),
        (true, false) => frame.say("has not chosen a password yet", "パスワード未設定"),
    }
}

/// What the page says of a form that was sent.
#[derive(Default)]
struct PeopleNotice {
    typed: NewMember,
    problem: Option<String>,
    link: Option<(String, String)>,
}

async fn view(service: &Service, frame: PageFrame, teacher: &Teacher, said: PeopleNotice) -> Result<Response, Problem> {
    teacher.check_course()?;
    let people = identity::people(service).await?;
    let may = |role: StaffRole| check_may_manage(teacher, role).is_ok();
    let offered = [StaffRole::Assistant, StaffRole::Lecturer, StaffRole::Administrator].into_iter();
    let offered = offered.filter(|role| may(*role) && !(service.is_beside() && *role == StaffRole::Administrator));
    let may_invite = identity::check_may_invite(service, teacher).await.is_ok();
    let is_first = !service.accounts().has_administrator().await?;
    shown(
        PeoplePage {
            place: Tab::People,
            csrf: teacher.csrf(service),
            roles: offered
                .filter(|role| !is_first || *role == StaffRole::Administrator)
                .map(|role| (id(role), role_name(&frame, role)))
                .collect(),
            people: people
                .into_iter()
                .map(|member| MemberLine {
                    role: role_name(&frame, member.role),
                    standing: standing(&frame, &member),
                    may_change: may(member.role),
                    member,
                })
                .collect(),
            is_first,
            may_invite,
            typed: said.typed,
            problem: said.problem,
            link: said.link,
            frame,
        }
        .render(),
    )
}

/// `GET /teacher/people`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view(&service, frame, &teacher, PeopleNotice::default()).await
}

/// `POST /teacher/people`: a new account. The first one's owner goes on to choose a password; of another one the page shows
/// the link.
pub(in crate::service::pages) async fn add(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    headers: HeaderMap,
    frame: PageFrame,
    Form(typed): Form<NewMember>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&service, &typed.csrf)?;
    let role = role(&typed.role).unwrap_or(StaffRole::Assistant);
    check_may_manage(&teacher, role)?;
    let is_first = !service.accounts().has_administrator().await?;
    match identity::let_in(&service, &teacher, (&typed.login, &typed.name), role).await {
        Ok((member, secret)) => {
            let detail = Detail::of(format!("{} {}", member.login, id(role)));
            let Some(secret) = secret else {
                return Ok(detail.on(Redirect::to("/teacher/people").into_response()));
            };
            if is_first && teacher.is_shared() {
                return Ok(detail.on(Redirect::to(&format!("/teacher/welcome/{secret}")).into_response()));
            }
            let link = Some((member.login, identity::invitation_link(&service, &headers, &secret)));
            Ok(detail.on(view(&service, frame, &teacher, PeopleNotice { link, ..PeopleNotice::default() }).await?))
        }
        Err(problem) => {
            let said = PeopleNotice { typed, problem: Some(said_of(problem, &frame)?), link: None };
            Ok(refused(view(&service, frame, &teacher, said).await?, StatusCode::UNPROCESSABLE_ENTITY))
        }
    }
}

/// `POST /teacher/people/{id}`: another link, another role, closing and opening an account.
pub(in crate::service::pages) async fn change(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Path(member): Path<String>,
    headers: HeaderMap,
    frame: PageFrame,
    Form(change): Form<AccountChange>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&service, &change.csrf)?;
    let member = service.store.course_member(&member).await?.ok_or_else(Problem::not_found)?;
    check_may_manage(&teacher, member.role)?;
    let detail = Detail::of(format!("{} {}", member.login, change.change));
    let done = match (change.change.as_str(), role(&change.change)) {
        ("link", _) => {
            identity::check_may_invite(&service, &teacher).await?;
            let secret = identity::invite(&service, &member).await?;
            let link = Some((member.login, identity::invitation_link(&service, &headers, &secret)));
            let page = view(&service, frame, &teacher, PeopleNotice { link, ..PeopleNotice::default() }).await?;
            return Ok(detail.on(page));
        }
        ("close", _) => identity::set_staff(&service, &member, member.role, false).await,
        ("open", _) => identity::set_staff(&service, &member, member.role, true).await,
        (_, Some(role)) => {
            check_may_manage(&teacher, role)?;
            identity::set_staff(&service, &member, role, member.is_active).await
        }
        (_, None) => Err(Problem::unprocessable("There is no such change.", "その操作はありません。")),
    };
    match done {
        Ok(()) => Ok(detail.on(Redirect::to("/teacher/people").into_response())),
        Err(problem) if problem.status == StatusCode::UNPROCESSABLE_ENTITY => {
            let detail = Some(problem.detail.get(frame.language).to_owned());
            let page =
                view(&service, frame, &teacher, PeopleNotice { problem: detail, ..PeopleNotice::default() }).await?;
            Ok(refused(page, problem.status))
        }
        Err(problem) => Err(problem),
    }
}
