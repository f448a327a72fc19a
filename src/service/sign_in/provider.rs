//! Who says who somebody is: an issuer of the configuration, what it says of itself, and what it is asked.

use super::{address_back, refused};
use crate::service::errors::Problem;
use crate::service::id_tokens;
use crate::service::store::SignIn;
use crate::service::{Service, lti};
use axum::http::StatusCode;
use jsonwebtoken::Algorithm;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Longest value of a claim that is looked at, in bytes.
const LONGEST_VALUE: usize = 255;

/// Who says who somebody is: `[[sign_in]]` of the configuration.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provider {
    /// A word for addresses.
    pub id: String,
    /// What the button says.
    pub name: String,
    /// The issuer's name for itself: an https address, below which its configuration is.
    pub issuer: String,
    /// The issuer's name for this service.
    pub client_id: String,
    /// The secret that they share; none for a public client.
    #[serde(default)]
    pub client_secret: Option<String>,
    /// The claim that has the student number, or the login of an account.
    #[serde(default = "email")]
    pub claim: String,
    /// The domain of mail addresses that are let in. What stands before it is the student number.
    #[serde(default)]
    pub domain: Option<String>,
    /// Ids of the tenants that are let in, for an issuer of many tenants (Microsoft's `common` and `organizations`).
    #[serde(default)]
    pub tenants: Vec<String>,
}

/// What stands for a tenant's id in the name of an issuer of many tenants.
const TENANT: &str = "{tenantid}";

fn email() -> String {
    "email".to_owned()
}

/// What an issuer says of itself (OpenID Connect Discovery).
#[derive(Debug, Deserialize)]
pub(super) struct Discovered {
    issuer: String,
    pub authorization_endpoint: String,
    token_endpoint: String,
    userinfo_endpoint: Option<String>,
    pub jwks_uri: String,
    #[serde(default)]
    token_endpoint_auth_methods_supported: Vec<String>,
    #[serde(default)]
    id_token_signing_alg_values_supported: Vec<String>,
}

/// What an issuer gives for a code.
#[derive(Debug)]
pub(super) struct Tokens {
    /// Says who somebody is.
    pub id: String,
    /// Opens the issuer's userinfo endpoint.
    access: Option<String>,
}

impl Discovered {
    /// By which algorithms it signs id tokens.
    pub fn algorithms(&self) -> Vec<Algorithm> {
        let known = id_tokens::algorithms(&self.id_token_signing_alg_values_supported);
        if known.is_empty() { id_tokens::USUAL.to_vec() } else { known }
    }
}

