//! The pages that people see: the templates of `pages/templates/`, filled with what the rest of the service knows.
//!
//! [`homeworks`] lists the homeworks where there are several, [`hand_in`] is the student's page of one, [`mod@form`] what it sends, [`student`] what that page says, [`attempts`] the cards of what was handed in, [`result`] the page of a report
//! and its pictures, [`judgement`] what people judge there, [`join`] the course link, [`who`] who sits there, [`privacy`] what is kept, [`lti`] what comes from learning platforms, [`teacher`] everything behind the login. [`frame`] is around each page,
//! [`assets`] what pages load. Every page works without scripts.

mod assets;
mod attempts;
mod datetime;
mod form;
mod frame;
mod hand_in;
mod homeworks;
mod join;
mod judgement;
mod lti;
mod preview;
mod privacy;
mod problem;
mod receipt;
mod report_fragment;
mod result;
mod standing;
mod student;
mod teacher;
mod terms;
mod who;

pub use assets::warm;
pub(super) use datetime::TimeElement;
pub use frame::PageFrame;
pub(super) use lti::{launch_lost, shown_choice, shown_number};
pub use preview::broken_folder;
pub use problem::problem;

use super::Service;
use super::errors::Problem;
use super::identity::visit;
use super::language::COOKIE;
use crate::fault::Fault;
use axum::Router;
use axum::extract::Request;
use axum::handler::Handler;
use axum::http::{HeaderValue, header};
use axum::middleware::{Next, from_fn, from_fn_with_state};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use tower_http::compression::CompressionLayer;

/// The routes of all pages. Those of a homework are a router of their own for each: below `/a/{assignment}`; where there is
/// one only, its student's page is also `/`, and its teacher's pages begin with `/teacher`.
pub fn router(service: &Service) -> Router<Service> {
    let mut routes = of_service();
    for state in service.homeworks() {
        let page = state.place();
        let drawn = from_fn_with_state(state.clone(), hand_in::drawn);
        let seen = from_fn_with_state(state.clone(), hand_in::seen);
        let student: Router<Service> =
            hand_in::router().layer(drawn.clone()).layer(seen.clone()).with_state(state.clone());
        let teacher: Router<Service> = teacher::router().layer(drawn.clone()).with_state(state.clone());
        routes = if service.has_several() {
            routes.nest(&page, student.merge(teacher))
        } else {
            let moved = homeworks::of_the_only_one().with_state(state.clone());
            let first = Router::new().route("/", get(hand_in::desk)).layer(drawn).layer(seen).with_state(state);
            routes.nest(&page, student.merge(moved)).merge(teacher).merge(first)
        };
    }
    if service.has_several() {
        routes = routes.merge(homeworks::router());
    }
    if !service.is_beside() {
        routes = routes.merge(teacher::of_service());
    }
    let embeddable = from_fn_with_state(service.clone(), lti::embeddable);
    routes
        .layer(from_fn(keep_language))
        .layer(embeddable.clone())
        .layer(from_fn_with_state(service.clone(), visit))
        .fallback(nothing_here.layer(embeddable))
        .merge(Router::new().route("/assets/{name}", get(assets::serve)).layer(CompressionLayer::new()))
}

/// An address at which there is nothing, which may be read in a frame as other pages are.
async fn nothing_here() -> Problem {
    Problem::not_found()
}

/// The pages that are of no homework, or of the one that their address leads to.
fn of_service() -> Router<Service> {
    Router::new()
        .route("/r/{id}", get(result::page))
        .route("/r/{id}/part", get(result::part_of))
        .route("/r/{id}/receipt", get(result::receipt_of))
        .route("/r/{id}/source", get(result::source))
        .route("/r/{id}/{picture}", get(result::picture))
        .route("/r/{id}/terms/{picture}", get(terms::picture))
        .route("/r/{id}/frames/{picture}", get(result::frame))
        .route("/r/{id}/override", post(judgement::forms::override_line))
        .route("/r/{id}/comments", post(judgement::forms::comment))
        .route("/r/{id}/appeal", post(judgement::forms::ask))
        .route("/teacher/appeals/{id}", post(judgement::forms::handled))
        .route("/join/{secret}", get(join::page).post(join::join))
        .route("/leave", post(join::leave))
        .route("/privacy", get(privacy::page))
        .route("/lti/register/{secret}", get(lti::register))
        .merge(teacher::of_course())
        .merge(super::lti::launches())
        .merge(super::sign_in::router())
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
