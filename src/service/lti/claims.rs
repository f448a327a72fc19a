//! What a platform vouches for: the claims of its id token.

use super::super::Service;
use super::super::store::{Platform, StaffRole};
use super::{refused, roles};
use crate::service::errors::Problem;
use crate::service::id_tokens::{self, Issuer};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

/// What the messages are called.
pub(super) const RESOURCE_LINK: &str = "LtiResourceLinkRequest";
pub(super) const DEEP_LINKING: &str = "LtiDeepLinkingRequest";

/// The claims of a launch.
#[derive(Debug, Deserialize)]
pub(super) struct Claims {
    pub nonce: Option<String>,
    #[serde(default, deserialize_with = "id_or_none")]
    pub sub: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    pub name: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    pub given_name: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    pub family_name: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/message_type", default, deserialize_with = "or_none")]
    pub message_type: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/version", default, deserialize_with = "or_none")]
    version: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/deployment_id", default, deserialize_with = "or_none")]
    pub deployment_id: Option<String>,
    #[serde(
        rename = "https://purl.imsglobal.org/spec/lti/claim/target_link_uri",
        default,
        deserialize_with = "or_none"
    )]
    pub target_link_uri: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/resource_link", default, deserialize_with = "or_none")]
    pub resource_link: Option<ResourceLink>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/roles", default, deserialize_with = "or_none")]
    roles: Option<Vec<String>>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/context", default, deserialize_with = "or_none")]
    pub context: Option<ContextClaim>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/lis", default, deserialize_with = "or_none")]
    pub lis: Option<Lis>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/ext", default, deserialize_with = "or_none")]
    pub ext: Option<Ext>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/custom", default, deserialize_with = "or_none")]
    pub custom: Option<Map<String, Value>>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint", default, deserialize_with = "or_none")]
    pub grades: Option<Grades>,
    #[serde(
        rename = "https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice",
        default,
        deserialize_with = "or_none"
    )]
    pub names: Option<MembershipsClaim>,
    #[serde(
        rename = "https://purl.imsglobal.org/spec/lti-dl/claim/deep_linking_settings",
        default,
        deserialize_with = "or_none"
    )]
    pub deep_linking: Option<DeepLinking>,
}

#[derive(Debug, Deserialize)]
pub(super) struct ResourceLink {
    #[serde(deserialize_with = "id")]
    pub id: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct ContextClaim {
    #[serde(deserialize_with = "id")]
    pub id: String,
    #[serde(default, deserialize_with = "or_none")]
    label: Option<String>,
    #[serde(default, deserialize_with = "or_none")]
    title: Option<String>,
}

/// What an information system of the university knows them by.
#[derive(Debug, Deserialize)]
pub(super) struct Lis {
    #[serde(default, deserialize_with = "or_none")]
    pub person_sourcedid: Option<String>,
}

/// What Moodle says besides.
#[derive(Debug, Deserialize)]
pub(super) struct Ext {
    #[serde(default, deserialize_with = "or_none")]
    pub user_username: Option<String>,
}

/// Where grades go.
#[derive(Debug, Deserialize)]
pub(super) struct Grades {
    #[serde(default)]
    pub scope: Vec<String>,
    #[serde(default, deserialize_with = "or_none")]
    pub lineitem: Option<String>,
}

/// Where the people of the course are.
#[derive(Debug, Deserialize)]
pub(super) struct MembershipsClaim {
    #[serde(default, deserialize_with = "or_none")]
    pub context_memberships_url: Option<String>,
}

/// Where a choice of homework goes.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct DeepLinking {
    pub deep_link_return_url: String,
    #[serde(default, deserialize_with = "or_none")]
    pub data: Option<String>,
    accept_multiple: Option<Value>,
}

impl ContextClaim {
    /// What people call it.
    pub fn name(&self) -> &str {
        let names = [&self.title, &self.label].into_iter().flatten();
        names.map(|name| name.trim()).find(|name| !name.is_empty()).unwrap_or_default()
    }
}

impl DeepLinking {
    /// Whether several links may be chosen at once; Moodle has said it as a text.
    pub fn takes_several(&self) -> bool {
        self.accept_multiple.as_ref().is_some_and(|said| *said == true || *said == "true")
    }
}

/// An id, which the standard wants to be a text and some platforms send as a number.
pub(super) fn id<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    match Value::deserialize(deserializer)? {
        Value::String(text) => Ok(text),
        Value::Number(number) => Ok(number.to_string()),
        other => Err(serde::de::Error::custom(format!("an id is {other}"))),
    }
}

/// The same where it may be missing.
fn id_or_none<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<String>, D::Error> {
    match Value::deserialize(deserializer)? {
        Value::Null => Ok(None),
        value => id(value).map(Some).map_err(serde::de::Error::custom),
    }
}

/// What a platform need not say, and some say as nothing else does: PHP writes an empty list where it means an empty object. What cannot
/// be read was not said.
pub(super) fn or_none<'de, D: Deserializer<'de>, T: DeserializeOwned>(deserializer: D) -> Result<Option<T>, D::Error> {
    Ok(serde_json::from_value(Value::deserialize(deserializer)?).ok())
}

impl Claims {
    /// The claims of an id token of this platform.
    pub async fn read(service: &Service, platform: &Platform, token: &str) -> Result<Self, Problem> {
        let of = Issuer {
            issuer: &platform.issuer,
            client_id: &platform.client_id,
            keys_url: &platform.keys_url,
            algorithms: &id_tokens::USUAL,
        };
        let claims: Self = id_tokens::read(&service.lti, of, token).await.map_err(|why| wrong(&why.en, &why.ja))?;
        if claims.version.as_deref() != Some("1.3.0") {
            return Err(wrong("it is not of LTI 1.3.0", "LTI 1.3.0 のメッセージではありません"));
        }
        Ok(claims)
    }

    fn roles(&self) -> &[String] {
        self.roles.as_deref().unwrap_or_default()
    }

    /// What they may do in the course; none for who does not teach it.
    pub fn staff_role(&self) -> Option<StaffRole> {
        roles::staff_role(self.roles())
    }

    /// Whether they are a student of the course.
    pub fn is_learner(&self) -> bool {
        roles::is_learner(self.roles())
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
