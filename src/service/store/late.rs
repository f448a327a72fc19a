//! What lateness takes off. The view `lateness` computes it from the rules of the homework, the deadlines, and the points.

use super::{Result, Store, on};
use crate::report::Lateness;
use crate::service::clock::Millis;
use jiff::Timestamp;
use jiff::tz::{Offset, TimeZone};
use serde::{Deserialize, Serialize};

/// The end of what is kept of a time zone: 2100-01-01. Nobody knows how the clocks are set then.
const ZONES_END: Millis = 4_102_444_800_000;

/// How long a span is for which a late hand-in loses points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum LateSpan {
    /// A day of the calendar in the course's time zone: 24 hours, but where the clocks are set meanwhile.
    #[default]
    Day,
    /// 60 minutes.
    Hour,
}

impl LateSpan {
    /// Its length where no clocks are set, by which it is kept.
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

/// How far a zone is ahead of UTC, and since when, from the beginning of time.
fn offsets(zone: &TimeZone) -> Vec<(Millis, Millis)> {
    let ahead = |offset: Offset| Millis::from(offset.seconds()) * 1_000;
    let changes = zone
        .following(Timestamp::UNIX_EPOCH)
        .map(|change| (change.timestamp().as_millisecond(), ahead(change.offset())));
    let first = (Millis::MIN, ahead(zone.to_offset(Timestamp::UNIX_EPOCH)));
    std::iter::once(first).chain(changes.take_while(|(starts_at, _)| *starts_at < ZONES_END)).collect()
}

impl Store {
    /// Keeps how the clocks are set in the course's time zone: the view `lateness` reckons days by it.
    pub async fn keep_zone(&self, zone: &TimeZone) -> Result<()> {
        const KEPT: &str = "SELECT starts_at, ahead FROM zone_offsets ORDER BY starts_at";
        const CLEAR: &str = "DELETE FROM zone_offsets";
        // Another process of the service may do the same at this moment.
        const INSERT: &str = "INSERT INTO zone_offsets (starts_at, ahead) VALUES ($1, $2) \
                              ON CONFLICT (starts_at) DO UPDATE SET ahead = excluded.ahead";
        let offsets = offsets(zone);
        let kept: Vec<(Millis, Millis)> = on!(&self.write, db => sqlx::query_as(KEPT).fetch_all(db).await?);
        if kept == offsets {
            return Ok(());
        }
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            sqlx::query(CLEAR).execute(&mut *transaction).await?;
            for (starts_at, ahead) in &offsets {
                sqlx::query(INSERT).bind(starts_at).bind(ahead).execute(&mut *transaction).await?;
            }
            transaction.commit().await?;
        });
        Ok(())
    }

    /// How late a submission is; none where it is in time.
    pub async fn lateness(&self, submission_id: &str) -> Result<Option<Lateness>> {
        const SQL: &str = "SELECT late, penalty FROM lateness WHERE submission_id = $1";
        let found: Option<(Millis, f64)> =
            on!(&self.read, db => sqlx::query_as(SQL).bind(submission_id).fetch_optional(db).await?);
        Ok(found.and_then(|(late, penalty)| lateness(late, penalty)))
    }
}
