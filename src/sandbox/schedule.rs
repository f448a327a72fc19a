//! What the kernel says a process has been doing: whether it was at work, kept waiting, or stopped from outside.

use super::ending::Ending;
use std::path::Path;
use std::time::{Duration, Instant};

/// Length of a tick of the kernel's accounting; the same on every Linux that user space sees.
const TICK: Duration = Duration::from_millis(10);

/// The share of the deadline that a worker must have computed for the time to count as its own. An honest file seldom needs
/// as much; a loop without an end gets as much unless seven others want the same processor.
const LEAST_SHARE: f64 = 0.75;

/// CPU time of all threads of the process so far.
fn cpu_time(process: u32) -> Option<Duration> {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    let mut fields = after_name(&stat)?.split_ascii_whitespace();
    // `man 5 proc`: utime and stime are fields 14 and 15, the state after the name is field 3.
    let user: u32 = fields.nth(11)?.parse().ok()?;
    let system: u32 = fields.next()?.parse().ok()?;
    Some(TICK * (user + system))
}

/// The share of the deadline after which a file takes long: several times what an honest one needs.
const LONG_SHARE: f64 = 1.0 / 16.0;

/// The time that a worker on a busy machine is waited for, in deadlines.
const PATIENCE: u32 = 3;

/// At least so long a worker is waited for once more.
const PAUSE: Duration = Duration::from_millis(20);

/// The time that a process has for one thing.
#[derive(Debug)]
pub(super) struct Allowance {
    process: u32,
    /// Its CPU time at the beginning.
    before: Option<Duration>,
    begin: Instant,
    deadline: Duration,
}

impl Allowance {
    /// Begins now.
    pub fn new(process: u32, deadline: Duration) -> Self {
        Self { process, before: cpu_time(process), begin: Instant::now(), deadline }
    }

    /// When it ends on an idle machine.
    pub fn end(&self) -> Instant {
        self.begin + self.deadline
    }

    /// When to look whether it takes long: as soon as it can have had a processor for [`LONG_SHARE`] of the deadline. The end where
    /// it has.
    pub fn next_look(&self) -> Instant {
        let left = self.deadline.mul_f64(LONG_SHARE).saturating_sub(self.used().unwrap_or(self.deadline));
        if left.is_zero() { self.end() } else { (Instant::now() + left.max(PAUSE)).min(self.end()) }
    }

    /// Until when to wait for a worker that has not answered by the end: until it has had as much of a processor. That others keep
    /// the machine busy is not the file's doing. `None` where it has had that, or does not want it.
    pub fn later(&self) -> Option<Instant> {
        let states = thread_states(self.process);
        let wants_processor = states.iter().any(|state| matches!(state, 'R' | 'D'));
        if !wants_processor || self.begin.elapsed() >= self.deadline * PATIENCE {
            return None;
        }
        let left = self.deadline.checked_sub(self.used()?).filter(|left| !left.is_zero())?;
        Some(Instant::now() + left.max(PAUSE))
    }

    /// What a worker that has not answered has been doing.
    pub fn of_late(&self) -> Ending {
        let states = thread_states(self.process);
        if states.iter().any(|state| matches!(state, 'T' | 't')) {
            return Ending::Suspended;
        }
        let wants_processor = states.iter().any(|state| matches!(state, 'R' | 'D'));
        match self.used() {
            // A worker that sleeps of its own accord has hung itself up: that is the file's doing.
            Some(used) if wants_processor && used < self.deadline.mul_f64(LEAST_SHARE) => Ending::Starved,
            _ => Ending::Deadline,
        }
    }

    fn used(&self) -> Option<Duration> {
        Some(cpu_time(self.process)?.saturating_sub(self.before?))
    }
}

/// The states of its threads: R for running or runnable, S for sleeping, D for waiting on a disk, T for stopped.
fn thread_states(process: u32) -> Vec<char> {
    let Ok(threads) = std::fs::read_dir(format!("/proc/{process}/task")) else { return Vec::new() };
    threads.flatten().filter_map(|thread| state(&thread.path().join("stat"))).collect()
}

fn state(stat: &Path) -> Option<char> {
    let stat = std::fs::read_to_string(stat).ok()?;
    after_name(&stat)?.trim_start().chars().next()
}

/// The name stands in parentheses and may hold any character, parentheses too.
fn after_name(stat: &str) -> Option<&str> {
    stat.rsplit_once(')').map(|(_, rest)| rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cpu_time_grows_with_work() {
        let before = cpu_time(std::process::id()).unwrap();
        let start = Instant::now();
        let mut sum = 0_u64;
        while cpu_time(std::process::id()).unwrap() < before + TICK * 3 {
            assert!(start.elapsed() < Duration::from_secs(20), "{sum}");
            sum = (0..100_000).fold(sum, |sum, n| sum ^ n);
        }
    }

    #[test]
    fn a_sleeping_process_is_late_by_itself() {
        let mut sleeper = std::process::Command::new("sleep").arg("60").spawn().unwrap();
        // Until it has started, it wants a processor.
        while thread_states(sleeper.id()) != ['S'] {
            std::thread::sleep(Duration::from_millis(1));
        }
        let late = Allowance::new(sleeper.id(), Duration::from_secs(2)).of_late();
        sleeper.kill().unwrap();
        sleeper.wait().unwrap();
        assert_eq!(late, Ending::Deadline);
    }

    #[test]
    fn a_worker_is_waited_for_until_it_has_had_the_time() {
        // This process is at work: its own thread runs.
        let (id, now, second) = (std::process::id(), Instant::now(), Duration::from_secs(1));
        let used = cpu_time(id).unwrap();
        let of = |before, begin, deadline| Allowance { process: id, before: Some(before), begin, deadline };
        assert!(of(used, now, second * 1000).later().is_some(), "it has had none of it");
        assert_eq!(of(Duration::ZERO, now, used.min(TICK / 2)).later(), None, "it has had all of it");
        let long_ago = now.checked_sub(second * 10).unwrap();
        assert_eq!(of(used, long_ago, second).later(), None, "nobody waits for ever");
    }

    #[test]
    fn a_name_with_parentheses_is_skipped() {
        assert_eq!(after_name("7 (a) b) S 1").map(str::trim), Some("S 1"));
    }
}
