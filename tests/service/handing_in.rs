//! Handing in: stored before it is graded, within what the teacher allows.

use crate::bench::{Bench, Fake, TEACHER, config};
use crate::cluster::Database;
use crate::on_both;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::fault::Fault;
use ggrade::language::Text;
use ggrade::report::Hints;
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::store::{Audience, Priority, Store};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;

on_both!(
    a_full_queue_says_so_and_stores_nothing,
    a_fault_of_ours_is_no_report_and_is_tried_again,
    nothing_is_graded_twice_and_nothing_is_left,
    only_while_it_is_open,
    attempts_are_counted_by_student,
    hand_ins_at_the_same_time_are_no_more_than_the_attempts,
    what_is_old_is_removed,
);

/// A door that graders wait at.
#[derive(Clone, Default)]
struct Gate(Arc<(Mutex<bool>, Condvar)>);

impl Gate {
    fn open(&self) {
        *self.0.0.lock().expect("a lock") = true;
        self.0.1.notify_all();
    }

    fn pass(&self) {
        let open = self.0.0.lock().expect("a lock");
        drop(self.0.1.wait_while(open, |open| !*open).expect("a lock"));
    }
}

async fn a_full_queue_says_so_and_stores_nothing(database: Database) {
    let gate = Gate::default();
    let judge = {
        let gate = gate.clone();
        Fake(move || {
            gate.pass();
            Ok(())
        })
    };
    let config = Config { workers: 1, queue: 2, wait: 0.05, ..config() };
    let bench = Bench::with(database, config, Arc::new(judge), Clock::system()).await;
    let mut accepted = Vec::new();
    let mut refused = Vec::new();
    // One is graded, two wait; while the grader has not yet taken the first one, there is room for one less.
    for number in 0..6 {
        let reply = bench.hand_in("", format!("file {number}")).await;
        match reply.status {
            StatusCode::ACCEPTED => accepted.push(reply),
            _ => refused.push(reply),
        }
    }
    assert!((2..=3).contains(&accepted.len()), "{accepted:?}");
    for reply in &accepted {
        assert_eq!(reply.json()["state"], "queued");
        assert!(!reply.header("retry-after").is_empty());
    }
    for reply in &refused {
        assert_eq!(reply.status, StatusCode::TOO_MANY_REQUESTS);
        assert_eq!(reply.problem(), "queue-full");
        assert_eq!(reply.json()["position"], 3);
        assert!(reply.header("retry-after").parse::<u64>().expect("seconds") >= 1);
    }
    let (waiting, failed) = bench.state.store.waiting().await.expect("counts");
    assert_eq!((waiting, failed), (accepted.len() as u64, 0));
    gate.open();
    for reply in &accepted {
        graded(&bench, &reply.id()).await;
    }
    bench.finish().await;
}

/// Waits until a submission has its report.
async fn graded(bench: &Bench, id: &str) {
    for _ in 0..600 {
        if bench.get(&format!("/api/v1/submissions/{id}")).await.json()["state"] == "graded" {
            return;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    panic!("{id} was not graded within 30 s");
}

async fn a_fault_of_ours_is_no_report_and_is_tried_again(database: Database) {
    let times = Arc::new(AtomicUsize::new(0));
    let judge = {
        let times = Arc::clone(&times);
        Fake(move || match times.fetch_add(1, Ordering::SeqCst) {
            0 => Err(Fault::new(Text::new("no driver", "ドライバがありません"))),
            1 => panic!("a bug of ours"),
            _ => Ok(()),
        })
    };
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = Bench::with(database, config(), Arc::new(judge), clock.clone()).await;
    let reply = bench.hand_in("?lang=ja", "file").await;
    assert_eq!(reply.status, StatusCode::ACCEPTED, "{reply:?}");
    let json = reply.json();
    assert_eq!((&json["state"], &json["report"]), (&"failed".into(), &serde_json::Value::Null));
    assert_eq!(json["fault"]["message"], "ドライバがありません");
    // Who looks at its pictures does not have it graded once more.
    let animation = bench.get(json["links"]["animation"].as_str().expect("a link")).await;
    assert_eq!((animation.status, times.load(Ordering::SeqCst)), (StatusCode::NOT_FOUND, 1));
    // The panic costs another try, and the third one succeeds.
    while times.load(Ordering::SeqCst) < 3 {
        clock.advance(Duration::from_secs(61));
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    graded(&bench, &reply.id()).await;
    bench.finish().await;
}

async fn nothing_is_graded_twice_and_nothing_is_left(database: Database) {
    let times = Arc::new(AtomicUsize::new(0));
    let judge = {
        let times = Arc::clone(&times);
        Arc::new(Fake(move || {
            times.fetch_add(1, Ordering::SeqCst);
            Ok(())
        }))
    };
    // What a process that has gone left behind: claims that nobody keeps up.
    let location = database.location.parse().expect("a location");
    let store = Store::open(&location).await.expect("a database");
    let assignment = store.assignment("ggsample06").await.expect("an assignment");
    for number in 0..40 {
        let new = ggrade::service::store::NewSubmission {
            id: format!("left-{number}"),
            assignment: assignment.id.clone(),
            hand_in: ggrade::hand_in::HandIn::of_one("a.vert", format!("x{number}")),
            owner_id: None,
            student_id: None,
            batch_id: None,
            via: ggrade::service::store::Via::Api,
            seed: assignment.seed,
            hints: Hints::Full,
            received_at: 0,
            priority: Priority::Student,
            senders: Vec::new(),
            most_attempts: None,
        };
        store.add_submission(&new, None).await.expect("stored");
        assert!(store.claim(&["ggsample06"], None, "gone", 0, 1).await.expect("a claim").is_some());
    }
    store.close().await;
    drop(store);
    let bench = Bench::with(database, Config { workers: 4, ..config() }, judge, Clock::system()).await;
    for number in 0..40 {
        graded(&bench, &format!("left-{number}")).await;
    }
    assert_eq!(times.load(Ordering::SeqCst), 40);
    assert_eq!(bench.state.store.waiting().await.expect("counts"), (0, 0));
    bench.finish().await;
}

async fn only_while_it_is_open(database: Database) {
    let clock = Clock::fixed(1_000_000);
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), clock.clone()).await;
    let mut assignment = bench.state.store.assignment("ggsample06").await.expect("an assignment");
    assignment.opens_at = Some(1_010_000);
    assignment.closes_at = Some(1_020_000);
    bench.state.store.set_assignment(&assignment).await.expect("set");
    let mut seen = Vec::new();
    for _ in 0..4 {
        let reply = bench.hand_in("", "file").await;
        seen.push(if reply.status == StatusCode::CREATED { "open".into() } else { reply.problem() });
        clock.advance(Duration::from_millis(9_999));
    }
    // 1,000,000; 1,009,999; 1,019,998; 1,029,997: before it opens twice, then inside, then after.
    assert_eq!(seen, ["not-open", "not-open", "open", "closed"]);
    bench.finish().await;
}

async fn attempts_are_counted_by_student(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), Clock::system()).await;
    let mut assignment = bench.state.store.assignment("ggsample06").await.expect("an assignment");
    assignment.attempts = Some(2);
    assignment.audience = Audience::Number;
    assignment.hints = Hints::Gentle;
    bench.state.store.set_assignment(&assignment).await.expect("set");
    assert_eq!(bench.hand_in("", "file").await.problem(), "no-number");
    let hand_in = |student: &'static str, number: usize| {
        let request = Request::post(format!("/api/v1/submissions?student={student}&hints=full"))
            .header(header::CONTENT_TYPE, "text/plain")
            .header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
        bench.send(request.body(Body::from(format!("file {number}"))).expect("a request"))
    };
    for number in 0..2 {
        let reply = hand_in("s1", number).await;
        assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
        // No more help than the course allows, whatever is asked for.
        let stored = bench.state.store.submission(&reply.id()).await.expect("a store").expect("a submission");
        assert_eq!(stored.hints, Hints::Gentle);
    }
    assert_eq!(hand_in("S1", 3).await.problem(), "attempts");
    assert_eq!(hand_in("s2", 3).await.status, StatusCode::CREATED);
    bench.finish().await;
}

