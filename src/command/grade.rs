//! `ggrade grade FILE…`: one hand-in to one report.

use super::view::{ReportView, has_colour};
use super::{ExitStatus, deadline, exchange, file_fault, files, language, warn, writing};
use crate::cli::{GradeArguments, ReportFormat, ViewFormat};
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::language::Language;
use crate::report::{Picture, Pictures, Report, Verdict, pictures};
use crate::sandbox::{GradedSubmission, GradingTask, Pool, Settings};
use crate::source::Source;
use reference::Assignment;
use std::io::Write;
use std::sync::Arc;
use std::time::Duration;

/// Grades one hand-in and writes its report.
pub fn run(arguments: &GradeArguments) -> Result<ExitStatus, Fault> {
    let language = language(arguments.lang);
    let Some(deadline) = deadline(arguments.deadline, language) else { return Ok(ExitStatus::Usage) };
    let asked = arguments.machine.assignment.as_deref();
    let Some(assignment) = super::assignment(asked, &arguments.files, language) else { return Ok(ExitStatus::Usage) };
    let wish = GradeRequest { arguments, assignment, deadline, language };
    match arguments.format {
        ReportFormat::Reading(reading) => run_for_reading(&wish, reading),
        ReportFormat::Exchange(format) => exchange::run(&wish, format),
    }
}

/// What is to be graded, and how.
pub(super) struct GradeRequest<'a> {
    pub arguments: &'a GradeArguments,
    pub assignment: Arc<Assignment>,
    pub deadline: Duration,
    pub language: Language,
}

fn run_for_reading(wish: &GradeRequest<'_>, reading: ViewFormat) -> Result<ExitStatus, Fault> {
    let GradeRequest { arguments, assignment, language, .. } = wish;
    let language = *language;
    let hand_in = match files::taken(&arguments.files, assignment) {
        Ok((hand_in, _)) => hand_in,
        Err(why) => {
            anstream::eprintln!("ggrade: {}", why.message().get(language));
            return Ok(ExitStatus::Nothing);
        }
    };
    let wants_frames = arguments.frames.is_some() || reading == ViewFormat::Html;
    let GradedSubmission { report, frames } = grade(wish, &hand_in, wants_frames)?;
    let sources = hand_in.readable();
    let pictures = pictures(wish, &report, &sources, frames)?;
    let view = ReportView { assignment, report: &report, sources: &sources, pictures: pictures.as_ref(), language };
    let colour = arguments.output.is_none() && has_colour();
    put(arguments, &view.document(reading, colour)?)?;
    Ok(if report.verdict == Verdict::Correct { ExitStatus::FullMarks } else { ExitStatus::Graded })
}

/// Grades a hand-in in a worker.
pub(super) fn grade(wish: &GradeRequest<'_>, hand_in: &HandIn, wants_frames: bool) -> Result<GradedSubmission, Fault> {
    let GradeRequest { arguments, assignment, deadline, language } = wish;
    let settings =
        Settings { adapter: arguments.machine.adapter, deadline: *deadline, ..Settings::new(Arc::clone(assignment)) };
    let pool = Pool::start(arguments.sandbox.apply(settings).for_one_grading(), 1)?;
    warn(&pool, *language);
    let seed = arguments.seed.unwrap_or_else(crate::grade::random_seed);
    let order = Order { seed, hints: arguments.hints, cross_check: arguments.cross_check };
    pool.grade(GradingTask { assignment, hand_in, order, wants_frames })
}

/// The pictures, where any were drawn; written into the folder that was asked for.
pub(super) fn pictures(
    wish: &GradeRequest<'_>,
    report: &Report,
    sources: &[Source],
    frames: Arc<[Picture]>,
) -> Result<Option<Pictures>, Fault> {
    if frames.is_empty() {
        return Ok(None);
    }
    let GradeRequest { arguments, assignment, .. } = wish;
    let pictures = Pictures {
        yours: frames,
        expected: crate::pictures::expected_pictures(assignment),
        terms: crate::pictures::term_pictures(assignment, report.explanation.as_deref(), sources.first()),
        cycle: assignment.scene.cycle,
    };
    if let Some(folder) = &arguments.frames {
        pictures::write(&pictures, folder)?;
    }
    Ok(Some(pictures))
}

/// Writes a document to where it was asked for.
pub(super) fn put(arguments: &GradeArguments, document: &str) -> Result<(), Fault> {
    match &arguments.output {
        Some(path) => std::fs::write(path, document).map_err(|error| file_fault(&writing(), path, &error)),
        None => {
            // A reader that closes the pipe early, such as `head`, has what it wanted.
            let _ = std::io::stdout().lock().write_all(document.as_bytes());
            Ok(())
        }
    }
}
