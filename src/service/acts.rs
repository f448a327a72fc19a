//! The log of what teachers do: a layer notes every request of a teacher that changed something, so that no handler can
//! forget it. A handler that knows more says so in its answer ([`Detail`]).

use super::Service;
use super::identity::Teacher;
use super::requests::of_any_homework;
use super::store::{Act, OwnedToken};
use axum::extract::{MatchedPath, Request, State as Shared};
use axum::http::Method;
use axum::middleware::Next;
use axum::response::Response;
use std::fmt::Display;

/// More about an act, for its line in the log.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Detail {
    /// Id of the student whom it was about.
    pub student_id: Option<String>,
    /// The homework, where the address does not say it.
    pub assignment: Option<String>,
    /// What else is worth knowing; in no language.
    pub text: String,
}

impl Detail {
    /// An answer with this detail.
    pub fn on(self, mut response: Response) -> Response {
        response.extensions_mut().insert(self);
        response
    }

    /// The detail of something that has a name.
    pub fn of(text: impl Into<String>) -> Self {
        Self { text: text.into(), ..Self::default() }
    }

    /// The detail of something about a student.
    pub fn about(student_id: &str) -> Self {
        Self { student_id: Some(student_id.to_owned()), ..Self::default() }
    }
}

/// What differs between settings as they stood and as they stand: `attempts: – → 3, hints: full → none`.
pub fn changes<N: Display>(before: &[(N, String)], after: &[(N, String)]) -> String {
    let shown = |text: &str| if text.is_empty() { "–".to_owned() } else { text.to_owned() };
    let changed = before.iter().zip(after).filter(|((_, before), (_, after))| before != after);
    let lines = changed.map(|((name, before), (_, after))| format!("{name}: {} → {}", shown(before), shown(after)));
    lines.collect::<Vec<_>>().join(", ")
}

/// What a request does, in the word that the log has for it; none for what is logged by itself, or is no act.
fn act(method: &Method, route: &str) -> Option<String> {
    let known = match (method.as_str(), route) {
        ("POST", "/teacher/login" | "/teacher/welcome/{secret}") => return None,
        ("POST", "/teacher/logout") => "logout",
        ("POST", "/teacher/settings") | ("PATCH", "/api/v1/assignments/{id}/settings") => "settings",
        ("POST", "/teacher/course") | ("PATCH", "/api/v1/course") => "course",
        ("POST", "/teacher/settings/link" | "/api/v1/course/link") => "link",
        ("POST", "/teacher/roster" | "/api/v1/platforms/{id}/roster") | ("PUT", "/api/v1/roster") => "roster",
        ("POST", "/teacher/folders" | "/teacher/folders/{id}") | ("POST", "/api/v1/folders") => "folder",
        ("POST", "/api/v1/folders/{id}/publication") | ("DELETE", "/api/v1/folders/{id}/publication") => "folder",
        ("POST", "/teacher/codes" | "/api/v1/codes/{number}") => "code",
        ("POST", "/teacher/data") => "pseudonyms",
        ("POST", "/teacher/data/export") => "exported",
        ("POST", "/teacher/data/archive" | "/api/v1/archive") => "download",
        ("POST", "/teacher/people" | "/api/v1/staff") => "person-added",
        ("POST", "/teacher/people/{id}" | "/api/v1/staff/{id}/invitation") | ("PATCH", "/api/v1/staff/{id}") => {
            "person"
        }
        ("POST", "/teacher/platforms" | "/api/v1/platforms" | "/api/v1/platforms/registration")
        | ("PATCH", "/api/v1/platforms/{id}")
        | ("PUT", "/api/v1/platforms/{id}/courses") => "platform",
        ("POST", "/teacher/tokens" | "/teacher/tokens/{id}") | ("DELETE", "/api/v1/tokens/{id}") => "token",
        ("POST", "/teacher/courses" | "/api/v1/courses") => "courses",
        ("POST", "/teacher/plan") | ("PUT", "/api/v1/plan") => "plan",
        ("POST", "/teacher/batches" | "/api/v1/batches") => "archive",
        ("POST", "/teacher/downloads" | "/teacher/worksheet" | "/teacher/batches/{id}/worksheet") => "download",
        ("POST", "/api/v1/class/files/{format}" | "/api/v1/batches/{id}/files/{format}") => "download",
        ("POST", "/teacher/regradings" | "/api/v1/regradings") => "regrading",
        ("POST", "/teacher/regradings/{id}" | "/api/v1/regradings/{id}/adoption") => "adopted",
        ("POST", "/teacher/extension" | "/teacher/extensions") | ("PUT", "/api/v1/extensions") => "extension",
        ("POST", "/teacher/choice" | "/api/v1/submissions/{id}/choice") => "choice",
        ("POST", "/r/{id}/override") | ("PUT" | "DELETE", "/api/v1/submissions/{id}/rubric/{line}") => "override",
        ("POST", "/r/{id}/comments" | "/api/v1/submissions/{id}/comments")
        | ("DELETE", "/api/v1/submissions/{id}/comments/{comment}") => "comment",
        ("POST", "/teacher/appeals/{id}") | ("PUT", "/api/v1/appeals/{id}/answer") => "appeal",
        ("PUT" | "DELETE", "/api/v1/appeals/{id}/handler") => "appeal",
        ("POST", "/teacher/delete") | ("DELETE", _) => "deleted",
        ("POST", "/api/v1/submissions") => "handed-in",
        (method, route) => return Some(format!("{method} {route}")),
    };
    Some(known.to_owned())
}

