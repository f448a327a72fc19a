//! `ggrade watch`.

use super::Outcome;
use crate::cli::Watch;
use crate::fault::Fault;

/// Runs it.
pub fn run(_arguments: &Watch) -> Result<Outcome, Fault> {
    todo!()
}
