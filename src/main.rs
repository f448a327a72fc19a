//! Command line → exit code.

use clap::Parser;
use ggrade::cli::{Cli, Command};
use ggrade::command;
use std::process::ExitCode;

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Grade(arguments) => command::grade::run(&arguments),
        Command::Corpus(arguments) => command::corpus::run(&arguments),
        Command::Doctor(arguments) => command::doctor::run(&arguments),
        Command::Worker(arguments) => command::worker::run(&arguments),
    };
    outcome.unwrap_or_else(|fault| command::report_fault(&fault)).into()
}
