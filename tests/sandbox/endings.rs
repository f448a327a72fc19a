//! How a grading ends that has no answer, and whose doing that is.

use super::workers::{Impostor, alone, children, grade, honest, is_running, say, words};
use ggrade::report::Verdict;
use ggrade::sandbox::{Pool, Settings};
use reference::Assignment;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Half of what the impostors would keep the grading waiting: what is answered before was not waited for. A busy machine
/// may add to a deadline what it likes.
const LONG: Duration = Duration::from_secs(30);

#[test]
fn the_deadline_ends_a_worker_that_says_nothing() {
    let _alone = alone();
    let silent = Impostor::new("hello \"$@\"; head -c 1 >/dev/null; sleep 6007 & sleep 60");
    let deadline = Duration::from_secs(1);
    let pool = Pool::start(Settings { deadline, ..silent.settings() }, 1).unwrap();
    let start = Instant::now();
    let report = grade(&pool, &honest()).unwrap().report;
    assert!((deadline..LONG).contains(&start.elapsed()), "{:?}", start.elapsed());
    assert!(report.elapsed_ms >= 1000.0);
    assert_eq!(report.verdict, Verdict::Stopped);
    assert!(words(&report).contains("within 1 s (time limit)"), "{}", words(&report));
    drop(pool);
    assert_eq!(children(), []);
    assert!(!is_running("sleep 6007"), "the whole group ends, not the worker alone");
}

#[test]
fn a_homework_may_give_more_time() {
    let _alone = alone();
    let silent = Impostor::new("hello \"$@\"; head -c 1 >/dev/null; sleep 60");
    let settings = silent.settings();
    let mut assignment = Assignment::clone(&settings.assignment);
    assignment.time = 3;
    let settings = Settings { deadline: Duration::from_millis(500), assignment: Arc::new(assignment), ..settings };
    let pool = Pool::start(settings, 1).unwrap();
    let report = grade(&pool, &honest()).unwrap().report;
    assert!(report.elapsed_ms >= 1500.0, "{}", report.elapsed_ms);
    assert!(words(&report).contains("within 1.5 s (time limit)"), "{}", words(&report));
}

#[test]
fn the_deadline_holds_while_the_file_is_sent() {
    let _alone = alone();
    let deaf = Impostor::new("hello \"$@\"; sleep 60");
    let deadline = Duration::from_secs(1);
    let pool = Pool::start(Settings { deadline, ..deaf.settings() }, 1).unwrap();
    let start = Instant::now();
    // Far more than the 64 KiB that a pipe holds.
    let report = grade(&pool, &vec![b' '; 1 << 20]).unwrap().report;
    assert!((deadline..LONG).contains(&start.elapsed()), "{:?}", start.elapsed());
    assert_eq!(report.verdict, Verdict::Stopped);
}

#[test]
fn limits_are_named() {
    let _alone = alone();
    // What Rust and C++ say where an allocation fails, what Rust says of an overflowed stack, and the kernel's signals.
    let endings = [
        ("echo 'memory allocation of 64 bytes failed' >&2; kill -ABRT $$", "768 MiB of memory (memory limit)"),
        ("echo \"what():  std::bad_alloc\" >&2; kill -ABRT $$", "768 MiB of memory (memory limit)"),
        ("echo \"thread 'grader' has overflowed its stack\" >&2; kill -ABRT $$", "(stack limit)"),
        ("kill -XCPU $$", "(CPU time limit)"),
        ("kill -SYS $$", "forbidden system call (SIGSYS)"),
    ];
    for (ending, name) in endings {
        let ended = Impostor::new(&format!("hello \"$@\"; head -c 1 >/dev/null; {ending}"));
        let pool = Pool::start(ended.settings(), 1).unwrap();
        let report = grade(&pool, &honest()).unwrap().report;
        assert_eq!(report.verdict, Verdict::Stopped, "{ending}");
        assert!(words(&report).contains(name), "{ending}: {}", words(&report));
    }
}

