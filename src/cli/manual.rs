//! Arguments of `ggrade man` and `ggrade completions`.

use clap::Args;
use clap_complete::Shell;
use std::path::PathBuf;

/// Write the manual pages.
#[derive(Debug, Args)]
pub struct ManualArguments {
    /// The folder to write into, one page for each command; it is made where it is missing
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
}

/// Print the completions of a shell.
#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// The shell that reads them
    #[arg(value_enum)]
    pub shell: Shell,
}
