//! A class in a format of `ggrade batch`.

use crate::batch::class::{Class, Outcome, Refused, Student};
use crate::batch::folder::{Folder, NotOpened};
use crate::batch::formats::{Format, KEY, worksheet};
use crate::batch::intake::{Content, HandIn};
use crate::batch::page::Pages;
use crate::batch::{output, run};
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::report::Report;
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::gallery::blocking;
use crate::service::store::{Batch, ClassRow, Stored, Submission};
use std::path::{Path, PathBuf};

/// What a download is made of.
#[derive(Clone, Debug)]
pub enum Whose {
    /// A batch.
    Batch(Batch),
    /// Everyone of the roster and everyone who handed in under a number: the best of each, or the latest.
    Students(Pick),
}

/// Which of a student's submissions counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Pick {
    /// The one with most points; of equals the earliest.
    #[default]
    Best,
    /// The one that came last.
    Latest,
}

/// A file to be saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Download {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// A class in one of the formats; `sheet` is Moodle's worksheet, which one format fills in. Formats of several files
/// come as a ZIP.
pub async fn download(
    state: &State,
    whose: Whose,
    format: Format,
    sheet: Option<Vec<u8>>,
    language: Language,
) -> Result<Download, Problem> {
    if format == Format::MoodleWorksheet && sheet.is_none() {
        return Err(Problem::unprocessable(
            "This format fills in the worksheet that Moodle gives: send that CSV file along.",
            "この形式は Moodle のワークシートに記入するものです。Moodle からダウンロードした CSV を送ってください。",
        ));
    }
    let (title, refused, members) = members(state, whose).await?;
    let submissions: Vec<_> =
        members.iter().map(|member| member.stored.as_ref().map(|stored| stored.submission.clone())).collect();
    let wants = output::wants(&[format]);
    let mut portraits = Vec::new();
    for member in &members {
        portraits.push(match (&member.stored, wants.portraits) {
            (Some(stored), true) => state.gallery.portrait(state, &stored.submission).await?,
            _ => None,
        });
    }
    let mut class = blocking(state, move |state| class(state, title, refused, members, portraits, language)).await?;
    let temporary = blocking(state, |_| tempfile::tempdir().map_err(|error| disk(&error))).await?;
    // The class page alone is downloaded: it leads to no pages beside it.
    if format == Format::MoodleFeedback {
        for (number, (entry, submission)) in class.entries.iter_mut().zip(submissions).enumerate() {
            if let (Outcome::Graded(report), Some(submission)) = (&entry.outcome, submission) {
                let path = temporary.path().join(format!("{number}.html"));
                let source = entry.source.clone().unwrap_or_default();
                entry.page = Some(page(state, &submission, report, source, language, path).await?);
            }
        }
    }
    let made = tokio::task::spawn_blocking(move || match (format, sheet) {
        (Format::MoodleWorksheet, Some(sheet)) => filled(&class, format, &sheet),
        _ => written(&class, format, &temporary.path().join("out")).map_err(|fault| Problem::of_fault(&fault)),
    });
    made.await.map_err(|panic| Problem::internal(&panic))?
}

/// Moodle's worksheet filled in; what is wrong with it the teacher can mend.
fn filled(class: &Class, format: Format, sheet: &[u8]) -> Result<Download, Problem> {
    let filled =
        worksheet::fill(class, sheet).map_err(|fault| Problem::unprocessable(fault.message.en, fault.message.ja))?;
    Ok(Download { name: format.files()[0].to_owned(), bytes: filled.bytes })
}

/// One student of a class, with what stands for them.
struct Member {
    student: Student,
    path: Option<String>,
    stored: Option<Stored>,
    bytes: Vec<u8>,
    note: Option<Text>,
}

async fn members(state: &State, whose: Whose) -> Result<(String, Vec<Refused>, Vec<Member>), Problem> {
    match whose {
        Whose::Batch(batch) => {
            let mut members = Vec::new();
            for entry in state.store.batch_entries(&batch.id).await? {
                let (stored, bytes) = with_bytes(state, entry.submission_id.as_deref()).await?;
                members.push(Member { student: entry.student, path: entry.path, stored, bytes, note: entry.note });
            }
            Ok((batch.title, batch.refused, members))
        }
        Whose::Students(pick) => {
            let rows = state.store.class(&state.assignment.id, None).await?;
            let mut members = Vec::new();
            for student in state.store.students().await? {
                let theirs = rows.iter().filter(|row| row.number.as_deref() == Some(student.number.as_str()));
                let chosen = chosen(theirs, pick);
                if chosen.is_none() && student.on_roster == 0 {
                    continue;
                }
                let (stored, bytes) = with_bytes(state, chosen.map(|row| row.row.submission.id.as_str())).await?;
                let name = if student.name.is_empty() { student.number.clone() } else { student.name };
                let path = stored.as_ref().map(|stored| stored.submission.name.clone());
                let student = Student { key: student.number, name, moodle: None };
                members.push(Member { student, path, stored, bytes, note: None });
            }
            Ok((state.assignment.id.clone(), Vec::new(), members))
        }
    }
}

