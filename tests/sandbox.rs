//! Worker processes: their limits, their ends, and that nothing of them is left.

mod workers;

use ggrade::report::Verdict;
use ggrade::sandbox::{Layer, Policy, Pool, Settings};
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Output};
use std::time::{Duration, Instant};
use workers::{
    Impostor, alone, children, children_of, descriptors, grade, honest, is_running, sample, say, settings, timeless,
    words,
};

/// What a busy machine may add to a deadline: the promise of docs/security.md.
const GRACE: Duration = Duration::from_millis(500);

const SIGABRT: i32 = 6;
const SIGXCPU: i32 = 24;
const SIGSYS: i32 = 31;

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
    for path in ["rejected/empty.vert", "rejected/brace-missing-at-end.vert"] {
        assert_eq!(grade(&pool, &sample(path)).unwrap().report.verdict, Verdict::Rejected, "{path}");
    }
    assert_eq!(timeless(grade(&pool, &honest()).unwrap()), first);
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
fn the_deadline_ends_a_worker_that_says_nothing() {
    let _alone = alone();
    let silent = Impostor::new("hello \"$@\"; head -c 1 >/dev/null; sleep 6007 & sleep 60");
    let deadline = Duration::from_secs(1);
    let pool = Pool::start(Settings { deadline, ..silent.settings() }, 1).unwrap();
    let start = Instant::now();
    let report = grade(&pool, &honest()).unwrap().report;
    assert!((deadline..deadline + GRACE).contains(&start.elapsed()), "{:?}", start.elapsed());
    assert!(report.elapsed_ms >= 1000.0);
    assert_eq!(report.verdict, Verdict::Stopped);
    assert!(words(&report).contains("within 1 s (time limit)"), "{}", words(&report));
    drop(pool);
    assert_eq!(children(), []);
    assert!(!is_running("sleep 6007"), "the whole group ends, not the worker alone");
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
    assert!((deadline..deadline + GRACE).contains(&start.elapsed()), "{:?}", start.elapsed());
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
        let start = Instant::now();
        let answer = grade(&pool, &honest());
        assert!(answer.is_err(), "{kind}: {answer:?}");
        assert!(start.elapsed() < Duration::from_secs(10), "{kind}: {:?}", start.elapsed());
    }
    assert_eq!(children(), []);
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
fn workers_die_with_their_parent() {
    let _alone = alone();
    let mut corpus = Command::new(workers::GGRADE)
        .args(["corpus", "submissions/accepted"])
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
fn this_kernel_closes_the_sandbox() {
    let _alone = alone();
    let pool = Pool::start(Settings { policy: Policy::Required, ..settings() }, 1).unwrap();
    let protection = pool.protection();
    assert!(protection.is_closed());
    for layer in [Layer::User, Layer::Limits, Layer::SystemCalls] {
        let state = protection.layers.iter().find(|state| state.layer == layer);
        assert!(state.is_some_and(|state| state.holds), "{layer:?}: {state:?}");
    }
    // A kernel without Landlock is said to be one; the other layers close the sandbox all the same.
    let files = protection.layers.iter().find(|state| state.layer == Layer::Files).unwrap();
    assert_eq!(files.holds, files.detail.starts_with("Landlock V"), "{files:?}");
}

#[test]
fn the_kernel_says_so_too() {
    let _alone = alone();
    let pool = Pool::start(settings(), 1).unwrap();
    let worker = pool.idle_processes()[0];
    let status = std::fs::read_to_string(format!("/proc/{worker}/status")).unwrap();
    let field = |name: &str| {
        let line = status.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'));
        line.unwrap_or_else(|| panic!("no {name}")).split_whitespace().map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(field("Seccomp"), ["2"], "2 is a filter");
    assert_eq!(field("NoNewPrivs"), ["1"]);
    assert!(field("Uid").iter().all(|id| id != "0"), "{:?}", field("Uid"));
    for set in ["CapPrm", "CapEff", "CapInh", "CapAmb"] {
        assert_eq!(field(set), ["0000000000000000"], "{set}");
    }
    let threads = std::fs::read_dir(format!("/proc/{worker}/task")).unwrap().flatten();
    for thread in threads {
        let status = std::fs::read_to_string(thread.path().join("status")).unwrap();
        assert!(status.contains("Seccomp:\t2"), "a thread without filters");
    }
}

#[test]
fn required_refuses_a_worker_that_can_get_out() {
    let _alone = alone();
    // What a worker says whose preflight found a way.
    let hello = r#"{"Ready":{"environment":{"ggrade":"","renderer":"","driver":""},"protection":{"layers":[{"layer":"files","holds":false,"detail":""}],"open":["read"]}}}"#;
    let open = Impostor::new(&format!("{}; sleep 60", say(hello)));
    let fault = Pool::start(Settings { policy: Policy::Required, ..open.settings() }, 1).unwrap_err();
    assert!(fault.message.en.contains("open files"), "{fault}");
    assert!(fault.remedy.is_some_and(|remedy| remedy.en.contains("best-effort")));
    let pool = Pool::start(Settings { policy: Policy::BestEffort, ..open.settings() }, 1).unwrap();
    let notice = pool.notice().unwrap();
    assert!(notice.en.contains("Landlock") && notice.en.contains("open files"), "{notice:?}");
    drop(pool);
    assert_eq!(children(), []);
}

#[test]
fn whoever_breaks_into_a_worker_gets_no_further() {
    let _alone = alone();
    assert_eq!(attempt("nothing").status.code(), Some(1), "a worker that tries nothing ends by itself");
    for refused in ["read", "write"] {
        let output = attempt(refused);
        assert_eq!(output.status.code(), Some(0), "{refused}: {output:?}");
    }
    for deadly in ["socket", "connect", "child", "exec", "signal", "root"] {
        assert_eq!(attempt(deadly).status.signal(), Some(SIGSYS), "{deadly}");
    }
    let spinning = attempt("compute");
    assert_eq!(spinning.status.signal(), Some(SIGXCPU), "{spinning:?}");
    let greedy = attempt("allocate");
    assert_eq!(greedy.status.signal(), Some(SIGABRT), "{greedy:?}");
    assert!(String::from_utf8_lossy(&greedy.stderr).contains("memory allocation of"), "{greedy:?}");
}

/// Runs `ggrade worker --attempt`.
fn attempt(what: &str) -> Output {
    Command::new(workers::GGRADE).args(["worker", "--cpu-seconds", "0", "--attempt", what]).output().unwrap()
}

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
