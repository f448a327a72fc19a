//! The teacher's pages, behind the login.
//!
//! [`class`] is the table of everyone with its filters and [`charts`], [`person`] what one student handed in, [`batches`]
//! whole archives and downloads, [`regradings`] grading again with a comparison, [`settings`] dates, limits, hints and the
//! course link, [`roster`] the list of students, [`login`] the way in.

mod batches;
mod charts;
mod class;
mod login;
mod people;
mod person;
mod regradings;
mod roster;
mod settings;

use crate::service::State;
use axum::Router;
use axum::extract::DefaultBodyLimit;
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
        .route("/teacher/roster", post(roster::take))
        .route("/teacher/batches", get(batches::list).post(batches::upload).layer(DefaultBodyLimit::disable()))
        .route("/teacher/batches/{id}", get(batches::one))
        .route("/teacher/batches/{id}/worksheet", post(batches::worksheet))
        .route("/teacher/regradings", post(regradings::start))
        .route("/teacher/regradings/{id}", get(regradings::page).post(regradings::adopt))
        .route("/teacher/regradings/{id}/events", get(regradings::events))
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
