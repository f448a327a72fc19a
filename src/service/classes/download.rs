//! A class in a format of `ggrade batch`.

use super::people::{Person, people};
use crate::batch::class::{Class, Entry, FileLocation, Outcome, Participant, Refused, Student};
use crate::batch::folder::{Folder, NotOpened};
use crate::batch::formats::{Format, KEY, worksheet};
use crate::batch::intake::{Content, StudentWork};
use crate::batch::page::Pages;
use crate::batch::summary::Written;
use crate::batch::{output, run};
use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::language::{Language, Text};
use crate::report::Report;
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::gallery::blocking;
use crate::service::store::{Batch, ClassRow, Stored, Submission};
use crate::source::Source;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What a download is made of.
#[derive(Clone, Debug)]
pub enum Whose {
    /// A batch.
    Batch(Batch),
    /// Everyone of the class: the best of each, or the latest.
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
    /// What a teacher should know of it: whom it leaves out, what could not be filled in.
    pub notes: Vec<Text>,
}

/// How far a download is: one step for each picture and each page that is drawn, and one for the rest.
#[derive(Debug)]
pub struct Steps {
    done: AtomicUsize,
    total: AtomicUsize,
}

impl Default for Steps {
    fn default() -> Self {
        Self { done: AtomicUsize::new(0), total: AtomicUsize::new(1) }
    }
}

impl Steps {
    /// How many are done, and how many there are.
    pub fn get(&self) -> (usize, usize) {
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed))
    }

    fn expect(&self, more: usize) {
        self.total.fetch_add(more, Ordering::Relaxed);
    }

    fn done(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }
}

/// The language of a format: students are spoken to in that of the course, unless the request asks for one.
pub async fn language(
    state: &State,
    format: Format,
    asked: Option<Language>,
    reader: Language,
) -> Result<Language, Problem> {
    match asked {
        Some(language) => Ok(language),
        None if format.is_for_students() => Ok(state.store.course().await?.language),
        None => Ok(reader),
    }
}

/// Whether a format takes seconds for a class, because something is drawn for everyone.
pub fn is_slow(format: Format) -> bool {
    let wants = output::wants(&[format]);
    wants.pages || wants.portraits
}

/// What a download shall be.
#[derive(Debug)]
pub struct Wanted {
    /// The format.
    pub format: Format,
    /// Moodle's worksheet, which one format fills in and another takes the members of groups from.
    pub sheet: Option<Vec<u8>>,
    /// The language of its words.
    pub language: Language,
    /// Whether the class page comes with everyone's own page, as a ZIP; alone it links to none.
    pub with_pages: bool,
}

impl Wanted {
    /// Whether it can be made: a worksheet is there where one is needed, and can be read.
    pub fn check(&self) -> Result<(), Problem> {
        match &self.sheet {
            Some(sheet) => {
                worksheet::check(sheet).map_err(|fault| Problem::unprocessable(fault.message.en, fault.message.ja))
            }
            None if self.format == Format::MoodleWorksheet => Err(Problem::unprocessable(
                "This format fills in the worksheet that Moodle gives: send that CSV file along.",
                "この形式は Moodle のワークシートに記入するものです。Moodle からダウンロードした CSV を送ってください。",
            )),
            None => Ok(()),
        }
    }
}

/// A class in one of the formats. Formats of several files come as a ZIP.
pub async fn download(state: &State, whose: Whose, wanted: Wanted, steps: &Arc<Steps>) -> Result<Download, Problem> {
    wanted.check()?;
    let Wanted { format, sheet, language, with_pages } = wanted;
    let (title, refused, members) = members(state, whose).await?;
    let submissions: Vec<_> =
        members.iter().map(|member| member.stored.as_ref().map(|stored| stored.submission.clone())).collect();
    let wants = output::wants(&[format]);
    let has_pages = wants.pages && (with_pages || format != Format::Html);
    let stored = members.iter().filter(|member| member.stored.is_some()).count();
    steps.expect(stored * (usize::from(wants.portraits) + usize::from(has_pages)));
    let mut portraits = Vec::new();
    for member in &members {
        let Some(stored) = member.stored.as_ref().filter(|_| wants.portraits) else {
            portraits.push(None);
            continue;
        };
        portraits.push(state.gallery.portrait(state, &stored.submission).await?);
        steps.done();
    }
    let mut class = blocking(state, move |state| class(state, title, refused, members, portraits, language)).await?;
    let temporary = blocking(state, |_| tempfile::tempdir().map_err(|error| disk(&error))).await?;
    if has_pages {
        for (number, (entry, submission)) in class.entries.iter_mut().zip(submissions).enumerate() {
            if let (Outcome::Graded(report), Some(submission)) = (&entry.outcome, submission) {
                let path = temporary.path().join(format!("{number}.html"));
                let sources = entry.sources.clone();
                entry.page = Some(page(state, &submission, report, sources, language, path).await?);
                steps.done();
            }
        }
    }
    let made =
        tokio::task::spawn_blocking(move || written(&class, format, sheet.as_deref(), &temporary.path().join("out")));
    let made = made.await.map_err(|panic| Problem::internal(&panic))?;
    made.map_err(|fault| Problem::of_fault(&fault))
}

