//! Several homeworks in one service: each is graded by its own folder, and each has a class of its own.

mod classes;
mod process;

use crate::bench::{Bench, Reply, config};
use crate::cluster::Database;
use crate::codes::Guest;
use crate::{on_both, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::report::Hints;
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::store::{NewSubmission, Priority, Via};
use reference::{Assignment, Folder};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::sync::Arc;

on_both!(
    each_is_graded_by_its_own_folder,
    the_pages_of_each_lead_to_its_own,
    restarts_keep_them_apart,
    what_is_not_served_waits,
    a_changed_folder_shows_no_picture_of_the_old_one,
    a_list_waits_for_no_picture_and_many_who_want_one_get_the_same,
);

/// The token that opens the class of the second homework.
const OF_WAVES: &str = "the-teacher-of-the-waves";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/waves")
}

/// The second homework.
pub fn waves() -> Arc<Assignment> {
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
pub fn waves_and_new() -> Vec<u8> {
    let mut bytes = std::fs::read(folder().join("solution.vert")).expect("a file");
    bytes.extend(format!("\n// {}\n", ggrade::service::identity::new_id()).into_bytes());
    bytes
}

fn request(method: &str, address: &str, token: &str, kind: &str, body: impl Into<Body>) -> Request<Body> {
    let request = Request::builder().method(method).uri(address).header(header::CONTENT_TYPE, kind);
    let request = request.header(header::ACCEPT, "text/html").header(header::ACCEPT_LANGUAGE, "en");
    request.header(header::AUTHORIZATION, format!("Bearer {token}")).body(body.into()).expect("a request")
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
        most_attempts: None,
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

async fn a_list_waits_for_no_picture_and_many_who_want_one_get_the_same(database: Database) {
    let bench = bench(database).await;
    let digest = &waves().digest[..16];
    let picture = format!("/a/waves/portrait.png?v={digest}");
    for address in ["/", "/teacher", "/a/waves/teacher"] {
        let page = bench.send(request("GET", address, crate::bench::TEACHER, "text/plain", Body::empty())).await;
        assert_eq!(page.status, StatusCode::OK, "{address}");
        assert!(page.text().contains(&picture) && !page.text().contains("data:image"), "{address}: {}", page.text());
    }
    let mut asked = tokio::task::JoinSet::new();
    for address in [picture, format!("/a/waves/goal.png?v={digest}")].into_iter().cycle().take(20) {
        let (app, asking) = (bench.app.clone(), Request::get(&address).body(Body::empty()).expect("a request"));
        asked.spawn(async move { (address, crate::bench::send(&app, asking).await) });
    }
    assert_eq!(bench.get("/healthz").await.status, StatusCode::OK);
    let mut seen = std::collections::BTreeMap::new();
    for (address, reply) in asked.join_all().await {
        assert_eq!((reply.status, reply.header("content-type")), (StatusCode::OK, "image/png"), "{address}");
        assert!(reply.header("cache-control").contains("immutable"), "{reply:?}");
        image::load_from_memory(&reply.body).expect("a PNG");
        let first = seen.entry(address).or_insert_with(|| reply.body.clone());
        assert_eq!(*first, reply.body);
    }
    assert_eq!(seen.len(), 2);
    bench.finish().await;
}
