//! The log of what teachers did.

use super::{Result, Store, on, signed};
use crate::service::clock::Millis;

/// What a teacher did.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct Act {
    /// When.
    pub at: Millis,
    /// Id of who did it; none: by a secret of the whole service, or by a program.
    pub staff_id: Option<String>,
    /// `account`, `password` or `token`.
    pub way: String,
    /// What, in a word.
    pub act: String,
    /// The homework that it was about.
    pub assignment: Option<String>,
    /// Id of the student whom it was about.
    pub student_id: Option<String>,
    /// More about it.
    pub detail: String,
}

/// An act with the names of those in it.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct NamedAct {
    /// The act.
    #[sqlx(flatten)]
    pub act: Act,
    /// The name by which who did it logs in.
    pub login: Option<String>,
    /// Number of the student.
    pub number: Option<String>,
}

impl Store {
    /// Notes an act.
    pub async fn note_act(&self, act: &Act) -> Result<()> {
        const SQL: &str = "INSERT INTO acts (id, at, staff_id, way, act, assignment, student_id, detail) \
                           VALUES ($1, $2, $3, $4, $5, $6, (SELECT id FROM students WHERE id = $7), $8)";
        on!(&self.write, db => {
            sqlx::query(SQL)
                // Of acts in one millisecond, the order is kept as well.
                .bind(uuid::Uuid::now_v7().to_string())
                .bind(act.at)
                .bind(&act.staff_id)
                .bind(&act.way)
                .bind(&act.act)
                .bind(&act.assignment)
                .bind(&act.student_id)
                .bind(&act.detail)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// How many acts there are.
    pub async fn count_acts(&self, assignment: Option<&str>) -> Result<usize> {
        const SQL: &str = "SELECT count(*) FROM acts WHERE $1 = '' OR assignment = $1";
        let assignment = assignment.unwrap_or_default();
        let count: i64 = on!(&self.read, db => sqlx::query_scalar(SQL).bind(assignment).fetch_one(db).await?);
        Ok(usize::try_from(count).unwrap_or(0))
    }

    /// The latest acts, the newest first, after as many as `skip`. `assignment` leaves out those of other homeworks.
    pub async fn acts(&self, assignment: Option<&str>, skip: usize, limit: usize) -> Result<Vec<NamedAct>> {
        const SQL: &str = "SELECT a.at, a.staff_id, a.way, a.act, a.assignment, a.student_id, a.detail, s.login, t.number \
                           FROM acts a LEFT JOIN staff s ON s.id = a.staff_id \
                           LEFT JOIN students t ON t.id = a.student_id \
                           WHERE $1 = '' OR a.assignment = $1 ORDER BY a.at DESC, a.id DESC LIMIT $2 OFFSET $3";
        Ok(on!(&self.read, db => {
            sqlx::query_as(SQL)
                .bind(assignment.unwrap_or_default())
                .bind(signed(limit as u64))
                .bind(signed(skip as u64))
                .fetch_all(db)
                .await?
        }))
    }
}
