//! What came of requests with an `Idempotency-Key`.

use super::{Result, Store, on};
use crate::service::clock::Millis;

/// The key of a request, as it is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoredKey {
    /// A hash of the key as the client gave it, and of the client.
    pub id: String,
    /// A hash of what was sent with it.
    pub fingerprint: String,
}

/// What came of a request.
#[derive(Clone, Debug, PartialEq, Eq, sqlx::FromRow)]
pub struct KeyResult {
    /// A hash of what was sent.
    pub fingerprint: String,
    /// The submission that it made.
    pub submission_id: Option<String>,
    /// The batch that it made.
    pub batch_id: Option<String>,
}

/// Keeps a key; does nothing where it is kept already. Another transaction that is about to keep it is waited for.
pub(super) const INSERT: &str = "INSERT INTO idempotency_keys (id, fingerprint, submission_id, batch_id, created_at) \
                                 VALUES ($1, $2, $3, $4, $5) ON CONFLICT (id) DO NOTHING";

/// Keeps the key of what this transaction stores, where there is one. Where it is taken, the function that this stands
/// in stores nothing and gives `$taken`.
macro_rules! keep_key {
    ($transaction:expr, $key:expr, $submission:expr, $batch:expr, $now:expr, $taken:expr) => {
        if let Some(key) = $key {
            let submission: Option<&str> = $submission;
            let batch: Option<&str> = $batch;
            let kept = sqlx::query($crate::service::store::keys::INSERT)
                .bind(&key.id)
                .bind(&key.fingerprint)
                .bind(submission)
                .bind(batch)
                .bind($now)
                .execute(&mut *$transaction)
                .await?;
            if kept.rows_affected() == 0 {
                $transaction.rollback().await?;
                return Ok($taken);
            }
        }
    };
}
pub(super) use keep_key;

impl Store {
    /// What came of the request with this key.
    pub async fn result_of_key(&self, id: &str) -> Result<Option<KeyResult>> {
        const SQL: &str = "SELECT fingerprint, submission_id, batch_id FROM idempotency_keys WHERE id = $1";
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?))
    }

    /// Forgets the keys that came before.
    pub async fn forget_keys(&self, before: Millis) -> Result<()> {
        const SQL: &str = "DELETE FROM idempotency_keys WHERE created_at < $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(before).execute(db).await?; });
        Ok(())
    }
}
