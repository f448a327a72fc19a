//! Moments as people read them, in the time zone of the course.

use crate::language::{Language, Text};
use crate::service::clock::{Millis, has_rfc3339, local_minute};
use jiff::civil::DateTime;
use jiff::tz::{AmbiguousOffset, TimeZone};
use jiff::{Timestamp, Zoned};

/// A local time as a field has it.
const MINUTE: &str = "%Y-%m-%dT%H:%M";

/// The word of a query that has local times which a zone has twice or not at all.
const UNCLEAR: &str = "unclear";

/// A moment for a `time` element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::service) struct TimeElement {
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

/// What a `datetime-local` field holds: none where it is empty, what is wrong where it is no date. A field that comes back as it was
/// shown is the moment that was `shown`: it has no seconds, and does not tell apart the two moments of one local time that there are
/// when summer time ends.
pub(super) fn parse(field: &str, zone: &TimeZone, shown: Option<Millis>) -> Result<Option<Millis>, Text> {
    let field = field.trim();
    if field.is_empty() {
        return Ok(None);
    }
    if shown.is_some_and(|at| local_minute(at, zone) == field) {
        return Ok(shown);
    }
    let moment = |local: DateTime| local.to_zoned(zone.clone()).map(|zoned| zoned.timestamp());
    let at = field.parse::<DateTime>().and_then(moment).ok().filter(|at| has_rfc3339(*at)).ok_or_else(no_date)?;
    Ok(Some(at.as_millisecond()))
}

/// An address with the local times among fields and what they showed that were typed anew and are in the zone twice or not at all,
/// because the clocks are set then: its page says which moments they are taken for.
pub(super) fn with_unclear(address: &str, fields: &[(&str, Option<Millis>)], zone: &TimeZone) -> String {
    let unclear = |(field, shown): &(&str, Option<Millis>)| {
        let is_new = shown.is_none_or(|at| local_minute(at, zone) != field.trim());
        let local: DateTime = field.trim().parse().ok().filter(|_| is_new)?;
        zone.to_ambiguous_timestamp(local).is_ambiguous().then(|| local.strftime(MINUTE).to_string())
    };
    let unclear: Vec<String> = fields.iter().filter_map(unclear).collect();
    if unclear.is_empty() {
        return address.to_owned();
    }
    format!("{address}{}{UNCLEAR}={}", if address.contains('?') { '&' } else { '?' }, unclear.join(","))
}

/// What a page says of the local times in its query that are unclear.
pub(super) fn said_of_unclear(query: &str, language: Language, zone: &TimeZone) -> Option<String> {
    let times = query.split('&').find_map(|pair| pair.strip_prefix(UNCLEAR)?.strip_prefix('='))?;
    let said = |time: &str| {
        let local: DateTime = time.parse().ok()?;
        let taken = local.to_zoned(zone.clone()).ok()?.timestamp().as_millisecond();
        let taken = TimeElement::zoned(taken, language, zone).text;
        let offset = zone.to_ambiguous_timestamp(local).offset();
        let local = local.strftime("%Y-%m-%d %H:%M");
        match (offset, language) {
            (AmbiguousOffset::Unambiguous { .. }, _) => None,
            (AmbiguousOffset::Gap { .. }, Language::En) => {
                Some(format!("There is no {local}, because the clocks are set forward: {taken} is taken."))
            }
            (AmbiguousOffset::Gap { .. }, Language::Ja) => {
                Some(format!("{local} は時計が進められるため存在しません。{taken} として設定しました。"))
            }
            (AmbiguousOffset::Fold { .. }, Language::En) => {
                Some(format!("{local} comes twice, because the clocks are set back: the first, {taken}, is taken."))
            }
            (AmbiguousOffset::Fold { .. }, Language::Ja) => {
                Some(format!("{local} は時計が戻されるため 2 回あります。1 回目の {taken} として設定しました。"))
            }
        }
    };
    let said: Vec<String> = times.split(',').filter_map(said).collect();
    Some(said.join(" ")).filter(|said| !said.is_empty())
}

fn no_date() -> Text {
    Text::new("A date has the form 2026-12-31T23:59.", "日時は 2026-12-31T23:59 の形で入力してください。")
}

#[cfg(test)]
mod tests {
    use super::*;
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
    fn what_the_clocks_leave_out_or_repeat_is_said() {
        let berlin = zone("Europe/Berlin");
        let said = |field: &str, shown| {
            let address = with_unclear("/teacher/settings?done=saved", &[(field, shown), ("", None)], &berlin);
            said_of_unclear(address.split_once('?').expect("a query").1, Language::En, &berlin)
        };
        let skipped =
            "There is no 2027-03-28 02:30, because the clocks are set forward: 28 Mar 2027, 03:30 CEST is taken.";
        assert_eq!(said("2027-03-28T02:30", None).as_deref(), Some(skipped));
        let twice = "2027-10-31 02:30 comes twice, because the clocks are set back: the first, 31 Oct 2027, 02:30 CEST, is taken.";
        assert_eq!(said("2027-10-31T02:30", Some(AT)).as_deref(), Some(twice));
        assert_eq!(said("2027-10-31T02:30", Some(1_824_946_200_000)), None, "it is not typed anew");
        assert_eq!(said("2027-10-31T04:30", None), None);
    }

    #[test]
    fn a_field_comes_back_as_it_was() {
        for zone in [zone("Asia/Tokyo"), zone("America/New_York")] {
            assert_eq!(parse(&local_minute(AT, &zone), &zone, None), Ok(Some(AT)));
            assert_eq!(parse(&local_minute(AT, &zone), &zone, Some(AT + 59_000)), Ok(Some(AT + 59_000)));
            assert_eq!(parse(" ", &zone, Some(AT)), Ok(None));
            for wrong in ["tomorrow", "-000001-01-01T00:00"] {
                assert!(parse(wrong, &zone, None).is_err(), "{wrong}");
            }
        }
        assert_eq!(local_minute(AT, &zone("Asia/Tokyo")), "2026-11-21T22:05");
        // The end of summer time: 02:30 comes at 00:30 UTC and again at 01:30. Typed anew it is the first.
        let (first, second) = (1_824_942_600_000, 1_824_946_200_000);
        let (field, berlin) = ("2027-10-31T02:30", zone("Europe/Berlin"));
        assert_eq!(parse(field, &berlin, None), Ok(Some(first)));
        assert_eq!(parse(field, &berlin, Some(second)), Ok(Some(second)));
    }
}
