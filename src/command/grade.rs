//! `ggrade grade FILE`: one file to one report.

use super::view::{View, has_colour, readable};
use super::{Outcome, deadline, exchange, file_fault, language, warn, writing};
use crate::cli::{Format, Grade, Reading};
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::language::{Language, Text};
use crate::report::{Picture, Pictures, Report, Verdict, pictures};
use crate::sandbox::{Answer, Pool, Settings, Submission};
use crate::source::Source;
use std::io::{Read, Write};
use std::path::Path;
use std::time::Duration;

/// Longest input that is read: a file over the source stage's limit is refused there, by its own message.
pub(super) const MAX_READ: u64 = 1 << 20;

/// Grades one file and writes its report.
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
    let bytes = match read(&arguments.file) {
        Ok(bytes) => bytes,
        Err(error) => {
            anstream::eprintln!("ggrade: {}", unreadable(&arguments.file, &error).get(language));
            return Ok(Outcome::Nothing);
        }
    };
    let name = name(&arguments.file);
    let wants_frames = arguments.frames.is_some() || reading == Reading::Html;
    let Answer { report, frames } = grade(arguments, deadline, &name, &bytes, wants_frames, language)?;
    let source = readable(&name, &bytes);
    let pictures = pictures(arguments, &report, source.as_ref(), frames)?;
    let assignment = crate::homework::assignment(&report.assignment)?;
    let view = View {
        report: &report,
        source: source.as_ref(),
        equation: assignment.typeset.as_ref(),
        pictures: pictures.as_ref(),
        language,
    };
    let colour = arguments.output.is_none() && has_colour();
    put(arguments, &view.document(reading, colour)?)?;
    Ok(if report.verdict == Verdict::Correct { Outcome::FullMarks } else { Outcome::Graded })
}

/// Grades the bytes of a file in a worker.
pub(super) fn grade(
    arguments: &Grade,
    deadline: Duration,
    name: &str,
    bytes: &[u8],
    wants_frames: bool,
    language: Language,
) -> Result<Answer, Fault> {
    let settings =
        Settings { adapter: arguments.machine.adapter, deadline, ..Settings::new(&arguments.machine.assignment) };
    // An unknown one is named before a driver is looked for.
    crate::homework::assignment(&settings.assignment)?;
    let pool = Pool::start(arguments.sandbox.apply(settings).for_one_grading(), 1)?;
    warn(&pool, language);
    let seed = arguments.seed.unwrap_or_else(crate::grade::random_seed);
    let order = Order { seed, hints: arguments.hints, cross_check: arguments.cross_check };
    pool.grade(Submission { hand_in: &HandIn::of_one(name, bytes), order, wants_frames })
}

/// The pictures, where any were drawn; written into the folder that was asked for.
pub(super) fn pictures(
    arguments: &Grade,
    report: &Report,
    source: Option<&Source>,
    frames: Vec<Picture>,
) -> Result<Option<Pictures>, Fault> {
    if frames.is_empty() {
        return Ok(None);
    }
    let assignment = crate::homework::assignment(&report.assignment)?;
    let pictures = Pictures {
        yours: frames,
        expected: crate::homework::expected_pictures(&assignment),
        terms: crate::homework::term_pictures(&assignment, report.explanation.as_deref(), source),
        cycle: assignment.scene.cycle,
    };
    if let Some(folder) = &arguments.frames {
        pictures::write(&pictures, folder)?;
    }
    Ok(Some(pictures))
}

/// The bytes of the file, as far as they matter.
pub(super) fn read(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    if path == Path::new("-") {
        std::io::stdin().lock().take(MAX_READ).read_to_end(&mut bytes)?;
    } else {
        std::fs::File::open(path)?.take(MAX_READ).read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

/// What is said of a file that cannot be read.
pub(super) fn unreadable(path: &Path, error: &std::io::Error) -> Text {
    Text::new(
        format!("cannot read {}: {error}", path.display()),
        format!("{} を読み込めません: {error}", path.display()),
    )
}

/// The file's own name, without its folder.
pub(super) fn name(path: &Path) -> String {
    if path == Path::new("-") {
        return "standard input".into();
    }
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
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
