//! `ggrade watch` by what a student at their desk sees of it.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longer than any grading on any machine: what has not happened by then does not happen.
const NEVER: Duration = Duration::from_secs(60);
/// How long nothing more is waited for where nothing more is expected.
const QUIET: Duration = Duration::from_millis(1500);

/// A shader that scores less than full marks, and a right one.
fn wrong() -> String {
    sample("wrong", "specular-half-unnormalized--")
}

fn right() -> String {
    sample("accepted/answers", "plain-int-zero")
}

fn sample(folder: &str, start: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(folder);
    let mut found: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    let is_wanted = |path: &&PathBuf| {
        path.extension().is_some_and(|e| e == "vert") && path.file_name().unwrap().to_string_lossy().starts_with(start)
    };
    fs::read_to_string(found.iter().find(is_wanted).unwrap()).unwrap()
}

/// A running `ggrade watch`.
struct Watching {
    child: Child,
    output: Receiver<Vec<u8>>,
    text: String,
    folder: TempDir,
}

impl Watching {
    fn start(content: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("ggsample06.vert"), content).unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_ggrade"))
            .args(["watch", "ggsample06.vert", "--lang", "en"])
            .current_dir(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .spawn()
            .unwrap();
        let mut stdout = child.stdout.take().unwrap();
        let (sender, output) = channel();
        std::thread::spawn(move || {
            let mut buffer = [0; 4096];
            while let Ok(count @ 1..) = stdout.read(&mut buffer) {
                if sender.send(buffer[..count].to_vec()).is_err() {
                    return;
                }
            }
        });
        Self { child, output, text: String::new(), folder }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("ggsample06.vert")
    }

    /// Waits until the output has `what` behind what was waited for before, and gives all up to its end.
    fn until(&mut self, what: &str) -> String {
        let deadline = Instant::now() + NEVER;
        loop {
            if let Some(at) = self.text.find(what) {
                return self.text.drain(..at + what.len()).collect();
            }
            let rest = deadline.saturating_duration_since(Instant::now());
            match self.output.recv_timeout(rest) {
                Ok(bytes) => self.text.push_str(&String::from_utf8_lossy(&bytes)),
                Err(error) => panic!("{error} before {what:?} in {:?}", self.text),
            }
        }
    }

    /// What else is said within a while.
    fn rest(&mut self) -> String {
        while let Ok(bytes) = self.output.recv_timeout(QUIET) {
            self.text.push_str(&String::from_utf8_lossy(&bytes));
        }
        std::mem::take(&mut self.text)
    }

    /// Ctrl-C, and how it ends.
    fn interrupt(&mut self) -> Option<i32> {
        let process = nix::unistd::Pid::from_raw(self.child.id().cast_signed());
        nix::sys::signal::kill(process, nix::sys::signal::Signal::SIGINT).unwrap();
        self.child.wait().unwrap().code()
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn each_save_gives_a_report_and_what_it_changed() {
    let mut watching = Watching::start(&wrong());
    watching.until("#1");
    watching.until("80 / 100");
    watching.until("seed");
    fs::write(watching.path(), right()).unwrap();
    let second = watching.until("Since the last save 80 → 100 / 100 (+20)");
    assert!(second.contains("#2") && second.contains("Every frame and every probe agrees"), "{second}");
    assert!(!second.contains('\x1b'), "a pipe gets no codes of a terminal");
    watching.until("mended: Half vector not normalised");
    fs::write(watching.path(), "#version 410 core\nvoid main() { oops }\n").unwrap();
    watching.until("It no longer runs: 100 → 0 / 100");
    assert_eq!(watching.interrupt(), Some(1), "the last report is no right answer");
}

#[test]
fn it_ends_with_the_code_of_the_last_report() {
    let mut watching = Watching::start(&right());
    watching.until("seed");
    assert_eq!(watching.interrupt(), Some(0));
}

#[test]
fn a_file_put_in_the_place_of_the_old_one_is_seen() {
    let mut watching = Watching::start(&wrong());
    watching.until("seed");
    let new = watching.folder.path().join("ggsample06.vert.swp");
    fs::write(&new, right()).unwrap();
    fs::rename(&new, watching.path()).unwrap();
    watching.until("80 → 100");
    // As editors with backups do it: the old one moves away, then comes a new one.
    // Where a busy machine leaves the place empty for longer than an editor does, it is tried again.
    for (content, change) in [(wrong(), "100 → 80"), (right(), "80 → 100")].into_iter().cycle().take(20) {
        fs::rename(watching.path(), watching.folder.path().join("ggsample06.vert~")).unwrap();
        let start = Instant::now();
        std::thread::sleep(Duration::from_millis(50));
        fs::write(watching.path(), content).unwrap();
        let is_editor = start.elapsed() < Duration::from_millis(200);
        let seen = watching.until(change);
        if is_editor {
            assert!(!seen.contains("is gone"), "{seen}");
            return;
        }
    }
    panic!("this machine does nothing within 0.2 s");
}

#[test]
fn a_file_that_goes_away_is_waited_for() {
    let mut watching = Watching::start(&wrong());
    watching.until("seed");
    fs::remove_file(watching.path()).unwrap();
    watching.until("ggsample06.vert is gone");
    fs::write(watching.path(), right()).unwrap();
    watching.until("80 → 100");
}

#[test]
fn of_many_saves_in_a_moment_the_last_one_counts() {
    let mut watching = Watching::start(&wrong());
    watching.until("seed");
    for _ in 0..20 {
        fs::write(watching.path(), "").unwrap();
        fs::write(watching.path(), wrong()).unwrap();
    }
    fs::write(watching.path(), right()).unwrap();
    watching.until("→ 100 / 100");
    let rest = watching.rest();
    assert!(!rest.contains("────"), "no report comes after that of the last save: {rest}");
}

#[test]
fn other_files_and_looks_at_this_one_are_no_saves() {
    let mut watching = Watching::start(&wrong());
    watching.until("seed");
    watching.rest();
    fs::write(watching.folder.path().join("notes.txt"), "x").unwrap();
    fs::read(watching.path()).unwrap();
    assert_eq!(watching.rest(), "");
}

#[test]
fn a_shader_that_loops_for_ever_costs_one_report_only() {
    let mut watching = Watching::start(&sample("hostile/stopped/loops", "do-while-true"));
    watching.until("0 / 100");
    watching.until("ms");
    fs::write(watching.path(), right()).unwrap();
    watching.until("It runs now: 0 → 100 / 100");
    assert_eq!(watching.interrupt(), Some(0));
}

#[test]
fn a_file_that_is_not_there_ends_with_4() {
    let folder = tempfile::tempdir().unwrap();
    let output =
        Command::new(env!("CARGO_BIN_EXE_ggrade")).arg("watch").arg(folder.path().join("x.vert")).output().unwrap();
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8_lossy(&output.stderr).contains("x.vert"));
}
