//! The roster, imported from a file.

use super::super::frame::PageFrame;
use super::refused;
use super::settings::{self, SettingsNotice, Typed};
use crate::service::State;
use crate::service::acts::Detail;
use crate::service::api::body::other;
use crate::service::errors::Problem;
use crate::service::identity::{LecturerPage, Teacher};
use crate::service::roster::{self, RosterChange, RosterFile};
use axum::extract::multipart::MultipartRejection;
use axum::extract::{Multipart, State as Shared};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Redirect, Response};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};

/// Columns that the page names.
const LISTED_COLUMNS: usize = 12;

/// Longest name of a column that it quotes, in characters.
const LONGEST_COLUMN: usize = 40;

/// `POST /teacher/roster`: a CSV file of student numbers and names. One that cannot be read leads back to the form.
pub(in crate::service::pages) async fn take(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    headers: HeaderMap,
    frame: PageFrame,
    form: Result<Multipart, MultipartRejection>,
) -> Result<Response, Problem> {
    match import(&state, &teacher, form).await {
        Ok((RosterFile { lines, left_aside }, RosterChange { new, gone })) => {
            let students = lines.len();
            let aside = shortened(&left_aside);
            let aside = utf8_percent_encode(&aside, NON_ALPHANUMERIC);
            let next = format!("{}/settings?done=roster&new={new}&gone={gone}&aside={aside}", frame.teacher());
            let answer = Redirect::to(&next).into_response();
            Ok(Detail::of(students.to_string()).on(answer))
        }
        Err(problem) if problem.status.is_client_error() => {
            let said = SettingsNotice {
                roster: Some(problem.detail.get(frame.language).to_owned()),
                ..SettingsNotice::default()
            };
            let page = settings::view(&state, frame, &headers, &teacher, Typed::default(), said).await?;
            Ok(refused(page, problem.status))
        }
        Err(problem) => Err(problem),
    }
}

async fn import(
    state: &State,
    teacher: &Teacher,
    form: Result<Multipart, MultipartRejection>,
) -> Result<(RosterFile, RosterChange), Problem> {
    let mut form = form.map_err(unreadable)?;
    let (mut csrf, mut bytes) = (String::new(), Vec::new());
    while let Some(field) = form.next_field().await.map_err(unreadable)? {
        match field.name().unwrap_or_default() {
            "csrf" => csrf = field.text().await.map_err(unreadable)?,
            "roster" => bytes = field.bytes().await.map_err(unreadable)?.to_vec(),
            _ => {}
        }
    }
    teacher.check_csrf(state, &csrf)?;
    teacher.check_course()?;
    let roster = roster::read(&bytes)?;
    let change = roster::import(state, &roster.lines).await?;
    Ok((roster, change))
}

/// Names of columns in a line: a gradebook has one for each of its tasks.
fn shortened(names: &[String]) -> String {
    let cut = |name: &String| name.chars().filter(|c| !c.is_control()).take(LONGEST_COLUMN).collect::<String>();
    let mut named: Vec<String> = names.iter().take(LISTED_COLUMNS).map(cut).collect();
    if names.len() > LISTED_COLUMNS {
        named.push("…".to_owned());
    }
    named.join(", ")
}

/// An upload that did not arrive, or is no roster by its size alone.
fn unreadable(rejection: impl IntoResponse + std::fmt::Display) -> Problem {
    let problem = other(rejection);
    match problem.status {
        StatusCode::PAYLOAD_TOO_LARGE => Problem::new(
            problem.status,
            "too-large",
            "The file is larger than 1 MiB. A roster has a few kilobytes: is it the right file? The roster was not changed.",
            "ファイルが 1 MiB を超えています。名簿は通常数キロバイトです。ファイルが正しいか確認してください。名簿は変更していません。",
        ),
        _ => problem,
    }
}
