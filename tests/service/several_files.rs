//! A homework of two files: its hand-ins through the API, the page and the store. Nothing is drawn: the judge says what a
//! worker would say of a file that does not compile.

use crate::bench::{Bench, Reply, config};
use crate::cluster::Database;
use crate::on_both;
use crate::roster::zip;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::diagnostic::{Diagnostic, Stage};
use ggrade::fault::Fault;
use ggrade::grade::{sources, unfinished};
use ggrade::language::Text;
use ggrade::report::Verdict;
use ggrade::sandbox::{GradedSubmission, Submission};
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use reference::Assignment;
use reference::assignment::Stage as ShaderStage;
use serde_json::json;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

on_both!(
    two_files_are_one_hand_in,
    what_is_missing_or_double_is_named_and_not_stored,
    an_archive_is_opened,
    the_same_files_are_graded_once,
    the_page_takes_and_shows_each_file,
);

const VERTEX: &str = "void main() { gl_Position = pv; }\n";
const FRAGMENT: &str = "out vec4 fc;\nvoid main() { fc = vec4(1.0) }\n";

/// The first homework with a second file.
fn homework() -> Arc<Assignment> {
    let mut assignment = (**reference::assignment("ggsample06").expect("built in")).clone();
    let first = assignment.files[0].clone();
    let slot = |name: &str, stage| reference::assignment::HandedIn { name: name.into(), stage, ..first.clone() };
    assignment.files =
        vec![slot("ggsample11.vert", ShaderStage::Vertex), slot("ggsample11.frag", ShaderStage::Fragment)];
    Arc::new(assignment)
}

/// Finds a mistake in line 2 of the second file.
#[derive(Debug)]
struct Second {
    homework: Arc<Assignment>,
    gradings: AtomicUsize,
}

impl Judge for Second {
    fn grade(&self, submission: Submission<'_>) -> Result<GradedSubmission, Fault> {
        self.gradings.fetch_add(1, Ordering::SeqCst);
        let sources = sources(&self.homework, submission.hand_in);
        let mut missing = Diagnostic::error(Stage::Compile, Text::verbatim("`;` is missing")).at(2, Some(28));
        missing.file = sources.get(1).map(|source| source.name.clone());
        let mut report = unfinished(&self.homework, sources, Verdict::Rejected, vec![missing], Default::default());
        report.probes.seed = submission.order.seed;
        Ok(GradedSubmission { report, frames: Vec::new() })
    }
}

async fn bench(database: Database) -> (Bench, Arc<Second>) {
    let judge = Arc::new(Second { homework: homework(), gradings: AtomicUsize::new(0) });
    (Bench::serving(homework(), database, config(), judge.clone(), Clock::system()).await, judge)
}

/// A form with these files.
fn form(address: &str, fields: &[(&str, &str)], files: &[(&str, &[u8])]) -> Request<Body> {
    let mut body = Vec::new();
    for (name, value) in fields {
        body.extend(format!("--x\r\nContent-Disposition: form-data; name=\"{name}\"\r\n\r\n{value}\r\n").into_bytes());
    }
    for (name, bytes) in files {
        let head = format!("--x\r\nContent-Disposition: form-data; name=\"file\"; filename=\"{name}\"\r\n\r\n");
        body.extend([head.as_bytes(), bytes, b"\r\n"].concat());
    }
    body.extend(b"--x--\r\n");
    let request = Request::post(address).header(header::CONTENT_TYPE, "multipart/form-data; boundary=x");
    request.body(Body::from(body)).expect("a request")
}

async fn send(bench: &Bench, files: &[(&str, &[u8])]) -> Reply {
    bench.send(form("/api/v1/submissions", &[], files)).await
}

fn both() -> [(&'static str, &'static [u8]); 2] {
    [("ggsample11.frag", FRAGMENT.as_bytes()), ("ggsample11.vert", VERTEX.as_bytes())]
}

async fn two_files_are_one_hand_in(database: Database) {
    let (bench, _) = bench(database).await;
    let reply = send(&bench, &both()).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    let json = reply.json();
    assert_eq!(json["name"], "ggsample11.vert, ggsample11.frag");
    let report = &json["report"];
    let named = |index: usize| (report["sources"][index]["name"].clone(), report["sources"][index]["stage"].clone());
    assert_eq!(named(0), (json!("ggsample11.vert"), json!("vertex")));
    assert_eq!(named(1), (json!("ggsample11.frag"), json!("fragment")));
    assert_eq!(report["source"], report["sources"][0]);
    assert_eq!(report["diagnostics"][0]["file"], "ggsample11.frag");

    let source = bench.get(json["links"]["source"].as_str().expect("a link")).await;
    assert!(source.header("content-disposition").contains("filename=\"ggsample06.zip\""), "{source:?}");
    let mut archive = ::zip::ZipArchive::new(std::io::Cursor::new(source.body)).expect("a ZIP");
    for (name, text) in [("ggsample11.vert", VERTEX), ("ggsample11.frag", FRAGMENT)] {
        let bytes = std::io::read_to_string(archive.by_name(name).expect(name)).expect("text");
        assert_eq!(bytes, text);
    }
    bench.finish().await;
}

