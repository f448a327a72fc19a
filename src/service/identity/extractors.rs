//! Teachers as arguments of handlers: nobody else passes.

use super::{Teacher, pseudonyms};
use crate::service::Scope;
use crate::service::errors::Problem;
use crate::service::store::StaffRole;
use axum::extract::{FromRequestParts, OptionalFromRequestParts};
use axum::http::StatusCode;
use axum::http::request::Parts;
use axum::response::{IntoResponse, Redirect, Response};

impl<S: Scope> FromRequestParts<S> for Teacher {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Self, Problem> {
        let found = Self::of_request(scope.whole(), &parts.headers, &mut parts.extensions).await?;
        let teacher = found.ok_or_else(|| {
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
        if !teacher.sees_names() {
            pseudonyms::check(parts)?;
        }
        teacher.check_scope(parts)?;
        Ok(teacher)
    }
}

impl<S: Scope> OptionalFromRequestParts<S> for Teacher {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Option<Self>, Problem> {
        let teacher = Self::of_request(scope.whole(), &parts.headers, &mut parts.extensions).await?;
        teacher.as_ref().map_or(Ok(()), |teacher| teacher.check_scope(parts))?;
        Ok(teacher)
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

/// A lecturer or an administrator on a page: assistants are told that it is not theirs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LecturerPage(pub Teacher);

impl<S: Scope> FromRequestParts<S> for LecturerPage {
    type Rejection = Response;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Self, Response> {
        let TeacherPage(teacher) = TeacherPage::from_request_parts(parts, scope).await?;
        teacher.check_role(StaffRole::Lecturer).map_err(IntoResponse::into_response)?;
        Ok(Self(teacher))
    }
}
