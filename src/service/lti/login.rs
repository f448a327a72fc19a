//! How a launch begins: the platform says that somebody comes, and this service asks it who.
//!
//! Inside a page of the platform it is found out first whether the browser keeps a cookie there. Where it does not, a new window is
//! offered before the platform is asked: Moodle answers once for each time that somebody comes.

use super::super::Service;
use super::super::clock::millis;
use super::super::errors::Problem;
use super::super::identity::{Jar, has_trial, new_token, set_launch, set_trial, token_hash};
use super::super::pages::{PageFrame, launch_lost};
use super::super::store::Launch;
use super::contexts::is_elsewheres;
use super::{address, refused};
use axum::Form;
use axum::extract::{Query, State as Shared};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Redirect, Response};
use reqwest::Url;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// How long a launch may take, with logging in at the platform.
const LAUNCH: Duration = Duration::from_secs(600);

/// What a platform says when somebody comes.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Coming {
    iss: String,
    login_hint: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    target_link_uri: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lti_message_hint: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    client_id: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lti_deployment_id: Option<String>,
    /// Whether the browser was given a cookie to keep; this service says so itself.
    #[serde(skip_serializing)]
    tried: Option<String>,
}

/// `GET /lti/login`.
pub async fn by_link(
    Shared(service): Shared<Service>,
    headers: HeaderMap,
    frame: PageFrame,
    Query(coming): Query<Coming>,
) -> Result<Response, Problem> {
    begin(&service, &headers, frame, coming).await
}

/// `POST /lti/login`.
pub async fn by_form(
    Shared(service): Shared<Service>,
    headers: HeaderMap,
    frame: PageFrame,
    Form(coming): Form<Coming>,
) -> Result<Response, Problem> {
    begin(&service, &headers, frame, coming).await
}

async fn begin(service: &Service, headers: &HeaderMap, frame: PageFrame, coming: Coming) -> Result<Response, Problem> {
    let platforms = service.store.platforms().await?;
    let is_it = |client: &str| coming.client_id.as_deref().is_none_or(|given| given == client);
    let mut found =
        platforms.into_iter().filter(|platform| platform.issuer == coming.iss && is_it(&platform.client_id));
    let platform = match found.next() {
        Some(platform) if is_elsewheres(service, &platform.id).await? => None,
        found => found,
    };
    let platform = platform.ok_or_else(|| {
        let iss: String = coming.iss.chars().filter(|c| !c.is_control()).take(200).collect();
        refused(
            format!("The learning platform {iss} is not known here. An administrator adds it under Staff, Learning platforms."),
            format!("学習プラットフォーム {iss} は登録されていません。管理者が「担当者」の「学習プラットフォーム」で登録してください。"),
        )
    })?;
    if platform.is_active == 0 {
        return Err(refused(
            format!("Launches from {} are switched off here. Ask an administrator.", platform.name),
            format!("{} からの利用は停止されています。管理者に問い合わせてください。", platform.name),
        ));
    }
    let begun_by = Url::parse_with_params("http://x/", pairs(&coming)).map_err(|error| Problem::internal(&error))?;
    let begun_by = begun_by.query().unwrap_or_default().to_owned();
    let jar = Jar::of(headers);
    if jar == Jar::Embedded && !has_trial(service, headers) {
        return match coming.tried {
            None => Ok(trial(service, &begun_by)),
            Some(_) => launch_lost(frame, &begun_by),
        };
    }
    let (state, nonce) = (new_token(), new_token());
    let now = service.clock.now();
    let launch = Launch { platform_id: platform.id.clone(), nonce: nonce.clone(), begun_by };
    service.store.begin_launch(&token_hash(&state), &launch, now, now + millis(LAUNCH)).await?;
    let back = format!("{}/lti/launch", address(service)?);
    let mut next = Url::parse(&platform.auth_url).map_err(|error| Problem::internal(&error))?;
    next.query_pairs_mut().extend_pairs([
        ("scope", "openid"),
        ("response_type", "id_token"),
        ("response_mode", "form_post"),
        ("prompt", "none"),
        ("client_id", &platform.client_id),
        ("redirect_uri", &back),
        ("login_hint", &coming.login_hint),
        ("state", &state),
        ("nonce", &nonce),
    ]);
    if let Some(hint) = &coming.lti_message_hint {
        next.query_pairs_mut().append_pair("lti_message_hint", hint);
    }
    let mut response = Redirect::to(next.as_str()).into_response();
    if let Some(cookie) = set_launch(service, &state, LAUNCH.as_secs(), jar) {
        response.headers_mut().append(header::SET_COOKIE, cookie);
    }
    Ok(response)
}

/// Gives a browser a cookie to keep, and has it come again with it.
fn trial(service: &Service, begun_by: &str) -> Response {
    let mut response = Redirect::to(&format!("/lti/login?{begun_by}&tried=1")).into_response();
    if let Some(cookie) = set_trial(service) {
        response.headers_mut().append(header::SET_COOKIE, cookie);
    }
    response
}

/// What the platform said, to be said again.
fn pairs(coming: &Coming) -> Vec<(String, String)> {
    let json = serde_json::to_value(coming).unwrap_or_default();
    let text = |(name, value): (&String, &serde_json::Value)| Some((name.clone(), value.as_str()?.to_owned()));
    json.as_object().into_iter().flatten().filter_map(text).collect()
}
