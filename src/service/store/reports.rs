//! Reports, and the lists that are made of them.

use super::cross_checks::differs;
use super::late::lateness;
use super::rows::{from_word, submission_columns, word};
use super::senders::{SUSPECT, suspected_until};
use super::{Result, Store, Submission, on};
use crate::report::{CrossCheck, Lateness, Report, Verdict};
use crate::service::clock::Millis;

/// A submission with its report, where it has one.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredSubmission {
    /// What was handed in.
    pub submission: Submission,
    /// What came of it, as students see it.
    pub report: Option<Report>,
    /// What the interpreter says of it, for the teacher.
    pub cross_check: Option<CrossCheck>,
}

/// One line of a student's own history.
#[derive(Clone, Debug, PartialEq)]
pub struct HistoryRow {
    /// What was handed in.
    pub submission: Submission,
    /// The verdict, where it is graded.
    pub verdict: Option<Verdict>,
    /// The points.
    pub score: Option<f64>,
    /// The possible points.
    pub max_score: Option<f64>,
    /// How late it came, and what that takes off.
    pub lateness: Option<Lateness>,
    /// When somebody chose that it counts.
    pub chosen_at: Option<Millis>,
}

impl HistoryRow {
    /// The points without what lateness takes off; none where it is not graded.
    pub fn total(&self) -> Option<f64> {
        Some(self.score? - self.lateness.map_or(0.0, |lateness| lateness.penalty))
    }
}

/// One submission as the class table has it.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassRow {
    /// What was handed in, the result, and
    pub row: HistoryRow,
    /// ids of the mistakes,
    pub mistakes: Vec<String>,
    /// student number and
    pub number: Option<String>,
    /// name, where they are known.
    pub student_name: Option<String>,
    /// Whether driver and interpreter disagree on it.
    pub differs: bool,
}

/// A report as its row.
pub(super) struct ReportRow {
    pub verdict: String,
    pub score: f64,
    pub max_score: f64,
    pub mistakes: String,
    pub report: String,
    pub ggrade: String,
}

impl ReportRow {
    pub fn of(report: &Report) -> Result<Self> {
        Ok(Self {
            verdict: word(&report.verdict),
            score: report.score,
            max_score: report.max_score,
            mistakes: serde_json::to_string(&report.mistakes)?,
            report: serde_json::to_string(report)?,
            ggrade: env!("CARGO_PKG_VERSION").into(),
        })
    }
}

/// Does nothing where there is a report already: the first one stands.
pub(super) const INSERT: &str = "INSERT INTO reports (submission_id, graded_at, verdict, score, max_score, mistakes, \
                                 report, ggrade, reused) VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9) \
                                 ON CONFLICT (submission_id) DO NOTHING";

/// Binds a report to [`INSERT`].
macro_rules! bind_report {
    ($query:expr, $id:expr, $graded_at:expr, $row:expr, $reused:expr) => {
        $query
            .bind($id)
            .bind($graded_at)
            .bind(&$row.verdict)
            .bind($row.score)
            .bind($row.max_score)
            .bind(&$row.mistakes)
            .bind(&$row.report)
            .bind(&$row.ggrade)
            .bind($reused)
    };
}
pub(super) use bind_report;

impl<'r, R: sqlx::Row> sqlx::FromRow<'r, R> for HistoryRow
where
    Submission: sqlx::FromRow<'r, R>,
    &'static str: sqlx::ColumnIndex<R>,
    Option<String>: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    i64: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    Option<i64>: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    f64: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    Option<f64>: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
{
    fn from_row(row: &'r R) -> std::result::Result<Self, sqlx::Error> {
        let verdict: Option<String> = row.try_get("verdict")?;
        Ok(Self {
            submission: Submission::from_row(row)?,
            verdict: verdict.map(from_word).transpose()?,
            score: row.try_get("score")?,
            max_score: row.try_get("max_score")?,
            lateness: lateness(row.try_get("late")?, row.try_get("penalty")?),
            chosen_at: row.try_get("chosen_at")?,
        })
    }
}

impl<'r, R: sqlx::Row> sqlx::FromRow<'r, R> for ClassRow
where
    HistoryRow: sqlx::FromRow<'r, R>,
    &'static str: sqlx::ColumnIndex<R>,
    i64: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    Option<String>: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
{
    fn from_row(row: &'r R) -> std::result::Result<Self, sqlx::Error> {
        let mistakes: Option<String> = row.try_get("mistakes")?;
        let mistakes = mistakes.map(|json| serde_json::from_str(&json)).transpose();
        Ok(Self {
            row: HistoryRow::from_row(row)?,
            mistakes: mistakes.map_err(|error| sqlx::Error::Decode(Box::new(error)))?.unwrap_or_default(),
            number: row.try_get("number")?,
            student_name: row.try_get("student_name")?,
            differs: row.try_get::<i64, _>("differs")? > 0,
        })
    }
}

impl Store {
    /// A submission with its report, and what people judge in it.
    pub async fn stored(&self, id: &str) -> Result<Option<StoredSubmission>> {
        const SQL: &str = "SELECT report FROM reports WHERE submission_id = $1";
        let Some(submission) = self.submission(id).await? else { return Ok(None) };
        let json: Option<String> = on!(&self.read, db => sqlx::query_scalar(SQL).bind(id).fetch_optional(db).await?);
        let mut report: Option<Report> = json.map(|json| serde_json::from_str(&json)).transpose()?;
        if let Some(report) = &mut report {
            // Reports of 0.1.0 do not say how much they help; their submissions do.
            report.hints = report.hints.min(submission.hints);
            self.judge(id, report).await?;
            report.lateness = self.lateness(id).await?;
        }
        let cross_check = report.as_mut().and_then(|report| report.cross_check.take());
        Ok(Some(StoredSubmission { submission, report, cross_check }))
    }

