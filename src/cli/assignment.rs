//! Arguments of `ggrade assignment`.

use crate::language::Language;
use crate::render::AdapterKind;
use crate::sandbox::Policy;
use clap::{Args, Subcommand};

/// Look at assignments.
#[derive(Debug, Args)]
pub struct Assignment {
    /// What to do.
    #[command(subcommand)]
    pub action: Action,
    /// Language of the answers [default: from LC_ALL, LC_MESSAGES or LANG]
    #[arg(long, value_enum, env = "GGRADE_LANG", global = true)]
    pub lang: Option<Language>,
}

/// What to do with assignments.
#[derive(Debug, Subcommand)]
pub enum Action {
    /// List the built-in assignments, each with its files and its title
    List,
    /// Read an assignment, and grade its own files: the solution has to have full marks, what is handed out has not
    Check(Check),
}

/// Read an assignment and grade its own files.
#[derive(Debug, Args)]
pub struct Check {
    /// The folder of an assignment, or the name of a built-in one
    #[arg(value_name = "FOLDER")]
    pub assignment: String,
    /// What renders: Mesa's software driver, or a real graphics card
    #[arg(long, value_enum, default_value_t)]
    pub adapter: AdapterKind,
    /// What to do where this machine cannot close the sandbox around a grading: refuse, or grade and say what is open
    #[arg(long, value_enum, default_value_t, env = "GGRADE_SANDBOX")]
    pub sandbox: Policy,
}
