//! Workers are killed, suspended and crashed at random moments while gradings run: every submission gets its one
//! report, and an honest one the report of a quiet day.

mod workers;

use ggrade::grade::Order;
use ggrade::hand_in::HandIn;
use ggrade::report::{Report, SourceInfo, Verdict};
use ggrade::sandbox::{GradingTask, Pool, Settings};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::collections::HashSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use workers::{children, descriptors, sample, settings};

const GRADINGS: usize = 200;
const CALLERS: usize = 4;

/// Seed of the disturbances; the moments that they hit differ from run to run all the same.
const SEED: u64 = 0x9e37_79b9_7f4a_7c15;

/// How many gradings end between two disturbances. By number and not by time, so that a slow machine is hit no more
/// often than a fast one.
const PACE: usize = 4;

/// A submission that is hit at each of its attempts gets a fault or, by two crashes, a wrong blame. A quarter of the
/// gradings sees a disturbance, and two in three of these hit the one of three workers that is at it or is waited for:
/// one attempt in six is hit, three in a row one time in 216, which is one of 200 gradings; two crashes (a third of the
/// disturbances) one time in 324. More than five would be another cause.
const UNLUCKY: usize = 5;

const FILES: [&str; 5] = [
    "accepted/answers/alpha-two.vert",
    "accepted/answers/all-in-one-expression.vert",
    "rejected/empty.vert",
    "rejected/brace-missing-at-end.vert",
    "accepted/answers/alpha-one-by-assignment.vert",
];

#[test]
fn every_submission_gets_its_one_report() {
    let before = descriptors();
    let files = FILES.map(sample);
    let quiet = {
        let pool = Pool::start(settings(), 1).unwrap();
        files.each_ref().map(|file| grade(&pool, "quiet", file).unwrap())
    };
    let pool = Pool::start(Settings { deadline: Duration::from_millis(1500), ..settings() }, 2).unwrap();
    let done = AtomicUsize::new(0);
    let (answers, disturbances) = std::thread::scope(|scope| {
        let chaos = scope.spawn(|| disturb(&pool, &done));
        let answers = grade_all(&pool, &files, &done);
        (answers, chaos.join().unwrap())
    });
    drop(pool);

    assert!(disturbances > 20, "{disturbances} disturbances show nothing");
    assert_eq!(answers.len(), GRADINGS, "one answer each");
    let numbers: HashSet<usize> = answers.iter().map(|&(number, _)| number).collect();
    assert_eq!(numbers.len(), GRADINGS, "none twice");
    let mut unlucky = Vec::new();
    for (number, answer) in answers {
        let expected = &quiet[number % FILES.len()];
        match answer {
            Ok(found) if found.verdict == Verdict::Stopped => unlucky.push(workers::words(&found)),
            Ok(found) => assert_eq!(found, *expected, "{}", FILES[number % FILES.len()]),
            Err(fault) => unlucky.push(fault),
        }
    }
    assert!(unlucky.len() <= UNLUCKY, "{disturbances} disturbances, {unlucky:?}");
    // A worker may be hit while it grades, while it is started, and while it reads the assignment.
    let named = ["crashed the renderer (SIGSEGV)", "from outside", "cannot be started", "cannot read the assignment"];
    assert!(unlucky.iter().all(|words| named.iter().any(|name| words.contains(name))), "{unlucky:?}");
    assert_eq!(children(), [], "no process is left, alive or dead");
    assert_eq!(descriptors(), before);
}

/// The answers with the numbers of their submissions, from several threads.
fn grade_all(pool: &Pool, files: &[Vec<u8>], done: &AtomicUsize) -> Vec<(usize, Result<Report, String>)> {
    let next = AtomicUsize::new(0);
    let caller = || {
        let mut answers = Vec::new();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= GRADINGS {
                return answers;
            }
            answers.push((number, grade(pool, &name(number), &files[number % files.len()])));
            done.fetch_add(1, Ordering::Relaxed);
        }
    };
    std::thread::scope(|scope| {
        let callers: Vec<_> = (0..CALLERS).map(|_| scope.spawn(caller)).collect();
        callers.into_iter().flat_map(|caller| caller.join().unwrap()).collect()
    })
}

fn grade(pool: &Pool, name: &str, bytes: &[u8]) -> Result<Report, String> {
    let hand_in = HandIn::of_one(name, bytes);
    let order = Order { seed: 7, ..Order::default() };
    let answer =
        pool.grade(GradingTask { assignment: pool.assignment(), hand_in: &hand_in, order, wants_frames: true });
    let mut report = answer.map(workers::timeless).map_err(|fault| fault.message.en)?;
    assert_eq!(report.source().name, name, "the report of another submission");
    let quiet = SourceInfo { name: "quiet".into(), ..report.source().clone() };
    report.of_files(vec![quiet]);
    Ok(report)
}

fn name(number: usize) -> String {
    format!("submission {number}")
}

/// Hits one worker after the other until the gradings are done; how many it hit.
fn disturb(pool: &Pool, done: &AtomicUsize) -> usize {
    let mut random = SEED;
    let mut ready = HashSet::new();
    let (mut hits, mut due) = (0, 0);
    loop {
        let seen = done.load(Ordering::Relaxed);
        if seen >= GRADINGS {
            return hits;
        }
        if seen < due {
            std::thread::sleep(Duration::from_millis(1));
            ready.extend(pool.idle_processes());
            continue;
        }
        due += PACE;
        std::thread::sleep(Duration::from_millis(next(&mut random) % 100));
        ready.extend(pool.idle_processes());
        let alive = children();
        let Some(&(process, _)) = alive.get(next(&mut random) as usize % alive.len().max(1)) else { continue };
        let signal = match next(&mut random) % 6 {
            0 | 1 => Signal::SIGSEGV,
            // A worker that is suspended while it starts holds up no grading but the test.
            2 if ready.contains(&process) => Signal::SIGSTOP,
            _ => Signal::SIGKILL,
        };
        hits += usize::from(kill(Pid::from_raw(process as i32), signal).is_ok());
    }
}

/// The next number of a sequence (xorshift64).
fn next(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}
