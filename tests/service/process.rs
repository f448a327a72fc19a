//! `ggrade serve` in a process of its own.

use crate::cluster::Database;
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// A running server.
pub struct Server {
    child: Child,
    pub address: String,
    /// What was read of its standard error so far.
    pub said: Arc<Mutex<String>>,
    /// Who reads it.
    reader: Option<JoinHandle<()>>,
}

/// The command line of a server on `database`; every limit is out of the way.
pub fn command(database: &Database) -> Command {
    command_at(database, "127.0.0.1:0")
}

/// The same at an address.
pub fn command_at(database: &Database, listen: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ggrade"));
    command
        .args(["serve", "--listen", listen, "--database", &database.location, "--workers", "1"])
        .args(["--deadline", "20", "--queue", "500"])
        .args(["--uploads-per-student", "100000", "--uploads-per-address", "100000"])
        .args(["--teacher-token", crate::bench::TEACHER])
        .env("GGRADE_WAIT", "60")
        // A busy machine must not change an answer.
        .env("GGRADE_LIMITS_REQUEST_TIMEOUT", "300")
        .env("GGRADE_LIMITS_LEASE", "1")
        .env("LANG", "C")
        .env_remove("GGRADE_LANG");
    command
}

impl Server {
    pub fn start(database: &Database) -> Self {
        Self::of(&mut command(database))
    }

    /// Starts it, and waits until it says where it listens.
    pub fn of(command: &mut Command) -> Self {
        let mut child = command.stderr(Stdio::piped()).stdin(Stdio::null()).spawn().expect("a server");
        let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
        let said = Arc::new(Mutex::new(String::new()));
        let mut address = None;
        for line in lines.by_ref() {
            let line = line.expect("text");
            said.lock().expect("a lock").push_str(&format!("{line}\n"));
            if let Some(url) = line.strip_prefix("Students:").or_else(|| line.strip_prefix("Grader:")) {
                address = Some(url.trim().trim_end_matches("/healthz").trim_end_matches('/').to_owned());
                break;
            }
        }
        let address = address.unwrap_or_else(|| panic!("no address: {}", said.lock().expect("a lock")));
        let more = Arc::clone(&said);
        // The pipe is read to its end, so that the server never waits for it.
        let reader = std::thread::spawn(move || {
            for line in lines.map_while(Result::ok) {
                more.lock().expect("a lock").push_str(&format!("{line}\n"));
            }
        });
        Self { child, address, said, reader: Some(reader) }
    }

    /// The address without its scheme.
    pub fn socket(&self) -> &str {
        self.address.trim_start_matches("http://")
    }

    /// The most memory that it had so far, in MiB; its workers not counted.
    pub fn peak(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).expect("a status");
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("a peak");
        line.trim().trim_end_matches(" kB").parse::<u64>().expect("a number") >> 10
    }

    pub fn kill(mut self) {
        self.child.kill().expect("a kill");
        self.child.wait().expect("an end");
    }

    /// Ends it, for all that it has said on standard error: a line may be read long after the answer that it was written before.
    pub fn everything_said(mut self) -> String {
        self.child.kill().expect("a kill");
        self.child.wait().expect("an end");
        self.reader.take().expect("a reader").join().expect("all is read");
        std::mem::take(&mut *self.said.lock().expect("a lock"))
    }

    /// Tells it to end, and waits for that.
    pub fn terminate(mut self) -> ExitStatus {
        let id = nix::unistd::Pid::from_raw(i32::try_from(self.child.id()).expect("an id"));
        nix::sys::signal::kill(id, nix::sys::signal::Signal::SIGTERM).expect("a signal");
        let give_up = Instant::now() + Duration::from_secs(60);
        loop {
            if let Some(status) = self.child.try_wait().expect("a status") {
                return status;
            }
            assert!(Instant::now() < give_up, "it did not end: {}", self.said.lock().expect("a lock"));
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Hands a file in; the answer, or nothing where there came none.
pub async fn hand_in(client: &reqwest::Client, address: &str, bytes: Vec<u8>) -> Option<(u16, Value)> {
    let request = client.post(format!("{address}/api/v1/submissions")).header("content-type", "text/plain").body(bytes);
    let response = request.send().await.ok()?;
    let status = response.status().as_u16();
    Some((status, response.json().await.ok()?))
}

/// The submission with this id.
pub async fn look_up(client: &reqwest::Client, address: &str, id: &str) -> Value {
    let url = format!("{address}/api/v1/submissions/{id}");
    let response = client.get(url).send().await.expect("an answer");
    assert_eq!(response.status(), 200, "{id} is lost");
    response.json().await.expect("JSON")
}
