//! `ggrade worker`: the child's side of the sandbox.

use super::Outcome;
use crate::cli::Worker;
use crate::fault::Fault;
use crate::language::Text;

/// Grades what the parent sends until it closes the pipe.
pub fn run(arguments: &Worker) -> Result<Outcome, Fault> {
    let assignment = crate::homework::assignment(&arguments.machine.assignment)?;
    crate::sandbox::worker::run(assignment, arguments.machine.adapter)
        .map_err(|error| Fault::new(Text::verbatim(error.to_string())))?;
    Ok(Outcome::FullMarks)
}
