//! The upload service: axum router, pages, store.
//!
//! | address | what |
//! | --- | --- |
//! | `/a/{assignment}` | the student's page; POST: a file, then to `/r/{id}` |
//! | `/` | the same of the only homework; a list where there are several |
//! | `/a/{assignment}/read` | POST: the text of a file, as grading reads it; nothing is stored |
//! | `/r/{id}` | the permanent page of a report; who has the address may see it |
//! | `/r/{id}/frames/{n}.png`, `animation.png` | its pictures; `?view=yours`, `expected`, `difference`, `all` |
//! | `/r/{id}/terms/{term}-yours.png`, `…-expected.png` | one term of the equation on its own |
//! | `/r/{id}/source` | the file as handed in, to be saved |
//! | `/r/{id}/override`, `comments`, `appeal` | POST: what people judge, and what a student asks |
//! | `/join/{secret}` | the course link |
//! | `/sign-in/{provider}`, `/signed-in` | the way to an OpenID issuer, and back |
//! | `/privacy` | what is kept, and for how long |
//! | `/lti/…` | launches from learning platforms, and the keys with which this service signs |
//! | `/teacher/…` | the teacher's pages; of each of several homeworks `/a/{assignment}/teacher/…`; `/teacher/login`, `/teacher/logout` |
//! | `/api/v1/…` | the API; `/api/v1/openapi.json`, to be read at `/api/docs` |
//! | `/assets/…` | styles and scripts |
//! | `/c/{course}/…` | all of this once more for another course than the first |
//! | `/healthz`, `/readyz`, `/metrics` | for who runs it |
//!
//! [`courses`] are the courses, [`folders`] are homeworks that come by the browser, [`submit`] is the one way in for files, [`grading`] grades them in the background, [`counting`] says which of several counts, [`gradebook`] is a course's table of all its homeworks, [`store`] keeps everything,
//! [`judgement`] what people judge beside it, [`likeness`] who has handed in what others have, [`insights`] what the class shows, [`export`] everything of one student, [`acts`] is the log of what teachers do, [`idempotency`] lets a file that is sent twice count once, [`identity`] says who is there, [`proxied`] takes a reverse proxy's word for it, [`sign_in`] that of an OpenID issuer, [`clients`] asks issuers and platforms, [`errors`] gives every error its form. [`server`] is the server around [`app`], [`preview`] one
//! for the teacher who is still writing the homework.
//! The async runtime lives nowhere else in ggrade.

pub mod acts;
pub mod api;
mod blocking;
pub mod classes;
pub mod clients;
pub mod clock;
pub mod config;
pub mod counting;
pub mod course;
pub mod courses;
pub mod deletion;
pub mod download;
pub mod errors;
pub mod export;
pub mod extensions;
pub mod folders;
pub mod gallery;
pub mod gradebook;
pub mod grading;
mod id_tokens;
pub mod idempotency;
pub mod identity;
pub mod insights;
pub mod judgement;
pub mod language;
pub mod likeness;
pub mod limits;
pub mod lti;
pub(crate) mod metrics;
pub mod pages;
pub mod preview;
pub mod proxied;
pub mod regrade;
mod requests;
pub mod roster;
mod rules;
mod scope;
pub mod server;
pub mod sign_in;
mod state;
pub mod store;
pub mod submit;
mod texts;
pub mod upkeep;

pub use config::Config;
pub use scope::Scope;
pub use state::{Service, ServiceParts, State};

use axum::Router;
use axum::extract::{DefaultBodyLimit, Request};
use axum::http::{HeaderName, HeaderValue, header};
use axum::response::Response;
use std::convert::Infallible;
use std::sync::{Arc, Mutex, PoisonError};
use tower::ServiceExt;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::set_header::SetResponseHeaderLayer;

/// The whole service as a router. Its routes are made anew when a homework was published or withdrawn.
pub fn app(service: Service) -> Router {
    let made = Arc::new(Mutex::new((service.generation(), whole(&service))));
    Router::new().fallback(async move |request: Request| -> Result<Response, Infallible> {
        if let Some((root, routes)) = courses::within(&service, &request) {
            return Ok(courses::answer(root, routes, request).await);
        }
        let routes = {
            let mut made = made.lock().unwrap_or_else(PoisonError::into_inner);
            let generation = service.generation();
            if made.0 != generation {
                *made = (generation, whole(&service));
            }
            made.1.clone()
        };
        routes.oneshot(request).await
    })
}

/// All routes of the homeworks that are served now.
fn whole(service: &Service) -> Router {
    let routes = Router::new().merge(pages::router(service)).merge(lti::router()).merge(api::router());
    layered(service.clone(), routes)
}

/// Routes with everything around them: limits, errors in their form, security headers.
pub fn layered(service: Service, routes: Router<Service>) -> Router {
    let fixed = |name: HeaderName, value: &'static str| {
        SetResponseHeaderLayer::if_not_present(name, HeaderValue::from_static(value))
    };
    routes
        .layer(DefaultBodyLimit::max(api::MAX_BODY))
        .layer(CatchPanicLayer::custom(panicked))
        .layer(axum::middleware::from_fn_with_state(service.clone(), courses::keep))
        .layer(axum::middleware::from_fn_with_state(service.clone(), acts::note))
        .layer(axum::middleware::from_fn_with_state(service.clone(), requests::attend))
        .layer(axum::middleware::from_fn_with_state(service.clone(), proxied::attend))
        .layer(axum::middleware::from_fn(errors::render))
        .layer(fixed(header::CONTENT_SECURITY_POLICY, CSP))
        .layer(fixed(header::X_CONTENT_TYPE_OPTIONS, "nosniff"))
        .layer(fixed(header::REFERRER_POLICY, "same-origin"))
        .layer(fixed(header::X_FRAME_OPTIONS, "DENY"))
        .layer(fixed(HeaderName::from_static("cross-origin-opener-policy"), "same-origin"))
        .layer(fixed(HeaderName::from_static("cross-origin-resource-policy"), "same-origin"))
        .layer(fixed(HeaderName::from_static("permissions-policy"), "camera=(), geolocation=(), microphone=()"))
        .with_state(service)
}

/// What a page may load: what this service has, and nothing inline.
const CSP: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; \
                   font-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'";

fn panicked(panic: Box<dyn std::any::Any + Send>) -> axum::response::Response {
    use axum::response::IntoResponse;
    let said = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    errors::Problem::internal(&format_args!("panic: {}", said.unwrap_or("no message"))).into_response()
}
