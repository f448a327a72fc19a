//! The router in this process, and what to send it.

use crate::cluster::Database;
use axum::Router;
use axum::body::{Body, to_bytes};
use axum::http::{HeaderMap, Request, StatusCode, header};
use ggrade::fault::Fault;
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::config::Timeouts;
use ggrade::service::grading::{Graders, Judge};
use ggrade::service::store::Store;
use ggrade::service::{Config, Service, State, app};
use serde_json::Value;
use std::sync::Arc;
use tower::ServiceExt;

/// A service without a server.
pub struct Bench {
    /// The service, for its first homework.
    pub state: State,
    pub app: Router,
    graders: Option<Graders>,
    _database: Database,
}

/// What came back.
#[derive(Debug)]
pub struct Reply {
    pub status: StatusCode,
    pub headers: HeaderMap,
    pub body: Vec<u8>,
}

/// The teacher's token of every test.
pub const TEACHER: &str = "the-teacher-of-the-tests";

/// A configuration that no rate limit disturbs.
pub fn config() -> Config {
    Config {
        workers: 2,
        wait: 60.0,
        uploads_per_student: 100_000,
        uploads_per_address: 100_000,
        // What runs while nobody waits has tests of its own.
        cross_check: false,
        teacher_token: Some(TEACHER.into()),
        // A busy machine must not change an answer.
        limits: Timeouts { request_timeout: 300.0, ..Timeouts::default() },
        ..Config::default()
    }
}

impl Bench {
    /// A service with real workers.
    pub async fn new(database: Database) -> Self {
        Self::with(database, config(), crate::pool(), Clock::system()).await
    }

    pub async fn with(database: Database, config: Config, judge: Arc<dyn Judge>, clock: Clock) -> Self {
        let assignment = reference::assignment("ggsample06").expect("built in");
        Self::serving(Arc::clone(assignment), database, config, judge, clock).await
    }

    /// The same for another homework.
    pub async fn serving(
        assignment: Arc<reference::Assignment>,
        database: Database,
        config: Config,
        judge: Arc<dyn Judge>,
        clock: Clock,
    ) -> Self {
        Self::serving_several(vec![assignment], database, config, judge, clock).await
    }

    /// The same for several homeworks.
    pub async fn serving_several(
        assignments: Vec<Arc<reference::Assignment>>,
        database: Database,
        mut config: Config,
        judge: Arc<dyn Judge>,
        clock: Clock,
    ) -> Self {
        config.database.clone_from(&database.location);
        let store = opened(&config).await;
        let service = Service::serving(assignments, config, store, judge, clock).await.expect("a service");
        let graders = Some(Graders::start(&service).await.expect("graders"));
        let state = service.homeworks().next().expect("a homework");
        Self { app: app(service), state, graders, _database: database }
    }

    /// The same service after a restart with other assignments.
    pub async fn restarted(mut self, assignments: Vec<Arc<reference::Assignment>>) -> Self {
        self.state.end();
        if let Some(graders) = self.graders.take() {
            graders.finish().await;
        }
        self.state.store.close().await;
        let Self { app, state, _database: database, .. } = self;
        let (config, pool) = (state.config.clone(), Arc::clone(&state.pool));
        // The old process is gone, and with it what it held.
        drop((app, state));
        Self::serving_several(assignments, database, config, pool, Clock::system()).await
    }

    /// Sends a request.
    pub async fn send(&self, request: Request<Body>) -> Reply {
        send(&self.app, request).await
    }

    pub async fn get(&self, address: &str) -> Reply {
        self.send(Request::get(address).body(Body::empty()).expect("a request")).await
    }

    /// Hands a file in as a program does.
    pub async fn hand_in(&self, query: &str, bytes: impl Into<Body>) -> Reply {
        let request = Request::post(format!("/api/v1/submissions{query}")).header(header::CONTENT_TYPE, "text/plain");
        self.send(request.body(bytes.into()).expect("a request")).await
    }

    /// Ends the service as SIGTERM does.
    pub async fn finish(mut self) {
        self.state.end();
        if let Some(graders) = self.graders.take() {
            graders.finish().await;
        }
    }
}

/// The database. A worker that another test starts at this moment has every file of this process open until it is a program of
/// its own, the lock of a database that was just closed among them.
async fn opened(config: &Config) -> Store {
    let location = config.location().expect("a location");
    for _ in 0..100 {
        match Store::open(&location).await {
            Err(error) if error.to_string().contains("has it open") => {
                tokio::time::sleep(std::time::Duration::from_millis(50)).await;
            }
            opened => return opened.expect("a database"),
        }
    }
    panic!("the database is held by another service");
}

pub async fn send(app: &Router, request: Request<Body>) -> Reply {
    let response = app.clone().oneshot(request).await.expect("an answer");
    let (parts, body) = response.into_parts();
    let body = to_bytes(body, usize::MAX).await.expect("a body").to_vec();
    Reply { status: parts.status, headers: parts.headers, body }
}

impl Reply {
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body)
            .unwrap_or_else(|error| panic!("{error}: {}", String::from_utf8_lossy(&self.body)))
    }

    pub fn header(&self, name: &str) -> &str {
        self.headers.get(name).map(|value| value.to_str().expect("text")).unwrap_or_default()
    }

    /// Its problem: the last word of its type.
    pub fn problem(&self) -> String {
        assert_eq!(self.header("content-type"), "application/problem+json", "{self:?}");
        let json = self.json();
        assert_eq!(json["status"], self.status.as_u16());
        assert!(!json["title"].as_str().expect("a title").is_empty());
        assert!(!json["detail"].as_str().expect("a detail").is_empty());
        json["type"].as_str().expect("a type").trim_start_matches("urn:ggrade:problem:").to_owned()
    }

    pub fn id(&self) -> String {
        self.json()["id"].as_str().unwrap_or_else(|| panic!("no id in {self:?}")).to_owned()
    }
}

/// A judge that does what a test wants.
pub struct Fake<F>(pub F);

impl<F> std::fmt::Debug for Fake<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Fake")
    }
}

impl<F: Fn() -> Result<(), Fault> + Send + Sync> Judge for Fake<F> {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        (self.0)()?;
        let assignment = reference::assignment("ggsample06").expect("built in");
        let sources = ggrade::grade::sources(assignment, submission.hand_in);
        let verdict = ggrade::report::Verdict::Rejected;
        let report = ggrade::grade::unfinished(assignment, sources, verdict, Vec::new(), Default::default());
        Ok(GradedSubmission { report, frames: Arc::default() })
    }
}
