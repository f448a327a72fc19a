//! Id tokens (OpenID Connect Core, section 3.1.3.7): who vouches for somebody, checked to the last word before anything in a token
//! is believed. Learning platforms and issuers for signing in send them.

use super::lti::Connections;
use crate::language::Text;
use base64::prelude::{BASE64_URL_SAFE_NO_PAD, Engine};
use jsonwebtoken::errors::ErrorKind;
use jsonwebtoken::jwk::{AlgorithmParameters, EllipticCurve, Jwk, JwkSet, PublicKeyUse};
use jsonwebtoken::{Algorithm, DecodingKey, Validation, decode, decode_header};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Seconds by which clocks may differ. Tokens live for a minute.
const LEEWAY: u64 = 30;

/// Whose tokens are believed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Issuer<'a> {
    /// Its name for itself.
    pub issuer: &'a str,
    /// Its name for this service.
    pub client_id: &'a str,
    /// Where its public keys are.
    pub keys_url: &'a str,
    /// By which algorithms it signs, all of them with a key of its own.
    pub algorithms: &'a [Algorithm],
}

/// What learning platforms sign by (1EdTech Security Framework 1.0, section 5.1.1), and issuers that say nothing else.
pub(super) const USUAL: [Algorithm; 1] = [Algorithm::RS256];

/// The algorithms that are believed among these names: those whose keys are public. A secret that both know proves nothing here.
pub(super) fn algorithms(names: &[String]) -> Vec<Algorithm> {
    use Algorithm::{ES256, ES384, EdDSA, PS256, PS384, PS512, RS256, RS384, RS512};
    let known = [RS256, RS384, RS512, PS256, PS384, PS512, ES256, ES384, EdDSA];
    known.into_iter().filter(|known| names.iter().any(|name| *name == format!("{known:?}"))).collect()
}

/// A claim of a token of which nothing is proved yet: to know whose keys are to be asked for.
pub(super) fn unproved(token: &str, claim: &str) -> Option<String> {
    let body = BASE64_URL_SAFE_NO_PAD.decode(token.split('.').nth(1)?).ok()?;
    Some(serde_json::from_slice::<Value>(&body).ok()?.get(claim)?.as_str()?.to_owned())
}

/// What the library does not check.
#[derive(Deserialize)]
struct CommonClaims {
    aud: Value,
    azp: Option<String>,
    iat: Option<f64>,
}

/// The claims of a token of this issuer; why it is not believed, where it is not.
pub(super) async fn read<C: DeserializeOwned>(
    connections: &Connections,
    of: Issuer<'_>,
    token: &str,
) -> Result<C, Text> {
    // `none` is no algorithm that this knows, and a secret in the place of a key is no RSA.
    let header = decode_header(token).map_err(|error| untrusted(&error))?;
    if !of.algorithms.contains(&header.alg) {
        let names: Vec<String> = of.algorithms.iter().map(|known| format!("{known:?}")).collect();
        let names = names.join(", ");
        return Err(Text::new(format!("it is not signed with {names}"), format!("{names} で署名されていません")));
    }
    let find = |keys: &JwkSet| match &header.kid {
        Some(id) => keys.find(id).cloned(),
        None => only_one(keys, header.alg),
    };
    let key = connections.key(of.keys_url, find).await.map_err(|failure| {
        let id = header.kid.as_deref().unwrap_or_default();
        tracing::warn!(failure, id, "the key of an id token");
        let en = match id {
            "" => {
                "it names no key, and who sent it has not published exactly one for it, or cannot be reached".to_owned()
            }
            id => format!("who sent it has published no key `{id}`, or cannot be reached"),
        };
        Text::new(en, "発行元の公開鍵を取得できません")
    })?;
    let key = DecodingKey::from_jwk(&key).map_err(|error| untrusted(&error))?;
    let mut rules = Validation::new(header.alg);
    rules.leeway = LEEWAY;
    rules.validate_nbf = true;
    rules.set_audience(&[of.client_id]);
    rules.set_issuer(&[of.issuer]);
    rules.set_required_spec_claims(&["exp", "aud", "iss"]);
    let claims: Value = decode(token, &key, &rules).map_err(|error| untrusted(&error))?.claims;
    let unreadable = |error| {
        tracing::warn!(%error, "the claims of an id token");
        Text::new("its claims cannot be read", "内容を読み取れません")
    };
    CommonClaims::deserialize(&claims).map_err(unreadable)?.check(of.client_id)?;
    C::deserialize(claims).map_err(unreadable)
}

/// The key for a token that names none, where it can be one only (OpenID Connect Core, section 10.1).
fn only_one(keys: &JwkSet, algorithm: Algorithm) -> Option<Jwk> {
    let mut fitting = keys.keys.iter().filter(|key| fits(key, algorithm));
    let first = fitting.next()?;
    fitting.next().is_none().then(|| first.clone())
}

/// Whether a key can sign by an algorithm.
fn fits(key: &Jwk, algorithm: Algorithm) -> bool {
    use Algorithm::{ES256, ES384, EdDSA, PS256, PS384, PS512, RS256, RS384, RS512};
    let is_of_kind = match &key.algorithm {
        AlgorithmParameters::RSA(_) => matches!(algorithm, RS256 | RS384 | RS512 | PS256 | PS384 | PS512),
        AlgorithmParameters::EllipticCurve(point) => match point.curve {
            EllipticCurve::P256 => algorithm == ES256,
            EllipticCurve::P384 => algorithm == ES384,
            _ => false,
        },
        AlgorithmParameters::OctetKeyPair(_) => algorithm == EdDSA,
        _ => false,
    };
    let is_meant = key.common.key_algorithm.is_none_or(|meant| meant == algorithm.into());
    is_of_kind && is_meant && key.common.public_key_use != Some(PublicKeyUse::Encryption)
}

impl CommonClaims {
    fn check(&self, client_id: &str) -> Result<(), Text> {
        let is_for_several = self.aud.as_array().is_some_and(|audience| audience.len() > 1);
        if self.azp.as_deref().map_or(is_for_several, |party| party != client_id) {
            return Err(Text::new("it is for another client (azp)", "別の利用者宛てです (azp)"));
        }
        let now = jsonwebtoken::get_current_timestamp();
        if self.iat.is_none_or(|at| at > (now + LEEWAY) as f64) {
            return Err(Text::new("it is of the future, or has no time (iat)", "発行時刻 (iat) が正しくありません"));
        }
        Ok(())
    }
}

fn untrusted(error: &jsonwebtoken::errors::Error) -> Text {
    let (en, ja) = match error.kind() {
        ErrorKind::ExpiredSignature => ("it is too old (exp)", "有効期限が切れています"),
        ErrorKind::ImmatureSignature => ("it is not valid yet (nbf)", "まだ有効ではありません (nbf)"),
        ErrorKind::InvalidAudience => ("it is for another client (aud)", "別の利用者宛てです (aud)"),
        ErrorKind::InvalidIssuer => ("it is of another issuer (iss)", "別の発行元のものです (iss)"),
        ErrorKind::InvalidSignature => ("its signature is wrong", "署名が正しくありません"),
        ErrorKind::MissingRequiredClaim(_) => ("a claim is missing", "必要な項目がありません"),
        _ => ("it is no signed token", "署名されたトークンではありません"),
    };
    Text::new(en, ja)
}
