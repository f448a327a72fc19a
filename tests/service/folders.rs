//! Homeworks that come by the browser: uploaded, checked in a worker, looked at, published, and regraded by a new version.

mod access;
mod preview;
mod process;

use crate::bench::{Bench, Reply, TEACHER, config};
use crate::cluster::Database;
use crate::on_both;
use crate::roster::zip;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use serde_json::json;
use std::path::Path;
use std::time::Duration;

on_both!(
    an_uploaded_homework_is_published_and_graded,
    a_new_version_regrades_beside_the_old_one_first,
    what_is_no_homework_is_refused,
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
    // What a publication has this process read anew is not served after the withdrawal.
    for _ in 0..5 {
        assert_eq!(publish(&bench, &id).await.status, StatusCode::OK);
        let address = format!("/api/v1/folders/{id}/publication");
        let withdrawn = request(&bench, ("DELETE", &address), TEACHER, vec![]).await;
        assert_eq!(withdrawn.status, StatusCode::NO_CONTENT, "{withdrawn:?}");
    }
    tokio::time::sleep(Duration::from_millis(500)).await;
    assert_eq!(ids(&bench).await, ["ggsample06"]);
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
