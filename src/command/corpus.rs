//! `ggrade corpus DIR`: a table of expected against found.

use super::{ExitStatus, language, warn};
use crate::cli::CorpusArguments;
use crate::corpus::{self, CheckedSample, Expectation};
use crate::fault::Fault;
use crate::language::Language;
use crate::parallel;
use crate::report::Opinion;
use crate::sandbox::{Pool, Settings};
use reference::Assignment;
use std::sync::Arc;
use std::time::Duration;

/// Longer than the usual deadline: a busy machine must not change what a sample is.
const DEADLINE: Duration = Duration::from_secs(10);

/// Grades the samples of a folder.
pub fn run(arguments: &CorpusArguments) -> Result<ExitStatus, Fault> {
    if arguments.bless && std::env::var_os("CI").is_some() {
        anstream::eprintln!("ggrade: expected reports are not written in CI");
        return Ok(ExitStatus::Usage);
    }
    let Some(assignment) = assignment(arguments) else { return Ok(ExitStatus::Usage) };
    let folder = arguments.folder(&assignment);
    let settings = Settings { adapter: arguments.machine.adapter, deadline: DEADLINE, ..Settings::new(assignment) };
    let workers = parallel::processors();
    let pool = Pool::start(arguments.sandbox.apply(settings), workers)?;
    warn(&pool, language(None));
    let results = corpus::check(&folder, &pool, arguments.cross_check)?;
    let disputed = cross_checked(&results, arguments.all);
    let mut differing = 0;
    for checked in &results {
        if checked.agrees() {
            if arguments.all {
                anstream::println!("ok    {}  {}", checked.sample.display(), summary(checked.expected.as_ref()));
            }
            continue;
        }
        differing += 1;
        show(checked);
        if arguments.bless && checked.found.is_ok() {
            checked.bless()?;
        }
    }
    let agreeing = results.len() - differing;
    anstream::println!("{agreeing} of {} samples are as expected", results.len());
    if arguments.bless && differing > 0 {
        anstream::eprintln!("ggrade: {differing} expected reports were written anew: look at them");
    }
    Ok(if differing == 0 && disputed == 0 { ExitStatus::FullMarks } else { ExitStatus::Graded })
}

/// The assignment that is asked for, or else the one whose samples they are by the names of the folders that they are in.
fn assignment(arguments: &CorpusArguments) -> Option<Arc<Assignment>> {
    let folders = arguments.folder.iter().flat_map(|folder| folder.components());
    let mut names = folders.filter_map(|folder| folder.as_os_str().to_str());
    let named = names.find(|name| reference::built_in::names().any(|known| known == *name));
    super::assignment(arguments.machine.assignment.as_deref().or(named), &[], language(None))
}

/// Says where the interpreter disagrees with the driver, and how many samples those are.
fn cross_checked(results: &[CheckedSample], all: bool) -> usize {
    let mut counts = [0; 3];
    for checked in results {
        let Some(cross_check) = &checked.cross_check else { continue };
        let (number, label) = match cross_check.opinion {
            Opinion::Agrees => (0, "agree"),
            Opinion::Differs => (1, "DISPUTED"),
            Opinion::NotRun => (2, "not run"),
        };
        counts[number] += 1;
        if number == 1 || (all && number == 2) {
            let message = cross_check.message.as_ref().map_or("", |message| &message.en);
            anstream::println!("{label}  {}  {message}", checked.sample.display());
        }
    }
    let [agreeing, differing, not_run] = counts;
    if agreeing + differing + not_run > 0 {
        anstream::println!(
            "{agreeing} of {} samples that were drawn agree with the interpreter; {differing} differ, {not_run} were not run",
            agreeing + differing + not_run
        );
    }
    differing
}

fn show(checked: &CheckedSample) {
    anstream::println!("DIFF  {}", checked.sample.display());
    anstream::println!("      expected  {}", summary(checked.expected.as_ref()));
    match &checked.found {
        Ok(found) => anstream::println!("      found     {}", summary(Some(found))),
        Err(fault) => anstream::println!("      found     fault: {}", fault.message.en),
    }
    let (Some(expected), Ok(found)) = (&checked.expected, &checked.found) else { return };
    for (name, expected, found) in expected.changed_texts(found) {
        for language in [Language::En, Language::Ja] {
            let [expected, found] = [&expected, &found].map(|text| text.get(language));
            if expected != found {
                anstream::println!("      {name}\n        expected  {expected}\n        found     {found}");
            }
        }
    }
}

/// The numbers of an expectation in one line.
fn summary(expectation: Option<&Expectation>) -> String {
    let Some(expectation) = expectation else { return "nothing (no file)".into() };
    let number = |n: Option<u32>| n.map_or_else(|| "-".into(), |n| n.to_string());
    let rubric: Vec<_> =
        expectation.rubric.iter().map(|(id, said)| format!("{id} {} :{}", said.points, number(said.line))).collect();
    let advice: Vec<_> = expectation.advice.iter().map(|(id, said)| format!("{id}:{}", number(said.line))).collect();
    let diagnostics: Vec<_> = expectation
        .diagnostics
        .iter()
        .map(|said| {
            let file = said.file.as_ref().map(|file| format!("{file}:")).unwrap_or_default();
            format!("{:?} {:?} {file}{}:{}", said.severity, said.stage, number(said.line), number(said.column))
        })
        .collect();
    format!(
        "{:?} {} ({}) [{}] {} {}",
        expectation.verdict,
        expectation.score,
        rubric.join(", "),
        expectation.mistakes.join(" "),
        advice.join(" "),
        diagnostics.join("; ")
    )
}
