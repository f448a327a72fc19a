//! One queue for all processes on a database: who grades what, in which order, and what is not graded a third time.

use crate::bench::{Bench, TEACHER, config, send};
use crate::cluster::Database;
use crate::on_both;
use crate::process::{Server, command, hand_in, look_up};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::cli::ProcessRole;
use ggrade::fault::Fault;
use ggrade::report::Verdict;
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::grading::{self, Judge};
use ggrade::service::identity::new_token;
use ggrade::service::limits::Peer;
use ggrade::service::store::Store;
use ggrade::service::{Config, regrade};
use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;

on_both!(
    a_flood_from_one_address_waits_behind_a_file_from_another,
    what_was_stopped_twice_is_known_until_a_teacher_asks_again,
    files_that_take_the_whole_deadline_never_hold_all_graders,
);

/// A judge that notes what it grades. It stops what says `endless`. What says `wait` waits until the gate is open.
#[derive(Debug, Default)]
struct Noting {
    graded: Mutex<Vec<String>>,
    is_open: Mutex<bool>,
    opened: Condvar,
}

impl Noting {
    fn open(&self) {
        *self.is_open.lock().unwrap() = true;
        self.opened.notify_all();
    }

    fn graded(&self) -> Vec<String> {
        self.graded.lock().unwrap().clone()
    }
}

impl Judge for Noting {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        let text = String::from_utf8_lossy(&submission.hand_in.files[0].bytes).into_owned();
        self.graded.lock().unwrap().push(text.clone());
        if text.contains("wait") {
            drop(self.opened.wait_while(self.is_open.lock().unwrap(), |is_open| !*is_open).unwrap());
        }
        let verdict = if text.contains("endless") { Verdict::Stopped } else { Verdict::Rejected };
        let sources = ggrade::grade::sources(submission.assignment, submission.hand_in);
        let report = ggrade::grade::unfinished(submission.assignment, sources, verdict, Vec::new(), Default::default());
        Ok(GradedSubmission { report, frames: Arc::default() })
    }
}

fn from(peer: &str, text: &str) -> Request<Body> {
    Request::post("/api/v1/submissions")
        .header(header::CONTENT_TYPE, "text/plain")
        .extension(Peer(format!("{peer}:1000").parse().expect("an address")))
        .body(Body::from(text.to_owned()))
        .expect("a request")
}