/// Acts that are about the course, on whatever page they are done.
const OF_COURSE: [&str; 13] = [
    "courses",
    "plan",
    "pseudonyms",
    "exported",
    "platform",
    "course",
    "link",
    "roster",
    "code",
    "person-added",
    "person",
    "logout",
    "token",
];

/// Routes that students use as well: what a teacher does there is an act where the handler says so.
fn is_of_everybody(route: &str) -> bool {
    !(route.contains("/teacher") || route.starts_with("/api/v1/batches") || route.starts_with("/api/v1/students"))
}

/// The layer.
pub(super) async fn note(Shared(service): Shared<Service>, mut request: Request, next: Next) -> Response {
    let route = request.extensions().get::<MatchedPath>().map(of_any_homework);
    let Some(route) = route.filter(|_| !request.method().is_safe()) else { return next.run(request).await };
    let route = route.strip_prefix("/a/{assignment}").unwrap_or(&route).to_owned();
    let word = act(request.method(), &route);
    let assignment = homework_in(request.uri().path());
    // Before the handler, which may end the session.
    let headers = request.headers().clone();
    let teacher = Teacher::of_request(&service, &headers, request.extensions_mut()).await.ok().flatten();
    let response = next.run(request).await;
    let status = response.status();
    let (Some(teacher), Some(word)) = (teacher, word) else { return response };
    let detail = response.extensions().get::<Detail>();
    if status.is_client_error() || status.is_server_error() || (detail.is_none() && is_of_everybody(&route)) {
        return response;
    }
    let detail = detail.cloned().unwrap_or_default();
    let is_of_course = OF_COURSE.contains(&word.as_str());
    let only = || service.only().filter(|_| !is_of_course).map(|state| state.assignment.id.clone());
    let act = Act {
        at: service.clock.now(),
        staff_id: teacher.staff().map(|member| member.id.clone()),
        way: teacher.way().to_owned(),
        act: word,
        assignment: detail
            .assignment
            .or(assignment.filter(|_| !is_of_course))
            .or_else(|| teacher.homework().map(str::to_owned))
            .or_else(only),
        student_id: detail.student_id,
        detail: detail.text,
    };
    if let Err(error) = service.store.note_act(&act).await {
        tracing::error!(%error, act = act.act, "an act of a teacher could not be noted");
    }
    response
}

/// The homework whose page an address is.
fn homework_in(path: &str) -> Option<String> {
    Some(path.strip_prefix("/a/")?.split('/').next()?.to_owned())
}

impl OwnedToken {
    /// What the log says where the token was ended.
    pub(super) fn detail(self) -> Detail {
        let Self { token, login } = self;
        Detail { assignment: token.assignment, ..Detail::of(format!("− {} ({login})", token.name)) }
    }
}
