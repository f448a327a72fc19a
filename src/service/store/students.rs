//! Students: the roster, and those who said who they are.

use super::{Result, Store, on, signed};
use crate::service::clock::Millis;

/// A student.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct StudentRecord {
    /// Id.
    pub id: String,
    /// Student number. Untrusted, as every text here.
    pub number: String,
    /// Name by the roster; empty where it is not known.
    pub name: String,
    /// 1 where the roster has them.
    pub on_roster: i64,
    /// The number by which Moodle's files name them, where the roster has it.
    pub moodle: Option<i64>,
    /// Which personal code of theirs counts, from 0.
    pub code_generation: i64,
    /// The group of the course that they are in; empty where the roster says none.
    pub group_name: String,
    /// Mail address; empty where the roster says none.
    pub email: String,
}

impl StudentRecord {
    /// Whether the roster has them.
    pub fn is_on_roster(&self) -> bool {
        self.on_roster != 0
    }
}

/// A student as a roster names them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RosterLine {
    /// Student number.
    pub number: String,
    /// Name; empty where the roster has none.
    pub name: String,
    /// The number by which Moodle's files name them.
    pub moodle: Option<u64>,
    /// Their group; empty where the roster has none.
    pub group: String,
    /// Their mail address; empty where the roster has none.
    pub email: String,
}

/// An entry of an archive, and who of the roster it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EntryMatch {
    /// Id of the batch.
    pub batch_id: String,
    /// Position in it.
    pub position: i64,
    /// Id of the student; none where it is nobody of the roster.
    pub student_id: Option<String>,
}

impl Store {
    /// The student with this number. Where there is a roster, only who is on it; otherwise they are made when met first.
    pub async fn student(&self, number: &str, now: Millis) -> Result<Option<StudentRecord>> {
        const INSERT: &str = "INSERT INTO students (id, number, name, on_roster, created_at) \
                              SELECT $1, $2, '', 0, $3 WHERE NOT EXISTS (SELECT 1 FROM students WHERE on_roster = 1) \
                              ON CONFLICT (number) DO NOTHING";
        const SELECT: &str = "SELECT id, number, name, on_roster, moodle, code_generation, group_name, email FROM students WHERE number = $1 \
                              AND (on_roster = 1 OR NOT EXISTS (SELECT 1 FROM students WHERE on_roster = 1))";
        let found = on!(&self.read, db => sqlx::query_as(SELECT).bind(number).fetch_optional(db).await?);
        if found.is_some() {
            return Ok(found);
        }
        let id = super::super::identity::new_id();
        on!(&self.write, db => { sqlx::query(INSERT).bind(&id).bind(number).bind(now).execute(db).await?; });
        Ok(on!(&self.write, db => sqlx::query_as(SELECT).bind(number).fetch_optional(db).await?))
    }

