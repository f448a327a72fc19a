//! The course link: a student says by which number they are known, and proves it by their personal code.

use super::frame::{PageFrame, SignInLink};
use super::{shown, student};
use crate::service::Service;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::{self, Identity, Jar, Visitor, personal_code};
use crate::service::store::Proof;
use askama::Template;
use axum::Form;
use axum::extract::{Path, Query, State as Shared};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/join.html")]
struct JoinPage {
    frame: PageFrame,
    /// The title of the homework, where there is one only.
    title: String,
    problem: Option<String>,
    action: String,
    leave: String,
    csrf: String,
    number: String,
    code: String,
    /// Whether every number has a code that the teacher handed out.
    has_roster: bool,
    who: Option<String>,
    /// The code that another browser needs, for who has it from nobody else.
    own_code: Option<String>,
    desk: String,
    sign_ins: Vec<SignInLink>,
}

/// The form of the page.
#[derive(Debug, Default, Deserialize)]
pub(super) struct JoinForm {
    #[serde(default)]
    csrf: String,
    #[serde(default)]
    number: String,
    #[serde(default)]
    code: String,
}

async fn view(
    service: &Service,
    frame: PageFrame,
    secret: &str,
    visitor: &Visitor,
    given: JoinForm,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let who = visitor.identity.student().map(|student| student.number.clone());
    let own_code = match &visitor.identity {
        Identity::Student(owner, student) if owner.proof == Proof::First => Some(personal_code(service, student)),
        _ => None,
    };
    let JoinForm { number, code, .. } = given;
    let page = JoinPage {
        title: service.only().map(|state| student::title(&state.assignment, frame.language)).unwrap_or_default(),
        problem,
        action: at(&format!("/join/{secret}")),
        leave: at("/leave"),
        csrf: visitor.csrf(service),
        number: if number.is_empty() { who.clone().unwrap_or_default() } else { number },
        code,
        has_roster: service.store.has_roster().await?,
        who,
        own_code,
        desk: desk(service),
        sign_ins: SignInLink::all(service, None),
        frame,
    };
    shown(page.render())
}

/// `GET /join/{secret}`; a link of a student's own has `number` and `code`.
pub(super) async fn page(
    Shared(service): Shared<Service>,
    Path(secret): Path<String>,
    Query(given): Query<JoinForm>,
    frame: PageFrame,
    visitor: Visitor,
) -> Result<Response, Problem> {
    identity::check_course_link(&service, &secret).await?;
    view(&service, frame, &secret, &visitor, given, None).await
}

/// `POST /join/{secret}`.
pub(super) async fn join(
    Shared(service): Shared<Service>,
    Path(secret): Path<String>,
    frame: PageFrame,
    visitor: Visitor,
    headers: HeaderMap,
    Form(given): Form<JoinForm>,
) -> Result<Response, Problem> {
    visitor.check_csrf(&service, &given.csrf)?;
    let jar = Jar::of(&headers);
    match identity::join(&service, visitor.clone(), &secret, &given.number, &given.code).await {
        // Who has their code from nobody is shown it there.
        Ok(visitor) if has_first(&visitor) => Ok(to_page(&service, &visitor, (&format!("/join/{secret}"), jar))),
        Ok(visitor) => Ok(to_page(&service, &visitor, (&desk(&service), jar))),
        Err(problem)
            if problem.status == StatusCode::UNPROCESSABLE_ENTITY
                || matches!(problem.kind, "code-needed" | "wrong-code") =>
        {
            let detail = problem.detail.get(frame.language).to_owned();
            let mut page = view(&service, frame, &secret, &visitor, given, Some(detail)).await?;
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
    headers: HeaderMap,
    Form(given): Form<JoinForm>,
) -> Result<Response, Problem> {
    visitor.check_csrf(&service, &given.csrf)?;
    Ok(to_page(&service, &identity::leave(), (&desk(&service), Jar::of(&headers))))
}

/// Whether a browser is a student's because it was the first that gave the number.
fn has_first(visitor: &Visitor) -> bool {
    matches!(&visitor.identity, Identity::Student(owner, _) if owner.proof == Proof::First)
}

/// Where a student works.
fn desk(service: &Service) -> String {
    service.only().map_or_else(|| at("/"), |state| state.page())
}

fn to_page(service: &Service, visitor: &Visitor, (page, jar): (&str, Jar)) -> Response {
    let mut response = Redirect::to(page).into_response();
    visitor.set_cookie_in(service, &mut response, jar);
    response
}
