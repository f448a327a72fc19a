//! What one student has handed in.

use super::super::datetime::Moment;
use super::super::frame::Frame;
use super::super::{report_fragment, shown, student};
use super::Tab;
use super::table::titled;
use crate::service::State;
use crate::service::classes::people;
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
#[template(path = "service/pages/templates/person.html")]
struct PersonPage {
    frame: Frame,
    place: Tab,
    csrf: String,
    number: String,
    name: String,
    attempts: Vec<Attempt>,
    note: Option<String>,
    key: Option<String>,
}

struct Attempt {
    id: String,
    mark: Option<&'static str>,
    word: &'static str,
    score: String,
    max_score: String,
    is_best: bool,
    portrait: Option<String>,
    /// Title and id.
    mistakes: Vec<(String, String)>,
    is_disputed: bool,
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
    let people = people(&state).await?;
    let person = people.all().find(|person| person.key == whom.key).cloned().ok_or_else(Problem::not_found)?;
    let best = person.best().map(|best| best.row.submission.id.clone());
    let hidden = whom.anonymous == "on";
    shown(
        PersonPage {
            place: Tab::Class,
            csrf: teacher.csrf(&state),
            attempts: person.rows.iter().map(|row| attempt(&frame, row, best.as_deref(), hidden)).collect(),
            note: person.note.as_ref().map(|note| note.get(frame.language).replace('`', "")),
            // A deletion shows who it is.
            key: (!hidden).then(|| person.key.clone()),
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
        id: submission.id.clone(),
        mark: row.row.verdict.map(|verdict| student::mark(verdict, row.row.score).id()),
        word: row
            .row
            .verdict
            .map_or_else(|| frame.say("Being graded", "採点中"), |verdict| report_fragment::verdict(frame, verdict)),
        score: report_fragment::points(row.row.score),
        max_score: report_fragment::points(row.row.max_score),
        is_best: best == Some(submission.id.as_str()),
        portrait: student::draws(row.row.verdict).then(|| frame.picture(&submission.id, "portrait")),
        mistakes: titled(frame, &row.mistakes),
        is_disputed: row.differs,
        file: if hidden { String::new() } else { submission.name.clone() },
        at: frame.moment(submission.received_at),
    }
}
