//! What people see of learning platforms: the choice of a homework, a launch that lost its cookie, a registration.

use super::frame::PageFrame;
use super::shown;
use crate::service::Service;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::lti::deep_linking::HomeworkChoice;
use crate::service::lti::known;
use crate::service::lti::number::HeldNumber;
use crate::service::lti::registration::{self, RegistrationQuery};
use askama::Template;
use axum::extract::{Path, Query, Request, State as Shared};
use axum::http::{HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::Response;

#[derive(Template)]
#[template(path = "service/pages/templates/lti_choice.html")]
struct ChoicePage {
    frame: PageFrame,
    choice: HomeworkChoice,
}

#[derive(Template)]
#[template(path = "service/pages/templates/lti_lost.html")]
struct LostPage {
    frame: PageFrame,
    again: String,
}

#[derive(Template)]
#[template(path = "service/pages/templates/lti_number.html")]
struct NumberPage {
    frame: PageFrame,
    number: String,
    action: String,
    claim: String,
    csrf: String,
    problem: Option<String>,
}

#[derive(Template)]
#[template(path = "service/pages/templates/lti_registered.html")]
struct RegisteredPage {
    frame: PageFrame,
    name: String,
}

/// The page on which a lecturer chooses a homework; its forms go to the platform.
pub(in crate::service) fn shown_choice(frame: PageFrame, choice: HomeworkChoice) -> Result<Response, Problem> {
    let origin = choice.origin.clone();
    let mut response = shown(ChoicePage { frame, choice }.render())?;
    let policy = crate::service::CSP
        .replace("form-action 'self'", &format!("form-action {origin}"))
        .replace("frame-ancestors 'none'", &format!("frame-ancestors {origin}"));
    if let Ok(policy) = HeaderValue::from_str(&policy) {
        response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, policy);
    }
    Ok(response)
}

/// The page of a launch that comes back without the cookie with which it began: the browser keeps none in a frame. In a
/// window of its own it does.
pub(in crate::service) fn launch_lost(frame: PageFrame, begun_by: &str) -> Result<Response, Problem> {
    let again = at(&format!("/lti/login?{begun_by}"));
    let mut page = shown(LostPage { frame, again }.render())?;
    *page.status_mut() = StatusCode::FORBIDDEN;
    Ok(page)
}

/// The page that asks somebody who comes from a platform for the code of the number that it says is theirs.
pub(in crate::service) fn shown_number(frame: PageFrame, held: HeldNumber) -> Result<Response, Problem> {
    let HeldNumber { number, action, claim, csrf, problem } = held;
    shown(NumberPage { frame, number, action, claim, csrf, problem }.render())
}

/// `GET /lti/register/{secret}`: the platform opens it for its administrator.
pub(super) async fn register(
    Shared(service): Shared<Service>,
    Path(secret): Path<String>,
    Query(asked): Query<RegistrationQuery>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let platform = registration::register(&service, &secret, &asked).await?;
    shown(RegisteredPage { frame, name: platform.name }.render())
}

/// The layer around pages: lets the learning platforms that are known, and nobody else, show them in a frame.
pub(super) async fn embeddable(Shared(service): Shared<Service>, request: Request, next: Next) -> Response {
    let is_framed = crate::service::identity::Jar::of(request.headers()) == crate::service::identity::Jar::Embedded;
    let registering = registering(&request);
    let mut response = next.run(request).await;
    if !is_framed || response.headers().contains_key(header::CONTENT_SECURITY_POLICY) {
        return response;
    }
    let mut origins = known::origins(&service).await.unwrap_or_default();
    origins.extend(registering.and_then(|address| known::origin(&address)));
    if !origins.is_empty() {
        let origins: Vec<String> = origins.into_iter().collect();
        let policy = format!("frame-ancestors 'self' {}", origins.join(" "));
        let policy = crate::service::CSP.replace("frame-ancestors 'none'", &policy);
        if let Ok(policy) = HeaderValue::from_str(&policy) {
            // Browsers that know this pass over X-Frame-Options.
            response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, policy);
        }
    }
    response
}

/// Where a platform is whose administrator opens a registration link there: what is wrong with the link is read in that frame.
fn registering(request: &Request) -> Option<String> {
    request.uri().path().strip_prefix("/lti/register/")?;
    Query::<RegistrationQuery>::try_from_uri(request.uri()).ok().map(|Query(asked)| asked.openid_configuration)
}
