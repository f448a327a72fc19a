//! What students of a homework ask to be looked at again, and who is handling it.

use super::super::frame::PageFrame;
use super::super::judgement::ShownAppeal;
use super::super::shown;
use super::Tab;
use crate::service::State;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use crate::service::store::Appeal;
use askama::Template;
use axum::extract::State as Shared;
use axum::response::Response;

#[derive(Template)]
#[template(path = "service/pages/templates/appeals.html")]
struct AppealsPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    rows: Vec<AppealLine>,
}

/// What one student asks.
struct AppealLine {
    href: String,
    number: String,
    name: String,
    asked: ShownAppeal,
}

/// `GET /teacher/appeals`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let shown_name = |name: &Option<String>| name.clone().filter(|_| teacher.sees_names()).unwrap_or_default();
    let row = |appeal: Appeal| AppealLine {
        href: at(&format!("/r/{}#judgement", appeal.submission_id)),
        number: match teacher.sees_names() {
            true => appeal.number.clone().unwrap_or_default(),
            false => frame.say("A student", "学生").to_owned(),
        },
        name: shown_name(&appeal.name),
        asked: ShownAppeal::of(&state, &frame, appeal),
    };
    let rows = state.store.appeals(&state.assignment.id).await?.into_iter().map(row).collect();
    shown(AppealsPage { place: Tab::Appeals, csrf: teacher.csrf(&state), rows, frame }.render())
}
