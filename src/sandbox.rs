//! The pool of worker processes in which [`crate::grade`] runs on untrusted bytes.
//!
//! The student's shader becomes machine code in the address space of the process that renders it, and a compiler can
//! be made to overflow its stack or eat all memory. So neither happens in this process: a worker does both, and a
//! worker that crashes or takes too long costs nothing but itself. `docs/security.md` tells what is promised.
//!
//! Here, in the parent: [`pool`] grades a [`task`], [`roster`] keeps workers ready, [`child`] is one of them, [`channel`] its
//! pipes, [`library`] what it needs to know of an assignment, [`ending`] what its end means, [`memory`] whether this
//! machine gives it enough.
//! On both sides: [`protocol`] is what they say to each other, as [`message`]s; [`check`] says whether an archive has a
//! homework.
//! There, in the worker: [`worker`] serves, [`unpacked`] is what it reads of such an archive, [`confine`], [`files`] and
//! [`syscalls`] are the walls, [`preflight`] leans against them.

mod channel;
mod check;
mod child;
mod confine;
mod drawings;
mod ending;
mod environment;
mod files;
mod library;
mod memory;
mod message;
mod pool;
mod preflight;
mod protection;
mod protocol;
mod roster;
mod schedule;
mod syscalls;
mod task;
mod unpacked;
pub mod worker;

pub use check::CheckedFolder;
pub use child::MOST_ASSIGNMENTS;
pub use pool::Pool;
pub use preflight::IntrusionAttempt;
pub use protection::{Layer, LayerState, Policy, Protection, Reach};
pub use task::{GradedSubmission, GradingTask};

use crate::expected;
use crate::render::AdapterKind;
use reference::Assignment;
use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// The environment that a worker has, for what is to be measured or compared outside of one.
pub fn driver_settings(adapter: AdapterKind) -> Vec<(&'static str, OsString)> {
    environment::variables(adapter)
}

/// Processor time for our own judgement of one submission that has run, to a homework that has the usual time: many times what any
/// needs, since its steps are bounded. To exceed it is our failure.
const JUDGING: Duration = Duration::from_secs(10);

/// The usual time for one submission, in seconds. A right answer that lights each pixel by four lights, with branches within branches,
/// is compiled for up to 2.
pub const DEADLINE_SECONDS: f64 = 4.0;

/// How workers grade.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The assignment that every worker reads at its start.
    pub assignment: Arc<Assignment>,
    /// The others that it reads after that one, so that nobody waits for them.
    pub further: Vec<Arc<Assignment>>,
    /// The adapter that renders.
    pub adapter: AdapterKind,
    /// Longest time for one submission to a homework that has the usual time, see [`Settings::deadline_of`].
    pub deadline: Duration,
    /// Longest CPU time for one such submission, over all threads of its worker; none is a second more than the deadline.
    pub cpu_seconds: Option<u64>,
    /// Most memory that one submission may take over what a warm worker takes, in bytes.
    pub memory: u64,
    /// After how many gradings a worker is replaced; 1 gives each submission a worker of its own.
    pub gradings_per_worker: u32,
    /// Warm workers kept ready besides those that grade.
    pub spares: usize,
    /// Whether a worker grades the handed-out file before it is called ready.
    pub warm_up: bool,
    /// The folder that keeps an assignment's right pictures; none keeps none.
    pub cache: Option<PathBuf>,
    /// How long it has to take to compute the right pictures for them to be kept.
    pub keep_above: Duration,
    /// What to do where the sandbox is not closed.
    pub policy: Policy,
    /// The program whose command `worker` is a worker; none is this program.
    pub program: Option<PathBuf>,
}

impl Settings {
    /// The usual settings for an assignment.
    pub fn new(assignment: Arc<Assignment>) -> Self {
        Self {
            assignment,
            further: Vec::new(),
            adapter: AdapterKind::Software,
            deadline: Duration::from_secs_f64(DEADLINE_SECONDS),
            cpu_seconds: None,
            memory: 768 << 20,
            gradings_per_worker: 500,
            spares: 1,
            warm_up: true,
            cache: expected::cache::folder(),
            keep_above: expected::KEEP_ABOVE,
            policy: Policy::Required,
            program: None,
        }
    }

    /// The same for one single grading: no spare worker, and none that grades anything else first.
    pub fn for_one_grading(self) -> Self {
        Self { spares: 0, warm_up: false, ..self }
    }

    /// The same with a worker of its own for each submission.
    pub fn with_single_use_workers(self) -> Self {
        Self { gradings_per_worker: 1, ..self }
    }

    /// Longest time for one submission to a homework.
    pub fn deadline_of(&self, assignment: &Assignment) -> Duration {
        self.deadline.saturating_mul(assignment.time)
    }

    fn limits(&self) -> WorkerLimits {
        let seconds = self.deadline.as_secs_f64().ceil() as u64;
        WorkerLimits { memory: self.memory, cpu_seconds: self.cpu_seconds.unwrap_or(seconds.saturating_add(1)) }
    }
}

/// What one submission may take inside a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkerLimits {
    /// Bytes of address space over what the worker has already.
    pub memory: u64,
    /// CPU seconds over all threads, rounded up to the next whole one.
    pub cpu_seconds: u64,
}
