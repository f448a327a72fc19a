//! Students who ask for another look at a line of the rubric.

use super::{Result, Store, on};
use crate::service::clock::Millis;

/// What a student asks.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct Appeal {
    /// Its id.
    pub id: String,
    /// Id of the submission.
    pub submission_id: String,
    /// Id of the assignment.
    pub assignment: String,
    /// Id of the line of the rubric.
    pub line: String,
    /// What they ask.
    pub question: String,
    /// When.
    pub asked_at: Millis,
    /// Who is handling it; none with a secret of the whole service.
    pub handler: Option<String>,
    /// When somebody began to handle it.
    pub taken_at: Option<Millis>,
    /// The answer.
    pub answer: Option<String>,
    /// When it was given.
    pub answered_at: Option<Millis>,
    /// Student number, where it is known.
    pub number: Option<String>,
    /// Name by the roster, where it is known.
    pub name: Option<String>,
    /// Id of the student, where it is known.
    pub student_id: Option<String>,
}

/// What is selected for [`Appeal`].
macro_rules! select {
    ($rest:literal) => {
        concat!(
            "SELECT a.id, a.submission_id, a.assignment, a.line, a.question, a.asked_at, \
             coalesce(nullif(p.name, ''), p.login) AS handler, a.taken_at, a.answer, a.answered_at, t.number, t.name, \
             t.id AS student_id FROM appeals a LEFT JOIN staff p ON p.id = a.handler_id \
             LEFT JOIN students t ON t.id = a.asker ",
            $rest
        )
    };
}

impl Store {
    /// Keeps what somebody asks; false where they have asked in this homework before.
    pub async fn add_appeal(&self, appeal: &Appeal, asker: &str) -> Result<bool> {
        const SQL: &str = "INSERT INTO appeals (id, submission_id, assignment, asker, line, question, asked_at) \
                           VALUES ($1, $2, $3, $4, $5, $6, $7) ON CONFLICT (assignment, asker) DO NOTHING";
        let added = on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&appeal.id)
                .bind(&appeal.submission_id)
                .bind(&appeal.assignment)
                .bind(asker)
                .bind(&appeal.line)
                .bind(&appeal.question)
                .bind(appeal.asked_at)
                .execute(db)
                .await?
                .rows_affected()
        });
        Ok(added > 0)
    }

    /// What somebody has asked in a homework.
    pub async fn appeal_of(&self, assignment: &str, asker: &str) -> Result<Option<Appeal>> {
        const SQL: &str = select!("WHERE a.assignment = $1 AND a.asker = $2");
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).bind(asker).fetch_optional(db).await?))
    }

    /// What is asked about a submission.
    pub async fn appeal_about(&self, submission_id: &str) -> Result<Option<Appeal>> {
        const SQL: &str = select!("WHERE a.submission_id = $1 ORDER BY a.asked_at LIMIT 1");
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(submission_id).fetch_optional(db).await?))
    }

    /// The appeal with this id.
    pub async fn appeal(&self, id: &str) -> Result<Option<Appeal>> {
        const SQL: &str = select!("WHERE a.id = $1");
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?))
    }

    /// What is asked in a homework: what is not answered first, and of that the oldest.
    pub async fn appeals(&self, assignment: &str) -> Result<Vec<Appeal>> {
        const SQL: &str = select!(
            "WHERE a.assignment = $1 ORDER BY CASE WHEN a.answered_at IS NULL THEN 0 ELSE 1 END, a.asked_at, a.id"
        );
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).fetch_all(db).await?))
    }

    /// How many are not answered.
    pub async fn open_appeals(&self, assignment: &str) -> Result<u64> {
        const SQL: &str = "SELECT count(*) FROM appeals WHERE assignment = $1 AND answered_at IS NULL";
        let count: i64 = on!(&self.read, db => sqlx::query_scalar(SQL).bind(assignment).fetch_one(db).await?);
        Ok(count.unsigned_abs())
    }

    /// Says who handles it from now on, or that nobody does (`taken_at` is none).
    pub async fn take_appeal(&self, id: &str, staff_id: Option<&str>, taken_at: Option<Millis>) -> Result<()> {
        const SQL: &str = "UPDATE appeals SET handler_id = $2, taken_at = $3 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).bind(staff_id).bind(taken_at).execute(db).await?; });
        Ok(())
    }

    /// Answers it, or answers it anew.
    pub async fn answer_appeal(&self, id: &str, staff_id: Option<&str>, answer: &str, now: Millis) -> Result<()> {
        const SQL: &str = "UPDATE appeals SET handler_id = $2, taken_at = coalesce(taken_at, $4), answer = $3, \
                           answered_at = $4 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).bind(staff_id).bind(answer).bind(now).execute(db).await?; });
        Ok(())
    }
}
