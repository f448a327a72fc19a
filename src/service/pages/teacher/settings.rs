//! Dates, limits, hints, who may hand in; the course's zone and language; the course link; what was deleted.

use super::super::datetime::{self, Moment};
use super::super::frame::Frame;
use super::super::shown;
use super::Tab;
use super::login::CsrfForm;
use super::{public_address, refused};
use crate::diagnose::Hints;
use crate::language::Language;
use crate::report::text::number;
use crate::service::State;
use crate::service::acts::Detail;
use crate::service::clock::Millis;
use crate::service::counting::Counting;
use crate::service::course::{Course, zone_names};
use crate::service::errors::Problem;
use crate::service::identity::{self, LecturerPage, Teacher};
use crate::service::store::{Assignment, Audience, LateRules, LateSpan, word};
use askama::Template;
use axum::Form;
use axum::extract::{Query, State as Shared};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/settings.html")]
struct SettingsPage {
    frame: Frame,
    place: Tab,
    csrf: String,
    said: Said,
    rules: Rules,
    /// Whether the teacher may change what belongs to the whole course: all that follows.
    has_course: bool,
    course: CourseFields,
    zones: Vec<String>,
    link: String,
    students: usize,
    deletions: Vec<(Moment, String)>,
}

/// The form of the rules.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct Rules {
    csrf: String,
    opens: String,
    closes: String,
    attempts: String,
    hints: String,
    audience: String,
    /// A box that is not ticked is not sent.
    practice: String,
    #[serde(flatten)]
    late: LateFields,
    counting: String,
}

/// The part of the form of the rules that is about lateness.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct LateFields {
    /// Minutes.
    grace: String,
    late_until: String,
    late_percent: String,
    late_span: String,
    late_floor: String,
}

/// The form of the course.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct CourseFields {
    csrf: String,
    zone: String,
    language: String,
}

/// What the page says of a form that was sent.
#[derive(Debug, Default)]
pub(super) struct Said {
    /// What was done.
    pub notice: Option<String>,
    /// What is wrong with the rules,
    pub rules: Option<String>,
    /// with the course,
    pub course: Option<String>,
    /// with the roster.
    pub roster: Option<String>,
}

/// What has just been done.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct Done {
    done: String,
}

/// What was typed, where that could not be taken.
#[derive(Debug, Default)]
pub(super) struct Typed {
    rules: Option<Rules>,
    course: Option<CourseFields>,
}

/// A minute.
const MINUTE: Millis = 60_000;

/// Longest grace, in minutes: a week.
const LONGEST_GRACE: f64 = 10_080.0;

/// `GET /teacher/settings`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    Query(Done { done }): Query<Done>,
    headers: HeaderMap,
    frame: Frame,
) -> Result<Response, Problem> {
    let notice = match done.as_str() {
        "saved" => Some(frame.say("Saved.", "保存しました。")),
        "link" => Some(frame.say("The old link opens nothing any more.", "以前のリンクは無効になりました。")),
        "roster" => Some(frame.say("The roster is imported.", "名簿を取り込みました。")),
        _ => None,
    };
    let said = Said { notice: notice.map(str::to_owned), ..Said::default() };
    view(&state, frame, &headers, &teacher, Typed::default(), said).await
}

