//! The interpreter's second opinion: after the report, for the teacher only, and never in anybody's way.

use crate::bench::{Bench, Reply, TEACHER, config};
use crate::cluster::Database;
use crate::{on_both, pool, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::fault::Fault;
use ggrade::language::Text;
use ggrade::report::{CrossCheck, Opinion, Verdict};
use ggrade::sandbox::{GradedSubmission, GradingTask, Pool};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use serde_json::Value;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};
use std::time::Duration;

on_both!(
    the_opinion_comes_after_the_report_and_is_the_teachers,
    a_file_that_differs_is_shown_and_kept,
    no_grading_waits_for_an_opinion,
    what_an_earlier_service_left_is_checked,
);

/// What opens the figures.
const FIGURES: &str = "the-figures-of-the-tests";

/// How often a test asks for what comes in the background, and how long it sleeps in between.
const ASKED: u32 = 600;
const BETWEEN: Duration = Duration::from_millis(100);

async fn get(bench: &Bench, address: &str) -> Reply {
    let request = Request::get(address).header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
    bench.send(request.header(header::ACCEPT_LANGUAGE, "en").body(Body::empty()).expect("a request")).await
}

/// Hands in for a student, as the teacher's program does.
async fn hand_in(bench: &Bench, student: &str, bytes: Vec<u8>) -> Reply {
    let request = Request::post(format!("/api/v1/submissions?student={student}"))
        .header(header::AUTHORIZATION, format!("Bearer {TEACHER}"))
        .header(header::CONTENT_TYPE, "text/plain");
    bench.send(request.body(bytes.into()).expect("a request")).await
}

/// The opinion on a submission, as the teacher's program is told it.
async fn opinion(bench: &Bench, id: &str) -> Value {
    for _ in 0..ASKED {
        let opinion = get(bench, &format!("/api/v1/submissions/{id}")).await.json()["report"]["cross_check"].take();
        if !opinion.is_null() {
            return opinion;
        }
        tokio::time::sleep(BETWEEN).await;
    }
    panic!("no second opinion on {id}");
}

async fn with(database: Database, judge: Arc<dyn Judge>, clock: Clock) -> Bench {
    let config =
        Config { cross_check: true, retention_days: 30, workers: 1, metrics_token: Some(FIGURES.into()), ..config() };
    Bench::with(database, config, judge, clock).await
}

async fn the_opinion_comes_after_the_report_and_is_the_teachers(database: Database) {
    let bench = with(database, pool(), Clock::system()).await;
    let bytes = right_and_new();
    let reply = hand_in(&bench, "s1", bytes.clone()).await;
    assert_eq!(reply.json()["report"]["cross_check"], Value::Null);
    let (id, refused) = (reply.id(), bench.hand_in("", sample("rejected/brace-missing-at-end.vert")).await.id());
    let checked = opinion(&bench, &id).await;
    assert_eq!((checked["opinion"].as_str(), checked["differing"].as_u64()), (Some("agrees"), Some(0)));
    assert!(checked["agreeing"].as_u64().expect("a count") > 500, "{checked}");

    // A student is told nothing of it, neither now nor with the same file once more; the teacher sees it on the page.
    for (page, is_teacher) in
        [(bench.get(&format!("/r/{id}")).await, false), (get(&bench, &format!("/r/{id}")).await, true)]
    {
        let text = String::from_utf8_lossy(&page.body).into_owned();
        assert_eq!((page.status, text.contains("id=\"second-opinion\"")), (StatusCode::OK, is_teacher), "{text}");
    }
    let again = hand_in(&bench, "s1", bytes).await;
    assert_eq!(again.json()["report"]["cross_check"], Value::Null);
    assert_eq!(opinion(&bench, &again.id()).await, checked, "an opinion goes with the report that is used again");
    assert_eq!(bench.get(&format!("/api/v1/submissions/{id}")).await.json()["report"]["cross_check"], Value::Null);
    // What was not drawn is not run.
    let report = get(&bench, &format!("/api/v1/submissions/{refused}")).await.json()["report"].take();
    assert_eq!((report["verdict"].as_str(), &report["cross_check"]), (Some("rejected"), &Value::Null));
    assert!(bench.state.store.not_cross_checked("ggsample06", 10).await.expect("a store").is_empty());
    assert!(!String::from_utf8_lossy(&get(&bench, "/teacher").await.body).contains("disputed"));
    bench.finish().await;
}

/// Real workers; what they say of the file with this text is turned into a disagreement, as a mistake of ours would be.
#[derive(Debug)]
struct Mistaken {
    pool: Arc<Pool>,
    text: &'static str,
}

impl Judge for Mistaken {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        let is_meant = String::from_utf8_lossy(&submission.hand_in.files[0].bytes).contains(self.text);
        let mut answer = self.pool.grade(submission)?;
        if let Some(checked) = answer.report.cross_check.as_mut().filter(|_| is_meant) {
            let message = Text::new("vertex 7: vc[1] differs", "頂点 7: vc[1] が異なります");
            let differing = std::mem::take(&mut checked.agreeing);
            *checked = CrossCheck { opinion: Opinion::Differs, differing, message: Some(message), ..checked.clone() };
        }
        Ok(answer)
    }
}

