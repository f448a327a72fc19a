//! Grading in the background: what is stored is graded, by whichever way it came.
//!
//! The queue is in the database. Graders of any process on it claim what is next, one by one. [`Queue`] is what a process
//! knows of it, and [`news`] what the processes tell each other.

mod cross_checks;
mod graders;
mod news;
mod queue;

pub use cross_checks::CrossChecks;
pub use graders::Graders;
pub(super) use graders::take_over;
pub use queue::{Full, GradingResult, Queue};

use super::Service;
use super::store::News;
use crate::fault::Fault;
use crate::language::Text;
use crate::sandbox::{CheckedFolder, GradedSubmission, GradingTask, Pool};

/// Tells graders, here and in other processes, that files wait.
pub async fn files_wait(service: &Service) {
    service.queue.wakes.notify_one();
    news::tell(service, &News::Waiting).await;
}

/// Tells other processes that another folder of a homework is served, or none.
pub(super) async fn folders_changed(service: &Service) {
    news::tell(service, &News::Published).await;
}

/// What grades a file: the pool of workers, or what a test puts in its place.
pub trait Judge: Send + Sync + std::fmt::Debug {
    /// Grades one file; may take until the deadline.
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault>;

    /// The same. `passed` is called where the file takes so long that another one is graded beside it in the meantime.
    fn grade_or_let_pass(
        &self,
        submission: GradingTask<'_>,
        _passed: &mut dyn FnMut(),
    ) -> Result<GradedSubmission, Fault> {
        self.grade(submission)
    }

    /// Whether an archive has the folder of a homework; what to tell its teacher, where it has none. May take a minute.
    fn check(&self, _archive: &[u8]) -> Result<Result<CheckedFolder, Text>, Fault> {
        Err(Fault::new(Text::verbatim("what grades here checks no folders")))
    }
}

impl Judge for Pool {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        Self::grade(self, submission)
    }

    fn grade_or_let_pass(
        &self,
        submission: GradingTask<'_>,
        passed: &mut dyn FnMut(),
    ) -> Result<GradedSubmission, Fault> {
        Self::grade_or_let_pass(self, submission, passed)
    }

    fn check(&self, archive: &[u8]) -> Result<Result<CheckedFolder, Text>, Fault> {
        Self::check(self, archive)
    }
}