/// The page, with what was typed and what is to be said of it.
pub(super) async fn view(
    state: &State,
    frame: Frame,
    headers: &HeaderMap,
    teacher: &Teacher,
    typed: Typed,
    said: Said,
) -> Result<Response, Problem> {
    let settings = state.store.assignment(&state.assignment.id).await?;
    let deletions = state.store.deletions().await?;
    shown(
        SettingsPage {
            place: Tab::Settings,
            csrf: teacher.csrf(state),
            said,
            rules: typed.rules.unwrap_or_else(|| Rules::of(&settings, &frame.course)),
            has_course: teacher.has_course(),
            course: typed.course.unwrap_or_else(|| CourseFields::of(&frame.course)),
            zones: zone_names(),
            link: format!("{}/join/{}", public_address(state, headers), identity::course_secret(state).await?),
            students: state.store.students().await?.iter().filter(|student| student.on_roster != 0).count(),
            deletions: deletions.into_iter().map(|gone| (frame.moment(gone.at), gone.said(frame.language))).collect(),
            frame,
        }
        .render(),
    )
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

impl Rules {
    /// The form as it stands for these settings.
    fn of(settings: &Assignment, course: &Course) -> Self {
        let date = |at: Option<_>| at.map(|at| datetime::field(at, course.zone())).unwrap_or_default();
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

    /// What differs from a form as it stood before, for the log of acts.
    fn changes_from(&self, before: &Self) -> String {
        let pairs = [
            ("opens", &before.opens, &self.opens),
            ("closes", &before.closes, &self.closes),
            ("attempts", &before.attempts, &self.attempts),
            ("hints", &before.hints, &self.hints),
            ("audience", &before.audience, &self.audience),
            ("practice", &before.practice, &self.practice),
            ("grace", &before.late.grace, &self.late.grace),
            ("late until", &before.late.late_until, &self.late.late_until),
            ("late percent", &before.late.late_percent, &self.late.late_percent),
            ("late span", &before.late.late_span, &self.late.late_span),
            ("late floor", &before.late.late_floor, &self.late.late_floor),
            ("counting", &before.counting, &self.counting),
        ];
        let shown = |text: &String| if text.trim().is_empty() { "–".to_owned() } else { text.trim().to_owned() };
        let changed = pairs.into_iter().filter(|(_, before, after)| before.trim() != after.trim());
        let lines = changed.map(|(name, before, after)| format!("{name}: {} → {}", shown(before), shown(after)));
        lines.collect::<Vec<_>>().join(", ")
    }

    /// The settings that the form asks for.
    fn read(&self, frame: &Frame, before: Assignment) -> Result<Assignment, &'static str> {
        let date = |field: &str| {
            datetime::parse(field, frame.course.zone()).map_err(|_| {
                frame.say("A date has the form 2026-12-31T23:59.", "日時は 2026-12-31T23:59 の形で入力してください。")
            })
        };
        let attempts = match self.attempts.trim() {
            "" => None,
            number => Some(number.parse().ok().filter(|number| *number > 0).ok_or(frame.say(
                "Attempts: a whole number above 0, or nothing.",
                "提出回数は 1 以上の整数で入力するか、空欄にしてください。",
            ))?),
        };
        let (opens_at, closes_at) = (date(&self.opens)?, date(&self.closes)?);
        if let (Some(opens), Some(closes)) = (opens_at, closes_at)
            && closes <= opens
        {
            return Err(frame.say("The end must come after the beginning.", "終了日時は開始日時より後にしてください。"));
        }
        let (hints, audience) = (read_hints(&self.hints), read_audience(&self.audience));
        let practice = !self.practice.is_empty();
        let late = self.late.read(frame, closes_at, date(&self.late.late_until)?)?;
        let counting = match self.counting.as_str() {
            "last" => Counting::Last,
            "chosen" => Counting::Chosen,
            _ => Counting::Best,
        };
        Ok(Assignment { opens_at, closes_at, attempts, hints, audience, practice, late, counting, ..before })
    }
}

impl LateFields {
    fn read(&self, frame: &Frame, due: Option<Millis>, until: Option<Millis>) -> Result<LateRules, &'static str> {
        let number = |field: &str, most: f64| match field.trim() {
            "" => Some(0.0),
            text => text.parse().ok().filter(|number: &f64| (0.0..=most).contains(number)),
        };
        let percent = |field: &str| {
            number(field, 100.0)
                .ok_or(frame.say("A share is a number from 0 to 100.", "割合は 0 から 100 の数で入力してください。"))
        };
        let grace = number(&self.grace, LONGEST_GRACE).ok_or(frame.say(
            "The grace is a number of minutes, at most 10080 (a week).",
            "猶予は 0 から 10080（1 週間）までの分数で入力してください。",
        ))?;
        if until.is_some_and(|until| due.is_none_or(|due| until <= due)) {
            return Err(frame.say(
                "Late hand-ins end after the due date: set that first, or leave the field empty.",
                "遅延提出の終了日時は締切より後にしてください。締切がない場合は空欄にしてください。",
            ));
        }
        Ok(LateRules {
            grace: (grace * MINUTE as f64).round() as Millis,
            until,
            percent: percent(&self.late_percent)?,
            span: if self.late_span == "hour" { LateSpan::Hour } else { LateSpan::Day },
            floor: percent(&self.late_floor)?,
        })
    }
}

