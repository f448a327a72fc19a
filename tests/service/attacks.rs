//! What nobody gets who may not have it, on every route that there is. The routes are read from the sources and from the
//! description of the API, so a new one is in these tests by being written.

use crate::bench::{Bench, Reply};
use crate::cluster::Database;
use crate::codes::Guest;
use crate::on_both;
use crate::staff::{administrator, bench};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::clock::Clock;
use std::path::Path;

on_both!(
    nothing_of_a_teacher_opens_for_a_student_or_for_nobody,
    no_change_is_made_that_a_page_of_another_site_asks_for,
    an_assistant_changes_what_an_assistant_may,
);

/// A route: its method and its address, with `{…}` where something is to be filled in.
type Route = (String, String);

const METHODS: [&str; 5] = ["get", "post", "put", "patch", "delete"];

/// The routes of the pages, as the sources have them.
fn pages() -> Vec<Route> {
    let mut routes = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src/service/pages")];
    let mut files = vec![folders[0].with_extension("rs")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder").filter_map(Result::ok) {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    for file in files {
        let text = std::fs::read_to_string(file).expect("a source");
        for route in text.split(".route(\"").skip(1) {
            let (path, rest) = route.split_once('"').expect("the end of a string");
            let handlers = rest.lines().next().unwrap_or_default();
            let is_one = |method: &&&str| handlers.contains(&format!("{method}("));
            routes.extend(METHODS.iter().filter(is_one).map(|method| (method.to_uppercase(), path.to_owned())));
        }
    }
    assert!(routes.len() > 80, "{}", routes.len());
    routes
}

/// Those that only who teaches may use.
fn of_teachers() -> Vec<Route> {
    let open = ["/teacher/login", "/teacher/welcome/{secret}"];
    let mut routes = pages();
    routes.retain(|(_, path)| path.starts_with("/teacher") && !open.contains(&path.as_str()));
    routes
}

/// The operations of the API that only who teaches may use.
async fn operations(bench: &Bench) -> Vec<Route> {
    let document = bench.get("/api/v1/openapi.json").await.json();
    let mut found = Vec::new();
    for (path, methods) in document["paths"].as_object().expect("paths") {
        for (method, operation) in methods.as_object().expect("operations") {
            let ways = operation["security"].as_array().cloned().unwrap_or_default();
            let is_theirs = !ways.is_empty() && ways.iter().all(|way| way.get("teacher").is_some());
            found.extend(is_theirs.then(|| (method.to_uppercase(), path.clone())));
        }
    }
    assert!(found.len() > 40, "{}", found.len());
    found
}

/// An address with this in the place of what is to be filled in.
fn filled(path: &str, id: &str) -> String {
    let mut pieces = path.split('{');
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |so_far, piece| so_far + id + piece.split_once('}').expect("a closing brace").1)
}

/// Which kinds of bodies a route may want.
const KINDS: [&str; 3] =
    ["application/x-www-form-urlencoded", "application/json", "multipart/form-data; boundary=xxxxxxxxxx"];

fn body(kind: &str, csrf: &str) -> String {
    match kind {
        "application/json" => "{}".to_owned(),
        "application/x-www-form-urlencoded" => format!("csrf={csrf}"),
        _ => format!(
            "--xxxxxxxxxx\r\nContent-Disposition: form-data; name=\"csrf\"\r\n\r\n{csrf}\r\n\
             --xxxxxxxxxx\r\nContent-Disposition: form-data; name=\"file\"; filename=\"a.zip\"\r\n\r\nx\r\n--xxxxxxxxxx--\r\n"
        ),
    }
}

/// Asks with these cookies, and with every kind of body.
async fn ask(bench: &Bench, (method, address): (&str, &str), cookies: &str, csrf: &str) -> Vec<Reply> {
    let kinds = if method == "GET" { &KINDS[..1] } else { &KINDS[..] };
    let mut replies = Vec::new();
    for kind in kinds {
        let request = Request::builder().method(method).uri(address).header(header::COOKIE, cookies);
        let request = request.header(header::CONTENT_TYPE, *kind).header("sec-fetch-site", "same-origin");
        let request = request.header("x-ggrade-csrf", csrf);
        let body = if method == "GET" { Body::empty() } else { Body::from(body(kind, csrf)) };
        replies.push(bench.send(request.body(body).expect("a request")).await);
    }
    replies
}

