//! `ggrade grade FILE… --format gradescope` and its like: one hand-in in a format of autograders and CI.
//!
//! What reads these formats shows its student whatever comes, so there is a document for every ending: also where there
//! is no file, and where ggrade itself fails.

use super::files::{self, NotTaken};
use super::grade::GradeRequest;
use super::{ExitStatus, file_fault, grade, writing};
use crate::class::formats::{ClassFormat, exchange, github, vpl};
use crate::class::portrait::Portraits;
use crate::class::{Class, ClassEntry, Outcome};
use crate::fault::Fault;
use crate::intake::Student;
use crate::language::Text;
use crate::report::Verdict;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;
use std::sync::Arc;

/// Grades one hand-in and writes it in `format`.
pub(super) fn run(wish: &GradeRequest<'_>, format: ClassFormat) -> Result<ExitStatus, Fault> {
    let class = class(wish, format).for_students().into_owned();
    let variable = |name| std::env::var(name).ok();
    let scale = vpl::Scale::from_variables(variable("VPL_GRADEMIN").as_deref(), variable("VPL_GRADEMAX").as_deref());
    grade::put(wish.arguments, &exchange::single(format, &class, scale)?.unwrap_or_default())?;
    if format == ClassFormat::Github {
        append_summary(&class)?;
    }
    match class.entries.into_iter().next().map(|entry| entry.outcome) {
        Some(Outcome::Graded(report)) if report.verdict == Verdict::Correct => Ok(ExitStatus::FullMarks),
        Some(Outcome::Graded(_)) => Ok(ExitStatus::Graded),
        Some(Outcome::Fault(fault)) => Err(fault),
        Some(Outcome::NotGraded(_)) | None => Ok(ExitStatus::Nothing),
    }
}

/// The hand-in as a class of one.
fn class(wish: &GradeRequest<'_>, format: ClassFormat) -> Class {
    let GradeRequest { arguments, assignment, language, .. } = wish;
    let name = files::names(&arguments.files);
    let mut entry = ClassEntry {
        student: Student { key: "submission".into(), name: name.clone(), moodle: None, email: None },
        places: files::places(&arguments.files),
        outcome: Outcome::NotGraded(Text::default()),
        sources: vec![],
        portrait: None,
        page: None,
        alike: vec![],
    };
    let mut class = Class {
        assignment: Arc::clone(assignment),
        title: name,
        entries: vec![],
        refused: vec![],
        expected_portrait: vec![],
        language: *language,
    };
    if let Err(became) = fill(&mut entry, &mut class, wish, format) {
        entry.outcome = became;
    }
    class.entries.push(entry);
    class
}

/// Grades the hand-in; what became of it where there is no report.
fn fill(
    entry: &mut ClassEntry,
    class: &mut Class,
    wish: &GradeRequest<'_>,
    format: ClassFormat,
) -> Result<(), Outcome> {
    let GradeRequest { arguments, assignment, .. } = wish;
    let (hand_in, places) = files::taken(&arguments.files, assignment).map_err(|why| match &why {
        NotTaken::Unfit(why) => Outcome::NotGraded(why.clone()),
        NotTaken::Unreadable(path, error) => match error.kind() {
            ErrorKind::NotFound | ErrorKind::IsADirectory | ErrorKind::NotADirectory => {
                let name = files::names(std::slice::from_ref(path));
                Outcome::NotGraded(Text::new(
                    format!("There is no file `{name}` to grade."),
                    format!("採点するファイル `{name}` がありません。"),
                ))
            }
            _ => Outcome::Fault(Fault::new(why.message())),
        },
    })?;
    entry.places = places;
    let wants_portrait = format == ClassFormat::Gradescope;
    let wants_frames = arguments.frames.is_some() || wants_portrait;
    let answer = grade::grade(wish, &hand_in, wants_frames).map_err(Outcome::Fault)?;
    entry.sources = hand_in.readable();
    if wants_portrait && !answer.frames.is_empty() {
        let portraits = Portraits::new(assignment).map_err(Outcome::Fault)?;
        entry.portrait = portraits.of(&answer.frames).map_err(Outcome::Fault)?;
        class.expected_portrait = portraits.expected;
    }
    if arguments.frames.is_some() {
        grade::pictures(wish, &answer.report, &entry.sources, answer.frames).map_err(Outcome::Fault)?;
    }
    entry.outcome = Outcome::Graded(Box::new(answer.report));
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
