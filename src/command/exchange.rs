//! `ggrade grade FILE --format gradescope` and its like: one file in a format of autograders and CI.
//!
//! What reads these formats shows its student whatever comes, so there is a document for every ending: also where there
//! is no file, and where ggrade itself fails.

use super::view::readable;
use super::{Outcome, file_fault, grade, writing};
use crate::batch::class::{Class, Entry, Outcome as Became, Student};
use crate::batch::formats::{Format, exchange, github, vpl};
use crate::batch::intake::in_working_folder;
use crate::batch::portrait::Portraits;
use crate::cli::Grade;
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::report::Verdict;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Grades one file and writes it in `format`.
pub(super) fn run(arguments: &Grade, format: Format, deadline: Duration, language: Language) -> Result<Outcome, Fault> {
    let class = class(arguments, format, deadline, language).for_students().into_owned();
    let variable = |name| std::env::var(name).ok();
    let scale = vpl::Scale::from_variables(variable("VPL_GRADEMIN").as_deref(), variable("VPL_GRADEMAX").as_deref());
    grade::put(arguments, &exchange::single(format, &class, scale)?.unwrap_or_default())?;
    if format == Format::Github {
        append_summary(&class)?;
    }
    match class.entries.into_iter().next().map(|entry| entry.outcome) {
        Some(Became::Graded(report)) if report.verdict == Verdict::Correct => Ok(Outcome::FullMarks),
        Some(Became::Graded(_)) => Ok(Outcome::Graded),
        Some(Became::Fault(fault)) => Err(fault),
        Some(Became::NotGraded(_)) | None => Ok(Outcome::Nothing),
    }
}

/// The file as a class of one.
fn class(arguments: &Grade, format: Format, deadline: Duration, language: Language) -> Class {
    let name = grade::name(&arguments.file);
    let is_file = arguments.file != Path::new("-");
    let local = is_file.then(|| in_working_folder(&arguments.file)).flatten();
    let shown = local.as_ref().map(|path| path.to_string_lossy().into_owned());
    let mut entry = Entry {
        student: Student { key: "submission".into(), name: name.clone(), moodle: None },
        path: is_file.then(|| shown.unwrap_or_else(|| name.clone())),
        local,
        outcome: Became::NotGraded(Text::default()),
        source: None,
        portrait: None,
        page: None,
        shares_with: vec![],
    };
    let mut class = Class {
        assignment: arguments.machine.assignment.clone(),
        title: name,
        entries: vec![],
        refused: vec![],
        expected_portrait: vec![],
        language,
    };
    if let Err(became) = fill(&mut entry, &mut class, arguments, format, deadline) {
        entry.outcome = became;
    }
    class.entries.push(entry);
    class
}

/// Grades the file; what became of it where there is no report.
fn fill(
    entry: &mut Entry,
    class: &mut Class,
    arguments: &Grade,
    format: Format,
    deadline: Duration,
) -> Result<(), Became> {
    let bytes = grade::read(&arguments.file).map_err(|error| match error.kind() {
        ErrorKind::NotFound | ErrorKind::IsADirectory | ErrorKind::NotADirectory => Became::NotGraded(Text::new(
            format!("There is no file `{}` to grade.", class.title),
            format!("採点するファイル `{}` がありません。", class.title),
        )),
        _ => Became::Fault(Fault::new(grade::unreadable(&arguments.file, &error))),
    })?;
    let (name, language) = (&class.title, class.language);
    let wants_portrait = format == Format::Gradescope;
    let wants_frames = arguments.frames.is_some() || wants_portrait;
    let answer = grade::grade(arguments, deadline, name, &bytes, wants_frames, language).map_err(Became::Fault)?;
    let source = readable(name, &bytes);
    if wants_portrait && !answer.frames.is_empty() {
        let assignment = crate::homework::assignment(&answer.report.assignment).map_err(Became::Fault)?;
        let portraits = Portraits::new(&assignment).map_err(Became::Fault)?;
        entry.portrait = portraits.of(&answer.frames).map_err(Became::Fault)?;
        class.expected_portrait = portraits.expected;
    }
    if arguments.frames.is_some() {
        grade::pictures(arguments, &answer.report, source.as_ref(), answer.frames).map_err(Became::Fault)?;
    }
    entry.source = source.map(|source| source.text);
    entry.outcome = Became::Graded(Box::new(answer.report));
    Ok(())
}

/// Appends the job's summary to the file that GitHub Actions names, where it does.
fn append_summary(class: &Class) -> Result<(), Fault> {
    let Some(path) = std::env::var_os("GITHUB_STEP_SUMMARY").filter(|path| !path.is_empty()).map(PathBuf::from) else {
        return Ok(());
    };
    let there = std::fs::metadata(&path).map_or(0, |file| usize::try_from(file.len()).unwrap_or(usize::MAX));
    let summary = github::summary(class, github::LIMIT.saturating_sub(there));
    let file = std::fs::OpenOptions::new().create(true).append(true).open(&path);
    file.and_then(|mut file| file.write_all(summary.as_bytes())).map_err(|error| file_fault(&writing(), &path, &error))
}
