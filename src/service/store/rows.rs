//! Rows as the rest of the service sees them.

use crate::fault::Fault;
use crate::report::Hints;
use crate::service::clock::Millis;
use serde::{Deserialize, Serialize};

/// The way by which a file came.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Via {
    /// The form of the student's page.
    Page,
    /// The editor, as one types: a draft, which is in no history, counts as no attempt, and is removed after a day.
    Editor,
    /// The HTTP API.
    Api,
    /// A teacher's upload of a whole class.
    Batch,
}

/// How far a submission is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[schema(as = State)]
#[serde(rename_all = "lowercase")]
pub enum SubmissionState {
    /// Stored, to be graded.
    Queued,
    /// There is a report.
    Graded,
    /// Grading failed by our fault; it is tried again.
    Failed,
}

/// What was handed in, without its files.
#[derive(Clone, Debug, PartialEq)]
pub struct Submission {
    /// Its unguessable id: whoever has it may see the report.
    pub id: String,
    /// Id of the assignment.
    pub assignment: String,
    /// Its digest in hexadecimal, see [`crate::hand_in::digest`].
    pub sha256: String,
    /// The names of its files as handed in, in one line. Untrusted.
    pub name: String,
    /// The browser that handed it in.
    pub owner_id: Option<String>,
    /// The student, where they said who they are.
    pub student_id: Option<String>,
    /// The batch that it came in.
    pub batch_id: Option<String>,
    /// The way by which it came.
    pub via: Via,
    /// Seed of its fresh probes.
    pub seed: u64,
    /// How much its messages help.
    pub hints: Hints,
    /// When it came.
    pub received_at: Millis,
    /// How far it is.
    pub state: SubmissionState,
    /// Why it failed, where it did.
    pub fault: Option<Fault>,
}

/// The columns of [`Submission`], in its order.
macro_rules! submission_columns {
    () => {
        "s.id, s.assignment, s.digest, s.name, s.owner_id, s.student_id, s.batch_id, s.via, s.seed, s.hints, \
         s.received_at, s.state, s.fault"
    };
}
pub(crate) use submission_columns;

impl<'r, R: sqlx::Row> sqlx::FromRow<'r, R> for Submission
where
    &'static str: sqlx::ColumnIndex<R>,
    String: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    i64: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
    Option<String>: sqlx::Decode<'r, R::Database> + sqlx::Type<R::Database>,
{
    fn from_row(row: &'r R) -> Result<Self, sqlx::Error> {
        let fault: Option<String> = row.try_get("fault")?;
        let fault = fault.map(|json| serde_json::from_str(&json)).transpose();
        Ok(Self {
            id: row.try_get("id")?,
            assignment: row.try_get("assignment")?,
            sha256: row.try_get("digest")?,
            name: row.try_get("name")?,
            owner_id: row.try_get("owner_id")?,
            student_id: row.try_get("student_id")?,
            batch_id: row.try_get("batch_id")?,
            via: from_word(row.try_get("via")?)?,
            seed: row.try_get::<i64, _>("seed")?.unsigned_abs(),
            hints: from_word(row.try_get("hints")?)?,
            received_at: row.try_get("received_at")?,
            state: from_word(row.try_get("state")?)?,
            fault: fault.map_err(|error| sqlx::Error::Decode(Box::new(error)))?,
        })
    }
}

/// The word by which serde calls a unit variant.
pub(crate) fn word<T: Serialize>(value: &T) -> String {
    serde_json::to_value(value).ok().and_then(|value| value.as_str().map(str::to_owned)).unwrap_or_default()
}

/// The variant of such a word.
pub(crate) fn from_word<T: for<'de> Deserialize<'de>>(word: String) -> Result<T, sqlx::Error> {
    serde_json::from_value(serde_json::Value::String(word)).map_err(|error| sqlx::Error::Decode(Box::new(error)))
}
