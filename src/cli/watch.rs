//! Arguments of `ggrade watch`.

use super::{Machine, Sandbox};
use clap::Args;

/// Grade a file again whenever it is saved.
#[derive(Debug, Args)]
pub struct Watch {
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: Machine,
    /// The walls around the gradings.
    #[command(flatten)]
    pub sandbox: Sandbox,
}
