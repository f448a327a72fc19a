//! Files that were handed in.

use super::keys::keep_key;
use super::rows::{submission_columns, word};
use super::{Key, Result, Store, Submission, Via, on, signed};
use crate::diagnose::Hints;
use crate::report::Report;
use crate::service::clock::Millis;

/// A file to be stored.
#[derive(Clone, Debug)]
pub struct NewSubmission {
    /// Its id, from [`crate::service::identity::new_id`].
    pub id: String,
    /// Id of the assignment.
    pub assignment: String,
    /// SHA-256 of the bytes in hexadecimal.
    pub sha256: String,
    /// The bytes.
    pub bytes: Vec<u8>,
    /// File name as handed in.
    pub name: String,
    /// The browser.
    pub owner_id: Option<String>,
    /// The student.
    pub student_id: Option<String>,
    /// The batch.
    pub batch_id: Option<String>,
    /// The way by which it came.
    pub via: Via,
    /// Seed of its fresh probes.
    pub seed: u64,
    /// How much its messages help.
    pub hints: Hints,
    /// When it came.
    pub received_at: Millis,
    /// Smaller is graded sooner.
    pub priority: i64,
    /// Who grades it at once, and until when nobody else does.
    pub claim: Option<(String, Millis)>,
}

pub(super) const INSERT_UPLOAD: &str =
    "INSERT INTO uploads (sha256, bytes) VALUES ($1, $2) ON CONFLICT (sha256) DO NOTHING";
pub(super) const INSERT: &str = "INSERT INTO submissions (id, assignment, sha256, name, owner_id, student_id, batch_id, \
                                 via, seed, hints, received_at, state, tries, priority, claimed_by, claimed_until) \
                                 VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, 0, $13, $14, $15)";

/// Binds a new submission to [`INSERT`].
macro_rules! bind_submission {
    ($query:expr, $new:expr, $state:expr) => {{
        let (claimed_by, claimed_until) = match &$new.claim {
            Some((by, until)) => (Some(by.as_str()), *until),
            None => (None, 0),
        };
        $query
            .bind(&$new.id)
            .bind(&$new.assignment)
            .bind(&$new.sha256)
            .bind(&$new.name)
            .bind(&$new.owner_id)
            .bind(&$new.student_id)
            .bind(&$new.batch_id)
            .bind($crate::service::store::rows::word(&$new.via))
            .bind($crate::service::store::signed($new.seed))
            .bind($crate::service::store::rows::word(&$new.hints))
            .bind($new.received_at)
            .bind($state)
            .bind($new.priority)
            .bind(claimed_by)
            .bind(claimed_until)
    }};
}
pub(super) use bind_submission;

