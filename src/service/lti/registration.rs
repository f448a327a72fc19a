//! Dynamic registration: an administrator opens a link of this service in the platform, and both know each other.

use super::super::Service;
use super::super::clock::{Millis, millis};
use super::super::errors::Problem;
use super::super::identity::{new_id, new_token, token_hash};
use super::super::store::Platform;
use super::platform::checked;
use super::{address, memberships, refused, scores};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::time::Duration;

/// Name of the setting that holds the secret of the link, and how long that holds.
const SETTING: &str = "lti_registration";
const HOLDS: Duration = Duration::from_secs(24 * 3600);

/// What the standards call the parts of a registration.
const TOOL: &str = "https://purl.imsglobal.org/spec/lti-tool-configuration";
const PLATFORM: &str = "https://purl.imsglobal.org/spec/lti-platform-configuration";

/// The secret of the link, as it is kept.
#[derive(Serialize, Deserialize)]
struct Kept {
    hash: String,
    until: Millis,
}

/// What a platform opens the link with.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct RegistrationQuery {
    /// Where the platform says what it is.
    pub openid_configuration: String,
    registration_token: Option<String>,
}

/// A new link. It works once, for a day. Without a public address a platform would not find this service.
pub async fn new_link(service: &Service) -> Result<String, Problem> {
    let address = address(service)?;
    let secret = new_token()[..32].to_owned();
    let kept = Kept { hash: token_hash(&secret), until: service.clock.now() + millis(HOLDS) };
    let json = serde_json::to_string(&kept).map_err(|error| Problem::internal(&error))?;
    service.store.set_setting(SETTING, &json).await?;
    Ok(format!("{address}/lti/register/{secret}"))
}

/// Registers this service with the platform that opened the link, and the platform here.
pub async fn register(service: &Service, secret: &str, asked: &RegistrationQuery) -> Result<Platform, Problem> {
    let kept = service.store.setting(SETTING).await?.and_then(|json| serde_json::from_str::<Kept>(&json).ok());
    let holds = kept.is_some_and(|kept| kept.hash == token_hash(secret) && kept.until > service.clock.now());
    if !holds {
        return Err(refused(
            "This registration link opens nothing: it has been used, is older than a day, or there is a newer one.",
            "この登録リンクは無効です。使用済みか、1 日を過ぎたか、新しいリンクが発行されています。",
        ));
    }
    let failed = |failure: String| {
        tracing::warn!(failure, "the registration of a platform");
        refused(
            format!("The learning platform could not be registered: {failure}"),
            format!("学習プラットフォームを登録できませんでした: {failure}"),
        )
    };
    let open_id = service.lti.json(&asked.openid_configuration).await.map_err(failed)?;
    let text = |name: &str| {
        let value = open_id[name].as_str().map(str::to_owned);
        value.ok_or_else(|| failed(format!("{}: `{name}` is missing", asked.openid_configuration)))
    };
    let issuer = text("issuer")?;
    let host = |address: &str| checked(address).ok().and_then(|url| url.host_str().map(str::to_owned));
    if host(&issuer).is_none() || host(&issuer) != host(&asked.openid_configuration) {
        return Err(failed(format!("the configuration is not of its issuer, {issuer}")));
    }
    let endpoint = text("registration_endpoint")?;
    let answer = service.lti.register(&endpoint, asked.registration_token.as_deref(), &request(service)?).await;
    let answer = answer.map_err(failed)?;
    let client_id = answer["client_id"].as_str().ok_or_else(|| failed("it gave no client_id".to_owned()))?.to_owned();
    let family = open_id[PLATFORM]["product_family_code"].as_str().unwrap_or("LTI");
    let platform = Platform {
        id: new_id(),
        name: format!("{family} {}", host(&issuer).unwrap_or_default()),
        issuer,
        client_id,
        auth_url: text("authorization_endpoint")?,
        token_url: text("token_endpoint")?,
        keys_url: text("jwks_uri")?,
        token_audience: open_id["authorization_server"].as_str().map(str::to_owned),
        is_active: 1,
    };
    let platform = keep(service, platform, answer[TOOL]["deployment_id"].as_str()).await?;
    service.store.set_setting(SETTING, "{}").await?;
    Ok(platform)
}

/// Who a request for a token is addressed to, as somebody typed it: nothing stands for the address itself.
pub fn audience(typed: &str) -> Option<String> {
    Some(typed.trim().to_owned()).filter(|typed| !typed.is_empty())
}

/// Keeps a platform with its first deployment. One without a name is called by its issuer.
pub async fn keep(service: &Service, platform: Platform, deployment: Option<&str>) -> Result<Platform, Problem> {
    let has_name = !platform.name.trim().is_empty();
    let platform = if has_name { platform } else { Platform { name: platform.issuer.clone(), ..platform } };
    for address in [&platform.auth_url, &platform.token_url, &platform.keys_url] {
        checked(address).map_err(|why| Problem::unprocessable(why.en, why.ja))?;
    }
    service.store.add_platform(&platform, service.clock.now()).await?;
    let is_it = |found: &Platform| found.issuer == platform.issuer && found.client_id == platform.client_id;
    let platform = service.store.platforms().await?.into_iter().find(is_it).unwrap_or(platform);
    if let Some(id) = deployment.filter(|id| !id.is_empty()) {
        service.store.note_deployment(&platform.id, id, true).await?;
    }
    Ok(platform)
}

/// What this service asks to be registered with.
fn request(service: &Service) -> Result<Value, Problem> {
    let own = address(service)?;
    let domain = own.split("://").nth(1).unwrap_or_default().split('/').next().unwrap_or_default();
    // Moodle looks a link's tool up by its domain without this.
    let domain = domain.strip_prefix("www.").unwrap_or(domain);
    let scopes = [scores::SCOPE, memberships::SCOPE].join(" ");
    Ok(json!({
        "application_type": "web",
        "response_types": ["id_token"],
        "grant_types": ["implicit", "client_credentials"],
        "initiate_login_uri": format!("{own}/lti/login"),
        "redirect_uris": [format!("{own}/lti/launch")],
        "client_name": "ggrade",
        "jwks_uri": format!("{own}/lti/jwks.json"),
        "token_endpoint_auth_method": "private_key_jwt",
        "scope": scopes,
        TOOL: {
            "domain": domain,
            "target_link_uri": format!("{own}/"),
            "description": "GLSL homework",
            "claims": ["iss", "sub", "name", "given_name", "family_name"],
            "messages": [
                { "type": "LtiResourceLinkRequest" },
                { "type": "LtiDeepLinkingRequest", "target_link_uri": format!("{own}/"), "label": "ggrade" },
            ],
        },
    }))
}
