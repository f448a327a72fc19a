//! Where somebody who was let in chooses a password.

use super::super::frame::PageFrame;
use super::super::shown;
use super::people::role_name;
use super::refused;
use crate::service::Service;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::{self, Jar, Visitor};
use crate::service::limits::Client;
use crate::service::proxied::ProxiedName;
use askama::Template;
use axum::extract::{Path, State as Shared};
use axum::http::StatusCode;
use axum::response::Response;
use axum::{Extension, Form};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/welcome.html")]
struct WelcomePage {
    frame: PageFrame,
    csrf: String,
    action: String,
    login: String,
    role: &'static str,
    shortest: usize,
    problem: Option<String>,
}

/// The form of the page.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct PasswordForm {
    csrf: String,
    password: String,
}

async fn view(
    service: &Service,
    frame: PageFrame,
    visitor: &Visitor,
    secret: &str,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let account = identity::invited(service, secret).await?;
    // The account is of the whole service, the role of this course.
    let member = service.store.course_member(&account.id).await?.unwrap_or(account);
    shown(
        WelcomePage {
            csrf: visitor.csrf(service),
            action: at(&format!("/teacher/welcome/{secret}")),
            login: member.login,
            role: role_name(&frame, member.role),
            shortest: identity::SHORTEST_PASSWORD,
            problem,
            frame,
        }
        .render(),
    )
}

/// `GET /teacher/welcome/{secret}`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    Path(secret): Path<String>,
    frame: PageFrame,
    visitor: Visitor,
) -> Result<Response, Problem> {
    view(&service, frame, &visitor, &secret, None).await
}

/// `POST /teacher/welcome/{secret}`: sets the password, and logs in.
pub(in crate::service::pages) async fn choose(
    Shared(service): Shared<Service>,
    Path(secret): Path<String>,
    frame: PageFrame,
    visitor: Visitor,
    client: Client,
    proxied: Option<Extension<ProxiedName>>,
    Form(chosen): Form<PasswordForm>,
) -> Result<Response, Problem> {
    visitor.check_csrf(&service, &chosen.csrf)?;
    service.limits.login(&client, &secret)?;
    let said = proxied.as_ref().map(|Extension(said)| said);
    match identity::choose_password(&service, &secret, &chosen.password).await {
        Ok(member) => identity::open_for(&service, member, "/teacher", (Jar::Own, said)).await,
        Err(problem) if problem.status == StatusCode::UNPROCESSABLE_ENTITY => {
            let detail = Some(problem.detail.get(frame.language).to_owned());
            Ok(refused(view(&service, frame, &visitor, &secret, detail).await?, problem.status))
        }
        Err(problem) => Err(problem),
    }
}
