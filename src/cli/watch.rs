//! Arguments of `ggrade watch`.

use super::{MachineArguments, SandboxArguments};
use crate::language::Language;
use crate::report::Hints;
use crate::sandbox::DEADLINE_SECONDS;
use clap::Args;
use std::path::PathBuf;

/// Grade a hand-in again whenever a file of it is saved.
#[derive(Debug, Args)]
pub struct WatchArguments {
    /// The files that you are working on, or their folder
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: MachineArguments,
    /// The walls around the gradings.
    #[command(flatten)]
    pub sandbox: SandboxArguments,
    /// Language of the reports [default: from LC_ALL, LC_MESSAGES or LANG]
    #[arg(long, value_enum, env = "GGRADE_LANG")]
    pub lang: Option<Language>,
    /// Seed of the fresh probes, the same for every save [default: random]
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// How much the messages help: only what is seen, also the equation it breaks, or also where to look
    #[arg(long, value_enum, default_value_t)]
    pub hints: Hints,
    /// Seconds that a grading may take
    #[arg(long, value_name = "SECONDS", default_value_t = DEADLINE_SECONDS)]
    pub deadline: f64,
}
