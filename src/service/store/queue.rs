//! Who grades what: the queue of all processes that work on this database, and claims that end by themselves.
//!
//! A grader that dies leaves its claims behind; when they end, or at once where the database is ours alone, others
//! take the files over. Two graders that hold the same file after all do no harm: the first report stands.
//!
//! On PostgreSQL a claim skips rows that another process is just claiming, and processes tell each other of new files and
//! of reports. An SQLite file has one process, which knows all that by itself.

use super::rows::submission_columns;
use super::{DatabasePool, Result, Sender, Store, Submission, on};
use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::service::clock::Millis;
use sqlx::postgres::{PgListener, PgNotification};

/// A submission that was claimed, with its files.
#[derive(Clone, Debug)]
pub struct Claimed {
    /// What was handed in.
    pub submission: Submission,
    /// Its files.
    pub hand_in: HandIn,
    /// Whether it may take the whole deadline.
    pub is_suspect: bool,
    /// Whether every process that tried to grade it has failed or ended, as often as it is tried.
    pub is_given_up: bool,
}

/// What waits before what: smaller is graded sooner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Priority {
    /// What a student hands in.
    Student = 0,
    /// The same of who sent lately what had to be stopped, and of files that had to be stopped before.
    Suspect = 1,
    /// A teacher's archive.
    Archive = 10,
}

/// What processes tell each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum News {
    /// A file waits.
    Waiting,
    /// Something came of the submission with this id.
    Finished(String),
    /// Another folder of a homework is served, or none.
    Published,
}

const WAITING: &str = "ggrade_waiting";
const FINISHED: &str = "ggrade_finished";
const PUBLISHED: &str = "ggrade_published";

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

/// The statement that claims the next file; `$lock` is what keeps two processes from waiting for each other. A claim that
/// ended by itself is a failure: whoever held it has died, perhaps of this file.
macro_rules! claim {
    ($lock:literal) => {
        concat!(
            "UPDATE submissions SET claimed_by = $1, claimed_until = $2, \
             tries = tries + CASE WHEN claimed_by IS NULL THEN 0 ELSE 1 END WHERE id = \
             (SELECT id FROM submissions WHERE state <> 'graded' AND (state = 'queued' OR tries < $3) \
             AND claimed_until <= $4 AND priority <> $6 AND ",
            is_among!("$5"),
            " ORDER BY priority, turn LIMIT 1 ",
            $lock,
            ") RETURNING id, priority, tries"
        )
    };
}

impl Store {
    /// Claims the next file of these assignments that nobody grades, but none of the priority that is left out.
    pub async fn claim(
        &self,
        assignments: &[&str],
        but: Option<Priority>,
        by: &str,
        now: Millis,
        until: Millis,
    ) -> Result<Option<Claimed>> {
        const SELECT: &str = concat!("SELECT ", submission_columns!(), " FROM submissions s WHERE s.id = $1");
        let claim = if self.is_exclusive() { claim!("") } else { claim!("FOR UPDATE SKIP LOCKED") };
        let claimed: Option<(String, i64, i64)> = on!(&self.write, db => {
            sqlx::query_as(claim)
                .bind(by)
                .bind(until)
                .bind(MAX_TRIES)
                .bind(now)
                .bind(list(assignments))
                .bind(but.map_or(-1, |priority| priority as i64))
                .fetch_optional(db)
                .await?
        });
        let Some((id, priority, tries)) = claimed else { return Ok(None) };
        let submission: Submission = on!(&self.write, db => sqlx::query_as(SELECT).bind(&id).fetch_one(db).await?);
        let Some(hand_in) = self.hand_in(&id).await? else { return Ok(None) };
        let (is_suspect, is_given_up) = (priority == Priority::Suspect as i64, tries >= MAX_TRIES);
        Ok(Some(Claimed { submission, hand_in, is_suspect, is_given_up }))
    }

