//! `ggrade grade FILE`: one file to one report.

use super::{Outcome, deadline, file_fault, language, warn, width, writing};
use crate::cli::{Format, Grade};
use crate::excerpt;
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::{Language, Text};
use crate::report::Equation;
use crate::report::html::Page;
use crate::report::{Pictures, Report, Verdict, json, pictures, text};
use crate::sandbox::{Answer, Pool, Settings, Submission};
use crate::source::{self, Source};
use std::io::{IsTerminal, Read, Write};
use std::path::Path;

/// Longest input that is read: a file over the source stage's limit is refused there, by its own message.
const MAX_READ: u64 = 1 << 20;

/// Grades one file and writes its report.
pub fn run(arguments: &Grade) -> Result<Outcome, Fault> {
    let language = language(arguments.lang);
    let Some(deadline) = deadline(arguments.deadline) else { return Ok(Outcome::Usage) };
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
    view.write(arguments)?;
    Ok(if report.verdict == Verdict::Correct { Outcome::FullMarks } else { Outcome::Graded })
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

/// The file as text, for excerpts; none where it cannot be read as text.
fn readable(name: &str, bytes: &[u8]) -> Option<Source> {
    match source::read(name, bytes) {
        Ok(source) => Some(source),
        Err(refusal) => refusal.source,
    }
}

/// Everything that a report is shown with.
struct View<'a> {
    report: &'a Report,
    source: Option<&'a Source>,
    pictures: Option<&'a Pictures>,
    language: Language,
}

impl View<'_> {
    fn write(&self, arguments: &Grade) -> Result<(), Fault> {
        match &arguments.output {
            Some(path) => {
                let document = self.document(arguments.format, false)?;
                std::fs::write(path, document).map_err(|error| file_fault(&writing(), path, &error))
            }
            None => {
                let colour = anstream::AutoStream::choice(&std::io::stdout()) != anstream::ColorChoice::Never;
                let document = self.document(arguments.format, colour)?;
                // A reader that closes the pipe early, such as `head`, has what it wanted.
                let _ = std::io::stdout().lock().write_all(document.as_bytes());
                Ok(())
            }
        }
    }

    fn document(&self, format: Format, colour: bool) -> Result<String, Fault> {
        match format {
            Format::Json => Ok(json::render(self.report, self.language)),
            Format::Html => Page {
                report: self.report,
                source: self.source.map(|source| source.text.as_str()),
                pictures: self.pictures,
                equation: Some(&Equation::illumination()),
                language: self.language,
            }
            .render(),
            Format::Text => {
                let excerpts = excerpt::excerpt(self.source, &self.report.diagnostics, self.language, colour);
                Ok(text::render(
                    self.report,
                    &text::Options {
                        language: self.language,
                        width: width(std::io::stdout().is_terminal()),
                        colour,
                        excerpts: Some(&excerpts),
                    },
                ))
            }
        }
    }
}
