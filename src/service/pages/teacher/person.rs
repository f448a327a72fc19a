//! What one student has handed in.

use super::super::attempts::{Attempt, CountingChoice};
use super::super::datetime::TimeElement;
use super::super::frame::PageFrame;
use super::super::shown;
use super::Tab;
use super::extensions::ExtensionForm;
use super::table::titled;
use crate::service::State;
use crate::service::acts::Detail;
use crate::service::classes::people;
use crate::service::clock::local_minute;
use crate::service::counting;
use crate::service::errors::Problem;
use crate::service::identity::{LecturerPage, Teacher, TeacherPage};
use crate::service::store::{Beneficiary, ClassRow};
use askama::Template;
use axum::Form;
use axum::extract::{Query, State as Shared};
use axum::response::{IntoResponse, Redirect, Response};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use serde::Deserialize;

/// Whom to show.
#[derive(Debug, Default, Deserialize)]
pub(in crate::service::pages) struct Whom {
    #[serde(default)]
    key: String,
    #[serde(default)]
    anonymous: String,
}

impl Whom {
    /// The one with this key.
    pub(super) fn of(key: String) -> Self {
        Self { key, ..Self::default() }
    }
}

#[derive(Template)]
#[template(path = "service/pages/templates/person.html")]
struct PersonPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    number: String,
    name: String,
    group: String,
    attempts: Vec<Attempt>,
    choose: String,
    deletable: bool,
    note: Option<String>,
    key: Option<String>,
    /// The deadline of a student; none where there is none that could be put off.
    deadline: Option<Deadline>,
}

/// The deadline of the homework, and a student's own as its form takes it.
struct Deadline {
    of_class: TimeElement,
    /// That of their group, where it has one.
    of_group: Option<GroupDeadline>,
    /// Id of the student.
    student: String,
    own: String,
    reason: String,
    problem: Option<String>,
}

/// The later deadline of a group.
struct GroupDeadline {
    group: String,
    until: TimeElement,
    reason: String,
}

/// `GET /teacher/person?key=`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Query(whom): Query<Whom>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view(&state, &teacher, &whom, frame, None).await
}

/// The form by which an attempt is chosen.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct CountedAttemptForm {
    csrf: String,
    submission: String,
}

/// `POST /teacher/choice`: lets an attempt count.
pub(in crate::service::pages) async fn choose(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
    Form(chosen): Form<CountedAttemptForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &chosen.csrf)?;
    let (_, submission) = state.submission(&chosen.submission).await?;
    teacher.check(&submission.assignment)?;
    counting::choose(&state, &submission).await?;
    let key = submission.student_id.clone().or(submission.owner_id).unwrap_or(submission.id);
    let page = format!("{}/person?key={}", frame.teacher(), utf8_percent_encode(&key, NON_ALPHANUMERIC));
    let detail = Detail { student_id: submission.student_id, ..Detail::default() };
    Ok(detail.on(Redirect::to(&page).into_response()))
}

/// The deadline of somebody who is a student, with what was typed and is wrong.
async fn deadline(
    state: &State,
    frame: &PageFrame,
    key: &str,
    typed: Option<(ExtensionForm, String)>,
) -> Result<Option<Deadline>, Problem> {
    let id = &state.assignment.id;
    let closes = state.store.assignment(id).await?.closes_at;
    let student = state.store.student_by_id(key).await?;
    let (Some(closes), Some(student)) = (closes, student) else { return Ok(None) };
    let kept = state.store.extension(id, &Beneficiary::Student(student.id.clone())).await?;
    let (own, reason, problem) = match (typed, kept) {
        (Some((asked, wrong)), _) => (asked.closes, asked.reason, Some(wrong)),
        (None, Some(kept)) => (local_minute(kept.closes_at, frame.course.zone()), kept.reason, None),
        (None, None) => (String::new(), String::new(), None),
    };
    let of_group = group_deadline(state, frame, student.group_name).await?;
    Ok(Some(Deadline { of_class: frame.deadline(closes), of_group, student: student.id, own, reason, problem }))
}

async fn group_deadline(state: &State, frame: &PageFrame, group: String) -> Result<Option<GroupDeadline>, Problem> {
    let kept = state.store.extension(&state.assignment.id, &Beneficiary::Group(group.clone())).await?;
    Ok(kept.map(|kept| GroupDeadline { group, until: frame.deadline(kept.closes_at), reason: kept.reason }))
}

/// The page, with a form that was refused.
pub(super) async fn view(
    state: &State,
    teacher: &Teacher,
    whom: &Whom,
    frame: PageFrame,
    typed: Option<(ExtensionForm, String)>,
) -> Result<Response, Problem> {
    let people = people(state).await?;
    let person = people.all().find(|person| person.key == whom.key).cloned().ok_or_else(Problem::not_found)?;
    let counted = person.counted().map(|row| row.row.submission.id.as_str());
    let hidden = whom.anonymous == "on" || !teacher.sees_names();
    let group = state.store.student_by_id(&person.key).await?.map(|student| student.group_name).unwrap_or_default();
    let choice = CountingChoice { counting: person.counting, counted, may_choose: frame.is_lecturers() && !hidden };
    shown(
        PersonPage {
            place: Tab::Class,
            deadline: if hidden { None } else { deadline(state, &frame, &person.key, typed).await? },
            csrf: teacher.csrf(state),
            attempts: person.rows.iter().map(|row| attempt(&frame, row, choice, hidden)).collect(),
            choose: format!("{}/choice", frame.teacher()),
            deletable: frame.is_lecturers() && !hidden,
            group: if hidden { String::new() } else { group },
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

fn attempt(frame: &PageFrame, row: &ClassRow, choice: CountingChoice<'_>, hidden: bool) -> Attempt {
    Attempt {
        mistakes: titled(frame, &row.mistakes),
        is_disputed: row.differs,
        file: if hidden { String::new() } else { row.row.submission.name.clone() },
        ..Attempt::of(frame, &row.row, choice)
    }
}
