//! What people judge beside the grading: points in place of the grading's, and comments on lines of a file.
//!
//! A stored report is what the grading found; it is never changed by a person. Whoever reads one gets it with the judgements in
//! it, so that they hold for a new report of a regrading as well. `reports.score` is the score with them.

use super::overrides::apply;
use super::{Result, Store, on};
use crate::report::{Comment, Report};
use crate::service::clock::Millis;

/// A comment, with what is needed to remove it.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct StoredComment {
    /// Its id.
    pub id: String,
    /// Name of the file.
    pub file: String,
    /// Line of the file, from 1.
    pub line: i64,
    /// What is said.
    pub text: String,
    /// Who says it; none with a secret of the whole service.
    pub author: Option<String>,
}

impl Store {
    /// The comments on a submission's files, in the order of the lines.
    pub async fn comments(&self, submission_id: &str) -> Result<Vec<StoredComment>> {
        const SQL: &str = "SELECT c.id, c.file, c.line, c.text, coalesce(nullif(p.name, ''), p.login) AS author \
                           FROM comments c LEFT JOIN staff p ON p.id = c.staff_id WHERE c.submission_id = $1 \
                           ORDER BY c.file, c.line, c.at, c.id";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(submission_id).fetch_all(db).await?))
    }

    /// Adds a comment on a line of a submission's file.
    pub async fn add_comment(
        &self,
        submission_id: &str,
        comment: &StoredComment,
        staff_id: Option<&str>,
        now: Millis,
    ) -> Result<()> {
        const SQL: &str = "INSERT INTO comments (id, submission_id, file, line, text, staff_id, at) \
                           VALUES ($1, $2, $3, $4, $5, $6, $7)";
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&comment.id)
                .bind(submission_id)
                .bind(&comment.file)
                .bind(comment.line)
                .bind(&comment.text)
                .bind(staff_id)
                .bind(now)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// Removes a comment; false where the submission has none with this id.
    pub async fn remove_comment(&self, submission_id: &str, id: &str) -> Result<bool> {
        const SQL: &str = "DELETE FROM comments WHERE submission_id = $1 AND id = $2";
        let removed = on!(&self.write, db => {
            sqlx::query(SQL).bind(submission_id).bind(id).execute(db).await?.rows_affected()
        });
        Ok(removed > 0)
    }

    /// Puts what people judge into a report of the grading.
    pub(super) async fn judge(&self, submission_id: &str, report: &mut Report) -> Result<()> {
        apply(report, &self.overrides(submission_id).await?);
        let comment = |comment: StoredComment| Comment {
            file: comment.file,
            line: u32::try_from(comment.line).unwrap_or(u32::MAX),
            text: comment.text,
            author: comment.author,
        };
        report.comments = self.comments(submission_id).await?.into_iter().map(comment).collect();
        Ok(())
    }
}
