//! Grading everything again, and what that would change.

use super::super::datetime::TimeElement;
use super::super::frame::PageFrame;
use super::super::{report_fragment, shown};
use super::Tab;
use super::login::CsrfForm;
use super::pager::Pager;
use super::table::titled;
use crate::report::html::Mark;
use crate::report::labels::rubric_label;
use crate::report::text::number;
use crate::service::State;
use crate::service::api::batches::{WatchedJob, progress};
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::{LecturerPage, TeacherPage};
use crate::service::regrade::{self, SAME_POINTS};
use crate::service::store::{Compared, OverriddenAgain, Progress};
use askama::Template;
use axum::Form;
use axum::extract::{Path, Query, State as Shared};
use axum::response::sse::{KeepAlive, Sse};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/regrading.html")]
struct RegradingsPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    at: TimeElement,
    id: String,
    seed: u64,
    events: String,
    progress: Progress,
    is_adopted: bool,
    gains: usize,
    losses: usize,
    otherwise: usize,
    same: usize,
    rows: Vec<RegradedLine>,
    pager: Pager,
    /// Lines that somebody overrode, and that are graded otherwise now.
    overridden: Vec<OverriddenLine>,
}

/// A line that somebody overrode.
struct OverriddenLine {
    href: String,
    number: String,
    label: String,
    given: String,
    reason: String,
    author: String,
    graded: String,
    again: String,
}

/// One submission that changed.
struct RegradedLine {
    href: String,
    number: String,
    name: String,
    before: SubmissionResult,
    after: Option<SubmissionResult>,
    change: String,
}

/// What a submission got.
struct SubmissionResult {
    mark: &'static str,
    word: &'static str,
    score: String,
    /// Title and id.
    mistakes: Vec<(String, String)>,
}

/// The form of the button.
#[derive(Debug, Default, Deserialize)]
pub(in crate::service::pages) struct RegradingForm {
    #[serde(default)]
    csrf: String,
    #[serde(default)]
    new_seed: String,
}

/// The page of the table.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct RegradingQuery {
    page: String,
}

/// `POST /teacher/regradings`: begins.
pub(in crate::service::pages) async fn start(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    Form(wish): Form<RegradingForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &wish.csrf)?;
    let regrading = regrade::start(&state, wish.new_seed == "on", None).await?;
    Ok(Redirect::to(&format!("{}/teacher/regradings/{}", state.base(), regrading.id)).into_response())
}

/// `POST /teacher/regradings/{id}`: adopts.
pub(in crate::service::pages) async fn adopt(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    Path(id): Path<String>,
    Form(token): Form<CsrfForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &token.csrf)?;
    regrade::adopt(&state, &id).await?;
    Ok(Redirect::to(&format!("{}/teacher/regradings/{id}", state.base())).into_response())
}

/// `GET /teacher/regradings/{id}/events`.
pub(in crate::service::pages) async fn events(
    Shared(state): Shared<State>,
    _: TeacherPage,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    regrade::found(&state, &id).await?;
    Ok(Sse::new(progress(state.service(), WatchedJob::Regrading(id))).keep_alive(KeepAlive::default()).into_response())
}

/// `GET /teacher/regradings/{id}`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
    Query(RegradingQuery { page }): Query<RegradingQuery>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let regrading = regrade::found(&state, &id).await?;
    let compared = state.store.compared(&id).await?;
    let differs = |row: &&Compared| row.after.as_ref().is_some_and(|after| regrade::differs(&row.before, after));
    let points = |row: &Compared| row.after.as_ref().map_or(0.0, |after| after.1 - row.before.1);
    let count = |test: fn(f64) -> bool| compared.iter().filter(|row| test(points(row))).count();
    let (gains, losses) = (count(|points| points > SAME_POINTS), count(|points| points < -SAME_POINTS));
    let changed: Vec<&Compared> = compared.iter().filter(differs).collect();
    let changes = changed.len();
    let pager = Pager::new(changes, &page, |page| format!("?page={page}"));
    shown(
        RegradingsPage {
            place: Tab::Batches,
            csrf: teacher.csrf(&state),
            at: frame.datetime(regrading.created_at),
            seed: regrading.seed,
            events: format!("{}/regradings/{id}/events", frame.teacher()),
            progress: state.store.regrading_progress(&id).await?,
            is_adopted: regrading.adopted_at.is_some(),
            gains,
            losses,
            otherwise: changes.saturating_sub(gains + losses),
            same: compared.iter().filter(|row| row.after.is_some()).count() - changes,
            overridden: state
                .store
                .overridden_again(&id)
                .await?
                .into_iter()
                .filter(OverriddenAgain::is_changed)
                .map(|line| overridden(&state, &frame, &compared, line))
                .collect(),
            rows: pager.of(&changed).iter().map(|row| line(&frame, row)).collect(),
            pager,
            id,
            frame,
        }
        .render(),
    )
}

fn line(frame: &PageFrame, row: &Compared) -> RegradedLine {
    let got = |(verdict, score, mistakes): &regrade::Earned| SubmissionResult {
        mark: Mark::of_verdict(*verdict, *score).id(),
        word: report_fragment::verdict(frame, *verdict),
        score: number(*score),
        mistakes: titled(frame, mistakes),
    };
    RegradedLine {
        href: at(&format!("/r/{}", row.submission.id)),
        number: row.number.clone().unwrap_or_else(|| row.submission.name.clone()),
        name: row.student_name.clone().unwrap_or_default(),
        before: got(&row.before),
        after: row.after.as_ref().map(got),
        change: row.after.as_ref().map_or_else(String::new, |after| signed(after.1 - row.before.1)),
    }
}

/// A line that somebody overrode, and what it gets now.
fn overridden(state: &State, frame: &PageFrame, compared: &[Compared], line: OverriddenAgain) -> OverriddenLine {
    let (given, again) = (given(&line), line.again);
    let overridden = line.overridden;
    let row = compared.iter().find(|row| row.submission.id == overridden.submission_id);
    let number_of = |row: &Compared| row.number.clone().unwrap_or_else(|| row.submission.name.clone());
    OverriddenLine {
        href: at(&format!("/r/{}#judgement", overridden.submission_id)),
        number: row.map(number_of).unwrap_or_default(),
        label: rubric_label(&state.assignment, &overridden.line, frame.language).to_owned(),
        given,
        reason: overridden.reason,
        author: overridden.author.unwrap_or_default(),
        graded: number(overridden.graded),
        again: again.map_or_else(|| frame.say("no such line", "項目なし").to_owned(), |again| number(again.graded)),
    }
}

/// What somebody gave, and what becomes of it where the line changes: `35`, `35 / 40 → 17.5 / 20`, `35 / 40 → –`.
fn given(line: &OverriddenAgain) -> String {
    let before = &line.overridden;
    let of = |points: f64, most: f64| format!("{} / {}", number(points), number(most));
    let was = before.most.map_or_else(|| number(before.points), |most| of(before.points, most));
    match (line.again, line.points()) {
        (Some(again), Some(points)) if before.is_changed(again.most) => format!("{was} → {}", of(points, again.most)),
        (Some(_), _) => number(before.points),
        (None, _) => format!("{was} → –"),
    }
}

/// A difference of points, with its sign.
fn signed(points: f64) -> String {
    let sign = if points > SAME_POINTS { "+" } else { "" };
    format!("{sign}{}", number(points))
}