impl Provider {
    /// Whether it can be used; what is wrong otherwise.
    pub(in crate::service) fn check(&self) -> Result<(), &'static str> {
        let is_word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
        match self {
            Self { id, .. } if id.is_empty() || !id.chars().all(is_word) => Err("id"),
            Self { name, .. } if name.trim().is_empty() => Err("name"),
            Self { issuer, .. } if lti::checked(issuer).is_err() => Err("issuer"),
            Self { client_id, .. } if client_id.is_empty() => Err("client_id"),
            Self { claim, .. } if claim.is_empty() => Err("claim"),
            Self { domain: Some(domain), .. } if domain.is_empty() || domain.contains('@') => Err("domain"),
            _ => Ok(()),
        }
    }

    pub(super) async fn discovered(&self, service: &Service) -> Result<Discovered, Problem> {
        let address = format!("{}/.well-known/openid-configuration", self.issuer.trim_end_matches('/'));
        let failed = |failure: String| {
            tracing::error!(failure, provider = self.id, "an issuer cannot be used");
            let name = &self.name;
            Problem::new(
                StatusCode::BAD_GATEWAY,
                "sign-in",
                format!("{name} does not answer as it should. Please try again later."),
                format!("{name} から正しい応答がありません。しばらくしてからもう一度試してください。"),
            )
        };
        let found = service.lti.kept_json(&address).await.map_err(failed)?;
        let found: Discovered = serde_json::from_value(found).map_err(|error| failed(format!("{address}: {error}")))?;
        if !self.is_named(&found.issuer) {
            return Err(failed(format!("{address} is of the issuer {}", found.issuer)));
        }
        let addresses = [&found.authorization_endpoint, &found.token_endpoint, &found.jwks_uri];
        for address in addresses.into_iter().chain(&found.userinfo_endpoint) {
            lti::checked(address).map_err(|why| failed(why.en))?;
        }
        Ok(found)
    }

    /// Whether an issuer that names itself so is the one of the configuration: by that name, or with a place for the tenant where
    /// the configuration says which tenants are let in.
    fn is_named(&self, name: &str) -> bool {
        let of_many = || {
            let (before, after) = name.split_once(TENANT)?;
            let tenant = self.issuer.strip_prefix(before)?.strip_suffix(after)?;
            Some(!tenant.is_empty() && !tenant.contains('/') && !self.tenants.is_empty())
        };
        name == self.issuer || of_many().unwrap_or(false)
    }

    /// Whether this is a name that the issuer may have in its answers.
    pub(super) fn has_name(&self, found: &Discovered, name: &str) -> bool {
        let of_tenant = |tenant: &String| found.issuer.replace(TENANT, tenant) == name;
        if found.issuer.contains(TENANT) { self.tenants.iter().any(of_tenant) } else { name == self.issuer }
    }

    /// The name of the issuer of a token; an issuer of many tenants has one for each.
    pub(super) fn issuer_of(&self, found: &Discovered, token: &str) -> Result<String, Problem> {
        if !found.issuer.contains(TENANT) {
            return Ok(self.issuer.clone());
        }
        let tenant = id_tokens::unproved(token, "tid").unwrap_or_default();
        match self.tenants.iter().find(|known| known.eq_ignore_ascii_case(&tenant)) {
            Some(_) => Ok(found.issuer.replace(TENANT, &tenant)),
            None => Err(self.distrusted("it is of a tenant that is not let in", "許可されていないテナントのものです")),
        }
    }

    /// The tokens for a code.
    pub(super) async fn tokens(
        &self,
        service: &Service,
        found: &Discovered,
        code: &str,
        begun: &SignIn,
    ) -> Result<Tokens, Problem> {
        let mut form = vec![
            ("grant_type", "authorization_code"),
            ("code", code),
            ("code_verifier", &begun.verifier),
            ("client_id", &self.client_id),
        ];
        let back = address_back(service)?;
        form.push(("redirect_uri", &back));
        let methods = &found.token_endpoint_auth_methods_supported;
        let has = |method: &str| methods.iter().any(|known| known == method);
        let mut login = self.client_secret.as_deref().map(|secret| (self.client_id.as_str(), secret));
        // Where it says nothing, it takes the secret in the header.
        if let Some((_, secret)) = login.filter(|_| has("client_secret_post") && !has("client_secret_basic")) {
            form.push(("client_secret", secret));
            login = None;
        }
        let answer = service.lti.post_form(&found.token_endpoint, &form, login).await.map_err(|failure| {
            tracing::warn!(failure, provider = self.id, "a code was not taken");
            self.distrusted("its code is not taken", "認可コードが受け付けられませんでした")
        })?;
        let token = |name: &str| answer.get(name).and_then(Value::as_str).map(str::to_owned);
        let id = token("id_token").ok_or_else(|| self.distrusted("there is no id token", "ID トークンがありません"))?;
        Ok(Tokens { id, access: token("access_token") })
    }

    /// Adds to the claims of an id token what is needed of somebody and is not there: issuers may keep it for the userinfo endpoint
    /// (OpenID Connect Core, section 5.4).
    pub(super) async fn complete(
        &self,
        service: &Service,
        found: &Discovered,
        tokens: &Tokens,
        claims: &mut Map<String, Value>,
    ) -> Result<(), Problem> {
        let needed = match self.claim.as_str() {
            "email" => vec!["email", "email_verified"],
            claim => vec![claim],
        };
        let (Some(address), Some(token)) = (&found.userinfo_endpoint, &tokens.access) else { return Ok(()) };
        if needed.iter().all(|name| claims.contains_key(*name)) {
            return Ok(());
        }
        let said = service.lti.json_for(address, token).await.map_err(|failure| {
            tracing::warn!(failure, provider = self.id, "a userinfo endpoint");
            self.distrusted("its userinfo endpoint does not answer", "userinfo エンドポイントから応答がありません")
        })?;
        // It may be about anybody whose token this is (section 5.3.2).
        let subject = claims.get("sub").and_then(Value::as_str);
        if subject.is_none() || said.get("sub").and_then(Value::as_str) != subject {
            return Err(self.distrusted("userinfo is of somebody else (sub)", "userinfo が別の利用者のものです (sub)"));
        }
        // An address and whether it is verified belong together.
        if said.get(&self.claim).is_some() {
            for name in needed {
                claims.insert(name.to_owned(), said.get(name).cloned().unwrap_or_default());
            }
        }
        Ok(())
    }

    pub(super) fn distrusted(&self, en: &str, ja: &str) -> Problem {
        let name = &self.name;
        refused(
            format!("What {name} says is not accepted: {en}. Sign in once more."),
            format!("{name} からの情報を受け付けられません（{ja}）。もう一度ログインしてください。"),
        )
    }

    /// The names by which somebody may be known here: as the issuer says it, and without the domain.
    pub(super) fn names(&self, claims: &Map<String, Value>) -> Result<(String, String), Problem> {
        let value = match claims.get(&self.claim) {
            Some(Value::String(text)) => text.trim().to_owned(),
            Some(Value::Number(number)) => number.to_string(),
            _ => String::new(),
        };
        if value.is_empty() || value.len() > LONGEST_VALUE {
            let claim = &self.claim;
            return Err(self.distrusted(&format!("it has no claim `{claim}`"), &format!("項目「{claim}」がありません")));
        }
        let is_verified = matches!(claims.get("email_verified"), Some(Value::Bool(true)))
            || claims.get("email_verified").and_then(Value::as_str) == Some("true");
        if self.claim == "email" && !is_verified {
            return Err(self.distrusted("the mail address is not verified", "メールアドレスが確認されていません"));
        }
        let Some(domain) = &self.domain else { return Ok((value.clone(), value)) };
        match value.rsplit_once('@') {
            Some((local, of)) if of.eq_ignore_ascii_case(domain) && !local.is_empty() => {
                Ok((value.clone(), local.to_owned()))
            }
            _ => Err(refused(
                format!(
                    "You are signed in as {value}. Only addresses of {domain} are let in: sign in with another account."
                ),
                format!(
                    "{value} でログインしています。利用できるのは {domain} のアカウントだけです。別のアカウントでログインしてください。"
                ),
            )),
        }
    }
}
