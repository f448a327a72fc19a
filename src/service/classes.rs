//! Whole classes: who is in the class ([`people`]), a teacher's archive in, a graded class out in any format
//! ([`download`]).

mod download;
mod jobs;
mod people;
mod standing;

pub use download::{Download, DownloadOptions, DownloadSelection, Pick, Steps, archive, download, is_slow, language};
pub use jobs::{DownloadJob, Jobs, Made};
#[cfg(test)]
pub(in crate::service) use people::samples;
pub use people::{People, Person, of_batch, people};
pub use standing::PersonStanding;

use super::State;
use super::errors::Problem;
use super::grading;
use super::idempotency;
use super::identity::new_id;
use super::roster::Matcher;
use super::store::{Batch, BatchEntry, NewSubmission, Priority, StoredKey, Via};
use super::submit::file_name;
use crate::intake::{self, HandInContent, Intake, StudentWork};
use crate::language::Text;
use std::path::PathBuf;
use std::sync::Arc;

/// The title of an archive that came without a name.
const NAMELESS: &str = "archive";

/// Stores a teacher's archive to be graded in the background. `path` is the archive, `title` the name that it came with,
/// `key` that with which it may come again.
pub async fn submit(state: &State, path: PathBuf, title: &str, key: Option<StoredKey>) -> Result<Batch, Problem> {
    let assignment = Arc::clone(&state.assignment);
    if let Some(batch) = stored_earlier(state, key.as_ref()).await? {
        return Ok(batch);
    }
    let title = if title.is_empty() { NAMELESS } else { title }.to_owned();
    let read = tokio::task::spawn_blocking(move || {
        let options = intake::IntakeOptions::new(&assignment);
        intake::read_archive(&path, &title, &options)
    });
    let intake = read.await.map_err(|panic| Problem::internal(&panic))?;
    if intake.hand_ins.is_empty() {
        return Err(nothing(&intake));
    }
    match store(state, intake, key.as_ref()).await? {
        Some(batch) => Ok(batch),
        // The same request was stored meanwhile.
        None => {
            stored_earlier(state, key.as_ref()).await?.ok_or_else(|| Problem::internal(&"a key is taken by nothing"))
        }
    }
}

/// The refusal of an archive with nothing in it: the first thing that was left out says why.
fn nothing(intake: &Intake) -> Problem {
    let mut problem = Problem::unprocessable(
        "There is nothing to grade in this archive. Upload the ZIP that Moodle gives, or one with a folder for each student.",
        "採点できるファイルがありません。Moodle の ZIP、または学生ごとのフォルダを入れた ZIP をアップロードしてください。",
    );
    if let Some(refused) = intake.refused.first() {
        let Text { en, ja } = problem.detail;
        problem.detail = Text::new(format!("{en} ({})", refused.reason.en), format!("{ja} ({})", refused.reason.ja));
    }
    problem
}

/// What an earlier request with this key stored.
async fn stored_earlier(state: &State, key: Option<&StoredKey>) -> Result<Option<Batch>, Problem> {
    let earlier = idempotency::earlier(state, key).await?;
    let Some(id) = earlier.and_then(|earlier| earlier.batch_id) else { return Ok(None) };
    Ok(state.store.batch(&id).await?)
}

/// Stores what was read; none where the request's key is taken.
async fn store(state: &State, intake: Intake, key: Option<&StoredKey>) -> Result<Option<Batch>, Problem> {
    let settings = state.store.assignment(&state.assignment.id).await?;
    let now = state.clock.now();
    let batch = Batch {
        id: new_id(),
        assignment: settings.id.clone(),
        title: intake.title,
        refused: intake.refused,
        created_at: now,
    };
    let mut entries = Vec::new();
    let mut files = Vec::new();
    let matcher = Matcher::new(&state.store.roster().await?);
    let paths: Vec<Option<String>> = intake.hand_ins.iter().map(StudentWork::path).collect();
    let students = intake.hand_ins.iter().map(|hand_in| &hand_in.student);
    let matches = matcher.of_batch(students.zip(paths.iter().map(Option::as_deref)));
    for (((hand_in, student_id), path), position) in intake.hand_ins.into_iter().zip(matches).zip(paths).zip(0..) {
        let student = hand_in.student;
        let mut entry = BatchEntry { position, student, path, submission_id: None, note: None, student_id };
        match hand_in.content {
            HandInContent::Nothing(why) => entry.note = Some(why),
            HandInContent::Files { mut hand_in, .. } => {
                for (file, slot) in hand_in.files.iter_mut().zip(&state.assignment.files) {
                    file.name = file_name(&file.name, Some(slot));
                }
                let id = new_id();
                entry.submission_id = Some(id.clone());
                files.push(NewSubmission {
                    id,
                    assignment: settings.id.clone(),
                    hand_in,
                    owner_id: None,
                    student_id: entry.student_id.clone(),
                    batch_id: Some(batch.id.clone()),
                    via: Via::Batch,
                    seed: settings.seed,
                    hints: settings.hints,
                    received_at: now,
                    priority: Priority::Archive,
                    senders: Vec::new(),
                    most_attempts: None,
                });
            }
        }
        entries.push(entry);
    }
    if !state.store.add_batch(&batch, &entries, &files, key).await? {
        return Ok(None);
    }
    grading::files_wait(state).await;
    Ok(Some(batch))
}
