//! Grading in the background: what is stored is graded, by whichever way it came.
//!
//! An upload is claimed by the process that stores it and waits in its [`Queue`]; what nobody holds (a teacher's batch,
//! files that a process left behind when it ended) is claimed from the database one by one.

mod cross_checks;
mod graders;
mod queue;

pub use cross_checks::CrossChecks;
pub use graders::Graders;
pub use queue::{Full, GradingResult, Job, Queue};

use crate::fault::Fault;
use crate::sandbox::{GradedSubmission, Pool, Submission};

/// What grades a file: the pool of workers, or what a test puts in its place.
pub trait Judge: Send + Sync + std::fmt::Debug {
    /// Grades one file; may take until the deadline.
    fn grade(&self, submission: Submission<'_>) -> Result<GradedSubmission, Fault>;
}

impl Judge for Pool {
    fn grade(&self, submission: Submission<'_>) -> Result<GradedSubmission, Fault> {
        Self::grade(self, submission)
    }
}
