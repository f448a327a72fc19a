//! Browsers that handed something in, and teachers' sessions. Their cookies are stored as hashes only.

use super::{Result, Store, on};
use crate::service::clock::Millis;

/// A browser that handed something in, or came by the course link.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct Owner {
    /// Id.
    pub id: String,
    /// Who sits there, where they said so.
    pub student_id: Option<String>,
}

impl Store {
    /// The owner of a cookie.
    pub async fn owner(&self, token_hash: &str) -> Result<Option<Owner>> {
        const SQL: &str = "SELECT id, student_id FROM owners WHERE token_hash = $1";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(token_hash).fetch_optional(db).await?))
    }

    /// The owner of a cookie, made when met first.
    pub async fn owner_or_new(&self, token_hash: &str, now: Millis) -> Result<Owner> {
        const SQL: &str = "INSERT INTO owners (id, token_hash, created_at) VALUES ($1, $2, $3) \
                           ON CONFLICT (token_hash) DO NOTHING";
        const SELECT: &str = "SELECT id, student_id FROM owners WHERE token_hash = $1";
        if let Some(owner) = self.owner(token_hash).await? {
            return Ok(owner);
        }
        let id = super::super::identity::new_id();
        on!(&self.write, db => { sqlx::query(SQL).bind(&id).bind(token_hash).bind(now).execute(db).await?; });
        Ok(on!(&self.write, db => sqlx::query_as(SELECT).bind(token_hash).fetch_one(db).await?))
    }

    /// Says who sits at a browser; none: nobody any more.
    pub async fn set_owner_student(&self, owner_id: &str, student_id: Option<&str>) -> Result<()> {
        const SQL: &str = "UPDATE owners SET student_id = $2 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(owner_id).bind(student_id).execute(db).await?; });
        Ok(())
    }

    /// Keeps a teacher's session, and forgets those that are over. `assignment` is the homework whose class it opens; none: all.
    pub async fn open_session(
        &self,
        token_hash: &str,
        assignment: Option<&str>,
        now: Millis,
        expires_at: Millis,
    ) -> Result<()> {
        const CLEAR: &str = "DELETE FROM teacher_sessions WHERE expires_at <= $1";
        const SQL: &str = "INSERT INTO teacher_sessions (token_hash, created_at, expires_at, assignment) \
                           VALUES ($1, $2, $3, $4)";
        on!(&self.write, db => {
            sqlx::query(CLEAR).bind(now).execute(db).await?;
            sqlx::query(SQL).bind(token_hash).bind(now).bind(expires_at).bind(assignment).execute(db).await?;
        });
        Ok(())
    }

    /// The homework whose class a teacher's session opens, none within for all; nothing where no such session is open.
    pub async fn session(&self, token_hash: &str, now: Millis) -> Result<Option<Option<String>>> {
        const SQL: &str = "SELECT assignment FROM teacher_sessions WHERE token_hash = $1 AND expires_at > $2";
        Ok(on!(&self.read, db => sqlx::query_scalar(SQL).bind(token_hash).bind(now).fetch_optional(db).await?))
    }

    /// Ends one session; none: all.
    pub async fn close_session(&self, token_hash: Option<&str>) -> Result<()> {
        const ONE: &str = "DELETE FROM teacher_sessions WHERE token_hash = $1";
        const ALL: &str = "DELETE FROM teacher_sessions";
        on!(&self.write, db => match token_hash {
            Some(hash) => { sqlx::query(ONE).bind(hash).execute(db).await?; }
            None => { sqlx::query(ALL).execute(db).await?; }
        });
        Ok(())
    }
}
