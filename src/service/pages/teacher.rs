//! The teacher's pages, behind the login.
//!
//! [`class`] is everyone with [`charts`] and the [`table`] of them, [`person`] what one student handed in, [`extensions`] later deadlines, [`appeals`] what students ask to be looked at again, [`likeness`] answers that are alike, [`insights`] what the homework shows of its class, [`batches`]
//! whole archives, [`downloads`] what takes a while to make, [`regradings`] grading again with a comparison, [`settings`]
//! dates, limits, hints, the course and its link, [`roster`] the list of students, [`delete`] what goes for good, [`login`]
//! the way in, [`live`] what arrives while somebody looks. Of all courses: [`courses`]. Of the whole course: [`plan`] its homeworks in their order, [`gradebook`] everybody with all of them, [`people`] who teaches, [`welcome`] where
//! they choose a password, [`codes`] the students' personal codes, [`data`] what is kept of people, [`platforms`] learning
//! platforms, [`tokens`] what programs come in by, [`folders`] the homeworks themselves, [`acts`] the log of what was done. Rows that are too many for one page
//! are shown by a [`pager`].

mod acts;
mod appeals;
mod batches;
mod charts;
mod class;
mod codes;
mod courses;
mod data;
mod delete;
mod downloads;
mod extensions;
mod folders;
mod gradebook;
mod insights;
mod likeness;
mod live;
pub(super) mod login;
mod pager;
mod people;
mod person;
mod plan;
mod platforms;
mod regradings;
mod roster;
mod settings;
mod table;
mod tokens;
mod welcome;
mod worksheets;

use super::Service;
use super::frame::PageFrame;
use super::report_fragment;
use crate::service::State;
use crate::service::classes::PersonStanding;
use crate::service::errors::Problem;
use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::http::StatusCode;
use axum::response::Response;
use axum::routing::{get, post};

/// The routes of a homework.
pub(super) fn router() -> Router<State> {
    Router::new()
        .route("/teacher", get(class::page))
        .route("/teacher/appeals", get(appeals::page))
        .route("/teacher/insights", get(insights::page))
        .route("/teacher/likeness", get(likeness::page))
        .route("/teacher/likeness/pair", get(likeness::side_by_side))
        .route("/teacher/events", get(live::events))
        .route("/teacher/person", get(person::page))
        .route("/teacher/extension", post(extensions::of_student))
        .route("/teacher/extensions", get(extensions::page).post(extensions::set))
        .route("/teacher/choice", post(person::choose))
        .route("/teacher/delete", get(delete::page).post(delete::delete))
        .route("/teacher/downloads", post(downloads::start))
        .route("/teacher/downloads/{id}", get(downloads::page))
        .route("/teacher/downloads/{id}/events", get(downloads::events))
        .route("/teacher/downloads/{id}/file", get(downloads::file))
        .route("/teacher/worksheet", post(worksheets::of_class))
        .route("/teacher/settings", get(settings::page).post(settings::save))
        .route("/teacher/course", post(settings::save_course))
        .route("/teacher/settings/link", post(settings::renew))
        .route("/teacher/roster", post(roster::take))
        .route("/teacher/batches", get(batches::list).post(batches::upload).layer(DefaultBodyLimit::disable()))
        .route("/teacher/batches/{id}", get(batches::one))
        .route("/teacher/batches/{id}/worksheet", post(batches::worksheet))
        .route("/teacher/regradings", post(regradings::start))
        .route("/teacher/regradings/{id}", get(regradings::page).post(regradings::adopt))
        .route("/teacher/regradings/{id}/events", get(regradings::events))
}

/// The routes of what belongs to all courses.
pub(super) fn of_service() -> Router<Service> {
    Router::new().route("/teacher/courses", get(courses::page).post(courses::change))
}

