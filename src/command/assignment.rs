//! `ggrade assignment`: what assignments there are, and whether one is whole.

mod check;
mod new;
#[cfg(feature = "service")]
mod preview;
mod show;

use super::{ExitStatus, language};
use crate::cli::{Action, AssignmentArguments as Arguments};
use crate::fault::Fault;
use crate::language::{Language, Text};
use reference::Assignment;

/// Does what is asked.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, Fault> {
    let language = language(arguments.lang);
    match &arguments.action {
        Action::List => {
            reference::assignments().for_each(|assignment| list(assignment, language));
            Ok(ExitStatus::FullMarks)
        }
        Action::Check(check) => check::run(check, language),
        Action::Show(show) => Ok(show::run(show, language)),
        Action::New(new) => new::run(new, language),
        Action::Schema => {
            anstream::print!("{}", reference::schema::text());
            Ok(ExitStatus::FullMarks)
        }
        #[cfg(feature = "service")]
        Action::Preview(preview) => preview::run(preview, language),
    }
}

fn list(assignment: &Assignment, language: Language) {
    let files: Vec<_> = assignment.files.iter().map(|file| file.name.as_str()).collect();
    let title = Text::new(&assignment.title.en, &assignment.title.ja);
    anstream::println!("{}  {}  {}", assignment.id, files.join(", "), title.get(language));
}
