//! Workers that read several assignments, and the right pictures that they share.

use super::workers::{alone, children, ggsample06, honest, settings};
use ggrade::expected::{self, Pack, Packer, cache};
use ggrade::grade::Order;
use ggrade::hand_in::HandIn;
use ggrade::report::{Report, Verdict};
use ggrade::sandbox::{GradingTask, Pool, Settings};
use reference::{Assignment, Folder};
use std::sync::Arc;
use std::time::Duration;

/// The homework with a text of its description replaced.
fn changed(from: &str, to: &str) -> Arc<Assignment> {
    let mut folder = Folder::clone(&ggsample06().folder);
    let manifest = folder.text("assignment.toml").unwrap();
    assert!(manifest.contains(from), "{from}");
    let manifest = manifest.replacen(from, to, 1);
    folder.files.insert("assignment.toml".into(), manifest.into());
    Arc::new(Assignment::load(folder).unwrap())
}

fn grade(pool: &Pool, assignment: &Arc<Assignment>) -> Report {
    let hand_in = &HandIn::of_one("ggsample06.vert", honest());
    let order = Order { seed: 7, ..Order::default() };
    pool.grade(GradingTask { assignment, hand_in, order, wants_frames: false }).unwrap().report
}

#[test]
fn one_worker_grades_for_several_assignments() {
    let _alone = alone();
    let pool = Pool::start(Settings { spares: 0, ..settings() }, 1).unwrap();
    let stretched = changed("points = 10", "points = 60");
    for _ in 0..2 {
        let (one, other) = (grade(&pool, ggsample06()), grade(&pool, &stretched));
        assert_eq!(
            (one.verdict, one.max_score, other.verdict, other.max_score),
            (Verdict::Correct, 100.0, Verdict::Correct, 150.0)
        );
        assert_eq!((&one.assignment, &other.assignment), (&ggsample06().id, &ggsample06().id));
        assert_eq!(one.assignment_digest, ggsample06().digest);
        assert_eq!(other.assignment_digest, stretched.digest);
        assert_ne!(one.assignment_digest, other.assignment_digest);
    }
    assert_eq!(children().len(), 1, "one worker for both");
}

/// A figure of a process in bytes: the line of `/proc/PID/FILE` that begins so, its first number times `unit`.
fn figure(process: u32, file: &str, line: &str, unit: u64) -> u64 {
    let text = std::fs::read_to_string(format!("/proc/{process}/{file}")).unwrap();
    let rest = text.lines().find_map(|found| found.strip_prefix(line)).unwrap_or_else(|| panic!("{line}: {text}"));
    rest.split_whitespace().find_map(|word| word.parse::<u64>().ok()).unwrap_or_else(|| panic!("{rest}")) * unit
}

#[test]
fn a_worker_with_several_assignments_gives_a_file_no_more_memory() {
    let _alone = alone();
    let further = vec![changed("points = 10", "points = 60"), changed("points = 10", "points = 20")];
    let pool = Pool::start(Settings { spares: 0, further: further.clone(), ..settings() }, 1).unwrap();
    pool.warm().unwrap();
    let [worker] = pool.idle_processes()[..] else { panic!("one worker") };
    for (assignment, points) in [(ggsample06(), 100.0), (&further[0], 150.0), (&further[1], 110.0)] {
        let size = figure(worker, "status", "VmSize:", 1024);
        assert_eq!(grade(&pool, assignment).max_score, points);
        let limit = figure(worker, "limits", "Max address space", 1);
        // Up to a page table's worth of rounding, what it had before the file and what the file may take.
        assert!((size..=size + (768 << 20) + (1 << 20)).contains(&limit), "{limit} of {size}");
    }
    assert_eq!(pool.idle_processes(), [worker], "the same worker graded for all");
}

#[test]
fn an_assignment_that_workers_cannot_read_costs_the_others_nothing() {
    let _alone = alone();
    let (mut broken, whole) = (Assignment::clone(ggsample06()), changed("points = 10", "points = 60"));
    let mut folder = Folder::clone(&broken.folder);
    folder.files.remove("solution.vert");
    broken.digest = folder.digest();
    broken.folder = Arc::new(folder);
    let broken = Arc::new(broken);
    let further = vec![Arc::clone(&broken), Arc::clone(&whole)];
    let pool = Pool::start(Settings { spares: 0, further, ..settings() }, 1).unwrap();
    for _ in 0..2 {
        assert_eq!((grade(&pool, ggsample06()).max_score, grade(&pool, &whole).max_score), (100.0, 150.0));
        let hand_in = &HandIn::of_one("ggsample06.vert", honest());
        let submission = GradingTask { assignment: &broken, hand_in, order: Order::default(), wants_frames: false };
        let fault = pool.grade(submission).unwrap_err();
        assert!(fault.message.en.contains("solution.vert"), "{}", fault.message.en);
    }
}

fn packed(assignment: &Assignment) -> Pack {
    let mut packer = Packer::default();
    expected::frames(assignment).for_each(|frame| packer.add(&frame).unwrap());
    packer.finish().unwrap()
}

#[test]
fn right_pictures_are_computed_once_and_kept() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let keeping =
        || Settings { cache: Some(folder.path().into()), keep_above: Duration::ZERO, spares: 2, ..settings() };
    let files = || std::fs::read_dir(folder.path()).unwrap().count();
    let pool = Pool::start(keeping(), 1).unwrap();
    assert_eq!(grade(&pool, ggsample06()).verdict, Verdict::Correct);
    drop(pool);
    assert_eq!(files(), 1);
    assert_eq!(cache::read(folder.path(), ggsample06()), Some(packed(ggsample06())));

    // What is kept is what later workers compare with: here the pictures of a larger field of view.
    let other = changed("fovy = 0.5", "fovy = 0.6");
    cache::write(folder.path(), ggsample06(), &packed(&other)).unwrap();
    let frames = grade(&Pool::start(keeping(), 1).unwrap(), ggsample06()).frames;
    assert!(frames.iter().any(|frame| !frame.agrees()), "the pictures were computed again");

    // What is damaged is computed again, and kept again.
    let path = std::fs::read_dir(folder.path()).unwrap().next().unwrap().unwrap().path();
    std::fs::write(&path, b"ggrade-frames/1 what a pity\n").unwrap();
    assert_eq!(grade(&Pool::start(keeping(), 1).unwrap(), ggsample06()).verdict, Verdict::Correct);
    assert_eq!(cache::read(folder.path(), ggsample06()), Some(packed(ggsample06())));

    // A folder that cannot be written costs the grading nothing.
    let lost = Settings { cache: Some("/proc/nowhere".into()), ..keeping() };
    assert_eq!(grade(&Pool::start(lost, 1).unwrap(), ggsample06()).verdict, Verdict::Correct);
}
