//! What every page has around its content: language, time zone, address, assets.

use super::assets;
use super::datetime::{self, TimeElement};
use super::who::KnownStudent;
use crate::language::Language;
use crate::report::html::SYMBOLS;
use crate::report::labels::mistake_title;
use crate::service::clock::Millis;
use crate::service::course::Course;
use crate::service::courses::{self, at};
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::sign_in::Provider;
use crate::service::store::StaffRole;
use crate::service::{Scope, Service, State};
use axum::extract::{FromRequestParts, OriginalUri};
use axum::http::Uri;
use axum::http::request::Parts;
use reference::Assignment;
use std::sync::Arc;

use crate::service::language::of_request;

/// The frame of one page.
#[derive(Clone, Debug)]
pub struct PageFrame {
    /// Language of every word.
    pub language: Language,
    /// The course, with the time zone of every date.
    pub course: Course,
    /// The teacher who looks.
    teacher: Option<Teacher>,
    /// The student at whose browser the page is read.
    pub who: Option<KnownStudent>,
    uri: Uri,
    /// The homework; none on a page that is of none.
    assignment: Option<Arc<Assignment>>,
    /// What the addresses of its pages begin with, see [`State::base`].
    base: String,
    /// What the addresses of the course begin with, see [`courses::root`].
    pub root: std::sync::Arc<str>,
}

/// A language to switch to.
pub(super) struct Tongue {
    pub tag: &'static str,
    pub name: &'static str,
    pub href: String,
    pub is_current: bool,
}

/// A way to sign in by an OpenID issuer.
pub(super) struct SignInLink {
    pub name: String,
    pub href: String,
}

impl SignInLink {
    /// Those of the configuration; `homework` is the id of the one to go on with.
    pub fn all(service: &Service, homework: Option<&str>) -> Vec<Self> {
        let query = homework.map(|id| format!("?homework={id}")).unwrap_or_default();
        let link = |provider: &Provider| Self {
            name: provider.name.clone(),
            href: at(&format!("/sign-in/{}{query}", provider.id)),
        };
        service.config.sign_in.iter().map(link).collect()
    }
}

impl PageFrame {
    /// The frame of a page at an address.
    pub fn new(language: Language, course: Course, uri: Uri, assignment: Option<Arc<Assignment>>) -> Self {
        Self { language, course, teacher: None, who: None, uri, assignment, base: String::new(), root: courses::root() }
    }

    /// The same for a page of a homework.
    pub(super) fn of(self, state: &State) -> Self {
        Self { assignment: Some(Arc::clone(&state.assignment)), base: state.base(), ..self }
    }

    /// The address of the teacher's pages.
    pub fn teacher(&self) -> String {
        if self.base.is_empty() { at("/teacher") } else { format!("{}/teacher", self.base) }
    }

    /// Whether it is a page of a homework.
    pub fn has_homework(&self) -> bool {
        self.assignment.is_some()
    }

    /// Whether a lecturer looks, who may do more than an assistant.
    pub fn is_lecturers(&self) -> bool {
        self.teacher.as_ref().is_some_and(|teacher| teacher.role() >= StaffRole::Lecturer)
    }

    /// Whether it is somebody who may do what belongs to the whole course.
    pub fn has_course(&self) -> bool {
        self.is_lecturers() && self.teacher.as_ref().is_some_and(Teacher::has_course)
    }

    /// Whether a teacher looks who is not of one homework only.
    pub fn is_of_course(&self) -> bool {
        self.teacher.as_ref().is_some_and(Teacher::has_course)
    }

    /// Whether the teacher who looks reads names of students, or pseudonyms.
    pub fn sees_names(&self) -> bool {
        self.teacher.as_ref().is_none_or(Teacher::sees_names)
    }

    /// What somebody is called where no names are read: by their place in an order that says nothing of names, from 0.
    pub(super) fn pseudonym(&self, place: usize) -> String {
        format!("{} {}", self.say("Student", "学生"), place + 1)
    }

    /// The name of the teacher who looks; none with a secret of the whole service.
    pub fn teachers_name(&self) -> Option<&str> {
        let staff = self.teacher.as_ref()?.staff()?;
        Some(if staff.name.is_empty() { &staff.login } else { &staff.name })
    }

    /// Whether the teacher who looks has an account, for all homeworks.
    pub fn has_account(&self) -> bool {
        self.teacher.as_ref().is_some_and(|teacher| teacher.staff().is_some() && teacher.has_course())
    }

    /// Whether the teacher who looks came in by a secret that others have as well.
    pub fn is_shared_login(&self) -> bool {
        self.teacher.as_ref().is_some_and(Teacher::is_shared)
    }

    /// The address of the student's page.
    pub fn student(&self) -> String {
        if self.base.is_empty() { at("/") } else { self.base.clone() }
    }

    /// The title of the course, where it has one.
    pub fn course_title(&self) -> Option<&str> {
        Some(self.course.title.as_str()).filter(|title| !title.is_empty())
    }

