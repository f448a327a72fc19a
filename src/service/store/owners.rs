//! Browsers that handed something in. Their cookies are stored as hashes only.

use super::rows::{from_word, word};
use super::{Result, Store, StudentRecord, on};
use crate::service::clock::Millis;
use serde::{Deserialize, Serialize};

/// A browser that handed something in, or came by the course link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Owner {
    /// Id.
    pub id: String,
    /// Who sits there, where they said so.
    pub student_id: Option<String>,
    /// How they proved it.
    pub proof: Proof,
    /// Generation of the personal code that counted then.
    code_generation: i64,
}

/// How a browser is known to be a student's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Proof {
    /// It was the first that gave the number: counts where no roster has the student.
    First,
    /// By the student's personal code.
    Code,
    /// By the word of a learning platform, or of a reverse proxy.
    Platform,
}

type OwnerRow = (String, Option<String>, String, i64);

impl Owner {
    fn of((id, student_id, proof, code_generation): OwnerRow) -> Result<Self> {
        Ok(Self { id, student_id, proof: from_word(proof)?, code_generation })
    }

    /// Whether this is known to be the student's browser.
    pub fn proves(&self, student: &StudentRecord) -> bool {
        self.student_id.as_deref() == Some(student.id.as_str())
            && self.code_generation == student.code_generation
            && (self.proof != Proof::First || !student.is_on_roster())
    }
}

const SELECT: &str = "SELECT id, student_id, proof, code_generation FROM owners WHERE token_hash = $1";

impl Store {
    /// The owner of a cookie.
    pub async fn owner(&self, token_hash: &str) -> Result<Option<Owner>> {
        let row: Option<OwnerRow> = on!(&self.read, db => {
            sqlx::query_as(SELECT).bind(token_hash).fetch_optional(db).await?
        });
        row.map(Owner::of).transpose()
    }

    /// The owner of a cookie, made when met first.
    pub async fn owner_or_new(&self, token_hash: &str, now: Millis) -> Result<Owner> {
        const SQL: &str = "INSERT INTO owners (id, token_hash, created_at) VALUES ($1, $2, $3) \
                           ON CONFLICT (token_hash) DO NOTHING";
        if let Some(owner) = self.owner(token_hash).await? {
            return Ok(owner);
        }
        let id = super::super::identity::new_id();
        on!(&self.write, db => { sqlx::query(SQL).bind(&id).bind(token_hash).bind(now).execute(db).await?; });
        Owner::of(on!(&self.write, db => sqlx::query_as(SELECT).bind(token_hash).fetch_one(db).await?))
    }

    /// Makes a browser a student's, which is known by another cookie from then on. None where it shall be so as the first that gave the number, and another one was.
    pub async fn bind_owner(
        &self,
        (owner_id, token_hash): (&str, &str),
        student: &StudentRecord,
        proof: Proof,
    ) -> Result<Option<Owner>> {
        // Two that come at once wait for each other at this row.
        const TURN: &str = "UPDATE students SET number = number WHERE id = $1";
        const OTHERS: &str = "SELECT count(*) FROM owners WHERE student_id = $1 AND code_generation = $2 AND id <> $3";
        const BIND: &str = "UPDATE owners SET student_id = $2, proof = $3, code_generation = $4, token_hash = $5 \
                            WHERE id = $1";
        const BOUND: &str = "SELECT id, student_id, proof, code_generation FROM owners WHERE id = $1";
        let row: OwnerRow = on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(TURN).bind(&student.id).execute(&mut *transaction).await?;
            let others: i64 = sqlx::query_scalar(OTHERS)
                .bind(&student.id)
                .bind(student.code_generation)
                .bind(owner_id)
                .fetch_one(&mut *transaction)
                .await?;
            if proof == Proof::First && others > 0 {
                return Ok(None);
            }
            sqlx::query(BIND)
                .bind(owner_id)
                .bind(&student.id)
                .bind(word(&proof))
                .bind(student.code_generation)
                .bind(token_hash)
                .execute(&mut *transaction)
                .await?;
            let row = sqlx::query_as(BOUND).bind(owner_id).fetch_one(&mut *transaction).await?;
            transaction.commit().await?;
            row
        });
        Owner::of(row).map(Some)
    }
}
