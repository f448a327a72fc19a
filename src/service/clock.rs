//! What time it is: the machine's, or one that a test sets.

use jiff::tz::{Offset, TimeZone};
use jiff::{Span, Timestamp};
use std::sync::atomic::{AtomicI64, Ordering};
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// Milliseconds since 1970 in UTC.
pub type Millis = i64;

/// A time of a time zone to the minute, as a `datetime-local` field has it.
pub fn local_minute(at: Millis, zone: &TimeZone) -> String {
    let timestamp = Timestamp::from_millisecond(at).unwrap_or_default();
    timestamp.to_zoned(zone.clone()).strftime("%Y-%m-%dT%H:%M").to_string()
}

/// The same as the log has it: with seconds where there are some, and with the offset where the zone has two such times.
pub fn local_moment(at: Millis, zone: &TimeZone) -> String {
    let local = Timestamp::from_millisecond(at).unwrap_or_default().to_zoned(zone.clone());
    let mut text = local_minute(at, zone);
    if local.second() != 0 {
        text += &local.strftime(":%S").to_string();
    }
    if zone.to_ambiguous_timestamp(local.datetime()).is_ambiguous() {
        text += &local.strftime("%:z").to_string();
    }
    text
}

/// The same local time some days later, or earlier: a day in which the clocks are set has 23 or 25 hours. What no calendar has stays.
pub fn days_later(at: Millis, days: i64, zone: &TimeZone) -> Millis {
    let moved = |at: Timestamp| at.to_zoned(zone.clone()).checked_add(Span::new().try_days(days)?);
    let moved = Timestamp::from_millisecond(at).and_then(moved);
    moved.map_or(at, |moved| moved.timestamp().as_millisecond())
}

/// A clock.
#[derive(Clone, Debug, Default)]
pub struct Clock(Option<Arc<AtomicI64>>);

impl Clock {
    /// The machine's clock.
    pub fn system() -> Self {
        Self(None)
    }

    /// A clock that stands at `now` until it is moved.
    pub fn fixed(now: Millis) -> Self {
        Self(Some(Arc::new(AtomicI64::new(now))))
    }

    /// Moves a fixed clock forward; the machine's goes by itself.
    pub fn advance(&self, by: Duration) {
        if let Some(fixed) = &self.0 {
            fixed.fetch_add(millis(by), Ordering::SeqCst);
        }
    }

    /// Time that has gone by, which nobody who sets the machine's clock changes.
    pub fn elapsed(&self) -> Duration {
        static START: LazyLock<Instant> = LazyLock::new(Instant::now);
        match &self.0 {
            Some(fixed) => Duration::from_millis(fixed.load(Ordering::SeqCst).unsigned_abs()),
            None => START.elapsed(),
        }
    }

    /// Now.
    pub fn now(&self) -> Millis {
        match &self.0 {
            Some(fixed) => fixed.load(Ordering::SeqCst),
            None => SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, millis),
        }
    }
}

/// A moment as RFC 3339 writes it, in UTC.
pub fn rfc3339(at: Millis) -> String {
    jiff::Timestamp::from_millisecond(at).map(|time| time.to_string()).unwrap_or_default()
}

/// Whether a moment can be written so: in years from 0 on. Later ones than those of four digits there are none of.
pub fn has_rfc3339(at: Timestamp) -> bool {
    Offset::UTC.to_datetime(at).year() >= 0
}

/// A span of time in milliseconds.
pub fn millis(span: Duration) -> Millis {
    Millis::try_from(span.as_millis()).unwrap_or(Millis::MAX)
}
