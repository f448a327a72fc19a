//! Dates, limits, hints, who may hand in; the course link and the roster.

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
use axum::extract::{Multipart, Query, State as Shared};
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
    Ok(Assignment { opens_at, closes_at, attempts, hints, audience, ..before })
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

/// `POST /teacher/roster`: a CSV file of student numbers and names.
pub(in crate::service::pages) async fn roster(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    mut form: Multipart,
) -> Result<Response, Problem> {
    let broken = |_| Problem::bad_request("The upload arrived incomplete.", "アップロードが途中で切れました。");
    let (mut csrf, mut bytes) = (String::new(), Vec::new());
    while let Some(field) = form.next_field().await.map_err(broken)? {
        match field.name().unwrap_or_default() {
            "csrf" => csrf = field.text().await.map_err(broken)?,
            "roster" => bytes = field.bytes().await.map_err(broken)?.to_vec(),
            _ => {}
        }
    }
    teacher.check_csrf(&state, &csrf)?;
    let roster = read_roster(&bytes)?;
    state.store.set_roster(&roster, state.clock.now()).await?;
    Ok(Redirect::to("/teacher/settings?done=roster").into_response())
}

/// Pairs of number and name: of each line the first cell that is a student number, and the first other one.
///
/// A line without a number is a heading where it is the first, and a mistake elsewhere.
fn read_roster(bytes: &[u8]) -> Result<Vec<(String, String)>, Problem> {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.trim_start_matches('\u{feff}').to_owned(),
        Err(_) => encoding_rs::SHIFT_JIS.decode(bytes).0.into_owned(),
    };
    let delimiter = if text.lines().next().is_some_and(|line| line.contains('\t')) { b'\t' } else { b',' };
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).delimiter(delimiter).from_reader(text.as_bytes());
    let mut roster = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let line = index + 1;
        let wrong = || {
            Problem::unprocessable(
                format!(
                    "Line {line} of the roster has no student number. A line looks like `s1234567,Family Given`; nothing was changed."
                ),
                format!(
                    "名簿の {line} 行目に学籍番号がありません。各行は「s1234567,氏名」の形にしてください。名簿は変更していません。"
                ),
            )
        };
        let record = record.map_err(|_| wrong())?;
        let cells: Vec<&str> = record.iter().map(str::trim).filter(|cell| !cell.is_empty()).collect();
        if cells.is_empty() {
            continue;
        }
        let has_digit = |number: &String| number.chars().any(|c| c.is_ascii_digit());
        let number = cells.iter().position(|cell| identity::normal_number(cell).as_ref().is_some_and(has_digit));
        match number {
            Some(place) => {
                let name = cells.iter().enumerate().find(|(index, _)| *index != place).map_or("", |(_, name)| name);
                roster.push((identity::normal_number(cells[place]).unwrap_or_default(), name.to_owned()));
            }
            None if line == 1 => {}
            None => return Err(wrong()),
        }
    }
    if roster.is_empty() {
        return Err(Problem::unprocessable(
            "The roster has no line with a student number; nothing was changed.",
            "名簿に学籍番号のある行がありません。名簿は変更していません。",
        ));
    }
    Ok(roster)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Vec<(String, String)> {
        read_roster(text.as_bytes()).expect("a roster")
    }

    fn pair(number: &str, name: &str) -> (String, String) {
        (number.to_owned(), name.to_owned())
    }

    #[test]
    fn a_roster_is_read_in_the_forms_that_spreadsheets_write() {
        let expected = [pair("S1234567", "和田 花子"), pair("S1234568", "Smith, J.")];
        assert_eq!(of("\u{feff}学籍番号,氏名\r\ns1234567,和田 花子\r\n\r\nｓ1234568,\"Smith, J.\"\r\n"), expected);
        assert_eq!(of("和田 花子\ts1234567\nSmith, J.\ts1234568"), expected);
        let (sjis, _, _) = encoding_rs::SHIFT_JIS.encode("s1234567,和田 花子\n");
        assert_eq!(read_roster(&sjis).expect("a roster"), [pair("S1234567", "和田 花子")]);
    }

    #[test]
    fn a_line_without_a_number_is_named() {
        let problem = read_roster("s1234567,A\nB only\n".as_bytes()).expect_err("a problem");
        assert!(problem.detail.en.starts_with("Line 2 ") && problem.detail.ja.contains("2 行目"));
        assert!(read_roster(b"").is_err() && read_roster(b"number,name\n").is_err());
    }
}
