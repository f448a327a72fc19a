//! GitHub Actions: workflow commands that put annotations at the students' lines, and the job's summary.
//!
//! The runner obeys every line of a step's output that looks like a command (`::error::…`, or the older `##[…]`
//! anywhere in a line). So what students wrote stands either escaped inside a command of ours, or between
//! `::stop-commands::TOKEN` and `::TOKEN::`, where nothing but the token is obeyed.

mod annotations;
mod summary;

pub use annotations::annotations;
pub use summary::{LIMIT, summary};

use super::untrusted::{one_line, visible};
use super::wording;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry};
use crate::fault::Fault;
use crate::hand_in::hexadecimal;
use crate::language::Text;
use crate::report::Report;
use crate::report::labels::mistake_title;
use crate::{excerpt, report};

/// What ends a stretch of text in which the runner obeys nothing. Nobody who writes that text can guess it.
#[derive(Clone, Debug)]
pub struct StopToken(String);

impl StopToken {
    /// A new one of 128 random bits.
    pub fn random() -> Result<Self, Fault> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes).map_err(|error| {
            Fault::new(Text::new(
                format!("this machine gives no random numbers: {error}"),
                format!("乱数を取得できません: {error}"),
            ))
        })?;
        Ok(Self(hexadecimal(&bytes)))
    }

    /// `text` so that the runner shows it and obeys nothing in it.
    fn fence(&self, text: &str) -> String {
        let token = &self.0;
        let end = if text.is_empty() || text.ends_with('\n') { "" } else { "\n" };
        format!("::stop-commands::{token}\n{text}{end}::{token}::\n")
    }
}

/// What a step prints: the annotations, then for people one line a student, or the full report of the only one.
pub fn log(class: &Class, token: &StopToken) -> String {
    let text = match &class.entries[..] {
        [entry] if entry.report().is_some() => full_report(entry, class),
        entries => entries.iter().map(|entry| line(entry, class)).collect(),
    };
    format!("{}{}", annotations(class), token.fence(&text))
}

fn line(entry: &ClassEntry, class: &Class) -> String {
    let standing = Standing::of(&entry.outcome);
    let score = entry.report().map(|report| format!(" {}", wording::result(report)));
    let titles = |report: &Report| {
        let titles = report.mistakes.iter().map(|id| mistake_title(&class.assignment, id, class.language));
        titles.collect::<Vec<_>>().join(" · ")
    };
    let mistakes = entry.report().map(titles).unwrap_or_default();
    let detail = match standing {
        Standing::NotGraded => wording::explanation(entry, class.language),
        Standing::Fault => wording::fault(entry, class.language).unwrap_or_default(),
        _ => mistakes,
    };
    let label = standing.word(class.language);
    let line = format!("{}: {label}{} {detail}", entry.student.name, score.unwrap_or_default());
    format!("{}\n", one_line(line.trim_end()))
}

/// Columns of a step's log that fit beside the line numbers.
const LOG_WIDTH: usize = 100;

fn full_report(entry: &ClassEntry, class: &Class) -> String {
    let Some(report) = entry.report() else { return String::new() };
    let excerpts = excerpt::excerpt(&entry.sources, &report.diagnostics, class.language, false);
    let options = report::text::TextOptions {
        assignment: &class.assignment,
        language: class.language,
        width: LOG_WIDTH,
        colour: false,
        excerpts: Some(&excerpts),
    };
    visible(&report::text::render(report, &options))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::class::Outcome;
    use crate::class::formats::nasty;
    use crate::report::samples;

    /// The commands that the runner obeys in `log`, by its own rules: a line whose first characters, spaces aside, are
    /// `::`, or that has `##[` anywhere; after `::stop-commands::TOKEN` nothing before `::TOKEN::`.
    pub fn obeyed(log: &str) -> Vec<&str> {
        let mut stopped: Option<String> = None;
        let mut commands = Vec::new();
        // The runner reads lines; a lone CR may end one for it.
        for line in log.split(['\n', '\r']) {
            let line = line.trim_start();
            match &stopped {
                Some(end) if line.trim_end() == end => stopped = None,
                Some(_) => {}
                None => match line.strip_prefix("::stop-commands::") {
                    Some(token) => stopped = Some(format!("::{}::", token.trim_end())),
                    None if line.starts_with("::") || line.contains("##[") => commands.push(line),
                    None => {}
                },
            }
        }
        assert!(stopped.is_none(), "commands stay stopped");
        commands
    }

    #[test]
    fn only_annotations_are_obeyed() {
        for report in samples::all() {
            let mut class = nasty::class();
            class.entries.push(nasty::attack(report.clone()));
            let single = Class { entries: vec![nasty::attack(report)], ..nasty::class() };
            for class in [class, single] {
                let log = log(&class, &StopToken::random().unwrap());
                for command in obeyed(&log) {
                    let ours = ["::error ", "::warning ", "::notice ", "::error::", "::notice::"];
                    assert!(ours.iter().any(|start| command.starts_with(start)), "{command}");
                }
            }
        }
    }

    #[test]
    fn each_token_is_another_and_long_enough() {
        let (a, b) = (StopToken::random().unwrap(), StopToken::random().unwrap());
        assert_ne!(a.0, b.0);
        // 128 bits are 32 hexadecimal digits.
        assert!(a.0.len() == 32 && a.0.bytes().all(|byte| byte.is_ascii_hexdigit()));
    }

    #[test]
    fn each_of_several_students_has_a_line_with_the_mistakes_by_title() {
        let entries: Vec<_> =
            (0..2).map(|number| nasty::entry(number, Outcome::Graded(Box::new(samples::wrong())))).collect();
        let log = log(&Class { entries, ..nasty::class() }, &StopToken::random().unwrap());
        let lines = log.lines().filter(|line| line.ends_with("80 / 100 Half vector not normalised"));
        assert_eq!(lines.count(), 2, "{log}");
    }

    #[test]
    fn the_only_student_gets_the_full_report_with_the_line_quoted() {
        let entry = nasty::entry(0, Outcome::Graded(Box::new(samples::rejected())));
        let log = log(&Class { entries: vec![entry], ..nasty::class() }, &StopToken::random().unwrap());
        assert!(log.contains("vec3 h = (l + v) / 2.0;") && log.contains("0 / 100"), "{log}");
    }
}
