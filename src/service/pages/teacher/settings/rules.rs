//! The form of a homework's rules: dates, attempts, lateness, hints, who may hand in, what counts.

use super::super::super::datetime;
use super::super::super::frame::PageFrame;
use crate::report::Hints;
use crate::report::text::number;
use crate::service::clock::{Millis, local_minute};
use crate::service::counting::Counting;
use crate::service::course::Course;
use crate::service::rules::{self, MINUTE};
use crate::service::store::{AssignmentSettings, Audience, LateRules, LateSpan, word};
use serde::Deserialize;

/// The form of the rules.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct RulesForm {
    pub csrf: String,
    pub opens: String,
    pub closes: String,
    pub attempts: String,
    pub hints: String,
    pub audience: String,
    /// A box that is not ticked is not sent.
    pub practice: String,
    #[serde(flatten)]
    pub late: LateFields,
    pub counting: String,
}

/// The part of the form of the rules that is about lateness.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct LateFields {
    /// Minutes.
    pub grace: String,
    pub late_until: String,
    pub late_percent: String,
    pub late_span: String,
    pub late_floor: String,
}

impl RulesForm {
    /// The form as it stands for these settings.
    pub(super) fn of(settings: &AssignmentSettings, course: &Course) -> Self {
        let date = |at: Option<_>| at.map(|at| local_minute(at, course.zone())).unwrap_or_default();
        Self {
            csrf: String::new(),
            opens: date(settings.opens_at),
            closes: date(settings.closes_at),
            attempts: settings.attempts.map(|attempts| attempts.to_string()).unwrap_or_default(),
            hints: word(&settings.hints),
            audience: word(&settings.audience),
            practice: if settings.practice { "on".to_owned() } else { String::new() },
            late: LateFields {
                grace: number(settings.late.grace as f64 / MINUTE as f64),
                late_until: date(settings.late.until),
                late_percent: number(settings.late.percent),
                late_span: word(&settings.late.span),
                late_floor: number(settings.late.floor),
            },
            counting: word(&settings.counting),
        }
    }

    /// The fields of dates: when handing in begins, when it is due, and when late hand-ins end.
    pub(super) fn dates(&self) -> [&str; 3] {
        [&self.opens, &self.closes, &self.late.late_until]
    }

    /// The settings that the form asks for.
    pub(super) fn read(&self, frame: &PageFrame, before: AssignmentSettings) -> Result<AssignmentSettings, String> {
        let date = |field: &str, shown: Option<Millis>| {
            datetime::parse(field, frame.course.zone(), shown).map_err(|wrong| wrong.get(frame.language).to_owned())
        };
        let attempts = match self.attempts.trim() {
            "" => None,
            number => Some(number.parse().map_err(|_| rules::no_attempts().get(frame.language).to_owned())?),
        };
        let (opens_at, closes_at) = (date(&self.opens, before.opens_at)?, date(&self.closes, before.closes_at)?);
        let (hints, audience) = (read_hints(&self.hints), read_audience(&self.audience));
        let practice = !self.practice.is_empty();
        let late = self.late.read(date(&self.late.late_until, before.late.until)?);
        let counting = match self.counting.as_str() {
            "last" => Counting::Last,
            "chosen" => Counting::Chosen,
            _ => Counting::Best,
        };
        let read =
            AssignmentSettings { opens_at, closes_at, attempts, hints, audience, practice, late, counting, ..before };
        rules::check(&read).map_err(|wrong| wrong.get(frame.language).to_owned())?;
        Ok(read)
    }
}

impl LateFields {
    fn read(&self, until: Option<Millis>) -> LateRules {
        // What is no number is none that the rules take.
        let number = |field: &str| match field.trim() {
            "" => 0.0,
            text => text.parse().ok().filter(|number: &f64| number.is_finite()).unwrap_or(-1.0),
        };
        LateRules {
            grace: (number(&self.grace) * MINUTE as f64).round() as Millis,
            until,
            percent: number(&self.late_percent),
            span: if self.late_span == "hour" { LateSpan::Hour } else { LateSpan::Day },
            floor: number(&self.late_floor),
        }
    }
}

fn read_hints(word: &str) -> Hints {
    match word {
        "none" => Hints::None,
        "gentle" => Hints::Gentle,
        _ => Hints::Full,
    }
}

fn read_audience(word: &str) -> Audience {
    if word == "number" { Audience::Number } else { Audience::Open }
}
