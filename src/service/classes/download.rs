//! A class in a format of `ggrade batch`.

mod archive;
mod members;
mod participants;
mod written;

pub use archive::archive;

use crate::class::formats::{ClassFormat, worksheet};
use crate::class::output;
use crate::class::{Class, Outcome};
use crate::language::{Language, Text};
use crate::service::State;
use crate::service::blocking::{aside, blocking};
use crate::service::errors::Problem;
use crate::service::store::Batch;
use members::{class, members};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use written::{disk, page, written};

/// What a download is made of.
#[derive(Clone, Debug)]
pub enum DownloadSelection {
    /// A batch.
    Batch(Batch),
    /// Everyone of the class, with one submission of each.
    Students(Pick),
}

/// Which of a student's submissions counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Pick {
    /// The one that counts by the rules of the homework.
    #[default]
    Counted,
    /// The one with most points after what lateness takes off; of equals the earliest.
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
    format: ClassFormat,
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
pub fn is_slow(format: ClassFormat) -> bool {
    let wants = output::wants(&[format]);
    wants.pages || wants.portraits
}

/// What a download shall be.
#[derive(Debug)]
pub struct DownloadOptions {
    /// The format.
    pub format: ClassFormat,
    /// Moodle's worksheet, which one format fills in and another takes the members of groups from.
    pub sheet: Option<Vec<u8>>,
    /// The language of its words.
    pub language: Language,
    /// Whether the class page comes with everyone's own page, as a ZIP; alone it links to none.
    pub with_pages: bool,
}

impl DownloadOptions {
    /// Whether it can be made: a worksheet is there where one is needed, and can be read.
    pub fn check(&self) -> Result<(), Problem> {
        match &self.sheet {
            Some(sheet) => {
                worksheet::check(sheet).map_err(|fault| Problem::unprocessable(fault.message.en, fault.message.ja))
            }
            None if self.format == ClassFormat::MoodleWorksheet => Err(Problem::unprocessable(
                "This format fills in the worksheet that Moodle gives: send that CSV file along.",
                "この形式は Moodle のワークシートに記入するものです。Moodle からダウンロードした CSV を送ってください。",
            )),
            None => Ok(()),
        }
    }
}

/// Whether Moodle would give no report of the class to anybody.
fn has_no_recipient(class: &Class, sheet: Option<&[u8]>) -> Result<bool, Problem> {
    let recipients = output::recipients(class, sheet).map_err(|fault| Problem::of_fault(&fault))?;
    Ok(recipients.is_empty())
}

/// The refusal of an archive of reports that would be empty.
fn no_recipient(has_sheet: bool) -> Problem {
    match has_sheet {
        true => Problem::unprocessable(
            "Nobody of the class is in this worksheet, so that there is no feedback to give. Is it of the same course, and does the roster have its names or numbers?",
            "このワークシートにクラスの学生がいないため、渡すフィードバックがありません。同じ授業のワークシートか、氏名または番号が名簿と一致しているか確認してください。",
        ),
        false => Problem::unprocessable(
            "No participant of Moodle is known for anybody, so that there is no feedback to give. Send Moodle's grading worksheet along: it says who they are.",
            "Moodle の参加者が分からないため、渡すフィードバックがありません。Moodle の評定ワークシートを一緒に送ってください。",
        ),
    }
}

/// A class in one of the formats. Formats of several files come as a ZIP.
pub async fn download(
    state: &State,
    whose: DownloadSelection,
    wanted: DownloadOptions,
    steps: &Arc<Steps>,
) -> Result<Download, Problem> {
    wanted.check()?;
    let DownloadOptions { format, sheet, language, with_pages } = wanted;
    let (title, refused, members) = members(state, whose, sheet.as_deref()).await?;
    let submissions: Vec<_> =
        members.iter().map(|member| member.stored.as_ref().map(|stored| stored.submission.clone())).collect();
    let wants = output::wants(&[format]);
    let has_pages = wants.pages && (with_pages || format != ClassFormat::Html);
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
    if format == ClassFormat::MoodleFeedback && has_no_recipient(&class, sheet.as_deref())? {
        return Err(no_recipient(sheet.is_some()));
    }
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
    let made = aside(move || written(&class, format, sheet.as_deref(), &temporary.path().join("out"))).await?;
    made.map_err(|fault| Problem::of_fault(&fault))
}
