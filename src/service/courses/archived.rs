//! An archived course: everything is read, nothing is changed.

use super::super::Service;
use super::super::errors::Problem;
use super::super::requests::of_any_homework;
use axum::extract::{MatchedPath, Request, State as Shared};
use axum::http::StatusCode;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// The routes by which nothing of a course changes, though they are POST: coming and going, downloads, the list of courses, and opening the course again.
const READING: [&str; 17] = [
    "/join/{secret}",
    "/leave",
    "/teacher/login",
    "/teacher/logout",
    "/teacher/welcome/{secret}",
    "/teacher/courses",
    "/api/v1/courses",
    "/api/v1/course",
    "/teacher/downloads",
    "/teacher/worksheet",
    "/teacher/batches/{id}/worksheet",
    "/api/v1/class/files/{format}",
    "/teacher/data/export",
    "/teacher/data/archive",
    "/api/v1/archive",
    "/api/v1/batches/{id}/files/{format}",
    "/lti/login",
];

/// The routes by which somebody's data or a program's way in goes: that is never refused.
const DELETING: [&str; 6] = [
    "/teacher/delete",
    "/api/v1/students/{number}",
    "/api/v1/submissions/{id}",
    "/api/v1/batches/{id}",
    "/teacher/tokens/{id}",
    "/api/v1/tokens/{id}",
];

/// The layer: refuses what would change an archived course. Launches from a learning platform come in.
pub(in crate::service) async fn keep(Shared(service): Shared<Service>, request: Request, next: Next) -> Response {
    let route = request.extensions().get::<MatchedPath>().map(of_any_homework).unwrap_or_default();
    let route = route.strip_prefix("/a/{assignment}").unwrap_or(&route);
    let changes = !request.method().is_safe() && !READING.contains(&route) && !DELETING.contains(&route);
    if !changes || route == "/lti/launch" {
        return next.run(request).await;
    }
    match service.store.archived_at().await {
        Ok(None) => next.run(request).await,
        Ok(Some(_)) => archived().into_response(),
        Err(error) => Problem::from(error).into_response(),
    }
}

/// The answer of a course that is archived.
pub fn archived() -> Problem {
    Problem::new(
        StatusCode::FORBIDDEN,
        "archived",
        "This course is archived: what is there can be read, and nothing is handed in or changed. An administrator can open it again.",
        "この授業はアーカイブされています。内容は閲覧できますが、提出や変更はできません。管理者は授業を再開できます。",
    )
}
