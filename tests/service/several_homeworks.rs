//! Several homeworks in one service: each is graded by its own folder, and each has a class of its own.

use crate::bench::{Bench, Reply, TEACHER, config};
use crate::cluster::Database;
use crate::codes::Guest;
use crate::process::{Server, command};
use crate::roster::zip;
use crate::{on_both, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::diagnose::Hints;
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::store::{NewSubmission, Priority, Via};
use reference::{Assignment, Folder};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

on_both!(
    each_is_graded_by_its_own_folder,
    the_pages_of_each_lead_to_its_own,
    restarts_keep_them_apart,
    what_is_not_served_waits,
    a_class_is_of_one_homework,
    the_teacher_of_one_homework_sees_no_other_class,
    a_changed_folder_shows_no_picture_of_the_old_one,
);

/// The token that opens the class of the second homework.
const OF_WAVES: &str = "the-teacher-of-the-waves";

/// Pages of the teacher's that belong to the course, below `/teacher`.
const OF_COURSE: [&str; 9] = ["codes", "courses", "data", "folders", "gradebook", "people", "plan", "platforms", "log"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/waves")
}

/// The second homework.
fn waves() -> Arc<Assignment> {
    Arc::new(Folder::read(&folder()).and_then(Assignment::load).expect("an assignment"))
}

fn ggsample06() -> Arc<Assignment> {
    Arc::clone(reference::assignment("ggsample06").expect("built in"))
}

fn of_both() -> Config {
    Config { homework_tokens: [("waves".to_owned(), OF_WAVES.to_owned())].into(), ..config() }
}

async fn bench(database: Database) -> Bench {
    Bench::serving_several(vec![ggsample06(), waves()], database, of_both(), crate::pool(), Clock::system()).await
}

/// A right answer to the second homework that no other test hands in.
fn waves_and_new() -> Vec<u8> {
    let mut bytes = std::fs::read(folder().join("solution.vert")).expect("a file");
    bytes.extend(format!("\n// {}\n", ggrade::service::identity::new_id()).into_bytes());
    bytes
}

fn request(method: &str, address: &str, token: &str, kind: &str, body: impl Into<Body>) -> Request<Body> {
    let request = Request::builder().method(method).uri(address).header(header::CONTENT_TYPE, kind);
    let request = request.header(header::ACCEPT, "text/html").header(header::ACCEPT_LANGUAGE, "en");
    request.header(header::AUTHORIZATION, format!("Bearer {token}")).body(body.into()).expect("a request")
}

async fn get(bench: &Bench, token: &str, address: &str) -> Reply {
    bench.send(request("GET", address, token, "", Body::empty())).await
}

/// A page as a student's browser gets it: the answer, and the cookie and the token of its forms.
async fn page(bench: &Bench, address: &str) -> (Reply, String, String) {
    let page = Request::get(address).header(header::ACCEPT_LANGUAGE, "en").body(Body::empty()).expect("a request");
    let page = bench.send(page).await;
    let cookie = page.header("set-cookie").split(';').next().unwrap_or_default().to_owned();
    let text = page.text();
    let csrf = text.split("name=\"csrf\" value=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap_or_default();
    (page, cookie, csrf.to_owned())
}

async fn each_is_graded_by_its_own_folder(database: Database) {
    let bench = bench(database).await;
    let (lambert, wave) = (right_and_new(), waves_and_new());
    for (query, bytes, verdict) in [
        ("?assignment=ggsample06", &lambert, "correct"),
        ("?assignment=waves", &wave, "correct"),
        ("?assignment=waves", &lambert, "rejected"),
        ("?assignment=ggsample06", &wave, "rejected"),
    ] {
        let reply = bench.hand_in(query, bytes.clone()).await;
        assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
        let json = reply.json();
        assert_eq!(json["report"]["verdict"], verdict, "{query}");
        assert_eq!(format!("?assignment={}", json["assignment"].as_str().expect("an id")), query);
        let digest = if query.ends_with("waves") { waves().digest.clone() } else { ggsample06().digest.clone() };
        assert_eq!(json["report"]["assignment_digest"], digest);
    }
    let list = bench.get("/api/v1/assignments?lang=ja").await.json();
    let of = |index: usize, key: &str| list["assignments"][index][key].clone();
    assert_eq!((of(0, "id"), of(1, "id"), of(1, "title")), (json!("ggsample06"), json!("waves"), json!("波")));
    assert_eq!((of(1, "files"), of(1, "digest")), (json!(["waves.vert"]), json!(waves().digest)));
    assert_eq!(of(1, "links"), json!({"page": "/a/waves", "starter": "/a/waves/starter"}));
    let unsaid = bench.hand_in("", lambert.clone()).await;
    assert_eq!((unsaid.status, unsaid.problem().as_str()), (StatusCode::UNPROCESSABLE_ENTITY, "unprocessable"));
    let detail = unsaid.json()["detail"].as_str().expect("a detail").to_owned();
    assert!(detail.contains("`ggsample06`, `waves`") && detail.contains("assignment=NAME"), "{detail}");
    let unknown = bench.hand_in("?assignment=wave", lambert).await;
    assert_eq!((unknown.status, unknown.problem().as_str()), (StatusCode::NOT_FOUND, "not-found"));
    let detail = unknown.json()["detail"].as_str().expect("a detail").to_owned();
    assert!(detail.contains("`wave`") && detail.contains("`ggsample06`, `waves`"), "{detail}");
    bench.finish().await;
}

async fn the_pages_of_each_lead_to_its_own(database: Database) {
    let bench = bench(database).await;
    let (list, ..) = page(&bench, "/").await;
    assert_eq!(list.all(".homeworks h2"), ["Gouraud shading", "Waves"].map(str::to_owned), "{}", list.text());
    assert!(list.text().contains("href=\"/a/waves\"") && list.text().contains("href=\"/a/ggsample06\""));
    for address in ["/a/nope", "/a/nope/teacher", "/a/nope/draft"] {
        let lost = bench.get(address).await;
        assert_eq!(lost.status, StatusCode::NOT_FOUND, "{address}");
        assert!(lost.text().contains("There is no homework `nope` here."), "{}", lost.text());
    }
    assert_eq!(bench.get("/a/waves/nope").await.status, StatusCode::NOT_FOUND);
    // The course link is that of the course: it leads to the list.
    let guest = Guest::new(&bench).await;
    let joined = guest.join(&bench, "S1", "").await;
    // Without a roster it first shows the code for other browsers, and then leads on.
    assert_eq!((joined.status, joined.header("location")), (StatusCode::SEE_OTHER, &*guest.address));
    let again = guest.get(&bench, &guest.address).await;
    assert!(again.all(".personal-code")[0].len() == 11 && again.text().contains("<a href=\"/\">"), "{}", again.text());
    // What is handed in on the page of a homework is of that homework, and so is the page of its report.
    for (id, bytes, title) in [("waves", waves_and_new(), "Waves"), ("ggsample06", right_and_new(), "Gouraud shading")]
    {
        let (desk, cookie, csrf) = page(&bench, &format!("/a/{id}")).await;
        let text = desk.text();
        assert!(text.contains(&format!("action=\"/a/{id}\"")), "{text}");
        assert!(text.contains(&format!("href=\"/a/{id}/teacher\"")), "{text}");
        assert_eq!(bench.get(&format!("/a/{id}/starter")).await.status, StatusCode::OK);
        let head = format!(
            "--x\r\nContent-Disposition: form-data; name=\"csrf\"\r\n\r\n{csrf}\r\n--x\r\nContent-Disposition: form-data; \
             name=\"file\"; filename=\"mine.vert\"\r\n\r\n"
        );
        let body = [head.as_bytes(), &bytes, b"\r\n--x--\r\n"].concat();
        let sent = Request::post(format!("/a/{id}"))
            .header(header::CONTENT_TYPE, "multipart/form-data; boundary=x")
            .header(header::COOKIE, &cookie);
        let sent = bench.send(sent.body(Body::from(body)).expect("a request")).await;
        assert_eq!(sent.status, StatusCode::SEE_OTHER, "{sent:?}");
        let (report, ..) = page(&bench, sent.header("location")).await;
        assert_eq!(report.all(".of-homework"), [title.to_owned()]);
        assert!(report.text().contains(&format!("href=\"/a/{id}\"")), "{}", report.text());
        let picture = bench.get(&format!("{}/portrait.png", sent.header("location"))).await;
        assert_eq!((picture.status, picture.header("content-type")), (StatusCode::OK, "image/png"));
        // The list knows what this browser has handed in.
        let list = Request::get("/").header(header::COOKIE, &cookie).header(header::ACCEPT_LANGUAGE, "en");
        let list = bench.send(list.body(Body::empty()).expect("a request")).await;
        let best: Vec<String> = list.all(".homeworks .terms-of-hand-in li");
        assert_eq!(best.len(), 1, "{best:?}");
        assert!(best[0].starts_with("Best so far"), "{best:?}");
    }
    bench.finish().await;
}

async fn restarts_keep_them_apart(database: Database) {
    let bench = bench(database).await;
    let lambert = bench.hand_in("?assignment=ggsample06", right_and_new()).await.json();
    let wave = bench.hand_in("?assignment=waves", waves_and_new()).await.json();
    let (of_lambert, of_wave) = (lambert["id"].as_str().expect("an id"), wave["id"].as_str().expect("an id"));
    // In another order, and with one of them alone.
    let bench = bench.restarted(vec![waves(), ggsample06()]).await;
    for (id, assignment) in [(of_lambert, "ggsample06"), (of_wave, "waves")] {
        let json = bench.get(&format!("/api/v1/submissions/{id}")).await.json();
        assert_eq!((&json["assignment"], &json["report"]["verdict"]), (&json!(assignment), &json!("correct")));
        let (shown, ..) = page(&bench, &format!("/r/{id}")).await;
        assert_eq!(shown.status, StatusCode::OK);
        assert!(shown.text().contains(&format!("href=\"/a/{assignment}\"")));
    }
    let bench = bench.restarted(vec![ggsample06()]).await;
    assert_eq!(page(&bench, &format!("/r/{of_lambert}")).await.0.status, StatusCode::OK);
    let (gone, ..) = page(&bench, &format!("/r/{of_wave}")).await;
    assert_eq!(gone.status, StatusCode::NOT_FOUND);
    assert!(gone.text().contains("There is no homework `waves` here."), "{}", gone.text());
    // Nothing of it is lost: a program still reads the report.
    assert_eq!(bench.get(&format!("/api/v1/submissions/{of_wave}")).await.json()["report"]["verdict"], "correct");
    bench.finish().await;
}

/// The other homework's files are for who serves it: another service on the same database, or this one after a restart.
async fn what_is_not_served_waits(database: Database) {
    let bench = Bench::new(database).await;
    let store = &bench.state.store;
    let stored = |assignment: &str, bytes: Vec<u8>, received_at| NewSubmission {
        id: ggrade::service::identity::new_id(),
        assignment: assignment.into(),
        hand_in: ggrade::hand_in::HandIn::of_one("mine.vert", bytes),
        owner_id: None,
        student_id: None,
        batch_id: None,
        via: Via::Api,
        seed: 7,
        hints: Hints::default(),
        received_at,
        priority: Priority::Student,
        senders: Vec::new(),
    };
    store.assignment("waves").await.expect("settings");
    // What came first would be graded first.
    let (wave, lambert) = (stored("waves", waves_and_new(), 0), stored("ggsample06", right_and_new(), 1));
    for new in [&wave, &lambert] {
        store.add_submission(new, None).await.expect("stored");
    }
    ggrade::service::grading::files_wait(&bench.state).await;
    assert_eq!(outcome(&bench, &lambert.id).await["report"]["verdict"], "correct");
    assert_eq!(bench.get(&format!("/api/v1/submissions/{}", wave.id)).await.json()["state"], "queued");
    let bench = bench.restarted(vec![ggsample06(), waves()]).await;
    assert_eq!(outcome(&bench, &wave.id).await["report"]["verdict"], "correct");
    bench.finish().await;
}

/// A submission when it is graded.
async fn outcome(bench: &Bench, id: &str) -> serde_json::Value {
    for _ in 0..1200 {
        let json = bench.get(&format!("/api/v1/submissions/{id}")).await.json();
        if json["state"] != "queued" {
            return json;
        }
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    }
    panic!("{id} was not graded");
}

/// An archive of two students.
fn archive(first: &[u8], second: &[u8]) -> Vec<u8> {
    let member = |name: &str, bytes: &[u8]| (format!("{name}/mine.vert"), bytes.to_vec());
    zip(&[member("alice", first), member("bob", second)])
}

async fn uploaded(bench: &Bench, token: &str, query: &str, bytes: Vec<u8>) -> Reply {
    bench.send(request("POST", &format!("/api/v1/batches{query}"), token, "application/zip", bytes)).await
}

async fn graded(bench: &Bench, id: &str) {
    for _ in 0..1200 {
        if bench.state.store.progress(id).await.expect("progress").is_done() {
            return;
        }
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    }
    panic!("the archive was not graded");
}

async fn a_class_is_of_one_homework(database: Database) {
    let bench = bench(database).await;
    let classes = get(&bench, TEACHER, "/teacher").await;
    assert_eq!(classes.all(".homeworks h2").len(), 2, "{}", classes.text());
    let of_waves = uploaded(&bench, TEACHER, "?assignment=waves", archive(&waves_and_new(), &right_and_new())).await;
    assert_eq!(of_waves.status, StatusCode::ACCEPTED, "{of_waves:?}");
    let id = of_waves.id();
    graded(&bench, &id).await;
    let unsaid = uploaded(&bench, TEACHER, "", archive(&right_and_new(), &right_and_new())).await;
    assert_eq!(unsaid.status, StatusCode::UNPROCESSABLE_ENTITY);

    let csv = get(&bench, TEACHER, "/api/v1/class/files/csv?assignment=waves").await.text();
    assert!(csv.contains("alice") && csv.contains("bob"), "{csv}");
    let verdicts: Vec<bool> = csv.lines().skip(1).map(|line| line.contains("correct")).collect();
    assert_eq!(verdicts, [true, false], "{csv}");
    let csv = get(&bench, TEACHER, "/api/v1/class/files/csv?assignment=ggsample06").await.text();
    assert!(!csv.contains("alice"), "{csv}");

    for (base, is_its_own) in [("/a/waves", true), ("/a/ggsample06", false)] {
        let class = get(&bench, TEACHER, &format!("{base}/teacher")).await;
        assert_eq!(class.status, StatusCode::OK);
        assert_eq!(class.text().contains("alice"), is_its_own);
        // What belongs to the course is the same for all homeworks; everything else stays in its own.
        let text = class.text();
        let leaves = text.split("href=\"/teacher/").skip(1).filter_map(|rest| rest.split('"').next());
        let leaves: Vec<&str> = leaves.filter(|page| !OF_COURSE.contains(page)).collect();
        assert!(leaves.is_empty(), "links leave the homework: {leaves:?}");
        let list = get(&bench, TEACHER, &format!("{base}/teacher/batches")).await;
        assert_eq!(list.text().contains(&id), is_its_own);
        let one = get(&bench, TEACHER, &format!("{base}/teacher/batches/{id}")).await;
        assert_eq!(one.status, if is_its_own { StatusCode::OK } else { StatusCode::NOT_FOUND });
        let settings = get(&bench, TEACHER, &format!("{base}/teacher/settings")).await;
        assert_eq!(settings.status, StatusCode::OK);
    }
    // Each has its own rules.
    let form = "application/x-www-form-urlencoded";
    let rules = "attempts=3&hints=full&audience=open&practice=on";
    let saved = bench.send(request("POST", "/a/waves/teacher/settings", TEACHER, form, rules)).await;
    assert_eq!(saved.header("location"), "/a/waves/teacher/settings?done=saved");
    let attempts = async |id: &str| bench.state.store.assignment(id).await.expect("settings").attempts;
    assert_eq!((attempts("waves").await, attempts("ggsample06").await), (Some(3), None));
    // Grading again is of one class as well.
    let again = bench.send(request("POST", "/a/waves/teacher/regradings", TEACHER, form, "")).await;
    let address = again.header("location").to_owned();
    assert!(address.starts_with("/a/waves/teacher/regradings/"), "{again:?}");
    assert_eq!(get(&bench, TEACHER, &address).await.status, StatusCode::OK);
    let elsewhere = address.replace("waves", "ggsample06");
    assert_eq!(get(&bench, TEACHER, &elsewhere).await.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}

async fn the_teacher_of_one_homework_sees_no_other_class(database: Database) {
    let bench = bench(database).await;
    let batch = uploaded(&bench, TEACHER, "?assignment=ggsample06", archive(&right_and_new(), &right_and_new())).await;
    let id = batch.id();
    graded(&bench, &id).await;
    let wave = bench.hand_in("?assignment=waves", waves_and_new()).await.id();
    let lambert = bench.hand_in("?assignment=ggsample06", right_and_new()).await.id();

    // Their only class is where they are led.
    let led = get(&bench, OF_WAVES, "/teacher").await;
    assert_eq!((led.status, led.header("location")), (StatusCode::SEE_OTHER, "/a/waves/teacher"));
    for address in ["/a/waves/teacher", "/a/waves/teacher/settings", "/api/v1/class/files/csv?assignment=waves"] {
        let own = get(&bench, OF_WAVES, address).await;
        assert_eq!(own.status, StatusCode::OK, "{address}");
        assert!(!own.text().contains("alice"), "{address}");
    }
    for address in [
        "/a/ggsample06/teacher",
        "/a/ggsample06/teacher/settings",
        "/a/ggsample06/teacher/batches",
        "/a/ggsample06/teacher/events",
        "/api/v1/class/files/csv?assignment=ggsample06",
        &format!("/api/v1/batches/{id}"),
        &format!("/api/v1/batches/{id}/events"),
        &format!("/api/v1/batches/{id}/files/csv"),
    ] {
        let foreign = get(&bench, OF_WAVES, address).await;
        assert_eq!(foreign.status, StatusCode::FORBIDDEN, "{address}");
        assert!(!foreign.text().contains("alice"), "{address}");
    }
    // Nor do they change it, nor what belongs to the whole course.
    let form = "application/x-www-form-urlencoded";
    for (method, address, kind) in [
        ("POST", "/a/ggsample06/teacher/settings", form),
        ("POST", "/a/ggsample06/teacher/regradings", form),
        ("POST", "/a/waves/teacher/course", form),
        ("POST", "/a/waves/teacher/settings/link", form),
        ("POST", "/api/v1/batches?assignment=ggsample06", "application/zip"),
        ("DELETE", &format!("/api/v1/batches/{id}"), ""),
        ("DELETE", &format!("/api/v1/submissions/{lambert}"), ""),
    ] {
        let body = if kind == form { "zone=UTC&language=en" } else { "" };
        let foreign = bench.send(request(method, address, OF_WAVES, kind, body)).await;
        assert_eq!(foreign.status, StatusCode::FORBIDDEN, "{method} {address}: {foreign:?}");
    }
    let student = bench.state.store.student("S1", 0).await.expect("a store").expect("a student");
    let refused = bench.send(request("DELETE", "/api/v1/students/S1", OF_WAVES, "", "")).await;
    assert_eq!(refused.status, StatusCode::FORBIDDEN, "{refused:?}");
    assert!(bench.state.store.student_by_id(&student.id).await.expect("a store").is_some());
    let delete = |address: String| request("POST", &address, OF_WAVES, form, format!("submission={lambert}"));
    let lost = bench.send(delete("/a/waves/teacher/delete".into())).await;
    assert_eq!(lost.status, StatusCode::NOT_FOUND, "found by the pages of another homework: {lost:?}");
    assert!(bench.state.store.submission(&lambert).await.expect("a store").is_some());
    let shown = get(&bench, OF_WAVES, "/a/waves/teacher/settings").await;
    assert!(!shown.text().contains("/join/") && !shown.text().contains("/teacher/roster"), "{}", shown.text());
    let gone = bench.send(request("DELETE", &format!("/api/v1/submissions/{wave}"), OF_WAVES, "", "")).await;
    assert_eq!(gone.status, StatusCode::OK, "{gone:?}");

    // The same by a session.
    let (_, cookie, csrf) = page(&bench, "/teacher/login").await;
    let login = Request::post("/teacher/login").header(header::COOKIE, &cookie).header(header::CONTENT_TYPE, form);
    let login = login.body(Body::from(format!("csrf={csrf}&password={OF_WAVES}"))).expect("a request");
    let login = bench.send(login).await;
    assert_eq!((login.status, login.header("location")), (StatusCode::SEE_OTHER, "/teacher"));
    let session = login.header("set-cookie").split(';').next().expect("a cookie").to_owned();
    for (address, status) in [("/a/waves/teacher", StatusCode::OK), ("/a/ggsample06/teacher", StatusCode::FORBIDDEN)] {
        let request = Request::get(address).header(header::COOKIE, &session).body(Body::empty()).expect("a request");
        assert_eq!(bench.send(request).await.status, status, "{address}");
    }
    bench.finish().await;
}

async fn a_changed_folder_shows_no_picture_of_the_old_one(database: Database) {
    let bench = Bench::new(database).await;
    let id = bench.hand_in("", sample("wrong/specular-half-unnormalized--average.vert")).await.id();
    let pictures = async |bench: &Bench| {
        let mut all = Vec::new();
        for name in ["portrait.png", "frames/0.png", "frames/0.png?view=expected"] {
            let picture = bench.get(&format!("/r/{id}/{name}")).await;
            assert_eq!(picture.status, StatusCode::OK, "{name}");
            all.push(picture.body);
        }
        all
    };
    let before = pictures(&bench).await;
    assert_eq!(before, pictures(&bench).await);
    let mut folder = Folder::clone(&bench.state.assignment.folder);
    let manifest = folder.text("assignment.toml").expect("text");
    assert!(manifest.contains("background = [255, 255, 255, 0]"), "{manifest}");
    let manifest = manifest.replacen("background = [255, 255, 255, 0]", "background = [40, 60, 90, 255]", 1);
    folder.files.insert("assignment.toml".into(), manifest.into());
    let changed = Arc::new(Assignment::load(folder).expect("an assignment"));
    let bench = bench.restarted(vec![changed]).await;
    for (old, new) in before.iter().zip(pictures(&bench).await) {
        assert_ne!(*old, new, "a picture of the folder as it was");
    }
    bench.finish().await;
}

/// What `ggrade serve` says and how it ends.
fn refusal(arguments: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let output = Command::new(env!("CARGO_BIN_EXE_ggrade"))
        .args(["serve", "--listen", "127.0.0.1:0", "--database"])
        .arg(folder.path().join("ggrade.db"))
        .args(arguments)
        .env("LANG", "C")
        .env_remove("GGRADE_LANG")
        .output()
        .expect("the program");
    (output.status.code(), String::from_utf8(output.stderr).expect("text"))
}

#[test]
fn two_homeworks_of_one_id_are_refused_at_the_start() {
    let copy = tempfile::tempdir().expect("a folder");
    for entry in std::fs::read_dir(folder()).expect("a folder").flatten() {
        std::fs::copy(entry.path(), copy.path().join(entry.file_name())).expect("a copy");
    }
    let (waves, copied) = (folder().display().to_string(), copy.path().display().to_string());
    let starter = copy.path().join("starter.vert");
    let text = std::fs::read_to_string(&starter).expect("a text");
    std::fs::write(&starter, text + "// another\n").expect("written");
    let (code, said) = refusal(&["--assignment", &waves, "--assignment", &copied]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains(&copied) && said.contains("the same id, `waves`"), "{said}");
    let (code, said) = refusal(&["--assignment", "ggsample06", "--assignment", "nothing"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("--assignment nothing: there is no built-in assignment"), "{said}");
    let (code, said) = refusal(&["--assignment", &waves, "--homework-token", "wave=0123456789abcdef"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("`wave`, which is not served. Served: waves."), "{said}");
    let (code, said) = refusal(&["--homework-token", "ggsample06=short"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("homework_tokens takes at least 16 characters"), "{said}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_program_serves_several() {
    let database = Database::sqlite();
    let waves = folder().display().to_string();
    // Named twice, it is there once.
    let mut serve = command(&database);
    serve.args(["--assignment", "ggsample06", "--assignment", &waves, "--assignment", &waves]);
    let client = reqwest::Client::new();
    let mut ids = Vec::new();
    for round in 0..2 {
        let server = Server::of(&mut serve);
        for (assignment, bytes) in [("ggsample06", right_and_new()), ("waves", waves_and_new())] {
            let address = format!("{}/api/v1/submissions?assignment={assignment}", server.address);
            let answer = client.post(address).header("content-type", "text/plain").body(bytes).send().await;
            let json: serde_json::Value = answer.expect("an answer").json().await.expect("JSON");
            assert_eq!((&json["assignment"], &json["report"]["verdict"]), (&json!(assignment), &json!("correct")));
            ids.push((json["id"].as_str().expect("an id").to_owned(), assignment));
        }
        for (id, assignment) in &ids {
            let json = crate::process::look_up(&client, &server.address, id).await;
            assert_eq!((&json["assignment"], &json["report"]["verdict"]), (&json!(assignment), &json!("correct")));
        }
        let figures = client.get(format!("{}/metrics", server.address)).send().await.expect("an answer");
        let figures = figures.text().await.expect("text");
        for assignment in ["ggsample06", "waves"] {
            let line =
                format!("ggrade_gradings_total{{assignment=\"{assignment}\",via=\"api\",verdict=\"correct\"}} 1");
            assert!(figures.contains(&line), "round {round}: {figures}");
        }
        // A crash in one round, an orderly end in the other.
        if round == 0 {
            server.kill();
        } else {
            assert!(server.terminate().success());
        }
    }
    // The file of a configuration names them in a list, or the only one as it always did.
    let settings = tempfile::NamedTempFile::new().expect("a file");
    for (line, several) in
        [(format!("assignment = [\"ggsample06\", {waves:?}]"), true), ("assignment = \"ggsample06\"".into(), false)]
    {
        std::fs::write(settings.path(), line).expect("written");
        let database = Database::sqlite();
        let server = Server::of(command(&database).arg("--config").arg(settings.path()));
        let page = client.get(&server.address).send().await.expect("an answer").text().await.expect("text");
        assert_eq!(page.contains("class=\"homeworks\""), several, "{page}");
    }
}
