//! Arguments of `ggrade serve`.

use super::{Machine, Sandbox};
use clap::Args;

/// Serve the upload pages.
#[derive(Debug, Args)]
pub struct Serve {
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: Machine,
    /// The walls around the gradings.
    #[command(flatten)]
    pub sandbox: Sandbox,
}