#[test]
fn a_crash_is_the_files_when_it_happens_twice() {
    let _alone = alone();
    let crashing = Impostor::new("hello \"$@\"; head -c 1 >/dev/null; note; kill -SEGV $$");
    let pool = Pool::start(crashing.settings(), 1).unwrap();
    let report = grade(&pool, &honest()).unwrap().report;
    assert_eq!(report.verdict, Verdict::Stopped);
    assert!(words(&report).contains("SIGSEGV"), "{}", words(&report));
    assert_eq!(crashing.notes(), 2);
}

#[test]
fn once_the_file_has_run_no_ending_is_its_own() {
    let _alone = alone();
    let drawn = say(r#"{"id":1,"spent":false,"outcome":"Drawn"}"#);
    // What takes long takes as long in another worker. A crash may come of an earlier file.
    for (ending, attempts) in [("sleep 2; kill -XCPU $$", 1), ("kill -SEGV $$", 3)] {
        let judging = Impostor::new(&format!("hello \"$@\"; head -c 1 >/dev/null; {drawn}; note; {ending}"));
        let settings = Settings { deadline: Duration::from_secs(1), ..judging.settings() };
        let fault = grade(&Pool::start(settings, 1).unwrap(), &honest()).unwrap_err();
        assert!(fault.message.en.contains("the shader ran"), "{ending}: {fault}");
        assert_eq!(judging.notes(), attempts, "{ending}");
    }
}

#[test]
fn one_crash_alone_costs_the_file_nothing() {
    let _alone = alone();
    for signal in ["SEGV", "KILL", "STOP"] {
        let once = Impostor::new(&format!(
            "if mkdir \"$folder\"/first 2>/dev/null; then hello \"$@\"; head -c 1 >/dev/null; kill -{signal} $$; sleep 60\n\
             else exec \"$real\" \"$@\"; fi"
        ));
        let settings = Settings { deadline: Duration::from_secs(3), ..once.settings() };
        let pool = Pool::start(settings, 1).unwrap();
        assert_eq!(grade(&pool, &honest()).unwrap().report.verdict, Verdict::Correct, "{signal}");
    }
    assert_eq!(children(), []);
}

#[test]
fn what_others_do_to_a_worker_is_a_fault_at_last() {
    let _alone = alone();
    let killed = Impostor::new("hello \"$@\"; head -c 1 >/dev/null; note; kill -KILL $$");
    let pool = Pool::start(killed.settings(), 1).unwrap();
    let fault = grade(&pool, &honest()).unwrap_err();
    assert!(fault.message.en.contains("SIGKILL"), "{fault}");
    assert_eq!(killed.notes(), 3);
}

#[test]
fn our_own_exit_is_no_crash() {
    let _alone = alone();
    for code in [0, 3, 101] {
        let leaving = Impostor::new(&format!("hello \"$@\"; head -c 1 >/dev/null; exit {code}"));
        let pool = Pool::start(leaving.settings(), 1).unwrap();
        assert!(grade(&pool, &honest()).is_err(), "exit {code}");
    }
}

#[test]
fn nonsense_is_never_taken_for_a_report() {
    let _alone = alone();
    let stranger = r#"{"id":0,"spent":false,"outcome":{"Failed":{"message":{"en":"x","ja":"x"},"remedy":null}}}"#;
    let answers = [
        ("garbage", "echo garbage garbage garbage".to_owned()),
        ("oversized", r"printf '\377\377\377\377\377\377\377\377'; cat /dev/zero".into()),
        ("truncated", r#"printf '\020\000\000\000\000\000\000\000{"id"'"#.into()),
        ("endless", "cat /dev/zero".into()),
        ("of another file", format!("{}; sleep 60", say(stranger))),
    ];
    for (kind, answer) in answers {
        let liar = Impostor::new(&format!("hello \"$@\"; head -c 1 >/dev/null; {answer}"));
        let pool = Pool::start(liar.settings(), 1).unwrap();
        // At the deadline it would be a report that says so.
        let answer = grade(&pool, &honest());
        assert!(answer.is_err(), "{kind}: {answer:?}");
    }
    assert_eq!(children(), []);
}
