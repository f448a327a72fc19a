//! A learning platform, written from the specifications: LTI 1.3 core, Assignment and Grade Services 2.0, Names and Role
//! Provisioning Services 2.0, Deep Linking 2.0, Dynamic Registration 1.0. It has a server and keys of its own.

use aws_lc_rs::encoding::AsDer;
use aws_lc_rs::rsa::{KeyPair, KeySize};
use axum::extract::{Query, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Form, Json, Router};
use base64::prelude::{BASE64_STANDARD, Engine};
use jsonwebtoken::jwk::{Jwk, JwkSet};
use jsonwebtoken::{Algorithm, DecodingKey, EncodingKey, Header, Validation};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

pub const CLIENT: &str = "client-of-ggrade";
pub const DEPLOYMENT: &str = "7";
const KEY: &str = "platform-key";
/// Seconds by which its clock is behind.
const BEHIND: u64 = 20;
const TOKEN: &str = "an-access-token";

/// The platform.
#[derive(Clone)]
pub struct Platform {
    pub issuer: String,
    key: Arc<EncodingKey>,
    seen: Arc<Mutex<Seen>>,
}

/// What it was sent.
#[derive(Default)]
pub struct Seen {
    /// The public keys of the tool, as a platform fetches them.
    pub tools_keys: Option<JwkSet>,
    pub registration: Value,
    pub scores: Vec<Value>,
    /// To whom requests for tokens are to be addressed, where that is not their address.
    pub audience: Option<String>,
    /// Shares no names of its people.
    pub is_nameless: bool,
    /// Answers scores with this status.
    pub failing: Option<StatusCode>,
    /// How the second page of its people is named, in place of its whole address.
    pub next_page: Option<String>,
    /// Does not answer scores at all.
    pub is_hanging: bool,
    /// How often scores were sent, those that it refused among them.
    pub posts: usize,
    tokens: usize,
    /// Hints of those who come and of whom was not asked yet: as with Moodle, each is answered once.
    pub hints: HashMap<String, String>,
}

/// A new RSA key.
pub fn key() -> EncodingKey {
    let der = KeyPair::generate(KeySize::Rsa2048).expect("a key").as_der().expect("its bytes");
    let pem =
        format!("-----BEGIN PRIVATE KEY-----\n{}\n-----END PRIVATE KEY-----\n", BASE64_STANDARD.encode(der.as_ref()));
    EncodingKey::from_rsa_pem(pem.as_bytes()).expect("a key")
}

impl Platform {
    pub async fn start() -> Self {
        Self::called("127.0.0.1").await
    }

    /// The same with another name for its host, which is another site to a browser.
    pub async fn called(host: &str) -> Self {
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let issuer = format!("http://{host}:{}", listener.local_addr().expect("an address").port());
        let platform = Self { issuer, key: Arc::new(key()), seen: Arc::default() };
        let routes = Router::new()
            .route("/openid-configuration", get(configuration))
            .route("/register", post(register))
            .route("/jwks", get(jwks))
            .route("/course", get(course))
            .route("/come", get(come))
            .route("/auth", get(auth))
            .route("/token", post(token))
            .route("/lineitem/scores", post(scores))
            .route("/memberships", get(memberships))
            .with_state(platform.clone());
        tokio::spawn(async move { axum::serve(listener, routes).await });
        platform
    }

