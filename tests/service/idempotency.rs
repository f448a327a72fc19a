//! `Idempotency-Key`: the same request twice stores once.

use crate::bench::{Bench, Fake, Reply, TEACHER, config};
use crate::cluster::Database;
use crate::on_both;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::clock::Clock;
use ggrade::service::limits::Peer;
use std::io::{Cursor, Write};
use std::sync::Arc;
use std::time::Duration;

on_both!(
    the_same_key_and_file_is_one_submission_with_one_answer,
    a_key_with_another_file_is_refused_and_stores_nothing,
    many_at_once_are_one_submission,
    a_repeated_hand_in_uses_up_no_second_attempt,
    a_key_is_forgotten_after_a_day,
    an_archive_sent_twice_is_one_batch,
    the_pages_form_takes_a_key_in_a_field,
);

async fn bench(database: Database, clock: Clock) -> Bench {
    Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), clock).await
}

fn post(query: &str, key: &str) -> axum::http::request::Builder {
    Request::post(format!("/api/v1/submissions{query}"))
        .header(header::CONTENT_TYPE, "text/plain")
        .header("idempotency-key", key)
}

async fn hand_in(bench: &Bench, query: &str, key: &str, body: &str) -> Reply {
    bench.send(post(query, key).body(Body::from(body.to_owned())).expect("a request")).await
}

async fn stored(bench: &Bench) -> usize {
    bench.state.store.class("ggsample06", None).await.expect("a class").len()
}

async fn the_same_key_and_file_is_one_submission_with_one_answer(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let first = hand_in(&bench, "?name=a.vert", "\"8e03978e-40d5\"", "file").await;
    assert_eq!(first.status, StatusCode::CREATED, "{first:?}");
    let again = hand_in(&bench, "?name=a.vert&lang=ja", "8e03978e-40d5", "file").await;
    assert_eq!((again.status, again.id()), (first.status, first.id()));
    assert_eq!(again.header("location"), first.header("location"));
    assert_eq!(again.json()["report"]["source"], first.json()["report"]["source"]);
    assert_eq!(stored(&bench).await, 1);
    // Without a key, and under another one, it is another submission.
    assert_ne!(hand_in(&bench, "?name=a.vert", "other", "file").await.id(), first.id());
    assert_ne!(bench.hand_in("?name=a.vert", "file").await.id(), first.id());
    assert_eq!(stored(&bench).await, 3);
    bench.finish().await;
}

async fn a_key_with_another_file_is_refused_and_stores_nothing(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let first = hand_in(&bench, "", "key", "file").await;
    for (query, body) in [("", "another"), ("?name=b.vert", "file"), ("?draft=true", "file"), ("?hints=none", "file")] {
        let reply = hand_in(&bench, query, "key", body).await;
        assert_eq!(reply.status, StatusCode::UNPROCESSABLE_ENTITY, "{query} {body}: {reply:?}");
        assert_eq!(reply.problem(), "idempotency-key-reused");
    }
    assert_eq!(hand_in(&bench, "", "", "file").await.status, StatusCode::BAD_REQUEST);
    assert_eq!(stored(&bench).await, 1);
    // A refused request leaves its key free.
    assert_eq!(hand_in(&bench, "", "second", "").await.problem(), "unprocessable");
    assert_eq!(hand_in(&bench, "", "second", "file").await.status, StatusCode::CREATED);
    // Somebody else's key is another one, whatever its letters.
    let elsewhere = post("", "key").extension(Peer("198.51.100.9:1".parse().expect("an address")));
    let reply = bench.send(elsewhere.body(Body::from("file")).expect("a request")).await;
    assert_eq!(reply.status, StatusCode::CREATED);
    assert_ne!(reply.id(), first.id());
    bench.finish().await;
}

async fn many_at_once_are_one_submission(database: Database) {
    let bench = bench(database, Clock::system()).await;
    // The second round finds the file's report in the store, which is another way through.
    for round in 0..2 {
        let mut senders = tokio::task::JoinSet::new();
        for _ in 0..12 {
            let app = bench.app.clone();
            let request = post("", &format!("round-{round}")).body(Body::from("file")).expect("a request");
            senders.spawn(async move { crate::bench::send(&app, request).await });
        }
        let mut ids = Vec::new();
        while let Some(reply) = senders.join_next().await {
            let reply = reply.expect("a task");
            assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
            ids.push(reply.id());
        }
        ids.sort();
        ids.dedup();
        assert_eq!(ids.len(), 1);
        assert_eq!(stored(&bench).await, round + 1);
    }
    bench.finish().await;
}

