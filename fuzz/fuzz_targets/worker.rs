//! The whole path in a worker process: every file gets a report within its time, and the pool goes on.
//!
//! `GGRADE` names the program whose workers are used, such as `target/release/ggrade`.
#![no_main]

use ggrade::grade::Order;
use ggrade::hand_in::HandIn;
use ggrade::sandbox::{Pool, Settings, GradingTask};
use ggrade_fuzz::program;
use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

static POOL: LazyLock<Pool> = LazyLock::new(|| {
    let program = std::env::var_os("GGRADE").expect("GGRADE names the program").into();
    Pool::start(Settings { program: Some(program), ..Settings::new(reference::assignment("ggsample06").expect("built in").clone()) }, 1).expect("workers")
});

/// The deadline, and what ending a worker may take.
const LONGEST: Duration = Duration::from_millis(2500);

fuzz_target!(|bytes: &[u8]| {
    let text = program::program(bytes.get(1..).unwrap_or_default());
    let is_program = bytes.first().is_some_and(|first| first % 2 == 0);
    let file = if is_program { text.as_bytes() } else { bytes };
    let order = Order { seed: 1, ..Order::default() };
    let grade = || {
        let start = Instant::now();
        let answer = POOL.grade(GradingTask { assignment: POOL.assignment(), hand_in: &HandIn::of_one("a.vert", file), order, wants_frames: true });
        (answer, start.elapsed())
    };
    let (answer, took) = grade();
    // Once, the machine may have stood still.
    assert!(took < LONGEST || grade().1 < LONGEST, "{took:?}");
    if let Err(fault) = answer {
        assert!(fault.message.en.starts_with("valid GLSL, not supported"), "{}", fault.message.en);
    }
});
