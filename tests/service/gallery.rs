//! Pictures of a submission: run once for all who look, and never where the file was stopped.

use crate::bench::{Bench, Reply, config};
use crate::cluster::Database;
use crate::{on_both, right_and_new};
use axum::http::StatusCode;
use ggrade::fault::Fault;
use ggrade::report::Verdict;
use ggrade::sandbox::{GradedSubmission, GradingTask, Pool};
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

on_both!(many_who_look_at_once_have_the_file_run_once, a_file_that_was_stopped_is_not_run_again_for_who_looks,);

/// The workers, and how often they drew pictures.
#[derive(Debug)]
struct Counting {
    pool: Arc<Pool>,
    drawings: AtomicUsize,
}

impl Judge for Counting {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        self.drawings.fetch_add(usize::from(submission.wants_frames), Ordering::SeqCst);
        Judge::grade(&*self.pool, submission)
    }
}

/// Every address of pictures of a submission.
fn addresses(id: &str) -> Vec<String> {
    let pages =
        ["yours.png", "difference.png", "portrait.png", "animation.png", "frames/3.png", "frames/3.png?view=all"];
    let api =
        ["animation.png?view=difference", "animation.png?view=all", "frames/7.png", "frames/7.png?view=difference"];
    let pages = pages.iter().map(|name| format!("/r/{id}/{name}"));
    pages.chain(api.iter().map(|name| format!("/api/v1/submissions/{id}/{name}"))).collect()
}

/// Asks for all of them at once.
async fn look(bench: &Bench, addresses: Vec<String>) -> Vec<(String, Reply)> {
    let mut asked = tokio::task::JoinSet::new();
    for address in addresses {
        let app = bench.app.clone();
        let request = axum::http::Request::get(&address).body(axum::body::Body::empty()).expect("a request");
        asked.spawn(async move { (address, crate::bench::send(&app, request).await) });
    }
    asked.join_all().await
}

async fn many_who_look_at_once_have_the_file_run_once(database: Database) {
    let counting = Arc::new(Counting { pool: crate::pool(), drawings: AtomicUsize::new(0) });
    let bench = Bench::with(database, config(), counting.clone(), Clock::system()).await;
    let bytes = right_and_new();
    let id = bench.hand_in("", bytes.clone()).await.id();
    assert_eq!(counting.drawings.load(Ordering::SeqCst), 0, "a grading keeps no pictures");
    for _ in 0..2 {
        let twice = [addresses(&id), addresses(&id)].concat();
        for (address, reply) in look(&bench, twice).await {
            assert_eq!((reply.status, reply.header("content-type")), (StatusCode::OK, "image/png"), "{address}");
            image::load_from_memory(&reply.body).expect("a PNG");
        }
    }
    assert_eq!(counting.drawings.load(Ordering::SeqCst), 1);
    // Another submission of the very same file has the very same pictures.
    let again = bench.hand_in("?name=other.vert", bytes).await.id();
    look(&bench, addresses(&again)).await;
    assert_eq!(counting.drawings.load(Ordering::SeqCst), 1);
    bench.finish().await;
}

/// Stops every file, and counts how often it is asked to.
#[derive(Debug, Default)]
struct Stopping(AtomicUsize);

impl Judge for Stopping {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        self.0.fetch_add(1, Ordering::SeqCst);
        let assignment = reference::assignment("ggsample06").expect("built in");
        let sources = ggrade::grade::sources(assignment, submission.hand_in);
        let report = ggrade::grade::unfinished(assignment, sources, Verdict::Stopped, Vec::new(), Default::default());
        Ok(GradedSubmission { report, frames: Arc::default() })
    }
}

async fn a_file_that_was_stopped_is_not_run_again_for_who_looks(database: Database) {
    let stopping = Arc::new(Stopping::default());
    let bench = Bench::with(database, config(), stopping.clone(), Clock::system()).await;
    let reply = bench.hand_in("", "void main() { for (;;); }").await;
    assert_eq!(reply.json()["report"]["verdict"], "stopped");
    let id = reply.id();
    let terms = ["terms/diffuse-yours.png", "terms/diffuse-expected.png"].map(|name| format!("/r/{id}/{name}"));
    for (address, reply) in look(&bench, [addresses(&id), terms.to_vec()].concat()).await {
        assert_eq!(reply.status, StatusCode::NOT_FOUND, "{address}");
    }
    assert_eq!(bench.get(&format!("/r/{id}")).await.status, StatusCode::OK);
    assert_eq!(stopping.0.load(Ordering::SeqCst), 1, "it was run again");
    bench.finish().await;
}
