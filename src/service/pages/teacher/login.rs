//! The way in, and out.

use super::super::frame::{PageFrame, SignInLink};
use super::super::shown;
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::identity::{self, Jar, LoginForm, Teacher, TeacherPage, Visitor};
use crate::service::limits::Client;
use crate::service::proxied::ProxiedName;
use askama::Template;
use axum::extract::State as Shared;
use axum::response::{IntoResponse, Redirect, Response};
use axum::{Extension, Form};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/login.html")]
struct LoginPage {
    frame: PageFrame,
    csrf: String,
    problem: Option<String>,
    /// Whether there are accounts to log in with.
    has_accounts: bool,
    login: String,
    sign_ins: Vec<SignInLink>,
}

async fn view(
    service: &Service,
    frame: PageFrame,
    visitor: &Visitor,
    login: String,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let has_accounts = service.accounts().has_administrator().await?;
    let sign_ins = SignInLink::all(service, None);
    shown(LoginPage { frame, csrf: visitor.csrf(service), problem, has_accounts, login, sign_ins }.render())
}

/// `GET /teacher/login`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    frame: PageFrame,
    visitor: Visitor,
    teacher: Option<Teacher>,
    proxied: Option<Extension<ProxiedName>>,
) -> Result<Response, Problem> {
    if teacher.is_some() {
        return Ok(Redirect::to("/teacher").into_response());
    }
    if let Some(Extension(said)) = proxied
        && let Some(member) = identity::member_of(&service, &said.0).await?
    {
        return identity::open_for(&service, member, "/teacher", (Jar::Own, Some(&said))).await;
    }
    view(&service, frame, &visitor, String::new(), None).await
}

/// `POST /teacher/login`.
pub(in crate::service::pages) async fn login(
    Shared(service): Shared<Service>,
    frame: PageFrame,
    visitor: Visitor,
    client: Client,
    proxied: Option<Extension<ProxiedName>>,
    Form(form): Form<LoginForm>,
) -> Result<Response, Problem> {
    let said = proxied.as_ref().map(|Extension(said)| said);
    match identity::login(&service, &client, &visitor, said, &form).await {
        Ok(response) => Ok(response),
        Err(problem) if problem.kind == "login" => {
            let detail = problem.detail.get(frame.language).to_owned();
            let mut page = view(&service, frame, &visitor, form.login, Some(detail)).await?;
            *page.status_mut() = problem.status;
            Ok(page)
        }
        Err(problem) => Err(problem),
    }
}

/// The form of the button.
#[derive(Debug, Default, Deserialize)]
pub(in crate::service::pages) struct CsrfForm {
    #[serde(default)]
    pub csrf: String,
}

/// `POST /teacher/logout`.
pub(in crate::service::pages) async fn logout(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    Form(token): Form<CsrfForm>,
) -> Result<Response, Problem> {
    identity::logout(&service, &teacher, &token.csrf).await
}
