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
use crate::language::Text;
use crate::sandbox::{CheckedFolder, GradedSubmission, Pool, Submission};

/// What grades a file: the pool of workers, or what a test puts in its place.
pub trait Judge: Send + Sync + std::fmt::Debug {
    /// Grades one file; may take until the deadline.
    fn grade(&self, submission: Submission<'_>) -> Result<GradedSubmission, Fault>;

    /// Whether an archive has the folder of a homework; what to tell its teacher, where it has none. May take a minute.
    fn check(&self, _archive: &[u8]) -> Result<Result<CheckedFolder, Text>, Fault> {
        Err(Fault::new(Text::verbatim("what grades here checks no folders")))
    }
}

impl Judge for Pool {
    fn grade(&self, submission: Submission<'_>) -> Result<GradedSubmission, Fault> {
        Self::grade(self, submission)
    }

    fn check(&self, archive: &[u8]) -> Result<Result<CheckedFolder, Text>, Fault> {
        Self::check(self, archive)
    }
}
