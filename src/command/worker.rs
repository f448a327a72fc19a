//! `ggrade worker`: the child's side of the sandbox.

use super::ExitStatus;
use crate::cli::WorkerArguments;
use crate::fault::Fault;
use crate::language::Text;
use crate::sandbox::{IntrusionAttempt, WorkerLimits, worker};
use std::io;

/// Grades what the parent sends until it closes the pipe.
pub fn run(arguments: &WorkerArguments) -> Result<ExitStatus, Fault> {
    let job = worker::WorkerTask {
        adapter: arguments.adapter,
        limits: WorkerLimits { memory: arguments.memory, cpu_seconds: arguments.cpu_seconds },
        rehearsal: arguments.rehearse,
    };
    match arguments.attempt {
        Some(attempt) => try_to_escape(job, attempt),
        None => worker::run(job).map(|()| ExitStatus::FullMarks).map_err(|error| broken(&error)),
    }
}

fn try_to_escape(job: worker::WorkerTask, attempt: IntrusionAttempt) -> Result<ExitStatus, Fault> {
    match worker::attempt(job, attempt).map_err(|error| broken(&error))? {
        Ok(()) => Ok(ExitStatus::Graded),
        Err(error) => {
            anstream::eprintln!("refused: {error}");
            Ok(ExitStatus::FullMarks)
        }
    }
}

fn broken(error: &io::Error) -> Fault {
    Fault::new(Text::verbatim(error.to_string()))
}
