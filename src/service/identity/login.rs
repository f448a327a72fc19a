//! Logging in and out.

use super::cookies::{TEACHER_COOKIE, set};
use super::secrets::password_matches;
use super::teacher::of_token;
use super::{Teacher, Visitor, new_token, token_hash};
use crate::service::Service;
use crate::service::clock::millis;
use crate::service::errors::Problem;
use crate::service::limits::Client;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;
use std::time::Duration;

/// How long a session lasts: a working day.
const SESSION: Duration = Duration::from_secs(12 * 3600);

/// Longest password that is looked at, in bytes.
const LONGEST_PASSWORD: usize = 1024;

/// Name of the setting that holds the hash of the teacher's password.
pub(in crate::service) const PASSWORD_SETTING: &str = "teacher_password_hash";

/// The form of the login page.
#[derive(Clone, Debug, Deserialize)]
pub struct LoginForm {
    /// The page's token.
    #[serde(default)]
    pub csrf: String,
    /// Password, or the teacher's token.
    #[serde(default)]
    pub password: String,
}

/// Opens a session: the answer goes to `/teacher` with its cookie. A wrong password is a [`Problem`] of kind `login`.
pub async fn login(
    service: &Service,
    client: &Client,
    visitor: &Visitor,
    form: &LoginForm,
) -> Result<Response, Problem> {
    visitor.check_csrf(service, &form.csrf)?;
    service.limits.login(client)?;
    let homework = match form.password.len() {
        0..=LONGEST_PASSWORD => opened(service, &form.password).await?,
        _ => None,
    };
    let Some(homework) = homework else {
        tracing::warn!(address = %client.address, "teacher login refused");
        return Err(Problem::new(
            StatusCode::FORBIDDEN,
            "login",
            "This is not the teacher's password or token.",
            "パスワードまたはトークンが違います。",
        ));
    };
    let session = new_token();
    let now = service.clock.now();
    service.store.open_session(&token_hash(&session), homework.as_deref(), now, now + millis(SESSION)).await?;
    tracing::info!(address = %client.address, "teacher logged in");
    Ok(to_page_with_cookie(service, "/teacher", &session, SESSION.as_secs()))
}

/// Ends a session: the answer goes to `/` and removes the cookie.
pub async fn logout(service: &Service, teacher: &Teacher, csrf: &str) -> Result<Response, Problem> {
    teacher.check_csrf(service, csrf)?;
    if let Some(session) = teacher.session() {
        service.store.close_session(Some(&token_hash(session))).await?;
    }
    Ok(to_page_with_cookie(service, "/", "", 0))
}

fn to_page_with_cookie(service: &Service, page: &str, value: &str, seconds: u64) -> Response {
    let mut response = Redirect::to(page).into_response();
    if let Some(cookie) = set(service, TEACHER_COOKIE, value, seconds) {
        response.headers_mut().append(header::SET_COOKIE, cookie);
    }
    response
}

/// What a password or token opens: the class of a homework, by its id, or, with none, the whole course.
async fn opened(service: &Service, password: &str) -> Result<Option<Option<String>>, Problem> {
    if let Some(opened) = of_token(service, password) {
        return Ok(Some(opened));
    }
    let hash = match &service.config.teacher_password_hash {
        Some(hash) => Some(hash.clone()),
        None => service.store.setting(PASSWORD_SETTING).await?,
    };
    let Some(hash) = hash else { return Ok(None) };
    // One at a time: each takes a processor and some memory for a while.
    let _turn = service.login_turn.acquire().await;
    let password = password.to_owned();
    let checked = tokio::task::spawn_blocking(move || password_matches(&password, &hash)).await;
    Ok(checked.map_err(|error| Problem::internal(&error))?.then_some(None))
}
