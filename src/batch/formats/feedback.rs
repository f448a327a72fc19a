//! Moodle's feedback archive: everyone's report, for "Upload multiple feedback files in a zip".
//!
//! Moodle reads `NAME_NUMBER_assignfeedback_file` and goes by the number. It cuts the folder's name at its underscores and,
//! up to 4.0, wants a fifth part, which may be empty: the folders of its own downloads end in `_` there. From 4.1 on they
//! do not. So the archive follows the download that the class came from.

use super::plain::{html, one_line};
use super::status::summary;
use crate::batch::class::{Class, Entry, Outcome, Participant};
use crate::batch::standing::Standing;
use crate::fault::Fault;
use crate::language::Text;
use std::fs::File;
use std::io::{Seek, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// What went into an archive.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Packed {
    /// How many pages.
    pub pages: usize,
    /// Who was left out, and why.
    pub notes: Vec<Text>,
}

/// Writes the archive into `out`; each page is copied from disk on the way.
pub fn write(class: &Class, out: impl Write + Seek) -> Result<Packed, Fault> {
    let mut archive = ZipWriter::new(out);
    let mut packed = Packed::default();
    let separator = separator(class);
    let mut left_out = (Vec::new(), Vec::new());
    for entry in &class.entries {
        match (&entry.student.moodle, &entry.outcome) {
            (None, _) => left_out.0.push(entry),
            (_, Outcome::Fault(_)) => left_out.1.push(entry),
            (Some(participant), _) => {
                add(&mut archive, entry, participant, separator, class)?;
                packed.pages += 1;
            }
        }
    }
    archive.finish().map_err(|error| failed(&error))?;
    packed.notes.extend(super::names::note(
        &left_out.0,
        "Not in Moodle's feedback archive, because they have no number of Moodle",
        "Moodle の番号がないため、フィードバックの ZIP に含めていません",
    ));
    packed.notes.extend(super::names::note(
        &left_out.1,
        "Not in Moodle's feedback archive, because grading them failed",
        "採点に失敗したため、フィードバックの ZIP に含めていません",
    ));
    Ok(packed)
}

/// What stands between `assignfeedback_file` and the file's name, in the way of Moodle's download.
fn separator(class: &Class) -> &'static str {
    const SUBMISSION: &str = "_assignsubmission_file";
    let paths = class.entries.iter().filter(|entry| entry.student.moodle.is_some()).filter_map(|e| e.path.as_deref());
    let after = paths.filter_map(|path| path.rsplit_once(SUBMISSION)).map(|(_, after)| after);
    let mut after = after.filter(|after| after.starts_with('/') || after.starts_with('_'));
    match after.next() {
        Some(after) if after.starts_with("_/") => "_/",
        Some(after) if after.starts_with('_') => "_",
        _ => "/",
    }
}

fn add<W: Write + Seek>(
    archive: &mut ZipWriter<W>,
    entry: &Entry,
    participant: &Participant,
    separator: &str,
    class: &Class,
) -> Result<(), Fault> {
    let name = format!("{}_{}_assignfeedback_file{separator}feedback.html", name_part(participant), participant.number);
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated).unix_permissions(0o644);
    archive.start_file(name, options).map_err(|error| failed(&error))?;
    let copied = match &entry.page {
        Some(page) => File::open(page).and_then(|mut file| std::io::copy(&mut file, archive).map(drop)),
        None => archive.write_all(notice(entry, class).as_bytes()),
    };
    copied.map_err(|error| match &entry.page {
        Some(page) => failed(&format!("{}: {error}", page.display())),
        None => failed(&error),
    })
}

/// The name as the download had it. Moodle itself writes no `_` into it, since the first one ends it.
fn name_part(participant: &Participant) -> String {
    participant.name.chars().map(|c| if matches!(c, '_' | '/' | '\\') || c.is_control() { ' ' } else { c }).collect()
}

/// A page for a student of whom there is no report.
fn notice(entry: &Entry, class: &Class) -> String {
    let language = class.language;
    let (tag, title) = (crate::report::labels::Labels::of(language).tag, Standing::of(&entry.outcome).word(language));
    let (name, text) = (html(&entry.student.name), html(&one_line(&summary(entry, language))));
    format!(
        "<!DOCTYPE html>\n<html lang=\"{tag}\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
         content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{title}</title>\n<style>body {{ max-width: 40rem; margin: 4rem auto; padding: 0 1rem; font: 1rem/1.7 \
         system-ui, sans-serif; }}</style>\n</head>\n<body>\n<p><bdi>{name}</bdi></p>\n<h1>{title}</h1>\n<p>{text}</p>\n\
         </body>\n</html>\n"
    )
}

fn failed(error: &dyn std::fmt::Display) -> Fault {
    Fault::new(Text::new(
        format!("Moodle's feedback archive could not be written: {error}."),
        format!("Moodle 用のフィードバック ZIP を書き出せませんでした（{error}）。"),
    ))
}
