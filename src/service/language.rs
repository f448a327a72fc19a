//! The language of a request: `?lang=`, else the cookie that a page's switch sets, else Accept-Language.

use crate::language::Language;
use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use axum::http::{HeaderMap, Uri, header};
use std::convert::Infallible;

/// Name of the cookie that keeps a choice.
pub const COOKIE: &str = "ggrade_lang";

/// The language of a request, for handlers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lang(pub Language);

impl<S: Sync> FromRequestParts<S> for Lang {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _state: &S) -> Result<Self, Infallible> {
        Ok(Self(of_request(&parts.headers, &parts.uri)))
    }
}

/// The language of a request.
pub fn of_request(headers: &HeaderMap, uri: &Uri) -> Language {
    asked(uri)
        .or_else(|| super::identity::cookie(headers, COOKIE).and_then(named))
        .unwrap_or_else(|| accepted(headers.get(header::ACCEPT_LANGUAGE).and_then(|value| value.to_str().ok())))
}

/// The language that an address asks for.
pub fn asked(uri: &Uri) -> Option<Language> {
    let mut pairs = uri.query().into_iter().flat_map(|query| query.split('&'));
    pairs.find_map(|pair| pair.strip_prefix("lang=")).and_then(named)
}

/// The language of a name such as `ja` or `en-GB`.
fn named(name: &str) -> Option<Language> {
    match name.split(['-', '_']).next().unwrap_or_default().to_ascii_lowercase().as_str() {
        "ja" => Some(Language::Ja),
        "en" => Some(Language::En),
        _ => None,
    }
}

/// The one of our languages that is liked best; of equals the first; English where none is.
fn accepted(header: Option<&str>) -> Language {
    let mut best = None;
    for range in header.unwrap_or_default().split(',') {
        let (name, parameters) = range.split_once(';').unwrap_or((range, ""));
        let quality: f32 =
            parameters.trim().strip_prefix("q=").map_or(1.0, |quality| quality.trim().parse().unwrap_or(0.0));
        let Some(language) = named(name.trim()) else { continue };
        if quality > 0.0 && best.is_none_or(|(_, most)| quality > most) {
            best = Some((language, quality));
        }
    }
    best.map_or(Language::En, |(language, _)| language)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(query: &str, cookie: Option<&str>, accept: Option<&str>) -> Language {
        let mut headers = HeaderMap::new();
        if let Some(cookie) = cookie {
            headers.insert(header::COOKIE, cookie.parse().expect("a header"));
        }
        if let Some(accept) = accept {
            headers.insert(header::ACCEPT_LANGUAGE, accept.parse().expect("a header"));
        }
        of_request(&headers, &format!("/a{query}").parse().expect("an address"))
    }

    #[test]
    fn the_address_goes_before_the_cookie_and_the_cookie_before_the_browser() {
        assert_eq!(of("?x=1&lang=ja", Some("ggrade_lang=en"), Some("en")), Language::Ja);
        assert_eq!(of("", Some("a=b; ggrade_lang=ja"), Some("en")), Language::Ja);
        assert_eq!(of("?lang=fr", None, Some("ja-JP,ja;q=0.9,en;q=0.8")), Language::Ja);
        assert_eq!(of("", None, Some("fr, en-GB;q=0.5, ja;q=0.7")), Language::Ja);
        assert_eq!(of("", None, Some("ja;q=0, fr")), Language::En);
        assert_eq!(of("", None, None), Language::En);
    }
}
