//! `ggrade assignment preview` by what a teacher at their desk sees of it: the page, the terminal, and nothing afterwards.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longer than anything takes on any machine: what has not happened by then does not happen.
const NEVER: Duration = Duration::from_secs(90);

/// A running preview of a copy of a homework of two files.
struct Previewing {
    child: Child,
    lines: Receiver<String>,
    address: String,
    around: TempDir,
}

impl Previewing {
    fn start() -> Self {
        let around = tempfile::tempdir().unwrap();
        for folder in ["bumps", "temporary", "programs"] {
            fs::create_dir(around.path().join(folder)).unwrap();
        }
        let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/bumps");
        for entry in fs::read_dir(original).unwrap().map(Result::unwrap) {
            fs::copy(entry.path(), around.path().join("bumps").join(entry.file_name())).unwrap();
        }
        // The desktop's way to a browser.
        let open = around.path().join("programs/xdg-open");
        fs::write(&open, format!("#!/bin/sh\necho \"$1\" > {}/opened\n", around.path().display())).unwrap();
        fs::set_permissions(&open, fs::Permissions::from_mode(0o755)).unwrap();
        let path = format!("{}:{}", around.path().join("programs").display(), std::env::var("PATH").unwrap());
        let mut child = Command::new(env!("CARGO_BIN_EXE_ggrade"))
            .args(["assignment", "preview", "bumps", "--lang", "en", "--deadline", "20"])
            .current_dir(around.path())
            .env("TMPDIR", around.path().join("temporary"))
            .env("PATH", path)
            .env("DISPLAY", ":0")
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .spawn()
            .unwrap();
        let stdout = BufReader::new(child.stdout.take().unwrap());
        let (sender, lines) = channel();
        std::thread::spawn(move || stdout.lines().map_while(Result::ok).try_for_each(|line| sender.send(line)));
        let mut previewing = Self { child, lines, address: String::new(), around };
        let first = previewing.until("http://");
        let address = first.trim_start_matches("http://").split('/').next().unwrap().to_owned();
        previewing.address = address;
        previewing
    }

    /// Waits for a line of the terminal that has this in it.
    fn until(&mut self, words: &str) -> String {
        let end = Instant::now() + NEVER;
        let mut seen = Vec::new();
        while let Ok(line) = self.lines.recv_timeout(end.saturating_duration_since(Instant::now())) {
            if line.contains(words) {
                return line;
            }
            seen.push(line);
        }
        panic!("waited in vain for {words:?}: {seen:#?}")
    }

    /// The folder's own files are graded.
    fn until_graded(&mut self) {
        self.until("the solution: Correct, 100 of 100 points");
        self.until("what is handed out: Wrong, 0 of 100 points");
    }

    /// The status and the text that an address answers.
    fn get(&self, path: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        let (host, end) = (&self.address, "Connection: close");
        write!(
            stream,
            "GET {path} HTTP/1.1\r\nHost: {host}\r\nAccept: text/html\r\nAccept-Language: en\r\n{end}\r\n\r\n"
        )
        .unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let status = answer.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap();
        (status, answer)
    }

    fn path(&self, file: &str) -> PathBuf {
        self.around.path().join("bumps").join(file)
    }

    /// Replaces a text of a file, which has to be there; the line on which it stands.
    fn replace(&self, file: &str, from: &str, to: &str) -> usize {
        let text = fs::read_to_string(self.path(file)).unwrap();
        let line = text.lines().position(|line| line.contains(from)).unwrap() + 1;
        fs::write(self.path(file), text.replacen(from, to, 1)).unwrap();
        line
    }

    /// Ends it as Ctrl-C does; its exit code.
    fn interrupt(&mut self) -> Option<i32> {
        let process = nix::unistd::Pid::from_raw(self.child.id().try_into().unwrap());
        nix::sys::signal::kill(process, nix::sys::signal::Signal::SIGINT).unwrap();
        self.child.wait().unwrap().code()
    }
}

impl Drop for Previewing {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn the_page_follows_the_folder_and_nothing_is_left() {
    let mut preview = Previewing::start();
    preview.until_graded();
    let opened = fs::read_to_string(preview.around.path().join("opened")).unwrap();
    assert_eq!(opened.trim(), format!("http://{}/", preview.address));
    let (status, page) = preview.get("/");
    assert_eq!(status, 200, "{page}");
    assert!(page.contains("<h1>Bumps</h1>") && page.contains("What is handed out"), "{page}");
    assert!(page.contains("<b>100 / 100</b>") && page.contains("<b>0 / 100</b>"), "{page}");

    preview.replace("assignment.toml", "en = \"Bumps\"", "en = \"Dents\"");
    preview.until_graded();
    assert!(preview.get("/").1.contains("<h1>Dents</h1>"));
    // A folder in the folder counts as well.
    fs::create_dir(preview.path("notes")).unwrap();
    fs::write(preview.path("notes/read-me.txt"), "mine\n").unwrap();
    preview.until_graded();

    // A mistake is named on the page and at the terminal, until it is mended.
    let line = preview.replace("assignment.toml", "stage = \"fragment\"", "stage = \"pixel\"");
    let place = format!("assignment.toml, line {line}");
    let said = preview.until(&place);
    assert!(said.starts_with("the folder bumps is not an assignment: "), "{said}");
    for path in ["/", "/a/bumps"] {
        let (status, page) = preview.get(path);
        assert_eq!(status, 503, "{page}");
        assert!(page.contains(&place), "{page}");
    }
    preview.replace("assignment.toml", "stage = \"pixel\"", "stage = \"fragment\"");
    preview.until_graded();
    assert!(preview.get("/").1.contains("<h1>Dents</h1>"));
    // A mistake in the solution is named by its line, and what is handed out may not be the answer.
    let line = preview.replace("solution.frag", "float lit = 0.2", "float lit = nothing");
    preview.until(&format!("solution.frag, line {line}"));
    preview.replace("solution.frag", "float lit = nothing", "float lit = 0.2");
    preview.until_graded();
    fs::copy(preview.path("solution.vert"), preview.path("starter.vert")).unwrap();
    preview.until("what is handed out: ");
    fs::copy(preview.path("solution.frag"), preview.path("starter.frag")).unwrap();
    preview.until("what is handed out: Correct");
    assert!(preview.get("/").1.contains("It has to run, and not to be right."));

    assert_eq!(preview.interrupt(), Some(0));
    assert!(TcpStream::connect(&preview.address).is_err());
    let left: Vec<_> = fs::read_dir(preview.around.path().join("temporary")).unwrap().collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn what_is_no_folder_is_no_preview() {
    super::ggrade()
        .args(["assignment", "preview", "tests/homeworks/nowhere", "--no-open"])
        .assert()
        .code(2)
        .stderr(predicates::str::contains("tests/homeworks/nowhere is no folder"));
}
