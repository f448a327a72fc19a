//! Arguments of `ggrade serve`.

use crate::sandbox::Policy;
use clap::Args;
use serde::Serialize;
use std::net::SocketAddr;
use std::path::PathBuf;

/// Where else options can be given.
const ELSEWHERE: &str = "Every option can also be an environment variable (GGRADE_QUEUE=64 for --queue 64) or a line of \
                         the file (queue = 64, teacher_token = \"...\"; trusted_proxies = [\"127.0.0.1\"] for \
                         --trusted-proxy). A flag goes before the environment, the environment before the file. \
                         docs/service.md has more, such as the limits for slow clients.";

/// Serve the upload pages.
#[derive(Clone, Debug, Default, Args, Serialize)]
#[command(after_help = ELSEWHERE)]
pub struct ServeArguments {
    /// A TOML file with any of these options
    #[arg(long, value_name = "FILE", env = "GGRADE_CONFIG")]
    #[serde(skip)]
    pub config: Option<PathBuf>,
    /// Ask on standard input for the password by which the first administrator comes in, keep its hash in the database, and
    /// end
    #[arg(long)]
    #[serde(skip)]
    pub set_teacher_password: bool,
    /// Ask the service that runs with these options on this machine whether it takes uploads, and end: with exit code 0 if
    /// it does
    #[arg(long, conflicts_with = "set_teacher_password")]
    #[serde(skip)]
    pub healthcheck: bool,
    /// Address and port to listen on [default: 127.0.0.1:8080]
    #[arg(long, value_name = "ADDRESS:PORT")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub listen: Option<SocketAddr>,
    /// An SQLite file, made when missing, or postgres://user@host/name [default: ggrade.db]
    #[arg(long, value_name = "FILE|URL")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub database: Option<String>,
    /// The address by which browsers know the service, such as https://ggrade.example.ac.jp; with https, cookies are
    /// never sent over plain http
    #[arg(long, value_name = "URL")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub public_url: Option<String>,
    /// Address (or network, as 10.0.0.0/8) of a reverse proxy whose X-Forwarded-For is believed; may be given again
    #[arg(long = "trusted-proxy", value_name = "ADDRESS")]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub trusted_proxies: Vec<String>,
    /// Header in which a reverse proxy says who somebody is (a student number, or the login of an account); needs
    /// --identity-proxy
    #[arg(long, value_name = "HEADER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub identity_header: Option<String>,
    /// Address (or network) of a reverse proxy whose --identity-header is believed; may be given again
    #[arg(long = "identity-proxy", value_name = "ADDRESS")]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub identity_proxies: Vec<String>,
    /// An assignment: the name of a built-in one, or the folder of one; may be given again, for a service with several
    /// [default: ggsample06]
    #[arg(long, value_name = "NAME|FOLDER")]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assignment: Vec<String>,
    /// What this process does; with PostgreSQL any number of them share the work of one service [default: all]
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub role: Option<ProcessRole>,
    /// Files graded at once [default: one per processor]
    #[arg(long, value_name = "N")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub workers: Option<usize>,
    /// What to do where this machine cannot close the sandbox around a grading [default: required]
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sandbox: Option<Policy>,
    /// Give each submission a process of its own, which no other submission has touched (slower)
    #[arg(long)]
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub single_use_workers: bool,
    /// Seconds that one grading may take [default: 2]
    #[arg(long, value_name = "SECONDS")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deadline: Option<f64>,
    /// Seconds that an upload waits for its report before it is told to come back [default: 5]
    #[arg(long, value_name = "SECONDS")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wait: Option<f64>,
    /// Uploads that may wait to be graded; the next one is told to come back (429) [default: 64]
    #[arg(long, value_name = "N")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub queue: Option<usize>,
    /// Uploads a minute from one student or browser [default: 60]
    #[arg(long, value_name = "N")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uploads_per_student: Option<u32>,
    /// Uploads a minute from one address; a whole computer room may share one [default: 6000]
    #[arg(long, value_name = "N")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uploads_per_address: Option<u32>,
    /// Largest archive that a teacher may upload, in MiB [default: 64]
    #[arg(long, value_name = "MIB")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub archive_mib: Option<u64>,
    /// Days after which submissions are removed; 0 keeps them [default: 0]
    #[arg(long, value_name = "DAYS")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub retention_days: Option<u32>,
    /// Whether the interpreter runs each file again after its grading, while nobody waits, and the teacher sees where it
    /// disagrees with the driver [default: true]
    #[arg(long, value_name = "BOOL")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cross_check: Option<bool>,
    /// Secret that lets programs use the teacher's part of the API, and the first administrator log in [default: a new one
    /// at each start, shown at the start, unless there is a password or an administrator]
    #[arg(long, value_name = "SECRET")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub teacher_token: Option<String>,
    /// Secret that opens one homework's class only, for programs of its teachers; may be given again
    #[arg(long = "homework-token", value_name = "NAME=SECRET")]
    #[serde(skip)]
    pub homework_tokens: Vec<String>,
    /// Hash of the teacher's password ($argon2id$…), instead of --set-teacher-password
    #[arg(long, value_name = "PHC")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub teacher_password_hash: Option<String>,
    /// Secret that lets others than this machine read /metrics (Authorization: Bearer)
    #[arg(long, value_name = "SECRET")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub metrics_token: Option<String>,
    /// How the log on standard error is written [default: text]
    #[arg(long, value_enum)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log_format: Option<LogFormat>,
    /// What is logged, such as warn or ggrade=debug [default: info]
    #[arg(long, value_name = "FILTER")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log: Option<String>,
}

/// What a process of the service does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ProcessRole {
    /// Serve the pages and grade
    #[default]
    All,
    /// Serve the pages, and leave the grading to others
    Web,
    /// Grade; of the addresses it has /healthz, /readyz and /metrics only
    Grader,
}

impl ProcessRole {
    /// Whether it has the pages and the API.
    pub fn serves_pages(self) -> bool {
        self != Self::Grader
    }

    /// Whether it grades.
    pub fn grades(self) -> bool {
        self != Self::Web
    }
}

/// How a log is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LogFormat {
    /// For a person
    #[default]
    Text,
    /// One JSON object a line
    Json,
}
