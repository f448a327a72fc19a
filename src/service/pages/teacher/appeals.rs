//! What students of a homework ask to be looked at again, and who is handling it.

use super::super::frame::Frame;
use super::super::judgement::ShownAppeal;
use super::super::shown;
use super::Tab;
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use crate::service::store::Appeal;
use askama::Template;
use axum::extract::State as Shared;
use axum::response::Response;

#[derive(Template)]
#[template(path = "service/pages/templates/appeals.html")]
struct AppealsPage {
    frame: Frame,
    place: Tab,
    csrf: String,
    rows: Vec<Row>,
}

/// What one student asks.
struct Row {
    href: String,
    number: String,
    name: String,
    asked: ShownAppeal,
}

/// `GET /teacher/appeals`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    frame: Frame,
) -> Result<Response, Problem> {
    let row = |appeal: Appeal| Row {
        href: format!("/r/{}#judgement", appeal.submission_id),
        number: appeal.number.clone().unwrap_or_default(),
        name: appeal.name.clone().unwrap_or_default(),
        asked: ShownAppeal::of(&state, &frame, appeal),
    };
    let rows = state.store.appeals(&state.assignment.id).await?.into_iter().map(row).collect();
    shown(AppealsPage { place: Tab::Appeals, csrf: teacher.csrf(&state), rows, frame }.render())
}
