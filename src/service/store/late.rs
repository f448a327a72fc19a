//! What lateness takes off. The view `lateness` computes it from the rules of the homework, the deadlines, and the points.

use super::{Result, Store, on};
use crate::report::Lateness;
use crate::service::clock::Millis;
use serde::{Deserialize, Serialize};

/// How long a span is for which a late hand-in loses points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum LateSpan {
    /// 24 hours.
    #[default]
    Day,
    /// 60 minutes.
    Hour,
}

impl LateSpan {
    /// Its length.
    pub fn millis(self) -> Millis {
        match self {
            Self::Day => 86_400_000,
            Self::Hour => 3_600_000,
        }
    }

    /// The span of this length.
    pub(super) fn of(millis: Millis) -> Self {
        if millis == Self::Hour.millis() { Self::Hour } else { Self::Day }
    }
}

/// What there is after the due date.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LateRules {
    /// How long after the due date a hand-in is still in time.
    pub grace: Millis,
    /// Until when late hand-ins are taken; none: not at all.
    pub until: Option<Millis>,
    /// Percent of all points that go for each span that has begun since the due date.
    pub percent: f64,
    /// The span.
    pub span: LateSpan,
    /// What lateness leaves at least, in percent of all points. Who has fewer points loses none.
    pub floor: f64,
}

/// Lateness as its columns have it.
pub(super) fn lateness(late: Millis, penalty: f64) -> Option<Lateness> {
    (late > 0).then(|| Lateness { milliseconds: late.unsigned_abs(), penalty })
}

impl Store {
    /// How late a submission is; none where it is in time.
    pub async fn lateness(&self, submission_id: &str) -> Result<Option<Lateness>> {
        const SQL: &str = "SELECT late, penalty FROM lateness WHERE submission_id = $1";
        let found: Option<(Millis, f64)> =
            on!(&self.read, db => sqlx::query_as(SQL).bind(submission_id).fetch_optional(db).await?);
        Ok(found.and_then(|(late, penalty)| lateness(late, penalty)))
    }
}