/// One student of a class, with what stands for them.
struct Member {
    student: Student,
    path: Option<String>,
    stored: Option<Stored>,
    hand_in: HandIn,
    note: Option<Text>,
}

async fn members(state: &State, whose: Whose) -> Result<(String, Vec<Refused>, Vec<Member>), Problem> {
    match whose {
        Whose::Batch(batch) => {
            let mut members = Vec::new();
            for entry in state.store.batch_entries(&batch.id).await? {
                let (stored, hand_in) = with_files(state, entry.submission_id.as_deref()).await?;
                members.push(Member { student: entry.student, path: entry.path, stored, hand_in, note: entry.note });
            }
            Ok((batch.title, batch.refused, members))
        }
        Whose::Students(pick) => {
            let mut members: Vec<Member> = Vec::new();
            let mut keys = HashSet::new();
            for person in people(state).await?.class {
                let chosen = chosen(&person, pick).or(person.rows.first());
                let (stored, hand_in) = with_files(state, chosen.map(|row| row.row.submission.id.as_str())).await?;
                let path = stored.as_ref().map(|stored| stored.submission.name.clone());
                let student = student(person.number, person.name, person.moodle, &person.key, &mut keys);
                members.push(Member { student, path, stored, hand_in, note: person.note });
            }
            members.sort_by(|a, b| a.student.key.cmp(&b.student.key));
            Ok((state.assignment.id.clone(), Vec::new(), members))
        }
    }
}

/// Somebody of the class as files name them; who has no number is told apart by a part of what is known of them.
fn student(
    number: String,
    name: String,
    moodle: Option<Participant>,
    key: &str,
    keys: &mut HashSet<String>,
) -> Student {
    let known = if number.is_empty() { format!("browser-{}", key.chars().take(8).collect::<String>()) } else { number };
    let name = if name.is_empty() { known.clone() } else { name };
    let mut key = known.clone();
    for time in 2.. {
        if keys.insert(key.to_ascii_lowercase()) {
            break;
        }
        key = format!("{known}.{time}");
    }
    Student { key, name, moodle }
}

/// The submission that counts.
fn chosen(person: &Person, pick: Pick) -> Option<&ClassRow> {
    match pick {
        Pick::Latest => person.rows.iter().find(|row| row.row.score.is_some()),
        Pick::Best => person.best(),
    }
}

async fn with_files(state: &State, id: Option<&str>) -> Result<(Option<Stored>, HandIn), Problem> {
    let Some(id) = id else { return Ok((None, HandIn::default())) };
    let Some(stored) = state.store.stored(id).await? else { return Ok((None, HandIn::default())) };
    let hand_in = state.store.hand_in(id).await?.unwrap_or_default();
    Ok((Some(stored), hand_in))
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
        let Member { student, path, stored, hand_in, note } = member;
        let content = match &stored {
            Some(_) => Content::Files { places: places(path, &hand_in), hand_in },
            None => Content::Nothing(note.unwrap_or_else(nobody)),
        };
        outcomes.push(stored.map(outcome));
        hand_ins.push(StudentWork { student, content });
    }
    let candidates = run::candidates(hand_ins, &state.assignment);
    let entries = candidates.iter().zip(outcomes).zip(portraits).map(|((candidate, outcome), portrait)| {
        candidate.entry(outcome.unwrap_or_else(|| candidate.nothing()), portrait, None)
    });
    Ok(Class {
        assignment: Arc::clone(&state.assignment),
        title,
        entries: entries.collect(),
        refused,
        expected_portrait: state.right.portraits()?.expected.clone(),
        language,
    })
}

/// Where the files were: the paths that an archive's list has in one line, or else their names.
fn places(path: Option<String>, hand_in: &HandIn) -> Vec<FileLocation> {
    let names: Vec<&str> = hand_in.files.iter().map(|file| file.name.as_str()).collect();
    let equal = |path| Some(str::split(path, ", ").collect()).filter(|parts: &Vec<&str>| parts.len() == names.len());
    let paths = path.as_deref().and_then(|path| split(path, &names).or_else(|| equal(path)));
    let paths = paths.unwrap_or(names);
    paths.into_iter().map(|path| FileLocation { path: path.to_owned(), local: None }).collect()
}

