//! The way into a course: addresses below `/c/COURSE`, and what they become in answers.
//!
//! Within a course, addresses are what they are in the first one: the way in takes `/c/COURSE` off a request, and puts it before
//! where an answer leads. Pages and the API write it themselves ([`at`]).

use super::Service;
use axum::Router;
use axum::extract::{OriginalUri, Request};
use axum::http::{HeaderMap, HeaderValue, Uri, header};
use axum::response::Response;
use std::sync::Arc;
use tower::ServiceExt;

tokio::task_local! {
    /// What the addresses of the course begin with that is being asked.
    static ROOT: Arc<str>;
}

/// What the addresses of the course begin with that is being asked: nothing in the first one.
pub fn root() -> Arc<str> {
    ROOT.try_with(Arc::clone).unwrap_or_else(|_| "".into())
}

/// An address of the course that is being asked, from its address within the course.
pub fn at(path: &str) -> String {
    format!("{}{path}", root())
}

/// What an address begins with that is of another course than the first: `/c/COURSE`.
pub fn root_of(path: &str) -> &str {
    let Some(rest) = path.strip_prefix("/c/") else { return "" };
    let end = rest.find('/').unwrap_or(rest.len());
    &path[.."/c/".len() + end]
}

/// The address of the course: the configured one, or that by which whoever asks knows it.
pub fn public_address(service: &Service, headers: &HeaderMap) -> String {
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok());
    let own = || format!("http://{}", host.map_or_else(|| service.config.listen.to_string(), str::to_owned));
    let host = service.config.public_url.clone().unwrap_or_else(own);
    format!("{}{}", host.trim_end_matches('/'), service.root())
}

/// The course to which a request leads, with its routes.
pub(in crate::service) fn within(first: &Service, request: &Request) -> Option<(Arc<str>, Router)> {
    let root = root_of(request.uri().path());
    let id = root.strip_prefix("/c/")?;
    let courses = first.courses.open();
    let open = courses.iter().find(|open| open.id == id)?;
    Some((root.into(), open.routes.clone()))
}

/// The answer of a course.
pub(in crate::service) async fn answer(root: Arc<str>, routes: Router, mut request: Request) -> Response {
    let asked = request.uri().clone();
    let rest = asked.path_and_query().map_or("", |path| &path.as_str()[root.len()..]);
    let rest = if rest.starts_with('/') { rest.to_owned() } else { format!("/{rest}") };
    // What is left of an address that was read once can be read again.
    *request.uri_mut() = rest.parse().unwrap_or_else(|_| Uri::from_static("/"));
    request.extensions_mut().insert(OriginalUri(asked));
    let answered = ROOT.scope(Arc::clone(&root), routes.oneshot(request)).await;
    let mut response = match answered {
        Ok(response) => response,
        Err(never) => match never {},
    };
    let location = response.headers().get(header::LOCATION).and_then(|value| value.to_str().ok());
    if let Some(location) = location
        && location.starts_with('/')
        && root_of(location) != &*root
        && let Ok(location) = HeaderValue::try_from(format!("{root}{location}"))
    {
        response.headers_mut().insert(header::LOCATION, location);
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_says_its_course() {
        for (path, root) in [("/c/x/a/b", "/c/x"), ("/c/x", "/c/x"), ("/c/x/", "/c/x"), ("/a/c/x", ""), ("/", "")] {
            assert_eq!(root_of(path), root, "{path}");
        }
        assert_eq!(at("/r/1"), "/r/1");
    }
}
