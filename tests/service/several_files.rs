//! A homework of two files: its hand-ins through the API, the page and the store. Nothing is drawn: the judge says what a
//! worker would say of a file that does not compile.

mod class;

use crate::bench::{Bench, Reply, config};
use crate::cluster::Database;
use crate::on_both;
use crate::roster::zip;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::diagnostic::{Diagnostic, DiagnosticStage};
use ggrade::fault::Fault;
use ggrade::grade::{sources, unfinished};
use ggrade::language::Text;
use ggrade::report::Verdict;
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use reference::Assignment;
use reference::interpreter::Stage as ShaderStage;
use serde_json::json;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

on_both!(
    two_files_are_one_hand_in,
    what_is_missing_or_double_is_named_and_not_stored,
    an_archive_is_opened,
    the_same_files_are_graded_once,
    the_page_takes_and_shows_each_file,
    what_the_editors_hold_is_handed_in_by_slot,
    the_page_learns_which_file_is_for_which_editor,
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
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        self.gradings.fetch_add(1, Ordering::SeqCst);
        let sources = sources(&self.homework, submission.hand_in);
        let mut missing = Diagnostic::error(DiagnosticStage::Compile, Text::verbatim("`;` is missing")).at(2, Some(28));
        missing.file = sources.get(1).map(|source| source.name.clone());
        let mut report = unfinished(&self.homework, sources, Verdict::Rejected, vec![missing], Default::default());
        report.probes.seed = submission.order.seed;
        Ok(GradedSubmission { report, frames: Arc::default() })
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

/// A cookie of the page, and the token of its forms.
async fn page(bench: &Bench, address: &str) -> (Reply, String, String) {
    let page = bench.get(address).await;
    let cookie = page.header("set-cookie").split(';').next().expect("a cookie").to_owned();
    let shown = page.text();
    let csrf = shown.split("name=\"csrf\" value=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a token");
    let csrf = csrf.to_owned();
    (page, cookie, csrf)
}

fn with_cookie(mut request: Request<Body>, cookie: &str) -> Request<Body> {
    request.headers_mut().insert(header::COOKIE, cookie.parse().expect("a cookie"));
    request
}

async fn the_page_takes_and_shows_each_file(database: Database) {
    let (bench, _) = bench(database).await;
    let (page, cookie, csrf) = page(&bench, "/").await;
    let shown = page.text();
    assert!(shown.contains("accept=\".vert,.vs,.frag,.fs,.glsl,.txt,text/plain,.zip\" multiple"), "{shown}");
    assert_eq!(page.all("textarea").len(), 2, "an editor for each file");
    let request = form("/a/ggsample06", &[("csrf", &csrf), ("send", "file")], &both());
    let reply = bench.send(with_cookie(request, &cookie)).await;
    assert_eq!(reply.status, StatusCode::SEE_OTHER, "{reply:?}");
    let report = bench.get(reply.header("location")).await;
    let text = report.text();
    assert_eq!(report.all(".listing").len(), 2, "{text}");
    assert!(text.contains("<a href=\"#F2L2\">ggsample11.frag, line 2, column 28</a>"), "{text}");

    // The texts of a hand-in are gone on with, each in its own editor.
    let id = reply.header("location").trim_start_matches("/r/").to_owned();
    let again = bench.get(&format!("/a/ggsample06?from={id}")).await;
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(again.all("textarea"), [VERTEX, FRAGMENT].map(words));
    let lost = bench.get("/a/ggsample06?from=00000000-0000-0000-0000-000000000000").await.text();
    assert!(lost.contains("no longer kept"), "{lost}");

    let starter = bench.get("/a/ggsample06/starter").await;
    assert!(starter.header("content-disposition").contains("ggsample06.zip"), "{starter:?}");
    let starter = bench.get("/a/ggsample06/starter?file=ggsample11.frag").await;
    assert_eq!(starter.text(), bench.state.assignment.files[1].starter);
    assert_eq!(bench.get("/a/ggsample06/starter?file=other").await.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}

async fn what_the_editors_hold_is_handed_in_by_slot(database: Database) {
    let (bench, _) = bench(database).await;
    let (_, cookie, csrf) = page(&bench, "/").await;
    // The first text as somebody typed it; in the place of the second a file, under a name that says something else.
    let mut body = Vec::new();
    for head in [
        format!("name=\"csrf\"\r\n\r\n{csrf}"),
        "name=\"text\"\r\n\r\nvoid main() {\r\n}\r\n".to_owned(),
        format!("name=\"text\"; filename=\"ggsample11.vert\"\r\n\r\n{FRAGMENT}"),
    ] {
        body.extend(format!("--x\r\nContent-Disposition: form-data; {head}\r\n").into_bytes());
    }
    body.extend(b"--x--\r\n");
    let post = |address: &str, body: Vec<u8>| {
        let request = Request::post(address).header(header::CONTENT_TYPE, "multipart/form-data; boundary=x");
        with_cookie(request.body(Body::from(body)).expect("a request"), &cookie)
    };
    let reply = bench.send(post("/a/ggsample06", body)).await;
    assert_eq!(reply.status, StatusCode::SEE_OTHER, "{reply:?}");
    let id = reply.header("location").trim_start_matches("/r/");
    let files = bench.state.store.hand_in(id).await.expect("a store").expect("a hand-in").files;
    let stored: Vec<_> = files.iter().map(|file| (file.name.as_str(), String::from_utf8_lossy(&file.bytes))).collect();
    assert_eq!(stored[0], ("ggsample11.vert", "void main() {\n}\n".into()));
    assert_eq!(stored[1], ("ggsample11.frag", FRAGMENT.into()));
    // Two editors are two texts.
    let one = form("/a/ggsample06", &[("csrf", &csrf), ("text", "void main() {}")], &[]);
    assert_eq!(bench.send(with_cookie(one, &cookie)).await.status, StatusCode::BAD_REQUEST);
    bench.finish().await;
}

async fn the_page_learns_which_file_is_for_which_editor(database: Database) {
    let (bench, judge) = bench(database).await;
    // A first visit that chooses a language gets its cookie as well.
    let request = Request::get("/?lang=en").body(Body::empty()).expect("a request");
    let page = bench.send(request).await;
    let cookies: Vec<_> = page.headers.get_all(header::SET_COOKIE).iter().filter_map(|c| c.to_str().ok()).collect();
    let cookie = cookies.iter().find(|cookie| cookie.starts_with("ggrade=")).expect("the browser's cookie");
    let cookie = cookie.split(';').next().expect("a cookie").to_owned();
    let text = page.text();
    let csrf = text.split("name=\"csrf\" value=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a token");
    let read = async |shown: &str, files: &[(&str, &[u8])]| {
        let form = form("/a/ggsample06/read", &[("csrf", csrf), ("shown", shown)], files);
        bench.send(with_cookie(form, &cookie)).await
    };
    let found = read("0", &both()).await.json();
    assert_eq!(
        (&found[0]["slot"], &found[0]["name"], &found[0]["text"]),
        (&json!(0), &json!("ggsample11.vert"), &json!(VERTEX))
    );
    assert_eq!(
        (&found[1]["slot"], &found[1]["name"], &found[1]["text"]),
        (&json!(1), &json!("ggsample11.frag"), &json!(FRAGMENT))
    );
    let sjis = [b"// \x83e\x83X\x83g\n".as_slice(), VERTEX.as_bytes()].concat();
    let found = read("1", &[("mine.vert", &sjis)]).await.json();
    assert_eq!((found.as_array().map(Vec::len), &found[0]["slot"]), (Some(1), &json!(0)));
    assert!(found[0]["text"].as_str().expect("a text").starts_with("// テスト\n"));
    let bytes = base64::Engine::decode(&base64::prelude::BASE64_STANDARD, found[0]["bytes"].as_str().expect("base64"));
    assert_eq!(bytes.expect("base64"), sjis, "the file is what is handed in, not its text");
    let members = both().map(|(name, bytes)| (format!("homework/{name}"), bytes.to_vec()));
    assert_eq!(read("0", &[("mine.zip", &zip(&members))]).await.json().as_array().map(Vec::len), Some(2));
    // What no slot asks for goes to the editor in sight.
    assert_eq!(read("1", &[("notes", b"void f() {}\n")]).await.json()[0]["slot"], 1);
    let double = read("0", &[("a.frag", b"1"), ("b.frag", b"2")]).await;
    assert_eq!((double.status, double.problem().as_str()), (StatusCode::UNPROCESSABLE_ENTITY, "files"));
    let picture = read("0", &[("ggsample11.frag", b"\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\0\x01")]).await.json();
    let detail = picture["detail"].as_str().expect("a detail");
    assert!(detail.starts_with("ggsample11.frag: This is not a fragment shader"), "{detail}");
    assert_eq!(judge.gradings.load(Ordering::SeqCst), 0);
    bench.finish().await;
}
