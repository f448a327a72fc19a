//! Tokens by which programs act for somebody who teaches. A token is stored as a hash only.

use super::rows::{from_word, word};
use super::{Result, StaffMember, Store, on};
use crate::service::clock::Millis;
use serde::{Deserialize, Serialize};

/// What a program may do with a token; never more than the token's owner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum TokenScope {
    /// Read.
    Read,
    /// Read, and hand in for students.
    Submit,
    /// Whatever its owner may do.
    All,
}

/// A token, without its secret.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AccessToken {
    /// Id.
    pub id: String,
    /// Id of its owner.
    pub staff_id: String,
    /// What its owner calls it.
    pub name: String,
    /// What it is good for.
    pub scope: TokenScope,
    /// Id of the homework that it is for; none: all that its owner sees.
    pub assignment: Option<String>,
    /// When it was made.
    pub created_at: Millis,
    /// When it ends.
    pub expires_at: Millis,
    /// When it was used last, to the hour.
    pub last_used_at: Option<Millis>,
}

/// A token with the name by which its owner logs in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnedToken {
    /// The token.
    pub token: AccessToken,
    /// The owner's login.
    pub login: String,
}

type TokenRow = (String, String, String, String, Option<String>, Millis, Millis, Option<Millis>);

impl AccessToken {
    fn of((id, staff_id, name, scope, assignment, created_at, expires_at, last_used_at): TokenRow) -> Result<Self> {
        let scope = from_word(scope)?;
        Ok(Self { id, staff_id, name, scope, assignment, created_at, expires_at, last_used_at })
    }
}

/// Selects a [`TokenRow`].
macro_rules! select {
    ($rest:literal) => {
        concat!(
            "SELECT id, staff_id, name, scope, assignment, created_at, expires_at, last_used_at FROM access_tokens ",
            $rest
        )
    };
}

/// How exactly it is kept when a token was used, in milliseconds: a program that asks every second shall not write every
/// second.
const HOUR: Millis = 3_600_000;

impl Store {
    /// Keeps a new token, and forgets those that are over.
    pub async fn add_token(&self, token: &AccessToken, token_hash: &str) -> Result<()> {
        const CLEAR: &str = "DELETE FROM access_tokens WHERE expires_at <= $1";
        const SQL: &str = "INSERT INTO access_tokens \
                           (id, staff_id, name, scope, assignment, token_hash, created_at, expires_at) \
                           VALUES ($1, $2, $3, $4, $5, $6, $7, $8)";
        on!(&self.write, db => {
            sqlx::query(CLEAR).bind(token.created_at).execute(db).await?;
            sqlx::query(SQL)
                .bind(&token.id)
                .bind(&token.staff_id)
                .bind(&token.name)
                .bind(word(&token.scope))
                .bind(&token.assignment)
                .bind(token_hash)
                .bind(token.created_at)
                .bind(token.expires_at)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// The tokens that hold, of one owner or of everybody; the newest first.
    pub async fn tokens(&self, staff_id: Option<&str>, now: Millis) -> Result<Vec<OwnedToken>> {
        const SQL: &str = select!("WHERE expires_at > $1 ORDER BY created_at DESC, id");
        let rows: Vec<TokenRow> = on!(&self.read, db => sqlx::query_as(SQL).bind(now).fetch_all(db).await?);
        let mut owned = Vec::new();
        for row in rows.into_iter().filter(|row| staff_id.is_none_or(|owner| owner == row.1)) {
            // An administrator has tokens here without being of the course's staff.
            let login = self.staff_member(&row.1).await?.map(|owner| owner.login).unwrap_or_default();
            owned.push(OwnedToken { token: AccessToken::of(row)?, login });
        }
        Ok(owned)
    }

    /// The token with this hash and its owner, while it holds and its owner may log in; notes that it is used.
    pub async fn use_token(&self, token_hash: &str, now: Millis) -> Result<Option<(AccessToken, StaffMember)>> {
        const SQL: &str = select!("WHERE token_hash = $1 AND expires_at > $2");
        const USED: &str = "UPDATE access_tokens SET last_used_at = $2 WHERE id = $1";
        let row: Option<TokenRow> =
            on!(&self.read, db => sqlx::query_as(SQL).bind(token_hash).bind(now).fetch_optional(db).await?);
        let Some(token) = row.map(AccessToken::of).transpose()? else { return Ok(None) };
        let owner = self.staff_member(&token.staff_id).await?.filter(|member| member.is_active);
        if owner.is_some() && token.last_used_at.is_none_or(|last| now - last >= HOUR) {
            on!(&self.write, db => { sqlx::query(USED).bind(&token.id).bind(now).execute(db).await?; });
        }
        Ok(owner.map(|owner| (token, owner)))
    }

    /// Ends a token.
    pub async fn remove_token(&self, id: &str) -> Result<()> {
        const SQL: &str = "DELETE FROM access_tokens WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).execute(db).await?; });
        Ok(())
    }
}
