//! Moments as people read them, in the time zone of the course.

use crate::language::Language;
use crate::service::clock::Millis;
use jiff::civil::DateTime;
use jiff::tz::TimeZone;
use jiff::{Timestamp, Zoned};

/// A moment for a `time` element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct TimeElement {
    /// As machines read it.
    pub iso: String,
    /// As people do.
    pub text: String,
}

impl TimeElement {
    /// The moment in a time zone. Pages ask [`PageFrame::moment`](super::PageFrame::moment), which knows the course's.
    pub fn of(at: Millis, language: Language, zone: &TimeZone) -> Self {
        let format = match language {
            Language::En => "%-d %b %Y, %H:%M",
            Language::Ja => "%Y年%-m月%-d日 %H:%M",
        };
        let local = local(at, zone);
        Self { iso: local.timestamp().to_string(), text: local.strftime(format).to_string() }
    }

    /// The same with the name of the time zone, for what people must not be late for.
    pub fn zoned(at: Millis, language: Language, zone: &TimeZone) -> Self {
        Self::of(at, language, zone).with_zone(at, zone)
    }

    /// The same to the second.
    pub fn exact(at: Millis, language: Language, zone: &TimeZone) -> Self {
        let seconds = local(at, zone).strftime(":%S").to_string();
        let plain = Self::of(at, language, zone);
        Self { text: plain.text + &seconds, ..plain }.with_zone(at, zone)
    }

    fn with_zone(self, at: Millis, zone: &TimeZone) -> Self {
        let name = local(at, zone).strftime("%Z").to_string();
        // A zone without a name of its own is called by its offset.
        let name = if name.starts_with(['+', '-']) { format!("UTC{name}") } else { name };
        Self { text: format!("{} {name}", self.text), ..self }
    }
}

fn local(at: Millis, zone: &TimeZone) -> Zoned {
    Timestamp::from_millisecond(at).unwrap_or_default().to_zoned(zone.clone())
}

/// What a `datetime-local` field holds: none where it is empty, an error where it is no date.
pub(super) fn parse(field: &str, zone: &TimeZone) -> Result<Option<Millis>, jiff::Error> {
    if field.trim().is_empty() {
        return Ok(None);
    }
    let local: DateTime = field.trim().parse()?;
    Ok(Some(local.to_zoned(zone.clone())?.timestamp().as_millisecond()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::service::clock::local_minute;
    use crate::service::course::Course;

    /// 2026-11-21T13:05:00Z; Tokyo is nine hours ahead, New York five behind.
    const AT: Millis = 1_795_266_300_000;

    fn zone(name: &str) -> TimeZone {
        Course::new(name, Language::En).expect("a zone").zone().clone()
    }

    #[test]
    fn a_moment_is_said_in_both_languages_and_in_any_zone() {
        assert_eq!(TimeElement::of(AT, Language::En, &zone("Asia/Tokyo")).text, "21 Nov 2026, 22:05");
        assert_eq!(TimeElement::of(AT, Language::En, &zone("America/New_York")).text, "21 Nov 2026, 08:05");
        let ja = TimeElement::of(AT, Language::Ja, &zone("Asia/Tokyo"));
        assert_eq!((ja.text.as_str(), ja.iso.as_str()), ("2026年11月21日 22:05", "2026-11-21T13:05:00Z"));
    }

    #[test]
    fn a_deadline_names_its_zone() {
        let named = |zone: TimeZone| TimeElement::zoned(0, Language::En, &zone).text;
        assert_eq!(named(TimeZone::get("Asia/Tokyo").expect("a zone")), "1 Jan 1970, 09:00 JST");
        assert_eq!(named(TimeZone::get("Asia/Dubai").expect("a zone")), "1 Jan 1970, 04:00 UTC+04");
        assert_eq!(named(TimeZone::UTC), "1 Jan 1970, 00:00 UTC");
    }

    #[test]
    fn a_field_comes_back_as_it_was() {
        for zone in [zone("Asia/Tokyo"), zone("America/New_York")] {
            assert_eq!(parse(&local_minute(AT, &zone), &zone).expect("a date"), Some(AT));
            assert_eq!(parse(" ", &zone).expect("nothing"), None);
            assert!(parse("tomorrow", &zone).is_err());
        }
        assert_eq!(local_minute(AT, &zone("Asia/Tokyo")), "2026-11-21T22:05");
    }
}
