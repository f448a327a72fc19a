//! The command line's types, and nothing else.

use crate::diagnose::Hints;
use crate::language::Language;
use crate::render::AdapterKind;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Grades GLSL shading homework: compiles the shader, renders it, and says which lighting term is wrong and why.
#[derive(Debug, Parser)]
#[command(name = "ggrade", version, max_term_width = 100, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 graded, all full marks · 1 graded, something is not · 2 usage · 3 our fault · \
                          4 nothing to grade";

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Grade one file
    Grade(Grade),
    /// Grade a folder of samples and hold each report against the expected one beside it
    Corpus(Corpus),
    /// Check this machine and say what to install
    Doctor(Doctor),
    /// Grade what the parent process sends (started by the other commands)
    #[command(hide = true)]
    Worker(Worker),
}

/// Which homework, on which adapter.
#[derive(Clone, Debug, Args)]
pub struct Machine {
    /// The assignment
    #[arg(long, value_name = "ID", default_value = "ggsample06")]
    pub assignment: String,
    /// What renders: Mesa's software driver, or a real graphics card
    #[arg(long, value_enum, default_value_t)]
    pub adapter: AdapterKind,
}

/// Grade one file.
#[derive(Debug, Args)]
pub struct Grade {
    /// The student's shader; `-` reads standard input
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: Machine,
    /// How the report is written
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// Language of the report [default: from LC_ALL, LC_MESSAGES or LANG]
    #[arg(long, value_enum, env = "GGRADE_LANG")]
    pub lang: Option<Language>,
    /// Write each frame (yours, expected, difference) and the animation into this folder
    #[arg(long, value_name = "DIR")]
    pub frames: Option<PathBuf>,
    /// Write the report to this file instead of standard output
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Seed of the probes: the one of an earlier report repeats that grading exactly [default: random]
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// How much the messages help: only what is seen, also the equation it breaks, or also where to look
    #[arg(long, value_enum, default_value_t)]
    pub hints: Hints,
    /// Seconds that the grading may take
    #[arg(long, value_name = "SECONDS", default_value_t = 2.0)]
    pub deadline: f64,
}

/// How a report is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For a person at a terminal
    #[default]
    Text,
    /// One JSON object (schema ggrade/report/v1)
    Json,
    /// One self-contained page with the animation
    Html,
}

/// Grade a folder of samples.
#[derive(Debug, Args)]
pub struct Corpus {
    /// The folder: each `NAME.vert` stands beside its expected report `NAME.json`
    #[arg(value_name = "DIR", default_value = "submissions")]
    pub folder: PathBuf,
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: Machine,
    /// Write the reports found as the expected ones (never in CI); ends with exit code 1, naming what changed
    #[arg(long, env = "BLESS")]
    pub bless: bool,
    /// Show the samples that agree as well
    #[arg(long)]
    pub all: bool,
}

/// Check this machine.
#[derive(Debug, Args)]
pub struct Doctor {
    /// Language of the answers [default: from LC_ALL, LC_MESSAGES or LANG]
    #[arg(long, value_enum, env = "GGRADE_LANG")]
    pub lang: Option<Language>,
}

/// Grade what the parent process sends.
#[derive(Debug, Args)]
pub struct Worker {
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: Machine,
}