async fn what_is_missing_or_double_is_named_and_not_stored(database: Database) {
    let (bench, judge) = bench(database).await;
    let missing = send(&bench, &both()[..1]).await;
    assert_eq!((missing.status, missing.problem().as_str()), (StatusCode::UNPROCESSABLE_ENTITY, "files"));
    let detail = missing.json()["detail"].as_str().expect("a detail").to_owned();
    assert!(detail.contains("There is no `ggsample11.vert`, only `ggsample11.frag`."), "{detail}");
    let double = [("a.vert", b"1".as_slice()), ("b.vert", b"2"), ("ggsample11.frag", b"3")];
    let detail = send(&bench, &double).await.json()["detail"].as_str().expect("a detail").to_owned();
    assert!(detail.contains("which file is `ggsample11.vert`: `a.vert`, `b.vert`"), "{detail}");
    let empty = [("ggsample11.vert", b"".as_slice()), ("ggsample11.frag", FRAGMENT.as_bytes())];
    let detail = send(&bench, &empty).await.json()["detail"].as_str().expect("a detail").to_owned();
    assert!(detail.starts_with("ggsample11.vert: The file is empty."), "{detail}");
    assert_eq!(judge.gradings.load(Ordering::SeqCst), 0);
    assert!(bench.state.store.class("ggsample06", None).await.expect("a store").is_empty());
    bench.finish().await;
}

async fn an_archive_is_opened(database: Database) {
    let (bench, _) = bench(database).await;
    let members = both().map(|(name, bytes)| (format!("homework/{name}"), bytes.to_vec()));
    let reply = send(&bench, &[("mine.zip", &zip(&members))]).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    assert_eq!(reply.json()["name"], "ggsample11.vert, ggsample11.frag");
    bench.finish().await;
}

async fn the_same_files_are_graded_once(database: Database) {
    let (bench, judge) = bench(database).await;
    let [fragment, vertex] = both();
    let first = send(&bench, &[vertex, fragment]).await.id();
    send(&bench, &[fragment, vertex]).await;
    assert_eq!(judge.gradings.load(Ordering::SeqCst), 1, "their order does not count");
    let other = [("ggsample11.vert", b"// other\n".as_slice()), fragment];
    let second = send(&bench, &other).await.id();
    assert_eq!(judge.gradings.load(Ordering::SeqCst), 2);
    // A file that another hand-in has as well is kept for that one.
    let store = &bench.state.store;
    let sha256 = |bytes: &[u8]| ggrade::hand_in::HandIn::of_one("", bytes).sha256();
    for id in [first, second] {
        let target = ggrade::service::store::DeletionTarget::Submission(id);
        store.delete(&target, &[], 0).await.expect("deleted");
    }
    assert!(store.has_file(&sha256(fragment.1)).await.expect("a store"), "the second hand-in has it");
    assert!(!store.has_file(&sha256(b"// other\n")).await.expect("a store"));
    bench.finish().await;
}

async fn the_page_takes_and_shows_each_file(database: Database) {
    let (bench, _) = bench(database).await;
    let page = bench.get("/").await;
    let cookie = page.header("set-cookie").split(';').next().expect("a cookie").to_owned();
    let shown = page.text();
    assert!(shown.contains("accept=\".vert,.vs,.frag,.fs,.glsl,.txt,text/plain,.zip\" multiple"), "{shown}");
    assert_eq!(page.all("textarea").len(), 0, "the editor is for one file");
    let csrf = shown.split("name=\"csrf\" value=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a token");
    let mut request = form("/a/ggsample06", &[("csrf", csrf), ("send", "file")], &both());
    request.headers_mut().insert(header::COOKIE, cookie.parse().expect("a cookie"));
    let reply = bench.send(request).await;
    assert_eq!(reply.status, StatusCode::SEE_OTHER, "{reply:?}");
    let report = bench.get(reply.header("location")).await;
    let text = report.text();
    assert_eq!(report.all(".listing").len(), 2, "{text}");
    assert!(!text.contains("?from="), "the editor is for one file");
    assert!(text.contains("<a href=\"#F2L2\">ggsample11.frag, line 2, column 28</a>"), "{text}");
    let starter = bench.get("/a/ggsample06/starter").await;
    assert!(starter.header("content-disposition").contains("ggsample06.zip"), "{starter:?}");
    bench.finish().await;
}
