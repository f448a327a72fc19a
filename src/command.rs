//! What each command of the command line does.

pub mod assignment;
pub mod batch;
pub mod corpus;
pub mod doctor;
#[cfg(feature = "watch")]
mod end_signals;
mod exchange;
mod files;
pub mod grade;
pub mod interrupt;
#[cfg(feature = "manual")]
pub mod manual;
#[cfg(feature = "opengl")]
pub mod opengl;
#[cfg(feature = "watch")]
mod saves;
#[cfg(feature = "service")]
pub mod serve;
mod view;
#[cfg(feature = "watch")]
pub mod watch;
pub mod worker;

use crate::choice;
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::sandbox::Pool;
use reference::Assignment;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

/// How a run of ggrade ends; the codes are a contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExitStatus {
    /// Graded, all full marks.
    FullMarks,
    /// Graded, something is not.
    Graded,
    /// The command line cannot be carried out as it stands.
    Usage,
    /// Our fault.
    Fault,
    /// There was nothing to grade.
    Nothing,
    /// A signal stopped it before everything was graded.
    Interrupted,
}

impl From<ExitStatus> for ExitCode {
    fn from(outcome: ExitStatus) -> Self {
        Self::from(match outcome {
            ExitStatus::FullMarks => 0,
            ExitStatus::Graded => 1,
            ExitStatus::Usage => 2,
            ExitStatus::Fault => 3,
            ExitStatus::Nothing => 4,
            ExitStatus::Interrupted => interrupt::EXIT_CODE,
        })
    }
}

/// Tells a person at the terminal what failed, and gives the outcome that stands for it.
pub fn report_fault(fault: &Fault) -> ExitStatus {
    let language = language(None);
    let word = Text::new("ggrade failed (this costs no points)", "ggrade の側の障害です (減点にはなりません)");
    anstream::eprintln!("{}: {}", word.get(language), fault.message.get(language));
    if let Some(remedy) = &fault.remedy {
        anstream::eprintln!("  {}", remedy.get(language));
    }
    ExitStatus::Fault
}

/// Says on standard error what the sandbox lacks, where gradings go on all the same.
pub fn warn(pool: &Pool, language: Language) {
    if let Some(notice) = pool.notice() {
        let word = Text::new("warning", "警告");
        anstream::eprintln!("ggrade: {}: {}", word.get(language), notice.get(language));
    }
}

/// The language asked for, or the terminal's own.
pub fn language(asked: Option<Language>) -> Language {
    let locale = || {
        ["LC_ALL", "LC_MESSAGES", "LANG"]
            .iter()
            .filter_map(|name| std::env::var(name).ok())
            .find(|value| !value.is_empty())
    };
    asked.unwrap_or_else(|| if locale().is_some_and(|l| l.starts_with("ja")) { Language::Ja } else { Language::En })
}

/// The fault of a file or folder of the command line's that cannot be read or written.
fn file_fault(action: &Text, path: &Path, error: &std::io::Error) -> Fault {
    Fault::new(Text::new(
        format!("cannot {} {}: {error}", action.en, path.display()),
        format!("{} を{}できません: {error}", path.display(), action.ja),
    ))
}

/// The assignment that is asked for; `None` where there is no such assignment, which is told.
fn assignment(asked: Option<&str>, files: &[PathBuf], language: Language) -> Option<Arc<Assignment>> {
    let chosen = choice::assignment(asked, files);
    let told = |text: &Text| anstream::eprintln!("ggrade: {}", text.get(language));
    let choice = chosen.inspect_err(told).ok()?;
    choice.notice.iter().for_each(told);
    Some(choice.assignment)
}

/// The time that a grading may take; `None` for a number that is no duration.
fn deadline(seconds: f64, language: Language) -> Option<Duration> {
    let deadline = Duration::try_from_secs_f64(seconds).ok().filter(|duration| !duration.is_zero());
    if deadline.is_none() {
        let text = Text::new(
            "--deadline takes seconds above 0, such as 2 or 0.5",
            "--deadline には 0 より大きい秒数を指定してください (例: 2、0.5)",
        );
        anstream::eprintln!("ggrade: {}", text.get(language));
    }
    deadline
}

/// Columns of the terminal; a file or pipe is as wide as a usual page.
fn width(is_terminal: bool) -> usize {
    const PAGE: usize = 100;
    if !is_terminal {
        return PAGE;
    }
    terminal_size::terminal_size().map_or(PAGE, |(width, _)| usize::from(width.0))
}

fn writing() -> Text {
    Text::new("write", "書き込みが")
}
