//! Arguments of `ggrade batch`.

use super::{MachineArguments, SandboxArguments};
use crate::batch::shard::Shard;
use crate::class::formats::ClassFormat;
use crate::language::Language;
use crate::report::Hints;
use crate::sandbox::DEADLINE_SECONDS;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};

/// Grade a whole class, or put the shards of one together.
#[derive(Debug, Args)]
#[command(after_help = AFTER, args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct BatchCommand {
    /// What to do with shards.
    #[command(subcommand)]
    pub action: Option<BatchAction>,
    /// What to grade, where there is no action.
    #[command(flatten)]
    pub batch: BatchArguments,
}

/// What to do with shards.
#[derive(Debug, Subcommand)]
pub enum BatchAction {
    /// Put the results of all shards together: the same as one run on the whole class gives
    Merge(MergeArguments),
}

/// Put shards together.
#[derive(Debug, Args)]
pub struct MergeArguments {
    /// The output folders of all shards
    #[arg(long, value_name = "DIR", num_args = 1.., required = true)]
    pub shards: Vec<PathBuf>,
    /// The class, with the options of the shards.
    #[command(flatten)]
    pub batch: BatchArguments,
}

/// Grade a whole class.
#[derive(Debug, Args)]
pub struct BatchArguments {
    /// What was handed in: folders, shaders, ZIP archives, a Moodle download
    #[arg(value_name = "INPUT", required = true)]
    pub inputs: Vec<PathBuf>,
    /// The folder that everything is written into
    #[arg(long, short, value_name = "DIR", required = true)]
    out: Option<PathBuf>,
    /// What is written, separated by commas [default: all but nbgrader, canvas and gradescope-grades, as far as the input allows]
    #[arg(long, value_enum, value_name = "LIST", value_delimiter = ',')]
    pub formats: Vec<ClassFormat>,
    /// Moodle's offline grading worksheet, to be filled in
    #[arg(long, value_name = "FILE.csv")]
    pub moodle_worksheet: Option<PathBuf>,
    /// Go on where an earlier run into the same folder stopped
    #[arg(long, conflicts_with = "force")]
    pub resume: bool,
    /// Begin anew, in place of the results that the folder has
    #[arg(long)]
    pub force: bool,
    /// Show what changed since an earlier grading; takes its seed as well
    #[arg(long, value_name = "OLD/results.jsonl")]
    pub compare: Option<PathBuf>,
    /// Hand-ins of an earlier term, to which the class is compared as well: who is alike
    #[arg(long, value_name = "INPUT", conflicts_with = "anonymous")]
    pub earlier: Vec<PathBuf>,
    /// Pseudonyms in place of all names; the same in this folder every time
    #[arg(long)]
    pub anonymous: bool,
    /// Write down whose pseudonym is whose
    #[arg(long, value_name = "FILE.csv", requires = "anonymous")]
    pub names: Option<PathBuf>,
    /// Write one JSON object for each submission to standard output, as it is finished
    #[arg(long)]
    pub json_lines: bool,
    /// How many submissions are graded at once [default: one a processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub jobs: Option<u16>,
    /// Title of the class [default: name of the archive or folder]
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// Language of the reports [default: from LC_ALL, LC_MESSAGES or LANG]
    #[arg(long, value_enum, env = "GGRADE_LANG")]
    pub lang: Option<Language>,
    /// How much the messages help: only what is seen, also the equation it breaks, or also where to look
    #[arg(long, value_enum, default_value_t)]
    pub hints: Hints,
    /// Seed of the fresh probes, one for the whole class: that of an earlier run repeats it exactly [default: random]
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Grade only one of N parts of the class, I from 1; `ggrade batch merge` puts the results together
    #[arg(long, value_name = "I/N", requires = "seed", conflicts_with = "anonymous")]
    pub shard: Option<Shard>,
    /// Seconds that a grading may take
    #[arg(long, value_name = "SECONDS", default_value_t = DEADLINE_SECONDS)]
    pub deadline: f64,
    /// Homework and adapter.
    #[command(flatten)]
    pub machine: MachineArguments,
    /// The walls around the gradings.
    #[command(flatten)]
    pub sandbox: SandboxArguments,
}

impl BatchArguments {
    /// The folder that everything is written into.
    pub fn out(&self) -> &Path {
        // An option for the parser only, which asks for the folder wherever there is something to grade.
        self.out.as_deref().unwrap_or_else(|| Path::new(""))
    }
}

const AFTER: &str = "Exit codes: 0 graded, all full marks, or a whole shard · 1 graded, something is not · 2 usage · 3 our fault, or a \
                     fault of ours in any submission · 4 nothing to grade · 130 stopped by Ctrl-C or SIGTERM";
