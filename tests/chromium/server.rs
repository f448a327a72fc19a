//! The service that the browser looks at: the program itself, on a free port, with a database of its own.

use std::ffi::{OsStr, OsString};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// The teacher's token of a test's service.
pub const TOKEN: &str = "a-token-of-the-browser-tests";

/// A running service.
pub struct Server {
    child: Child,
    /// Its address, without a slash at the end.
    pub address: String,
    _folder: tempfile::TempDir,
}

impl Server {
    /// Starts it and waits until it listens.
    pub fn start() -> Self {
        Self::serving(&[])
    }

    /// The same with the homeworks of these folders in place of those that are built in.
    pub fn serving(homeworks: &[PathBuf]) -> Self {
        let homeworks = homeworks.iter().flat_map(|folder| ["--assignment".as_ref(), folder.as_os_str()]);
        Self::of(homeworks.map(OsStr::to_owned).collect())
    }

    /// The same by a configuration, at the address that it says.
    pub fn configured(configuration: &Path) -> Self {
        Self::of(vec!["--config".into(), configuration.into()])
    }

    fn of(arguments: Vec<OsString>) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let has_address = arguments.iter().any(|argument| argument == "--config");
        let mut child = Command::new(env!("CARGO_BIN_EXE_ggrade"))
            .args(["serve", "--log", "warn", "--teacher-token", TOKEN])
            .args(if has_address { &[][..] } else { &["--listen", "127.0.0.1:0"] })
            .args(["--uploads-per-student", "600", "--deadline", "10", "--wait", "20", "--database"])
            .arg(folder.path().join("ggrade.db"))
            .args(arguments)
            .env("LC_ALL", "C")
            .stderr(Stdio::piped())
            .spawn()
            .expect("ggrade");
        let mut lines = BufReader::new(child.stderr.take().expect("standard error")).lines();
        let address = lines
            .by_ref()
            .map_while(Result::ok)
            .find_map(|line| line.strip_prefix("Students:").map(|rest| rest.trim().trim_end_matches('/').to_owned()))
            .expect("ggrade serve says where it listens");
        // What it says later is passed on, and the pipe never fills.
        std::thread::spawn(move || lines.map_while(Result::ok).for_each(|line| eprintln!("{line}")));
        Self { child, address, _folder: folder }
    }

    /// An address of it.
    pub fn at(&self, path: &str) -> String {
        format!("{}{path}", self.address)
    }

    /// Hands a sample in for a student, as a teacher's program does.
    pub async fn hand_in(&self, student: &str, sample: &str) {
        let bytes = std::fs::read(super::sample(sample)).expect("a sample");
        let answer = reqwest::Client::new()
            .post(self.at(&format!("/api/v1/submissions?student={student}&name=ggsample06.vert")))
            .bearer_auth(TOKEN)
            .header("content-type", "text/plain")
            .body(bytes)
            .send()
            .await
            .expect("an answer");
        assert_eq!(answer.status(), 201, "{}", answer.text().await.unwrap_or_default());
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
