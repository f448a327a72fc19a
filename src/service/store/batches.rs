//! Whole classes that a teacher uploaded.

use super::keys::keep_key;
use super::submissions::insert_submission;
use super::{NewSubmission, Result, Store, StoredKey, on};
use crate::intake::{Refused, Student};
use crate::language::Text;
use crate::service::clock::Millis;

/// A teacher's upload.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// Id.
    pub id: String,
    /// Id of the assignment.
    pub assignment: String,
    /// Name of the archive. Untrusted.
    pub title: String,
    /// What was left out.
    pub refused: Vec<Refused>,
    /// When it came.
    pub created_at: Millis,
}

/// One student of a batch.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchEntry {
    /// Place in the order of the input.
    pub position: i64,
    /// Who, as the archive names them.
    pub student: Student,
    /// Where the file was in the archive.
    pub path: Option<String>,
    /// The submission, where there was something to grade.
    pub submission_id: Option<String>,
    /// Why there was nothing to grade, where there was not.
    pub note: Option<Text>,
    /// Who of the roster that is, where it is one of them.
    pub student_id: Option<String>,
}

/// How far a batch is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, utoipa::ToSchema)]
pub struct Progress {
    /// Students of the batch.
    pub entries: u64,
    /// Files to grade.
    pub files: u64,
    /// Graded files.
    pub graded: u64,
    /// Files that failed by our fault.
    pub failed: u64,
}

impl Progress {
    /// The progress of files counted by state.
    pub(super) fn of(states: &[(String, i64)]) -> Self {
        let of = |state: &str| {
            states.iter().filter(|(name, _)| name == state).map(|(_, count)| count.unsigned_abs()).sum::<u64>()
        };
        let files = states.iter().map(|(_, count)| count.unsigned_abs()).sum();
        Self { entries: files, files, graded: of("graded"), failed: of("failed") }
    }

    /// Whether nothing is left to do.
    pub fn is_done(&self) -> bool {
        self.graded + self.failed >= self.files
    }
}

type BatchRow = (String, String, String, String, i64);

impl Batch {
    fn of((id, assignment, title, refused, created_at): BatchRow) -> Result<Self> {
        Ok(Self { id, assignment, title, refused: serde_json::from_str(&refused)?, created_at })
    }
}

impl Store {
    /// Stores a batch with all its files, or nothing of it. False, with nothing stored, where the request's key is taken.
    pub async fn add_batch(
        &self,
        batch: &Batch,
        entries: &[BatchEntry],
        files: &[NewSubmission],
        key: Option<&StoredKey>,
    ) -> Result<bool> {
        const BATCH: &str =
            "INSERT INTO batches (id, assignment, title, refused, created_at) VALUES ($1, $2, $3, $4, $5)";
        const ENTRY: &str = "INSERT INTO batch_entries (batch_id, position, student, path, submission_id, note, \
                             student_id) VALUES ($1, $2, $3, $4, $5, $6, $7)";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(BATCH)
                .bind(&batch.id)
                .bind(&batch.assignment)
                .bind(&batch.title)
                .bind(serde_json::to_string(&batch.refused)?)
                .bind(batch.created_at)
                .execute(&mut *transaction)
                .await?;
            keep_key!(transaction, key, None, Some(&batch.id), batch.created_at, false);
            for new in files {
                insert_submission!(transaction, new, new.received_at, "queued");
            }
            for entry in entries {
                sqlx::query(ENTRY)
                    .bind(&batch.id)
                    .bind(entry.position)
                    .bind(serde_json::to_string(&entry.student)?)
                    .bind(&entry.path)
                    .bind(&entry.submission_id)
                    .bind(entry.note.as_ref().map(serde_json::to_string).transpose()?)
                    .bind(&entry.student_id)
                    .execute(&mut *transaction)
                    .await?;
            }
            transaction.commit().await?;
        });
        Ok(true)
    }

    /// The batch with this id.
    pub async fn batch(&self, id: &str) -> Result<Option<Batch>> {
        const SQL: &str = "SELECT id, assignment, title, refused, created_at FROM batches WHERE id = $1";
        let row: Option<BatchRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?);
        row.map(Batch::of).transpose()
    }

    /// Every batch of an assignment, the newest first.
    pub async fn batches(&self, assignment: &str) -> Result<Vec<Batch>> {
        const SQL: &str = "SELECT id, assignment, title, refused, created_at FROM batches WHERE assignment = $1 \
                           ORDER BY created_at DESC, id";
        let rows: Vec<BatchRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).fetch_all(db).await?);
        rows.into_iter().map(Batch::of).collect()
    }

    /// Every batch of every assignment.
    pub async fn all_batches(&self) -> Result<Vec<Batch>> {
        const SQL: &str = "SELECT id, assignment, title, refused, created_at FROM batches ORDER BY created_at DESC, id";
        let rows: Vec<BatchRow> = on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?);
        rows.into_iter().map(Batch::of).collect()
    }

    /// Everyone of a batch, in the order of the input.
    pub async fn batch_entries(&self, id: &str) -> Result<Vec<BatchEntry>> {
        const SQL: &str = "SELECT position, student, path, submission_id, note, student_id FROM batch_entries \
                           WHERE batch_id = $1 ORDER BY position";
        type EntryRow = (i64, String, Option<String>, Option<String>, Option<String>, Option<String>);
        let rows: Vec<EntryRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_all(db).await?);
        let entry = |(position, student, path, submission_id, note, student_id): EntryRow| {
            Ok(BatchEntry {
                position,
                student: serde_json::from_str(&student)?,
                path,
                submission_id,
                note: note.map(|json| serde_json::from_str(&json)).transpose()?,
                student_id,
            })
        };
        rows.into_iter().map(entry).collect()
    }

    /// How far a batch is.
    pub async fn progress(&self, id: &str) -> Result<Progress> {
        const ENTRIES: &str = "SELECT count(*) FROM batch_entries WHERE batch_id = $1";
        const FILES: &str = "SELECT state, count(*) FROM submissions WHERE batch_id = $1 GROUP BY state";
        let entries: i64 = on!(&self.read, db => sqlx::query_scalar(ENTRIES).bind(id).fetch_one(db).await?);
        let states: Vec<(String, i64)> = on!(&self.read, db => sqlx::query_as(FILES).bind(id).fetch_all(db).await?);
        Ok(Progress { entries: entries.unsigned_abs(), ..Progress::of(&states) })
    }
}
