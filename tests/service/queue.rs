//! The queue: what is graded in which order, and what is not graded a third time.

mod processes;

use crate::bench::{Bench, config};
use crate::cluster::Database;
use crate::on_both;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::fault::Fault;
use ggrade::report::Verdict;
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use ggrade::service::limits::Peer;
use ggrade::service::{Config, regrade};
use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;

on_both!(
    a_flood_from_one_address_waits_behind_a_file_from_another,
    what_was_stopped_twice_is_known_until_a_teacher_asks_again,
    files_that_take_the_whole_deadline_never_hold_all_graders,
    a_file_that_takes_long_gives_its_grader_to_another,
);

/// A judge that notes what it grades. It stops what says `endless`. What says `wait` waits until the gate is open, and what says `long
/// wait` lets another file pass before.
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

    fn grade_or_let_pass(
        &self,
        submission: GradingTask<'_>,
        passed: &mut dyn FnMut(),
    ) -> Result<GradedSubmission, Fault> {
        if submission.hand_in.files[0].bytes.starts_with(b"long wait") {
            passed();
        }
        self.grade(submission)
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

async fn a_file_that_takes_long_gives_its_grader_to_another(database: Database) {
    let judge = Arc::new(Noting::default());
    let config = Config { workers: 1, wait: 0.01, ..config() };
    let bench = Bench::with(database, config, judge.clone(), Clock::system()).await;
    bench.send(from("192.0.2.1", "long wait")).await;
    until(|| judge.graded().len() == 1).await;
    // The only grader takes the next one, while the first goes on.
    bench.send(from("192.0.2.2", "another")).await;
    until(|| judge.graded().len() == 2).await;
    // What takes long is finished like all others before the service ends.
    judge.open();
    bench.finish().await;
    assert_eq!(judge.graded(), ["long wait", "another"]);
}
