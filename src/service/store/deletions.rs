//! Deleting what a teacher chose, with everything that belongs to it, and the log of it.

use super::retention::{PORTRAITS, UPLOADS};
use super::rows::from_word;
use super::{Result, Store, Via, on};
use crate::language::{Language, Text};
use crate::service::clock::Millis;
use serde::{Deserialize, Serialize};

/// What is to be deleted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeletionTarget {
    /// One file with its report and pictures.
    Submission(String),
    /// An archive with all its files.
    Batch(String),
    /// A student, with every file, every entry in archives, and the browsers that know their number.
    Student(String),
    /// Somebody who is known as a browser only.
    Browser(String),
    /// Somebody who is known as an entry of an archive only: the batch, and the position in it.
    Entry(String, i64),
}

/// How much belongs to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
pub struct Counts {
    /// Files that were handed in, with their reports and pictures.
    pub submissions: u64,
    /// Drafts: what was typed in the editor, or graded without being handed in.
    pub drafts: u64,
    /// Entries in archives.
    pub entries: u64,
    /// Browsers that know a student's number.
    pub browsers: u64,
}

/// A deletion in the log: when, and how much of what. Whose it was is not kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Deletion {
    /// When.
    pub at: Millis,
    /// `submission`, `batch` or `student`.
    pub what: String,
    /// How much.
    pub counts: Counts,
}

/// What stands in an archive's list where a file was.
fn deleted_note() -> Text {
    Text::new("deleted by the teacher", "教員が削除しました")
}

type SubmissionRows = Vec<(String, String, String)>;

impl DeletionTarget {
    /// The word in the log: people without a number are students as well.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Submission(_) => "submission",
            Self::Batch(_) => "batch",
            Self::Student(_) | Self::Browser(_) | Self::Entry(..) => "student",
        }
    }

    /// The statement that lists its submissions, and what that is given.
    fn submissions(&self) -> (&'static str, &str, i64) {
        match self {
            Self::Submission(id) => ("SELECT id, digest, via FROM submissions WHERE id = $1 AND $2 = 0", id, 0),
            Self::Batch(id) => ("SELECT id, digest, via FROM submissions WHERE batch_id = $1 AND $2 = 0", id, 0),
            // What a browser tried before its student gave a number is theirs as well.
            Self::Student(id) => (
                "SELECT id, digest, via FROM submissions WHERE $2 = 0 AND (student_id = $1 OR (student_id IS NULL \
                 AND owner_id IN (SELECT id FROM owners WHERE student_id = $1)))",
                id,
                0,
            ),
            Self::Browser(id) => {
                ("SELECT id, digest, via FROM submissions WHERE owner_id = $1 AND student_id IS NULL AND $2 = 0", id, 0)
            }
            Self::Entry(batch, position) => (
                "SELECT id, digest, via FROM submissions WHERE id = \
                 (SELECT submission_id FROM batch_entries WHERE batch_id = $1 AND position = $2)",
                batch,
                *position,
            ),
        }
    }

    /// The statement that counts its entries in archives, and the one that counts its browsers.
    fn others(&self) -> (&'static str, &'static str) {
        const NONE: &str = "SELECT 0 * $2 FROM (SELECT $1 AS id) AS nobody";
        match self {
            Self::Submission(_) => (NONE, NONE),
            Self::Batch(_) => ("SELECT count(*) FROM batch_entries WHERE batch_id = $1 AND $2 = 0", NONE),
            Self::Student(_) => (
                "SELECT count(*) FROM batch_entries WHERE student_id = $1 AND $2 = 0",
                "SELECT count(*) FROM owners WHERE student_id = $1 AND $2 = 0",
            ),
            Self::Browser(_) => (NONE, "SELECT count(*) FROM owners WHERE id = $1 AND $2 = 0"),
            Self::Entry(..) => ("SELECT count(*) FROM batch_entries WHERE batch_id = $1 AND position = $2", NONE),
        }
    }

    /// What remains to be deleted when its submissions are gone, in this order.
    fn rest(&self) -> &'static [&'static str] {
        match self {
            Self::Submission(_) => &[],
            Self::Batch(_) => &["DELETE FROM batches WHERE id = $1 AND $2 = 0"],
            Self::Student(_) => &[
                "DELETE FROM batch_entries WHERE student_id = $1 AND $2 = 0",
                "DELETE FROM owners WHERE student_id = $1 AND $2 = 0",
                "UPDATE acts SET detail = '' WHERE student_id = $1 AND $2 = 0",
                "DELETE FROM students WHERE id = $1 AND $2 = 0",
            ],
            Self::Browser(_) => &["DELETE FROM owners WHERE id = $1 AND $2 = 0"],
            Self::Entry(..) => &["DELETE FROM batch_entries WHERE batch_id = $1 AND position = $2"],
        }
    }
}

impl Counts {
    fn of(rows: &SubmissionRows, entries: i64, browsers: i64) -> Result<Self> {
        let mut counts = Self { entries: entries.unsigned_abs(), browsers: browsers.unsigned_abs(), ..Self::default() };
        for (_, _, via) in rows {
            match from_word(via.clone())? {
                Via::Editor => counts.drafts += 1,
                Via::Page | Via::Api | Via::Batch => counts.submissions += 1,
            }
        }
        Ok(counts)
    }

