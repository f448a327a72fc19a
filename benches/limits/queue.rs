//! How many graders one database feeds: services whose gradings are 20 ms of sleep, on one PostgreSQL on this machine.

#[path = "../../tests/service/cluster.rs"]
#[allow(dead_code, reason = "tests need more of it")]
mod cluster;

use crate::measure::percentile;
use crate::table::Row;
use cluster::Database;
use ggrade::cli::ProcessRole;
use ggrade::fault::Fault;
use ggrade::hand_in::HandIn;
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::grading::{Graders, Judge, files_wait};
use ggrade::service::store::{NewSubmission, Priority, Store, Via};
use ggrade::service::{Config, Service};
use sqlx::PgPool;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// What a simulated grading takes.
const GRADING: Duration = Duration::from_millis(20);

/// How long each number of graders is watched, and before that runs unwatched.
const WATCHED: Duration = Duration::from_secs(8);
const UNWATCHED: Duration = Duration::from_secs(2);

/// Files that wait at the beginning: more than are graded meanwhile.
const FILES: i32 = 20_000;

/// Files that wait, all alike to the database but for their ids and turns.
const FILL: &str = "INSERT INTO submissions (id, assignment, sha256, digest, name, via, seed, hints, received_at, state, tries, \
                    priority, turn, claimed_until) SELECT 'file-' || n, 'ggsample06', '00', '00', 'a.vert', 'api', 7, \
                    'full', n, 'queued', 0, 0, n, 0 FROM generate_series(1, $1) n";

/// Files that come one by one to an idle grader.
const SINGLE_FILES: usize = 200;

/// Sleeps for as long as a grading takes, and knows when the last one began.
#[derive(Debug, Default)]
struct Sleeper {
    began: Mutex<Option<Instant>>,
}

impl Judge for Sleeper {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        *self.began.lock().expect("no panic") = Some(Instant::now());
        std::thread::sleep(GRADING);
        let sources = ggrade::grade::sources(submission.assignment, submission.hand_in);
        let verdict = ggrade::report::Verdict::Rejected;
        let report = ggrade::grade::unfinished(submission.assignment, sources, verdict, Vec::new(), Default::default());
        Ok(GradedSubmission { report, frames: Arc::default() })
    }
}

/// The rates of 4 and of 16 graders against that of one, what the database costs, and how soon an idle grader begins.
pub fn rows() -> Vec<Row> {
    let runtime = tokio::runtime::Runtime::new().expect("a runtime");
    let [(one, _), (four, _), (sixteen, cost)] = [1, 4, 16].map(|graders| runtime.block_on(rate(graders)));
    let starts = runtime.block_on(starts());
    vec![
        Row::rate("queue-1", one),
        Row::at_least("queue-4", "×", four / one, 3.6),
        Row::at_least("queue-16", "×", sixteen / one, 13.0),
        Row::milliseconds("queue-database", cost),
        Row::at_most("queue-start", "ms", percentile(&starts, 0.99), 20.0),
    ]
}

/// A service with one grader, as a process of its own would be.
async fn service(database: &Database, role: ProcessRole, judge: &Arc<Sleeper>) -> Service {
    let database = database.location.clone();
    let config = Config { workers: 1, role, cross_check: false, database, ..Config::default() };
    let store = Store::open(&config.location().expect("a location")).await.expect("a database");
    let assignments = vec![Arc::clone(reference::assignment("ggsample06").expect("built in"))];
    Service::serving(assignments, config, store, judge.clone(), Clock::system()).await.expect("a service")
}

/// Milliseconds from the moment at which a file is stored by one process to the beginning of its grading in another one.
async fn starts() -> Vec<f64> {
    let (database, judge) = (Database::postgres().await, Arc::new(Sleeper::default()));
    let web = service(&database, ProcessRole::Web, &judge).await;
    let grader = service(&database, ProcessRole::Grader, &judge).await;
    let graders = Graders::start(&grader).await.expect("graders");
    let mut waits = Vec::new();
    for number in 0..SINGLE_FILES {
        let new = NewSubmission {
            id: format!("file-{number}"),
            assignment: "ggsample06".into(),
            hand_in: HandIn::of_one("a.vert", format!("{number}")),
            owner_id: None,
            student_id: None,
            batch_id: None,
            via: Via::Api,
            seed: 7,
            hints: Default::default(),
            received_at: web.clock.now(),
            priority: Priority::Student,
            senders: Vec::new(),
            most_attempts: None,
        };
        web.store.add_submission(&new, None).await.expect("stored");
        let stored = Instant::now();
        files_wait(&web).await;
        let begun = || judge.began.lock().expect("no panic").filter(|began| *began > stored);
        while begun().is_none() {
            tokio::time::sleep(Duration::from_millis(1)).await;
        }
        waits.extend(begun().map(|began| (began - stored).as_secs_f64() * 1e3));
        // Until its report is stored and the grader waits again.
        tokio::time::sleep(3 * GRADING).await;
    }
    grader.end();
    graders.finish().await;
    waits
}

/// Gradings a second of so many graders, each a process's worth of service with one grader, and the milliseconds of CPU time
/// that the database takes for each.
async fn rate(graders: usize) -> (f64, f64) {
    let database = Database::postgres().await;
    let mut running = Vec::new();
    let pool = PgPool::connect(&database.location).await.expect("a database");
    for number in 0..graders {
        let service = service(&database, ProcessRole::All, &Arc::default()).await;
        if number == 0 {
            for (sql, count) in [
                ("INSERT INTO uploads (sha256, bytes) SELECT '00', 'void main() {}'::bytea WHERE $1 > 0", 1),
                (FILL, FILES),
                (
                    "INSERT INTO submission_files (submission_id, position, name, sha256) \
                     SELECT 'file-' || n, 0, 'a.vert', '00' FROM generate_series(1, $1) n",
                    FILES,
                ),
            ] {
                sqlx::query(sql).bind(count).execute(&pool).await.expect("files");
            }
        }
        running.push((service.clone(), Graders::start(&service).await.expect("graders")));
    }
    tokio::time::sleep(UNWATCHED).await;
    let (before, cost, began) = (graded(&pool).await, database_cpu(), Instant::now());
    tokio::time::sleep(WATCHED).await;
    let done = (graded(&pool).await - before) as f64;
    let (rate, cost) = (done / began.elapsed().as_secs_f64(), (database_cpu() - cost) / done);
    for (service, graders) in running {
        service.end();
        graders.finish().await;
        service.store.close().await;
    }
    (rate, cost)
}

/// Milliseconds of CPU time that PostgreSQL's processes on this machine have taken so far.
fn database_cpu() -> f64 {
    /// Clock ticks a second, which is the same on all Linux systems.
    const TICKS: f64 = 100.0;
    let processes = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let stats = processes.filter_map(|process| std::fs::read_to_string(process.path().join("stat")).ok());
    let ticks = stats.filter_map(|stat| {
        // The name stands in brackets; user and system time are the 12th and 13th field after it.
        let fields = stat.split_once("(postgres) ")?.1;
        Some(fields.split(' ').skip(11).take(2).filter_map(|field| field.parse::<f64>().ok()).sum::<f64>())
    });
    ticks.sum::<f64>() / TICKS * 1e3
}

async fn graded(pool: &PgPool) -> i64 {
    sqlx::query_scalar("SELECT count(*) FROM reports").fetch_one(pool).await.expect("a count")
}
