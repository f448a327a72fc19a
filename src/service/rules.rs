//! What a homework's rules may be, whoever sets them: a form or a program.

use super::clock::{Millis, local_moment};
use super::store::{AssignmentSettings, CoursePlace, word};
use crate::language::Text;
use crate::report::text::number;
use jiff::Timestamp;
use jiff::tz::{Offset, TimeZone};
use std::ops::RangeInclusive;

/// A minute.
pub const MINUTE: Millis = 60_000;

/// Longest grace, in minutes: a week.
pub const LONGEST_GRACE: Millis = 10_080;

/// Most points that a homework counts.
const MOST_POINTS: f64 = 100_000.0;

/// Most attempts of one student.
const MOST_ATTEMPTS: u64 = 1_000_000;

/// The years in which something may be due: others are typing errors.
const YEARS: RangeInclusive<i16> = 2000..=2999;

/// What is said of a number of attempts that is none.
pub fn no_attempts() -> Text {
    Text::new(
        format!("Attempts: a whole number from 1 to {MOST_ATTEMPTS}, or nothing."),
        format!("提出回数は 1 から {MOST_ATTEMPTS} までの整数で入力するか、空欄にしてください。"),
    )
}

/// A date, where it is in one of the years in which something may be.
pub fn check_date(at: Option<Millis>) -> Result<(), Text> {
    let year = |at: Timestamp| Offset::UTC.to_datetime(at).year();
    if at.is_none_or(|at| Timestamp::from_millisecond(at).is_ok_and(|at| YEARS.contains(&year(at)))) {
        return Ok(());
    }
    let (first, last) = (YEARS.start(), YEARS.end());
    Err(Text::new(
        format!("A date is in the years {first} to {last}. Correct the year."),
        format!("日時は {first} 年から {last} 年までで入力してください。年を確認してください。"),
    ))
}

/// What a homework counts in its course, where it may count that.
pub fn check_points(points: f64) -> Result<f64, Text> {
    if (0.0..=MOST_POINTS).contains(&points) {
        return Ok(points);
    }
    Err(Text::new("Points: a number from 0, or nothing.", "配点は 0 以上の数値で入力するか、空欄にしてください。"))
}

/// What is wrong with rules, where something is.
pub fn check(rules: &AssignmentSettings) -> Result<(), Text> {
    let (opens, due, late) = (rules.opens_at, rules.closes_at, &rules.late);
    let is_share = |number: f64| (0.0..=100.0).contains(&number);
    for date in [opens, due, late.until] {
        check_date(date)?;
    }
    if opens.zip(due).is_some_and(|(opens, due)| due <= opens) {
        return Err(Text::new("The end must come after the beginning.", "終了日時は開始日時より後にしてください。"));
    }
    if rules.attempts.is_some_and(|attempts| !(1..=MOST_ATTEMPTS).contains(&attempts)) {
        return Err(no_attempts());
    }
    if !(0..=LONGEST_GRACE * MINUTE).contains(&late.grace) {
        return Err(Text::new(
            format!("The grace is a number of minutes, at most {LONGEST_GRACE} (a week)."),
            format!("猶予は 0 から {LONGEST_GRACE}（1 週間）までの分数で入力してください。"),
        ));
    }
    if late.until.is_some_and(|until| due.is_none_or(|due| until <= due)) {
        return Err(Text::new(
            "Late hand-ins end after the due date: set that first, or leave the field empty.",
            "遅延提出の終了日時は締切より後にしてください。締切がない場合は空欄にしてください。",
        ));
    }
    if !is_share(late.percent) {
        return Err(Text::new(
            "Deduction: a number from 0 to 100, in percent of all points.",
            "減点は 0 から 100 までの数（満点に対する %）で入力してください。",
        ));
    }
    if !is_share(late.floor) {
        return Err(Text::new(
            "Floor: a number from 0 to 100, in percent of all points.",
            "減点後の下限は 0 から 100 までの数（満点に対する %）で入力してください。",
        ));
    }
    Ok(())
}

/// Rules in the words of the log of acts.
pub fn described(rules: &AssignmentSettings, zone: &TimeZone) -> [(&'static str, String); 12] {
    let date = |at: Option<Millis>| at.map(|at| local_moment(at, zone)).unwrap_or_default();
    let late = &rules.late;
    [
        ("opens", date(rules.opens_at)),
        ("closes", date(rules.closes_at)),
        ("attempts", rules.attempts.map(|attempts| attempts.to_string()).unwrap_or_default()),
        ("hints", word(&rules.hints)),
        ("audience", word(&rules.audience)),
        ("practice", on_or_off(rules.practice)),
        ("grace", number(late.grace as f64 / MINUTE as f64)),
        ("late until", date(late.until)),
        ("late percent", number(late.percent)),
        ("late span", word(&late.span)),
        ("late floor", number(late.floor)),
        ("counting", word(&rules.counting)),
    ]
}

/// The same of what a homework counts in its course, and who sees it when.
pub fn described_place(place: &CoursePlace, zone: &TimeZone) -> [(&'static str, String); 2] {
    let shown = match (place.is_hidden, place.shown_from) {
        (0, None) => "now".to_owned(),
        (0, Some(from)) => local_moment(from, zone),
        _ => "hidden".to_owned(),
    };
    [("points", place.points.map(number).unwrap_or_default()), ("shown", shown)]
}

/// Whether something holds, in the words of the log.
pub fn on_or_off(holds: bool) -> String {
    if holds { "on" } else { "off" }.to_owned()
}
