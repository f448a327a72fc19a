//! The courses beside the first one, and what a course says of its homeworks.

use super::{Result, Store, StoreError, on};
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

    /// Adds a course; whether there was none with this id. It is there once `fill` has filled its tables: where that fails, and
    /// where the process ends before, it is not. Until then whoever adds the same one waits.
    pub async fn add_course<E: From<StoreError>>(
        &self,
        id: &str,
        now: Millis,
        fill: impl AsyncFnOnce() -> std::result::Result<(), E>,
    ) -> std::result::Result<bool, E> {
        const SQL: &str = "INSERT INTO courses (id, created_at) VALUES ($1, $2) ON CONFLICT (id) DO NOTHING";
        on!(&self.write, db => {
            let mut transaction = db.begin().await.map_err(StoreError::from)?;
            let added = sqlx::query(SQL).bind(id).bind(now).execute(&mut *transaction).await;
            if added.map_err(StoreError::from)?.rows_affected() == 0 {
                return Ok(false);
            }
            fill().await?;
            transaction.commit().await.map_err(StoreError::from)?;
        });
        Ok(true)
    }

    /// Empties tables that were filled for a course that then was not added; whether nothing of people is in them. Where
    /// something is, all of it stays.
    pub async fn forget_unfinished(&self) -> Result<bool> {
        const PEOPLE: &str = "SELECT (SELECT count(*) FROM students) + (SELECT count(*) FROM submissions) \
                              + (SELECT count(*) FROM staff) + (SELECT count(*) FROM batches)";
        const CLEAR: [&str; 4] =
            ["DELETE FROM folder_files", "DELETE FROM folders", "DELETE FROM assignments", "DELETE FROM settings"];
        let people: i64 = on!(&self.write, db => sqlx::query_scalar(PEOPLE).fetch_one(db).await?);
        if people > 0 {
            return Ok(false);
        }
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            for sql in CLEAR {
                sqlx::query(sql).execute(&mut *transaction).await?;
            }
            transaction.commit().await?;
        });
        Ok(true)
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