    pub fn seen(&self) -> std::sync::MutexGuard<'_, Seen> {
        self.seen.lock().expect("a lock")
    }

    /// The claims of a launch, as Moodle writes them.
    pub fn claims(&self, nonce: &str, subject: &str, role: &str) -> Value {
        let now = jsonwebtoken::get_current_timestamp();
        json!({
            "iss": self.issuer, "aud": CLIENT, "sub": subject, "nonce": nonce, "iat": now, "exp": now + 60,
            "name": format!("Name of {subject}"),
            "https://purl.imsglobal.org/spec/lti/claim/message_type": "LtiResourceLinkRequest",
            "https://purl.imsglobal.org/spec/lti/claim/version": "1.3.0",
            "https://purl.imsglobal.org/spec/lti/claim/deployment_id": DEPLOYMENT,
            "https://purl.imsglobal.org/spec/lti/claim/target_link_uri": "https://ggrade.example/a/ggsample06",
            "https://purl.imsglobal.org/spec/lti/claim/resource_link": { "id": "3", "title": "Homework" },
            "https://purl.imsglobal.org/spec/lti/claim/context": { "id": "course-2" },
            "https://purl.imsglobal.org/spec/lti/claim/roles":
                [format!("http://purl.imsglobal.org/vocab/lis/v2/membership#{role}")],
            "https://purl.imsglobal.org/spec/lti/claim/lis": { "person_sourcedid": subject },
            "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint": {
                "scope": ["https://purl.imsglobal.org/spec/lti-ags/scope/score"],
                // A query, as Moodle has it.
                "lineitem": format!("{}/lineitem?type_id=3", self.issuer),
            },
            "https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice": {
                "context_memberships_url": format!("{}/memberships", self.issuer), "service_versions": ["2.0"],
            },
        })
    }

    /// Signs claims as the platform does.
    pub fn sign(&self, claims: &Value) -> String {
        let header = Header { kid: Some(KEY.to_owned()), ..Header::new(Algorithm::RS256) };
        jsonwebtoken::encode(&header, claims, &self.key).expect("a token")
    }

    /// The bytes of its public key in PEM, which somebody may take for a secret.
    pub fn public_modulus(&self) -> String {
        let jwk = serde_json::to_value(self.jwk()).expect("JSON");
        jwk["n"].as_str().expect("a modulus").to_owned()
    }

    fn jwk(&self) -> Jwk {
        let mut jwk = Jwk::from_encoding_key(&self.key, Algorithm::RS256).expect("a key");
        jwk.common.key_id = Some(KEY.to_owned());
        jwk
    }

    /// What the tool signed, checked as a platform checks it.
    pub fn checked(&self, token: &str, audience: &str) -> Value {
        let id = jsonwebtoken::decode_header(token).expect("a header").kid.expect("a key id");
        let seen = self.seen();
        let key = seen.tools_keys.as_ref().expect("keys").find(&id).expect("a published key");
        let mut rules = Validation::new(Algorithm::RS256);
        rules.set_audience(&[audience]);
        rules.set_issuer(&[CLIENT]);
        let key = DecodingKey::from_jwk(key).expect("a key");
        let claims = jsonwebtoken::decode::<Value>(token, &key, &rules).expect("a token of the tool's").claims;
        // This platform's clock is behind, and like Moodle's library it takes nothing that is of the future.
        let now = jsonwebtoken::get_current_timestamp() - BEHIND;
        assert!(claims["iat"].as_u64().expect("a time") <= now, "of the future: {claims}");
        claims
    }
}

async fn configuration(State(platform): State<Platform>) -> Json<Value> {
    let at = |path: &str| format!("{}/{path}", platform.issuer);
    Json(json!({
        "issuer": platform.issuer, "authorization_endpoint": at("auth"), "token_endpoint": at("token"),
        "jwks_uri": at("jwks"), "registration_endpoint": at("register"),
        "https://purl.imsglobal.org/spec/lti-platform-configuration": { "product_family_code": "moodle" },
    }))
}

async fn register(State(platform): State<Platform>, headers: HeaderMap, Json(asked): Json<Value>) -> Json<Value> {
    assert_eq!(headers[header::AUTHORIZATION], "Bearer one-time");
    let mut answer = asked.clone();
    platform.seen().registration = asked;
    answer["client_id"] = json!(CLIENT);
    answer["https://purl.imsglobal.org/spec/lti-tool-configuration"]["deployment_id"] = json!(DEPLOYMENT);
    Json(answer)
}

async fn jwks(State(platform): State<Platform>) -> Json<JwkSet> {
    Json(JwkSet { keys: vec![platform.jwk()] })
}

async fn token(State(platform): State<Platform>, Form(form): Form<HashMap<String, String>>) -> Json<Value> {
    assert_eq!(form["grant_type"], "client_credentials");
    assert_eq!(form["client_assertion_type"], "urn:ietf:params:oauth:client-assertion-type:jwt-bearer");
    let audience = platform.seen().audience.clone().unwrap_or_else(|| format!("{}/token", platform.issuer));
    let claims = platform.checked(&form["client_assertion"], &audience);
    assert_eq!((&claims["sub"], claims["jti"].is_string()), (&json!(CLIENT), true));
    platform.seen().tokens += 1;
    Json(json!({ "access_token": TOKEN, "token_type": "bearer", "expires_in": 3600, "scope": form["scope"] }))
}

fn is_authorized(headers: &HeaderMap) -> bool {
    headers[header::AUTHORIZATION] == format!("Bearer {TOKEN}").as_str()
}

