//! The processes of a browser: they end with the test, also with one that fails.

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::path::Path;
use std::process::Child;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for killed processes to be gone.
const PATIENCE: Duration = Duration::from_secs(10);
/// Pause between two looks at them.
const LOOK: Duration = Duration::from_millis(10);

/// A driver, and the browser that it starts with a profile of its own. The driver runs the browser apart from itself, so
/// that killing the driver leaves the browser running.
pub struct Processes {
    pub driver: Child,
    pub profile: TempDir,
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
