//! What every request gets: a count by its address where it changes something, a time limit, a line in the log, a place in the figures.

use super::errors::Problem;
use super::identity::{is_teachers_program, visitor_cookie};
use super::limits::Counted;
use super::{Config, Service, api, metrics, submit};
use axum::extract::{MatchedPath, Request, State as Shared};
use axum::http::request::Parts;
use axum::http::{HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use std::time::{Duration, Instant};

/// How many times longer than other requests those may take that a teacher sends: archives come, whole classes go.
const TEACHERS_PATIENCE: f64 = 8.0;

/// What the routes begin with that are about a whole class or course.
const ABOUT_A_CLASS: [&str; 7] = [
    "/api/v1/batches",
    "/api/v1/class",
    "/api/v1/courses",
    "/api/v1/folders",
    "/api/v1/plan",
    "/api/v1/platforms",
    "/teacher",
];

/// Whether a request is about a whole class or course. Others than teachers get a short answer there.
fn is_about_a_class(route: &str) -> bool {
    let route = route.strip_prefix(HOMEWORK).unwrap_or(route);
    ABOUT_A_CLASS.iter().any(|start| route.starts_with(start))
}

/// What the routes of a homework begin with.
const HOMEWORK: &str = "/a/{assignment}";

/// A route with no homework's name in it.
pub(super) fn of_any_homework(path: &MatchedPath) -> String {
    match path.as_str().strip_prefix("/a/") {
        Some(rest) => format!("{HOMEWORK}{}", rest.find('/').map_or("", |slash| &rest[slash..])),
        None => path.as_str().to_owned(),
    }
}

/// The route of a request within its homework, where it is of one.
pub(super) fn route_of(parts: &Parts) -> String {
    let route = parts.extensions.get::<MatchedPath>().map(of_any_homework).unwrap_or_default();
    route.strip_prefix(HOMEWORK).unwrap_or(&route).to_owned()
}

/// The layer.
pub(super) async fn attend(Shared(service): Shared<Service>, mut request: Request, next: Next) -> Response {
    let start = Instant::now();
    let method = request.method().clone();
    let route = request.extensions().get::<MatchedPath>().map_or_else(|| "none".to_owned(), of_any_homework);
    let patience = if is_about_a_class(&route) { TEACHERS_PATIENCE } else { 1.0 };
    let seconds = service.config.limits.request_timeout * patience;
    // Counted before a byte of the body is read. What changes nothing is not, and neither is what a teacher's program sends.
    let is_safe = request.method().is_safe();
    let (counted, is_within_rate) = match is_safe || is_teachers_program(&service, &mut request).await {
        true => (Counted::default(), Ok(())),
        false => counted(&service, &request, &route),
    };
    let mut response = match is_within_rate {
        Err(problem) => problem.into_response(),
        Ok(()) if !is_about_a_class(&route) && declared_length(&request) > api::MAX_BODY as u64 => {
            // Later than the time limit there is nobody left to tell.
            let _ = tokio::time::timeout(Config::span(seconds), pass_over(request)).await;
            submit::too_large().into_response()
        }
        Ok(()) => {
            let answered = tokio::time::timeout(Config::span(seconds), next.run(request)).await;
            answered.unwrap_or_else(|_| too_late())
        }
    };
    counted.tell(response.headers_mut());
    let status = response.status().as_u16();
    let took = start.elapsed();
    // An id in the address opens a report, and a name in it was written by a student: the route says enough.
    let milliseconds = took.as_secs_f64() * 1e3;
    tracing::info!(%method, route, status, milliseconds, "request");
    metrics::request(&route, if is_known(&method) { method.as_str() } else { "other" }, status, took);
    if service.is_ending() {
        response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
    }
    response
}

/// What is left of the rates of a request, and whether it may come in.
fn counted(service: &Service, request: &Request, route: &str) -> (Counted, Result<(), Problem>) {
    let client = service.proxies.client_of(request);
    let cookie = visitor_cookie(service, request.headers());
    service.limits.count(&client, UPLOADS.contains(&route), cookie.as_deref())
}

/// Routes to which students send files.
const UPLOADS: [&str; 3] = ["/api/v1/submissions", "/a/{assignment}", "/a/{assignment}/draft"];

/// How long a body is by its head.
fn declared_length(request: &Request) -> u64 {
    let length = request.headers().get(header::CONTENT_LENGTH);
    length.and_then(|length| length.to_str().ok()?.parse().ok()).unwrap_or(0)
}

/// Most bytes of a body that are read for nothing, and how long the next ones may take.
const MOST_PASSED_OVER: usize = 32 << 20;
const LONGEST_PAUSE: Duration = Duration::from_secs(1);

/// Reads a body for nothing: who is still sending when the connection ends never sees the answer.
async fn pass_over(request: Request) {
    let mut body = request.into_body().into_data_stream();
    let mut passed = 0;
    while passed < MOST_PASSED_OVER
        && let Ok(Some(Ok(bytes))) = tokio::time::timeout(LONGEST_PAUSE, body.next()).await
    {
        passed += bytes.len();
    }
}

/// Names of methods are the client's to choose; figures must not grow with them.
fn is_known(method: &Method) -> bool {
    [Method::GET, Method::HEAD, Method::POST, Method::PUT, Method::PATCH, Method::DELETE, Method::OPTIONS]
        .contains(method)
}

fn too_late() -> Response {
    Problem::new(
        StatusCode::REQUEST_TIMEOUT,
        "timeout",
        "The request took too long to arrive or to be answered. Please try again.",
        "時間内にリクエストの受信または処理が終わりませんでした。もう一度試してください。",
    )
    .into_response()
}
