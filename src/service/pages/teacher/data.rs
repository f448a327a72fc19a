//! What is kept of people: the same words that they read, pseudonyms for assistants, and everything of one student as a file.

use super::super::frame::PageFrame;
use super::super::shown;
use super::Tab;
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::courses::at;
use crate::service::download::saved;
use crate::service::errors::Problem;
use crate::service::export;
use crate::service::identity::{LecturerPage, normal_number};
use askama::Template;
use axum::Form;
use axum::extract::State as Shared;
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/data.html")]
struct DataPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    days: u32,
    has_platforms: bool,
    has_pseudonyms: bool,
}

/// `GET /teacher/data`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    shown(
        DataPage {
            place: Tab::Data,
            csrf: teacher.csrf(&service),
            days: service.config.retention_days,
            has_platforms: !service.store.platforms().await?.is_empty(),
            has_pseudonyms: service.store.has_pseudonyms().await?,
            frame,
        }
        .render(),
    )
}

/// The form that sets whether assistants read names.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct PseudonymsForm {
    csrf: String,
    pseudonyms: String,
}

/// `POST /teacher/data`.
pub(in crate::service::pages) async fn set(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Form(form): Form<PseudonymsForm>,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    teacher.check_csrf(&service, &form.csrf)?;
    let are_wanted = form.pseudonyms == "on";
    service.store.set_pseudonyms(are_wanted).await?;
    let said = if are_wanted { "pseudonyms: on" } else { "pseudonyms: off" };
    Ok(Detail::of(said).on(Redirect::to("/teacher/data").into_response()))
}

/// The form that has the archive made.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct ArchiveRequestForm {
    csrf: String,
}

/// `POST /teacher/data/archive`: begins to make the term's archive, and leads to its page.
pub(in crate::service::pages) async fn archive(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Form(form): Form<ArchiveRequestForm>,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    teacher.check_csrf(&service, &form.csrf)?;
    let state = service.homeworks().next().ok_or_else(Problem::not_found)?;
    let language = service.store.course().await?.language;
    let job = service.downloads.archive(&state, language, at("/teacher/data"));
    let page = format!("{}/teacher/downloads/{}", state.base(), job.id);
    Ok(Detail::of("term.zip").on(Redirect::to(&page).into_response()))
}

/// Whose data.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct PersonDataForm {
    csrf: String,
    number: String,
}

/// `POST /teacher/data/export`: everything of one student as a ZIP. A form that is sent, so that the log has it.
pub(in crate::service::pages) async fn export(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Form(whose): Form<PersonDataForm>,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    teacher.check_csrf(&service, &whose.csrf)?;
    let number = normal_number(&whose.number).ok_or_else(Problem::not_found)?;
    let student = service.store.student_by_number(&number).await?.ok_or_else(Problem::not_found)?;
    let bytes = export::of_student(&service, &student).await?;
    Ok(Detail::about(&student.id).on(saved(&format!("{number}.zip"), "application/zip", bytes)))
}
