//! `ggrade grade FILE…`: one hand-in to one report.

use super::view::{View, has_colour};
use super::{Outcome, deadline, exchange, file_fault, files, language, warn, writing};
use crate::cli::{Format, Grade, Reading};
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::language::Language;
use crate::report::{Picture, Pictures, Report, Verdict, pictures};
use crate::sandbox::{Answer, Pool, Settings, Submission};
use crate::source::Source;
use std::io::Write;
use std::time::Duration;

/// Grades one hand-in and writes its report.
pub fn run(arguments: &Grade) -> Result<Outcome, Fault> {
    let language = language(arguments.lang);
    let Some(deadline) = deadline(arguments.deadline) else { return Ok(Outcome::Usage) };
    match arguments.format {
        Format::Reading(reading) => run_for_reading(arguments, reading, deadline, language),
        Format::Exchange(format) => exchange::run(arguments, format, deadline, language),
    }
}

fn run_for_reading(
    arguments: &Grade,
    reading: Reading,
    deadline: Duration,
    language: Language,
) -> Result<Outcome, Fault> {
    // An unknown one is named before a file is read.
    let assignment = crate::homework::assignment(&arguments.machine.assignment)?;
    let hand_in = match files::taken(&arguments.files, &assignment) {
        Ok((hand_in, _)) => hand_in,
        Err(why) => {
            anstream::eprintln!("ggrade: {}", why.message().get(language));
            return Ok(Outcome::Nothing);
        }
    };
    let wants_frames = arguments.frames.is_some() || reading == Reading::Html;
    let Answer { report, frames } = grade(arguments, deadline, &hand_in, wants_frames, language)?;
    let sources = hand_in.readable();
    let pictures = pictures(arguments, &report, &sources, frames)?;
    let view = View {
        report: &report,
        sources: &sources,
        equation: assignment.typeset.as_ref(),
        pictures: pictures.as_ref(),
        language,
    };
    let colour = arguments.output.is_none() && has_colour();
    put(arguments, &view.document(reading, colour)?)?;
    Ok(if report.verdict == Verdict::Correct { Outcome::FullMarks } else { Outcome::Graded })
}

/// Grades a hand-in in a worker.
pub(super) fn grade(
    arguments: &Grade,
    deadline: Duration,
    hand_in: &HandIn,
    wants_frames: bool,
    language: Language,
) -> Result<Answer, Fault> {
    let settings =
        Settings { adapter: arguments.machine.adapter, deadline, ..Settings::new(&arguments.machine.assignment) };
    let pool = Pool::start(arguments.sandbox.apply(settings).for_one_grading(), 1)?;
    warn(&pool, language);
    let seed = arguments.seed.unwrap_or_else(crate::grade::random_seed);
    let order = Order { seed, hints: arguments.hints, cross_check: arguments.cross_check };
    pool.grade(Submission { hand_in, order, wants_frames })
}

/// The pictures, where any were drawn; written into the folder that was asked for.
pub(super) fn pictures(
    arguments: &Grade,
    report: &Report,
    sources: &[Source],
    frames: Vec<Picture>,
) -> Result<Option<Pictures>, Fault> {
    if frames.is_empty() {
        return Ok(None);
    }
    let assignment = crate::homework::assignment(&report.assignment)?;
    let pictures = Pictures {
        yours: frames,
        expected: crate::homework::expected_pictures(&assignment),
        terms: crate::homework::term_pictures(&assignment, report.explanation.as_deref(), sources.first()),
        cycle: assignment.scene.cycle,
    };
    if let Some(folder) = &arguments.frames {
        pictures::write(&pictures, folder)?;
    }
    Ok(Some(pictures))
}

/// Writes a document to where it was asked for.
pub(super) fn put(arguments: &Grade, document: &str) -> Result<(), Fault> {
    match &arguments.output {
        Some(path) => std::fs::write(path, document).map_err(|error| file_fault(&writing(), path, &error)),
        None => {
            // A reader that closes the pipe early, such as `head`, has what it wanted.
            let _ = std::io::stdout().lock().write_all(document.as_bytes());
            Ok(())
        }
    }
}
