//! Who teaches, their sessions and the links by which they choose a password. Secrets are stored as hashes only.

use super::rows::{from_word, word};
use super::{Result, Store, on};
use crate::service::clock::Millis;
use serde::{Deserialize, Serialize};

/// What somebody may do; each may do what those before may.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, utoipa::ToSchema)]
#[schema(as = Role)]
#[serde(rename_all = "lowercase")]
pub enum StaffRole {
    /// Sees the class and its reports.
    Assistant,
    /// Sets the homework, keeps the roster, deletes, grades again, lets assistants in.
    Lecturer,
    /// Lets everybody in.
    Administrator,
}

/// Somebody who teaches.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StaffMember {
    /// Id.
    pub id: String,
    /// The name by which they log in, in small letters.
    pub login: String,
    /// Their name.
    pub name: String,
    /// What they may do.
    pub role: StaffRole,
    /// Whether they have chosen a password.
    pub has_password: bool,
    /// Whether they may log in.
    pub is_active: bool,
}

/// An open session of a teacher.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TeacherSession {
    /// The homework whose class it opens; none: all.
    pub assignment: Option<String>,
    /// Whose it is; none: of who logged in with a secret of the whole service.
    pub staff: Option<StaffMember>,
    /// Whom a reverse proxy named when it was opened.
    pub proxied_name: Option<String>,
}

type StaffRow = (String, String, String, String, i64, i64);

impl StaffMember {
    fn of((id, login, name, role, has_password, is_active): StaffRow) -> Result<Self> {
        let role = from_word(role)?;
        Ok(Self { id, login, name, role, has_password: has_password != 0, is_active: is_active != 0 })
    }
}

/// Selects a [`StaffRow`].
macro_rules! select {
    ($rest:literal) => {
        concat!(
            "SELECT id, login, name, role, CAST(CASE WHEN password_hash IS NULL THEN 0 ELSE 1 END AS BIGINT), is_active \
             FROM staff ",
            $rest
        )
    };
}

