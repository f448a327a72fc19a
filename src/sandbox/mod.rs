//! The pool of worker processes in which [`crate::grade`] runs on untrusted bytes.
//!
//! The student's shader becomes machine code in the address space of the process that renders it, and a compiler can
//! be made to overflow its stack or eat all memory. So neither happens in this process: a worker does both, and a
//! worker that crashes or takes too long costs nothing but itself.

mod child;
mod pool;
mod protocol;
pub mod worker;

pub use pool::{Answer, Pool, Submission};

use crate::render::AdapterKind;
use std::time::Duration;

/// How workers grade.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Id of the assignment.
    pub assignment: String,
    /// The adapter that renders.
    pub adapter: AdapterKind,
    /// Longest time for one submission.
    pub deadline: Duration,
    /// After how many gradings a worker is replaced.
    pub gradings_per_worker: u32,
}

impl Settings {
    /// The usual settings for an assignment.
    pub fn new(assignment: &str) -> Self {
        Self {
            assignment: assignment.into(),
            adapter: AdapterKind::Software,
            deadline: Duration::from_secs(2),
            gradings_per_worker: 500,
        }
    }
}
