//! The courses of learning platforms, and to which course here each of them belongs.

use super::{Result, Store, on};

/// A course of a learning platform.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct PlatformCourse {
    /// Id of the platform.
    pub platform_id: String,
    /// The platform's id of the course.
    pub context: String,
    /// What the platform calls it.
    pub title: String,
    /// Id of the course here; empty: the one with which the platform is registered; none: nobody has said.
    pub course: Option<String>,
}

impl Store {
    /// Every course from which somebody came.
    pub async fn platform_courses(&self) -> Result<Vec<PlatformCourse>> {
        const SQL: &str = "SELECT platform_id, context, title, course FROM lti_contexts ORDER BY platform_id, context";
        Ok(on!(&self.write, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }

    /// Notes a course from which somebody comes; what was said of it stays.
    pub async fn note_platform_course(&self, noted: &PlatformCourse) -> Result<()> {
        const SQL: &str = "INSERT INTO lti_contexts (platform_id, context, title, course) VALUES ($1, $2, $3, $4) \
                           ON CONFLICT (platform_id, context) DO UPDATE SET title = excluded.title";
        on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&noted.platform_id)
                .bind(&noted.context)
                .bind(&noted.title)
                .bind(&noted.course)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// Whether nobody uses this course yet: it has no students and no files, and nobody has been let in to teach it. Administrators
    /// are there before.
    pub async fn is_unused(&self) -> Result<bool> {
        const SQL: &str = "SELECT (SELECT count(*) FROM students) + (SELECT count(*) FROM submissions) \
                           + (SELECT count(*) FROM batches) \
                           + (SELECT count(*) FROM staff WHERE is_member = 1 AND role <> 'administrator')";
        let count: i64 = on!(&self.write, db => sqlx::query_scalar(SQL).fetch_one(db).await?);
        Ok(count == 0)
    }

    /// Says to which course here a platform's course belongs.
    pub async fn connect_platform_course(&self, platform_id: &str, context: &str, course: Option<&str>) -> Result<()> {
        const SQL: &str = "UPDATE lti_contexts SET course = $3 WHERE platform_id = $1 AND context = $2";
        on!(&self.write, db => {
            sqlx::query(SQL).bind(platform_id).bind(context).bind(course).execute(db).await?;
        });
        Ok(())
    }

    /// Forgets the links of a platform's course and who is in it, so that nothing is sent there any more.
    pub async fn forget_links(&self, platform_id: &str, context: &str) -> Result<()> {
        const LINKS: &str = "DELETE FROM lti_links WHERE platform_id = $1 AND context = $2";
        const MEMBERS: &str = "DELETE FROM lti_members WHERE platform_id = $1 AND context = $2";
        for sql in [LINKS, MEMBERS] {
            on!(&self.write, db => { sqlx::query(sql).bind(platform_id).bind(context).execute(db).await?; });
        }
        Ok(())
    }
}
