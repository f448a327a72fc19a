//! How workers begin, take turns, are replaced and leave nothing behind.

use super::workers::{
    self, Impostor, alone, children, children_of, descriptors, grade, honest, sample, settings, timeless,
};
use super::{signal, until};
use ggrade::grade::Order;
use ggrade::hand_in::HandIn;
use ggrade::report::Verdict;
use ggrade::sandbox::{GradingTask, Pool, Settings};
use std::process::Command;

#[test]
fn a_worker_grades_and_leaves_nothing() {
    let _alone = alone();
    let pool = Pool::start(settings(), 2).unwrap();
    assert_eq!(grade(&pool, &honest()).unwrap().report.verdict, Verdict::Correct);
    drop(pool);
    assert_eq!(children(), []);
}

#[test]
fn a_report_is_the_same_from_a_worker_that_has_graded_others() {
    let _alone = alone();
    let pool = Pool::start(Settings { spares: 0, ..settings() }, 1).unwrap();
    let first = timeless(grade(&pool, &honest()).unwrap());
    let process = pool.idle_processes();
    for (path, verdict) in [
        ("rejected/empty.vert", Verdict::Rejected),
        ("rejected/brace-missing-at-end.vert", Verdict::Rejected),
        ("hostile/stopped/memory/local-array-1000000.vert", Verdict::Stopped),
        ("hostile/stopped/loops/do-while-true.vert", Verdict::Stopped),
    ] {
        assert_eq!(grade(&pool, &sample(path)).unwrap().report.verdict, verdict, "{path}");
    }
    assert_eq!(timeless(grade(&pool, &honest()).unwrap()), first);
    assert_eq!(pool.idle_processes(), process);
}

#[test]
fn single_use_workers_meet_one_file_each() {
    let _alone = alone();
    let pool = Pool::start(Settings { spares: 0, ..settings() }.with_single_use_workers(), 1).unwrap();
    let mut processes = Vec::new();
    for _ in 0..3 {
        grade(&pool, &sample("rejected/empty.vert")).unwrap();
        // The next one is started when the last one is gone.
        let next = until(|| pool.idle_processes().first().copied());
        assert!(!processes.contains(&next));
        processes.push(next);
    }
}

#[test]
fn a_replacement_is_warm_before_it_is_needed() {
    let _alone = alone();
    let pool = Pool::start(settings(), 1).unwrap();
    until(|| (pool.idle_processes().len() == 2).then_some(()));
    let lost = pool.idle_processes()[0];
    signal(lost, "KILL");
    until(|| (!pool.idle_processes().is_empty() && grade(&pool, &honest()).is_ok()).then_some(()));
    until(|| (pool.idle_processes().len() == 2 && !pool.idle_processes().contains(&lost)).then_some(()));
}

#[test]
fn callers_beyond_the_number_of_workers_wait() {
    let _alone = alone();
    let pool = Pool::start(Settings { spares: 0, ..settings() }, 1).unwrap();
    let file = honest();
    let verdicts: Vec<_> = std::thread::scope(|scope| {
        let callers: Vec<_> = (0..6).map(|_| scope.spawn(|| grade(&pool, &file).unwrap().report.verdict)).collect();
        callers.into_iter().map(|caller| caller.join().unwrap()).collect()
    });
    assert_eq!(verdicts, [Verdict::Correct; 6]);
    assert_eq!(children().len(), 1, "one worker, not one a caller");
}

#[test]
fn chatter_on_standard_error_holds_nobody_up() {
    let _alone = alone();
    let chatty = Impostor::new("head -c 1000000 /dev/zero >&2; exec \"$real\" \"$@\"");
    let pool = Pool::start(chatty.settings(), 1).unwrap();
    assert_eq!(grade(&pool, &honest()).unwrap().report.verdict, Verdict::Correct);
}

#[test]
fn a_worker_that_cannot_start_is_a_fault_with_its_own_words() {
    let _alone = alone();
    let broken = Impostor::new("note; echo 'no such luck' >&2; exit 127");
    let fault = Pool::start(broken.settings(), 1).unwrap_err();
    assert!(fault.message.en.contains("no such luck"), "{fault}");
    assert_eq!(broken.notes(), 3, "a start is tried again");
    let missing = Settings { program: Some("/nonexistent/ggrade".into()), ..settings() };
    assert!(Pool::start(missing, 1).is_err());
    assert_eq!(children(), []);
}

#[test]
fn a_driver_that_is_not_there_is_a_fault_that_says_what_to_do() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let lost = folder.path().join("lvp_icd.lost.json");
    for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        let mut command = Command::new(workers::GGRADE);
        command.env_remove("VK_DRIVER_FILES").env_remove("VK_ICD_FILENAMES").env(name, &lost);
        command.args(["grade", "submissions/ggsample06/accepted/answers/alpha-two.vert", "--format", "json"]);
        let output = command.env("LC_ALL", "C").current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{told}");
        assert!(output.stdout.is_empty(), "a fault is no report");
        assert!(told.contains("lvp_icd.lost.json") && told.contains("unset it"), "{told}");
    }
}

#[test]
fn workers_die_with_their_parent() {
    let _alone = alone();
    let mut corpus = Command::new(workers::GGRADE)
        .args(["corpus", "submissions/ggsample06/accepted"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let orphans = until(|| Some(children_of(corpus.id())).filter(|workers| workers.len() >= 2));
    // SIGKILL: the parent has no say in what becomes of them.
    corpus.kill().unwrap();
    corpus.wait().unwrap();
    let is_gone = |worker: u32| !std::path::Path::new(&format!("/proc/{worker}")).exists();
    until(|| orphans.iter().all(|&(worker, _)| is_gone(worker)).then_some(()));
}

#[test]
fn neither_processes_nor_descriptors_are_left_behind() {
    let _alone = alone();
    let settings = Settings { gradings_per_worker: 30, ..settings() };
    let pool = Pool::start(settings, 2).unwrap();
    let file = sample("rejected/empty.vert");
    until(|| (pool.idle_processes().len() == 3).then_some(()));
    let before = descriptors();
    for _ in 0..300 {
        grade(&pool, &file).unwrap();
    }
    until(|| (pool.idle_processes().len() == 3).then_some(()));
    assert_eq!(descriptors(), before);
    assert!(children().iter().all(|&(_, state)| state != 'Z'), "{:?}", children());
    drop(pool);
    assert_eq!(children(), []);
}

#[test]
fn a_file_that_takes_long_gives_its_place_to_another() {
    let _alone = alone();
    let pool = &Pool::start(settings(), 1).unwrap();
    pool.warm().unwrap();
    let (tell, told) = std::sync::mpsc::channel();
    std::thread::scope(|scope| {
        let long = scope.spawn(move || {
            let hand_in =
                HandIn::of_one("ggsample06.vert", sample("hostile/stopped/fuzz/arrays-without-end-compared.vert"));
            let order = Order { seed: 7, ..Order::default() };
            let task = GradingTask { assignment: pool.assignment(), hand_in: &hand_in, order, wants_frames: false };
            pool.grade_or_let_pass(task, &mut || tell.send(()).unwrap())
        });
        told.recv().expect("it lets another pass");
        // There is one place, and the spare worker grades in it.
        assert_eq!(grade(pool, &honest()).unwrap().report.verdict, Verdict::Correct);
        assert_eq!(long.join().unwrap().unwrap().report.verdict, Verdict::Stopped);
    });
    // The place is there once, and the spare again.
    assert_eq!(grade(pool, &honest()).unwrap().report.verdict, Verdict::Correct);
    until(|| (pool.idle_processes().len() == 2).then_some(()));
}