    /// The homework's title, where the service has others as well.
    pub fn homework(&self) -> Option<&str> {
        let assignment = self.assignment.as_deref().filter(|_| !self.base.is_empty())?;
        Some(self.language.of(&assignment.title))
    }

    /// The wording of this page's language.
    pub fn say(&self, en: &'static str, ja: &'static str) -> &'static str {
        match self.language {
            Language::En => en,
            Language::Ja => ja,
        }
    }

    /// A moment as this page's reader takes it, in the course's time zone. Every date of a page comes from here.
    pub(super) fn datetime(&self, at: Millis) -> TimeElement {
        TimeElement::of(at, self.language, self.course.zone())
    }

    /// The same with the name of the time zone, for what people must not be late for.
    pub(super) fn deadline(&self, at: Millis) -> TimeElement {
        TimeElement::zoned(at, self.language, self.course.zone())
    }

    /// The same to the second, for a receipt.
    pub(super) fn exact_datetime(&self, at: Millis) -> TimeElement {
        TimeElement::exact(at, self.language, self.course.zone())
    }

    /// What is to be said of a local time that was set and that the course's zone has twice or not at all.
    pub fn unclear_times(&self) -> Option<String> {
        datetime::said_of_unclear(self.uri.query()?, self.language, self.course.zone())
    }

    /// The language as a BCP 47 tag.
    pub fn tag(&self) -> &'static str {
        tag(self.language)
    }

    /// The languages to choose from; each leads to this page.
    pub(super) fn tongues(&self) -> [Tongue; 2] {
        let tongue = |language, name| {
            let others = self.uri.query().unwrap_or_default().split('&').filter(|pair| !pair.starts_with("lang="));
            let query: Vec<String> = others
                .filter(|pair| !pair.is_empty())
                .map(str::to_owned)
                .chain([format!("lang={}", tag(language))])
                .collect();
            Tongue {
                tag: tag(language),
                name,
                href: format!("{}?{}", self.uri.path(), query.join("&")),
                is_current: language == self.language,
            }
        };
        [tongue(Language::Ja, "日本語"), tongue(Language::En, "English")]
    }

    /// The address of an asset.
    pub fn asset(&self, name: &str) -> &'static str {
        assets::address(name)
    }

    /// The address of the style that moves the assignment's pictures.
    pub fn motion(&self) -> Option<String> {
        self.assignment.as_deref().map(assets::motion)
    }

    /// The address of a picture of a submission. Browsers keep pictures; under another version of the homework's folder the
    /// address is another one.
    pub(super) fn picture(&self, id: &str, name: &str) -> String {
        picture(self.assignment.as_deref(), id, name)
    }

    /// The title of a mistake; its id where the homework does not know it.
    pub(super) fn mistake_title(&self, id: &str) -> String {
        let known = self.assignment.as_deref();
        known.map_or_else(|| id.to_owned(), |assignment| mistake_title(assignment, id, self.language))
    }

    /// The signs that reports refer to.
    pub fn symbols(&self) -> &'static str {
        SYMBOLS
    }

    /// Version of ggrade.
    pub fn version(&self) -> &'static str {
        env!("CARGO_PKG_VERSION")
    }
}

/// See [`PageFrame::picture`].
pub(super) fn picture(assignment: Option<&Assignment>, id: &str, name: &str) -> String {
    let version = assignment.and_then(|assignment| assignment.digest.get(..DIGITS)).unwrap_or_default();
    at(&format!("/r/{id}/{name}.png?of={version}"))
}

/// Digits of a folder's digest that tell its versions apart.
const DIGITS: usize = 8;

fn tag(language: Language) -> &'static str {
    match language {
        Language::En => "en",
        Language::Ja => "ja",
    }
}

impl<S: Scope> FromRequestParts<S> for PageFrame {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Self, Problem> {
        let uri =
            parts.extensions.get::<OriginalUri>().map_or_else(|| parts.uri.clone(), |original| original.0.clone());
        let language = of_request(&parts.headers, &uri);
        let course = scope.whole().store.course().await?;
        let teacher = Teacher::of_request(scope.whole(), &parts.headers, &mut parts.extensions).await?;
        let who = KnownStudent::of(scope.whole(), &parts.extensions);
        let frame = Self { teacher, who, ..Self::new(language, course, uri, None) };
        Ok(match scope.own() {
            Some(state) => frame.of(&state),
            None => frame,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_switch_of_language_stays_on_the_page() {
        let frame = PageFrame::new(
            Language::En,
            Course::default(),
            Uri::from_static("/teacher/x?verdict=wrong&lang=en&q=a%22b"),
            None,
        );
        let [ja, en] = frame.tongues();
        assert_eq!(ja.href, "/teacher/x?verdict=wrong&q=a%22b&lang=ja");
        assert!(!ja.is_current && en.is_current);
        let [ja, _] = PageFrame::new(Language::Ja, Course::default(), Uri::from_static("/"), None).tongues();
        assert_eq!(ja.href, "/?lang=ja");
    }
}
