//! Homeworks that come by the browser: uploaded, checked in a worker, looked at, published, and regraded by a new version.

use crate::bench::{Bench, Reply, TEACHER, config};
use crate::cluster::Database;
use crate::on_both;
use crate::process::{Server, command};
use crate::roster::zip;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use reqwest::Method;
use serde_json::json;
use std::path::Path;
use std::time::Duration;

on_both!(
    an_uploaded_homework_is_published_and_graded,
    a_new_version_regrades_beside_the_old_one_first,
    what_is_no_homework_is_refused,
    whoever_may_not_is_kept_out,
    a_version_is_looked_at_as_students_will_see_it,
    a_token_of_a_homework_opens_one_that_was_published,
    addresses_of_a_class_lead_on_where_it_moved,
);

const OF_GGSAMPLE06: &str = "the-teacher-of-ggsample06";
const OF_WAVES: &str = "the-teacher-of-waves-alone";

/// The folder of the waves in a ZIP, each file changed by `change`.
fn waves(change: impl Fn(&str, String) -> String) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/waves");
    let files = std::fs::read_dir(folder).expect("a folder").map(|entry| {
        let entry = entry.expect("a file");
        let name = entry.file_name().into_string().expect("a name");
        let text = std::fs::read_to_string(entry.path()).expect("text");
        (format!("waves/{name}"), change(&name, text).into_bytes())
    });
    zip(&files.collect::<Vec<_>>())
}

/// The homework as it is.
fn first() -> Vec<u8> {
    waves(|_, text| text)
}

/// A version in which the surface is worth 70 points instead of 60.
fn second() -> Vec<u8> {
    waves(|name, text| match name {
        "assignment.toml" => text.replace("points = 60", "points = 70").replace("points = 40", "points = 30"),
        _ => text,
    })
}

/// A hand-in whose surface is right and whose colour is not.
fn half(comment: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/waves/solution.vert");
    let text = std::fs::read_to_string(folder).expect("text");
    text.replace("vec4(vec3(0.2, 0.4, 0.7) + up, 1.0)", "vec4(0.9, 0.1, 0.1, 1.0)") + "// " + comment + "\n"
}

async fn bench(database: Database) -> Bench {
    let tokens = [("ggsample06", OF_GGSAMPLE06), ("waves", OF_WAVES)];
    let tokens = tokens.map(|(homework, token)| (homework.to_owned(), token.to_owned())).into();
    // A busy machine must not change what a folder is.
    let config = Config { homework_tokens: tokens, deadline: 20.0, ..config() };
    Bench::with(database, config, crate::pool(), Clock::system()).await
}

async fn request(bench: &Bench, (method, address): (&str, &str), token: &str, body: Vec<u8>) -> Reply {
    let request = Request::builder().method(method).uri(address).header(header::ACCEPT_LANGUAGE, "en");
    let kind = if address.contains("/teacher/") { "application/x-www-form-urlencoded" } else { "application/zip" };
    let request = request.header(header::AUTHORIZATION, format!("Bearer {token}")).header(header::CONTENT_TYPE, kind);
    bench.send(request.body(Body::from(body)).expect("a request")).await
}

async fn post(bench: &Bench, address: &str, body: impl Into<Vec<u8>>) -> Reply {
    request(bench, ("POST", address), TEACHER, body.into()).await
}

async fn get(bench: &Bench, address: &str) -> Reply {
    request(bench, ("GET", address), TEACHER, Vec::new()).await
}

/// Uploads a folder: its id.
async fn uploaded(bench: &Bench, archive: Vec<u8>) -> String {
    let reply = post(bench, "/api/v1/folders", archive).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{:?}", String::from_utf8_lossy(&reply.body));
    reply.id()
}

async fn publish(bench: &Bench, id: &str) -> Reply {
    post(bench, &format!("/api/v1/folders/{id}/publication"), "").await
}

async fn ids(bench: &Bench) -> Vec<String> {
    let list = bench.get("/api/v1/assignments").await.json();
    let id = |one: &serde_json::Value| one["id"].as_str().expect("an id").to_owned();
    list["assignments"].as_array().expect("a list").iter().map(id).collect()
}

