//! An OpenID issuer, written from the specifications: OpenID Connect Core 1.0 (code flow), Discovery 1.0, PKCE (RFC 7636). It has a
//! server and keys of its own.

use super::lti::platform::key;
use axum::extract::{Query, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Form, Json, Router};
use base64::prelude::{BASE64_STANDARD, BASE64_URL_SAFE_NO_PAD, Engine};
use jsonwebtoken::jwk::{Jwk, JwkSet};
use jsonwebtoken::{Algorithm, EncodingKey, Header};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

pub const CLIENT: &str = "ggrade of the course";
pub const SECRET: &str = "a secret: with a colon & more";
/// Whom it knows.
const PEOPLE: [&str; 3] = ["s1", "s2", "prof"];
const KEY: &str = "issuer-key";
const ACCESS: &str = "an-access-token";
const CURVE: &str = "issuer-curve";

/// The issuer.
#[derive(Clone)]
pub struct Issuer {
    pub address: String,
    /// Where it sends people back to.
    back: String,
    key: Arc<EncodingKey>,
    curve: Arc<EncodingKey>,
    seen: Arc<Mutex<Seen>>,
}

/// What it knows of sign-ins under way, and how it behaves.
#[derive(Default)]
pub struct Seen {
    /// Challenge and id token of each code that was not taken yet.
    codes: HashMap<String, (String, String)>,
    /// Another name than its own, where it lies.
    pub alias: Option<String>,
    /// Whether it takes the secret in the form alone.
    pub takes_post: bool,
    /// Whether it signs with an elliptic curve.
    pub signs_by_curve: bool,
    /// Whether it publishes a second key of the same kind.
    pub has_successor: bool,
    /// What its userinfo endpoint says; without it, it has none.
    pub userinfo: Option<Value>,
    /// How often it was asked what it is.
    pub discovered: usize,
}

/// A new key on an elliptic curve.
fn curve() -> EncodingKey {
    use aws_lc_rs::signature::{ECDSA_P256_SHA256_FIXED_SIGNING, EcdsaKeyPair};
    let random = aws_lc_rs::rand::SystemRandom::new();
    let key = EcdsaKeyPair::generate_pkcs8(&ECDSA_P256_SHA256_FIXED_SIGNING, &random).expect("a key");
    EncodingKey::from_ec_der(key.as_ref())
}

/// A public key as it is published.
fn published(key: &EncodingKey, algorithm: Algorithm, id: &str) -> Jwk {
    let mut jwk = Jwk::from_encoding_key(key, algorithm).expect("a key");
    jwk.common.key_id = Some(id.to_owned());
    jwk
}

impl Issuer {
    pub async fn start() -> Self {
        Self::sending_to("http://ggrade.example/signed-in").await
    }

    /// The same for a service at another address.
    pub async fn sending_to(back: &str) -> Self {
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = format!("http://{}/realm", listener.local_addr().expect("an address"));
        let back = back.to_owned();
        let issuer = Self { address, back, key: Arc::new(key()), curve: Arc::new(curve()), seen: Arc::default() };
        let routes = Router::new()
            .route("/realm/.well-known/openid-configuration", get(configuration))
            .route("/realm/jwks", get(jwks))
            .route("/realm/authorize", get(authorize))
            .route("/realm/token", post(token))
            .route("/realm/userinfo", get(userinfo))
            .with_state(issuer.clone());
        tokio::spawn(async move { axum::serve(listener, routes).await });
        issuer
    }

    pub fn seen(&self) -> std::sync::MutexGuard<'_, Seen> {
        self.seen.lock().expect("a lock")
    }

    /// The claims of somebody who has signed in.
    pub fn claims(&self, asked: &HashMap<String, String>, email: &str) -> Value {
        let now = jsonwebtoken::get_current_timestamp();
        json!({
            "iss": self.address, "aud": CLIENT, "sub": "248289761001", "nonce": asked["nonce"], "iat": now, "exp": now + 300,
            "email": email, "email_verified": true,
        })
    }

    /// Signs claims as the issuer does.
    pub fn sign(&self, claims: &Value) -> String {
        let (id, algorithm, key) = match self.seen().signs_by_curve {
            true => (CURVE, Algorithm::ES256, &self.curve),
            false => (KEY, Algorithm::RS256, &self.key),
        };
        let header = Header { kid: Some(id.to_owned()), ..Header::new(algorithm) };
        jsonwebtoken::encode(&header, claims, key).expect("a token")
    }

    /// The same with no word on which key it is.
    pub fn unnamed(&self, claims: &Value) -> String {
        jsonwebtoken::encode(&Header::new(Algorithm::RS256), claims, &self.key).expect("a token")
    }

    /// The modulus of its public key, which somebody may take for a secret.
    pub fn public_modulus(&self) -> String {
        serde_json::to_value(self.jwk()).expect("JSON")["n"].as_str().expect("a modulus").to_owned()
    }

    fn jwk(&self) -> Jwk {
        published(&self.key, Algorithm::RS256, KEY)
    }

    /// Signs somebody in who was sent with this question: the code for this id token.
    pub fn code(&self, asked: &HashMap<String, String>, token: &str) -> String {
        for (name, value) in [("response_type", "code"), ("client_id", CLIENT), ("redirect_uri", &self.back)] {
            assert_eq!(asked[name], value);
        }
        assert_eq!(asked["code_challenge_method"], "S256");
        assert!(asked["scope"].split(' ').any(|scope| scope == "openid"), "{asked:?}");
        assert!(asked["state"].len() >= 43 && asked["nonce"].len() >= 43, "{asked:?}");
        let code = ggrade::service::identity::new_id();
        self.seen().codes.insert(code.clone(), (asked["code_challenge"].clone(), token.to_owned()));
        code
    }
}

