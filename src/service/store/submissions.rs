//! What was handed in.

use super::keys::keep_key;
use super::rows::{submission_columns, word};
use super::senders::{HOLD, Sender, TAKE_TURN};
use super::{Priority, Result, Store, StoredKey, Submission, Via, on, signed};
use crate::hand_in::{HandIn, HandedInFile};
use crate::report::{Hints, Report, Verdict};
use crate::service::clock::Millis;

/// A hand-in to be stored.
#[derive(Clone, Debug)]
pub struct NewSubmission {
    /// Its id, from [`crate::service::identity::new_id`].
    pub id: String,
    /// Id of the assignment.
    pub assignment: String,
    /// Its files, in the order of the homework; at least one.
    pub hand_in: HandIn,
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
    /// What it waits behind.
    pub priority: Priority,
    /// With whose files it takes turns among those of the same priority: nobody's, where it is graded in the order of arrival.
    /// The first of them is suspected where it has to be stopped.
    pub senders: Vec<Sender>,
    /// How many attempts the first of the senders has in all; none: any number.
    pub most_attempts: Option<u64>,
}

/// What became of a hand-in that was to be stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Added {
    /// It is stored, and is never lost.
    Stored,
    /// Nothing is stored: the key of the request is taken.
    KeyTaken,
    /// Nothing is stored: all attempts are used up.
    NoAttemptLeft,
}

/// The statement that counts the attempts of a student, or of a browser where nobody said who sits there, and their id for it.
/// Drafts and teachers' batches are no attempts.
fn attempts_of<'a>(owner_id: &'a str, student_id: Option<&'a str>) -> (&'static str, &'a str) {
    const STUDENT: &str = "SELECT count(*) FROM submissions \
                           WHERE assignment = $1 AND student_id = $2 AND via NOT IN ('editor', 'batch')";
    const OWNER: &str = "SELECT count(*) FROM submissions \
                         WHERE assignment = $1 AND owner_id = $2 AND via NOT IN ('editor', 'batch')";
    student_id.map_or((OWNER, owner_id), |id| (STUDENT, id))
}

pub(super) const INSERT_UPLOAD: &str =
    "INSERT INTO uploads (sha256, bytes) VALUES ($1, $2) ON CONFLICT (sha256) DO NOTHING";
pub(super) const INSERT: &str = "INSERT INTO submissions (id, assignment, sha256, digest, name, owner_id, student_id, \
                                 batch_id, via, seed, hints, received_at, state, tries, priority, turn, sender, \
                                 claimed_until) VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, $13, 0, \
                                 $14, $15, $16, 0)";
pub(super) const INSERT_FILE: &str =
    "INSERT INTO submission_files (submission_id, position, name, sha256) VALUES ($1, $2, $3, $4)";

/// Stores a submission with its files.
macro_rules! insert_submission {
    ($transaction:expr, $new:expr, $turn:expr, $state:expr) => {{
        use $crate::service::store::submissions::{INSERT, INSERT_FILE, INSERT_UPLOAD};
        let files = &$new.hand_in.files;
        for file in files {
            sqlx::query(INSERT_UPLOAD).bind(file.sha256()).bind(&file.bytes).execute(&mut *$transaction).await?;
        }
        sqlx::query(INSERT)
            .bind(&$new.id)
            .bind(&$new.assignment)
            .bind(files.first().map(|file| file.sha256()))
            .bind($new.hand_in.sha256())
            .bind($new.hand_in.names())
            .bind(&$new.owner_id)
            .bind(&$new.student_id)
            .bind(&$new.batch_id)
            .bind($crate::service::store::rows::word(&$new.via))
            .bind($crate::service::store::signed($new.seed))
            .bind($crate::service::store::rows::word(&$new.hints))
            .bind($new.received_at)
            .bind($state)
            .bind($new.priority as i64)
            .bind($turn)
            .bind($new.senders.first().map($crate::service::store::Sender::key))
            .execute(&mut *$transaction)
            .await?;
        for (file, position) in files.iter().zip(0_i64..) {
            sqlx::query(INSERT_FILE)
                .bind(&$new.id)
                .bind(position)
                .bind(&file.name)
                .bind(file.sha256())
                .execute(&mut *$transaction)
                .await?;
        }
    }};
}
pub(super) use insert_submission;

/// Ends the function that this stands in, with nothing stored, where all attempts are used up. Whoever sends as the same one
/// at the same time waits, so that nobody counts before the other has stored.
macro_rules! check_attempts {
    ($transaction:expr, $new:expr) => {
        if let Some(most) = $new.most_attempts {
            if let Some(sender) = $new.senders.first() {
                sqlx::query(HOLD).bind(sender.key()).execute(&mut *$transaction).await?;
            }
            let (count, id) = attempts_of($new.owner_id.as_deref().unwrap_or_default(), $new.student_id.as_deref());
            let made: i64 =
                sqlx::query_scalar(count).bind(&$new.assignment).bind(id).fetch_one(&mut *$transaction).await?;
            if made.unsigned_abs() >= most {
                $transaction.rollback().await?;
                return Ok(Added::NoAttemptLeft);
            }
        }
    };
}