/// The routes of what belongs to the whole course.
pub(super) fn of_course() -> Router<Service> {
    Router::new()
        .route("/teacher/login", get(login::page).post(login::login))
        .route("/teacher/logout", post(login::logout))
        .route("/teacher/welcome/{secret}", get(welcome::page).post(welcome::choose))
        .route("/teacher/plan", get(plan::page).post(plan::save))
        .route("/teacher/gradebook", get(gradebook::page))
        .route("/teacher/gradebook/file", get(gradebook::file))
        .route("/teacher/people", get(people::page).post(people::add))
        .route("/teacher/people/{id}", post(people::change))
        .route("/teacher/data", get(data::page).post(data::set))
        .route("/teacher/data/export", post(data::export))
        .route("/teacher/data/archive", post(data::archive))
        .route("/teacher/codes", get(codes::page).post(codes::renew))
        .route("/teacher/codes/file", get(codes::file))
        .route("/teacher/platforms", get(platforms::page).post(platforms::change))
        .route("/teacher/folders", get(folders::list).post(folders::upload).layer(DefaultBodyLimit::disable()))
        .route("/teacher/folders/{id}", get(folders::one).post(folders::change))
        .route("/teacher/folders/{id}/page", get(folders::preview::student_page).post(folders::preview::not_handed_in))
        .route("/teacher/folders/{id}/page/starter", get(folders::preview::starter))
        .route("/teacher/folders/{id}/page/read", post(folders::preview::read))
        .route("/teacher/tokens", get(tokens::page).post(tokens::make))
        .route("/teacher/tokens/{id}", post(tokens::end))
        .route("/teacher/log", get(acts::page))
}

/// Where a page stands among the teacher's, for its navigation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tab {
    /// The class.
    Class,
    /// What students ask to be looked at again.
    Appeals,
    /// What the class shows.
    Insights,
    /// Answers that are alike.
    Likeness,
    /// Archives.
    Batches,
    /// Settings.
    Settings,
    /// The classes of all homeworks.
    Classes,
    /// Everybody with all homeworks.
    Gradebook,
    /// Which homeworks the course has.
    Plan,
    /// The homeworks' folders.
    Folders,
    /// Personal codes.
    Codes,
    /// What is kept of people.
    Data,
    /// Who teaches.
    People,
    /// Learning platforms.
    Platforms,
    /// Tokens for programs.
    Tokens,
    /// The log of what they did.
    Acts,
}

impl Tab {
    /// Whether it is a page of the whole course.
    pub(super) fn is_of_course(self) -> bool {
        !matches!(
            self,
            Self::Class
                | Self::Appeals
                | Self::Insights
                | Self::Likeness
                | Self::Batches
                | Self::Settings
                | Self::Tokens
        )
    }

    /// What a page of the whole course is called, for the closed menu that has it.
    pub(super) fn in_course(self, frame: &PageFrame) -> Option<&'static str> {
        self.is_of_course().then(|| self.name(frame))
    }

    /// What the navigation calls a page that stands in a menu.
    pub(super) fn name(self, frame: &PageFrame) -> &'static str {
        match self {
            Self::Classes => frame.say("All classes", "クラスの一覧"),
            Self::Gradebook => frame.say("Gradebook", "成績一覧"),
            Self::Plan => frame.say("Plan", "構成"),
            Self::Folders => frame.say("Homeworks", "課題"),
            Self::Codes => frame.say("Codes", "個人コード"),
            Self::Data => frame.say("Data", "データ"),
            Self::People => frame.say("Staff", "担当者"),
            Self::Platforms => frame.say("Learning platforms", "学習プラットフォーム"),
            Self::Tokens => frame.say("Tokens", "トークン"),
            Self::Acts => frame.say("Log", "操作記録"),
            Self::Class | Self::Appeals | Self::Insights | Self::Likeness | Self::Batches | Self::Settings => "",
        }
    }
}

/// How somebody stands, in words.
fn word(frame: &PageFrame, standing: PersonStanding) -> &'static str {
    match standing {
        PersonStanding::Graded(verdict) => report_fragment::verdict(frame, verdict),
        PersonStanding::Queued => frame.say("Being graded", "採点中"),
        PersonStanding::Failed => frame.say("Our fault", "サーバ側の障害"),
        PersonStanding::Ungraded => frame.say("Nothing to grade", "採点対象なし"),
        PersonStanding::Nothing => frame.say("Nothing handed in", "未提出"),
    }
}

/// What a page says of a form that cannot be done as it is filled in; any other problem is the answer.
fn said_of(problem: Problem, frame: &PageFrame) -> Result<String, Problem> {
    match problem.status {
        StatusCode::UNPROCESSABLE_ENTITY => Ok(problem.detail.get(frame.language).replace('`', "")),
        _ => Err(problem),
    }
}

/// A page that leads a form back to its sender, with the status of the refusal.
fn refused(mut page: Response, status: StatusCode) -> Response {
    *page.status_mut() = status;
    page
}
