//! Files that are no answer: what is no text is refused at the door, and what is hostile is answered as any other.

use crate::bench::{Bench, Fake, TEACHER, config};
use crate::cluster::Database;
use crate::{on_both, right, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::clock::Clock;
use std::path::Path;
use std::sync::Arc;

on_both!(
    what_is_no_text_uses_up_nothing,
    nothing_in_a_name_turns_its_direction,
    hostile_files_are_answered_as_any_other,
);

async fn what_is_no_text_uses_up_nothing(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), Clock::system()).await;
    let mut assignment = bench.state.store.assignment("ggsample06").await.expect("an assignment");
    assignment.attempts = Some(2);
    bench.state.store.set_assignment(&assignment).await.expect("set");
    let hand_in = |bytes: Vec<u8>| {
        let request = Request::post("/api/v1/submissions?student=s1")
            .header(header::CONTENT_TYPE, "text/plain")
            .header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
        bench.send(request.body(Body::from(bytes)).expect("a request"))
    };
    let swapped =
        std::iter::once(0xFEFF).chain("#version 410 core\nvoid main() {}\n".encode_utf16().map(u16::swap_bytes));
    for bytes in [
        b"\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\0\x01".to_vec(),
        b"PK\x03\x04\x14\0\0\0\x08\0".to_vec(),
        b"%PDF-1.7\n".to_vec(),
        swapped.flat_map(u16::to_le_bytes).collect(),
        b"void main() {\0}".to_vec(),
    ] {
        let reply = hand_in(bytes).await;
        assert_eq!((reply.status, reply.problem().as_str()), (StatusCode::UNPROCESSABLE_ENTITY, "not-text"));
    }
    assert_eq!(bench.state.store.waiting().await.expect("counts"), (0, 0));
    // What an editor in Japan saves is text: both attempts are left for it.
    for encoding in ["shift-jis", "euc-jp"] {
        let reply = hand_in(sample(&format!("hostile/accepted/encodings/{encoding}.vert"))).await;
        assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    }
    assert_eq!(hand_in(right()).await.problem(), "attempts");
    bench.finish().await;
}

async fn nothing_in_a_name_turns_its_direction(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), Clock::system()).await;
    // `trev.exe` in the order of its letters, `exe.vert` to the eye.
    let id = bench.hand_in("?name=%E2%80%AEtrev%E2%81%A6.exe", "void main() {}").await.id();
    let stored = bench.state.store.submission(&id).await.expect("a store").expect("a submission");
    assert_eq!(stored.name, "trev.exe");
    bench.finish().await;
}

/// Hostile files of every kind, each beside its expected report.
const HOSTILE: [&str; 9] = [
    "accepted/encodings",
    "rejected/degenerate",
    "rejected/preprocessor",
    "rejected/recursion",
    "stopped/compile-bombs",
    "stopped/loops",
    "stopped/memory",
    "stopped/nesting",
    "wrong/positions",
];

async fn hostile_files_are_answered_as_any_other(database: Database) {
    let bench = Bench::new(database).await;
    for kind in HOSTILE {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06/hostile").join(kind);
        let mut names: Vec<_> = std::fs::read_dir(&folder)
            .expect("a folder")
            .map(|entry| entry.expect("an entry").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "vert"))
            .collect();
        names.sort();
        let path = names.first().expect("a sample");
        let expected: serde_json::Value =
            serde_json::from_slice(&std::fs::read(path.with_extension("json")).expect("an expectation")).expect("JSON");
        let bytes = std::fs::read(path).expect("a sample");
        assert_eq!(
            ggrade::source::not_text(&reference::assignment("ggsample06").expect("built in").files[0], &bytes),
            None,
            "{}: no text, so refused at the door",
            path.display()
        );
        let reply = bench.hand_in("", bytes).await;
        assert_eq!(reply.status, StatusCode::CREATED, "{}: {reply:?}", path.display());
        assert_eq!(reply.json()["report"]["verdict"], expected["verdict"], "{}", path.display());
    }
    // And honest ones go on.
    let reply = bench.hand_in("", right_and_new()).await;
    assert_eq!(reply.json()["report"]["verdict"], "correct");
    assert_eq!(bench.hand_in("", right()).await.json()["report"]["verdict"], "correct");
    assert_eq!(bench.hand_in("", sample("rejected/brace-missing-at-end.vert")).await.json()["report"]["score"], 0);
    bench.finish().await;
}
