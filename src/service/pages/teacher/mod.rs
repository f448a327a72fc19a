//! The teacher's pages, behind the login.
//!
//! [`class`] is the table of everyone with its filters and charts, [`person`] what one student handed in, [`settings`]
//! dates, limits, hints and the course link, [`login`] the way in.

mod charts;
mod class;
mod login;
mod people;
mod person;
mod settings;

use crate::service::State;
use axum::Router;
use axum::routing::{get, post};

/// The routes.
pub(super) fn router() -> Router<State> {
    Router::new()
        .route("/teacher", get(class::page))
        .route("/teacher/login", get(login::page).post(login::login))
        .route("/teacher/logout", post(login::logout))
        .route("/teacher/person", get(person::page))
        .route("/teacher/settings", get(settings::page).post(settings::save))
        .route("/teacher/settings/link", post(settings::renew))
        .route("/teacher/roster", post(settings::roster))
}

/// Where a page stands among the teacher's, for its navigation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// The class.
    Class,
    /// Archives.
    Batches,
    /// Settings.
    Settings,
}
