//! The forms by which people judge and ask, and what each of them does.

use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, Visitor};
use crate::service::judgement::{self, Handling, handle};
use crate::service::store::StoredSubmission;
use axum::Form;
use axum::extract::{Path, State as Shared};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

/// The submission with its report, for a teacher who may see it.
async fn judged(service: &Service, teacher: &Teacher, csrf: &str, id: &str) -> Result<StoredSubmission, Problem> {
    teacher.check_csrf(service, csrf)?;
    let (_, stored) = service.stored(id).await?;
    teacher.check(&stored.submission.assignment)?;
    Ok(stored)
}

/// Back to the page, with a line for the log.
fn done(stored: &StoredSubmission, text: String) -> Response {
    let submission = &stored.submission;
    let detail =
        Detail { student_id: submission.student_id.clone(), assignment: Some(submission.assignment.clone()), text };
    detail.on(back(stored))
}

/// Back to the page.
fn back(stored: &StoredSubmission) -> Response {
    Redirect::to(&format!("/r/{}#judgement", stored.submission.id)).into_response()
}

/// A refusal that leads back to the report, with what was typed.
fn refused(problem: Problem, id: &str, typed: &str) -> Problem {
    problem.of_form(&at(&format!("/r/{id}#judgement")), typed)
}

/// The form of a line of the rubric.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct OverrideForm {
    csrf: String,
    line: String,
    points: String,
    reason: String,
    /// `clear`: the grading's points count again.
    wish: String,
}

/// `POST /r/{id}/override`.
pub(in crate::service::pages) async fn override_line(
    Shared(service): Shared<Service>,
    teacher: Teacher,
    Path(id): Path<String>,
    Form(form): Form<OverrideForm>,
) -> Result<Response, Problem> {
    let stored = judged(&service, &teacher, &form.csrf, &id).await;
    let stored = stored.map_err(|problem| refused(problem, &id, &form.reason))?;
    let points = form.points.trim().parse().unwrap_or(f64::NAN);
    let given = (form.wish != "clear").then_some((points, form.reason.as_str()));
    let said = judgement::override_line(&service, &teacher, &stored, &form.line, given).await;
    let said = said.map_err(|problem| refused(problem, &id, &form.reason))?;
    Ok(said.map_or_else(|| back(&stored), |said| done(&stored, said)))
}

/// The form of a comment.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct CommentForm {
    csrf: String,
    file: String,
    line: String,
    text: String,
    /// Id of a comment that is to be removed.
    remove: String,
}

/// `POST /r/{id}/comments`.
pub(in crate::service::pages) async fn comment(
    Shared(service): Shared<Service>,
    teacher: Teacher,
    Path(id): Path<String>,
    Form(form): Form<CommentForm>,
) -> Result<Response, Problem> {
    let stored = judged(&service, &teacher, &form.csrf, &id).await;
    let stored = stored.map_err(|problem| refused(problem, &id, &form.text))?;
    if !form.remove.is_empty() {
        let removed = service.store.remove_comment(&id, &form.remove).await?;
        return Ok(if removed { done(&stored, "–".to_owned()) } else { back(&stored) });
    }
    let line = form.line.trim().parse().unwrap_or(0);
    let comment = judgement::comment(&service, &teacher, &stored, (&form.file, line), &form.text).await;
    let comment = comment.map_err(|problem| refused(problem, &id, &form.text))?;
    Ok(done(&stored, format!("{}:{}: {}", comment.file, comment.line, comment.text)))
}

/// The form by which a student asks.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct QuestionForm {
    csrf: String,
    line: String,
    question: String,
}

/// `POST /r/{id}/appeal`: a student asks for another look at a line.
pub(in crate::service::pages) async fn ask(
    Shared(service): Shared<Service>,
    visitor: Visitor,
    Path(id): Path<String>,
    Form(form): Form<QuestionForm>,
) -> Result<Response, Problem> {
    visitor.check_csrf(&service, &form.csrf).map_err(|problem| refused(problem, &id, &form.question))?;
    let (state, stored) = service.stored(&id).await?;
    let asked = judgement::ask(&state, &visitor.identity, &stored, &form.line, &form.question).await;
    asked.map_err(|problem| refused(problem, &id, &form.question))?;
    Ok(Redirect::to(&format!("/r/{id}#judgement")).into_response())
}

/// The form by which those who teach handle what was asked.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct HandlingForm {
    csrf: String,
    answer: String,
    /// `take`, `release` or `answer`.
    wish: String,
}

/// `POST /teacher/appeals/{id}`: takes, gives back or answers what a student asked.
pub(in crate::service::pages) async fn handled(
    Shared(service): Shared<Service>,
    teacher: Teacher,
    Path(id): Path<String>,
    Form(form): Form<HandlingForm>,
) -> Result<Response, Problem> {
    let appeal = service.store.appeal(&id).await?.ok_or_else(Problem::not_found)?;
    let of = &appeal.submission_id;
    let stored = judged(&service, &teacher, &form.csrf, of).await;
    let stored = stored.map_err(|problem| refused(problem, of, &form.answer))?;
    let handling = match form.wish.as_str() {
        "take" => Handling::Take,
        "release" => Handling::Release,
        _ => Handling::Answer(&form.answer),
    };
    let handled = handle(&service, &teacher, &appeal, handling).await;
    handled.map_err(|problem| refused(problem, of, &form.answer))?;
    let said = if matches!(handling, Handling::Answer(_)) { form.answer } else { form.wish };
    Ok(done(&stored, said))
}
