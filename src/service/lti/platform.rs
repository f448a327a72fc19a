//! Asking a platform: its keys, a token for its services, and these.

use super::super::Service;
use super::super::clients::{Clients, causes};
use super::super::identity::new_id;
use super::super::store::Platform;
use super::keys::{issued_at, sign};
use crate::language::Text;
use jsonwebtoken::jwk::{Jwk, JwkSet};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use reqwest::{Method, Response, StatusCode, Url};
use serde::Deserialize;
use serde_json::json;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The longest answer of a platform, in bytes.
const LONGEST: usize = 4 << 20;

/// How soon keys are fetched again for one that is not among them.
const REFETCH: Duration = Duration::from_secs(10);

/// How long keys are believed: one that its owner has withdrawn signs nothing after that.
const BELIEVED: Duration = Duration::from_secs(3600);

/// How long what an issuer says of itself is kept.
const KEPT: Duration = Duration::from_secs(600);

/// Seconds for which a request for a token holds, and before the end of which a token is not used any more.
const ASSERTION: i64 = 60;
const MARGIN: u64 = 30;

/// What is kept of platforms between requests.
#[derive(Debug, Default)]
pub struct Connections {
    clients: Clients,
    /// What issuers say of themselves, by its address.
    said: Mutex<HashMap<String, (Instant, serde_json::Value)>>,
    /// Keys by their address.
    keys: Mutex<HashMap<String, (Instant, Arc<JwkSet>)>>,
    /// Tokens by platform and scope.
    tokens: Mutex<HashMap<(String, String), (Instant, String)>>,
}

/// What a platform did not do: for the log and for its administrator.
pub type Failure = String;

/// An address of a platform's: https, or this very machine.
pub(in crate::service) fn checked(address: &str) -> Result<Url, Text> {
    let is_here = |url: &Url| matches!(url.host_str(), Some("localhost" | "127.0.0.1" | "[::1]"));
    let url = Url::parse(address).ok().filter(|url| match url.scheme() {
        "https" => true,
        scheme => scheme == "http" && is_here(url),
    });
    url.ok_or_else(|| {
        Text::new(format!("{address} is no https address"), format!("{address} は https のアドレスではありません。"))
    })
}

impl Connections {
    fn request(&self, method: Method, address: &str) -> Result<reqwest::RequestBuilder, Failure> {
        let url = checked(address).map_err(|why| why.en)?;
        let client = self.clients.of(&url).map_err(|failure| format!("{address}: {failure}"))?;
        Ok(client.request(method, url))
    }

    /// The JSON at an address.
    pub(in crate::service) async fn json(&self, address: &str) -> Result<serde_json::Value, Failure> {
        let response = answered(address, self.request(Method::GET, address)?).await?;
        parsed(address, response).await
    }

    /// The JSON at an address for who has this token.
    pub(in crate::service) async fn json_for(&self, address: &str, token: &str) -> Result<serde_json::Value, Failure> {
        let response = answered(address, self.request(Method::GET, address)?.bearer_auth(token)).await?;
        parsed(address, response).await
    }

    /// The JSON at an address, which is asked for once in a while.
    pub(in crate::service) async fn kept_json(&self, address: &str) -> Result<serde_json::Value, Failure> {
        let kept = lock(&self.said).get(address).filter(|(since, _)| since.elapsed() < KEPT).cloned();
        if let Some((_, said)) = kept {
            return Ok(said);
        }
        let said = self.json(address).await?;
        lock(&self.said).insert(address.to_owned(), (Instant::now(), said.clone()));
        Ok(said)
    }

    /// Sends JSON, and reads what comes back; `token` is that of a registration.
    pub(super) async fn register(
        &self,
        address: &str,
        token: Option<&str>,
        body: &serde_json::Value,
    ) -> Result<serde_json::Value, Failure> {
        let mut request = self.request(Method::POST, address)?.json(body);
        if let Some(token) = token {
            request = request.bearer_auth(token);
        }
        parsed(address, answered(address, request).await?).await
    }

    /// Sends a form, and reads the JSON that comes back; `login` is who this service is there, and its secret.
    pub(in crate::service) async fn post_form(
        &self,
        address: &str,
        form: &[(&str, &str)],
        login: Option<(&str, &str)>,
    ) -> Result<serde_json::Value, Failure> {
        let mut request = self.request(Method::POST, address)?.form(form);
        if let Some((name, secret)) = login {
            // Both are encoded as in a form before they go into the header (RFC 6749, section 2.3.1).
            let encoded = |text: &str| utf8_percent_encode(text, NON_ALPHANUMERIC).to_string();
            request = request.basic_auth(encoded(name), Some(encoded(secret)));
        }
        parsed(address, answered(address, request).await?).await
    }