impl CourseFields {
    fn of(course: &Course) -> Self {
        let language = if course.language == Language::Ja { "ja" } else { "en" };
        Self { csrf: String::new(), zone: course.zone_name().to_owned(), language: language.to_owned() }
    }

    fn read(&self, frame: &Frame) -> Result<Course, String> {
        let language = if self.language == "en" { Language::En } else { Language::Ja };
        Course::new(&self.zone, language).ok_or_else(|| {
            let zone = self.zone.trim();
            match frame.language {
                Language::En => format!("There is no time zone `{zone}`. Choose one of the list, such as Asia/Tokyo."),
                Language::Ja => format!(
                    "「{zone}」というタイムゾーンはありません。Asia/Tokyo のように、一覧にある名前を選んでください。"
                ),
            }
        })
    }
}

/// `POST /teacher/settings`.
pub(in crate::service::pages) async fn save(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    headers: HeaderMap,
    frame: Frame,
    Form(rules): Form<Rules>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &rules.csrf)?;
    let before = state.store.assignment(&state.assignment.id).await?;
    let was = Rules::of(&before, &frame.course);
    match rules.read(&frame, before) {
        Ok(settings) => {
            state.store.set_assignment(&settings).await?;
            let answer = Redirect::to(&format!("{}/settings?done=saved", frame.teacher())).into_response();
            Ok(Detail::of(rules.changes_from(&was)).on(answer))
        }
        Err(wrong) => {
            let said = Said { rules: Some(wrong.to_owned()), ..Said::default() };
            let typed = Typed { rules: Some(rules), ..Typed::default() };
            let page = view(&state, frame, &headers, &teacher, typed, said).await?;
            Ok(refused(page, StatusCode::UNPROCESSABLE_ENTITY))
        }
    }
}

/// `POST /teacher/course`: time zone and language.
pub(in crate::service::pages) async fn save_course(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    headers: HeaderMap,
    frame: Frame,
    Form(fields): Form<CourseFields>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &fields.csrf)?;
    teacher.check_course()?;
    match fields.read(&frame) {
        Ok(course) => {
            state.store.set_course(&course).await?;
            let answer = Redirect::to(&format!("{}/settings?done=saved", frame.teacher())).into_response();
            Ok(Detail::of(format!("{}, {}", fields.zone, fields.language)).on(answer))
        }
        Err(wrong) => {
            let said = Said { course: Some(wrong), ..Said::default() };
            let typed = Typed { course: Some(fields), ..Typed::default() };
            let page = view(&state, frame, &headers, &teacher, typed, said).await?;
            Ok(refused(page, StatusCode::UNPROCESSABLE_ENTITY))
        }
    }
}

/// `POST /teacher/settings/link`: a new course link.
pub(in crate::service::pages) async fn renew(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    Form(token): Form<CsrfForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &token.csrf)?;
    teacher.check_course()?;
    identity::renew_course_secret(&state).await?;
    Ok(Redirect::to(&format!("{}/teacher/settings?done=link", state.base())).into_response())
}
