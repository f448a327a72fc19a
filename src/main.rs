//! Command line → exit code.

use clap::Parser;
use ggrade::cli::{Cli, Command};
use ggrade::command;
use std::process::ExitCode;

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Grade(arguments) => command::grade::run(&arguments),
        Command::Batch(arguments) => command::batch::run(&arguments),
        #[cfg(feature = "watch")]
        Command::Watch(arguments) => command::watch::run(&arguments),
        #[cfg(feature = "service")]
        Command::Serve(arguments) => command::serve::run(&arguments),
        Command::Corpus(arguments) => command::corpus::run(&arguments),
        Command::Assignment(arguments) => command::assignment::run(&arguments),
        Command::Doctor(arguments) => command::doctor::run(&arguments),
        #[cfg(feature = "manual")]
        Command::Man(arguments) => command::manual::pages(&arguments),
        #[cfg(feature = "manual")]
        Command::Completions(arguments) => command::manual::completions(&arguments),
        #[cfg(feature = "opengl")]
        Command::OpenGl(arguments) => command::opengl::run(&arguments),
        Command::Worker(arguments) => command::worker::run(&arguments),
    };
    outcome.unwrap_or_else(|fault| command::report_fault(&fault)).into()
}
