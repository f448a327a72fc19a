//! What a course and a student wait for, by the clock: `ggrade batch` over a folder, and uploads to `ggrade serve`.

use crate::class::Submission;
use crate::measure::{WORKERS, clean, program};
use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// Uploads a second.
const RATE: f64 = 20.0;

/// Seconds of `ggrade batch`, start and end included, with what it writes.
pub fn batch(submissions: &[Submission], formats: &str) -> f64 {
    let folder = tempfile::tempdir().expect("a folder");
    let class = folder.path().join("class");
    std::fs::create_dir(&class).expect("a folder");
    for (index, submission) in submissions.iter().enumerate() {
        std::fs::write(class.join(format!("{index:05}-{}", submission.name)), &submission.text).expect("a file");
    }
    let mut command = clean(program());
    command.arg("batch").arg(&class).arg("--out").arg(folder.path().join("out")).args(["--formats", formats]);
    command.args(["--jobs", &WORKERS.to_string()]).stdout(Stdio::null()).stderr(Stdio::null());
    let began = Instant::now();
    let status = command.status().expect("ggrade starts");
    let seconds = began.elapsed().as_secs_f64();
    assert!(matches!(status.code(), Some(0 | 1)), "ggrade batch: {status}");
    seconds
}

/// Milliseconds from an upload to its report.
pub struct Latency {
    /// Of files that nobody has handed in before.
    pub new: Vec<f64>,
    /// Of the same files once more.
    pub known: Vec<f64>,
}

/// Uploads each file to a service of its own and then again, [`RATE`] a second whatever the answers take.
pub fn service(submissions: &[Submission]) -> Latency {
    let folder = tempfile::tempdir().expect("a folder");
    let server = Server::start(folder.path());
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
    runtime.block_on(async {
        let client = reqwest::Client::new();
        // The first uploads open connections and meet workers that have met nobody.
        upload_all(&client, &server.address, &submissions[..8]).await;
        let rest = &submissions[8..];
        let new = upload_all(&client, &server.address, rest).await;
        Latency { new, known: upload_all(&client, &server.address, rest).await }
    })
}

async fn upload_all(client: &reqwest::Client, address: &str, submissions: &[Submission]) -> Vec<f64> {
    let began = tokio::time::Instant::now();
    let mut uploads = tokio::task::JoinSet::new();
    for (index, submission) in submissions.iter().enumerate() {
        tokio::time::sleep_until(began + Duration::from_secs_f64(index as f64 / RATE)).await;
        let request = client.post(format!("{address}/api/v1/submissions")).header("content-type", "text/plain");
        let request = request.body(submission.text.clone());
        uploads.spawn(async move {
            let began = Instant::now();
            let answer = request.send().await.expect("an answer");
            let status = answer.status();
            let report: serde_json::Value = answer.json().await.expect("JSON");
            assert_eq!(report["state"], "graded", "{status}: {report}");
            began.elapsed().as_secs_f64() * 1e3
        });
    }
    uploads.join_all().await
}

/// A running service.
pub struct Server {
    child: Child,
    pub address: String,
}

impl Server {
    fn start(folder: &std::path::Path) -> Self {
        let rates = ["--uploads-per-student", "100000", "--uploads-per-address", "100000"];
        Self::with(folder, ["--deadline", "60"].iter().chain(&rates))
    }

    /// One that tells people apart by their addresses, and has the usual deadline.
    pub fn of_people(folder: &std::path::Path, rates: &[&str]) -> Self {
        Self::with(folder, ["--trusted-proxy", "127.0.0.1", "--queue", "1000"].iter().chain(rates))
    }

    fn with<'a>(folder: &std::path::Path, options: impl Iterator<Item = &'a &'a str>) -> Self {
        let mut command = clean(program());
        command.args(["serve", "--listen", "127.0.0.1:0", "--workers", &WORKERS.to_string(), "--wait", "60"]);
        command.args(options).env("GGRADE_LIMITS_REQUEST_TIMEOUT", "300");
        command.arg("--database").arg(folder.join("ggrade.db")).env("LC_ALL", "C").env_remove("GGRADE_LANG");
        let mut child = command.stdin(Stdio::null()).stderr(Stdio::piped()).spawn().expect("ggrade starts");
        let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines().map_while(Result::ok);
        let address =
            lines.find_map(|line| Some(line.strip_prefix("Students:")?.trim().trim_end_matches('/').to_owned()));
        // The pipe is read to its end, so that the service never waits for it.
        std::thread::spawn(move || lines.for_each(drop));
        Self { child, address: address.expect("an address") }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