async fn an_uploaded_homework_is_published_and_graded(database: Database) {
    let bench = bench(database).await;
    let id = uploaded(&bench, first()).await;
    assert_eq!(uploaded(&bench, first()).await, id, "the same folder is there once");
    let list = get(&bench, "/api/v1/folders").await.json();
    let folder = &list["folders"][0];
    assert_eq!((folder["assignment"].clone(), folder["is_served"].clone()), (json!("waves"), json!(false)), "{list}");
    assert_eq!((folder["solution_score"].clone(), folder["max_score"].clone()), (json!(100.0), json!(100.0)), "{list}");
    assert_eq!(list["folders"].as_array().expect("a list").len(), 1);
    // It is looked at before anybody sees it.
    let page = get(&bench, &format!("/teacher/folders/{id}")).await;
    assert_eq!((page.status, page.all("h1")), (StatusCode::OK, vec!["Waves".to_owned()]), "{}", page.text());
    assert!(page.all("tbody th").contains(&"Surface".to_owned()), "{}", page.text());
    let text = page.text();
    let address = text.split('"').find(|it| it.starts_with("/assets/expected-waves.")).expect("the right pictures");
    let goal = get(&bench, address).await;
    assert!(goal.status == StatusCode::OK && goal.body.starts_with(b"\x89PNG"), "{goal:?}");
    assert_eq!(bench.get("/a/waves").await.status, StatusCode::NOT_FOUND);
    assert_eq!(ids(&bench).await, ["ggsample06"]);
    // With one homework, the class is at the address of ever.
    assert_eq!(get(&bench, "/teacher/settings").await.status, StatusCode::OK);
    let published = publish(&bench, &id).await;
    assert_eq!((published.status, published.json()), (StatusCode::OK, json!({"is_served": true, "regrading": null})));
    assert_eq!(ids(&bench).await, ["ggsample06", "waves"]);
    for address in ["/a/waves", "/a/waves/starter", "/a/waves/goal.png", "/a/ggsample06", "/"] {
        assert_eq!(bench.get(address).await.status, StatusCode::OK, "{address}");
    }
    assert_eq!(get(&bench, "/a/waves/teacher/settings").await.status, StatusCode::OK);
    let report = bench.hand_in("?assignment=waves", half("one")).await.json();
    assert_eq!(report["report"]["score"], 60.0, "{report}");
    // A start of the service serves it again, without being told.
    let bench = bench.restarted(vec![reference::assignment("ggsample06").expect("built in").clone()]).await;
    assert_eq!(ids(&bench).await, ["ggsample06", "waves"]);
    // Taken out of service, nothing of it is lost.
    let withdrawn = request(&bench, ("DELETE", &format!("/api/v1/folders/{id}/publication")), TEACHER, vec![]).await;
    assert_eq!(withdrawn.status, StatusCode::NO_CONTENT, "{withdrawn:?}");
    assert_eq!(
        (ids(&bench).await, bench.get("/a/waves").await.status),
        (vec!["ggsample06".into()], StatusCode::NOT_FOUND)
    );
    assert_eq!(publish(&bench, &id).await.status, StatusCode::OK);
    let page = bench.get(&format!("/r/{}", report["id"].as_str().expect("an id"))).await;
    assert_eq!(page.status, StatusCode::OK);
    let log = get(&bench, "/teacher/log").await.text();
    assert!(log.contains("withdraw") && log.contains("publish") && log.contains("uploaded"), "{log}");
    bench.finish().await;
}

