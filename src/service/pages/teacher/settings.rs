//! Dates, limits, hints, who may hand in; the course link.

use super::super::frame::Frame;
use super::super::moment;
use super::super::shown;
use super::Place;
use super::login::Token;
use crate::diagnose::Hints;
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::identity::{self, TeacherPage};
use crate::service::store::{Assignment, Audience};
use askama::Template;
use axum::Form;
use axum::extract::{Query, State as Shared};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/settings.html")]
struct View {
    frame: Frame,
    place: Place,
    csrf: String,
    notice: Option<&'static str>,
    problem: Option<String>,
    opens: String,
    closes: String,
    zone: String,
    attempts: String,
    hints: &'static str,
    audience: &'static str,
    practice: bool,
    link: String,
    students: usize,
}

/// The form of the page.
#[derive(Debug, Default, Deserialize)]
pub(in crate::service::pages) struct Given {
    #[serde(default)]
    csrf: String,
    #[serde(default)]
    opens: String,
    #[serde(default)]
    closes: String,
    #[serde(default)]
    attempts: String,
    #[serde(default)]
    hints: String,
    #[serde(default)]
    audience: String,
    /// A box that is not ticked is not sent.
    #[serde(default)]
    practice: String,
}

/// What has just been done.
#[derive(Debug, Default, Deserialize)]
pub(in crate::service::pages) struct Done {
    #[serde(default)]
    done: String,
}

fn hints_word(hints: Hints) -> &'static str {
    match hints {
        Hints::None => "none",
        Hints::Gentle => "gentle",
        Hints::Full => "full",
    }
}

fn audience_word(audience: Audience) -> &'static str {
    match audience {
        Audience::Open => "open",
        Audience::Number => "number",
    }
}

/// `GET /teacher/settings`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Query(done): Query<Done>,
    headers: HeaderMap,
    frame: Frame,
) -> Result<Response, Problem> {
    let settings = state.store.assignment(&state.assignment.id).await?;
    let given = Given {
        opens: settings.opens_at.map(moment::field).unwrap_or_default(),
        closes: settings.closes_at.map(moment::field).unwrap_or_default(),
        attempts: settings.attempts.map(|attempts| attempts.to_string()).unwrap_or_default(),
        hints: hints_word(settings.hints).to_owned(),
        audience: audience_word(settings.audience).to_owned(),
        practice: if settings.practice { "on".to_owned() } else { String::new() },
        csrf: teacher.csrf(&state),
    };
    let notice = match done.done.as_str() {
        "saved" => Some(frame.say("Saved.", "保存しました。")),
        "link" => Some(frame.say("The old link opens nothing any more.", "以前のリンクは無効になりました。")),
        "roster" => Some(frame.say("The roster is taken over.", "名簿を登録しました。")),
        _ => None,
    };
    shown(view(&state, frame, &host(&state, &headers), given, notice, None).await?.render())
}

/// The name by which the teacher's own browser knows the service.
fn host(state: &State, headers: &HeaderMap) -> String {
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok());
    host.map_or_else(|| state.config.listen.to_string(), str::to_owned)
}

async fn view(
    state: &State,
    frame: Frame,
    host: &str,
    given: Given,
    notice: Option<&'static str>,
    problem: Option<String>,
) -> Result<View, Problem> {
    let public = state.config.public_url.clone().unwrap_or_else(|| format!("http://{host}"));
    let students = state.store.students().await?;
    Ok(View {
        frame,
        place: Place::Settings,
        csrf: given.csrf,
        notice,
        problem,
        opens: given.opens,
        closes: given.closes,
        zone: moment::zone(),
        attempts: given.attempts,
        hints: hints_word(read_hints(&given.hints)),
        audience: audience_word(read_audience(&given.audience)),
        practice: !given.practice.is_empty(),
        link: format!("{}/join/{}", public.trim_end_matches('/'), identity::course_secret(state).await?),
        students: students.iter().filter(|student| student.on_roster != 0).count(),
    })
}

fn read_hints(word: &str) -> Hints {
    match word {
        "none" => Hints::None,
        "gentle" => Hints::Gentle,
        _ => Hints::Full,
    }
}

fn read_audience(word: &str) -> Audience {
    if word == "number" { Audience::Number } else { Audience::Open }
}

/// `POST /teacher/settings`.
pub(in crate::service::pages) async fn save(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    headers: HeaderMap,
    frame: Frame,
    Form(mut given): Form<Given>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &given.csrf)?;
    let before = state.store.assignment(&state.assignment.id).await?;
    match read(&frame, before, &given) {
        Ok(settings) => {
            state.store.set_assignment(&settings).await?;
            Ok(Redirect::to("/teacher/settings?done=saved").into_response())
        }
        Err(problem) => {
            given.csrf = teacher.csrf(&state);
            let host = host(&state, &headers);
            shown(view(&state, frame, &host, given, None, Some(problem.to_owned())).await?.render())
        }
    }
}

fn read(frame: &Frame, before: Assignment, given: &Given) -> Result<Assignment, &'static str> {
    let date = |field: &str| {
        moment::parse(field).map_err(|_| {
            frame.say("A date has the form 2026-12-31T23:59.", "日時は 2026-12-31T23:59 の形で入力してください。")
        })
    };
    let attempts = match given.attempts.trim() {
        "" => None,
        number => Some(number.parse().ok().filter(|number| *number > 0).ok_or(frame.say(
            "Attempts: a whole number above 0, or nothing.",
            "提出回数は 1 以上の整数で入力するか、空欄にしてください。",
        ))?),
    };
    let (opens_at, closes_at) = (date(&given.opens)?, date(&given.closes)?);
    if let (Some(opens), Some(closes)) = (opens_at, closes_at)
        && closes <= opens
    {
        return Err(frame.say("The end must come after the beginning.", "終了日時は開始日時より後にしてください。"));
    }
    let (hints, audience) = (read_hints(&given.hints), read_audience(&given.audience));
    let practice = !given.practice.is_empty();
    Ok(Assignment { opens_at, closes_at, attempts, hints, audience, practice, ..before })
}

/// `POST /teacher/settings/link`: a new course link.
pub(in crate::service::pages) async fn renew(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Form(token): Form<Token>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &token.csrf)?;
    identity::renew_course_secret(&state).await?;
    Ok(Redirect::to("/teacher/settings?done=link").into_response())
}
