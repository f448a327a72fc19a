//! Students: the roster, and those who said who they are.

use super::{Result, Store, on};
use crate::service::clock::Millis;

/// A student.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct Student {
    /// Id.
    pub id: String,
    /// Student number. Untrusted, as every text here.
    pub number: String,
    /// Name by the roster; empty where it is not known.
    pub name: String,
    /// 1 where the roster has them.
    pub on_roster: i64,
}

impl Store {
    /// The student with this number, who is made when met first.
    pub async fn student(&self, number: &str, now: Millis) -> Result<Student> {
        const INSERT: &str = "INSERT INTO students (id, number, name, on_roster, created_at) \
                              VALUES ($1, $2, '', 0, $3) ON CONFLICT (number) DO NOTHING";
        const SELECT: &str = "SELECT id, number, name, on_roster FROM students WHERE number = $1";
        let found = on!(&self.read, db => sqlx::query_as(SELECT).bind(number).fetch_optional(db).await?);
        if let Some(student) = found {
            return Ok(student);
        }
        let id = super::super::identity::new_id();
        on!(&self.write, db => { sqlx::query(INSERT).bind(&id).bind(number).bind(now).execute(db).await?; });
        Ok(on!(&self.write, db => sqlx::query_as(SELECT).bind(number).fetch_one(db).await?))
    }

    /// The student with this id.
    pub async fn student_by_id(&self, id: &str) -> Result<Option<Student>> {
        const SQL: &str = "SELECT id, number, name, on_roster FROM students WHERE id = $1";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?))
    }

    /// Everyone, by number.
    pub async fn students(&self) -> Result<Vec<Student>> {
        const SQL: &str = "SELECT id, number, name, on_roster FROM students ORDER BY number";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }

    /// Takes a roster of (number, name) pairs in place of the last one; who is not on it any more keeps their files.
    pub async fn set_roster(&self, roster: &[(String, String)], now: Millis) -> Result<()> {
        const CLEAR: &str = "UPDATE students SET on_roster = 0";
        const INSERT: &str = "INSERT INTO students (id, number, name, on_roster, created_at) \
                              VALUES ($1, $2, $3, 1, $4) \
                              ON CONFLICT (number) DO UPDATE SET name = excluded.name, on_roster = 1";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(CLEAR).execute(&mut *transaction).await?;
            for (number, name) in roster {
                let id = super::super::identity::new_id();
                sqlx::query(INSERT).bind(&id).bind(number).bind(name).bind(now).execute(&mut *transaction).await?;
            }
            transaction.commit().await?;
        });
        Ok(())
    }
}
