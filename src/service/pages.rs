//! The pages that people see: the templates of `pages/templates/`, filled with what the rest of the service knows.
//!
//! [`hand_in`] is the student's page with its forms, [`student`] what that page says, [`result`] the page of a report
//! and its pictures, [`join`] the course link, [`teacher`] everything behind the login. [`frame`] is around each page,
//! [`assets`] what pages load. Every page works without scripts.

mod assets;
mod datetime;
mod frame;
mod hand_in;
mod join;
mod problem;
mod receipt;
mod report_fragment;
mod result;
mod standing;
mod student;
mod teacher;
mod terms;

pub use assets::warm;
pub use frame::Frame;
pub use problem::problem;

use super::State;
use super::errors::Problem;
use super::identity::visit;
use super::language::COOKIE;
use crate::fault::Fault;
use axum::Router;
use axum::extract::Request;
use axum::http::{HeaderValue, header};
use axum::middleware::{Next, from_fn, from_fn_with_state};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use tower_http::compression::CompressionLayer;

/// The routes of all pages.
pub fn router(state: &State) -> Router<State> {
    Router::new()
        .route("/", get(hand_in::first))
        .route("/a/{assignment}", get(hand_in::desk).post(hand_in::hand_in))
        .route("/a/{assignment}/draft", post(hand_in::draft))
        .route("/a/{assignment}/read", post(hand_in::read))
        .route("/a/{assignment}/starter", get(hand_in::starter))
        .route("/r/{id}", get(result::page))
        .route("/r/{id}/part", get(result::part_of))
        .route("/r/{id}/receipt", get(result::receipt_of))
        .route("/r/{id}/source", get(result::source))
        .route("/r/{id}/{picture}", get(result::picture))
        .route("/r/{id}/terms/{picture}", get(terms::picture))
        .route("/r/{id}/frames/{picture}", get(result::frame))
        .route("/join/{secret}", get(join::page).post(join::join))
        .route("/leave", post(join::leave))
        .merge(teacher::router())
        .layer(from_fn(keep_language))
        .layer(from_fn_with_state(state.clone(), visit))
        .merge(Router::new().route("/assets/{name}", get(assets::serve)).layer(CompressionLayer::new()))
}

/// A year, in seconds.
const YEAR: u32 = 365 * 24 * 3600;

/// Remembers a language that was chosen on a page.
async fn keep_language(request: Request, next: Next) -> Response {
    let chosen = request.uri().query().into_iter().flat_map(|query| query.split('&')).find_map(|pair| match pair {
        "lang=ja" => Some("ja"),
        "lang=en" => Some("en"),
        _ => None,
    });
    let mut response = next.run(request).await;
    if let Some(language) = chosen {
        let cookie = format!("{COOKIE}={language}; Path=/; Max-Age={YEAR}; SameSite=Lax");
        if let Ok(cookie) = HeaderValue::from_str(&cookie) {
            response.headers_mut().append(header::SET_COOKIE, cookie);
        }
    }
    response
}

/// A page of somebody's own, which no cache may keep.
fn shown(page: askama::Result<String>) -> Result<Response, Problem> {
    let page = page.map_err(|error| Problem::internal(&error))?;
    Ok(([(header::CACHE_CONTROL, "no-store"), (header::VARY, "accept-language, cookie")], Html(page)).into_response())
}

fn internal(fault: Fault) -> Problem {
    Problem::of_fault(&fault)
}
