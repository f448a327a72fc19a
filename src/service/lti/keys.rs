//! The keys with which this service signs: made when the first is needed, and changed from time to time.

use super::super::Service;
use super::super::blocking::aside;
use super::super::clock::{Millis, millis};
use super::super::errors::Problem;
use super::super::identity::new_id;
use super::super::store::{Platform, Store};
use super::contexts;
use aws_lc_rs::encoding::AsDer;
use aws_lc_rs::rsa::{KeyPair, KeySize};
use axum::Json;
use axum::extract::State as Shared;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use base64::prelude::{BASE64_STANDARD, Engine};
use jsonwebtoken::jwk::{Jwk, JwkSet, PublicKeyUse};
use jsonwebtoken::{Algorithm, EncodingKey, Header};
use serde::Serialize;
use std::time::Duration;

const DAY: Duration = Duration::from_secs(24 * 3600);

/// How long a key is the newest.
const LIFE: u32 = 90;

/// How long a new key is published before it signs: platforms keep what they have fetched. The first one signs at once.
const HERALD: u32 = 2;

/// How long a key stays published after it was made.
const KEPT: u32 = 2 * LIFE;

/// By how many seconds a signature is dated back: a platform whose clock is behind refuses what is of the future, as Moodle does, and
/// allows for no difference.
const BACKDATED: i64 = 30;

/// When what is signed now was issued, in seconds.
pub(super) fn issued_at(service: &Service) -> i64 {
    service.clock.now() / 1000 - BACKDATED
}

/// A key that signs.
struct SigningKey {
    id: String,
    key: EncodingKey,
}

/// `GET /lti/jwks.json`: the public keys.
pub async fn published(Shared(service): Shared<Service>) -> Result<Response, Problem> {
    renew(&service, &service.store).await?;
    let mut keys = Vec::new();
    for (id, pem, _) in service.store.signing_keys().await? {
        let key = EncodingKey::from_rsa_pem(pem.as_bytes()).map_err(|error| Problem::internal(&error))?;
        let mut jwk = Jwk::from_encoding_key(&key, Algorithm::RS256).map_err(|error| Problem::internal(&error))?;
        jwk.common.key_id = Some(id);
        jwk.common.public_key_use = Some(PublicKeyUse::Signature);
        keys.push(jwk);
    }
    Ok(([(header::CACHE_CONTROL, "public, max-age=300")], Json(JwkSet { keys })).into_response())
}

/// Claims for a platform, signed by this service.
pub(super) async fn sign(service: &Service, platform: &Platform, claims: &impl Serialize) -> Result<String, Problem> {
    let SigningKey { id, key } = signing(service, contexts::home(service, &platform.id).await?).await?;
    let header = Header { kid: Some(id), ..Header::new(Algorithm::RS256) };
    jsonwebtoken::encode(&header, claims, &key).map_err(|error| Problem::internal(&error))
}

/// The newest key that has been published for long enough.
async fn signing(service: &Service, store: &Store) -> Result<SigningKey, Problem> {
    renew(service, store).await?;
    let known = days(HERALD);
    let keys = store.signing_keys().await?;
    let now = service.clock.now();
    let heralded = keys.iter().rev().find(|(_, _, since)| since + known <= now);
    let (id, pem, _) = heralded.or(keys.first()).ok_or_else(|| Problem::internal(&"there is no key to sign with"))?;
    let key = EncodingKey::from_rsa_pem(pem.as_bytes()).map_err(|error| Problem::internal(&error))?;
    Ok(SigningKey { id: id.clone(), key })
}

/// Makes a key where there is none, or where the newest is old.
async fn renew(service: &Service, store: &Store) -> Result<(), Problem> {
    let now = service.clock.now();
    let newest = store.signing_keys().await?.last().map(|(_, _, since)| *since);
    if newest.is_some_and(|since| since + days(LIFE) > now) {
        return Ok(());
    }
    let pem = aside(new_key).await?.map_err(|error| Problem::internal(&error))?;
    Ok(store.add_signing_key(&new_id(), &pem, now, now - days(KEPT)).await?)
}

fn days(days: u32) -> Millis {
    millis(DAY) * Millis::from(days)
}

/// A new RSA key of 2048 bits in PEM, as PKCS #8.
fn new_key() -> Result<String, aws_lc_rs::error::Unspecified> {
    let der = KeyPair::generate(KeySize::Rsa2048)?.as_der()?;
    let text = BASE64_STANDARD.encode(der.as_ref());
    let lines: Vec<&str> = text.as_bytes().chunks(64).filter_map(|line| std::str::from_utf8(line).ok()).collect();
    Ok(format!("-----BEGIN PRIVATE KEY-----\n{}\n-----END PRIVATE KEY-----\n", lines.join("\n")))
}
