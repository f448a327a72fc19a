//! Honest files beside hostile ones: each report is the one of a quiet day.

use super::files;
use super::settings;
use super::workers::sample;
use ggrade::grade::Order;
use ggrade::hand_in::HandIn;
use ggrade::report::{Picture, Report, Verdict};
use ggrade::sandbox::{GradedSubmission, GradingTask, Pool, Settings};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Right, wrong and refused files; what they have in common is that they mean no harm.
const HONEST: [&str; 7] = [
    "accepted/answers/alpha-two.vert",
    "accepted/answers/all-in-one-expression.vert",
    "wrong/specular-half-unnormalized--average.vert",
    "wrong/specular-phong--reflect.vert",
    "wrong/normal-not-transformed--in-both-dots.vert",
    "rejected/brace-missing-at-end.vert",
    "rejected/empty.vert",
];

/// A part of these names is in those of hostile files that end or tire a worker, or try to leave something behind.
const WORST: [&str; 12] = [
    "loops--endless-for-one-vertex",
    "loops--vertices-part-ways",
    "loops--nested-300",
    "compile-bombs--doubles",
    "memory--local-array-1024",
    "out-of-bounds--",
    "uninitialised--",
    "positions--all-nan",
    "stages--storage-buffer",
    "nesting--parentheses-300",
    "preprocessor--macros-double-60",
    "encodings--utf-16",
];

const CALLERS: usize = 4;

#[test]
fn honest_reports_are_those_of_a_quiet_day() {
    let honest: Vec<(&str, Vec<u8>)> = HONEST.iter().map(|path| (*path, sample(path))).collect();
    let quiet: Vec<String> = {
        let pool = Pool::start(settings().with_single_use_workers(), 1).unwrap();
        honest.iter().map(|(path, bytes)| lasting(hand_in(&pool, path, bytes))).collect()
    };
    let hostile: Vec<_> =
        files::samples().into_iter().filter(|file| WORST.iter().any(|part| file.name.contains(part))).collect();
    assert!(hostile.len() > 50, "only {} hostile files", hostile.len());

    // Fewer workers than callers, and workers that are used up in the middle.
    let pool = Pool::start(Settings { gradings_per_worker: 23, ..settings() }, 2).unwrap();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut compared = 0;
        loop {
            let turn = next.fetch_add(1, Ordering::Relaxed);
            let Some(file) = hostile.get(turn / 2) else { return compared };
            if turn.is_multiple_of(2) {
                let answer = hand_in(&pool, &file.name, &file.bytes).report;
                assert_eq!(answer.verdict, file.promise.verdict, "{}", file.name);
            } else {
                let (path, bytes) = &honest[turn / 2 % honest.len()];
                let noisy = lasting(hand_in(&pool, path, bytes));
                assert!(noisy == quiet[turn / 2 % honest.len()], "{path} beside {}", file.name);
                compared += 1;
            }
        }
    };
    let compared: usize = std::thread::scope(|scope| {
        let callers: Vec<_> = (0..CALLERS).map(|_| scope.spawn(work)).collect();
        callers.into_iter().map(|caller| caller.join().unwrap()).sum()
    });
    assert_eq!(compared, hostile.len());
}

#[test]
fn reports_that_differ_are_told_apart() {
    let pool = Pool::start(settings(), 1).unwrap();
    let right = hand_in(&pool, "a.vert", &sample(HONEST[0]));
    let wrong = hand_in(&pool, "a.vert", &sample(HONEST[2]));
    assert_eq!(right.report.verdict, Verdict::Correct);
    let mut repainted = right.clone();
    Arc::make_mut(&mut repainted.frames)[0].rgba[0] ^= 1;
    assert!(lasting(right.clone()) != lasting(repainted), "one bit of one pixel shows");
    assert!(lasting(right) != lasting(wrong));
}

pub fn hand_in(pool: &Pool, name: &str, bytes: &[u8]) -> GradedSubmission {
    let order = Order { seed: 7, ..Order::default() };
    let hand_in = HandIn::of_one(name, bytes);
    let submission = GradingTask { assignment: pool.assignment(), hand_in: &hand_in, order, wants_frames: true };
    pool.grade(submission).unwrap_or_else(|fault| panic!("{name}: {fault}"))
}

/// All that a report and its pictures say, but for the time that it took.
pub fn lasting(answer: GradedSubmission) -> String {
    use sha2::{Digest, Sha256};
    let report = Report { elapsed_ms: 0.0, ..answer.report };
    let add = |hash: Sha256, picture: &Picture| hash.chain_update(picture.pixels().as_flattened());
    let pictures = answer.frames.iter().fold(Sha256::new(), add);
    format!("{} {:?} {report:?}", answer.frames.len(), pictures.finalize())
}
