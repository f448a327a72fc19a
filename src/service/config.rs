//! The service's configuration: flags before environment before file.

mod check;

use super::sign_in::Provider;
use super::store::Location;
use crate::cli::{LogFormat, ProcessRole, ServeArguments};
use crate::fault::Fault;
use crate::language::Text;
use crate::sandbox::{DEADLINE_SECONDS, Policy};
use figment::Figment;
use figment::providers::{Env, Format, Serialized, Toml};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::time::Duration;

/// Everything that can be configured; each option is explained by `ggrade serve --help`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct Config {
    pub listen: SocketAddr,
    pub database: String,
    pub public_url: Option<String>,
    pub trusted_proxies: Vec<String>,
    pub identity_header: Option<String>,
    pub identity_proxies: Vec<String>,
    pub sign_in: Vec<Provider>,
    #[serde(deserialize_with = "one_or_several")]
    pub assignment: Vec<String>,
    pub role: ProcessRole,
    pub workers: usize,
    pub sandbox: Policy,
    pub single_use_workers: bool,
    pub deadline: f64,
    pub wait: f64,
    pub queue: usize,
    pub uploads_per_student: u32,
    pub uploads_per_address: u32,
    pub archive_mib: u64,
    pub retention_days: u32,
    pub cross_check: bool,
    pub teacher_token: Option<String>,
    pub homework_tokens: BTreeMap<String, String>,
    pub teacher_password_hash: Option<String>,
    pub metrics_token: Option<String>,
    pub log_format: LogFormat,
    pub log: String,
    pub limits: Timeouts,
}

/// Times that only a test or an unusual network changes; in seconds.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub struct Timeouts {
    /// For the head of a request.
    pub header_timeout: f64,
    /// For a whole request, from its head to the head of the answer; teachers' requests get eight times as much.
    pub request_timeout: f64,
    /// For a client to take any part of an answer.
    pub write_timeout: f64,
    /// For what is under way when the service is told to end.
    pub drain_timeout: f64,
    /// After which the files of a process that has gone are graded by another one.
    pub lease: f64,
    /// Connections at once, and from one address.
    pub connections: usize,
    pub connections_per_address: usize,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            listen: SocketAddr::from(([127, 0, 0, 1], 8080)),
            database: "ggrade.db".into(),
            public_url: None,
            trusted_proxies: Vec::new(),
            identity_header: None,
            identity_proxies: Vec::new(),
            sign_in: Vec::new(),
            assignment: Vec::new(),
            role: ProcessRole::All,
            workers: std::thread::available_parallelism().map_or(1, usize::from),
            sandbox: Policy::Required,
            single_use_workers: false,
            deadline: DEADLINE_SECONDS,
            wait: 5.0,
            queue: 64,
            uploads_per_student: 60,
            uploads_per_address: 6000,
            archive_mib: 64,
            retention_days: 0,
            cross_check: true,
            teacher_token: None,
            homework_tokens: BTreeMap::new(),
            teacher_password_hash: None,
            metrics_token: None,
            log_format: LogFormat::Text,
            log: "info".into(),
            limits: Timeouts::default(),
        }
    }
}

impl Default for Timeouts {
    fn default() -> Self {
        Self {
            header_timeout: 10.0,
            request_timeout: 15.0,
            write_timeout: 20.0,
            drain_timeout: 10.0,
            lease: 30.0,
            connections: 1024,
            connections_per_address: 256,
        }
    }
}

impl Config {
    /// The configuration of a command line; a fault names the option that is wrong and where it stands.
    pub fn load(flags: &ServeArguments) -> Result<Self, Fault> {
        let mut figment = Figment::from(Serialized::defaults(Self::default()));
        if let Some(path) = &flags.config {
            figment = figment.merge(Toml::file_exact(path));
        }
        figment = figment.merge(environment()).merge(Serialized::defaults(flags));
        for pair in &flags.homework_tokens {
            let (name, secret) = pair.split_once('=').ok_or_else(|| {
                Fault::new(Text::new(
                    "--homework-token takes the name of a homework, `=` and a secret, such as ggsample06=SECRET",
                    "--homework-token は ggsample06=秘密 のように、課題の名前、`=`、秘密の順に指定してください",
                ))
            })?;
            figment = figment.merge(Serialized::default(&format!("homework_tokens.{name}"), secret));
        }
        let config: Self = figment.extract().map_err(|error| {
            Fault::new(Text::new(format!("the configuration: {error}"), format!("設定に誤りがあります: {error}")))
        })?;
        config.check()?;
        Ok(config)
    }

    /// Where the database is.
    pub fn location(&self) -> Result<Location, Fault> {
        self.database.parse().map_err(|error: String| {
            Fault::new(Text::new(
                format!("the configuration: database: {error}"),
                "設定の database には、ファイル名か postgres://ユーザ@ホスト/名前 を指定してください",
            ))
        })
    }

    /// Whether browsers reach the service by https.
    pub fn is_secure(&self) -> bool {
        self.public_url.as_ref().is_some_and(|url| url.starts_with("https://"))
    }

    /// A configured number of seconds.
    pub fn span(seconds: f64) -> Duration {
        Duration::try_from_secs_f64(seconds).unwrap_or(Duration::from_secs(1))
    }
}

/// A list, or its only member.
fn one_or_several<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "a name, or a list of names in brackets")]
    enum OneOrSeveral {
        One(String),
        Several(Vec<String>),
    }
    Ok(match OneOrSeveral::deserialize(deserializer)? {
        OneOrSeveral::One(one) => vec![one],
        OneOrSeveral::Several(several) => several,
    })
}

/// The options that the environment sets: `GGRADE_QUEUE`, `GGRADE_LIMITS_LEASE`. Other variables with this prefix belong to
/// the command line.
fn environment() -> Figment {
    let known = serde_json::to_value(Config::default()).unwrap_or_default();
    let mut figment = Figment::new();
    for (name, value) in known.as_object().into_iter().flatten() {
        match value {
            // Text stays text, even where it looks like a number.
            Value::String(_) | Value::Null => {
                if let Ok(text) = std::env::var(format!("GGRADE_{}", name.to_uppercase())) {
                    figment = figment.merge(Serialized::default(name, text));
                }
            }
            // Names of homeworks are the teacher's to choose, and no part of a variable's name.
            Value::Object(_) if name != "limits" => {}
            Value::Object(_) => {
                let prefix = format!("{name}_");
                figment = figment.merge(Env::prefixed("GGRADE_").filter_map(move |key| {
                    key.as_str().to_lowercase().strip_prefix(&prefix).map(|rest| format!("limits.{rest}").into())
                }));
            }
            _ => figment = figment.merge(Env::prefixed("GGRADE_").only(&[name])),
        }
    }
    figment
}
