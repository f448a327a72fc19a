//! Deleting, after a page that says what goes.

use super::super::frame::PageFrame;
use super::super::shown;
use super::{Tab, batches};
use crate::service::State;
use crate::service::classes::people;
use crate::service::courses::at;
use crate::service::deletion;
use crate::service::errors::Problem;
use crate::service::identity::LecturerPage;
use crate::service::store::{DeletionTarget, Submission};
use askama::Template;
use axum::Form;
use axum::extract::{Query, State as Shared};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/delete.html")]
struct DeletePage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    chosen: DeletionForm,
    heading: &'static str,
    /// What it is, as the teacher knows it.
    name: String,
    counts: Vec<String>,
    back: String,
}

/// What is to be deleted: one of the three.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct DeletionForm {
    csrf: String,
    submission: String,
    batch: String,
    /// Key of somebody of the class table.
    person: String,
}

/// What was chosen, found.
struct FoundTarget {
    target: DeletionTarget,
    heading: &'static str,
    name: String,
    /// The page that it is on.
    back: String,
    is_on_roster: bool,
}

async fn found(state: &State, frame: &PageFrame, chosen: &DeletionForm) -> Result<FoundTarget, Problem> {
    if !chosen.submission.is_empty() {
        return found_submission(state, frame, &chosen.submission).await;
    }
    if !chosen.batch.is_empty() {
        let batch = batches::found(state, &chosen.batch).await?;
        return Ok(FoundTarget {
            heading: frame
                .say("Delete this archive with everything in it?", "このアーカイブと中の提出をすべて削除しますか?"),
            name: format!("{} · {}", batch.title, frame.datetime(batch.created_at).text),
            back: format!("{}/batches/{}", frame.teacher(), batch.id),
            target: DeletionTarget::Batch(batch.id),
            is_on_roster: false,
        });
    }
    let people = people(state).await?;
    let person = people.all().find(|person| person.key == chosen.person).ok_or_else(Problem::not_found)?;
    if person.is_anonymous {
        return found_submission(state, frame, &person.key).await;
    }
    let student = state.store.student_by_id(&person.key).await?;
    let key = percent_encoding::utf8_percent_encode(&person.key, percent_encoding::NON_ALPHANUMERIC);
    Ok(FoundTarget {
        heading: frame.say("Delete this student with everything of theirs?", "この学生のデータをすべて削除しますか?"),
        name: match format!("{} {}", person.number, person.name).trim() {
            "" => frame.say("no number", "番号なし").to_owned(),
            name => name.to_owned(),
        },
        back: format!("{}/person?key={key}", frame.teacher()),
        is_on_roster: student.as_ref().is_some_and(|student| student.is_on_roster()),
        target: match (&student, person.key.split_once('/')) {
            (Some(student), _) => DeletionTarget::Student(student.id.clone()),
            (None, Some((batch, position))) => {
                DeletionTarget::Entry(batch.to_owned(), position.parse().map_err(|_| Problem::not_found())?)
            }
            (None, None) => DeletionTarget::Browser(person.key.clone()),
        },
    })
}

/// One file: also where a file is all that is known of somebody.
async fn found_submission(state: &State, frame: &PageFrame, id: &str) -> Result<FoundTarget, Problem> {
    let of_this = |submission: &Submission| submission.assignment == state.assignment.id;
    let submission = state.store.submission(id).await?.filter(of_this).ok_or_else(Problem::not_found)?;
    Ok(FoundTarget {
        heading: frame.say("Delete this submission?", "この提出を削除しますか?"),
        name: format!("{} · {}", submission.name, frame.datetime(submission.received_at).text),
        back: at(&format!("/r/{}", submission.id)),
        target: DeletionTarget::Submission(submission.id),
        is_on_roster: false,
    })
}

/// `GET /teacher/delete?submission=`, `batch=` or `person=`: what would go.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    Query(chosen): Query<DeletionForm>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let found = found(&state, &frame, &chosen).await?;
    teacher.may_delete(&found.target)?;
    let mut counts = state.store.count(&found.target).await?.said(frame.language);
    if found.is_on_roster {
        counts.push(frame.say("the line of the roster", "名簿の行").to_owned());
    }
    let csrf = teacher.csrf(&state);
    let (heading, name, back) = (found.heading, found.name, found.back);
    shown(DeletePage { frame, place: Tab::Class, csrf, chosen, heading, name, counts, back }.render())
}

/// `POST /teacher/delete`.
pub(in crate::service::pages) async fn delete(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
    Form(chosen): Form<DeletionForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &chosen.csrf)?;
    let found = found(&state, &frame, &chosen).await?;
    teacher.may_delete(&found.target)?;
    let counts = deletion::delete(&state, &found.target).await?;
    let answer = Redirect::to(&format!("{}?done=deleted", frame.teacher())).into_response();
    Ok(deletion::detail(&found.target, &counts).on(answer))
}
