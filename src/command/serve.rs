//! `ggrade serve`.

use super::Outcome;
use crate::cli::Serve;
use crate::fault::Fault;

/// Runs it.
pub fn run(_arguments: &Serve) -> Result<Outcome, Fault> {
    todo!()
}
