//! Logging in and out.

use super::accounts::in_course;
use super::cookies::{Jar, TEACHER_COOKIE, read, remove, set};
use super::secrets::{hash_password, password_matches};
use super::staff::{LONGEST_PASSWORD, PASSWORD_SETTING, normal_login};
use super::teacher::of_token;
use super::{Teacher, Visitor, new_token, token_hash};
use crate::service::Service;
use crate::service::blocking::aside;
use crate::service::clock::millis;
use crate::service::errors::Problem;
use crate::service::limits::Client;
use crate::service::proxied::ProxiedName;
use crate::service::store::{Act, StaffMember, TeacherSession};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;
use std::sync::LazyLock;
use std::time::Duration;

/// How long a session lasts: a working day.
const SESSION: Duration = Duration::from_secs(12 * 3600);

/// The form of the login page.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct LoginForm {
    /// The page's token.
    pub csrf: String,
    /// The name by which somebody logs in; empty with a secret of the whole service.
    pub login: String,
    /// Password, or a secret of the whole service.
    pub password: String,
}

/// Opens a session: the answer goes to `/teacher` with its cookie. A wrong password is a [`Problem`] of kind `login`.
pub async fn login(
    service: &Service,
    client: &Client,
    visitor: &Visitor,
    said: Option<&ProxiedName>,
    form: &LoginForm,
) -> Result<Response, Problem> {
    visitor.check_csrf(service, &form.csrf)?;
    service.limits.login(client, &form.login)?;
    let session = match form.password.len() {
        0..=LONGEST_PASSWORD => opened(service, &form.login, &form.password).await?,
        _ => None,
    };
    let Some(session) = session else {
        tracing::warn!(address = %client.address, "teacher login refused");
        return Err(Problem::new(
            StatusCode::FORBIDDEN,
            "login",
            "There is no such login with this password.",
            "ログイン名またはパスワードが違います。",
        ));
    };
    tracing::info!(address = %client.address, "teacher logged in");
    let page = match &session.staff {
        Some(member) if !service.is_beside() && in_course(service, member.clone()).await?.is_none() => {
            "/teacher/courses"
        }
        _ => "/teacher",
    };
    open(service, session, page, (Jar::Own, said)).await
}

/// Opens the session of somebody who is known, in a browser for which a reverse proxy named somebody or did not.
pub async fn open_for(
    service: &Service,
    member: StaffMember,
    page: &str,
    place: (Jar, Option<&ProxiedName>),
) -> Result<Response, Problem> {
    if service.is_beside() {
        service.accounts().keep_account(&member, service.clock.now()).await?;
    }
    open(service, TeacherSession { staff: Some(member), ..TeacherSession::default() }, page, place).await
}

async fn open(
    service: &Service,
    session: TeacherSession,
    page: &str,
    (jar, said): (Jar, Option<&ProxiedName>),
) -> Result<Response, Problem> {
    let session = TeacherSession { proxied_name: said.map(|ProxiedName(name)| name.clone()), ..session };
    let token = new_token();
    let now = service.clock.now();
    service.accounts().open_session(&token_hash(&token), &session, now, now + millis(SESSION)).await?;
    // Whoever teaches elsewhere only is in the log of the first course, where the accounts are.
    let is_here = match &session.staff {
        Some(member) => in_course(service, member.clone()).await?.is_some(),
        None => true,
    };
    let log = if is_here { &service.store } else { service.accounts() };
    let act = Act {
        at: now,
        way: if session.staff.is_some() { "account" } else { "password" }.to_owned(),
        staff_id: session.staff.map(|member| member.id),
        act: "login".to_owned(),
        assignment: session.assignment,
        student_id: None,
        detail: String::new(),
    };
    log.note_act(&act).await?;
    let mut response = Redirect::to(page).into_response();
    if let Some(cookie) = set(service, TEACHER_COOKIE, &token, SESSION.as_secs(), jar) {
        response.headers_mut().append(header::SET_COOKIE, cookie);
    }
    Ok(response)
}

/// Ends a session: the answer goes to `/` and removes the cookie.
pub async fn logout(service: &Service, teacher: &Teacher, csrf: &str) -> Result<Response, Problem> {
    teacher.check_csrf(service, csrf)?;
    if let Some(session) = teacher.session() {
        service.accounts().close_session(Some(&token_hash(session))).await?;
    }
    let mut response = Redirect::to("/").into_response();
    // The session may be one of a frame.
    for jar in [Jar::Own, Jar::Embedded] {
        remove_cookie(service, &mut response, jar);
    }
    Ok(response)
}

