//! What a homework's [`rules`] are; the course's zone and language; the course link; what was deleted.

mod rules;

use super::super::datetime::{self, TimeElement};
use super::super::frame::PageFrame;
use super::super::shown;
use super::Tab;
use super::login::CsrfForm;
use super::refused;
use crate::language::Language;
use crate::service::State;
use crate::service::acts::{Detail, changes};
use crate::service::course::{Course, zone_names};
use crate::service::errors::Problem;
use crate::service::identity::{self, LecturerPage, Teacher};
use crate::service::rules::described;
use crate::service::store::StudentRecord;
use askama::Template;
use axum::Form;
use axum::extract::{Query, State as Shared};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Redirect, Response};
use rules::RulesForm;
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/settings.html")]
struct SettingsPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    said: SettingsNotice,
    rules: RulesForm,
    /// Whether the teacher may change what belongs to the whole course: all that follows.
    has_course: bool,
    course: CourseFields,
    zones: Vec<String>,
    link: String,
    students: usize,
    deletions: Vec<(TimeElement, String)>,
}

/// The form of the course.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct CourseFields {
    csrf: String,
    title: String,
    zone: String,
    language: String,
}

/// What the page says of a form that was sent.
#[derive(Debug, Default)]
pub(super) struct SettingsNotice {
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
pub(in crate::service::pages) struct SettingsQuery {
    done: String,
    /// Of a roster: how many students were not on the one before,
    new: usize,
    /// how many of that one are not on it,
    gone: usize,
    /// and which columns of the file were not taken.
    aside: String,
}

/// What was typed, where that could not be taken.
#[derive(Debug, Default)]
pub(super) struct Typed {
    rules: Option<RulesForm>,
    course: Option<CourseFields>,
}

/// `GET /teacher/settings`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    Query(query): Query<SettingsQuery>,
    headers: HeaderMap,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let notice = match query.done.as_str() {
        "saved" => Some(frame.say("Saved.", "保存しました。").to_owned()),
        "link" => {
            Some(frame.say("The old link opens nothing any more.", "以前のリンクは無効になりました。").to_owned())
        }
        "roster" => Some(imported(&frame, &query, &state.store.roster().await?)),
        _ => None,
    };
    let said = SettingsNotice { notice, ..SettingsNotice::default() };
    view(&state, frame, &headers, &teacher, Typed::default(), said).await
}

/// What was read of a roster, so that a wrong file or column is seen at once.
fn imported(frame: &PageFrame, query: &SettingsQuery, roster: &[StudentRecord]) -> String {
    let SettingsQuery { new, gone, aside, .. } = query;
    let all = roster.len();
    let grouped = roster.iter().filter(|student| !student.group_name.is_empty()).count();
    let aside = match (aside.as_str(), frame.language) {
        ("", _) => String::new(),
        (names, Language::En) => format!("Columns that were not taken: {names}. "),
        (names, Language::Ja) => format!("取り込まなかった列: {names}。"),
    };
    let first = roster.iter().take(3).map(|student| format!("{} {}", student.number, student.name).trim().to_owned());
    let first: Vec<String> = first.collect();
    match frame.language {
        Language::En => format!(
            "The roster is imported: {all} on it, {new} of them new; {gone} of the roster before are no longer on it. \
             {grouped} of {all} have a group. {aside}It begins with {}.",
            first.join("; ")
        ),
        Language::Ja => format!(
            "名簿を取り込みました。{all} 人（新規 {new} 人）です。以前の名簿から外れた学生は {gone} 人です。グループのある学生は {all} 人中 {grouped} 人です。{aside}先頭: {}",
            first.join("、")
        ),
    }
}

/// The page, with what was typed and what is to be said of it.
pub(super) async fn view(
    state: &State,
    frame: PageFrame,
    headers: &HeaderMap,
    teacher: &Teacher,
    typed: Typed,
    said: SettingsNotice,
) -> Result<Response, Problem> {
    let settings = state.store.assignment(&state.assignment.id).await?;
    let deletions = state.store.deletions().await?;
    shown(
        SettingsPage {
            place: Tab::Settings,
            csrf: teacher.csrf(state),
            said,
            rules: typed.rules.unwrap_or_else(|| RulesForm::of(&settings, &frame.course)),
            has_course: teacher.has_course(),
            course: typed.course.unwrap_or_else(|| CourseFields::of(&frame.course)),
            zones: zone_names(),
            link: identity::course_link(state, headers).await?,
            students: state.store.students().await?.iter().filter(|student| student.on_roster != 0).count(),
            deletions: deletions.into_iter().map(|gone| (frame.datetime(gone.at), gone.said(frame.language))).collect(),
            frame,
        }
        .render(),
    )
}

impl CourseFields {
    fn of(course: &Course) -> Self {
        let language = if course.language == Language::Ja { "ja" } else { "en" };
        let title = course.title.clone();
        Self { csrf: String::new(), title, zone: course.zone_name().to_owned(), language: language.to_owned() }
    }

    fn read(&self, frame: &PageFrame) -> Result<Course, String> {
        let language = if self.language == "en" { Language::En } else { Language::Ja };
        let course = Course::new(&self.zone, language).ok_or_else(|| {
            let zone = self.zone.trim();
            match frame.language {
                Language::En => format!("There is no time zone `{zone}`. Choose one of the list, such as Asia/Tokyo."),
                Language::Ja => format!(
                    "「{zone}」というタイムゾーンはありません。Asia/Tokyo のように、一覧にある名前を選んでください。"
                ),
            }
        })?;
        course.titled(&self.title).map_err(|problem| problem.detail.get(frame.language).to_owned())
    }
}

/// `POST /teacher/settings`.
pub(in crate::service::pages) async fn save(
    Shared(state): Shared<State>,
    LecturerPage(teacher): LecturerPage,
    headers: HeaderMap,
    frame: PageFrame,
    Form(rules): Form<RulesForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &rules.csrf)?;
    let before = state.store.assignment(&state.assignment.id).await?;
    let zone = frame.course.zone();
    let was = described(&before, zone);
    let shown = [before.opens_at, before.closes_at, before.late.until];
    match rules.read(&frame, before) {
        Ok(settings) => {
            state.store.set_assignment(&settings).await?;
            let dates: Vec<_> = rules.dates().into_iter().zip(shown).collect();
            let page = datetime::with_unclear(&format!("{}/settings?done=saved", frame.teacher()), &dates, zone);
            let answer = Redirect::to(&page).into_response();
            Ok(Detail::of(changes(&was, &described(&settings, zone))).on(answer))
        }
        Err(wrong) => {
            let said = SettingsNotice { rules: Some(wrong), ..SettingsNotice::default() };
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
    frame: PageFrame,
    Form(fields): Form<CourseFields>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &fields.csrf)?;
    teacher.check_course()?;
    match fields.read(&frame) {
        Ok(course) => {
            state.store.set_course(&course).await?;
            let answer = Redirect::to(&format!("{}/settings?done=saved", frame.teacher())).into_response();
            Ok(Detail::of(changes(&frame.course.described(), &course.described())).on(answer))
        }
        Err(wrong) => {
            let said = SettingsNotice { course: Some(wrong), ..SettingsNotice::default() };
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
