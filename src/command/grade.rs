//! `ggrade grade FILE`: one file to one report.

use super::view::{View, readable};
use super::{Outcome, language, warn};
use crate::cli::{Format, Grade};
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::{Language, Text};
use crate::report::{Pictures, Verdict, pictures};
use crate::sandbox::{Answer, Pool, Settings, Submission};
use std::io::Read;
use std::path::Path;
use std::time::Duration;

/// Longest input that is read: a file over the source stage's limit is refused there, by its own message.
pub(super) const MAX_READ: u64 = 1 << 20;

/// Grades one file and writes its report.
pub fn run(arguments: &Grade) -> Result<Outcome, Fault> {
    let language = language(arguments.lang);
    let Some(deadline) = deadline(arguments.deadline) else {
        return Ok(bad_deadline());
    };
    let Some(bytes) = read(&arguments.file, language) else { return Ok(Outcome::Nothing) };
    let name = name(&arguments.file);
    let settings =
        Settings { adapter: arguments.machine.adapter, deadline, ..Settings::new(&arguments.machine.assignment) };
    let assignment = crate::homework::assignment(&settings.assignment)?;
    let pool = Pool::start(arguments.sandbox.apply(settings).for_one_grading(), 1)?;
    warn(&pool, language);
    let wants_frames = arguments.frames.is_some() || arguments.format == Format::Html;
    let seed = arguments.seed.unwrap_or_else(crate::grade::random_seed);
    let order = Order { seed, hints: arguments.hints };
    let answer = pool.grade(Submission { name: &name, bytes: &bytes, order, wants_frames })?;
    drop(pool);

    let Answer { report, frames } = answer;
    let source = readable(&name, &bytes);
    let pictures = (!frames.is_empty()).then(|| Pictures {
        yours: frames,
        expected: crate::homework::expected_pictures(assignment),
        terms: crate::homework::term_pictures(assignment, report.explanation.as_deref(), source.as_ref()),
    });
    if let (Some(folder), Some(pictures)) = (&arguments.frames, &pictures) {
        pictures::write(pictures, folder)?;
    }
    let view = View { report: &report, source: source.as_ref(), pictures: pictures.as_ref(), language };
    view.write(arguments.format, arguments.output.as_deref())?;
    Ok(if report.verdict == Verdict::Correct { Outcome::FullMarks } else { Outcome::Graded })
}

/// Says that the deadline is none.
pub(super) fn bad_deadline() -> Outcome {
    anstream::eprintln!("ggrade: --deadline takes seconds above 0, such as 2 or 0.5");
    Outcome::Usage
}

pub(super) fn deadline(seconds: f64) -> Option<Duration> {
    Duration::try_from_secs_f64(seconds).ok().filter(|duration| !duration.is_zero())
}

/// The bytes of the file; where there is none to read, says so.
fn read(path: &Path, language: Language) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = if path == Path::new("-") {
        std::io::stdin().lock().take(MAX_READ).read_to_end(&mut bytes)
    } else {
        std::fs::File::open(path).and_then(|file| file.take(MAX_READ).read_to_end(&mut bytes))
    };
    match read {
        Ok(_) => Some(bytes),
        Err(error) => {
            let message = Text::new(
                format!("cannot read {}: {error}", path.display()),
                format!("{} を読み込めません: {error}", path.display()),
            );
            anstream::eprintln!("ggrade: {}", message.get(language));
            None
        }
    }
}

/// The file's own name, without its folder.
fn name(path: &Path) -> String {
    if path == Path::new("-") {
        return "standard input".into();
    }
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
