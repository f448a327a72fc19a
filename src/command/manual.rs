//! `ggrade man` and `ggrade completions`: the command line in the forms that `man` and shells read.

use super::{ExitStatus, file_fault, writing};
use crate::cli::{Cli, CompletionsArguments, ManualArguments};
use crate::fault::Fault;
use clap::CommandFactory;
use std::io::Write;
use std::path::Path;

/// Writes a page for each command, such as `ggrade-grade.1`.
pub fn pages(arguments: &ManualArguments) -> Result<ExitStatus, Fault> {
    let folder = &arguments.folder;
    let written = std::fs::create_dir_all(folder).and_then(|()| clap_mangen::generate_to(Cli::command(), folder));
    written.map_err(|error| file_fault(&writing(), folder, &error))?;
    Ok(ExitStatus::FullMarks)
}

/// Prints what a shell reads to complete commands and options.
pub fn completions(arguments: &CompletionsArguments) -> Result<ExitStatus, Fault> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "ggrade", &mut text);
    let written = std::io::stdout().write_all(&text);
    written.map_err(|error| file_fault(&writing(), Path::new("-"), &error))?;
    Ok(ExitStatus::FullMarks)
}
