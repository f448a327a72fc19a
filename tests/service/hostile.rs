//! Every hostile file to one server, from several clients at once: each has its verdict, and the server stays up.

#[path = "../hostile/files.rs"]
mod files;

use crate::cluster::Database;
use crate::process::{Server, command, look_up};
use files::{Hostile, Seen};
use ggrade::diagnostic::DiagnosticStage;
use ggrade::report::Verdict;
use ggrade::service::submit::MAX_UPLOAD;
use ggrade::source::not_text;
use reqwest::Client;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Clients that hand in at once.
const CLIENTS: usize = 4;

/// How often an upload that was not graded at once is asked for, every 0.1 s.
const QUESTIONS: usize = 600;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn hostile_files_get_their_verdicts_and_the_server_stays_up() {
    let database = Database::sqlite();
    // Less than a request may take: on a busy machine an upload is told to come back.
    let server = Server::of(command(&database).env("GGRADE_WAIT", "5"));
    let (files, next) = (Arc::new(files::all()), Arc::new(AtomicUsize::new(0)));
    let mut clients = tokio::task::JoinSet::new();
    for _ in 0..CLIENTS {
        let (files, next, address) = (Arc::clone(&files), Arc::clone(&next), server.address.clone());
        clients.spawn(async move {
            let client = Client::new();
            let mut broken = Vec::new();
            while let Some(file) = files.get(next.fetch_add(1, Ordering::Relaxed)) {
                let told = hand_in(&client, &address, file).await;
                broken.extend(told.err().map(|complaint| format!("{}: {complaint}", file.name)));
            }
            broken
        });
    }
    let broken: Vec<String> = clients.join_all().await.concat();
    assert!(broken.is_empty(), "{} of {} files:\n{}", broken.len(), files.len(), broken.join("\n"));
    // It was the process that was started that answered to the last; it ends because it is told to.
    assert!(server.terminate().success());
}

/// Hands a file in, and holds what comes of it against what is promised.
async fn hand_in(client: &Client, address: &str, file: &Hostile) -> Result<(), String> {
    let (status, json) =
        crate::process::hand_in(client, address, file.bytes.clone()).await.ok_or_else(|| "no answer".to_owned())?;
    // Refused at the door, with nothing stored: what is empty, what is too large, and what is no text.
    let unread = not_text(&reference::assignment("ggsample06").expect("built in").files[0], &file.bytes)
        .map(|error| error.message.en);
    let problem = match file.bytes.len() {
        0 => Some((422, "urn:ggrade:problem:unprocessable", "The file is empty")),
        length if length > MAX_UPLOAD => Some((413, "urn:ggrade:problem:too-large", "larger than 64 KiB")),
        _ => unread.as_deref().map(|message| (422, "urn:ggrade:problem:not-text", message)),
    };
    if let Some((expected, kind, says)) = problem {
        // Elsewhere such a file gets a report that says the same.
        if !file.bytes.is_empty()
            && (file.promise.verdict, file.promise.stage) != (Verdict::Rejected, Some(DiagnosticStage::Source))
        {
            return Err(format!("refused at the door, and promised {:?}", file.promise));
        }
        let is_named = json["detail"].as_str().is_some_and(|detail| detail.contains(says));
        let is_kept = status == expected && json["type"] == kind && is_named;
        return is_kept.then_some(()).ok_or_else(|| format!("{status}: {json}"));
    }
    if !matches!(status, 201 | 202) {
        return Err(format!("{status}: {json}"));
    }
    let mut json = json;
    let id = json["id"].as_str().ok_or("no id")?.to_owned();
    for _ in 0..QUESTIONS {
        if json["state"] == "graded" {
            break;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
        json = look_up(client, address, &id).await;
    }
    file.check(&Seen::of_json(&json["report"]).ok_or_else(|| format!("no report: {json}"))?)?;
    // What it says stands on a page as well.
    let page = client.get(format!("{address}/r/{id}")).header("accept", "text/html").send().await;
    let status = page.map_err(|error| error.to_string())?.status();
    status.is_success().then_some(()).ok_or_else(|| format!("its page: {status}"))
}