    /// What a student's file waits behind: whether its sender is suspected, or the file was stopped before.
    pub async fn priority(&self, digest: &str, sender: &Sender, now: Millis) -> Result<Priority> {
        const SQL: &str = "SELECT (SELECT count(*) FROM senders WHERE sender = $2 AND suspected_until > $3) + \
                           (SELECT count(*) FROM (SELECT 1 FROM submissions s JOIN reports r ON r.submission_id = s.id \
                           WHERE s.digest = $1 AND r.verdict = 'stopped' LIMIT 1) AS stopped)";
        let found: i64 = on!(&self.read, db => {
            sqlx::query_scalar(SQL).bind(digest).bind(sender.key()).bind(now).fetch_one(db).await?
        });
        Ok(if found > 0 { Priority::Suspect } else { Priority::Student })
    }

    /// How many uploads wait for a grader, counted no further than `most`.
    pub async fn queue_length(&self, now: Millis, most: usize) -> Result<usize> {
        const SQL: &str = "SELECT count(*) FROM (SELECT 1 FROM submissions WHERE state = 'queued' AND state <> 'graded' \
                           AND priority < $1 AND claimed_until <= $2 LIMIT $3) AS waiting";
        let most = i64::try_from(most).unwrap_or(i64::MAX);
        let count: i64 = on!(&self.read, db => {
            sqlx::query_scalar(SQL).bind(Priority::Archive as i64).bind(now).bind(most).fetch_one(db).await?
        });
        Ok(usize::try_from(count).unwrap_or_default())
    }

    /// The place of a file that waits, from 1; none where it does not wait.
    pub async fn position(&self, id: &str, now: Millis) -> Result<Option<u64>> {
        const SQL: &str = "SELECT count(*) FROM submissions s JOIN submissions this ON this.id = $1 \
                           WHERE s.state <> 'graded' AND s.state = 'queued' AND s.claimed_until <= $2 \
                           AND this.state = 'queued' AND this.claimed_until <= $2 \
                           AND (s.priority, s.turn, s.id) <= (this.priority, this.turn, this.id)";
        let count: i64 = on!(&self.read, db => sqlx::query_scalar(SQL).bind(id).bind(now).fetch_one(db).await?);
        Ok(Some(count.unsigned_abs()).filter(|position| *position > 0))
    }

    /// Keeps all claims of a process for longer.
    pub async fn extend_claims(&self, by: &str, until: Millis) -> Result<()> {
        const SQL: &str = "UPDATE submissions SET claimed_until = $2 WHERE claimed_by = $1 AND state <> 'graded'";
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

    /// Lets every file that failed by our fault be graded again, but for those that somebody tries just now.
    pub async fn retry_failed(&self, now: Millis) -> Result<u64> {
        const SQL: &str = "UPDATE submissions SET state = 'queued', tries = 0, claimed_until = 0 \
                           WHERE state = 'failed' AND (claimed_by IS NULL OR claimed_until <= $1)";
        Ok(on!(&self.write, db => sqlx::query(SQL).bind(now).execute(db).await?.rows_affected()))
    }

    /// Tells the other processes on this database.
    pub async fn tell(&self, news: &News) -> Result<()> {
        let DatabasePool::Postgres(db) = &self.write else { return Ok(()) };
        let (channel, about) = match news {
            News::Waiting => (WAITING, ""),
            News::Finished(id) => (FINISHED, id.as_str()),
            News::Published => (PUBLISHED, ""),
        };
        sqlx::query("SELECT pg_notify($1, $2)").bind(channel).bind(about).execute(db).await?;
        Ok(())
    }

    /// What the other processes tell from now on; none where there can be no others.
    pub async fn listen(&self) -> Result<Option<Listener>> {
        let DatabasePool::Postgres(db) = &self.write else { return Ok(None) };
        let mut listener = PgListener::connect_with(db).await?;
        listener.listen_all([WAITING, FINISHED, PUBLISHED]).await?;
        Ok(Some(Listener(listener)))
    }
}

/// A connection on which other processes are heard.
#[derive(Debug)]
pub struct Listener(PgListener);

impl Listener {
    /// Waits for the next news; none where the connection was lost and made again, and news may have been missed.
    pub async fn next(&mut self) -> Result<Option<News>> {
        let news = |told: PgNotification| match told.channel() {
            FINISHED => News::Finished(told.payload().to_owned()),
            PUBLISHED => News::Published,
            _ => News::Waiting,
        };
        Ok(self.0.try_recv().await?.map(news))
    }
}
