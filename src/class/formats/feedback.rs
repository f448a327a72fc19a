//! Moodle's feedback archive: everyone's report, for "Upload feedback files in a zip".
//!
//! Moodle reads `NAME_NUMBER_assignfeedback_file` and goes by the number. It cuts the folder's name at its underscores and,
//! up to 4.0, wants a fifth part, which may be empty: the folders of its own downloads end in `_` there. From 4.1 on they
//! do not. So the archive follows the download that the class came from.

use super::plain::{html, one_line};
use super::status::summary;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry, Outcome};
use crate::fault::Fault;
use crate::language::Text;
use std::collections::HashSet;
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

/// A participant of Moodle's who gets a student's report.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipient<'a> {
    /// Whose report.
    pub entry: &'a ClassEntry,
    /// The participant's name, which Moodle does not go by.
    pub name: String,
    /// The participant's number, which it goes by.
    pub number: u64,
}

/// The recipients where there is no worksheet: the numbers of the download are taken for participants'.
pub fn by_number<'a>(class: &'a Class) -> Vec<Recipient<'a>> {
    let recipient = |entry: &'a ClassEntry| {
        let ClassEntry { student, .. } = entry;
        let participant = student.moodle.as_ref()?;
        Some(Recipient { entry, name: participant.name.clone(), number: participant.number? })
    };
    class.entries.iter().filter_map(recipient).collect()
}

/// What a teacher should know of an archive that was made without a worksheet.
pub fn without_worksheet() -> Text {
    Text::new(
        "moodle-feedback.zip was made without Moodle's worksheet: right where everyone hands in alone. Where groups hand in, \
         the numbers are those of groups and other students would get these files: name the worksheet with \
         --moodle-worksheet",
        "moodle-feedback.zip は評定ワークシートなしで作りました。一人ずつ提出する課題ではこのまま使えます。グループで提出する\
         課題では番号がグループのもので、別の学生に渡ってしまいます。--moodle-worksheet でワークシートを指定してください",
    )
}

/// Writes the archive into `out`; each page is copied from disk on the way.
pub fn write(class: &Class, recipients: &[Recipient], out: impl Write + Seek) -> Result<Packed, Fault> {
    let mut archive = ZipWriter::new(out);
    let mut packed = Packed::default();
    let separator = separator(class);
    let (faults, graded): (Vec<&ClassEntry>, Vec<&ClassEntry>) =
        class.entries.iter().partition(|entry| matches!(entry.outcome, Outcome::Fault(_)));
    for recipient in recipients.iter().filter(|recipient| !matches!(recipient.entry.outcome, Outcome::Fault(_))) {
        add(&mut archive, recipient, separator, class)?;
        packed.pages += 1;
    }
    archive.finish().map_err(|error| failed(&error))?;
    let known: HashSet<&str> = recipients.iter().map(|recipient| recipient.entry.student.key.as_str()).collect();
    let unknown: Vec<&ClassEntry> = graded.into_iter().filter(|e| !known.contains(e.student.key.as_str())).collect();
    packed.notes.extend(super::names::note(
        &unknown,
        "Not in Moodle's feedback archive, because no participant of Moodle is known to whom it would go",
        "渡す相手（Moodle の参加者）が分からないため、フィードバックの ZIP に含めていません",
    ));
    packed.notes.extend(super::names::note(
        &faults,
        "Not in Moodle's feedback archive, because grading them failed",
        "採点に失敗したため、フィードバックの ZIP に含めていません",
    ));
    Ok(packed)
}

/// What stands between `assignfeedback_file` and the file's name, in the way of Moodle's download.
fn separator(class: &Class) -> &'static str {
    const SUBMISSION: &str = "_assignsubmission_file";
    let paths = class.entries.iter().filter(|entry| entry.student.moodle.is_some()).flat_map(|entry| &entry.places);
    let after = paths.filter_map(|place| place.path.rsplit_once(SUBMISSION)).map(|(_, after)| after);
    let mut after = after.filter(|after| after.starts_with('/') || after.starts_with('_'));
    match after.next() {
        Some(after) if after.starts_with("_/") => "_/",
        Some(after) if after.starts_with('_') => "_",
        _ => "/",
    }
}

fn add<W: Write + Seek>(
    archive: &mut ZipWriter<W>,
    recipient: &Recipient,
    separator: &str,
    class: &Class,
) -> Result<(), Fault> {
    let Recipient { entry, name, number } = recipient;
    let name = format!("{}_{number}_assignfeedback_file{separator}feedback.html", name_part(name));
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

/// The name as the download had it, but for what Moodle's importer stumbles over: the first `_` ends a name, and files
/// that begin with `.` or `~` are hidden to it.
fn name_part(name: &str) -> String {
    let name = name.trim_start_matches(['.', '~']).chars();
    name.map(|c| if matches!(c, '_' | '/' | '\\') || c.is_control() { ' ' } else { c }).collect()
}

/// A page for a student of whom there is no report.
fn notice(entry: &ClassEntry, class: &Class) -> String {
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
