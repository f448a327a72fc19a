//! Grading everything again: the new results stand beside the reports until a teacher adopts them.

use super::overrides::rescore;
use super::queue::{is_among, list};
use super::rows::{from_word, submission_columns, word};
use super::{Progress, Result, Store, Submission, on, signed};
use crate::hand_in::HandIn;
use crate::report::{Hints, Report, Verdict};
use crate::service::clock::Millis;
use std::collections::HashMap;

/// One time that everything is graded again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Regrading {
    /// Id.
    pub id: String,
    /// Id of the assignment.
    pub assignment: String,
    /// Seed of the fresh probes.
    pub seed: u64,
    /// How much the messages help.
    pub hints: Hints,
    /// When it began.
    pub created_at: Millis,
    /// When its results took the place of the reports.
    pub adopted_at: Option<Millis>,
    /// Id of the uploaded folder by which everything is graded; none: by the one that is served.
    pub folder: Option<String>,
}

/// What became of one submission.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// What was handed in.
    pub submission: Submission,
    /// Student number, where it is known.
    pub number: Option<String>,
    /// Name by the roster, where it is known.
    pub student_name: Option<String>,
    /// The report's verdict, points and mistakes; those that it had then, where the regrading is adopted.
    pub before: (Verdict, f64, Vec<String>),
    /// The same graded again; none where that is still to come, or failed by our fault.
    pub after: Option<(Verdict, f64, Vec<String>)>,
    /// Whether both are kept as they were when the results took the place of the reports.
    is_adopted: bool,
}

/// A submission that is to be graded again, with its bytes.
#[derive(Clone, Debug)]
pub struct Again {
    /// Which regrading.
    pub regrading_id: String,
    /// What was handed in, with the regrading's seed and hints.
    pub submission: Submission,
    /// Its files.
    pub hand_in: HandIn,
    /// The regrading's folder.
    pub folder: Option<String>,
}

type RegradingRow = (String, String, i64, String, i64, Option<i64>, Option<String>);

/// Selects a [`RegradingRow`].
macro_rules! select {
    ($rest:literal) => {
        concat!("SELECT id, assignment, seed, hints, created_at, adopted_at, folder_id FROM regradings ", $rest)
    };
}

impl Regrading {
    fn of((id, assignment, seed, hints, created_at, adopted_at, folder): RegradingRow) -> Result<Self> {
        Ok(Self { id, assignment, seed: seed.unsigned_abs(), hints: from_word(hints)?, created_at, adopted_at, folder })
    }
}

impl<'r, R: sqlx::Row> sqlx::FromRow<'r, R> for Compared
where
    Submission: sqlx::FromRow<'r, R>,
    &'static str: sqlx::ColumnIndex<R>,
    String: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    f64: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    Option<String>: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    Option<f64>: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
{
    fn from_row(row: &'r R) -> std::result::Result<Self, sqlx::Error> {
        let mistakes = |json: String| serde_json::from_str(&json).map_err(|error| sqlx::Error::Decode(Box::new(error)));
        let verdict: Option<String> = row.try_get("new_verdict")?;
        let score: Option<f64> = row.try_get("new_score")?;
        let adopted: Option<f64> = row.try_get("score_adopted")?;
        let new_mistakes: Option<String> = row.try_get("new_mistakes")?;
        let after = match (verdict, score, new_mistakes) {
            (Some(verdict), Some(score), Some(json)) => {
                Some((from_word(verdict)?, adopted.unwrap_or(score), mistakes(json)?))
            }
            _ => None,
        };
        Ok(Self {
            submission: Submission::from_row(row)?,
            number: row.try_get("number")?,
            student_name: row.try_get("student_name")?,
            before: (from_word(row.try_get("verdict")?)?, row.try_get("score")?, mistakes(row.try_get("mistakes")?)?),
            after,
            is_adopted: adopted.is_some(),
        })
    }
}

/// Adds what has a report to a regrading; drafts are left out, and what is in it already.
const ITEMS: &str = "INSERT INTO regraded (regrading_id, submission_id, state, claimed_until) \
                     SELECT $1, s.id, 'queued', 0 FROM submissions s \
                     WHERE s.assignment = $2 AND s.state = 'graded' AND s.via <> 'editor' \
                     ON CONFLICT (regrading_id, submission_id) DO NOTHING";

