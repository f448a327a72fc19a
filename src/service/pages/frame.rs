//! What every page has around its content: language, time zone, address, assets.

use super::assets;
use super::datetime::Moment;
use crate::language::Language;
use crate::report::html::SYMBOLS;
use crate::report::labels::mistake_title;
use crate::service::State;
use crate::service::clock::Millis;
use crate::service::course::Course;
use crate::service::errors::Problem;
use axum::extract::{FromRequestParts, OriginalUri};
use axum::http::Uri;
use axum::http::request::Parts;
use reference::Assignment;
use std::sync::Arc;

use crate::service::language::of_request;

/// The frame of one page.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Language of every word.
    pub language: Language,
    /// The course, with the time zone of every date.
    pub course: Course,
    uri: Uri,
    /// The homework; none on a page that is of none.
    assignment: Option<Arc<Assignment>>,
}

/// A language to switch to.
pub(super) struct Tongue {
    pub tag: &'static str,
    pub name: &'static str,
    pub href: String,
    pub is_current: bool,
}

impl Frame {
    /// The frame of a page at an address.
    pub fn new(language: Language, course: Course, uri: Uri, assignment: Option<Arc<Assignment>>) -> Self {
        Self { language, course, uri, assignment }
    }

    /// The wording of this page's language.
    pub fn say(&self, en: &'static str, ja: &'static str) -> &'static str {
        match self.language {
            Language::En => en,
            Language::Ja => ja,
        }
    }

    /// A moment as this page's reader takes it, in the course's time zone. Every date of a page comes from here.
    pub(super) fn moment(&self, at: Millis) -> Moment {
        Moment::of(at, self.language, self.course.zone())
    }

    /// The same with the name of the time zone, for what people must not be late for.
    pub(super) fn deadline(&self, at: Millis) -> Moment {
        Moment::zoned(at, self.language, self.course.zone())
    }

    /// The same to the second, for a receipt.
    pub(super) fn exact_moment(&self, at: Millis) -> Moment {
        Moment::exact(at, self.language, self.course.zone())
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

    /// The title of a mistake; its id where the homework does not know it.
    pub(super) fn mistake_title<'a>(&'a self, id: &'a str) -> &'a str {
        self.assignment.as_deref().map_or(id, |assignment| mistake_title(assignment, id, self.language))
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

fn tag(language: Language) -> &'static str {
    match language {
        Language::En => "en",
        Language::Ja => "ja",
    }
}

impl FromRequestParts<State> for Frame {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &State) -> Result<Self, Problem> {
        let uri =
            parts.extensions.get::<OriginalUri>().map_or_else(|| parts.uri.clone(), |original| original.0.clone());
        let language = of_request(&parts.headers, &uri);
        Ok(Self::new(language, state.store.course().await?, uri, Some(Arc::clone(&state.assignment))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_switch_of_language_stays_on_the_page() {
        let frame = Frame::new(
            Language::En,
            Course::default(),
            Uri::from_static("/teacher/x?verdict=wrong&lang=en&q=a%22b"),
            None,
        );
        let [ja, en] = frame.tongues();
        assert_eq!(ja.href, "/teacher/x?verdict=wrong&q=a%22b&lang=ja");
        assert!(!ja.is_current && en.is_current);
        let [ja, _] = Frame::new(Language::Ja, Course::default(), Uri::from_static("/"), None).tongues();
        assert_eq!(ja.href, "/?lang=ja");
    }
}