/// The paths of files with these names, of which [`FileLocation::joined`] has made one line. A folder or a name may have in it what
/// stands between two of them.
fn split<'a>(joined: &'a str, names: &[&str]) -> Option<Vec<&'a str>> {
    let [name, rest @ ..] = names else { return None };
    if rest.is_empty() {
        return Some(vec![joined]);
    }
    let is_named = |path: &str| path.rsplit('/').next() == Some(*name);
    joined.match_indices(", ").find_map(|(end, between)| {
        let path = &joined[..end];
        let further = split(&joined[end + between.len()..], rest).filter(|_| is_named(path))?;
        Some([vec![path], further].concat())
    })
}

fn outcome(stored: Stored) -> Outcome {
    match (stored.report, stored.submission.fault) {
        (Some(report), _) => Outcome::Graded(Box::new(report)),
        (None, Some(fault)) => Outcome::Fault(fault),
        (None, None) => Outcome::NotGraded(Text::new("not graded yet", "まだ採点していません")),
    }
}

/// Writes a student's report as a page with its pictures; where that is. `sources` are its files as far as a report shows them.
async fn page(
    state: &State,
    submission: &Submission,
    report: &Report,
    sources: Vec<Source>,
    language: Language,
    path: PathBuf,
) -> Result<PathBuf, Problem> {
    let mut frames = state.gallery.decoded(state, submission).await?;
    let report = report.clone();
    let write = move |state: &State| {
        let page = Pages::new(Arc::clone(&state.assignment), language).page(&report, &sources, &mut frames)?;
        std::fs::write(&path, page).map_err(|error| disk(&error))?;
        Ok(path)
    };
    blocking(state, write).await
}

/// Writes a format into a folder, and takes its file from there, or all its files as a ZIP.
fn written(class: &Class, format: Format, sheet: Option<&[u8]>, path: &Path) -> Result<Download, Fault> {
    let folder = match Folder::open(path) {
        Ok(folder) => folder,
        Err(NotOpened::Fault(fault)) => return Err(fault),
        Err(NotOpened::InUse) => return Err(Fault::new(Text::verbatim("a new folder is in use"))),
    };
    let (Written { notes, .. }, fault) = output::write(class, &[format], sheet, None, &folder);
    if let Some(fault) = fault {
        return Err(fault);
    }
    let pages: Vec<&Entry> = class.entries.iter().filter(|entry| entry.page.is_some()).collect();
    if format == Format::Html && !pages.is_empty() {
        // Where the class page links to.
        let folder = path.join("students");
        std::fs::create_dir_all(&folder).map_err(|error| disk(&error))?;
        for entry in pages {
            let to = folder.join(format!("{}.html", entry.student.key));
            std::fs::copy(entry.page.as_deref().unwrap_or(path), to).map_err(|error| disk(&error))?;
        }
        let bytes = zipped(path).map_err(|error| disk(&error))?;
        return Ok(Download { name: format!("{}.zip", format.id()), bytes, notes });
    }
    match format.files() {
        [file] if !file.contains(KEY) => {
            let bytes = std::fs::read(folder.at(file)).map_err(|error| disk(&error))?;
            Ok(Download { name: (*file).to_owned(), bytes, notes })
        }
        _ => {
            let bytes = zipped(path).map_err(|error| disk(&error))?;
            Ok(Download { name: format!("{}.zip", format.id()), bytes, notes })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_in::HandedInFile;

    #[test]
    fn each_file_has_its_own_path_whatever_its_folder_is_called() {
        let found = |path: Option<&str>, names: &[&str]| {
            let files = names.iter().map(|name| HandedInFile::new(*name, "")).collect();
            places(path.map(str::to_owned), &HandIn { files }).into_iter().map(|place| place.path).collect::<Vec<_>>()
        };
        let both = ["a.vert", "a.frag"];
        assert_eq!(found(Some("S1/a.vert, S1/a.frag"), &both), ["S1/a.vert", "S1/a.frag"]);
        assert_eq!(
            found(Some("Smith, Ann_1/a.vert, Smith, Ann_1/a.frag"), &both),
            ["Smith, Ann_1/a.vert", "Smith, Ann_1/a.frag"]
        );
        assert_eq!(found(Some("x, y.vert, a.frag"), &["x, y.vert", "a.frag"]), ["x, y.vert", "a.frag"]);
        assert_eq!(found(Some("Smith, Ann/a.vert"), &both[..1]), ["Smith, Ann/a.vert"]);
        // Two files of one name are stored under those of their slots.
        assert_eq!(found(Some("S1/a/x.txt, S1/b/x.txt"), &both), ["S1/a/x.txt", "S1/b/x.txt"]);
        assert_eq!(found(None, &both), both);
    }
}
