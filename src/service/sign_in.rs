//! Signing in by OpenID Connect: an issuer (a university, Google, Microsoft) says who somebody is.
//!
//! The code flow with PKCE, state and nonce. What the issuer's addresses are is discovered from its name. The state is used once,
//! within ten minutes, and in the browser in which it was made. `jsonwebtoken` and `reqwest` of the LTI launches do the work.
//! [`provider`] is one issuer.

mod provider;

pub use provider::Provider;

use super::clock::millis;
use super::errors::Problem;
use super::id_tokens::{self, Issuer};
use super::identity::{
    Jar, Visitor, become_student, end_session, has_launch, member_of, new_token, normal_number, open_for, set_sign_in,
    token_hash,
};
use super::proxied::ProxiedName;
use super::store::{Proof, SignIn};
use super::{Service, lti};
use axum::extract::{Path, Query, State as Shared};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::get;
use axum::{Extension, Router};
use base64::prelude::{BASE64_URL_SAFE_NO_PAD, Engine};
use reqwest::Url;
use serde::Deserialize;
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};
use std::time::Duration;

/// How long signing in may take.
const PATIENCE: Duration = Duration::from_secs(600);

/// The routes, which are among the pages.
pub fn router() -> Router<Service> {
    Router::new().route("/sign-in/{provider}", get(begin)).route("/signed-in", get(finish))
}

/// Where issuers send browsers back to.
fn address_back(service: &Service) -> Result<String, Problem> {
    Ok(format!("{}/signed-in", lti::address(service)?))
}

fn refused(en: impl Into<String>, ja: impl Into<String>) -> Problem {
    Problem::new(StatusCode::FORBIDDEN, "sign-in", en, ja)
}

/// Where to go on afterwards.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct SignInQuery {
    /// Id of a homework.
    homework: String,
}

/// `GET /sign-in/{provider}`: leads to the issuer.
async fn begin(
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    Query(wish): Query<SignInQuery>,
) -> Result<Response, Problem> {
    let provider = service.config.sign_in.iter().find(|provider| provider.id == id).ok_or_else(Problem::not_found)?;
    let found = provider.discovered(&service).await?;
    let (state, nonce, verifier) = (new_token(), new_token(), new_token());
    let challenge = BASE64_URL_SAFE_NO_PAD.encode(Sha256::digest(verifier.as_bytes()));
    let now = service.clock.now();
    let homework = service.homework(&wish.homework).map(|state| state.assignment.id.clone());
    let begun = SignIn { provider: id, nonce: nonce.clone(), verifier, homework };
    service.store.begin_sign_in(&token_hash(&state), &begun, now, now + millis(PATIENCE)).await?;
    let back = address_back(&service)?;
    let mut next = Url::parse(&found.authorization_endpoint).map_err(|error| Problem::internal(&error))?;
    next.query_pairs_mut().extend_pairs([
        ("response_type", "code"),
        ("scope", "openid profile email"),
        ("client_id", &provider.client_id),
        ("redirect_uri", &back),
        ("state", &state),
        ("nonce", &nonce),
        ("code_challenge", &challenge),
        ("code_challenge_method", "S256"),
        // At a computer that several people use the issuer may know the one before.
        ("prompt", "select_account"),
    ]);
    let mut response = Redirect::to(next.as_str()).into_response();
    if let Some(cookie) = set_sign_in(&service, &state, PATIENCE.as_secs()) {
        response.headers_mut().append(header::SET_COOKIE, cookie);
    }
    Ok(response)
}

/// What an issuer sends a browser back with.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct IssuerResponse {
    code: String,
    state: String,
    iss: Option<String>,
    error: String,
    error_description: String,
}