async fn nothing_of_a_teacher_opens_for_a_student_or_for_nobody(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let student = Guest::new(&bench).await;
    assert_eq!(student.join(&bench, "S1", "").await.status, StatusCode::SEE_OTHER);
    let (cookie, csrf) = (student.cookie(), student.csrf(&bench).await);
    let submission = student.hand_in(&bench, "x").await.id();
    for (cookie, csrf) in [("", ""), (cookie.as_str(), csrf.as_str())] {
        for (method, path) in of_teachers() {
            for reply in ask(&bench, (&method, &filled(&path, &submission)), cookie, csrf).await {
                let is_led_away = reply.status == StatusCode::SEE_OTHER && reply.header("location") == "/teacher/login";
                let is_refused = [401, 403, 404].contains(&reply.status.as_u16());
                assert!(is_led_away || is_refused, "{method} {path}: {reply:?}");
            }
        }
        for (method, path) in operations(&bench).await {
            for reply in ask(&bench, (&method, &filled(&path, &submission)), cookie, csrf).await {
                assert_eq!(reply.status, StatusCode::UNAUTHORIZED, "{method} {path}: {reply:?}");
            }
        }
    }
    assert_eq!(student.get(&bench, &format!("/r/{submission}")).await.status, StatusCode::OK, "nothing is gone");
    bench.finish().await;
}

async fn no_change_is_made_that_a_page_of_another_site_asks_for(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let handed_in = bench.hand_in("", "x").await.id();
    let teacher = administrator(&bench).await;
    let changes = pages().into_iter().chain(operations(&bench).await).filter(|(method, _)| method != "GET");
    for (method, path) in changes {
        for csrf in ["", "0"] {
            let address = filled(&path, &handed_in);
            for reply in ask(&bench, (&method, &address), &teacher.cookie_line(), csrf).await {
                assert!(reply.status.is_client_error(), "{method} {path}: {reply:?}");
            }
        }
    }
    assert_eq!(bench.get(&format!("/r/{handed_in}")).await.status, StatusCode::OK, "nothing is gone");
    bench.finish().await;
}

/// What an assistant may change: judgements, what is made to be downloaded, and what is their own.
const OF_ASSISTANTS: [&str; 14] = [
    "POST /teacher/appeals/{id}",
    "POST /teacher/downloads",
    "POST /teacher/worksheet",
    "POST /teacher/batches/{id}/worksheet",
    "POST /teacher/tokens",
    "POST /teacher/tokens/{id}",
    "PUT /api/v1/appeals/{id}/answer",
    "PUT /api/v1/appeals/{id}/handler",
    "DELETE /api/v1/appeals/{id}/handler",
    "POST /api/v1/submissions/{id}/comments",
    "DELETE /api/v1/submissions/{id}/comments/{comment}",
    "PUT /api/v1/submissions/{id}/rubric/{line}",
    "DELETE /api/v1/submissions/{id}/rubric/{line}",
    "DELETE /api/v1/tokens/{id}",
];

async fn an_assistant_changes_what_an_assistant_may(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let handed_in = bench.hand_in("", "x").await.id();
    let mut first = administrator(&bench).await;
    let mut assistant = first.let_in("taro", "assistant").await;
    assistant.get("/teacher").await;
    let changes = of_teachers().into_iter().chain(operations(&bench).await).filter(|(method, _)| method != "GET");
    let mut allowed = Vec::new();
    for (method, path) in changes.filter(|(_, path)| path != "/teacher/logout") {
        let address = filled(&path, &handed_in);
        let replies = ask(&bench, (&method, &address), &assistant.cookie_line(), assistant.csrf()).await;
        // A body of a kind that the route does not take is refused before anybody asks who sends it.
        let is_refused = |reply: &Reply| [403, 415].contains(&reply.status.as_u16());
        allowed.extend((!replies.iter().all(is_refused)).then(|| format!("{method} {path}")));
    }
    assert_eq!(allowed, OF_ASSISTANTS);
    bench.finish().await;
}