impl Store {
    /// Everybody who teaches in this course, by the name by which they log in.
    pub async fn staff(&self) -> Result<Vec<StaffMember>> {
        const SQL: &str = select!("WHERE is_member = 1 ORDER BY login");
        let rows: Vec<StaffRow> = on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?);
        rows.into_iter().map(StaffMember::of).collect()
    }

    /// The one with this id.
    pub async fn staff_member(&self, id: &str) -> Result<Option<StaffMember>> {
        const SQL: &str = select!("WHERE id = $1");
        let row: Option<StaffRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?);
        row.map(StaffMember::of).transpose()
    }

    /// The one with this id, where they teach in this course.
    pub async fn course_member(&self, id: &str) -> Result<Option<StaffMember>> {
        const SQL: &str = select!("WHERE id = $1 AND is_member = 1");
        let row: Option<StaffRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?);
        row.map(StaffMember::of).transpose()
    }

    /// The account of a login, whether they teach in this course or not.
    pub async fn account(&self, login: &str) -> Result<Option<StaffMember>> {
        const SQL: &str = select!("WHERE login = $1");
        let row: Option<StaffRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(login).fetch_optional(db).await?);
        row.map(StaffMember::of).transpose()
    }

    /// Keeps an account of somebody who does not teach in this course; where there is one, it stays as it is.
    pub async fn keep_account(&self, member: &StaffMember, now: Millis) -> Result<()> {
        const SQL: &str = "INSERT INTO staff (id, login, name, role, is_active, created_at, is_member) \
                           VALUES ($1, $2, $3, 'assistant', 1, $4, 0) ON CONFLICT DO NOTHING";
        on!(&self.write, db => {
            sqlx::query(SQL).bind(&member.id).bind(&member.login).bind(&member.name).bind(now).execute(db).await?;
        });
        Ok(())
    }

    /// Lets somebody teach in this course whose account it keeps.
    pub async fn let_teach(&self, id: &str, role: StaffRole) -> Result<()> {
        const SQL: &str = "UPDATE staff SET role = $2, is_active = 1, is_member = 1, is_vouched = 0 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).bind(word(&role)).execute(db).await?; });
        Ok(())
    }

    /// Says that somebody has their role by the word of a learning platform.
    pub async fn vouch(&self, id: &str) -> Result<()> {
        const SQL: &str = "UPDATE staff SET is_vouched = 1 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).execute(db).await?; });
        Ok(())
    }

    /// Gives somebody the role of which a learning platform says now that it is theirs, or none any more: where a platform gave the one
    /// that they have. Who has none teaches no more in this course, and does again as soon as the platform says so.
    pub async fn follow_platform(&self, id: &str, role: Option<StaffRole>) -> Result<()> {
        const ROLE: &str = "UPDATE staff SET role = $2 WHERE id = $1 AND is_vouched = 1 AND role <> 'administrator'";
        // Who was let in anew could log in: whose login was closed stays where they are.
        const NONE: &str = "UPDATE staff SET is_member = 0 WHERE id = $1 AND is_vouched = 1 AND role <> 'administrator' \
                            AND is_active = 1";
        on!(&self.write, db => match role {
            Some(role) => { sqlx::query(ROLE).bind(id).bind(word(&role)).execute(db).await?; }
            None => { sqlx::query(NONE).bind(id).execute(db).await?; }
        });
        Ok(())
    }

    /// The one whose link this is, while it holds.
    pub async fn invited(&self, invitation_hash: &str, now: Millis) -> Result<Option<StaffMember>> {
        const SQL: &str = select!("WHERE invitation_hash = $1 AND invited_until > $2 AND is_active = 1");
        let row: Option<StaffRow> =
            on!(&self.read, db => sqlx::query_as(SQL).bind(invitation_hash).bind(now).fetch_optional(db).await?);
        row.map(StaffMember::of).transpose()
    }

    /// Who logs in by this name, and the hash of their password.
    pub async fn staff_login(&self, login: &str) -> Result<Option<(StaffMember, String)>> {
        const ID: &str = "SELECT id, password_hash FROM staff WHERE login = $1 AND is_active = 1 \
                          AND password_hash IS NOT NULL";
        let found: Option<(String, String)> =
            on!(&self.read, db => sqlx::query_as(ID).bind(login).fetch_optional(db).await?);
        let Some((id, hash)) = found else { return Ok(None) };
        Ok(self.staff_member(&id).await?.map(|member| (member, hash)))
    }

    /// Whether somebody can log in as an administrator.
    pub async fn has_administrator(&self) -> Result<bool> {
        const SQL: &str = "SELECT count(*) FROM staff WHERE role = 'administrator' AND is_active = 1 \
                           AND password_hash IS NOT NULL";
        let count: i64 = on!(&self.read, db => sqlx::query_scalar(SQL).fetch_one(db).await?);
        Ok(count > 0)
    }

    /// Adds somebody; false where the name by which they would log in is taken.
    pub async fn add_staff(&self, member: &StaffMember, now: Millis) -> Result<bool> {
        const SQL: &str = "INSERT INTO staff (id, login, name, role, is_active, created_at) \
                           VALUES ($1, $2, $3, $4, 1, $5) ON CONFLICT (login) DO NOTHING";
        let added = on!(&self.write, db => {
            sqlx::query(SQL)
                .bind(&member.id)
                .bind(&member.login)
                .bind(&member.name)
                .bind(word(&member.role))
                .bind(now)
                .execute(db)
                .await?
                .rows_affected()
        });
        Ok(added > 0)
    }

    /// Gives somebody a link by which they choose a password; an earlier one opens nothing any more.
    pub async fn invite(&self, id: &str, invitation_hash: &str, until: Millis) -> Result<()> {
        const SQL: &str = "UPDATE staff SET invitation_hash = $2, invited_until = $3 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).bind(invitation_hash).bind(until).execute(db).await?; });
        Ok(())
    }

    /// Sets a password, and ends the link and every session of theirs.
    pub async fn set_staff_password(&self, id: &str, hash: &str) -> Result<()> {
        const SET: &str = "UPDATE staff SET password_hash = $2, invitation_hash = NULL, invited_until = NULL \
                           WHERE id = $1";
        const SESSIONS: &str = "DELETE FROM teacher_sessions WHERE staff_id = $1";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(SET).bind(id).bind(hash).execute(&mut *transaction).await?;
            sqlx::query(SESSIONS).bind(id).execute(&mut *transaction).await?;
            transaction.commit().await?;
        });
        Ok(())
    }

    /// Sets what somebody may do, and whether they may log in; who may not has no session, no link and no token any more. Another role
    /// than they had is that of who sets it, and no more a platform's.
    pub async fn set_staff(&self, id: &str, role: StaffRole, is_active: bool) -> Result<()> {
        const SET: &str = "UPDATE staff SET is_vouched = CASE WHEN role = $2 THEN is_vouched ELSE 0 END, role = $2, \
                           is_active = $3 WHERE id = $1";
        const SESSIONS: &str = "DELETE FROM teacher_sessions WHERE staff_id = $1";
        const LINK: &str = "UPDATE staff SET invitation_hash = NULL, invited_until = NULL WHERE id = $1";
        const TOKENS: &str = "DELETE FROM access_tokens WHERE staff_id = $1";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(SET).bind(id).bind(word(&role)).bind(i64::from(is_active)).execute(&mut *transaction).await?;
            if !is_active {
                for sql in [SESSIONS, LINK, TOKENS] {
                    sqlx::query(sql).bind(id).execute(&mut *transaction).await?;
                }
            }
            transaction.commit().await?;
        });
        Ok(())
    }

    /// Keeps a teacher's session, and forgets those that are over.
    pub async fn open_session(
        &self,
        token_hash: &str,
        session: &TeacherSession,
        now: Millis,
        expires_at: Millis,
    ) -> Result<()> {
        const CLEAR: &str = "DELETE FROM teacher_sessions WHERE expires_at <= $1";
        const SQL: &str = "INSERT INTO teacher_sessions (token_hash, created_at, expires_at, assignment, staff_id, \
                           proxied_name) VALUES ($1, $2, $3, $4, $5, $6)";
        on!(&self.write, db => {
            sqlx::query(CLEAR).bind(now).execute(db).await?;
            sqlx::query(SQL)
                .bind(token_hash)
                .bind(now)
                .bind(expires_at)
                .bind(&session.assignment)
                .bind(session.staff.as_ref().map(|member| &member.id))
                .bind(&session.proxied_name)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// The session of a cookie, while it is open.
    pub async fn session(&self, token_hash: &str, now: Millis) -> Result<Option<TeacherSession>> {
        const SQL: &str = "SELECT assignment, staff_id, proxied_name FROM teacher_sessions \
                           WHERE token_hash = $1 AND expires_at > $2";
        let row: Option<(Option<String>, Option<String>, Option<String>)> =
            on!(&self.read, db => sqlx::query_as(SQL).bind(token_hash).bind(now).fetch_optional(db).await?);
        let Some((assignment, staff_id, proxied_name)) = row else { return Ok(None) };
        let session = TeacherSession { assignment, staff: None, proxied_name };
        let Some(staff_id) = staff_id else { return Ok(Some(session)) };
        let member = self.staff_member(&staff_id).await?.filter(|member| member.is_active);
        Ok(member.map(|member| TeacherSession { staff: Some(member), ..session }))
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

    /// Ends the sessions of who logged in with a secret of the whole service, and that secret where it is kept here.
    pub async fn close_shared_way(&self, setting: &str) -> Result<()> {
        const SESSIONS: &str = "DELETE FROM teacher_sessions WHERE staff_id IS NULL";
        const SECRET: &str = "DELETE FROM settings WHERE name = $1";
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(SESSIONS).execute(&mut *transaction).await?;
            sqlx::query(SECRET).bind(setting).execute(&mut *transaction).await?;
            transaction.commit().await?;
        });
        Ok(())
    }
}