async fn hand_ins_at_the_same_time_are_no_more_than_the_attempts(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), Clock::system()).await;
    // The files of the second student are the same one, which has a report already: that is another way to the store.
    bench.hand_in("", "the same").await;
    let mut assignment = bench.state.store.assignment("ggsample06").await.expect("an assignment");
    assignment.attempts = Some(2);
    bench.state.store.set_assignment(&assignment).await.expect("set");
    for (student, is_same) in [("S1", false), ("S2", true)] {
        let mut senders = tokio::task::JoinSet::new();
        for number in 0..6 {
            let app = bench.app.clone();
            let text = if is_same { "the same".to_owned() } else { format!("file {number}") };
            let request = Request::post(format!("/api/v1/submissions?student={student}"))
                .header(header::CONTENT_TYPE, "text/plain")
                .header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
            let request = request.body(Body::from(text)).expect("a request");
            senders.spawn(async move { crate::bench::send(&app, request).await });
        }
        let replies = senders.join_all().await;
        let (stored, refused): (Vec<_>, Vec<_>) = replies.iter().partition(|reply| reply.status == StatusCode::CREATED);
        assert_eq!(stored.len(), 2, "{replies:?}");
        assert!(refused.iter().all(|reply| reply.problem() == "attempts"), "{refused:?}");
    }
    let rows = bench.state.store.class("ggsample06", None).await.expect("a class");
    let of = |student: &str| rows.iter().filter(|row| row.number.as_deref() == Some(student)).count();
    assert_eq!((of("S1"), of("S2")), (2, 2));
    bench.finish().await;
}

async fn what_is_old_is_removed(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let config = Config { retention_days: 30, ..config() };
    let bench = Bench::with(database, config, Arc::new(Fake(|| Ok(()))), clock.clone()).await;
    let draft = bench.hand_in("?draft=true", "draft").await.id();
    let old = bench.hand_in("", "old").await.id();
    let day = Duration::from_secs(24 * 3600);
    clock.advance(2 * day);
    ggrade::service::upkeep::remove(&bench.state).await;
    let status = async |id: &str| bench.get(&format!("/api/v1/submissions/{id}")).await.status;
    assert_eq!((status(&draft).await, status(&old).await), (StatusCode::NOT_FOUND, StatusCode::OK));
    clock.advance(29 * day);
    let young = bench.hand_in("", "young").await.id();
    let same_file = bench.hand_in("", "old").await.id();
    ggrade::service::upkeep::remove(&bench.state).await;
    assert_eq!((status(&old).await, status(&young).await), (StatusCode::NOT_FOUND, StatusCode::OK));
    // Another submission still has the very same file.
    let source = bench.get(&format!("/api/v1/submissions/{same_file}/source")).await;
    assert_eq!(source.body, b"old");
    bench.finish().await;
}