/// The submission that counts; `rows` has the newest first.
pub fn chosen<'a>(rows: impl Iterator<Item = &'a ClassRow>, pick: Pick) -> Option<&'a ClassRow> {
    let mut graded = rows.filter(|row| row.row.score.is_some());
    match pick {
        Pick::Latest => graded.next(),
        // Of equals the last of them is taken here: the earliest that came.
        Pick::Best => graded.max_by(|a, b| a.row.score.unwrap_or(0.0).total_cmp(&b.row.score.unwrap_or(0.0))),
    }
}

async fn with_bytes(state: &State, id: Option<&str>) -> Result<(Option<Stored>, Vec<u8>), Problem> {
    let Some(id) = id else { return Ok((None, Vec::new())) };
    let Some(stored) = state.store.stored(id).await? else { return Ok((None, Vec::new())) };
    let bytes = state.store.upload(&stored.submission.sha256).await?.unwrap_or_default();
    Ok((Some(stored), bytes))
}

fn class(
    state: &State,
    title: String,
    refused: Vec<Refused>,
    members: Vec<Member>,
    portraits: Vec<Option<Vec<u8>>>,
    language: Language,
) -> Result<Class, Fault> {
    let nobody = || Text::new("nothing was handed in", "提出がありません");
    let mut outcomes = Vec::new();
    let mut hand_ins = Vec::new();
    for member in members {
        let Member { student, path, stored, bytes, note } = member;
        let content = match &stored {
            Some(stored) => Content::File { name: stored.submission.name.clone(), bytes },
            None => Content::Nothing(note.unwrap_or_else(nobody)),
        };
        outcomes.push(stored.map(outcome));
        hand_ins.push(HandIn { student, path, local: None, content });
    }
    let candidates = run::candidates(hand_ins, state.assignment);
    let entries = candidates.iter().zip(outcomes).zip(portraits).map(|((candidate, outcome), portrait)| {
        candidate.entry(outcome.unwrap_or_else(|| candidate.nothing()), portrait, None)
    });
    Ok(Class {
        assignment: state.assignment.id.clone(),
        title,
        entries: entries.collect(),
        refused,
        expected_portrait: state.gallery.portraits()?.expected.clone(),
        language,
    })
}

fn outcome(stored: Stored) -> Outcome {
    match (stored.report, stored.submission.fault) {
        (Some(report), _) => Outcome::Graded(Box::new(report)),
        (None, Some(fault)) => Outcome::Fault(fault),
        (None, None) => Outcome::NotGraded(Text::new("not graded yet", "まだ採点していません")),
    }
}

/// Writes a student's report as a page with its pictures; where that is. `source` is the file as far as a report shows it.
async fn page(
    state: &State,
    submission: &Submission,
    report: &Report,
    source: String,
    language: Language,
    path: PathBuf,
) -> Result<PathBuf, Problem> {
    let mut frames = state.gallery.decoded(state, submission).await?;
    let report = report.clone();
    let write = move |state: &State| {
        let page = Pages::new(state.assignment, language).page(&report, source.as_bytes(), &mut frames)?;
        std::fs::write(&path, page).map_err(|error| disk(&error))?;
        Ok(path)
    };
    blocking(state, write).await
}

/// Writes a format into a folder, and takes its file from there, or all its files as a ZIP.
fn written(class: &Class, format: Format, path: &Path) -> Result<Download, Fault> {
    let folder = match Folder::open(path) {
        Ok(folder) => folder,
        Err(NotOpened::Fault(fault)) => return Err(fault),
        Err(NotOpened::InUse) => return Err(Fault::new(Text::verbatim("a new folder is in use"))),
    };
    if let (_, Some(fault)) = output::write(class, &[format], None, None, &folder) {
        return Err(fault);
    }
    match format.files() {
        [file] if !file.contains(KEY) => {
            let bytes = std::fs::read(folder.at(file)).map_err(|error| disk(&error))?;
            Ok(Download { name: (*file).to_owned(), bytes })
        }
        _ => {
            let bytes = zipped(path).map_err(|error| disk(&error))?;
            Ok(Download { name: format!("{}.zip", format.id()), bytes })
        }
    }
}

/// Every file below a folder, in the order of their names.
fn zipped(folder: &Path) -> std::io::Result<Vec<u8>> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for entry in walkdir::WalkDir::new(folder).sort_by_file_name() {
        let entry = entry?;
        let Ok(name) = entry.path().strip_prefix(folder) else { continue };
        if entry.file_type().is_file() {
            zip.start_file(name.to_string_lossy(), zip::write::SimpleFileOptions::default())?;
            std::io::copy(&mut std::fs::File::open(entry.path())?, &mut zip)?;
        }
    }
    Ok(zip.finish()?.into_inner())
}

fn disk(error: &std::io::Error) -> Fault {
    Fault::new(Text::new(format!("a temporary file: {error}"), format!("一時ファイルの障害: {error}")))
}