async fn a_repeated_hand_in_uses_up_no_second_attempt(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = bench(database, clock.clone()).await;
    let mut assignment = bench.state.store.assignment("ggsample06").await.expect("an assignment");
    assignment.attempts = Some(1);
    assignment.closes_at = Some(clock.now() + 1000);
    bench.state.store.set_assignment(&assignment).await.expect("set");
    let send = async || {
        let request = post("?student=s1", "key").header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
        bench.send(request.body(Body::from("file")).expect("a request")).await
    };
    let first = send().await;
    assert_eq!(first.status, StatusCode::CREATED, "{first:?}");
    assert_eq!(send().await.id(), first.id());
    // Also when handing in is over: it was in time.
    clock.advance(Duration::from_secs(2));
    assert_eq!(send().await.id(), first.id());
    bench.finish().await;
}

async fn a_key_is_forgotten_after_a_day(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = bench(database, clock.clone()).await;
    let first = hand_in(&bench, "", "key", "file").await.id();
    let hour = Duration::from_secs(3600);
    clock.advance(23 * hour);
    ggrade::service::upkeep::remove(&bench.state).await;
    assert_eq!(hand_in(&bench, "", "key", "file").await.id(), first);
    clock.advance(2 * hour);
    ggrade::service::upkeep::remove(&bench.state).await;
    assert_ne!(hand_in(&bench, "", "key", "file").await.id(), first);
    bench.finish().await;
}

fn archive(text: &str) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for student in ["a", "b"] {
        let options = zip::write::SimpleFileOptions::default();
        zip.start_file(format!("{student}/ggsample06.vert"), options).expect("a member");
        zip.write_all(text.as_bytes()).expect("written");
    }
    zip.finish().expect("an archive").into_inner()
}

async fn an_archive_sent_twice_is_one_batch(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let send = |bytes: Vec<u8>| {
        let request = Request::post("/api/v1/batches")
            .header(header::CONTENT_TYPE, "application/zip")
            .header(header::AUTHORIZATION, format!("Bearer {TEACHER}"))
            .header("idempotency-key", "\"of the class\"");
        crate::bench::send(&bench.app, request.body(Body::from(bytes)).expect("a request"))
    };
    let bytes = archive("one");
    let (first, second) = tokio::join!(send(bytes.clone()), send(bytes.clone()));
    assert_eq!((first.status, second.status), (StatusCode::ACCEPTED, StatusCode::ACCEPTED), "{first:?} {second:?}");
    assert_eq!(first.id(), second.id());
    assert_eq!(send(bytes).await.id(), first.id());
    assert_eq!(send(archive("other")).await.problem(), "idempotency-key-reused");
    assert_eq!(bench.state.store.batches("ggsample06").await.expect("batches").len(), 1);
    assert_eq!(stored(&bench).await, 2);
    bench.finish().await;
}

async fn the_pages_form_takes_a_key_in_a_field(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let page = bench.get("/").await;
    let cookie = page.header("set-cookie").split(';').next().expect("a cookie").to_owned();
    let html = String::from_utf8_lossy(&page.body).into_owned();
    let html = scraper::Html::parse_document(&html);
    let field = scraper::Selector::parse("input[name=csrf]").expect("a selector");
    let csrf = html.select(&field).next().and_then(|input| input.value().attr("value")).expect("a token").to_owned();
    drop(html);
    let send = async |text: &str| {
        let part = |name: &str, value: &str| {
            format!("--x\r\nContent-Disposition: form-data; name=\"{name}\"\r\n\r\n{value}\r\n")
        };
        let body =
            [part("csrf", &csrf), part("idempotency_key", "k1"), part("text", text), "--x--\r\n".into()].concat();
        let request = Request::post("/a/ggsample06")
            .header(header::CONTENT_TYPE, "multipart/form-data; boundary=x")
            .header(header::COOKIE, &cookie);
        bench.send(request.body(Body::from(body)).expect("a request")).await
    };
    let first = send("void main() {}").await;
    assert_eq!(first.status, StatusCode::SEE_OTHER, "{first:?}");
    assert_eq!(send("void main() {}").await.header("location"), first.header("location"));
    // Whoever goes back to the page sends the same key with another text.
    let other = send("void main() { }").await;
    assert_eq!(other.status, StatusCode::SEE_OTHER, "{other:?}");
    assert_ne!(other.header("location"), first.header("location"));
    assert_eq!(stored(&bench).await, 2);
    bench.finish().await;
}