    /// The public key that is looked for, of those that are published at an address.
    pub(in crate::service) async fn key(
        &self,
        address: &str,
        find: impl Fn(&JwkSet) -> Option<Jwk>,
    ) -> Result<Jwk, Failure> {
        let kept = lock(&self.keys).get(address).filter(|(since, _)| since.elapsed() < BELIEVED).cloned();
        if let Some((since, keys)) = kept {
            if let Some(key) = find(&keys) {
                return Ok(key);
            }
            if since.elapsed() < REFETCH {
                return Err(no_key(address));
            }
        }
        let keys: JwkSet = serde_json::from_value(self.json(address).await?).map_err(|e| format!("{address}: {e}"))?;
        let found = find(&keys);
        lock(&self.keys).insert(address.to_owned(), (Instant::now(), Arc::new(keys)));
        found.ok_or_else(|| no_key(address))
    }

    /// Asks a service of a platform for something, or sends it something.
    pub(super) async fn call(
        service: &Service,
        platform: &Platform,
        scope: &str,
        (method, address, kind): (Method, &str, &str),
        body: Option<&serde_json::Value>,
    ) -> Result<Response, Failure> {
        let connections = &service.lti;
        let token = connections.token(service, platform, scope).await?;
        let mut request = connections.request(method, address)?.bearer_auth(token);
        request = match body {
            Some(body) => request.header("content-type", kind).body(body.to_string()),
            None => request.header("accept", kind),
        };
        let response = request.send().await.map_err(|error| format!("{address}: {}", causes(&error)))?;
        if response.status() == StatusCode::UNAUTHORIZED {
            lock(&connections.tokens).remove(&(platform.id.clone(), scope.to_owned()));
        }
        succeeded(address, response).await
    }

    /// A token for a scope, kept until it is about to end.
    async fn token(&self, service: &Service, platform: &Platform, scope: &str) -> Result<String, Failure> {
        let key = (platform.id.clone(), scope.to_owned());
        if let Some((until, token)) = lock(&self.tokens).get(&key)
            && *until > Instant::now()
        {
            return Ok(token.clone());
        }
        let now = service.clock.now() / 1000;
        let address = &platform.token_url;
        let claims = json!({
            "iss": platform.client_id,
            "sub": platform.client_id,
            "aud": platform.token_audience.as_ref().unwrap_or(address),
            "iat": issued_at(service),
            "exp": now + ASSERTION,
            "jti": new_id(),
        });
        let assertion = sign(service, platform, &claims).await.map_err(|problem| problem.detail.en)?;
        let form = [
            ("grant_type", "client_credentials"),
            ("client_assertion_type", "urn:ietf:params:oauth:client-assertion-type:jwt-bearer"),
            ("client_assertion", &assertion),
            ("scope", scope),
        ];
        let response = answered(address, self.request(Method::POST, address)?.form(&form)).await?;
        let PlatformToken { access_token, expires_in } = parsed(address, response).await?;
        let life = Duration::from_secs(expires_in.unwrap_or(ASSERTION as u64).saturating_sub(MARGIN));
        lock(&self.tokens).insert(key, (Instant::now() + life, access_token.clone()));
        Ok(access_token)
    }
}

#[derive(Deserialize)]
struct PlatformToken {
    access_token: String,
    expires_in: Option<u64>,
}

fn no_key(address: &str) -> Failure {
    format!("{address} has no such key")
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

async fn answered(address: &str, request: reqwest::RequestBuilder) -> Result<Response, Failure> {
    let response = request.send().await.map_err(|error| format!("{address}: {}", causes(&error)))?;
    succeeded(address, response).await
}

/// An answer of success; another one with the beginning of what it says.
async fn succeeded(address: &str, response: Response) -> Result<Response, Failure> {
    let status = response.status();
    if status.is_success() {
        return Ok(response);
    }
    let said = bytes(response).await.unwrap_or_default();
    let said: String = String::from_utf8_lossy(&said).chars().filter(|c| !c.is_control()).take(200).collect();
    Err(format!("{address} answered {status}: {said}"))
}

async fn bytes(mut response: Response) -> Option<Vec<u8>> {
    let mut all = Vec::new();
    while let Some(chunk) = response.chunk().await.ok()? {
        all.extend_from_slice(&chunk);
        if all.len() > LONGEST {
            return None;
        }
    }
    Some(all)
}

pub(super) async fn parsed<T: serde::de::DeserializeOwned>(address: &str, response: Response) -> Result<T, Failure> {
    let bytes = bytes(response).await.ok_or_else(|| format!("{address}: the answer breaks off, or is too long"))?;
    serde_json::from_slice(&bytes).map_err(|error| format!("{address}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn keys_are_fetched_again_when_they_are_old() {
        let keys = json!({ "keys": [{ "kty": "RSA", "kid": "a", "n": "AQAB", "e": "AQAB" }] });
        let keys: Arc<JwkSet> = Arc::new(serde_json::from_value(keys).expect("keys"));
        let connections = Connections::default();
        // Nobody answers there.
        let address = "http://127.0.0.1:1/jwks";
        for (age, is_believed) in [(Duration::ZERO, true), (BELIEVED / 2, true), (BELIEVED, false)] {
            let since = Instant::now().checked_sub(age).expect("a time");
            lock(&connections.keys).insert(address.to_owned(), (since, Arc::clone(&keys)));
            let found = connections.key(address, |keys| keys.find("a").cloned()).await;
            assert_eq!(found.is_ok(), is_believed, "{age:?}: {found:?}");
        }
    }
}
