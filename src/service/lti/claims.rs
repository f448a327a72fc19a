//! What a platform vouches for: an id token, checked to the last word before anything in it is believed.

use super::super::Service;
use super::super::store::Platform;
use super::refused;
use crate::service::errors::Problem;
use jsonwebtoken::errors::ErrorKind;
use jsonwebtoken::{Algorithm, DecodingKey, Validation, decode, decode_header};
use serde::Deserialize;
use serde_json::{Map, Value};

/// Seconds by which clocks may differ. Tokens live for a minute.
const LEEWAY: u64 = 30;

/// What the messages are called.
pub(super) const RESOURCE_LINK: &str = "LtiResourceLinkRequest";
pub(super) const DEEP_LINKING: &str = "LtiDeepLinkingRequest";

/// The claims of a launch.
#[derive(Debug, Deserialize)]
pub(super) struct Claims {
    pub nonce: Option<String>,
    azp: Option<String>,
    aud: Value,
    iat: Option<f64>,
    pub sub: Option<String>,
    pub name: Option<String>,
    pub given_name: Option<String>,
    pub family_name: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/message_type")]
    pub message_type: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/version")]
    version: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/deployment_id")]
    pub deployment_id: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/target_link_uri")]
    pub target_link_uri: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/resource_link")]
    pub resource_link: Option<ResourceLink>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/roles", default)]
    pub roles: Vec<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/context")]
    pub context: Option<Context>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/lis")]
    pub lis: Option<Lis>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/ext")]
    pub ext: Option<Ext>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/custom", default)]
    pub custom: Option<Map<String, Value>>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint")]
    pub grades: Option<Grades>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice")]
    pub names: Option<Names>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti-dl/claim/deep_linking_settings")]
    pub deep_linking: Option<DeepLinking>,
}

#[derive(Debug, Deserialize)]
pub(super) struct ResourceLink {
    pub id: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Context {
    pub id: String,
}

/// What an information system of the university knows them by.
#[derive(Debug, Deserialize)]
pub(super) struct Lis {
    pub person_sourcedid: Option<String>,
}

/// What Moodle says besides.
#[derive(Debug, Deserialize)]
pub(super) struct Ext {
    pub user_username: Option<String>,
}

/// Where grades go.
#[derive(Debug, Deserialize)]
pub(super) struct Grades {
    #[serde(default)]
    pub scope: Vec<String>,
    pub lineitem: Option<String>,
}

/// Where the people of the course are.
#[derive(Debug, Deserialize)]
pub(super) struct Names {
    pub context_memberships_url: Option<String>,
}

/// Where a choice of homework goes.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct DeepLinking {
    pub deep_link_return_url: String,
    pub data: Option<String>,
}

impl Claims {
    /// The claims of an id token of this platform.
    pub async fn read(service: &Service, platform: &Platform, token: &str) -> Result<Self, Problem> {
        // `none` is no algorithm that this knows, and a secret in the place of a key is no RSA.
        let header = decode_header(token).map_err(|error| untrusted(&error))?;
        if header.alg != Algorithm::RS256 {
            return Err(wrong("it is not signed with RS256", "RS256 で署名されていません"));
        }
        let Some(id) = header.kid else { return Err(wrong("it names no key", "鍵の指定がありません")) };
        let key = service.lti.key(platform, &id).await.map_err(|failure| {
            tracing::warn!(failure, "the key of a launch");
            wrong(
                &format!("the platform has published no key `{id}`, or cannot be reached"),
                "プラットフォームの公開鍵を取得できません",
            )
        })?;
        let key = DecodingKey::from_jwk(&key).map_err(|error| untrusted(&error))?;
        let mut rules = Validation::new(Algorithm::RS256);
        rules.leeway = LEEWAY;
        rules.set_audience(&[&platform.client_id]);
        rules.set_issuer(&[&platform.issuer]);
        rules.set_required_spec_claims(&["exp", "aud", "iss"]);
        let claims: Self = decode(token, &key, &rules).map_err(|error| untrusted(&error))?.claims;
        claims.check(platform)?;
        Ok(claims)
    }

    /// What the library does not check.
    fn check(&self, platform: &Platform) -> Result<(), Problem> {
        let is_for_several = self.aud.as_array().is_some_and(|audience| audience.len() > 1);
        let party = self.azp.as_deref();
        if party.map_or(is_for_several, |party| party != platform.client_id) {
            return Err(wrong("it is for another tool (azp)", "別のツール宛てです (azp)"));
        }
        let now = jsonwebtoken::get_current_timestamp();
        if self.iat.is_none_or(|at| at > (now + LEEWAY) as f64) {
            return Err(wrong("it is of the future, or has no time (iat)", "発行時刻 (iat) が正しくありません"));
        }
        if self.version.as_deref() != Some("1.3.0") {
            return Err(wrong("it is not of LTI 1.3.0", "LTI 1.3.0 のメッセージではありません"));
        }
        Ok(())
    }

    /// Whether one of the roles is of this kind, in the course or anywhere.
    fn has_role(&self, names: &[&str]) -> bool {
        let is_one = |role: &String| names.iter().any(|name| role.rsplit(['#', '/']).next() == Some(*name));
        self.roles.iter().any(|role| is_one(role) && !role.contains("/institution/"))
    }

    /// Whether they are a teaching assistant, and no more.
    pub fn is_assistant(&self) -> bool {
        self.has_role(&["TeachingAssistant"])
    }

    /// Whether they teach the course.
    pub fn is_staff(&self) -> bool {
        self.has_role(&["Instructor", "TeachingAssistant", "Administrator", "ContentDeveloper"])
    }

    /// Their name, as far as the platform tells it.
    pub fn full_name(&self) -> String {
        let parts = [&self.family_name, &self.given_name];
        let joined = || parts.into_iter().flatten().map(String::as_str).collect::<Vec<_>>().join(" ");
        self.name.clone().unwrap_or_else(joined)
    }
}

/// The refusal of a token.
fn wrong(en: &str, ja: &str) -> Problem {
    refused(
        format!("The learning platform's message is not accepted: {en}. Go back there and open the homework again."),
        format!(
            "学習プラットフォームからの情報を受け付けられません（{ja}）。プラットフォームに戻り、課題を開き直してください。"
        ),
    )
}

fn untrusted(error: &jsonwebtoken::errors::Error) -> Problem {
    let (en, ja) = match error.kind() {
        ErrorKind::ExpiredSignature => ("it is too old (exp)", "有効期限が切れています"),
        ErrorKind::InvalidAudience => ("it is for another tool (aud)", "別のツール宛てです (aud)"),
        ErrorKind::InvalidIssuer => ("it is of another platform (iss)", "別のプラットフォームのものです (iss)"),
        ErrorKind::InvalidSignature => ("its signature is wrong", "署名が正しくありません"),
        ErrorKind::MissingRequiredClaim(_) => ("a claim is missing", "必要な項目がありません"),
        _ => ("it is no signed token", "署名されたトークンではありません"),
    };
    wrong(en, ja)
}
