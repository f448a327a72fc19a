//! Logging in and out.

use super::cookies::{TEACHER_COOKIE, set};
use super::secrets::{password_matches, same};
use super::{Teacher, Visitor, new_token, token_hash};
use crate::service::State;
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
pub async fn login(state: &State, client: &Client, visitor: &Visitor, form: &LoginForm) -> Result<Response, Problem> {
    visitor.check_csrf(state, &form.csrf)?;
    state.limits.login(client)?;
    if form.password.len() > LONGEST_PASSWORD || !is_right(state, &form.password).await? {
        tracing::warn!(address = %client.address, "teacher login refused");
        return Err(Problem::new(
            StatusCode::FORBIDDEN,
            "login",
            "This is not the teacher's password or token.",
            "パスワードまたはトークンが違います。",
        ));
    }
    let session = new_token();
    let now = state.clock.now();
    state.store.open_session(&token_hash(&session), now, now + millis(SESSION)).await?;
    tracing::info!(address = %client.address, "teacher logged in");
    Ok(to_page_with_cookie(state, "/teacher", &session, SESSION.as_secs()))
}

/// Ends a session: the answer goes to `/` and removes the cookie.
pub async fn logout(state: &State, teacher: &Teacher, csrf: &str) -> Result<Response, Problem> {
    teacher.check_csrf(state, csrf)?;
    if let Some(session) = teacher.session() {
        state.store.close_session(Some(&token_hash(session))).await?;
    }
    Ok(to_page_with_cookie(state, "/", "", 0))
}

fn to_page_with_cookie(state: &State, page: &str, value: &str, seconds: u64) -> Response {
    let mut response = Redirect::to(page).into_response();
    if let Some(cookie) = set(state, TEACHER_COOKIE, value, seconds) {
        response.headers_mut().append(header::SET_COOKIE, cookie);
    }
    response
}

async fn is_right(state: &State, password: &str) -> Result<bool, Problem> {
    if state.teacher_token.as_ref().is_some_and(|token| same(token, password)) {
        return Ok(true);
    }
    let hash = match &state.config.teacher_password_hash {
        Some(hash) => Some(hash.clone()),
        None => state.store.setting(PASSWORD_SETTING).await?,
    };
    let Some(hash) = hash else { return Ok(false) };
    // One at a time: each takes a processor and some memory for a while.
    let _turn = state.login_turn.acquire().await;
    let password = password.to_owned();
    let checked = tokio::task::spawn_blocking(move || password_matches(&password, &hash)).await;
    checked.map_err(|error| Problem::internal(&error))
}