async fn a_file_that_differs_is_shown_and_kept(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let judge = Mistaken { pool: pool(), text: "// disputed" };
    let bench = with(database, Arc::new(judge), clock.clone()).await;
    let figures = async || {
        let request = Request::get("/metrics").header(header::AUTHORIZATION, format!("Bearer {FIGURES}"));
        bench.send(request.body(Body::empty()).expect("a request")).await
    };
    // Nothing is counted before somebody has asked.
    assert_eq!(figures().await.status, StatusCode::OK);
    let mut bytes = right_and_new();
    let plain = hand_in(&bench, "s1", bytes.clone()).await.id();
    bytes.extend(b"// disputed\n");
    let reply = hand_in(&bench, "s2", bytes.clone()).await;
    assert_eq!((reply.status, reply.json()["report"]["score"].as_u64()), (StatusCode::CREATED, Some(100)));
    let id = reply.id();
    assert_eq!(opinion(&bench, &plain).await["opinion"], "agrees");
    assert_eq!(opinion(&bench, &id).await["opinion"], "differs");

    let text = async |address: &str| String::from_utf8_lossy(&get(&bench, address).await.body).into_owned();
    let page = text(&format!("/r/{id}")).await;
    assert!(page.contains("Driver and interpreter disagree.") && page.contains("vertex 7: vc[1] differs"), "{page}");
    assert!(!String::from_utf8_lossy(&bench.get(&format!("/r/{id}")).await.body).contains("vertex 7"));
    let class = text("/teacher").await;
    assert!(class.contains("Driver and interpreter disagree on 1 hand-in</a>"), "{class}");
    assert_eq!(class.matches("<em class=\"disputed\">").count(), 1, "{class}");
    let chosen = text("/teacher?disputed=on").await;
    assert!(chosen.contains("<small id=\"live-count\" data-live>1 shown"), "{chosen}");
    let figures = String::from_utf8_lossy(&figures().await.body).into_owned();
    assert!(figures.contains("ggrade_cross_checks_total{assignment=\"ggsample06\",opinion=\"differs\"}"), "{figures}");

    // When all else of the time goes, the file and the report stay, and nothing of whose they were.
    clock.advance(Duration::from_secs(31 * 24 * 3600));
    ggrade::service::upkeep::remove(&bench.state).await;
    assert_eq!(get(&bench, &format!("/r/{plain}")).await.status, StatusCode::NOT_FOUND);
    let kept = bench.state.store.submission(&id).await.expect("a store").expect("it is kept");
    assert_eq!((kept.student_id, kept.owner_id, kept.batch_id), (None, None, None));
    assert_eq!(bench.get(&format!("/api/v1/submissions/{id}/source")).await.body, bytes);
    assert!(text(&format!("/r/{id}")).await.contains("vertex 7"));
    bench.finish().await;
}

/// Draws everything at once, but takes for a second opinion as long as the test likes.
#[derive(Debug)]
struct Slow {
    began: AtomicBool,
    goes_on: std::sync::Mutex<mpsc::Receiver<()>>,
}

impl Judge for Slow {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        if submission.order.cross_check {
            self.began.store(true, Ordering::SeqCst);
            // The sender goes where the test fails: then nobody waits for ever.
            let _ = self.goes_on.lock().expect("a lock").recv();
        }
        let assignment = reference::assignment("ggsample06").expect("built in");
        let sources = ggrade::grade::sources(assignment, submission.hand_in);
        let mut report =
            ggrade::grade::unfinished(assignment, sources, Verdict::Correct, Vec::new(), Default::default());
        report.probes.seed = submission.order.seed;
        Ok(GradedSubmission { report, frames: Arc::default() })
    }
}

async fn no_grading_waits_for_an_opinion(database: Database) {
    let (go_on, goes_on) = mpsc::channel();
    let judge = Arc::new(Slow { began: AtomicBool::new(false), goes_on: goes_on.into() });
    let bench = with(database, judge.clone(), Clock::system()).await;
    let first = bench.hand_in("", right_and_new()).await.id();
    for _ in 0..ASKED {
        if judge.began.load(Ordering::SeqCst) {
            break;
        }
        tokio::time::sleep(BETWEEN).await;
    }
    assert!(judge.began.load(Ordering::SeqCst), "nobody waits, and no opinion is asked for");
    // It takes as long as it likes: the one grader is free.
    for _ in 0..3 {
        assert_eq!(bench.hand_in("", right_and_new()).await.status, StatusCode::CREATED);
    }
    drop(go_on);
    // A second run that says nothing of the kind is one that was not made: it is not asked for again and again.
    assert_eq!(opinion(&bench, &first).await["opinion"], "not-run");
    bench.finish().await;
}

async fn what_an_earlier_service_left_is_checked(database: Database) {
    let before =
        Bench::with(database.again(), Config { cross_check: false, ..config() }, pool(), Clock::system()).await;
    let id = before.hand_in("", right_and_new()).await.id();
    before.finish().await;
    let bench = with(database.again(), pool(), Clock::system()).await;
    assert_eq!(opinion(&bench, &id).await["opinion"], "agrees");
    bench.finish().await;
}