/// Adopts a regrading as soon as it is done.
async fn adopted(bench: &Bench, address: &str) -> Reply {
    for _ in 0..400 {
        let reply = post(bench, address, "csrf=").await;
        let waits = reply.status == StatusCode::CONFLICT && reply.json()["detail"].to_string().contains("wait until");
        if !waits {
            return reply;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    panic!("the regrading does not end");
}

async fn a_new_version_regrades_beside_the_old_one_first(database: Database) {
    let bench = bench(database).await;
    let before = uploaded(&bench, first()).await;
    assert_eq!(publish(&bench, &before).await.status, StatusCode::OK);
    let early = bench.hand_in("?assignment=waves", half("early")).await.id();
    let after = uploaded(&bench, second()).await;
    let begun = publish(&bench, &after).await;
    assert_eq!((begun.status, begun.json()["is_served"].clone()), (StatusCode::ACCEPTED, json!(false)));
    let address = format!("/a/waves/teacher/regradings/{}", begun.json()["regrading"].as_str().expect("an id"));
    // Until somebody adopts, the old version grades.
    let late = bench.hand_in("?assignment=waves", half("late")).await;
    assert_eq!(late.json()["report"]["score"], 60.0);
    let late = late.id();
    let refused = adopted(&bench, &address).await;
    assert_eq!(refused.status, StatusCode::CONFLICT, "{refused:?}");
    assert!(refused.json()["detail"].as_str().expect("a detail").contains("1 more"), "{}", refused.json());
    let shown = get(&bench, &address).await;
    assert!(shown.text().contains("+10"), "{}", shown.text());
    let done = adopted(&bench, &address).await;
    assert_eq!(done.status, StatusCode::SEE_OTHER, "{done:?}");
    let list = bench.get("/api/v1/assignments").await.json();
    for id in [early, late] {
        let report = bench.get(&format!("/api/v1/submissions/{id}")).await.json();
        assert_eq!(report["report"]["score"], 70.0, "{report}");
        assert_eq!(report["report"]["assignment_digest"], list["assignments"][1]["digest"]);
    }
    let next = bench.hand_in("?assignment=waves", half("early")).await.json();
    assert_eq!(next["report"]["score"], 70.0, "the report by the old version is not given for the new one");
    bench.finish().await;
}

async fn what_is_no_homework_is_refused(database: Database) {
    let bench = bench(database).await;
    let manifest = |from: &'static str, to: &'static str| {
        waves(move |name, text| if name == "assignment.toml" { text.replace(from, to) } else { text })
    };
    let other = |file: &'static str, from: &'static str, to: &'static str| {
        waves(move |name, text| if name == file { text.replace(from, to) } else { text })
    };
    let starter = std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/waves/starter.vert"));
    let cases: Vec<(Vec<u8>, &[&str])> = vec![
        (b"no archive".to_vec(), &["no ZIP"]),
        (zip(&[("starter.vert".into(), starter.expect("a file"))]), &["no assignment.toml"]),
        (manifest("[scene]", "[scene"), &["assignment.toml, line"]),
        (manifest("segments = [24, 24]", "segments = [0, 24]"), &["assignment.toml, line"]),
        (manifest("solution = \"solution.vert\"", "solution = \"gone.vert\""), &["gone.vert"]),
        (manifest("id = \"waves\"", "id = \"../waves\""), &["cannot stand in an address"]),
        (other("fixed.frag", "}", "} }"), &["fixed.frag, line 4"]),
        (other("starter.vert", "void main", "void mein"), &["hands out", "entry point"]),
    ];
    for (archive, words) in cases {
        let reply = post(&bench, "/api/v1/folders", archive).await;
        assert_eq!((reply.status, reply.problem().as_str()), (StatusCode::UNPROCESSABLE_ENTITY, "unprocessable"));
        let detail = reply.json()["detail"].as_str().expect("a detail").to_owned();
        assert!(words.iter().all(|word| detail.contains(word)), "{words:?}: {detail}");
    }
    assert_eq!(get(&bench, "/api/v1/folders").await.json(), json!({"folders": []}));
    bench.finish().await;
}

async fn whoever_may_not_is_kept_out(database: Database) {
    let bench = bench(database).await;
    let id = uploaded(&bench, first()).await;
    // Who teaches another homework sees nothing of it.
    let list = request(&bench, ("GET", "/api/v1/folders"), OF_GGSAMPLE06, Vec::new()).await;
    assert_eq!((list.status, list.json()), (StatusCode::OK, json!({"folders": []})));
    assert_eq!(bench.get("/api/v1/folders").await.status, StatusCode::UNAUTHORIZED);
    let page = request(&bench, ("GET", "/teacher/folders"), OF_GGSAMPLE06, Vec::new()).await;
    assert!(page.status == StatusCode::OK && !page.text().contains("waves"), "{page:?}");
    for (token, status) in [(OF_GGSAMPLE06, StatusCode::FORBIDDEN), ("wrong", StatusCode::UNAUTHORIZED)] {
        for target in [
            ("GET", format!("/api/v1/folders/{id}")),
            ("DELETE", format!("/api/v1/folders/{id}")),
            ("POST", "/api/v1/folders".to_owned()),
            ("POST", format!("/api/v1/folders/{id}/publication")),
            ("DELETE", format!("/api/v1/folders/{id}/publication")),
        ] {
            let reply = request(&bench, (target.0, &target.1), token, first()).await;
            assert_eq!(reply.status, status, "{target:?}");
        }
    }
    for below in ["", "/page", "/page/starter"] {
        let address = format!("/teacher/folders/{id}{below}");
        let reply = request(&bench, ("GET", &address), OF_GGSAMPLE06, Vec::new()).await;
        assert_eq!(reply.status, StatusCode::FORBIDDEN, "{address}");
        assert_eq!(bench.get(&address).await.header("location"), "/teacher/login", "{address}");
    }
    assert_eq!(bench.get("/teacher/folders").await.header("location"), "/teacher/login");
    assert_eq!(get(&bench, "/api/v1/folders").await.json()["folders"].as_array().expect("a list").len(), 1);
    assert_eq!(ids(&bench).await, ["ggsample06"]);
    let missing = publish(&bench, "00000000-0000-0000-0000-000000000000").await;
    assert_eq!(missing.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}

/// Another process on the same database serves what one publishes, and takes out of service what one takes out.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_one_process_publishes_another_serves() {
    let database = Database::postgres().await;
    let (here, there) = (bench(database.again()).await, bench(database.again()).await);
    let id = uploaded(&here, first()).await;
    let address = format!("/api/v1/folders/{id}/publication");
    for (method, is_served) in [("POST", true), ("DELETE", false)] {
        let reply = request(&here, (method, &address), TEACHER, Vec::new()).await;
        assert!(reply.status.is_success(), "{method}: {reply:?}");
        let mut tries = 0;
        while there.state.homework("waves").is_some() != is_served {
            tries += 1;
            assert!(tries < 3000, "{method}: the other process was not told");
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
    }
    here.finish().await;
    there.finish().await;
}

/// What differs between the page of a version that is looked at and the page that students have once it is published.
fn without_marks(page: &str, id: &str) -> String {
    let page =
        page.replace(&format!("/teacher/folders/{id}/page"), "/a/waves").replace(&format!("waves {id}"), "waves");
    let mark = page.find("<aside class=\"preview\"").map(|from| from..page.find("</aside>").expect("an end") + 9);
    let page = mark.map_or(page.clone(), |mark| page.replace(&page[mark], ""));
    let is_of_this_page = |line: &&str| {
        [
            "csrf",
            "data-now",
            "/api/docs",
            "idempotency_key",
            "<footer",
            "/teacher",
            "?lang=",
            "formaction=\"/a/waves/draft\"",
        ]
        .iter()
        .any(|word| line.contains(word))
    };
    let lines = page
        .lines()
        .filter(|line| !is_of_this_page(line))
        .map(|line| line.replace(" data-draft=\"/a/waves/draft\"", ""));
    lines.filter(|line| !line.trim().is_empty()).collect::<Vec<_>>().join("\n")
}

async fn a_version_is_looked_at_as_students_will_see_it(database: Database) {
    let bench = bench(database).await;
    let id = uploaded(&bench, first()).await;
    let address = format!("/teacher/folders/{id}/page");
    assert!(get(&bench, &format!("/teacher/folders/{id}")).await.text().contains(&format!("href=\"{address}\"")));
    let seen = get(&bench, &address).await;
    assert_eq!((seen.status, seen.all("h1")), (StatusCode::OK, vec!["Waves".to_owned()]));
    assert!(seen.all("aside.preview")[0].contains("Nobody else sees it"), "{}", seen.text());
    // Nothing is handed in or graded there, and what is loaded by it is there.
    let sent = post(&bench, &address, "").await;
    assert_eq!((sent.status, sent.problem().as_str()), (StatusCode::CONFLICT, "preview"));
    assert!(!seen.text().contains("data-draft="), "nothing that is typed is sent");
    let starter = get(&bench, &format!("{address}/starter")).await;
    let published = std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/waves/starter.vert"));
    assert_eq!((starter.status, starter.body), (StatusCode::OK, published.expect("a file")));
    assert_eq!(bench.get("/a/waves").await.status, StatusCode::NOT_FOUND);
    assert_eq!(publish(&bench, &id).await.status, StatusCode::OK);
    // Beside the page that is published, with the same homeworks in the navigation.
    let (seen, published) = (get(&bench, &address).await, get(&bench, "/a/waves").await);
    let (before, after) = (without_marks(&seen.text(), &id), without_marks(&published.text(), &id));
    assert!(before.len() > 3000);
    for (before, after) in before.lines().zip(after.lines()) {
        assert_eq!(before, after);
    }
    assert_eq!(before.lines().count(), after.lines().count());
    bench.finish().await;
}

async fn a_token_of_a_homework_opens_one_that_was_published(database: Database) {
    let bench = bench(database).await;
    let before = uploaded(&bench, first()).await;
    assert_eq!(publish(&bench, &before).await.status, StatusCode::OK);
    // By its token another version of the homework is uploaded and published, and nothing else.
    let sent = request(&bench, ("POST", "/api/v1/folders"), OF_WAVES, second()).await;
    assert_eq!(sent.status, StatusCode::CREATED, "{sent:?}");
    let folder = format!("/api/v1/folders/{}", sent.id());
    let read = request(&bench, ("GET", &folder), OF_WAVES, Vec::new()).await;
    assert_eq!((read.status, &read.json()["assignment"]), (StatusCode::OK, &json!("waves")));
    let published = request(&bench, ("POST", &format!("{folder}/publication")), OF_WAVES, Vec::new()).await;
    assert_eq!((published.status, &published.json()["is_served"]), (StatusCode::OK, &json!(true)));
    let class = request(&bench, ("GET", "/api/v1/class/files/csv?assignment=waves"), OF_WAVES, Vec::new()).await;
    assert_eq!(class.status, StatusCode::OK, "{class:?}");
    for other in ["/api/v1/class/files/csv?assignment=ggsample06", "/api/v1/gradebook", "/api/v1/staff"] {
        assert_eq!(
            request(&bench, ("GET", other), OF_WAVES, Vec::new()).await.status,
            StatusCode::FORBIDDEN,
            "{other}"
        );
    }
    let kept = request(&bench, ("DELETE", &folder), OF_WAVES, Vec::new()).await;
    assert_eq!((kept.status, kept.problem().as_str()), (StatusCode::CONFLICT, "in-use"));
    let third = waves(|_, text| text.replace("Waves", "More waves"));
    let next = request(&bench, ("POST", "/api/v1/folders"), OF_WAVES, third).await.id();
    let gone = request(&bench, ("DELETE", &format!("/api/v1/folders/{next}")), OF_WAVES, Vec::new()).await;
    assert_eq!(gone.status, StatusCode::NO_CONTENT);
    assert_eq!(get(&bench, &format!("/api/v1/folders/{next}")).await.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}

/// Asks a server in a process of its own.
async fn ask(server: &Server, method: Method, path: &str, token: &str, body: Vec<u8>) -> reqwest::Response {
    let request = reqwest::Client::new().request(method, format!("{}{path}", server.address)).bearer_auth(token);
    request.header("content-type", "application/zip").body(body).send().await.expect("an answer")
}

/// A folder of some kilobytes that takes half a gigabyte to read, a large texture for each of its readings: the worker that grades
/// its files may have as much, the service must not.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_would_fill_the_service_stays_in_a_worker() {
    let database = Database::sqlite();
    let server = Server::start(&database);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/maps");
    let text = |name: &str| std::fs::read_to_string(folder.join(name)).expect("text");
    let reading = |place: &u8| {
        let note = format!("{{ en = \"Reading {place}.\", ja = \"解釈 {place}。\" }}");
        format!("{{ file = \"reading{place}.frag\", id = \"reading-{place}\", note = {note} }}")
    };
    let readings: Vec<String> = [1, 2, 3].iter().map(reading).collect();
    let manifest = text("assignment.toml").replace("size = [48, 48]", "size = [1900, 1900]").replacen(
        "solution = \"solution.frag\"\n",
        &format!("solution = \"solution.frag\"\naccepted = [{}]\n", readings.join(", ")),
        1,
    );
    let mut files = vec![("assignment.toml".to_owned(), manifest.into_bytes())];
    files
        .extend(["fixed.vert", "solution.frag", "starter.frag"].map(|name| (name.to_owned(), text(name).into_bytes())));
    files.extend([1, 2, 3].map(|place| (format!("reading{place}.frag"), text("solution.frag").into_bytes())));
    let archive = zip(&files);
    assert!(archive.len() < 100_000);
    let before = server.peak();
    let reply = ask(&server, Method::POST, "/api/v1/folders", TEACHER, archive).await;
    assert_eq!(reply.status(), 422);
    let detail = reply.json::<serde_json::Value>().await.expect("JSON")["detail"].to_string();
    assert!(detail.contains("256 MiB") && detail.contains("textures"), "{detail}");
    let grown = server.peak() - before;
    assert!(grown < 100, "the service grew by {grown} MiB");
    // It goes on, and takes a folder that is none of that kind.
    let reply = ask(&server, Method::POST, "/api/v1/folders", TEACHER, first()).await;
    assert_eq!(reply.status(), 201);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_token_may_be_of_a_homework_that_came_by_the_browser() {
    let database = Database::sqlite();
    let server = Server::start(&database);
    let uploaded = ask(&server, Method::POST, "/api/v1/folders", TEACHER, first()).await;
    let id = uploaded.json::<serde_json::Value>().await.expect("JSON")["id"].as_str().expect("an id").to_owned();
    let published = ask(&server, Method::POST, &format!("/api/v1/folders/{id}/publication"), TEACHER, vec![]).await;
    assert_eq!(published.status(), 200);
    assert!(server.terminate().success());
    let server = Server::of(command(&database).args(["--homework-token", &format!("waves={OF_WAVES}")]));
    for (homework, status) in [("waves", 200), ("ggsample06", 403)] {
        let path = format!("/api/v1/class/files/csv?assignment={homework}");
        assert_eq!(ask(&server, Method::GET, &path, OF_WAVES, vec![]).await.status(), status, "{homework}");
    }
}

async fn addresses_of_a_class_lead_on_where_it_moved(database: Database) {
    let bench = bench(database).await;
    // While there is one homework, its class is at the address of ever, and its own address leads there.
    for (old, new) in
        [("", "/teacher"), ("/settings", "/teacher/settings"), ("/person?number=S1", "/teacher/person?number=S1")]
    {
        let reply = get(&bench, &format!("/a/ggsample06/teacher{old}")).await;
        assert_eq!((reply.status, reply.header("location")), (StatusCode::SEE_OTHER, new));
    }
    let batch = request(&bench, ("POST", "/api/v1/batches"), TEACHER, zip(&[("S1.vert".into(), crate::right())])).await;
    assert_eq!(batch.status, StatusCode::ACCEPTED, "{batch:?}");
    let id = uploaded(&bench, first()).await;
    assert_eq!(publish(&bench, &id).await.status, StatusCode::OK);
    // With the second one it is below its homework. A page of both asks which; what is of one leads there.
    let asked = get(&bench, "/teacher/settings?lang=en").await;
    assert_eq!((asked.status, asked.all("h1")), (StatusCode::OK, vec!["Of which class?".to_owned()]));
    for homework in ["ggsample06", "waves"] {
        assert!(asked.text().contains(&format!("href=\"/a/{homework}/teacher/settings?lang=en\"")), "{}", asked.text());
    }
    assert!(asked.text().contains("href=\"/teacher/folders\""), "the whole course is reached from here");
    let address = format!("/teacher/batches/{}", batch.id());
    assert_eq!(get(&bench, &address).await.header("location"), format!("/a/ggsample06{address}"));
    let own = request(&bench, ("GET", "/teacher/insights"), OF_WAVES, Vec::new()).await;
    assert_eq!(own.header("location"), "/a/waves/teacher/insights", "the only class that they teach");
    let others = request(&bench, ("GET", &address), OF_WAVES, Vec::new()).await;
    assert_eq!(others.status, StatusCode::FORBIDDEN);
    assert_eq!(bench.get("/teacher/settings").await.header("location"), "/teacher/login");
    assert_eq!(get(&bench, "/teacher/nothing").await.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}