async fn configuration(State(issuer): State<Issuer>) -> Json<Value> {
    let at = |path: &str| format!("{}/{path}", issuer.address);
    let mut seen = issuer.seen();
    seen.discovered += 1;
    let methods = if seen.takes_post { json!(["client_secret_post"]) } else { json!(["client_secret_basic"]) };
    Json(json!({
        "issuer": seen.alias.as_ref().unwrap_or(&issuer.address), "authorization_endpoint": at("authorize?theme=dark"),
        "token_endpoint": at("token"), "userinfo_endpoint": seen.userinfo.as_ref().map(|_| at("userinfo")), "jwks_uri": at("jwks"), "token_endpoint_auth_methods_supported": methods,
        "response_types_supported": ["code"], "id_token_signing_alg_values_supported": if seen.signs_by_curve { json!(["RS256", "ES256", "HS256", "none"]) } else { json!(["RS256"]) },
    }))
}

/// The page on which people say that it is them: a link for each.
async fn authorize(State(issuer): State<Issuer>, Query(asked): Query<HashMap<String, String>>) -> Html<String> {
    let link = |who: &&str| {
        let token = issuer.sign(&issuer.claims(&asked, &format!("{who}@example.ac.jp")));
        let code = issuer.code(&asked, &token);
        format!("<p><a id={who} href='{}?code={code}&state={}'>{who}</a></p>", issuer.back, asked["state"])
    };
    Html(format!(
        "<!DOCTYPE html><title>Who are you?</title><link rel=icon href='data:,'>{}",
        PEOPLE.iter().map(link).collect::<String>()
    ))
}

async fn userinfo(State(issuer): State<Issuer>, headers: HeaderMap) -> Json<Option<Value>> {
    assert_eq!(headers[header::AUTHORIZATION], format!("Bearer {ACCESS}").as_str());
    Json(issuer.seen().userinfo.clone())
}

async fn jwks(State(issuer): State<Issuer>) -> Json<JwkSet> {
    let mut keys = vec![issuer.jwk(), published(&issuer.curve, Algorithm::ES256, CURVE)];
    if issuer.seen().has_successor {
        keys.push(published(&issuer.key, Algorithm::RS256, "issuer-key-2"));
    }
    Json(JwkSet { keys })
}

/// Whether a request to the token endpoint is this client's.
fn is_client(headers: &HeaderMap, form: &HashMap<String, String>, takes_post: bool) -> bool {
    if takes_post {
        return form.get("client_secret").is_some_and(|secret| secret == SECRET)
            && !headers.contains_key(header::AUTHORIZATION);
    }
    let encoded =
        |text: &str| percent_encoding::utf8_percent_encode(text, percent_encoding::NON_ALPHANUMERIC).to_string();
    let expected = BASE64_STANDARD.encode(format!("{}:{}", encoded(CLIENT), encoded(SECRET)));
    headers.get(header::AUTHORIZATION).is_some_and(|value| value == format!("Basic {expected}").as_str())
}

async fn token(
    State(issuer): State<Issuer>,
    headers: HeaderMap,
    Form(form): Form<HashMap<String, String>>,
) -> Response {
    let mut seen = issuer.seen();
    let refused = |why: &str| (StatusCode::BAD_REQUEST, Json(json!({ "error": why }))).into_response();
    if !is_client(&headers, &form, seen.takes_post) {
        return refused("invalid_client");
    }
    assert_eq!(form["grant_type"], "authorization_code");
    assert_eq!(form["redirect_uri"], issuer.back);
    // A code is taken once.
    let Some((challenge, token)) = seen.codes.remove(&form["code"]) else { return refused("invalid_grant") };
    if BASE64_URL_SAFE_NO_PAD.encode(Sha256::digest(&form["code_verifier"])) != challenge {
        return refused("invalid_grant");
    }
    Json(json!({ "access_token": ACCESS, "token_type": "Bearer", "id_token": token })).into_response()
}
