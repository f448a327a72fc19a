//! Removing what is old.

use super::cross_checks::differs;
use super::{DatabasePool, Result, Store, on};
use crate::service::clock::Millis;

/// What was removed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RemovedCounts {
    /// Submissions with their reports.
    pub submissions: u64,
    /// Files that no submission has any more.
    pub uploads: u64,
    /// Browsers that have nothing here any more.
    pub owners: u64,
}

/// Files that no submission has any more, and their portraits.
pub(super) const UPLOADS: &str = "DELETE FROM uploads WHERE NOT EXISTS \
                                  (SELECT 1 FROM submission_files f WHERE f.sha256 = uploads.sha256)";
pub(super) const PORTRAITS: &str = "DELETE FROM portraits WHERE NOT EXISTS \
                                    (SELECT 1 FROM submissions s WHERE s.digest = portraits.sha256)";

impl Store {
    /// Empties the log of changes beside an SQLite file, which has what was deleted as it stood before. PostgreSQL clears its
    /// files by itself.
    pub async fn empty_log(&self) -> Result<()> {
        if let DatabasePool::Sqlite(db) = &self.write {
            let (is_busy, ..): (i64, i64, i64) =
                sqlx::query_as("PRAGMA wal_checkpoint(TRUNCATE)").fetch_one(db).await?;
            if is_busy != 0 {
                tracing::warn!("the log of the database could not be emptied now; it is tried again within the hour");
            }
        }
        Ok(())
    }

    /// Removes submissions that came before `before`, drafts that came before `drafts_before`, and what only they had.
    /// Of a submission on which driver and interpreter disagree the file and the report stay, and nothing of whose it was.
    pub async fn remove_old(&self, before: Option<Millis>, drafts_before: Millis) -> Result<RemovedCounts> {
        const DRAFTS: &str = "DELETE FROM submissions WHERE via = 'editor' AND received_at < $1";
        const NAMELESS: &str = concat!(
            "UPDATE submissions SET owner_id = NULL, student_id = NULL, batch_id = NULL, via = 'api' \
             WHERE received_at < $1 AND (owner_id IS NOT NULL OR student_id IS NOT NULL OR batch_id IS NOT NULL) \
             AND EXISTS (SELECT 1 FROM reports r WHERE r.submission_id = submissions.id AND ",
            differs!("r.report"),
            ")"
        );
        const SUBMISSIONS: &str = concat!(
            "DELETE FROM submissions WHERE received_at < $1 \
             AND NOT EXISTS (SELECT 1 FROM reports r WHERE r.submission_id = submissions.id AND ",
            differs!("r.report"),
            ")"
        );
        const BATCHES: &str = "DELETE FROM batches WHERE created_at < $1";
        const REGRADINGS: &str = "DELETE FROM regradings WHERE created_at < $1";
        const ACTS: &str = "DELETE FROM acts WHERE at < $1";
        const OWNERS: &str = "DELETE FROM owners WHERE created_at < $1 AND NOT EXISTS \
                              (SELECT 1 FROM submissions s WHERE s.owner_id = owners.id)";
        let mut removed = RemovedCounts::default();
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            let gone = sqlx::query(DRAFTS).bind(drafts_before).execute(&mut *transaction).await?;
            removed.submissions += gone.rows_affected();
            if let Some(before) = before {
                for sql in [REGRADINGS, NAMELESS, SUBMISSIONS, BATCHES, ACTS] {
                    let gone = sqlx::query(sql).bind(before).execute(&mut *transaction).await?;
                    if sql == SUBMISSIONS {
                        removed.submissions += gone.rows_affected();
                    }
                }
                removed.owners += sqlx::query(OWNERS).bind(before).execute(&mut *transaction).await?.rows_affected();
            }
            removed.uploads += sqlx::query(UPLOADS).execute(&mut *transaction).await?.rows_affected();
            sqlx::query(PORTRAITS).execute(&mut *transaction).await?;
            transaction.commit().await?;
        });
        Ok(removed)
    }
}
