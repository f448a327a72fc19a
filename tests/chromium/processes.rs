//! The processes of a browser: they end with the test, also with one that fails.

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for killed processes to be gone.
const PATIENCE: Duration = Duration::from_secs(10);
/// Pause between two looks at them.
const LOOK: Duration = Duration::from_millis(10);

/// So many drivers are started until one has its port.
const ATTEMPTS: usize = 5;

/// A driver, and the browser that it starts with a profile of its own. The driver runs the browser apart from itself, so
/// that killing the driver leaves the browser running.
pub struct Processes {
    pub driver: Child,
    pub profile: TempDir,
}

impl Processes {
    /// Starts a driver on a free port, for a browser with an empty profile.
    pub fn start() -> (Self, u16) {
        // A driver takes a free port in IPv4, and ends where another has the same number in IPv6 by then.
        (0..ATTEMPTS).find_map(|_| Self::try_to_start()).expect("chromedriver's port")
    }

    fn try_to_start() -> Option<(Self, u16)> {
        let driver = Command::new("chromedriver")
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("chromedriver: run script/bootstrap --test");
        let mut processes = Self { driver, profile: tempfile::tempdir().expect("a folder") };
        let output = BufReader::new(processes.driver.stdout.take().expect("standard output"));
        let port = output
            .lines()
            .map_while(Result::ok)
            .find_map(|line| line.rsplit_once("successfully on port ")?.1.trim_end_matches('.').parse::<u16>().ok())?;
        Some((processes, port))
    }
}

impl Drop for Processes {
    fn drop(&mut self) {
        let _ = self.driver.kill();
        let _ = self.driver.wait();
        let start = Instant::now();
        loop {
            let left = of_profile(self.profile.path());
            for &process in &left {
                let _ = kill(process, Signal::SIGKILL);
            }
            if left.is_empty() || start.elapsed() > PATIENCE {
                return;
            }
            std::thread::sleep(LOOK);
        }
    }
}

/// The processes that were started for a profile: its folder is in their command lines. One that has ended has none.
pub fn of_profile(profile: &Path) -> Vec<Pid> {
    let mark = profile.to_string_lossy().into_owned();
    let all = std::fs::read_dir("/proc").expect("/proc").filter_map(Result::ok);
    let process = |entry: std::fs::DirEntry| {
        let number = entry.file_name().to_str()?.parse().ok()?;
        let command = std::fs::read(entry.path().join("cmdline")).ok()?;
        String::from_utf8_lossy(&command).contains(&mark).then(|| Pid::from_raw(number))
    };
    all.filter_map(process).collect()
}
