//! Arguments of `ggrade assignment`.

use crate::language::Language;
use crate::render::AdapterKind;
use crate::sandbox::Policy;
use clap::{Args, Subcommand};
#[cfg(feature = "service")]
use std::net::SocketAddr;
use std::path::PathBuf;

/// Look at assignments.
#[derive(Debug, Args)]
pub struct AssignmentArguments {
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
    Check(CheckArguments),
    /// Say what the folder of an assignment says: files, interface, scene, rubric, mistakes
    Show(ShowArguments),
    /// Write the folder of an assignment from a solution
    New(NewArguments),
    /// Print the JSON schema of assignment.toml, for editors
    Schema,
    /// Open the page that students will see, and keep it as the folder is while you write
    #[cfg(feature = "service")]
    Preview(PreviewArguments),
}

/// Say what the folder of an assignment says.
#[derive(Debug, Args)]
pub struct ShowArguments {
    /// The name of a built-in assignment, or the folder of one
    #[arg(value_name = "NAME|FOLDER")]
    pub assignment: String,
}

/// Write the folder of an assignment from a solution: interface, scene, rubric and texts are proposed.
#[derive(Debug, Args)]
pub struct NewArguments {
    /// The folder to write: it does not exist yet, or is empty
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// The solution: a vertex shader, a fragment shader, both, or a `.shader_test` of piglit
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub from: Vec<PathBuf>,
}

/// Read an assignment and grade its own files.
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// The folder of an assignment, or the name of a built-in one
    #[arg(value_name = "FOLDER")]
    pub assignment: String,
    /// Folder for pictures: what is drawn, what should be and where they differ, for each of the homework's own files, for the
    /// solution without each feature, and with each mistake
    #[arg(long, value_name = "DIR")]
    pub pictures: Option<PathBuf>,
    /// What renders: Mesa's software driver, or a real graphics card
    #[arg(long, value_enum, default_value_t)]
    pub adapter: AdapterKind,
    /// What to do where this machine cannot close the sandbox around a grading: refuse, or grade and say what is open
    #[arg(long, value_enum, default_value_t, env = "GGRADE_SANDBOX")]
    pub sandbox: Policy,
}

/// Open the page that students will see.
#[cfg(feature = "service")]
#[derive(Debug, Args)]
pub struct PreviewArguments {
    /// The folder of an assignment; it may still be broken
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Say the address, and open no browser
    #[arg(long)]
    pub no_open: bool,
    /// Address and port to listen on; port 0 is a free one
    #[arg(long, value_name = "ADDRESS:PORT", default_value = "127.0.0.1:0")]
    pub listen: SocketAddr,
    /// Seconds that a grading may take
    #[arg(long, value_name = "SECONDS", default_value_t = crate::sandbox::DEADLINE_SECONDS)]
    pub deadline: f64,
    /// What to do where this machine cannot close the sandbox around a grading: refuse, or grade and say what is open
    #[arg(long, value_enum, default_value_t, env = "GGRADE_SANDBOX")]
    pub sandbox: Policy,
}