/// `GET /signed-in`: takes what the issuer vouches for.
async fn finish(
    Shared(service): Shared<Service>,
    headers: HeaderMap,
    visitor: Visitor,
    proxied: Option<Extension<ProxiedName>>,
    Query(answer): Query<IssuerResponse>,
) -> Result<Response, Problem> {
    let begun = service.store.take_sign_in(&token_hash(&answer.state), service.clock.now()).await?;
    let begun = begun.filter(|_| has_launch(&service, &headers, &answer.state)).ok_or_else(|| {
        refused(
            "This sign-in has been used, took longer than ten minutes, or began in another browser. Sign in once more.",
            "このログインはすでに使用されたか、10 分を過ぎたか、別のブラウザで始めたものです。もう一度ログインしてください。",
        )
    })?;
    let provider = service.config.sign_in.iter().find(|provider| provider.id == begun.provider);
    let provider = provider.ok_or_else(Problem::not_found)?;
    if !answer.error.is_empty() {
        let said = format!("{} {}", answer.error, answer.error_description);
        let said: String = said.chars().filter(|c| !c.is_control()).take(300).collect();
        return Err(refused(
            format!("{} does not let you in: {said}", provider.name),
            format!("{} で認証できませんでした: {said}", provider.name),
        ));
    }
    let found = provider.discovered(&service).await?;
    // Before the code goes anywhere (RFC 9207).
    if answer.iss.as_deref().is_some_and(|iss| !provider.has_name(&found, iss)) {
        return Err(provider.distrusted("it comes from another issuer (iss)", "別の発行元からのものです (iss)"));
    }
    let tokens = provider.tokens(&service, &found, &answer.code, &begun).await?;
    let (issuer, algorithms) = (provider.issuer_of(&found, &tokens.id)?, found.algorithms());
    let of =
        Issuer { issuer: &issuer, client_id: &provider.client_id, keys_url: &found.jwks_uri, algorithms: &algorithms };
    let mut claims: Map<String, Value> =
        id_tokens::read(&service.lti, of, &tokens.id).await.map_err(|why| provider.distrusted(&why.en, &why.ja))?;
    check_claims(provider, &claims, &begun.nonce)?;
    provider.complete(&service, &found, &tokens, &mut claims).await?;
    let (full, short) = provider.names(&claims)?;
    let said = proxied.map(|Extension(said)| said);
    enter(&service, (&headers, visitor, said.as_ref()), (&full, &short), begun.homework.as_deref()).await
}

/// Whether claims answer this sign-in and say who somebody is (OpenID Connect Core, sections 2 and 3.1.3.7).
fn check_claims(provider: &Provider, claims: &Map<String, Value>, nonce: &str) -> Result<(), Problem> {
    let text = |claim: &str| claims.get(claim).and_then(Value::as_str).unwrap_or_default();
    if text("nonce") != nonce {
        return Err(provider.distrusted(
            "it is not the answer to this sign-in (nonce)",
            "このログインに対するものではありません (nonce)",
        ));
    }
    if text("sub").is_empty() {
        return Err(provider.distrusted("it does not say who somebody is (sub)", "利用者の識別子 (sub) がありません"));
    }
    Ok(())
}

/// Lets somebody in by their name: with the account of this login, or as the student with this number.
async fn enter(
    service: &Service,
    (headers, visitor, said): (&HeaderMap, Visitor, Option<&ProxiedName>),
    (full, short): (&str, &str),
    homework: Option<&str>,
) -> Result<Response, Problem> {
    for login in [full, short] {
        if let Some(member) = member_of(service, login).await? {
            return open_for(service, member, "/teacher", (Jar::Own, said)).await;
        }
    }
    let student = match normal_number(short) {
        Some(number) => service.store.student(&number, service.clock.now()).await?,
        None => None,
    };
    let student = student.ok_or_else(|| {
        refused(
            format!("You are signed in as {full}, who is not on the roster and has no account here. Ask your teacher."),
            format!(
                "{full} でログインしていますが、名簿にもアカウントにもありません。担当教員に問い合わせてください。"
            ),
        )
    })?;
    let visitor = become_student(service, visitor, student, Proof::Platform).await?;
    let state = homework.and_then(|id| service.homework(id)).or_else(|| service.only());
    let page = state.map_or_else(|| "/".to_owned(), |state| state.page());
    let mut response = Redirect::to(&page).into_response();
    visitor.set_cookie(service, &mut response);
    end_session(service, headers, (&mut response, Jar::Own)).await?;
    Ok(response)
}
