//! Sign-ins that are under way. Their states are stored as hashes only.

use super::{Result, Store, on};
use crate::service::clock::Millis;

/// A sign-in that was begun.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct SignIn {
    /// Id of the provider.
    pub provider: String,
    /// What the issuer has to repeat.
    pub nonce: String,
    /// What shows the issuer that the code comes back to who began.
    pub verifier: String,
    /// Id of the homework to go on with.
    pub homework: Option<String>,
}

impl Store {
    /// Begins a sign-in, and forgets those that were never finished.
    pub async fn begin_sign_in(&self, state_hash: &str, begun: &SignIn, now: Millis, until: Millis) -> Result<()> {
        const CLEAR: &str = "DELETE FROM sign_ins WHERE expires_at <= $1";
        const SQL: &str = "INSERT INTO sign_ins (state_hash, provider, nonce, verifier, homework, expires_at) \
                           VALUES ($1, $2, $3, $4, $5, $6)";
        on!(&self.write, db => {
            sqlx::query(CLEAR).bind(now).execute(db).await?;
            sqlx::query(SQL)
                .bind(state_hash)
                .bind(&begun.provider)
                .bind(&begun.nonce)
                .bind(&begun.verifier)
                .bind(&begun.homework)
                .bind(until)
                .execute(db)
                .await?;
        });
        Ok(())
    }

    /// The sign-in of a state, which is used up by that: whoever comes second gets nothing.
    pub async fn take_sign_in(&self, state_hash: &str, now: Millis) -> Result<Option<SignIn>> {
        const SQL: &str = "DELETE FROM sign_ins WHERE state_hash = $1 AND expires_at > $2 \
                           RETURNING provider, nonce, verifier, homework";
        Ok(on!(&self.write, db => sqlx::query_as(SQL).bind(state_hash).bind(now).fetch_optional(db).await?))
    }
}
