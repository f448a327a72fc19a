//! Assistants who read pseudonyms: what is theirs all the same.

use crate::service::errors::Problem;
use crate::service::requests::route_of;
use axum::http::StatusCode;
use axum::http::request::Parts;

/// What shows no name, or a pseudonym in its place. Everything else of a teacher's is refused: a page that is added names
/// nobody before somebody has looked at it.
const NAMELESS: [&str; 20] = [
    "/teacher",
    "/teacher/events",
    "/teacher/person",
    "/teacher/appeals",
    "/teacher/appeals/{id}",
    "/teacher/insights",
    "/teacher/likeness",
    "/teacher/likeness/pair",
    "/teacher/logout",
    "/teacher/tokens",
    "/teacher/tokens/{id}",
    "/api/v1/tokens",
    "/api/v1/tokens/{id}",
    "/r/{id}/override",
    "/r/{id}/comments",
    "/api/v1/insights/{table}",
    "/api/v1/submissions/{id}/rubric/{line}",
    "/api/v1/submissions/{id}/comments",
    "/api/v1/submissions/{id}/comments/{comment}",
    "/api/v1/submissions/{id}/likeness/{other}",
];

/// Lets a request pass whose answer names nobody.
pub(super) fn check(parts: &Parts) -> Result<(), Problem> {
    if NAMELESS.contains(&route_of(parts).as_str()) {
        return Ok(());
    }
    Err(Problem::new(
        StatusCode::FORBIDDEN,
        "names",
        "This names students, and assistants of this course see pseudonyms. Ask a lecturer.",
        "この内容には学生の氏名が含まれます。この授業ではアシスタントには仮名だけを表示します。担当教員に依頼してください。",
    ))
}
