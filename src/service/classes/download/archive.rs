//! A term as one file that opens without ggrade: of every homework the class page, everyone's feedback page, everything that
//! was handed in, the grades as CSV and JSON; and the gradebook of the course and the log of what teachers did.

use super::members::{class, members, student};
use super::written::{disk, page, zip_into};
use super::{DownloadSelection, Pick, Steps};
use crate::class::formats::plain::cell;
use crate::class::formats::{grades, page as class_page};
use crate::class::{Class, ClassEntry, Outcome};
use crate::fault::Fault;
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Language;
use crate::report::html::BASE_STYLE;
use crate::report::json;
use crate::report::text::number;
use crate::service::State;
use crate::service::blocking::{aside, blocking};
use crate::service::classes::Made;
use crate::service::classes::people::people;
use crate::service::clock::rfc3339;
use crate::service::errors::Problem;
use crate::service::gradebook::{Gradebook, GradebookPerson, rounded};
use crate::service::pages::TimeElement;
use crate::service::store::NamedAct;
use crate::service::{Service, download};
use askama::Template;
use jiff::tz::TimeZone;
use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;

/// The page that the archive opens with.
#[derive(Template)]
#[template(path = "service/classes/download/templates/index.html")]
struct Index {
    language: Language,
    tag: &'static str,
    style: &'static str,
    /// What the course is called, where somebody said.
    course: String,
    at: TimeElement,
    homeworks: Vec<ArchivedHomework>,
    gradebook: ArchivedGradebook,
}

/// Everybody with the points of the course.
struct ArchivedGradebook {
    /// Titles of the homeworks, and what each counts.
    homeworks: Vec<(String, String)>,
    most: String,
    lines: Vec<ArchivedSum>,
}

/// A line of it.
struct ArchivedSum {
    number: String,
    name: String,
    points: Vec<String>,
    total: String,
}

impl Index {
    fn say(&self, en: &'static str, ja: &'static str) -> &'static str {
        match self.language {
            Language::En => en,
            Language::Ja => ja,
        }
    }
}

/// A homework in the archive.
struct ArchivedHomework {
    id: String,
    title: String,
    students: Vec<ArchivedStudent>,
}

/// A student of a homework.
struct ArchivedStudent {
    key: String,
    name: String,
    points: String,
    has_page: bool,
    /// Paths of what they handed in, the oldest first, and when each came.
    files: Vec<(String, TimeElement)>,
}

/// Makes the archive of all homeworks.
pub async fn archive(service: &Service, language: Language, steps: &Arc<Steps>) -> Result<Made, Problem> {
    let folder = tempfile::tempdir().map_err(|error| Problem::of_fault(&disk(&error)))?;
    let course = service.store.course().await?;
    let mut homeworks = Vec::new();
    for state in service.homeworks() {
        homeworks.push(homework(&state, folder.path(), language, course.zone(), steps).await?);
    }
    let (log, book) = (log(service).await?, Gradebook::of(service, language).await?);
    let sums = book.csv()?;
    let index = Index {
        language,
        tag: match language {
            Language::En => "en",
            Language::Ja => "ja",
        },
        style: BASE_STYLE,
        at: TimeElement::zoned(service.clock.now(), language, course.zone()),
        course: course.title,
        homeworks,
        gradebook: gradebook(book),
    };
    let index = index.render().map_err(|error| Problem::internal(&error))?;
    let written = aside(move || {
        std::fs::write(folder.path().join("index.html"), index)?;
        std::fs::write(folder.path().join("gradebook.csv"), sums)?;
        std::fs::write(folder.path().join("log.csv"), log)?;
        let file = tempfile::NamedTempFile::new()?;
        zip_into(folder.path(), file.as_file())?;
        let bytes = file.as_file().metadata()?.len();
        std::io::Result::Ok((file.into_temp_path(), bytes))
    });
    let (path, bytes) = written.await?.map_err(|error| Problem::of_fault(&disk(&error)))?;
    let bytes = usize::try_from(bytes).unwrap_or(usize::MAX);
    Ok(Made { name: "term.zip".to_owned(), path, bytes, notes: Vec::new() })
}

fn gradebook(book: Gradebook) -> ArchivedGradebook {
    let line = |line: &GradebookPerson| ArchivedSum {
        number: line.number.clone(),
        name: line.name.clone(),
        points: line.points.iter().map(|points| points.map_or_else(|| "–".to_owned(), rounded)).collect(),
        total: rounded(line.total()),
    };
    ArchivedGradebook {
        most: rounded(book.most()),
        lines: book.lines.iter().map(line).collect(),
        homeworks: book.homeworks.into_iter().map(|one| (one.title, rounded(one.points))).collect(),
    }
}