    /// The student with this id.
    pub async fn student_by_id(&self, id: &str) -> Result<Option<StudentRecord>> {
        const SQL: &str = "SELECT id, number, name, on_roster, moodle, code_generation, group_name, email FROM students WHERE id = $1";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?))
    }

    /// The student with this number, whether the roster has them or not.
    pub async fn student_by_number(&self, number: &str) -> Result<Option<StudentRecord>> {
        const SQL: &str = "SELECT id, number, name, on_roster, moodle, code_generation, group_name, email FROM students WHERE number = $1";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(number).fetch_optional(db).await?))
    }

    /// Everyone, by number.
    pub async fn students(&self) -> Result<Vec<StudentRecord>> {
        const SQL: &str = "SELECT id, number, name, on_roster, moodle, code_generation, group_name, email FROM students ORDER BY number";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }

    /// The roster, by number; empty where there is none.
    pub async fn roster(&self) -> Result<Vec<StudentRecord>> {
        Ok(self.students().await?.into_iter().filter(StudentRecord::is_on_roster).collect())
    }

    /// Everyone who has a personal code: the roster; without one, whoever gave a number.
    pub async fn with_codes(&self) -> Result<Vec<StudentRecord>> {
        let mut students = self.students().await?;
        let has_roster = students.iter().any(StudentRecord::is_on_roster);
        students.retain(|student| !has_roster || student.is_on_roster());
        Ok(students)
    }

    /// The names of the groups of the roster.
    pub async fn groups(&self) -> Result<Vec<String>> {
        const SQL: &str =
            "SELECT DISTINCT group_name FROM students WHERE on_roster = 1 AND group_name <> '' ORDER BY group_name";
        Ok(on!(&self.read, db => sqlx::query_scalar(SQL).fetch_all(db).await?))
    }

    /// Whether there is a roster: then it is the class.
    pub async fn has_roster(&self) -> Result<bool> {
        const SQL: &str = "SELECT count(*) FROM (SELECT 1 FROM students WHERE on_roster = 1 LIMIT 1) AS one";
        let count: i64 = on!(&self.read, db => sqlx::query_scalar(SQL).fetch_one(db).await?);
        Ok(count > 0)
    }

    /// Takes a roster in place of the last one; who is not on it any more keeps their files, and no mail address is kept of them.
    pub async fn set_roster(&self, roster: &[RosterLine], now: Millis) -> Result<()> {
        const CLEAR: &str = "UPDATE students SET on_roster = 0, email = ''";
        const INSERT: &str = "INSERT INTO students (id, number, name, on_roster, created_at, moodle, group_name, email) \
                              VALUES ($1, $2, $3, 1, $4, $5, $6, $7) ON CONFLICT (number) DO UPDATE SET \
                              name = excluded.name, on_roster = 1, moodle = excluded.moodle, \
                              group_name = excluded.group_name, email = excluded.email";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(CLEAR).execute(&mut *transaction).await?;
            for line in roster {
                sqlx::query(INSERT)
                    .bind(super::super::identity::new_id())
                    .bind(&line.number)
                    .bind(&line.name)
                    .bind(now)
                    .bind(line.moodle.map(signed))
                    .bind(&line.group)
                    .bind(&line.email)
                    .execute(&mut *transaction)
                    .await?;
            }
            transaction.commit().await?;
        });
        Ok(())
    }

    /// The student with a number, whom a learning platform has. Where there is a roster, they stand on it from now on.
    pub async fn enrol(&self, line: &RosterLine, now: Millis) -> Result<StudentRecord> {
        const SQL: &str = "INSERT INTO students (id, number, name, on_roster, created_at) \
                           VALUES ($1, $2, $3, CAST($4 AS BIGINT), $5) ON CONFLICT (number) DO UPDATE SET \
                           name = CASE WHEN students.name = '' THEN excluded.name ELSE students.name END, \
                           on_roster = CASE WHEN excluded.on_roster = 1 THEN 1 ELSE students.on_roster END";
        const SELECT: &str = "SELECT id, number, name, on_roster, moodle, code_generation, group_name, email FROM students WHERE number = $1";
        let on_roster = i64::from(self.has_roster().await?);
        Ok(on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(super::super::identity::new_id())
                .bind(&line.number)
                .bind(&line.name)
                .bind(on_roster)
                .bind(now)
                .execute(db)
                .await?;
            sqlx::query_as(SELECT).bind(&line.number).fetch_one(db).await?
        }))
    }

    /// Makes another personal code count for a student: browsers that are bound by an earlier one are theirs no more.
    pub async fn renew_code(&self, student_id: &str) -> Result<()> {
        const SQL: &str = "UPDATE students SET code_generation = code_generation + 1 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(student_id).execute(db).await?; });
        Ok(())
    }

    /// Says of entries of archives, and of their files, who of the roster they are.
    pub async fn set_matches(&self, matches: &[EntryMatch]) -> Result<()> {
        const ENTRY: &str = "UPDATE batch_entries SET student_id = $3 WHERE batch_id = $1 AND position = $2";
        const FILE: &str = "UPDATE submissions SET student_id = $3 WHERE id = \
                            (SELECT submission_id FROM batch_entries WHERE batch_id = $1 AND position = $2)";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            for found in matches {
                for sql in [ENTRY, FILE] {
                    sqlx::query(sql)
                        .bind(&found.batch_id)
                        .bind(found.position)
                        .bind(&found.student_id)
                        .execute(&mut *transaction)
                        .await?;
                }
            }
            transaction.commit().await?;
        });
        Ok(())
    }
}
