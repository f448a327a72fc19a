//! What one student has handed in.

use super::super::datetime::{self, Moment};
use super::super::frame::Frame;
use super::super::{report_fragment, shown, student};
use super::table::titled;
use super::{Tab, refused};
use crate::service::State;
use crate::service::acts::Detail;
use crate::service::classes::people;
use crate::service::errors::Problem;
use crate::service::identity::{LecturerPage, Teacher, TeacherPage};
use crate::service::store::{ClassRow, Extension};
use askama::Template;
use axum::Form;
use axum::extract::{Query, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Redirect, Response};
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
    /// The deadline of a student; none where there is none that could be put off.
    deadline: Option<Deadline>,
}

/// The deadline of the homework, and a student's own as its form takes it.
struct Deadline {
    of_class: Moment,
    /// Id of the student.
    student: String,
    own: String,
    reason: String,
    problem: Option<String>,
}

/// The form of a student's own deadline; without a date it is taken away.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct OwnDeadline {
    csrf: String,
    student: String,
    closes: String,
    reason: String,
}

/// Longest reason, in characters.
const LONGEST_REASON: usize = 500;

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
    view(&state, &teacher, &whom, frame, None).await
}

/// `POST /teacher/extension`: a student's own deadline.
pub(in crate::service::pages) async fn extend(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    frame: Frame,
    Form(asked): Form<OwnDeadline>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &asked.csrf)?;
    let id = &state.assignment.id;
    let student = state.store.student_by_id(&asked.student).await?.ok_or_else(Problem::not_found)?;
    let of_class = state.store.assignment(id).await?.closes_at;
    let wrong = match datetime::parse(&asked.closes, frame.course.zone()) {
        Ok(Some(own)) if of_class.is_none_or(|class| own <= class) => frame.say(
            "An extension ends after the deadline of the class; without a date it is taken away.",
            "延長後の締切は、クラスの締切より後にしてください。空欄にすると延長を取り消します。",
        ),
        Ok(own) => {
            let reason: String = asked.reason.trim().chars().take(LONGEST_REASON).collect();
            let own = own.map(|closes_at| Extension { closes_at, reason: reason.clone() });
            state.store.set_extension(id, &student.id, own.as_ref()).await?;
            let until = if own.is_some() { asked.closes.as_str() } else { "–" };
            let answer = Redirect::to(&format!("{}/person?key={}", frame.teacher(), student.id)).into_response();
            return Ok(Detail { text: format!("{until} {reason}"), ..Detail::about(&student.id) }.on(answer));
        }
        Err(_) => {
            frame.say("A date has the form 2026-12-31T23:59.", "日時は 2026-12-31T23:59 の形で入力してください。")
        }
    };
    let whom = Whom { key: student.id, ..Whom::default() };
    let page = view(&state, &teacher, &whom, frame, Some((asked, wrong.to_owned()))).await?;
    Ok(refused(page, StatusCode::UNPROCESSABLE_ENTITY))
}

/// The deadline of somebody who is a student, with what was typed and is wrong.
async fn deadline(
    state: &State,
    frame: &Frame,
    key: &str,
    typed: Option<(OwnDeadline, String)>,
) -> Result<Option<Deadline>, Problem> {
    let id = &state.assignment.id;
    let closes = state.store.assignment(id).await?.closes_at;
    let student = state.store.student_by_id(key).await?;
    let (Some(closes), Some(student)) = (closes, student) else { return Ok(None) };
    let kept = state.store.extension(id, &student.id).await?;
    let (own, reason, problem) = match (typed, kept) {
        (Some((asked, wrong)), _) => (asked.closes, asked.reason, Some(wrong)),
        (None, Some(kept)) => (datetime::field(kept.closes_at, frame.course.zone()), kept.reason, None),
        (None, None) => (String::new(), String::new(), None),
    };
    Ok(Some(Deadline { of_class: frame.deadline(closes), student: student.id, own, reason, problem }))
}

/// The page, with a form that was refused.
async fn view(
    state: &State,
    teacher: &Teacher,
    whom: &Whom,
    frame: Frame,
    typed: Option<(OwnDeadline, String)>,
) -> Result<Response, Problem> {
    let people = people(state).await?;
    let person = people.all().find(|person| person.key == whom.key).cloned().ok_or_else(Problem::not_found)?;
    let best = person.best().map(|best| best.row.submission.id.clone());
    let hidden = whom.anonymous == "on";
    shown(
        PersonPage {
            place: Tab::Class,
            deadline: if hidden { None } else { deadline(state, &frame, &person.key, typed).await? },
            csrf: teacher.csrf(state),
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