/// Waits for what is sure to come.
async fn until(mut is_so: impl FnMut() -> bool) {
    for _ in 0..6000 {
        if is_so() {
            return;
        }
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    panic!("it did not come");
}

async fn a_flood_from_one_address_waits_behind_a_file_from_another(database: Database) {
    let judge = Arc::new(Noting::default());
    let config = Config { workers: 1, wait: 0.01, ..config() };
    let bench = Bench::with(database, config, judge.clone(), Clock::fixed(1_700_000_000_000)).await;
    // The only grader is busy until all have come.
    bench.send(from("192.0.2.9", "wait")).await;
    until(|| judge.graded().len() == 1).await;
    for number in 0..6 {
        let reply = bench.send(from("192.0.2.1", &format!("flood {number}"))).await;
        assert_eq!(reply.status, StatusCode::ACCEPTED);
    }
    let reply = bench.send(from("192.0.2.2", "alone")).await;
    assert!(reply.json()["position"].as_u64().expect("a position") <= 2, "{reply:?}");
    judge.open();
    until(|| judge.graded().len() == 8).await;
    let place = |text: &str| judge.graded().iter().position(|graded| graded == text).expect("graded");
    // Both came first of their address, at the same time of the clock.
    assert!(place("alone") <= 2, "{:?}", judge.graded());
    assert_eq!(judge.graded().last().map(String::as_str), Some("flood 5"));
    bench.finish().await;
}

async fn what_was_stopped_twice_is_known_until_a_teacher_asks_again(database: Database) {
    let judge = Arc::new(Noting::default());
    let bench = Bench::with(database, config(), judge.clone(), Clock::system()).await;
    for _ in 0..5 {
        let reply = bench.hand_in("", "endless").await;
        assert_eq!(reply.json()["report"]["verdict"], "stopped", "{reply:?}");
    }
    assert_eq!(judge.graded(), ["endless"; 2]);
    // Another file of the same kind is another file.
    bench.hand_in("", "endless, and other").await;
    assert_eq!(judge.graded().len(), 3);
    let regrading = regrade::start(&bench.state, false, None).await.expect("a regrading");
    until(|| judge.graded().len() == 3 + 6).await;
    let progress = || bench.state.store.regrading_progress(&regrading.id);
    while !progress().await.expect("progress").is_done() {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    assert_eq!(judge.graded().len(), 3 + 6);
    bench.finish().await;
}

async fn files_that_take_the_whole_deadline_never_hold_all_graders(database: Database) {
    let judge = Arc::new(Noting::default());
    let config = Config { workers: 2, wait: 0.01, ..config() };
    let bench = Bench::with(database, config, judge.clone(), Clock::system()).await;
    // Stopped once, and so under suspicion: whatever comes from there waits behind all others.
    judge.open();
    bench.send(from("192.0.2.1", "endless wait")).await;
    until(|| judge.graded().len() == 1).await;
    let store = &bench.state.store;
    while store.waiting().await.expect("counts") != (0, 0) {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    *judge.is_open.lock().unwrap() = false;
    for number in 0..3 {
        let reply = bench.send(from("192.0.2.1", &format!("wait {number}"))).await;
        assert_eq!(reply.status, StatusCode::ACCEPTED);
    }
    until(|| judge.graded().len() == 2).await;
    for number in 0..5 {
        bench.send(from("192.0.2.2", &format!("honest {number}"))).await;
    }
    until(|| judge.graded().len() == 2 + 5).await;
    assert_eq!(judge.graded().iter().filter(|text| text.starts_with("honest")).count(), 5);
    judge.open();
    until(|| judge.graded().len() == 4 + 5).await;
    bench.finish().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn processes_on_one_database_share_all_files() {
    let database = Database::postgres().await;
    let mut benches = Vec::new();
    let judges = [0; 3].map(|_| Arc::new(Noting::default()));
    for (judge, role) in judges.iter().zip([ProcessRole::Web, ProcessRole::Grader, ProcessRole::Grader]) {
        let config = Config { workers: 1, role, ..config() };
        benches.push(Bench::with(database.again(), config, judge.clone(), Clock::system()).await);
    }
    // Until the gate opens, each grader holds one file: neither can have them all.
    let web = benches[0].app.clone();
    let mut uploads = tokio::task::JoinSet::new();
    for number in 0..40 {
        let web = web.clone();
        uploads.spawn(async move { send(&web, from("192.0.2.1", &format!("wait {number}"))).await });
    }
    until(|| judges[1..].iter().all(|judge| judge.graded().len() == 1)).await;
    judges[1..].iter().for_each(|judge| judge.open());
    // Who handed in at one process is told what another one found, without asking again.
    for reply in uploads.join_all().await {
        assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    }
    let counts = judges.each_ref().map(|judge| judge.graded().len());
    assert_eq!(counts[0], 0, "the process with the pages grades nothing");
    assert_eq!(counts[1] + counts[2], 40, "{counts:?}");
    let mut all = [judges[1].graded(), judges[2].graded()].concat();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), 40, "nothing is graded twice");
    for bench in benches {
        bench.finish().await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_archive_is_graded_by_all_processes() {
    let database = Database::postgres().await;
    let judges = [0; 2].map(|_| Arc::new(Noting::default()));
    let mut benches = Vec::new();
    for judge in &judges {
        let config = Config { workers: 1, ..config() };
        benches.push(Bench::with(database.again(), config, judge.clone(), Clock::system()).await);
    }
    let state = &benches[0].state;
    for number in 0..10 {
        let new = ggrade::service::store::NewSubmission {
            id: format!("archived-{number}"),
            assignment: "ggsample06".into(),
            hand_in: ggrade::hand_in::HandIn::of_one("a.vert", format!("wait {number}")),
            owner_id: None,
            student_id: None,
            batch_id: None,
            via: ggrade::service::store::Via::Batch,
            seed: 7,
            hints: Default::default(),
            received_at: 0,
            priority: ggrade::service::store::Priority::Archive,
            senders: Vec::new(),
        };
        state.store.add_submission(&new, None).await.expect("stored");
    }
    grading::files_wait(state).await;
    until(|| judges.iter().all(|judge| judge.graded().len() == 1)).await;
    // A student goes before the rest of the archive.
    let reply = tokio::spawn({
        let web = benches[0].app.clone();
        async move { send(&web, from("192.0.2.1", "student")).await }
    });
    while state.store.waiting().await.expect("counts").0 < 11 {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    judges.iter().for_each(|judge| judge.open());
    assert_eq!(reply.await.expect("a reply").status, StatusCode::CREATED);
    until(|| judges.iter().map(|judge| judge.graded().len()).sum::<usize>() == 11).await;
    let second: Vec<String> = judges.iter().filter_map(|judge| judge.graded().get(1).cloned()).collect();
    assert!(second.contains(&"student".to_owned()), "{second:?}");
    for bench in benches {
        bench.finish().await;
    }
}

/// A version that knows nothing of turns has stored files, and has gone: one is taken over, and one has taken every process
/// along that began to grade it.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_an_earlier_version_leaves_is_taken_over_and_not_for_ever() {
    const STORE: [&str; 3] = [
        "INSERT INTO uploads (sha256, bytes) VALUES ('00', 'left'), ('01', 'deadly')",
        "INSERT INTO submissions (id, assignment, sha256, digest, name, via, seed, hints, received_at, state, priority, \
         claimed_by, claimed_until, tries) \
         VALUES ('left', 'ggsample06', '00', '00', 'a.vert', 'api', 7, 'full', 0, 'queued', 0, 'gone', 1, 0), \
         ('deadly', 'ggsample06', '01', '01', 'a.vert', 'api', 7, 'full', 0, 'queued', 0, 'gone', 1, 3)",
        "INSERT INTO submission_files (submission_id, position, name, sha256) VALUES ('left', 0, 'a.vert', '00'), \
         ('deadly', 0, 'a.vert', '01')",
    ];
    let database = Database::postgres().await;
    let judge = Arc::new(Noting::default());
    let bench = Bench::with(database.again(), config(), judge.clone(), Clock::system()).await;
    let pool = sqlx::PgPool::connect(&database.location).await.expect("a database");
    for sql in STORE {
        sqlx::query(sql).execute(&pool).await.expect("a statement");
    }
    while bench.state.store.waiting().await.expect("counts") != (0, 1) {
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    assert_eq!(judge.graded(), ["left"]);
    let reply = bench.get("/api/v1/submissions/deadly").await.json();
    assert_eq!(reply["state"], "failed", "{reply}");
    bench.finish().await;
}

#[test]
fn an_sqlite_file_has_one_process() {
    let output = command(&Database::sqlite()).args(["--role", "grader"]).output().expect("a run");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("role") && said.contains("PostgreSQL"), "{said}");
}

/// Graders are killed at random moments and others come; the process with the pages stays. Three are killed, since a file that has
/// taken four processes along is given up. Leases are long enough for a busy machine to extend them.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_killed_graders_leave_is_graded_once_by_others() {
    let database = Database::postgres().await;
    let web = Server::of(command(&database).args(["--role", "web"]).env("GGRADE_WAIT", "0.1"));
    let grader = || Server::of(command(&database).args(["--role", "grader"]).env("GGRADE_LIMITS_LEASE", "5"));
    let client = reqwest::Client::new();
    let mut graders = vec![grader(), grader()];
    assert_eq!(client.get(format!("{}/", graders[0].address)).send().await.expect("an answer").status(), 404);
    let mut ids = Vec::new();
    for round in 0..3 {
        for number in 0..8 {
            let bytes = [crate::right(), format!("\n// {round} {number}\n").into_bytes()].concat();
            let (status, json) = hand_in(&client, &web.address, bytes).await.expect("an answer");
            assert!(matches!(status, 201 | 202), "{status}: {json}");
            ids.push(json["id"].as_str().expect("an id").to_owned());
        }
        let moment = u64::from_str_radix(&new_token()[..2], 16).expect("hex");
        tokio::time::sleep(Duration::from_millis(moment / 2)).await;
        graders.remove(0).kill();
        graders.push(grader());
    }
    for id in &ids {
        let mut json = look_up(&client, &web.address, id).await;
        for _ in 0..1200 {
            if json["state"] == "graded" {
                break;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
            json = look_up(&client, &web.address, id).await;
        }
        assert_eq!(json["report"]["verdict"], "correct", "{id}: {json}");
    }
    let figures = client.get(format!("{}/metrics", graders[0].address)).bearer_auth(TEACHER).send().await;
    assert!(figures.expect("an answer").text().await.expect("text").contains("ggrade_gradings_total"));
    for server in graders.into_iter().chain([web]) {
        assert!(server.terminate().success());
    }
    let store = Store::open(&database.location.parse().expect("a location")).await.expect("a database");
    assert_eq!(store.class("ggsample06", None).await.expect("a class").len(), ids.len());
    assert_eq!(store.waiting().await.expect("counts"), (0, 0));
    store.close().await;
}
