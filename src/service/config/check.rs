//! What a configuration may be.

use super::Config;
use crate::cli::ProcessRole;
use crate::fault::Fault;
use crate::language::Text;
use crate::service::limits::Proxies;
use crate::service::store::Location;
use axum::http::HeaderName;
use reqwest::Url;

/// A secret shorter than this can be guessed.
const SHORTEST_SECRET: usize = 16;

impl Config {
    /// Checks every option; a fault names the one that is wrong.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let wrong = |name: &str, what: &str, ja: &str| {
            Err(Fault::new(Text::new(format!("the configuration: {name} {what}"), format!("設定の {name} {ja}"))))
        };
        let times = [
            ("deadline", self.deadline),
            ("wait", self.wait),
            ("header_timeout", self.limits.header_timeout),
            ("request_timeout", self.limits.request_timeout),
            ("write_timeout", self.limits.write_timeout),
            ("drain_timeout", self.limits.drain_timeout),
            ("lease", self.limits.lease),
        ];
        for (name, value) in times {
            if !(value > 0.0 && value <= 86_400.0) {
                return wrong(name, "takes seconds above 0", "は 0 より大きい秒数で指定してください");
            }
        }
        let counts = [
            ("workers", self.workers),
            ("queue", self.queue),
            ("connections", self.limits.connections),
            ("connections_per_address", self.limits.connections_per_address),
            ("uploads_per_student", self.uploads_per_student as usize),
            ("uploads_per_address", self.uploads_per_address as usize),
        ];
        for (name, value) in counts {
            if value == 0 {
                return wrong(name, "takes a number above 0", "は 1 以上で指定してください");
            }
        }
        let secrets = [("teacher_token", &self.teacher_token), ("metrics_token", &self.metrics_token)];
        let secrets = secrets.into_iter().filter_map(|(name, secret)| Some((name, secret.as_ref()?)));
        for (name, secret) in secrets.chain(self.homework_tokens.values().map(|secret| ("homework_tokens", secret))) {
            if secret.len() < SHORTEST_SECRET {
                return wrong(name, "takes at least 16 characters", "は 16 文字以上にしてください");
            }
        }
        if self.public_url.as_deref().is_some_and(|url| !is_origin(url)) {
            return wrong(
                "public_url",
                "takes an address without a path, such as https://ggrade.example.ac.jp",
                "には https://ggrade.example.ac.jp のように、パスを含まないアドレスを指定してください",
            );
        }
        let vouching = [("sign_in", !self.sign_in.is_empty()), ("identity_header", self.identity_header.is_some())];
        if let Some((name, _)) = vouching.into_iter().find(|(_, is_on)| *is_on)
            && self.public_url.is_none()
        {
            return wrong(
                name,
                "needs public_url: the address by which browsers know the service",
                "を使うには、ブラウザから見たサービスのアドレスを public_url に指定してください",
            );
        }
        for (place, provider) in self.sign_in.iter().enumerate() {
            let is_second = self.sign_in[..place].iter().any(|other| other.id == provider.id);
            if let Some(field) = provider.check().err().or(is_second.then_some("id")) {
                return wrong(
                    &format!("sign_in.{field}"),
                    "cannot be used: see docs/service.md, “Signing in by OpenID Connect”",
                    "が正しくありません。docs/service.md の「Signing in by OpenID Connect」を参照してください",
                );
            }
        }
        self.location()?;
        Proxies::parse("trusted_proxies", &self.trusted_proxies)?;
        Proxies::parse("identity_proxies", &self.identity_proxies)?;
        match &self.identity_header {
            Some(header) if HeaderName::from_bytes(header.as_bytes()).is_err() => {
                return wrong(
                    "identity_header",
                    "takes the name of an HTTP header",
                    "には HTTP ヘッダーの名前を指定してください",
                );
            }
            Some(_) if self.identity_proxies.is_empty() => {
                return wrong(
                    "identity_header",
                    "needs identity_proxies: the addresses of the proxies that send it",
                    "を使うには、それを送るプロキシのアドレスを identity_proxies に指定してください",
                );
            }
            _ => {}
        }
        if self.role != ProcessRole::All && matches!(self.location()?, Location::File(_)) {
            return wrong(
                "role",
                "divides the work among processes, which takes PostgreSQL: an SQLite file has one process",
                "で処理を分けるには PostgreSQL が必要です (SQLite のファイルを使えるのは 1 プロセスだけです)",
            );
        }
        Ok(())
    }
}

/// Whether an address is a scheme and a host, with or without a port: pages name all others from their root.
fn is_origin(address: &str) -> bool {
    Url::parse(address).is_ok_and(|url| {
        let has_more =
            url.path() != "/" || url.query().is_some() || url.fragment().is_some() || !url.username().is_empty();
        matches!(url.scheme(), "http" | "https") && !has_more
    })
}
