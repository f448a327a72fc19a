//! Worker processes: their limits, their ends, and that nothing of them is left.

mod assignments;
mod endings;
mod life;
mod walls;
#[path = "../workers/mod.rs"]
mod workers;

use std::process::Command;
use std::time::{Duration, Instant};

/// Waits for something that takes a moment, and fails where it takes far too long.
fn until<T>(mut ready: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = ready() {
            return found;
        }
        assert!(start.elapsed() < Duration::from_secs(20), "waited in vain");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn signal(process: u32, name: &str) {
    let status = Command::new("kill").args([&format!("-{name}"), &process.to_string()]).status().unwrap();
    assert!(status.success());
}
