//! What the tests of the worker processes share: settings, samples, impostors, and a look at the process table.

// Each test program uses a part of it.
#![allow(dead_code)]

use ggrade::grade::Order;
use ggrade::hand_in::HandIn;
use ggrade::report::Report;
use ggrade::sandbox::{GradedSubmission, GradingTask, Pool, Settings};
use reference::Assignment;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The program under test.
pub const GGRADE: &str = env!("CARGO_BIN_EXE_ggrade");

/// Longer than the usual deadline, for gradings that are not about it: the machine may be busy with other tests.
pub const PATIENT: Duration = Duration::from_secs(10);

/// One test at a time: they count this process's children and descriptors, and measure time.
pub fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Settings whose workers are the program under test.
pub fn settings() -> Settings {
    Settings { program: Some(GGRADE.into()), deadline: PATIENT, ..Settings::new(ggsample06().clone()) }
}

/// The homework.
pub fn ggsample06() -> &'static Arc<Assignment> {
    reference::assignment("ggsample06").unwrap()
}

/// The bytes of a sample.
pub fn sample(path: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(path);
    fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A right answer.
pub fn honest() -> Vec<u8> {
    sample("accepted/answers/alpha-two.vert")
}

/// Grades bytes with a fixed seed and without frames.
pub fn grade(pool: &Pool, bytes: &[u8]) -> Result<GradedSubmission, ggrade::fault::Fault> {
    pool.grade(GradingTask {
        assignment: pool.assignment(),
        hand_in: &HandIn::of_one("ggsample06.vert", bytes),
        order: Order { seed: 7, ..Order::default() },
        wants_frames: false,
    })
}

/// The report without its timing.
pub fn timeless(answer: GradedSubmission) -> Report {
    Report { elapsed_ms: 0.0, ..answer.report }
}

/// What the diagnostics of a report say.
pub fn words(report: &Report) -> String {
    report.diagnostics.iter().map(|diagnostic| diagnostic.message.en.as_str()).collect::<Vec<_>>().join("\n")
}

/// A shell command that writes a message of the workers' protocol: both lengths, and a head without a body.
pub fn say(head: &str) -> String {
    assert!(head.len() < 0o77777 && !head.contains('\''));
    let [low, high, ..] = head.len().to_le_bytes();
    format!(r"printf '\{low:03o}\{high:03o}\000\000\000\000\000\000'; printf '%s' '{head}'")
}

/// A program in a worker's place, in sh.
pub struct Impostor {
    folder: tempfile::TempDir,
}

impl Impostor {
    /// `script` may use `$real` (the program under test), `$folder` (a place for notes), `hello "$@"` (says hello and reads
    /// the assignment as a worker does) and `note` (writes a line for [`Self::notes`]).
    pub fn new(script: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let lines = format!(
            "#!/bin/sh\nreal='{GGRADE}'\nfolder='{}'\nhello() {{ \"$real\" \"$@\" --rehearse; }}\n\
             note() {{ echo >>\"$folder\"/notes; }}\n{script}\n",
            folder.path().display()
        );
        let impostor = Self { folder };
        fs::write(impostor.program(), lines).unwrap();
        fs::set_permissions(impostor.program(), fs::Permissions::from_mode(0o755)).unwrap();
        impostor
    }

    fn program(&self) -> PathBuf {
        self.folder.path().join("impostor")
    }

    /// How often the script called `note`.
    pub fn notes(&self) -> usize {
        fs::read_to_string(self.folder.path().join("notes")).unwrap_or_default().lines().count()
    }

    /// Settings whose workers it is.
    pub fn settings(&self) -> Settings {
        Settings { program: Some(self.program()), spares: 0, warm_up: false, ..settings() }
    }
}

/// This process's children: number and state, `Z` for one that is dead and not reaped.
pub fn children() -> Vec<(u32, char)> {
    children_of(std::process::id())
}

/// The children of a process.
pub fn children_of(process: u32) -> Vec<(u32, char)> {
    let processes = fs::read_dir("/proc").unwrap().flatten();
    processes
        .filter_map(|entry| {
            let id: u32 = entry.file_name().to_str()?.parse().ok()?;
            let stat = fs::read_to_string(entry.path().join("stat")).ok()?;
            // `man 5 proc`: the name in parentheses, the state, the parent.
            let mut fields = stat.rsplit_once(')')?.1.split_ascii_whitespace();
            let state = fields.next()?.chars().next()?;
            let parent: u32 = fields.next()?.parse().ok()?;
            (parent == process).then_some((id, state))
        })
        .collect()
}

/// Whether any process on this machine has this command line.
pub fn is_running(line: &str) -> bool {
    let line = format!("{}\0", line.replace(' ', "\0"));
    let processes = fs::read_dir("/proc").unwrap().flatten();
    processes.filter_map(|process| fs::read(process.path().join("cmdline")).ok()).any(|found| found == line.as_bytes())
}

/// How many descriptors this process has open.
pub fn descriptors() -> usize {
    fs::read_dir("/proc/self/fd").unwrap().count()
}
