//! The command line's types, and nothing else.

mod assignment;
mod batch;
mod format;
#[cfg(feature = "manual")]
mod manual;
#[cfg(feature = "service")]
mod serve;
#[cfg(feature = "watch")]
mod watch;

#[cfg(feature = "service")]
pub use assignment::PreviewArguments;
pub use assignment::{Action, AssignmentArguments, CheckArguments, NewArguments, ShowArguments};
pub use batch::{BatchAction, BatchArguments, BatchCommand, MergeArguments};
pub use format::{ReportFormat, ViewFormat};
#[cfg(feature = "manual")]
pub use manual::{CompletionsArguments, ManualArguments};
#[cfg(feature = "service")]
pub use serve::{LogFormat, ProcessRole, ServeArguments};
#[cfg(feature = "watch")]
pub use watch::WatchArguments;

use crate::language::Language;
use crate::render::AdapterKind;
use crate::report::Hints;
use crate::sandbox::{DEADLINE_SECONDS, IntrusionAttempt, Policy, Settings};
use clap::{Args, Parser, Subcommand};
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
    /// Grade one hand-in: its file, or its files
    Grade(GradeArguments),
    /// Grade a whole class: folders, files, archives, a Moodle download
    Batch(BatchCommand),
    /// Grade a hand-in again whenever a file of it is saved
    #[cfg(feature = "watch")]
    Watch(WatchArguments),
    /// Serve the pages on which students upload and teachers see the class
    #[cfg(feature = "service")]
    Serve(ServeArguments),
    /// Grade a folder of samples and hold each report against the expected one beside it
    Corpus(CorpusArguments),
    /// List and show assignments, write the folder of one, or check it
    Assignment(AssignmentArguments),
    /// Check this machine and say what to install
    Doctor(DoctorArguments),
    /// Write the manual pages of all commands into a folder
    #[cfg(feature = "manual")]
    Man(ManualArguments),
    /// Print what a shell needs to complete commands and options
    #[cfg(feature = "manual")]
    Completions(CompletionsArguments),
    /// Hold the solution of an assignment against OpenGL, and print JSON (started by `assignment check`)
    #[cfg(feature = "opengl")]
    #[command(hide = true, name = "opengl")]
    OpenGl(OpenglArguments),
    /// Grade what the parent process sends (started by the other commands)
    #[command(hide = true)]
    Worker(WorkerArguments),
}

/// Which homework, on which adapter.
#[derive(Clone, Debug, Args)]
pub struct MachineArguments {
    /// The assignment: the name of a built-in one, or the folder of one [default: the built-in one whose file it is, or else ggsample06]
    #[arg(long, value_name = "NAME|FOLDER")]
    pub assignment: Option<String>,
    /// What renders: Mesa's software driver, or a real graphics card
    #[arg(long, value_enum, default_value_t)]
    pub adapter: AdapterKind,
}

/// How submissions are kept from this machine and from each other.
#[derive(Clone, Copy, Debug, Args)]
pub struct SandboxArguments {
    /// What to do where this machine cannot close the sandbox around a grading: refuse, or grade and say what is open
    #[arg(long, value_enum, default_value_t, env = "GGRADE_SANDBOX")]
    pub sandbox: Policy,
    /// Give each submission a process of its own, which no other submission has touched (slower)
    #[arg(long)]
    pub single_use_workers: bool,
}

impl CorpusArguments {
    /// The folder of the samples: those of the assignment where none is named.
    pub fn folder(&self, assignment: &reference::Assignment) -> PathBuf {
        self.folder.clone().unwrap_or_else(|| PathBuf::from("submissions").join(&assignment.id))
    }
}

impl SandboxArguments {
    /// The settings with these wishes.
    pub fn apply(self, settings: Settings) -> Settings {
        let settings = Settings { policy: self.sandbox, ..settings };
        if self.single_use_workers { settings.with_single_use_workers() } else { settings }
    }
}

/// Grade one hand-in.
#[derive(Debug, Args)]
pub struct GradeArguments {
    /// The files of one hand-in, or its folder or ZIP; `-` reads standard input
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: MachineArguments,
    /// The walls around the grading.
    #[command(flatten)]
    pub sandbox: SandboxArguments,
    /// How the report is written
    #[arg(long, value_enum, default_value_t)]
    pub format: ReportFormat,
    /// Language of the report [default: from LC_ALL, LC_MESSAGES or LANG]
    #[arg(long, value_enum, env = "GGRADE_LANG")]
    pub lang: Option<Language>,
    /// Write each frame (yours, expected, difference) and the animation into this folder
    #[arg(long, value_name = "DIR")]
    pub frames: Option<PathBuf>,
    /// Write the report to this file instead of standard output
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Seed of the fresh probes: the one of an earlier report repeats that grading exactly [default: random]
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// How much the messages help: only what is seen, also the equation it breaks, or also where to look
    #[arg(long, value_enum, default_value_t)]
    pub hints: Hints,
    /// Run the file in ggrade's own interpreter as well, and say where it computes other values than the driver
    #[arg(long)]
    pub cross_check: bool,
    /// Seconds that the grading may take
    #[arg(long, value_name = "SECONDS", default_value_t = DEADLINE_SECONDS, env = "GGRADE_DEADLINE")]
    pub deadline: f64,
}

/// Grade a folder of samples.
#[derive(Debug, Args)]
pub struct CorpusArguments {
    /// The folder: each `NAME.vert`, or folder `NAME/` of several files, stands beside its expected report `NAME.json` [default: submissions/ASSIGNMENT]
    #[arg(value_name = "DIR")]
    pub folder: Option<PathBuf>,
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: MachineArguments,
    /// The walls around the gradings.
    #[command(flatten)]
    pub sandbox: SandboxArguments,
    /// Write the reports found as the expected ones (never in CI); ends with exit code 1, naming what changed
    #[arg(long, env = "BLESS")]
    pub bless: bool,
    /// Run each sample in ggrade's own interpreter as well: a value that differs from the driver's is a difference
    #[arg(long)]
    pub cross_check: bool,
    /// Show the samples that agree as well
    #[arg(long)]
    pub all: bool,
}

/// Check this machine.
#[derive(Debug, Args)]
pub struct DoctorArguments {
    /// Language of the answers [default: from LC_ALL, LC_MESSAGES or LANG]
    #[arg(long, value_enum, env = "GGRADE_LANG")]
    pub lang: Option<Language>,
}

/// Hold the solution of an assignment against OpenGL, and print JSON.
#[cfg(feature = "opengl")]
#[derive(Debug, Args)]
pub struct OpenglArguments {
    /// The folder of an assignment, or the name of a built-in one
    #[arg(value_name = "FOLDER")]
    pub assignment: String,
}

/// Grade what the parent process sends.
#[derive(Debug, Args)]
pub struct WorkerArguments {
    /// What renders
    #[arg(long, value_enum, default_value_t)]
    pub adapter: AdapterKind,
    /// Bytes of memory that one submission may take over what the worker has
    #[arg(long, value_name = "BYTES", default_value_t = 768 << 20)]
    pub memory: u64,
    /// CPU seconds that one submission may take
    #[arg(long, value_name = "SECONDS", default_value_t = 3)]
    pub cpu_seconds: u64,
    /// Grade nothing: end once the first assignment is read
    #[arg(long)]
    pub rehearse: bool,
    /// Grade nothing: enter the sandbox, try this, and exit with 0 where it was refused, with 1 where it was not
    #[arg(long, value_enum, value_name = "WHAT")]
    pub attempt: Option<IntrusionAttempt>,
}
