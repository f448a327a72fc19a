//! The teacher: a session's cookie in a browser, or the token in a program.

use super::cookies::{TEACHER_COOKIE, read};
use super::secrets::same;
use super::{csrf, token_hash};
use crate::service::errors::Problem;
use crate::service::store::DeletionTarget;
use crate::service::{Scope, Service};
use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};

/// A teacher. As an argument of a handler it lets nobody else pass; where the handler is not of one homework, it asks which
/// class they may see.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Teacher {
    /// The session; none for a program.
    session: Option<String>,
    /// Id of the homework whose teacher it is; none for the whole course.
    homework: Option<String>,
}

impl Teacher {
    async fn of(service: &Service, headers: &HeaderMap) -> Result<Option<Self>, Problem> {
        if let Some(token) = bearer(headers) {
            return Ok(of_token(service, token).map(|homework| Self { session: None, homework }));
        }
        let Some(session) = read(service, headers, TEACHER_COOKIE) else { return Ok(None) };
        let open = service.store.session(&token_hash(&session), service.clock.now()).await?;
        Ok(open.map(|homework| Self { session: Some(session), homework }))
    }

    /// Whether they may see the class of a homework.
    pub fn may_see(&self, assignment: &str) -> bool {
        self.homework.as_deref().is_none_or(|own| own == assignment)
    }

    /// Lets who may see the class of a homework pass.
    pub fn check(&self, assignment: &str) -> Result<(), Problem> {
        if self.may_see(assignment) { Ok(()) } else { Err(Problem::not_this_teachers()) }
    }

    /// Whether they are a teacher of the whole course.
    pub fn has_course(&self) -> bool {
        self.homework.is_none()
    }

    /// Lets a teacher of the whole course pass: for what belongs to all its homeworks.
    pub fn check_course(&self) -> Result<(), Problem> {
        if self.has_course() { Ok(()) } else { Err(Problem::not_this_teachers()) }
    }

    /// Lets who may delete this pass, where they may see the homework that it was found in. With somebody goes what they
    /// handed in for every homework.
    pub fn may_delete(&self, target: &DeletionTarget) -> Result<(), Problem> {
        match target {
            DeletionTarget::Submission(_) | DeletionTarget::Batch(_) | DeletionTarget::Entry(..) => Ok(()),
            DeletionTarget::Student(_) | DeletionTarget::Browser(_) => self.check_course(),
        }
    }

    /// The token of every form on a page for this teacher.
    pub fn csrf(&self, service: &Service) -> String {
        self.session.as_deref().map(|session| csrf::token(service, session)).unwrap_or_default()
    }

    /// Lets a form pass that has this session's token. A program brings its secret itself, which no page can make it do.
    pub fn check_csrf(&self, service: &Service, given: &str) -> Result<(), Problem> {
        self.session.as_deref().map_or(Ok(()), |session| csrf::check(service, session, given))
    }

    pub(super) fn session(&self) -> Option<&str> {
        self.session.as_deref()
    }
}

/// Whose token this is: the id of a homework, none for the whole course; nothing where it is no teacher's.
pub(super) fn of_token(service: &Service, token: &str) -> Option<Option<String>> {
    if service.teacher_token.as_ref().is_some_and(|secret| same(secret, token)) {
        return Some(None);
    }
    let of_homeworks = service.config.homework_tokens.iter();
    of_homeworks.filter(|(_, secret)| same(secret, token)).map(|(id, _)| Some(id.clone())).next()
}

/// Whether a request brings a teacher's token, as a program of theirs does.
pub(in crate::service) fn is_teachers_program(service: &Service, headers: &HeaderMap) -> bool {
    bearer(headers).is_some_and(|token| of_token(service, token).is_some())
}

/// The secret of an `Authorization: Bearer`.
pub(in crate::service) fn bearer(headers: &HeaderMap) -> Option<&str> {
    headers.get(header::AUTHORIZATION)?.to_str().ok()?.strip_prefix("Bearer ").map(str::trim)
}

impl<S: Scope> FromRequestParts<S> for Teacher {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Self, Problem> {
        let teacher = Self::of(scope.whole(), &parts.headers).await?.ok_or_else(|| {
            Problem::new(
                StatusCode::UNAUTHORIZED,
                "unauthorized",
                "This is for teachers: send Authorization: Bearer with the teacher's token, or log in at /teacher/login.",
                "教員用です。教員用トークンを Authorization: Bearer で送るか、/teacher/login でログインしてください。",
            )
        })?;
        if let Some(service) = scope.own() {
            teacher.check(&service.assignment.id)?;
        }
        Ok(teacher)
    }
}

impl<S: Scope> axum::extract::OptionalFromRequestParts<S> for Teacher {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Option<Self>, Problem> {
        Self::of(scope.whole(), &parts.headers).await
    }
}

/// A teacher on a page: anybody else is sent to log in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TeacherPage(pub Teacher);

impl<S: Scope> FromRequestParts<S> for TeacherPage {
    type Rejection = Response;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Self, Response> {
        match <Teacher as FromRequestParts<S>>::from_request_parts(parts, scope).await {
            Ok(teacher) => Ok(Self(teacher)),
            Err(problem) if problem.status == StatusCode::UNAUTHORIZED => {
                Err(Redirect::to("/teacher/login").into_response())
            }
            Err(problem) => Err(problem.into_response()),
        }
    }
}