    /// Each kind that there is, in words.
    pub fn said(&self, language: Language) -> Vec<String> {
        let kinds = [
            (
                self.submissions,
                "submission with its report and pictures",
                "submissions with their reports and pictures",
                "提出（レポートと画像を含む）",
            ),
            (self.drafts, "draft", "drafts", "下書き"),
            (self.entries, "entry of an archive", "entries of archives", "アーカイブの項目"),
            (self.browsers, "browser's history", "browsers' histories", "ブラウザの履歴"),
        ];
        let there = kinds.into_iter().filter(|(count, ..)| *count > 0);
        let one = |(count, one, many, ja): (u64, &str, &str, &str)| match language {
            Language::En => format!("{count} {}", if count == 1 { one } else { many }),
            Language::Ja => format!("{ja} {count} 件"),
        };
        there.map(one).collect()
    }
}

impl Deletion {
    /// The line of the log.
    pub fn said(&self, language: Language) -> String {
        let what = match (self.what.as_str(), language) {
            ("batch", Language::En) => "An archive",
            ("batch", Language::Ja) => "アーカイブ",
            ("student", Language::En) => "A student",
            ("student", Language::Ja) => "学生 1 人",
            (_, Language::En) => "A submission",
            (_, Language::Ja) => "提出 1 件",
        };
        let (colon, comma) = if language == Language::En { (": ", ", ") } else { ("：", "、") };
        let counts = self.counts.said(language);
        if counts.is_empty() { what.to_owned() } else { format!("{what}{colon}{}", counts.join(comma)) }
    }
}

impl Store {
    /// How much belongs to it.
    pub async fn count(&self, target: &DeletionTarget) -> Result<Counts> {
        let (sql, id, position) = target.submissions();
        let (entries, browsers) = target.others();
        on!(&self.read, db => {
            let rows: SubmissionRows = sqlx::query_as(sql).bind(id).bind(position).fetch_all(db).await?;
            let entries: i64 = sqlx::query_scalar(entries).bind(id).bind(position).fetch_one(db).await?;
            let browsers: i64 = sqlx::query_scalar(browsers).bind(id).bind(position).fetch_one(db).await?;
            Counts::of(&rows, entries, browsers)
        })
    }

    /// Deletes it with all of that in one transaction, and notes it in the log. `refused` is what the lists of archives'
    /// left-out members become, by the id of the batch. The answer has the digest of each hand-in, for whoever keeps
    /// pictures of it.
    pub async fn delete(
        &self,
        target: &DeletionTarget,
        refused: &[(String, String)],
        now: Millis,
    ) -> Result<(Counts, Vec<String>)> {
        const ONE: &str = "DELETE FROM submissions WHERE id = $1";
        const NOTE: &str = "UPDATE batch_entries SET note = $2 WHERE submission_id = $1";
        const REFUSED: &str = "UPDATE batches SET refused = $2 WHERE id = $1";
        const LOG: &str = "INSERT INTO deletions (id, at, what, counts) VALUES ($1, $2, $3, $4)";
        let (sql, id, position) = target.submissions();
        let (entries, browsers) = target.others();
        let note = serde_json::to_string(&deleted_note())?;
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            let rows: SubmissionRows = sqlx::query_as(sql).bind(id).bind(position).fetch_all(&mut *transaction).await?;
            let entries: i64 =
                sqlx::query_scalar(entries).bind(id).bind(position).fetch_one(&mut *transaction).await?;
            let browsers: i64 =
                sqlx::query_scalar(browsers).bind(id).bind(position).fetch_one(&mut *transaction).await?;
            let counts = Counts::of(&rows, entries, browsers)?;
            for (submission, _, _) in &rows {
                sqlx::query(NOTE).bind(submission).bind(&note).execute(&mut *transaction).await?;
                sqlx::query(ONE).bind(submission).execute(&mut *transaction).await?;
            }
            for sql in target.rest() {
                sqlx::query(*sql).bind(id).bind(position).execute(&mut *transaction).await?;
            }
            for (batch, list) in refused {
                sqlx::query(REFUSED).bind(batch).bind(list).execute(&mut *transaction).await?;
            }
            for sql in [UPLOADS, PORTRAITS] {
                sqlx::query(sql).execute(&mut *transaction).await?;
            }
            sqlx::query(LOG)
                .bind(super::super::identity::new_id())
                .bind(now)
                .bind(target.word())
                .bind(serde_json::to_string(&counts)?)
                .execute(&mut *transaction)
                .await?;
            transaction.commit().await?;
            Ok((counts, rows.into_iter().map(|(_, digest, _)| digest).collect()))
        })
    }

    /// What was deleted, the latest first, as far as a page lists it.
    pub async fn deletions(&self) -> Result<Vec<Deletion>> {
        const SQL: &str = "SELECT at, what, counts FROM deletions ORDER BY at DESC, id LIMIT 50";
        let rows: Vec<(Millis, String, String)> = on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?);
        let deletion = |(at, what, counts): (Millis, String, String)| {
            Ok(Deletion { at, what, counts: serde_json::from_str(&counts)? })
        };
        rows.into_iter().map(deletion).collect()
    }
}
