//! Deadlines of single students.

use super::{Assignment, Result, Store, on};
use crate::service::clock::Millis;

/// A student's own deadline.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct Extension {
    /// When handing in ends for them.
    pub closes_at: Millis,
    /// Why, for those who teach.
    pub reason: String,
}

impl Store {
    /// The settings of an assignment as they are for somebody: with their own deadline, where the homework has one and they
    /// have a later one.
    pub async fn assignment_for(&self, id: &str, student_id: Option<&str>) -> Result<Assignment> {
        let settings = self.assignment(id).await?;
        let (Some(closes), Some(student_id)) = (settings.closes_at, student_id) else { return Ok(settings) };
        let own = self.extension(id, student_id).await?.filter(|own| own.closes_at > closes);
        Ok(match own {
            Some(own) => Assignment { closes_at: Some(own.closes_at), has_own_deadline: true, ..settings },
            None => settings,
        })
    }

    /// A student's own deadline.
    pub async fn extension(&self, assignment: &str, student_id: &str) -> Result<Option<Extension>> {
        const SQL: &str = "SELECT closes_at, reason FROM extensions WHERE assignment = $1 AND student_id = $2";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).bind(student_id).fetch_optional(db).await?))
    }

    /// Gives a student a deadline of their own, or takes it away.
    pub async fn set_extension(&self, assignment: &str, student_id: &str, own: Option<&Extension>) -> Result<()> {
        const CLEAR: &str = "DELETE FROM extensions WHERE assignment = $1 AND student_id = $2";
        const SET: &str = "INSERT INTO extensions (assignment, student_id, closes_at, reason) VALUES ($1, $2, $3, $4)";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(CLEAR).bind(assignment).bind(student_id).execute(&mut *transaction).await?;
            if let Some(own) = own {
                sqlx::query(SET)
                    .bind(assignment)
                    .bind(student_id)
                    .bind(own.closes_at)
                    .bind(&own.reason)
                    .execute(&mut *transaction)
                    .await?;
            }
            transaction.commit().await?;
        });
        Ok(())
    }
}
