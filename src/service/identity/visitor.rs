//! The browser that a page is for.

use super::cookies::{Jar, STUDENT_COOKIE, is_set, read, set};
use super::{Identity, become_student, csrf, member_of, new_token, normal_number, token_hash};
use crate::service::errors::Problem;
use crate::service::proxied::ProxiedName;
use crate::service::store::Proof;
use crate::service::{Scope, Service};
use axum::extract::{FromRequestParts, Request, State as Shared};
use axum::http::request::Parts;
use axum::http::{Extensions, HeaderMap, header};
use axum::middleware::Next;
use axum::response::Response;

/// A year, in seconds: a course and its repetition.
const COOKIE_LIFE: u64 = 365 * 24 * 3600;

/// A browser, known by its cookie. Nothing is stored of who only looks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Visitor {
    token: String,
    is_new: bool,
    /// Who that is.
    pub identity: Identity,
}

impl Visitor {
    /// A browser that is not known.
    fn unknown() -> Self {
        Self { token: new_token(), is_new: true, identity: Identity::Nobody }
    }

    /// The browser of a request.
    pub(in crate::service) async fn of(service: &Service, headers: &HeaderMap) -> Result<Self, Problem> {
        let Some(token) = read(service, headers, STUDENT_COOKIE) else { return Ok(Self::unknown()) };
        let identity = match service.store.owner(&token_hash(&token)).await? {
            None => Identity::Nobody,
            Some(owner) => match &owner.student_id {
                None => Identity::Browser(owner),
                Some(id) => match service.store.student_by_id(id).await? {
                    Some(student) if owner.proves(&student) => Identity::Student(owner, student),
                    Some(student) => Identity::Claimed(owner, student),
                    None => Identity::Browser(owner),
                },
            },
        };
        Ok(Self { token, is_new: false, identity })
    }

    /// Whoever a reverse proxy says that it is: the browser becomes that student's. Where the name is no student's of this course,
    /// the browser is nobody's.
    async fn proxied(self, service: &Service, extensions: &Extensions) -> Result<Self, Problem> {
        let Some(ProxiedName(name)) = extensions.get::<ProxiedName>() else { return Ok(self) };
        let is_staff = member_of(service, name).await?.is_some();
        let student = match normal_number(name).filter(|_| !is_staff) {
            Some(number) => service.store.student(&number, service.clock.now()).await?,
            None => None,
        };
        match (student, self.identity.student().or(self.identity.claimed())) {
            (Some(student), _) if self.identity.student_id() == Some(student.id.as_str()) => Ok(self),
            (Some(student), _) => become_student(service, self, student, Proof::Platform).await,
            (None, Some(_)) => Ok(Self::replaced()),
            (None, None) => Ok(self),
        }
    }

    /// Whether the request brought no cookie.
    pub fn is_new(&self) -> bool {
        self.is_new
    }

    /// The token of every form on a page for this browser: `<input type="hidden" name="csrf">`.
    pub fn csrf(&self, service: &Service) -> String {
        csrf::token(service, &self.token)
    }

    /// Lets a form pass that has this browser's token.
    pub fn check_csrf(&self, service: &Service, given: &str) -> Result<(), Problem> {
        csrf::check(service, &self.token, given)
    }

    /// The same, known from now on: for who hands something in.
    pub async fn known(mut self, service: &Service) -> Result<Self, Problem> {
        if self.identity == Identity::Nobody {
            let owner = service.store.owner_or_new(&token_hash(&self.token), service.clock.now()).await?;
            self.identity = Identity::Browser(owner);
        }
        Ok(self)
    }

    /// The same browser by another secret, which its cookie has from now on.
    pub(super) fn renamed(self) -> Self {
        Self { token: new_token(), is_new: true, ..self }
    }

    /// The hash of the secret by which it is known.
    pub(super) fn token_hash(&self) -> String {
        token_hash(&self.token)
    }

    /// Another browser in the place of this one, for a student who sits down where another one sat.
    pub(in crate::service) fn replaced() -> Self {
        Self::unknown()
    }

    /// Makes a response set this browser's cookie.
    pub fn set_cookie(&self, service: &Service, response: &mut Response) {
        self.set_cookie_in(service, response, Jar::Own);
    }

    /// The same in a jar of one's choice.
    pub(in crate::service) fn set_cookie_in(&self, service: &Service, response: &mut Response, jar: Jar) {
        if let Some(cookie) = set(service, STUDENT_COOKIE, &self.token, COOKIE_LIFE, jar) {
            response.headers_mut().append(header::SET_COOKIE, cookie);
        }
    }
}

/// The layer around pages: gives each browser its cookie.
pub async fn visit(Shared(service): Shared<Service>, mut request: Request, next: Next) -> Result<Response, Problem> {
    let visitor = Visitor::of(&service, request.headers()).await?.proxied(&service, request.extensions()).await?;
    let jar = Jar::of(request.headers());
    request.extensions_mut().insert(visitor.clone());
    let mut response = next.run(request).await;
    // A handler may have put another browser in its place.
    if visitor.is_new && !is_set(&service, response.headers(), STUDENT_COOKIE) {
        visitor.set_cookie_in(&service, &mut response, jar);
    }
    Ok(response)
}

impl<S: Scope> FromRequestParts<S> for Visitor {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, scope: &S) -> Result<Self, Problem> {
        match parts.extensions.get::<Self>() {
            Some(visitor) => Ok(visitor.clone()),
            None => Self::of(scope.whole(), &parts.headers).await?.proxied(scope.whole(), &parts.extensions).await,
        }
    }
}