impl Store {
    /// Begins to grade everything of an assignment again that has a report; drafts are left out.
    pub async fn add_regrading(&self, regrading: &Regrading) -> Result<()> {
        const INSERT: &str = "INSERT INTO regradings (id, assignment, seed, hints, created_at, folder_id) \
                              VALUES ($1, $2, $3, $4, $5, $6)";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(INSERT)
                .bind(&regrading.id)
                .bind(&regrading.assignment)
                .bind(signed(regrading.seed))
                .bind(word(&regrading.hints))
                .bind(regrading.created_at)
                .bind(&regrading.folder)
                .execute(&mut *transaction)
                .await?;
            sqlx::query(ITEMS).bind(&regrading.id).bind(&regrading.assignment).execute(&mut *transaction).await?;
            transaction.commit().await?;
        });
        Ok(())
    }

    /// Adds what was graded since a regrading began; how many these are.
    pub async fn extend_regrading(&self, regrading: &Regrading) -> Result<u64> {
        Ok(on!(&self.write, db => {
            sqlx::query(ITEMS).bind(&regrading.id).bind(&regrading.assignment).execute(db).await?.rows_affected()
        }))
    }

    /// Every regrading of an assignment, the newest first.
    pub async fn regradings(&self, assignment: &str) -> Result<Vec<Regrading>> {
        const SQL: &str = select!("WHERE assignment = $1 ORDER BY created_at DESC, id");
        let rows: Vec<RegradingRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).fetch_all(db).await?);
        rows.into_iter().map(Regrading::of).collect()
    }

    /// The regrading with this id.
    pub async fn regrading(&self, id: &str) -> Result<Option<Regrading>> {
        const SQL: &str = select!("WHERE id = $1");
        let row: Option<RegradingRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?);
        row.map(Regrading::of).transpose()
    }

    /// How far a regrading is.
    pub async fn regrading_progress(&self, id: &str) -> Result<Progress> {
        const SQL: &str = "SELECT state, count(*) FROM regraded WHERE regrading_id = $1 GROUP BY state";
        let states: Vec<(String, i64)> = on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_all(db).await?);
        Ok(Progress::of(&states))
    }

    /// Every submission of a regrading, before and after, with the points that people gave in place of the grading's; those that
    /// changed most come first.
    pub async fn compared(&self, id: &str) -> Result<Vec<Compared>> {
        const SQL: &str = concat!(
            "SELECT ",
            submission_columns!(),
            ", t.number, t.name AS student_name, coalesce(g.verdict_before, r.verdict) AS verdict, \
             coalesce(g.score_before, r.score) AS score, coalesce(g.mistakes_before, r.mistakes) AS mistakes, \
             g.verdict AS new_verdict, g.score AS new_score, g.score_adopted, g.mistakes AS new_mistakes \
             FROM regraded g \
             JOIN submissions s ON s.id = g.submission_id JOIN reports r ON r.submission_id = s.id \
             LEFT JOIN students t ON t.id = s.student_id WHERE g.regrading_id = $1 \
             ORDER BY s.received_at DESC, s.id"
        );
        let mut rows: Vec<Compared> = on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_all(db).await?);
        let mut given: HashMap<String, f64> = HashMap::new();
        for line in self.overridden_again(id).await? {
            let gain = line.gain();
            *given.entry(line.overridden.submission_id).or_default() += gain;
        }
        for row in rows.iter_mut().filter(|row| !row.is_adopted) {
            if let (Some((_, score, _)), Some(more)) = (&mut row.after, given.get(&row.submission.id)) {
                *score += more;
            }
        }
        let change = |row: &Compared| row.after.as_ref().map_or(0.0, |after| (after.1 - row.before.1).abs());
        rows.sort_by(|a, b| change(b).total_cmp(&change(a)));
        Ok(rows)
    }

    /// Claims the next submission of these assignments that is to be graded again.
    pub async fn claim_again(
        &self,
        assignments: &[&str],
        by: &str,
        now: Millis,
        until: Millis,
    ) -> Result<Option<Again>> {
        macro_rules! claim {
            ($lock:literal) => {
                concat!(
                    "UPDATE regraded SET claimed_by = $1, claimed_until = $2 \
             WHERE (regrading_id, submission_id) = (SELECT regrading_id, submission_id FROM regraded \
             WHERE state = 'queued' AND claimed_until <= $3 AND regrading_id IN (SELECT id FROM regradings WHERE ",
                    is_among!("$4"),
                    ") LIMIT 1 ",
                    $lock,
                    ") AND state = 'queued' AND claimed_until <= $3 RETURNING regrading_id, submission_id"
                )
            };
        }
        let claim = if self.is_exclusive() { claim!("") } else { claim!("FOR UPDATE SKIP LOCKED") };
        let claimed: Option<(String, String)> = on!(&self.write, db => {
            sqlx::query_as(claim).bind(by).bind(until).bind(now).bind(list(assignments)).fetch_optional(db).await?
        });
        let Some((regrading_id, submission_id)) = claimed else { return Ok(None) };
        let (regrading, submission) = (self.regrading(&regrading_id).await?, self.submission(&submission_id).await?);
        let (Some(regrading), Some(mut submission)) = (regrading, submission) else { return Ok(None) };
        submission.seed = regrading.seed;
        submission.hints = submission.hints.min(regrading.hints);
        let Some(hand_in) = self.hand_in(&submission_id).await? else { return Ok(None) };
        Ok(Some(Again { regrading_id, submission, hand_in, folder: regrading.folder }))
    }

    /// Keeps what a submission got when it was graded again; none: that failed by our fault.
    pub async fn finish_again(&self, regrading_id: &str, submission_id: &str, report: Option<&Report>) -> Result<()> {
        const SQL: &str = "UPDATE regraded SET state = $3, verdict = $4, score = $5, mistakes = $6, report = $7 \
                           WHERE regrading_id = $1 AND submission_id = $2 AND state = 'queued'";
        let row = report.map(super::reports::ReportRow::of).transpose()?;
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(regrading_id)
                .bind(submission_id)
                .bind(if row.is_some() { "graded" } else { "failed" })
                .bind(row.as_ref().map(|row| &row.verdict))
                .bind(row.as_ref().map(|row| row.score))
                .bind(row.as_ref().map(|row| &row.mistakes))
                .bind(row.as_ref().map(|row| &row.report))
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// Lets the results of a regrading take the place of the reports, its seed that of the assignment's, and its folder that of
    /// the one that is served.
    pub async fn adopt(&self, regrading: &Regrading, now: Millis) -> Result<()> {
        const BEFORE: &str = "UPDATE regraded SET verdict_before = r.verdict, score_before = r.score, \
                              mistakes_before = r.mistakes FROM reports r \
                              WHERE regraded.regrading_id = $1 AND r.submission_id = regraded.submission_id";
        const AFTER: &str = "UPDATE regraded SET score_adopted = r.score FROM reports r \
                             WHERE regraded.regrading_id = $1 AND r.submission_id = regraded.submission_id \
                             AND regraded.state = 'graded'";
        const REPORTS: &str = "UPDATE reports SET graded_at = $2, verdict = g.verdict, score = g.score, \
                               mistakes = g.mistakes, report = g.report, ggrade = $3, reused = 0 FROM regraded g \
                               WHERE g.regrading_id = $1 AND g.submission_id = reports.submission_id \
                               AND g.state = 'graded'";
        const SUBMISSIONS: &str = "UPDATE submissions SET seed = $2 WHERE id IN \
                                   (SELECT submission_id FROM regraded WHERE regrading_id = $1 AND state = 'graded')";
        const ASSIGNMENT: &str = "UPDATE assignments SET seed = $2 WHERE id = $1";
        const OVERRIDDEN: &str = "SELECT DISTINCT o.submission_id FROM overrides o JOIN regraded g \
                                  ON g.submission_id = o.submission_id WHERE g.regrading_id = $1";
        const DONE: &str = "UPDATE regradings SET adopted_at = $2 WHERE id = $1";
        const PUBLISHED: &str = "UPDATE folders SET published_at = $2 WHERE id = $1";
        let seed = signed(regrading.seed);
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(BEFORE).bind(&regrading.id).execute(&mut *transaction).await?;
            sqlx::query(REPORTS)
                .bind(&regrading.id)
                .bind(now)
                .bind(env!("CARGO_PKG_VERSION"))
                .execute(&mut *transaction)
                .await?;
            let overridden: Vec<String> =
                sqlx::query_scalar(OVERRIDDEN).bind(&regrading.id).fetch_all(&mut *transaction).await?;
            for submission in &overridden {
                rescore!(transaction, submission);
            }
            sqlx::query(AFTER).bind(&regrading.id).execute(&mut *transaction).await?;
            sqlx::query(SUBMISSIONS).bind(&regrading.id).bind(seed).execute(&mut *transaction).await?;
            sqlx::query(ASSIGNMENT).bind(&regrading.assignment).bind(seed).execute(&mut *transaction).await?;
            sqlx::query(DONE).bind(&regrading.id).bind(now).execute(&mut *transaction).await?;
            sqlx::query(PUBLISHED).bind(&regrading.folder).bind(now).execute(&mut *transaction).await?;
            transaction.commit().await?;
        });
        Ok(())
    }
}