/// Writes one homework into its folder.
async fn homework(
    state: &State,
    root: &Path,
    language: Language,
    zone: &TimeZone,
    steps: &Arc<Steps>,
) -> Result<ArchivedHomework, Problem> {
    let id = state.assignment.id.clone();
    let folder = root.join(&id);
    let failed = |error: std::io::Error| Problem::of_fault(&disk(&error));
    std::fs::create_dir_all(folder.join("students")).map_err(failed)?;
    let (title, refused, members) = members(state, DownloadSelection::Students(Pick::Counted), None).await?;
    let submissions: Vec<_> =
        members.iter().map(|member| member.stored.as_ref().map(|stored| stored.submission.clone())).collect();
    steps.expect(2 * submissions.iter().flatten().count());
    let mut portraits = Vec::new();
    for submission in &submissions {
        portraits.push(match submission {
            Some(submission) => {
                let portrait = state.gallery.portrait(state, submission).await?;
                steps.done();
                portrait
            }
            None => None,
        });
    }
    let mut class = blocking(state, move |state| class(state, title, refused, members, portraits, language)).await?;
    for (entry, submission) in class.entries.iter_mut().zip(&submissions) {
        if let (Outcome::Graded(report), Some(submission)) = (&entry.outcome, submission) {
            let path = folder.join(format!("students/{}.html", entry.student.key));
            entry.page = Some(page(state, submission, report, entry.sources.clone(), language, path).await?);
            steps.done();
        }
    }
    let mut listed = Vec::new();
    let mut keys = HashSet::new();
    for person in people(state).await?.class {
        let student = student(person.number, person.name, person.moodle, &person.key, &mut keys);
        let mut files = Vec::new();
        for (place, row) in person.rows.iter().rev().enumerate() {
            let submission = &row.row.submission;
            let into = format!("hand-ins/{}/{:02}", student.key, place + 1);
            std::fs::create_dir_all(folder.join(&into)).map_err(failed)?;
            let hand_in = state.store.hand_in(&submission.id).await?.unwrap_or_default();
            for (name, file) in plain_names(&hand_in).into_iter().zip(&hand_in.files) {
                let path = format!("{into}/{name}");
                std::fs::write(folder.join(&path), &file.bytes).map_err(failed)?;
                files.push((path, TimeElement::zoned(submission.received_at, language, zone)));
            }
            if let Some(report) = state.store.stored(&submission.id).await?.and_then(|stored| stored.report) {
                std::fs::write(folder.join(&into).join("report.json"), json::render(&report, language))
                    .map_err(failed)?;
            }
        }
        let entry = class.entries.iter().find(|entry| entry.student.key == student.key);
        listed.push(ArchivedStudent {
            points: entry.and_then(ClassEntry::report).map(|it| points(it.total(), it.max_score)).unwrap_or_default(),
            has_page: entry.is_some_and(|entry| entry.page.is_some()),
            key: student.key,
            name: student.name,
            files,
        });
    }
    listed.sort_by(|a, b| a.key.cmp(&b.key));
    let title = state.assignment.title.clone();
    let written = blocking(state, move |_| written(&class, &folder));
    written.await?;
    Ok(ArchivedHomework { id, title: language.of(&title).to_owned(), students: listed })
}

/// The names of the files of a hand-in as every system takes them, each another one.
fn plain_names(hand_in: &HandIn) -> Vec<String> {
    let mut taken = HashSet::new();
    let name = |(place, file): (usize, &HandedInFile)| {
        let name = download::plain_name(&file.name);
        if taken.insert(name.to_lowercase()) { name } else { format!("{}-{name}", place + 1) }
    };
    hand_in.files.iter().enumerate().map(name).collect()
}

fn points(total: f64, most: f64) -> String {
    format!("{} / {}", number(total), number(most))
}

/// The class page and the grades.
fn written(class: &Class, folder: &Path) -> Result<(), Fault> {
    for (name, bytes) in [
        ("report.html", class_page::render(class)?),
        ("grades.csv", grades::render(class)?),
        ("grades.json", grades::json(class)?),
    ] {
        std::fs::write(folder.join(name), bytes).map_err(|error| disk(&error))?;
    }
    Ok(())
}

/// The log as CSV, the latest first.
async fn log(service: &Service) -> Result<Vec<u8>, Problem> {
    let count = service.store.count_acts(None).await?;
    let acts = service.store.acts(None, 0, count).await?;
    let row = |act: NamedAct| {
        let at = rfc3339(act.act.at);
        let who = act.login.as_deref().unwrap_or(&act.act.way);
        let (homework, student) = (act.act.assignment.as_deref(), act.number.as_deref());
        let (act, detail) = (act.act.act.as_str(), act.act.detail.as_str());
        [at.as_str(), who, act, homework.unwrap_or_default(), student.unwrap_or_default(), detail].map(cell)
    };
    let heading = ["at", "who", "act", "assignment", "student", "detail"].map(cell);
    download::csv(std::iter::once(heading).chain(acts.into_iter().map(row)))
}
