//! The courses beside the first one, and what a course says of its homeworks.

use super::{Result, Store, on};
use crate::service::clock::Millis;

/// Name of the setting that holds when the course was archived.
const ARCHIVED: &str = "archived_at";

/// A homework's place in its course.
#[derive(Clone, Debug, PartialEq, sqlx::FromRow)]
pub struct CoursePlace {
    /// Id of the homework.
    pub id: String,
    /// 1 where the course has it, whatever the command line says.
    pub is_chosen: i64,
    /// Its place in the order; none: behind all that have one.
    pub position: Option<i64>,
    /// What it counts in the course; none: as many points as its rubric has.
    pub points: Option<f64>,
    /// 1 where students do not see it.
    pub is_hidden: i64,
    /// From when on they do.
    pub shown_from: Option<Millis>,
}

impl Store {
    /// The ids of the courses beside the first one, in the order in which they were made.
    pub async fn courses(&self) -> Result<Vec<String>> {
        const SQL: &str = "SELECT id FROM courses ORDER BY created_at, id";
        Ok(on!(&self.write, db => sqlx::query_scalar(SQL).fetch_all(db).await?))
    }

    /// Adds a course; whether there was none with this id.
    pub async fn add_course(&self, id: &str, now: Millis) -> Result<bool> {
        const SQL: &str = "INSERT INTO courses (id, created_at) VALUES ($1, $2) ON CONFLICT (id) DO NOTHING";
        Ok(on!(&self.write, db => sqlx::query(SQL).bind(id).bind(now).execute(db).await?.rows_affected()) > 0)
    }

    /// When this course was archived; none: it is not.
    pub async fn archived_at(&self) -> Result<Option<Millis>> {
        Ok(self.setting(ARCHIVED).await?.and_then(|at| at.parse().ok()))
    }

    /// Archives this course, or opens it again.
    pub async fn set_archived(&self, at: Option<Millis>) -> Result<()> {
        const SQL: &str = "DELETE FROM settings WHERE name = $1";
        match at {
            Some(at) => self.set_setting(ARCHIVED, &at.to_string()).await,
            None => {
                on!(&self.write, db => { sqlx::query(SQL).bind(ARCHIVED).execute(db).await?; });
                Ok(())
            }
        }
    }

    /// What the course says of every homework that it has met, in its order.
    pub async fn places(&self) -> Result<Vec<CoursePlace>> {
        const SQL: &str = "SELECT id, is_chosen, position, points, is_hidden, shown_from FROM assignments \
                           ORDER BY CASE WHEN position IS NULL THEN 1 ELSE 0 END, position, id";
        Ok(on!(&self.write, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }

    /// Sets what the course says of homeworks, which it has met.
    pub async fn set_places(&self, places: &[CoursePlace]) -> Result<()> {
        const SQL: &str = "UPDATE assignments SET is_chosen = $2, position = $3, points = $4, is_hidden = $5, \
                           shown_from = $6 WHERE id = $1";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            for place in places {
                sqlx::query(SQL)
                    .bind(&place.id)
                    .bind(place.is_chosen)
                    .bind(place.position)
                    .bind(place.points)
                    .bind(place.is_hidden)
                    .bind(place.shown_from)
                    .execute(&mut *transaction)
                    .await?;
            }
            transaction.commit().await?;
        });
        Ok(())
    }
}
