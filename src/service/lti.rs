//! LTI 1.3 and its services (Advantage): a learning platform vouches for who comes, and grades go home.
//!
//! [`login`] begins a launch and [`launch`] takes what the platform vouches for ([`claims`]); [`people`] says who that is
//! here, [`number`] asks them where that is not sure, [`roles`] what they may do, and [`contexts`] in which course; [`known`] gathers what is known of each platform. [`deep_linking`] lets a lecturer choose a homework, [`registration`] makes a platform and this service known to each
//! other, [`scores`] sends grades, [`memberships`] fetches the roster, [`keys`] are those with which this service signs,
//! [`platform`] asks a platform.

mod claims;
pub mod contexts;
pub mod deep_linking;
mod keys;
pub mod known;
mod launch;
mod login;
pub mod memberships;
mod next_page;
pub mod number;
mod people;
mod platform;
pub mod registration;
mod roles;
pub mod scores;

pub use platform::Connections;
pub(super) use platform::checked;

use super::Service;
use super::errors::Problem;
use axum::Router;
use axum::routing::{get, post};

/// The routes of launches, which are among the pages.
pub fn launches() -> Router<Service> {
    Router::new()
        .route("/lti/login", get(login::by_link).post(login::by_form))
        .route("/lti/launch", post(launch::launch))
        .route("/lti/number", post(number::answered))
}

/// What platforms themselves ask for.
pub fn router() -> Router<Service> {
    Router::new().route("/lti/jwks.json", get(keys::published))
}

/// Where others reach this service, or a course of it. Without a configured address nothing is sent that names one.
pub fn address(service: &Service) -> Result<String, Problem> {
    let host = service.config.public_url.as_deref().ok_or_else(|| {
        Problem::unprocessable(
            "The service does not know by which address others reach it. Start it with --public-url (public_url in the \
             configuration) first.",
            "このサービスの公開アドレスが設定されていません。先に --public-url（設定ファイルでは public_url）を指定して起動してください。",
        )
    })?;
    Ok(format!("{}{}", host.trim_end_matches('/'), service.root()))
}

/// A refusal of what a platform sent, which says what is wrong with it.
fn refused(en: impl Into<String>, ja: impl Into<String>) -> Problem {
    Problem::new(axum::http::StatusCode::FORBIDDEN, "lti", en, ja)
}