/// Ends a teacher's session in a browser in which a student is known from now on: whoever sat there before has left.
pub(in crate::service) async fn end_session(
    service: &Service,
    headers: &HeaderMap,
    (response, jar): (&mut Response, Jar),
) -> Result<(), Problem> {
    if let Some(session) = read(service, headers, TEACHER_COOKIE) {
        service.accounts().close_session(Some(&token_hash(&session))).await?;
    }
    remove_cookie(service, response, jar);
    Ok(())
}

fn remove_cookie(service: &Service, response: &mut Response, jar: Jar) {
    if let Some(cookie) = set(service, TEACHER_COOKIE, "", 0, jar) {
        response.headers_mut().append(header::SET_COOKIE, cookie);
    }
}

/// Ends the session of a request whose proxy names somebody else than when it was opened: another person sits there. Where it names
/// nobody any more, the request goes on without the session, which is not ended: the proxy may let everybody ask for some pages.
pub(in crate::service) async fn check_session(
    service: &Service,
    headers: &mut HeaderMap,
    said: Option<&ProxiedName>,
) -> Result<(), Problem> {
    let Some(hash) = read(service, headers, TEACHER_COOKIE).map(|token| token_hash(&token)) else { return Ok(()) };
    let session = service.accounts().session(&hash, service.clock.now()).await?;
    if session.is_none_or(|session| is_of(&session, said)) {
        return Ok(());
    }
    if said.is_some() {
        service.accounts().close_session(Some(&hash)).await?;
    }
    remove(service, headers, TEACHER_COOKIE);
    Ok(())
}

/// Whether a session is that of whom a proxy names: the one of its account, or whom it named when the session was opened. One whose name
/// cannot be read may be anybody.
fn is_of(session: &TeacherSession, said: Option<&ProxiedName>) -> bool {
    let Some(ProxiedName(name)) = said else { return session.proxied_name.is_none() };
    if name.is_empty() {
        return false;
    }
    let login = session.staff.as_ref().map(|member| &member.login);
    [login, session.proxied_name.as_ref()].into_iter().flatten().any(|known| known.eq_ignore_ascii_case(name))
}

/// What a login and a password open, or a secret of the whole service without a login.
async fn opened(service: &Service, login: &str, password: &str) -> Result<Option<TeacherSession>, Problem> {
    if login.trim().is_empty() {
        return shared(service, password).await;
    }
    let found = match normal_login(login) {
        Some(login) => service.accounts().staff_login(&login).await?,
        None => None,
    };
    let (member, hash) = match found {
        Some((member, hash)) => (Some(member), hash),
        // A login that there is not takes as long as a wrong password.
        None => (None, NOBODYS.clone()),
    };
    let is_right = matches(service, password, hash).await?;
    Ok(member.filter(|_| is_right).map(|member| TeacherSession { staff: Some(member), ..TeacherSession::default() }))
}

/// The hash of a password that nobody knows.
static NOBODYS: LazyLock<String> = LazyLock::new(|| hash_password(&new_token()).unwrap_or_default());

/// What a secret of the whole service opens. The password that is set on the machine always does; what the configuration
/// has, until there is an administrator.
async fn shared(service: &Service, secret: &str) -> Result<Option<TeacherSession>, Problem> {
    let is_first = !service.accounts().has_administrator().await?;
    if is_first && let Some(assignment) = of_token(service, secret) {
        return Ok(Some(TeacherSession { assignment, ..TeacherSession::default() }));
    }
    let hash = match &service.config.teacher_password_hash {
        Some(hash) if is_first => Some(hash.clone()),
        _ => service.accounts().setting(PASSWORD_SETTING).await?,
    };
    let Some(hash) = hash else { return Ok(None) };
    Ok(matches(service, secret, hash).await?.then(TeacherSession::default))
}

async fn matches(service: &Service, password: &str, hash: String) -> Result<bool, Problem> {
    // One at a time: each takes a processor and some memory for a while.
    let _turn = service.login_turn.acquire().await;
    let password = password.to_owned();
    aside(move || password_matches(&password, &hash)).await
}
