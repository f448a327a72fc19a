//! What people wait for beside others who mean harm: uploads to one service from many addresses at once, by the clock.

use crate::class;
use crate::measure::percentile;
use crate::surfaces::Server;
use crate::table::Row;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Who hands in at once, one file after the other.
#[derive(Clone, Copy, Debug)]
struct Crowd {
    /// People whose files mean no harm, each new.
    honest: usize,
    /// People with the hostile samples, in turns.
    hostile: usize,
    /// People who send as fast as the rates allow, each file new.
    floods: usize,
    /// How long everybody waits between an answer and the next file.
    pause: Duration,
}

/// What is not counted at the beginning: connections are opened and hostile files met for the first time.
const UNWATCHED: Duration = Duration::from_secs(5);

/// How much longer than without anybody else 33 people wait beside 17 who send the hostile samples, and beside one who floods; for
/// each the medians' ratio and that of the longest but one in a hundred.
pub fn rows(seconds: f64) -> Vec<Row> {
    let unlimited = ["--uploads-per-student", "100000", "--uploads-per-address", "100000"];
    let pauses = [("hostile-p50", "hostile-p99", 2.0), ("hostile-busy-p50", "hostile-busy-p99", 0.0)];
    let mut rows = Vec::new();
    for (p50, p99, pause) in pauses {
        let alone = Crowd { honest: 33, hostile: 0, floods: 0, pause: Duration::from_secs_f64(pause) };
        let beside = Crowd { hostile: 17, ..alone };
        rows.extend(ratios([p50, p99], 1.3, [alone, beside].map(|crowd| latencies(crowd, &unlimited, seconds))));
    }
    let alone = Crowd { honest: 20, hostile: 0, floods: 0, pause: Duration::from_secs(2) };
    let beside = Crowd { floods: 1, ..alone };
    rows.extend(ratios(["flood-p50", "flood-p99"], 1.2, [alone, beside].map(|crowd| latencies(crowd, &[], seconds))));
    rows
}

fn ratios(ids: [&'static str; 2], most: f64, [alone, beside]: [Vec<f64>; 2]) -> [Row; 2] {
    let ratio = |part| percentile(&beside, part) / percentile(&alone, part);
    for (name, waits) in [("alone", &alone), ("beside", &beside)] {
        let [p50, p99] = [0.5, 0.99].map(|part| percentile(waits, part));
        eprintln!("{} {name}: {} reports, {p50:.0} and {p99:.0} ms", ids[0], waits.len());
    }
    [Row::ratio(ids[0], ratio(0.5), most), Row::ratio(ids[1], ratio(0.99), most)]
}

/// Milliseconds from an upload of the honest to its report, over so many seconds.
fn latencies(crowd: Crowd, rates: &[&str], seconds: f64) -> Vec<f64> {
    let folder = tempfile::tempdir().expect("a folder");
    let server = Server::of_people(folder.path(), rates);
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
    let end = UNWATCHED + Duration::from_secs_f64(seconds);
    // Nobody gets an answer in less than 5 ms.
    let most = (end.as_secs_f64() / 0.005) as usize;
    let fresh = Arc::new(Mutex::new(VecDeque::from(class::submissions(most))));
    let hostile = Arc::new(hostile_samples());
    let waited = Arc::new(Mutex::new(Vec::new()));
    runtime.block_on(async {
        let began = Instant::now();
        let mut people = tokio::task::JoinSet::new();
        for number in 0..crowd.honest + crowd.hostile + crowd.floods {
            let person = Person::new(&server.address, number);
            let (fresh, hostile, waited) = (Arc::clone(&fresh), Arc::clone(&hostile), Arc::clone(&waited));
            let next = move || fresh.lock().expect("no panic").pop_front().expect("a file").text.into_bytes();
            people.spawn(async move {
                // Nobody begins at the same time.
                tokio::time::sleep(crowd.pause * number as u32 / 50).await;
                for round in 0.. {
                    if number >= crowd.honest + crowd.hostile {
                        person.flood(next()).await;
                        continue;
                    }
                    let is_honest = number < crowd.honest;
                    let bytes = if is_honest { next() } else { hostile[(number * 7 + round) % hostile.len()].clone() };
                    let took = person.hand_in(bytes).await;
                    if is_honest && began.elapsed() > UNWATCHED {
                        waited.lock().expect("no panic").push(took);
                    }
                    tokio::time::sleep(crowd.pause).await;
                }
            });
        }
        tokio::time::sleep(end).await;
        people.abort_all();
    });
    std::mem::take(&mut *waited.lock().expect("no panic"))
}

/// Somebody with an address of their own.
struct Person {
    client: reqwest::Client,
    upload: String,
    address: String,
}

impl Person {
    fn new(server: &str, number: usize) -> Self {
        let upload = format!("{server}/api/v1/submissions");
        Self { client: reqwest::Client::new(), upload, address: format!("10.1.{}.{}", number / 250, number % 250 + 1) }
    }

    async fn send(&self, bytes: Vec<u8>) -> reqwest::Response {
        let request = self.client.post(&self.upload).header("content-type", "text/plain");
        request.header("x-forwarded-for", &self.address).body(bytes).send().await.expect("an answer")
    }

    /// Hands in and waits for the report.
    async fn hand_in(&self, bytes: Vec<u8>) -> f64 {
        let began = Instant::now();
        let answer = self.send(bytes).await;
        let status = answer.status();
        let body = answer.text().await.expect("a body");
        assert!(status.is_success() || status.as_u16() == 400, "{status}: {body}");
        began.elapsed().as_secs_f64() * 1e3
    }

    /// Hands in as often as the rates allow.
    async fn flood(&self, bytes: Vec<u8>) {
        let answer = self.send(bytes).await;
        let wait = answer.headers().get("retry-after").and_then(|seconds| seconds.to_str().ok()?.parse().ok());
        if answer.status().as_u16() == 429 {
            tokio::time::sleep(Duration::from_secs(wait.unwrap_or(1))).await;
        }
    }
}

/// All samples of `submissions/ggsample06/hostile/`, in the order of their names.
fn hostile_samples() -> Vec<Vec<u8>> {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06/hostile")];
    let mut files: Vec<PathBuf> = Vec::new();
    while let Some(folder) = folders.pop() {
        let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        for path in entries.flatten().map(|entry| entry.path()) {
            match path.is_dir() {
                true => folders.push(path),
                false if path.extension().is_some_and(|extension| extension == "vert") => files.push(path),
                false => {}
            }
        }
    }
    files.sort();
    files.iter().map(|file| std::fs::read(file).expect("a file")).collect()
}
