//! The teacher: a session's cookie in a browser, or the token in a program.

use super::cookies::{TEACHER_COOKIE, read};
use super::secrets::same;
use super::{csrf, token_hash};
use crate::service::State;
use crate::service::errors::Problem;
use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};

/// A teacher. As an argument of a handler it lets nobody else pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Teacher {
    /// The session; none for a program.
    session: Option<String>,
}

impl Teacher {
    async fn of(state: &State, headers: &HeaderMap) -> Result<Option<Self>, Problem> {
        if let Some(token) = bearer(headers) {
            return Ok(is_theirs(state, token).then_some(Self { session: None }));
        }
        let Some(session) = read(state, headers, TEACHER_COOKIE) else { return Ok(None) };
        let is_open = state.store.session_is_open(&token_hash(&session), state.clock.now()).await?;
        Ok(is_open.then_some(Self { session: Some(session) }))
    }

    /// The token of every form on a page for this teacher.
    pub fn csrf(&self, state: &State) -> String {
        self.session.as_deref().map(|session| csrf::token(state, session)).unwrap_or_default()
    }

    /// Lets a form pass that has this session's token. A program brings its secret itself, which no page can make it do.
    pub fn check_csrf(&self, state: &State, given: &str) -> Result<(), Problem> {
        self.session.as_deref().map_or(Ok(()), |session| csrf::check(state, session, given))
    }

    pub(super) fn session(&self) -> Option<&str> {
        self.session.as_deref()
    }
}

fn is_theirs(state: &State, token: &str) -> bool {
    state.teacher_token.as_ref().is_some_and(|secret| same(secret, token))
}

/// Whether a request brings the teacher's token, as a program of theirs does.
pub(in crate::service) fn is_teachers_program(state: &State, headers: &HeaderMap) -> bool {
    bearer(headers).is_some_and(|token| is_theirs(state, token))
}

/// The secret of an `Authorization: Bearer`.
pub(in crate::service) fn bearer(headers: &HeaderMap) -> Option<&str> {
    headers.get(header::AUTHORIZATION)?.to_str().ok()?.strip_prefix("Bearer ").map(str::trim)
}

impl FromRequestParts<State> for Teacher {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &State) -> Result<Self, Problem> {
        Self::of(state, &parts.headers).await?.ok_or_else(|| {
            Problem::new(
                StatusCode::UNAUTHORIZED,
                "unauthorized",
                "This is for teachers: send Authorization: Bearer with the teacher's token, or log in at /teacher/login.",
                "教員用です。教員用トークンを Authorization: Bearer で送るか、/teacher/login でログインしてください。",
            )
        })
    }
}

impl axum::extract::OptionalFromRequestParts<State> for Teacher {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &State) -> Result<Option<Self>, Problem> {
        Self::of(state, &parts.headers).await
    }
}

/// A teacher on a page: anybody else is sent to log in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TeacherPage(pub Teacher);

impl FromRequestParts<State> for TeacherPage {
    type Rejection = Response;

    async fn from_request_parts(parts: &mut Parts, state: &State) -> Result<Self, Response> {
        match Teacher::of(state, &parts.headers).await {
            Ok(Some(teacher)) => Ok(Self(teacher)),
            Ok(None) => Err(Redirect::to("/teacher/login").into_response()),
            Err(problem) => Err(problem.into_response()),
        }
    }
}