impl Store {
    /// Stores a hand-in.
    pub async fn add_submission(&self, new: &NewSubmission, key: Option<&StoredKey>) -> Result<Added> {
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            check_attempts!(transaction, new);
            let mut turn = new.received_at;
            for sender in &new.senders {
                let own: Millis = sqlx::query_scalar(TAKE_TURN)
                    .bind(sender.key())
                    .bind(new.received_at)
                    .bind(sender.cost())
                    .fetch_one(&mut *transaction)
                    .await?;
                turn = turn.max(own);
            }
            insert_submission!(transaction, new, turn, "queued");
            keep_key!(transaction, key, Some(&new.id), None, new.received_at, Added::KeyTaken);
            transaction.commit().await?;
        });
        Ok(Added::Stored)
    }

    /// Stores a hand-in together with its report, which is known already.
    pub async fn add_graded(
        &self,
        new: &NewSubmission,
        key: Option<&StoredKey>,
        report: &Report,
        graded_at: Millis,
    ) -> Result<Added> {
        let row = super::reports::ReportRow::of(report)?;
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            check_attempts!(transaction, new);
            insert_submission!(transaction, new, new.received_at, "graded");
            super::reports::bind_report!(sqlx::query(super::reports::INSERT), &new.id, graded_at, row, 1_i64)
                .execute(&mut *transaction)
                .await?;
            keep_key!(transaction, key, Some(&new.id), None, new.received_at, Added::KeyTaken);
            transaction.commit().await?;
        });
        Ok(Added::Stored)
    }

    /// The submission with this id.
    pub async fn submission(&self, id: &str) -> Result<Option<Submission>> {
        const SQL: &str = concat!("SELECT ", submission_columns!(), " FROM submissions s WHERE s.id = $1");
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?))
    }

    /// The files of a submission, in the order of the homework; none where there is no such submission.
    pub async fn hand_in(&self, id: &str) -> Result<Option<HandIn>> {
        const SQL: &str = "SELECT f.name, u.bytes FROM submission_files f JOIN uploads u ON u.sha256 = f.sha256 \
                           WHERE f.submission_id = $1 ORDER BY f.position";
        let rows: Vec<(String, Vec<u8>)> = on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_all(db).await?);
        let files = rows.into_iter().map(|(name, bytes)| HandedInFile { name, bytes });
        let hand_in = HandIn { files: files.collect() };
        Ok(Some(hand_in).filter(|hand_in| !hand_in.files.is_empty()))
    }

    /// Whether a file is kept, by the SHA-256 of its bytes.
    pub async fn has_file(&self, sha256: &str) -> Result<bool> {
        const SQL: &str = "SELECT count(*) FROM uploads WHERE sha256 = $1";
        let count: i64 = on!(&self.read, db => sqlx::query_scalar(SQL).bind(sha256).fetch_one(db).await?);
        Ok(count > 0)
    }

    /// How often somebody has handed in: a student, or a browser where nobody said who sits there.
    pub async fn attempts(&self, assignment: &str, owner_id: &str, student_id: Option<&str>) -> Result<u64> {
        let (sql, id) = attempts_of(owner_id, student_id);
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

    /// Lets a submission count where those count that are chosen.
    pub async fn choose(&self, id: &str, now: Millis) -> Result<()> {
        const SQL: &str = "UPDATE submissions SET chosen_at = $2 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).bind(now).execute(db).await?; });
        Ok(())
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

    /// A report of the very same files, graded in the very same way by this version, where there is one. What was
    /// stopped once is graded anew, because the machine may have been busy. What was stopped twice is known.
    pub async fn known_report(
        &self,
        assignment: &str,
        sha256: &str,
        seed: u64,
        hints: Hints,
    ) -> Result<Option<Report>> {
        const SQL: &str = "SELECT r.report FROM submissions s JOIN reports r ON r.submission_id = s.id \
                           WHERE s.digest = $1 AND s.assignment = $2 AND s.seed = $3 AND s.hints = $4 \
                           AND r.ggrade = $5 AND (r.verdict <> 'stopped' OR r.reused = 0) \
                           ORDER BY r.verdict = 'stopped' LIMIT 2";
        let found: Vec<String> = on!(&self.read, db => {
            sqlx::query_scalar(SQL)
                .bind(sha256)
                .bind(assignment)
                .bind(signed(seed))
                .bind(word(&hints))
                .bind(env!("CARGO_PKG_VERSION"))
                .fetch_all(db)
                .await?
        });
        let Some(json) = found.first() else { return Ok(None) };
        let report: Report = serde_json::from_str(json)?;
        let is_known = report.verdict != Verdict::Stopped || found.len() > 1;
        Ok(Some(report).filter(|_| is_known))
    }
}