impl Store {
    /// Stores a file. When this is done, it is never lost. False, with nothing stored, where the request's key is taken.
    pub async fn add_submission(&self, new: &NewSubmission, key: Option<&Key>) -> Result<bool> {
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(INSERT_UPLOAD).bind(&new.sha256).bind(&new.bytes).execute(&mut *transaction).await?;
            bind_submission!(sqlx::query(INSERT), new, "queued").execute(&mut *transaction).await?;
            keep_key!(transaction, key, Some(&new.id), None, new.received_at);
            transaction.commit().await?;
        });
        Ok(true)
    }

    /// Stores a file together with its report, which is known already. False, with nothing stored, where the request's key
    /// is taken.
    pub async fn add_graded(
        &self,
        new: &NewSubmission,
        key: Option<&Key>,
        report: &Report,
        graded_at: Millis,
    ) -> Result<bool> {
        let row = super::reports::ReportRow::of(report)?;
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(INSERT_UPLOAD).bind(&new.sha256).bind(&new.bytes).execute(&mut *transaction).await?;
            bind_submission!(sqlx::query(INSERT), new, "graded").execute(&mut *transaction).await?;
            super::reports::bind_report!(sqlx::query(super::reports::INSERT), &new.id, graded_at, row, 1_i64)
                .execute(&mut *transaction)
                .await?;
            keep_key!(transaction, key, Some(&new.id), None, new.received_at);
            transaction.commit().await?;
        });
        Ok(true)
    }

    /// The submission with this id.
    pub async fn submission(&self, id: &str) -> Result<Option<Submission>> {
        const SQL: &str = concat!("SELECT ", submission_columns!(), " FROM submissions s WHERE s.id = $1");
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?))
    }

    /// The bytes of an uploaded file.
    pub async fn upload(&self, sha256: &str) -> Result<Option<Vec<u8>>> {
        const SQL: &str = "SELECT bytes FROM uploads WHERE sha256 = $1";
        Ok(on!(&self.read, db => sqlx::query_scalar(SQL).bind(sha256).fetch_optional(db).await?))
    }

    /// How often somebody has handed in: a student, or a browser where nobody said who sits there. Drafts and teachers'
    /// batches are no attempts.
    pub async fn attempts(&self, assignment: &str, owner_id: &str, student_id: Option<&str>) -> Result<u64> {
        const STUDENT: &str = "SELECT count(*) FROM submissions \
                               WHERE assignment = $1 AND student_id = $2 AND via NOT IN ('editor', 'batch')";
        const OWNER: &str = "SELECT count(*) FROM submissions \
                             WHERE assignment = $1 AND owner_id = $2 AND via NOT IN ('editor', 'batch')";
        let (sql, id) = student_id.map_or((OWNER, owner_id), |id| (STUDENT, id));
        let count: i64 = on!(&self.read, db => sqlx::query_scalar(sql).bind(assignment).bind(id).fetch_one(db).await?);
        Ok(count.unsigned_abs())
    }

    /// Which attempt of its student, or of its browser, a submission is, from 1.
    pub async fn attempt_number(&self, submission: &Submission) -> Result<u64> {
        const SQL: &str = "SELECT count(*) FROM submissions WHERE assignment = $1 AND via NOT IN ('editor', 'batch') \
                           AND (student_id = $2 OR ($2 = '' AND owner_id = $3) OR id = $5) \
                           AND (received_at < $4 OR (received_at = $4 AND id <= $5))";
        let count: i64 = on!(&self.read, db => {
            sqlx::query_scalar(SQL)
                .bind(&submission.assignment)
                .bind(submission.student_id.as_deref().unwrap_or_default())
                .bind(submission.owner_id.as_deref().unwrap_or_default())
                .bind(submission.received_at)
                .bind(&submission.id)
                .fetch_one(db)
                .await?
        });
        Ok(count.unsigned_abs())
    }

    /// How many files wait to be graded, and how many failed.
    pub async fn waiting(&self) -> Result<(u64, u64)> {
        const SQL: &str = "SELECT count(*) FROM submissions WHERE state = $1";
        let mut counts = [0; 2];
        for (count, state) in counts.iter_mut().zip(["queued", "failed"]) {
            let found: i64 = on!(&self.read, db => sqlx::query_scalar(SQL).bind(state).fetch_one(db).await?);
            *count = found.unsigned_abs();
        }
        Ok((counts[0], counts[1]))
    }

    /// A report of the very same file, graded in the very same way by this version, where there is one. A file that was
    /// stopped is graded anew: the machine may have been busy.
    pub async fn known_report(
        &self,
        assignment: &str,
        sha256: &str,
        seed: u64,
        hints: Hints,
    ) -> Result<Option<Report>> {
        const SQL: &str = "SELECT r.report FROM submissions s JOIN reports r ON r.submission_id = s.id \
                           WHERE s.sha256 = $1 AND s.assignment = $2 AND s.seed = $3 AND s.hints = $4 \
                           AND r.ggrade = $5 AND r.verdict <> 'stopped' LIMIT 1";
        let json: Option<String> = on!(&self.read, db => {
            sqlx::query_scalar(SQL)
                .bind(sha256)
                .bind(assignment)
                .bind(signed(seed))
                .bind(word(&hints))
                .bind(env!("CARGO_PKG_VERSION"))
                .fetch_optional(db)
                .await?
        });
        Ok(json.map(|json| serde_json::from_str(&json)).transpose()?)
    }
}
