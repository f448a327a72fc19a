//! Moments as people read them, in the time zone of the machine.

use crate::language::Language;
use crate::service::clock::Millis;
use jiff::Timestamp;
use jiff::civil::DateTime;
use jiff::tz::TimeZone;

/// A moment for a `time` element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Moment {
    /// As machines read it.
    pub iso: String,
    /// As people do.
    pub text: String,
}

impl Moment {
    /// The moment in the machine's time zone.
    pub fn of(at: Millis, language: Language) -> Self {
        Self::in_zone(at, language, TimeZone::system())
    }

    fn in_zone(at: Millis, language: Language, zone: TimeZone) -> Self {
        let timestamp = Timestamp::from_millisecond(at).unwrap_or_default();
        let format = match language {
            Language::En => "%-d %b %Y, %H:%M",
            Language::Ja => "%Y年%-m月%-d日 %H:%M",
        };
        Self { iso: timestamp.to_string(), text: timestamp.to_zoned(zone).strftime(format).to_string() }
    }
}

/// The value of a `datetime-local` field.
pub(super) fn field(at: Millis) -> String {
    let timestamp = Timestamp::from_millisecond(at).unwrap_or_default();
    timestamp.to_zoned(TimeZone::system()).strftime("%Y-%m-%dT%H:%M").to_string()
}

/// What a `datetime-local` field holds: none where it is empty, an error where it is no date.
pub(super) fn parse(field: &str) -> Result<Option<Millis>, jiff::Error> {
    if field.trim().is_empty() {
        return Ok(None);
    }
    let local: DateTime = field.trim().parse()?;
    Ok(Some(local.to_zoned(TimeZone::system())?.timestamp().as_millisecond()))
}

/// The machine's time zone, such as `Asia/Tokyo`.
pub(super) fn zone() -> String {
    let zone = TimeZone::system();
    zone.iana_name().map_or_else(|| "UTC".to_owned(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_is_said_in_both_languages() {
        // 2026-11-21T13:05:00Z; Tokyo is nine hours ahead.
        let at = 1_795_266_300_000;
        let zone = || TimeZone::fixed(jiff::tz::offset(9));
        assert_eq!(Moment::in_zone(at, Language::En, zone()).text, "21 Nov 2026, 22:05");
        let ja = Moment::in_zone(at, Language::Ja, zone());
        assert_eq!((ja.text.as_str(), ja.iso.as_str()), ("2026年11月21日 22:05", "2026-11-21T13:05:00Z"));
    }

    #[test]
    fn a_field_comes_back_as_it_was() {
        let at = 1_795_266_300_000;
        assert_eq!(parse(&field(at)).expect("a date"), Some(at));
        assert_eq!(parse(" ").expect("nothing"), None);
        assert!(parse("tomorrow").is_err());
    }
}
