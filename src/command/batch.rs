//! `ggrade batch`.

use super::Outcome;
use crate::cli::Batch;
use crate::fault::Fault;

/// Runs it.
pub fn run(_arguments: &Batch) -> Result<Outcome, Fault> {
    todo!()
}
