//! What is kept: one SQL for both databases, an SQLite file or PostgreSQL.
//!
//! Every statement is written once, with `$1` as both databases take it, and only with what both understand; `on!` runs
//! it on the one that is open. Statements that change something go through [`Store::write`]'s pool: SQLite has one
//! writer at a time, and a pool of one connection queues for it without ever being told that the file is busy.

mod acts;
mod appeals;
mod assignments;
mod batches;
mod courses;
mod cross_checks;
mod deletions;
mod export;
mod extensions;
mod folders;
mod insights;
mod judgements;
mod keys;
mod late;
mod likeness;
mod lti;
mod lti_contexts;
mod lti_scores;
mod open;
mod overrides;
mod owners;
mod pseudonyms;
mod queue;
mod regradings;
mod reports;
mod retention;
mod rows;
mod senders;
mod settings;
mod sign_ins;
mod staff;
mod students;
mod submissions;
mod tokens;

pub use acts::{Act, NamedAct};
pub use appeals::Appeal;
pub use assignments::{AssignmentSettings, Audience};
pub use batches::{Batch, BatchEntry, Progress};
pub use courses::CoursePlace;
pub use deletions::{Counts, Deletion, DeletionTarget};
pub use extensions::{Beneficiary, Extension, NamedExtension};
pub use folders::UploadedFolder;
pub use judgements::StoredComment;
pub use keys::{KeyResult, StoredKey};
pub use late::{LateRules, LateSpan};
pub use lti::{Deployment, HomeworkLink, Launch, Platform, PlatformPerson};
pub use lti_contexts::PlatformCourse;
pub use lti_scores::{DueScore, Stuck};
pub use open::Location;
pub use overrides::{LineAgain, OverriddenAgain, Override};
pub use owners::{Owner, Proof};
pub use queue::{Claimed, Listener, News, Priority};
pub use regradings::{Again, Compared, Regrading};
pub use reports::{ClassRow, HistoryRow, StoredSubmission};
pub use retention::RemovedCounts;
pub(crate) use rows::word;
pub use rows::{Submission, SubmissionState, Via};
pub use senders::Sender;
pub use sign_ins::SignIn;
pub use staff::{StaffMember, StaffRole, TeacherSession};
pub use students::{EntryMatch, RosterLine, StudentRecord};
pub use submissions::{Added, NewSubmission};
pub use tokens::{AccessToken, OwnedToken, TokenScope};

use sqlx::{PgPool, SqlitePool};

/// What failed in the database, for the log; nobody else is told.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The database's own words.
    #[error("{0}")]
    Database(#[from] sqlx::Error),
    /// The tables could not be brought up to date.
    #[error("{0}")]
    Migration(#[from] sqlx::migrate::MigrateError),
    /// What is stored cannot be read.
    #[error("stored data cannot be read: {0}")]
    Content(#[from] serde_json::Error),
    /// The file is in use or cannot be made.
    #[error("{0}")]
    File(String),
}

/// What most functions here give.
pub type Result<T> = std::result::Result<T, StoreError>;

/// A pool of either database.
#[derive(Clone, Debug)]
pub(crate) enum DatabasePool {
    Sqlite(SqlitePool),
    Postgres(PgPool),
}

/// Runs one statement on the database that is open. `$db` stands for the pool.
macro_rules! on {
    ($pool:expr, $db:ident => $body:expr) => {
        match $pool {
            $crate::service::store::DatabasePool::Sqlite($db) => $body,
            $crate::service::store::DatabasePool::Postgres($db) => $body,
        }
    };
}
pub(crate) use on;

/// The database.
#[derive(Clone, Debug)]
pub struct Store {
    read: DatabasePool,
    write: DatabasePool,
    location: std::sync::Arc<Location>,
    /// Held while an SQLite file is open, so that no second service works on it.
    _lock: Option<std::sync::Arc<std::fs::File>>,
}

impl Store {
    /// Whether the database answers.
    pub async fn ping(&self) -> Result<()> {
        on!(&self.read, db => { sqlx::query("SELECT 1").execute(db).await?; });
        Ok(())
    }

    /// Whether nobody else can work on this database: then claims of earlier processes mean nothing.
    pub fn is_exclusive(&self) -> bool {
        self._lock.is_some()
    }

    /// Ends the connections when their work is done.
    pub async fn close(&self) {
        on!(&self.write, db => db.close().await);
        on!(&self.read, db => db.close().await);
    }
}

/// A number that both databases keep, from an unsigned one.
pub(crate) fn signed(number: u64) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX)
}
