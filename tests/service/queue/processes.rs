//! Several processes on one database: they share all files, and take over what one leaves.

use super::{Noting, from, until};
use crate::bench::{Bench, TEACHER, config, send};
use crate::cluster::Database;
use crate::process::{Server, command, hand_in, look_up};
use axum::http::StatusCode;
use ggrade::cli::ProcessRole;
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::grading;
use ggrade::service::identity::new_token;
use ggrade::service::store::Store;
use std::sync::Arc;
use std::time::Duration;

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
            most_attempts: None,
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
