//! What holds a worker that somebody has broken into.

use super::workers::{self, Impostor, alone, children, say, settings};
use ggrade::sandbox::{Layer, Policy, Pool, Settings};
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Output};

const SIGABRT: i32 = 6;
const SIGXCPU: i32 = 24;
const SIGSYS: i32 = 31;

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
    pool.warm().unwrap();
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
