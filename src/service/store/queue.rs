//! Who grades what: claims that end by themselves.
//!
//! A grader that dies leaves its claims behind; when they end, or at once where the database is ours alone, others
//! take the files over. Two graders that hold the same file after all do no harm: the first report stands.

use super::rows::submission_columns;
use super::{Result, Store, Submission, on};
use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::service::clock::Millis;

/// A submission that was claimed, with its files.
#[derive(Clone, Debug)]
pub struct Claimed {
    /// What was handed in.
    pub submission: Submission,
    /// Its files.
    pub hand_in: HandIn,
}

/// Whether the column `assignment` is in a [`list`].
macro_rules! is_among {
    ($list:literal) => {
        concat!("replace(", $list, ", ',' || assignment || ',', '') <> ", $list)
    };
}
pub(super) use is_among;

/// Ids as one text, for [`is_among`]: no id has a comma, and both databases can look for one in there.
pub(super) fn list(assignments: &[&str]) -> String {
    assignments.iter().map(|id| format!(",{id},")).collect()
}

/// How often a file is graded that fails by our fault.
const MAX_TRIES: i64 = 4;

impl Store {
    /// Claims the next file of these assignments that nobody grades.
    pub async fn claim(&self, assignments: &[&str], by: &str, now: Millis, until: Millis) -> Result<Option<Claimed>> {
        // Who waited for another's claim sees the outer conditions again, and gets nothing.
        const CLAIM: &str = concat!(
            "UPDATE submissions SET claimed_by = $1, claimed_until = $2 WHERE id = \
             (SELECT id FROM submissions WHERE state <> 'graded' AND tries < $3 AND claimed_until <= $4 AND ",
            is_among!("$5"),
            " ORDER BY priority, received_at LIMIT 1) AND state <> 'graded' AND claimed_until <= $4 RETURNING id"
        );
        const SELECT: &str = concat!("SELECT ", submission_columns!(), " FROM submissions s WHERE s.id = $1");
        let id: Option<String> = on!(&self.write, db => {
            sqlx::query_scalar(CLAIM)
                .bind(by)
                .bind(until)
                .bind(MAX_TRIES)
                .bind(now)
                .bind(list(assignments))
                .fetch_optional(db)
                .await?
        });
        let Some(id) = id else { return Ok(None) };
        let submission: Submission = on!(&self.write, db => sqlx::query_as(SELECT).bind(&id).fetch_one(db).await?);
        let Some(hand_in) = self.hand_in(&id).await? else { return Ok(None) };
        Ok(Some(Claimed { submission, hand_in }))
    }

    /// Keeps all claims of a process for longer.
    pub async fn extend_claims(&self, by: &str, until: Millis) -> Result<()> {
        const SQL: &str = "UPDATE submissions SET claimed_until = $2 WHERE claimed_by = $1 AND state = 'queued'";
        const AGAIN: &str = "UPDATE regraded SET claimed_until = $2 WHERE claimed_by = $1 AND state = 'queued'";
        on!(&self.write, db => {
            sqlx::query(SQL).bind(by).bind(until).execute(db).await?;
            sqlx::query(AGAIN).bind(by).bind(until).execute(db).await?;
        });
        Ok(())
    }

    /// Gives up the claims of a process, or of every other one: whoever comes next may take the files.
    pub async fn release_claims(&self, by: Option<&str>) -> Result<u64> {
        const ONE: &str = "UPDATE submissions SET claimed_by = NULL, claimed_until = 0 \
                           WHERE state <> 'graded' AND claimed_by = $1";
        const ALL: &str = "UPDATE submissions SET claimed_by = NULL, claimed_until = 0 \
                           WHERE state = 'queued' AND claimed_until > 0";
        const AGAIN_ONE: &str = "UPDATE regraded SET claimed_until = 0 WHERE state = 'queued' AND claimed_by = $1";
        const AGAIN_ALL: &str = "UPDATE regraded SET claimed_until = 0 WHERE state = 'queued' AND claimed_until > 0";
        let done = on!(&self.write, db => match by {
            Some(by) => {
                sqlx::query(AGAIN_ONE).bind(by).execute(db).await?;
                sqlx::query(ONE).bind(by).execute(db).await?.rows_affected()
            }
            None => {
                sqlx::query(AGAIN_ALL).execute(db).await?;
                sqlx::query(ALL).execute(db).await?.rows_affected()
            }
        });
        Ok(done)
    }

    /// Notes that grading failed by our fault; it is tried again after 10 s, then after a minute, then after ten.
    pub async fn fail(&self, submission_id: &str, fault: &Fault, now: Millis) -> Result<()> {
        const SQL: &str = "UPDATE submissions SET state = 'failed', fault = $2, tries = tries + 1, claimed_by = NULL, \
                           claimed_until = $3 + CASE tries WHEN 0 THEN 10000 WHEN 1 THEN 60000 ELSE 600000 END \
                           WHERE id = $1 AND state <> 'graded'";
        let fault = serde_json::to_string(fault)?;
        on!(&self.write, db => {
            sqlx::query(SQL).bind(submission_id).bind(&fault).bind(now).execute(db).await?;
        });
        Ok(())
    }

    /// Lets every file that failed by our fault be graded again.
    pub async fn retry_failed(&self) -> Result<u64> {
        const SQL: &str =
            "UPDATE submissions SET state = 'queued', tries = 0, claimed_until = 0 WHERE state = 'failed'";
        Ok(on!(&self.write, db => sqlx::query(SQL).execute(db).await?.rows_affected()))
    }
}
