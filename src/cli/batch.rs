//! Arguments of `ggrade batch`.

use super::{Machine, Sandbox};
use clap::Args;

/// Grade a whole class.
#[derive(Debug, Args)]
pub struct Batch {
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: Machine,
    /// The walls around the gradings.
    #[command(flatten)]
    pub sandbox: Sandbox,
}
