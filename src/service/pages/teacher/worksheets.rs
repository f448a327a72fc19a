//! Moodle's worksheet for what the class handed in: filled in, or the reports for the participants in it.

use super::super::frame::PageFrame;
use super::class;
use super::downloads::begun;
use super::refused;
use super::table::TableFilter;
use crate::class::formats::ClassFormat;
use crate::language::Language;
use crate::service::State;
use crate::service::api::batches::named;
use crate::service::api::body::other;
use crate::service::classes::{DownloadOptions, DownloadSelection, Pick};
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, TeacherPage};
use axum::extract::multipart::MultipartRejection;
use axum::extract::{Multipart, State as Shared};
use axum::response::Response;

/// `POST /teacher/worksheet`: for the class. A worksheet that cannot be read leads back to the form.
pub(in crate::service::pages) async fn of_class(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
    form: Result<Multipart, MultipartRejection>,
) -> Result<Response, Problem> {
    let whose = DownloadSelection::Students(Pick::Counted);
    match filled(&state, &teacher, whose, frame.course.language, frame.teacher(), form).await {
        Err(problem) if problem.status.is_client_error() => {
            let detail = problem.detail.get(frame.language).replace('`', "");
            let page = class::view(&state, &teacher, frame, TableFilter::default(), Some(detail)).await?;
            Ok(refused(page, problem.status))
        }
        answer => answer,
    }
}

/// Begins to make what a form with a worksheet asks for; `back` is the page that it stands on.
pub(super) async fn filled(
    state: &State,
    teacher: &Teacher,
    whose: DownloadSelection,
    language: Language,
    back: String,
    form: Result<Multipart, MultipartRejection>,
) -> Result<Response, Problem> {
    let mut form = form.map_err(other)?;
    let (mut csrf, mut sheet, mut format) = (String::new(), Vec::new(), ClassFormat::MoodleWorksheet);
    while let Some(field) = form.next_field().await.map_err(other)? {
        match field.name().unwrap_or_default() {
            "format" => format = named(&field.text().await.map_err(other)?)?,
            "csrf" => csrf = field.text().await.map_err(other)?,
            "sheet" => sheet = field.bytes().await.map_err(other)?.to_vec(),
            _ => {}
        }
    }
    teacher.check_csrf(state, &csrf)?;
    let wanted = DownloadOptions { format, sheet: Some(sheet), language, with_pages: false };
    wanted.check()?;
    Ok(begun(state, whose, wanted, back))
}
