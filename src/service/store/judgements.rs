//! What people judge beside the grading: points in place of the grading's, and comments on lines of a file.
//!
//! A stored report is what the grading found; it is never changed by a person. Whoever reads one gets it with the judgements in
//! it, so that they hold for a new report of a regrading as well. `reports.score` is the score with them.

use super::{Result, Store, on};
use crate::language::Text;
use crate::report::text::number;
use crate::report::{Comment, Report};
use crate::service::clock::Millis;

/// Points of a line of the rubric in place of those of the grading.
#[derive(Clone, Debug, PartialEq, sqlx::FromRow)]
pub struct Override {
    /// Id of the submission.
    pub submission_id: String,
    /// Id of the line.
    pub line: String,
    /// The points.
    pub points: f64,
    /// What the grading gave when it was overridden.
    pub graded: f64,
    /// Why; the student reads it.
    pub reason: String,
    /// Who did it; none with a secret of the whole service.
    pub author: Option<String>,
    /// When.
    pub at: Millis,
}

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

/// A submission that a regrading judges anew, and a line of it that somebody overrode.
#[derive(Clone, Debug, PartialEq)]
pub struct OverriddenAgain {
    /// What somebody gave.
    pub overridden: Override,
    /// What the line gets when it is graded again; none where the new report has no such line.
    pub graded_again: Option<f64>,
}

impl OverriddenAgain {
    /// Whether the new grading differs from the one that was overridden.
    pub fn is_changed(&self) -> bool {
        // Sums of fractions of points are rounded.
        self.graded_again.is_none_or(|again| (again - self.overridden.graded).abs() > 1e-6)
    }
}

/// The columns of [`Override`].
macro_rules! override_columns {
    () => {
        "o.submission_id, o.line, o.points, o.graded, o.reason, coalesce(nullif(p.name, ''), p.login) AS author, o.at"
    };
}

pub(super) const OVERRIDES: &str = concat!(
    "SELECT ",
    override_columns!(),
    " FROM overrides o LEFT JOIN staff p ON p.id = o.staff_id WHERE o.submission_id = $1 ORDER BY o.line"
);

pub(super) const REPORT: &str = "SELECT report FROM reports WHERE submission_id = $1";
pub(super) const SCORE: &str = "UPDATE reports SET score = $2 WHERE submission_id = $1";

/// Puts overridden points into a report.
pub(super) fn apply(report: &mut Report, overrides: &[Override]) {
    for given in overrides {
        let Some(line) = report.rubric.iter_mut().find(|line| line.id == given.line) else { continue };
        let (points, graded) = (number(given.points), number(line.points));
        let en = format!("Set to {points} points by the course's staff; the grading gave {graded}. {}", given.reason);
        let ja = format!("担当者が {points} 点に変更しました（自動採点では {graded} 点）。{}", given.reason);
        line.message = Text::new(format!("{en}\n{}", line.message.en), format!("{ja}\n{}", line.message.ja));
        report.score += given.points - line.points;
        line.graded = Some(line.points);
        line.points = given.points;
    }
}

/// Brings the score of a submission up to date, after its report or what is overridden has changed.
macro_rules! rescore {
    ($transaction:expr, $id:expr) => {{
        use $crate::service::store::judgements::{OVERRIDES, Override, REPORT, SCORE, apply};
        let json: Option<String> = sqlx::query_scalar(REPORT).bind($id).fetch_optional(&mut *$transaction).await?;
        if let Some(json) = json {
            let mut report: $crate::report::Report = serde_json::from_str(&json)?;
            let overrides: Vec<Override> = sqlx::query_as(OVERRIDES).bind($id).fetch_all(&mut *$transaction).await?;
            apply(&mut report, &overrides);
            sqlx::query(SCORE).bind($id).bind(report.score).execute(&mut *$transaction).await?;
        }
    }};
}
pub(super) use rescore;

impl Store {
    /// What is overridden of a submission.
    pub async fn overrides(&self, submission_id: &str) -> Result<Vec<Override>> {
        Ok(on!(&self.read, db => sqlx::query_as(OVERRIDES).bind(submission_id).fetch_all(db).await?))
    }

    /// Overrides a line of a submission's report, or takes that back. The line gets `points`, for a reason that its student reads.
    pub async fn set_override(
        &self,
        submission_id: &str,
        line: &str,
        given: Option<(f64, &str)>,
        staff_id: Option<&str>,
        now: Millis,
    ) -> Result<()> {
        const CLEAR: &str = "DELETE FROM overrides WHERE submission_id = $1 AND line = $2";
        const SET: &str = "INSERT INTO overrides (submission_id, line, points, graded, reason, staff_id, at) \
                           VALUES ($1, $2, $3, $4, $5, $6, $7)";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            let json: Option<String> =
                sqlx::query_scalar(REPORT).bind(submission_id).fetch_optional(&mut *transaction).await?;
            let report: Option<Report> = json.map(|json| serde_json::from_str(&json)).transpose()?;
            let graded = report.and_then(|report| report.rubric.into_iter().find(|it| it.id == line));
            sqlx::query(CLEAR).bind(submission_id).bind(line).execute(&mut *transaction).await?;
            if let (Some((points, reason)), Some(graded)) = (given, graded) {
                sqlx::query(SET)
                    .bind(submission_id)
                    .bind(line)
                    .bind(points)
                    .bind(graded.points)
                    .bind(reason)
                    .bind(staff_id)
                    .bind(now)
                    .execute(&mut *transaction)
                    .await?;
            }
            rescore!(transaction, submission_id);
            transaction.commit().await?;
        });
        Ok(())
    }

    /// What is overridden of everything that a regrading judges anew, with the points that it gives.
    pub async fn overridden_again(&self, regrading_id: &str) -> Result<Vec<OverriddenAgain>> {
        const SQL: &str = concat!(
            "SELECT ",
            override_columns!(),
            " FROM overrides o JOIN regraded g ON g.submission_id = o.submission_id \
             LEFT JOIN staff p ON p.id = o.staff_id WHERE g.regrading_id = $1 AND g.state = 'graded' \
             ORDER BY o.submission_id, o.line"
        );
        const AGAIN: &str = "SELECT report FROM regraded WHERE regrading_id = $1 AND submission_id = $2";
        let found: Vec<Override> = on!(&self.read, db => sqlx::query_as(SQL).bind(regrading_id).fetch_all(db).await?);
        let mut all = Vec::new();
        for overridden in found {
            let json: Option<String> = on!(&self.read, db => {
                sqlx::query_scalar(AGAIN).bind(regrading_id).bind(&overridden.submission_id).fetch_one(db).await?
            });
            let report: Option<Report> = json.map(|json| serde_json::from_str(&json)).transpose()?;
            let line = report.and_then(|report| report.rubric.into_iter().find(|it| it.id == overridden.line));
            all.push(OverriddenAgain { graded_again: line.map(|line| line.points), overridden });
        }
        Ok(all)
    }

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