async fn scores(
    State(platform): State<Platform>,
    Query(query): Query<HashMap<String, String>>,
    headers: HeaderMap,
    body: String,
) -> Response {
    let is_hanging = platform.seen().is_hanging;
    if is_hanging {
        std::future::pending::<()>().await;
    }
    let mut seen = platform.seen();
    seen.posts += 1;
    if let Some(status) = seen.failing {
        return (status, "not now").into_response();
    }
    if !is_authorized(&headers) {
        return StatusCode::UNAUTHORIZED.into_response();
    }
    assert_eq!(query["type_id"], "3");
    assert_eq!(headers[header::CONTENT_TYPE], "application/vnd.ims.lis.v1.score+json");
    let score: Value = serde_json::from_str(&body).expect("JSON");
    // Equal or earlier timestamps are refused, by whole seconds as Moodle does.
    let of_user = |old: &&Value| old["userId"] == score["userId"];
    let second = |score: &Value| score["timestamp"].as_str().map(|at| at[..19].to_owned());
    if let Some(last) = seen.scores.iter().rfind(of_user)
        && second(&score) <= second(last)
    {
        return StatusCode::CONFLICT.into_response();
    }
    seen.scores.push(score);
    StatusCode::OK.into_response()
}

/// A course's page, which has the tool in a frame.
async fn course(Query(query): Query<HashMap<String, String>>) -> Html<String> {
    let (tool, who, role) = (&query["tool"], &query["who"], &query["role"]);
    Html(format!(
        "<!DOCTYPE html><title>Course</title><link rel=icon href='data:,'><iframe src='/come?tool={tool}&who={who}&role={role}' width=900 height=700></iframe>"
    ))
}

/// Somebody opens the tool: `who` with `role`.
async fn come(State(platform): State<Platform>, Query(query): Query<HashMap<String, String>>) -> Html<String> {
    let hint = ggrade::service::identity::new_id();
    let (who, role) = (&query["who"], &query["role"]);
    platform.seen().hints.insert(hint.clone(), format!("{who} {role}"));
    Html(posted(
        &format!("{}/lti/login", query["tool"]),
        &[
            ("iss", &platform.issuer),
            ("login_hint", who),
            ("lti_message_hint", &hint),
            ("client_id", CLIENT),
            ("target_link_uri", "x"),
        ],
    ))
}

/// Says who it is, to whom it knows.
async fn auth(State(platform): State<Platform>, Query(query): Query<HashMap<String, String>>) -> Html<String> {
    assert_eq!((query["client_id"].as_str(), query["response_mode"].as_str()), (CLIENT, "form_post"));
    // The tool may say that it is behind https on this machine, for which nobody has a certificate.
    let back = query["redirect_uri"].replace("https://localhost", "http://localhost");
    let known = platform.seen().hints.remove(&query["lti_message_hint"]);
    let Some((who, role)) = known.as_deref().and_then(|known| known.split_once(' ')) else {
        let failed = [("error", "invalid_request"), ("state", &query["state"])];
        return Html(posted(&back, &failed));
    };
    let token = platform.sign(&platform.claims(&query["nonce"], who, role));
    Html(posted(&back, &[("id_token", &token), ("state", &query["state"])]))
}

/// A page that sends a form as soon as it is there.
fn posted(address: &str, fields: &[(&str, &str)]) -> String {
    let field = |(name, value): &(&str, &str)| format!("<input type=hidden name='{name}' value='{value}'>");
    let fields: String = fields.iter().map(field).collect();
    format!(
        "<!DOCTYPE html><link rel=icon href='data:,'><form method=post action='{address}'>{fields}</form><script>document.forms[0].submit()</script>"
    )
}

/// Two pages of people.
async fn memberships(
    State(platform): State<Platform>,
    Query(query): Query<HashMap<String, String>>,
    headers: HeaderMap,
) -> Response {
    assert!(is_authorized(&headers));
    assert_eq!(headers[header::ACCEPT], "application/vnd.ims.lti-nrps.v2.membershipcontainer+json");
    let member = |id: &str, role: &str, status: &str| {
        let role = format!("http://purl.imsglobal.org/vocab/lis/v2/membership#{role}");
        let name = (!platform.seen().is_nameless).then(|| format!("Name of {id}"));
        json!({ "user_id": id, "name": name, "email": name.as_ref().map(|_| format!("{id}@example.org")), "lis_person_sourcedid": id, "roles": [role], "status": status })
    };
    let kind = (header::CONTENT_TYPE, "application/vnd.ims.lti-nrps.v2.membershipcontainer+json".to_owned());
    if query.contains_key("page") {
        let members = json!({ "members": [member("s2", "Learner", "Active"), member("s3", "Learner", "Inactive")] });
        return ([kind], members.to_string()).into_response();
    }
    let members = json!({ "members": [member("s1", "Learner", "Active"), member("teacher", "Instructor", "Active")] });
    let named = platform.seen().next_page.clone();
    let named = named.unwrap_or_else(|| format!("<{}/memberships?page=2>; rel=\"next\"", platform.issuer));
    let next = (header::LINK, named);
    ([kind, next], members.to_string()).into_response()
}