    /// Whether a submission's report has pictures: whether the file could be drawn to the end.
    pub async fn is_drawn(&self, id: &str) -> Result<bool> {
        const SQL: &str = "SELECT verdict FROM reports WHERE submission_id = $1";
        let verdict: Option<String> = on!(&self.read, db => sqlx::query_scalar(SQL).bind(id).fetch_optional(db).await?);
        let verdict: Option<Verdict> = verdict.map(from_word).transpose()?;
        Ok(verdict.is_some_and(Verdict::is_drawn))
    }

    /// What a browser has handed in for an assignment, the newest first; drafts are left out.
    pub async fn history(
        &self,
        assignment: &str,
        owner_id: &str,
        student_id: Option<&str>,
        limit: u32,
    ) -> Result<Vec<HistoryRow>> {
        const SQL: &str = concat!(
            "SELECT ",
            submission_columns!(),
            ", r.verdict, r.score, r.max_score, l.late, l.penalty, s.chosen_at FROM submissions s \
             JOIN lateness l ON l.submission_id = s.id LEFT JOIN reports r ON r.submission_id = s.id \
             WHERE s.assignment = $1 AND (s.owner_id = $2 OR (s.student_id = $3 AND s.via <> 'batch')) \
             AND s.via <> 'editor' ORDER BY s.received_at DESC, s.id LIMIT $4"
        );
        Ok(on!(&self.read, db => {
            sqlx::query_as(SQL)
                .bind(assignment)
                .bind(owner_id)
                .bind(student_id.unwrap_or_default())
                .bind(i64::from(limit))
                .fetch_all(db)
                .await?
        }))
    }

    /// Everything handed in for an assignment, the newest first; drafts are left out. `batch` takes one batch only.
    pub async fn class(&self, assignment: &str, batch: Option<&str>) -> Result<Vec<ClassRow>> {
        const SQL: &str = concat!(
            "SELECT ",
            submission_columns!(),
            ", r.verdict, r.score, r.max_score, l.late, l.penalty, s.chosen_at, r.mistakes, t.number, \
             t.name AS student_name, CAST(CASE WHEN ",
            differs!("r.report"),
            " THEN 1 ELSE 0 END AS BIGINT) AS differs \
             FROM submissions s JOIN lateness l ON l.submission_id = s.id LEFT JOIN reports r ON r.submission_id = s.id \
             LEFT JOIN students t ON t.id = s.student_id \
             WHERE s.assignment = $1 AND s.via <> 'editor' AND ($2 = '' OR s.batch_id = $2) \
             ORDER BY s.received_at DESC, s.id"
        );
        let batch = batch.unwrap_or_default();
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).bind(batch).fetch_all(db).await?))
    }

    /// Keeps a report, and says whether it is the first one of its submission. Nothing is kept of a submission that was
    /// deleted while it was graded.
    pub async fn finish(&self, submission_id: &str, report: &Report, graded_at: Millis) -> Result<bool> {
        const STATE: &str = "UPDATE submissions SET state = 'graded', fault = NULL, claimed_by = NULL, sender = NULL \
                             WHERE id = $1";
        let row = ReportRow::of(report)?;
        let is_first = on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            if report.verdict == Verdict::Stopped {
                let until = suspected_until(graded_at);
                sqlx::query(SUSPECT).bind(submission_id).bind(until).execute(&mut *transaction).await?;
            }
            let found = sqlx::query(STATE).bind(submission_id).execute(&mut *transaction).await?;
            let mut is_first = false;
            if found.rows_affected() > 0 {
                let done = bind_report!(sqlx::query(INSERT), submission_id, graded_at, row, 0_i64)
                    .execute(&mut *transaction)
                    .await?;
                is_first = done.rows_affected() > 0;
            }
            transaction.commit().await?;
            is_first
        });
        Ok(is_first)
    }

    /// The portrait of a hand-in, by its digest and that of the homework's folder, where it was made: the picture, or nothing
    /// where the hand-in draws nothing.
    pub async fn portrait(&self, assignment_digest: &str, sha256: &str) -> Result<Option<Option<Vec<u8>>>> {
        const SQL: &str = "SELECT png FROM portraits WHERE assignment_digest = $1 AND sha256 = $2";
        Ok(on!(&self.read, db => {
            sqlx::query_scalar(SQL).bind(assignment_digest).bind(sha256).fetch_optional(db).await?
        }))
    }

    /// Says that a class has changed: how many files of each state there are, and when the last one came.
    pub async fn class_version(&self, assignment: &str, batch: Option<&str>) -> Result<Vec<(String, i64, i64)>> {
        const SQL: &str = "SELECT state, count(*), max(received_at) FROM submissions WHERE assignment = $1 \
                           AND via <> 'editor' AND ($2 = '' OR batch_id = $2) GROUP BY state ORDER BY state";
        let batch = batch.unwrap_or_default();
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).bind(batch).fetch_all(db).await?))
    }

    /// Keeps a portrait.
    pub async fn set_portrait(&self, assignment_digest: &str, sha256: &str, png: Option<&[u8]>) -> Result<()> {
        // Not for a hand-in that was deleted while its portrait was drawn.
        const SQL: &str = "INSERT INTO portraits (assignment_digest, sha256, png) SELECT $1, $2, $3 \
                           WHERE EXISTS (SELECT 1 FROM submissions WHERE digest = $2) ON CONFLICT DO NOTHING";
        on!(&self.write, db => { sqlx::query(SQL).bind(assignment_digest).bind(sha256).bind(png).execute(db).await?; });
        Ok(())
    }
}
