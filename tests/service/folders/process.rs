//! Folders in services that are processes of their own, or several on one database.

use super::{OF_WAVES, bench, first, request, uploaded};
use crate::bench::TEACHER;
use crate::cluster::Database;
use crate::process::{Server, command};
use crate::roster::zip;
use reqwest::Method;
use std::path::Path;
use std::time::Duration;

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
