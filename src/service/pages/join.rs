//! The course link: a student says by which number they are known.

use super::frame::Frame;
use super::{shown, student};
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::identity::{self, Visitor};
use askama::Template;
use axum::Form;
use axum::extract::{Path, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/join.html")]
struct JoinPage {
    frame: Frame,
    /// The title of the homework, where there is one only.
    title: String,
    problem: Option<String>,
    action: String,
    leave: &'static str,
    csrf: String,
    number: String,
    who: Option<String>,
}

/// The form of the page.
#[derive(Debug, Default, Deserialize)]
pub(super) struct JoinForm {
    #[serde(default)]
    csrf: String,
    #[serde(default)]
    number: String,
}

fn view(
    service: &Service,
    frame: Frame,
    secret: &str,
    visitor: &Visitor,
    number: String,
    problem: Option<String>,
) -> JoinPage {
    let who = visitor.identity.student().map(|student| student.number.clone());
    JoinPage {
        title: service.only().map(|state| student::title(&state.assignment, frame.language)).unwrap_or_default(),
        problem,
        action: format!("/join/{secret}"),
        leave: "/leave",
        csrf: visitor.csrf(service),
        number: if number.is_empty() { who.clone().unwrap_or_default() } else { number },
        who,
        frame,
    }
}

/// `GET /join/{secret}`.
pub(super) async fn page(
    Shared(service): Shared<Service>,
    Path(secret): Path<String>,
    frame: Frame,
    visitor: Visitor,
) -> Result<Response, Problem> {
    identity::check_course_link(&service, &secret).await?;
    shown(view(&service, frame, &secret, &visitor, String::new(), None).render())
}

/// `POST /join/{secret}`.
pub(super) async fn join(
    Shared(service): Shared<Service>,
    Path(secret): Path<String>,
    frame: Frame,
    visitor: Visitor,
    Form(given): Form<JoinForm>,
) -> Result<Response, Problem> {
    visitor.check_csrf(&service, &given.csrf)?;
    match identity::join(&service, visitor.clone(), &secret, &given.number).await {
        Ok(visitor) => Ok(to_desk(&service, &visitor)),
        Err(problem) if problem.status == StatusCode::UNPROCESSABLE_ENTITY => {
            let detail = problem.detail.get(frame.language).to_owned();
            let mut page = shown(view(&service, frame, &secret, &visitor, given.number, Some(detail)).render())?;
            *page.status_mut() = problem.status;
            Ok(page)
        }
        Err(problem) => Err(problem),
    }
}

/// `POST /leave`: leaves the browser to somebody else.
pub(super) async fn leave(
    Shared(service): Shared<Service>,
    visitor: Visitor,
    Form(given): Form<JoinForm>,
) -> Result<Response, Problem> {
    visitor.check_csrf(&service, &given.csrf)?;
    Ok(to_desk(&service, &identity::leave()))
}

fn to_desk(service: &Service, visitor: &Visitor) -> Response {
    let page = service.only().map_or_else(|| "/".to_owned(), |state| state.page());
    let mut response = Redirect::to(&page).into_response();
    visitor.set_cookie(service, &mut response);
    response
}
