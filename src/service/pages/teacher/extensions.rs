//! Deadlines of students and groups: all of them on one page, and the form of one student's own.

use super::super::datetime::{self, TimeElement};
use super::super::frame::PageFrame;
use super::super::shown;
use super::person::{self, Whom};
use super::{Tab, refused, said_of};
use crate::service::State;
use crate::service::acts::Detail;
use crate::service::errors::Problem;
use crate::service::extensions::{beneficiary, grant};
use crate::service::identity::{LecturerPage, Teacher};
use crate::service::store::Beneficiary;
use askama::Template;
use axum::Form;
use axum::extract::State as Shared;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/extensions.html")]
struct ExtensionsPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    /// The deadline of the class; none where there is none that could be put off.
    of_class: Option<TimeElement>,
    rows: Vec<ExtensionLine>,
    /// Groups and numbers to choose from.
    known: Vec<String>,
    typed: ExtensionForm,
    problem: Option<String>,
}

/// One deadline.
struct ExtensionLine {
    whose: String,
    name: String,
    is_group: bool,
    until: TimeElement,
    reason: String,
}

/// The form of a deadline; without a date it is taken away.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct ExtensionForm {
    csrf: String,
    /// Id of the student, on their own page.
    student: String,
    /// Number of a student, or name of a group.
    whose: String,
    pub closes: String,
    pub reason: String,
}

impl ExtensionForm {
    /// Does what the form asks for, and goes on to a page.
    async fn carry_out(
        &self,
        state: &State,
        frame: &PageFrame,
        to: &Beneficiary,
        page: &str,
    ) -> Result<Response, Problem> {
        let kept = state.store.extension(&state.assignment.id, to).await?.map(|kept| kept.closes_at);
        let closes_at = datetime::parse(&self.closes, frame.course.zone(), kept)
            .map_err(|wrong| Problem::unprocessable(wrong.en, wrong.ja))?;
        let reason = grant(state, to, closes_at, &self.reason).await?;
        let until = if closes_at.is_some() { self.closes.as_str() } else { "–" };
        let detail = match to {
            Beneficiary::Student(id) => Detail { text: format!("{until} {reason}"), ..Detail::about(id) },
            Beneficiary::Group(group) => Detail::of(format!("{group}: {until} {reason}")),
        };
        let page = datetime::with_unclear(page, &[(&self.closes, kept)], frame.course.zone());
        Ok(detail.on(Redirect::to(&page).into_response()))
    }
}

/// `GET /teacher/extensions`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view(&state, &teacher, frame, ExtensionForm::default(), None).await
}

/// `POST /teacher/extensions`: the deadline of a student or of a group.
pub(in crate::service::pages) async fn set(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
    Form(asked): Form<ExtensionForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &asked.csrf)?;
    let done = match beneficiary(&state, &asked.whose).await {
        Ok(to) => asked.carry_out(&state, &frame, &to, &format!("{}/extensions", frame.teacher())).await,
        Err(problem) => Err(problem),
    };
    match done {
        Ok(response) => Ok(response),
        Err(problem) => {
            let said = said_of(problem, &frame)?;
            Ok(refused(view(&state, &teacher, frame, asked, Some(said)).await?, StatusCode::UNPROCESSABLE_ENTITY))
        }
    }
}

/// `POST /teacher/extension`: a student's own deadline, from their page.
pub(in crate::service::pages) async fn of_student(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
    Form(asked): Form<ExtensionForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &asked.csrf)?;
    let student = state.store.student_by_id(&asked.student).await?.ok_or_else(Problem::not_found)?;
    let page = format!("{}/person?key={}", frame.teacher(), student.id);
    match asked.carry_out(&state, &frame, &Beneficiary::Student(student.id.clone()), &page).await {
        Err(problem) if problem.status == StatusCode::UNPROCESSABLE_ENTITY => {
            let wrong = problem.detail.get(frame.language).to_owned();
            let page = person::view(&state, &teacher, &Whom::of(student.id), frame, Some((asked, wrong))).await?;
            Ok(refused(page, StatusCode::UNPROCESSABLE_ENTITY))
        }
        done => done,
    }
}

async fn view(
    state: &State,
    teacher: &Teacher,
    frame: PageFrame,
    typed: ExtensionForm,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let id = &state.assignment.id;
    let of_class = state.store.assignment(id).await?.closes_at.map(|at| frame.deadline(at));
    let mut rows = Vec::new();
    for extension in state.store.extensions(id).await? {
        rows.push(ExtensionLine {
            is_group: extension.number.is_none(),
            whose: extension.number.unwrap_or(extension.key),
            name: extension.name,
            until: frame.datetime(extension.closes_at),
            reason: extension.reason,
        });
    }
    let mut known = state.store.groups().await?;
    known.extend(state.store.roster().await?.into_iter().map(|student| student.number));
    let csrf = teacher.csrf(state);
    shown(ExtensionsPage { place: Tab::Settings, csrf, of_class, rows, known, typed, problem, frame }.render())
}
