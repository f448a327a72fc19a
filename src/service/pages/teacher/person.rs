//! What one student has handed in.

use super::super::frame::Frame;
use super::super::moment::Moment;
use super::super::{part, shown, student};
use super::Place;
use super::people::people;
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use crate::service::store::ClassRow;
use askama::Template;
use axum::extract::{Query, State as Shared};
use axum::response::Response;
use serde::Deserialize;

/// Whom to show.
#[derive(Debug, Default, Deserialize)]
pub(in crate::service::pages) struct Whom {
    #[serde(default)]
    key: String,
    #[serde(default)]
    anonymous: String,
}

#[derive(Template)]
#[template(path = "service/person.html")]
struct View {
    frame: Frame,
    place: Place,
    csrf: String,
    number: String,
    name: String,
    attempts: Vec<Attempt>,
}

struct Attempt {
    href: String,
    mark: Option<&'static str>,
    word: &'static str,
    score: String,
    max_score: String,
    is_best: bool,
    portrait: Option<String>,
    mistakes: Vec<String>,
    file: String,
    at: Moment,
}

/// `GET /teacher/person?key=`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Query(whom): Query<Whom>,
    frame: Frame,
) -> Result<Response, Problem> {
    let frame = frame.of(&state.assignment.id);
    let all = people(&state, None).await?;
    let person = all.into_iter().find(|person| person.key == whom.key).ok_or_else(Problem::not_found)?;
    let best = person.best().map(|best| best.row.submission.id.clone());
    let hidden = whom.anonymous == "on";
    shown(
        View {
            place: Place::Class,
            csrf: teacher.csrf(&state),
            attempts: person.rows.iter().map(|row| attempt(&frame, row, best.as_deref(), hidden)).collect(),
            number: if hidden { frame.say("A student", "学生").to_owned() } else { person.number },
            name: if hidden { String::new() } else { person.name },
            frame,
        }
        .render(),
    )
}

fn attempt(frame: &Frame, row: &ClassRow, best: Option<&str>, hidden: bool) -> Attempt {
    let submission = &row.row.submission;
    Attempt {
        href: format!("/r/{}", submission.id),
        mark: row.row.verdict.map(|verdict| student::mark(verdict, row.row.score).id()),
        word: row
            .row
            .verdict
            .map_or_else(|| frame.say("Being graded", "採点中"), |verdict| part::verdict(frame, verdict)),
        score: part::points(row.row.score),
        max_score: part::points(row.row.max_score),
        is_best: best == Some(submission.id.as_str()),
        portrait: student::draws(row.row.verdict).then(|| format!("/r/{}/portrait.png", submission.id)),
        mistakes: row.mistakes.clone(),
        file: if hidden { String::new() } else { submission.name.clone() },
        at: Moment::of(submission.received_at, frame.language),
    }
}
