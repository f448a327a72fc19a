//! Cookies: HttpOnly, SameSite=Lax, and behind https Secure and bound to the host. Inside a page of a learning platform they
//! are SameSite=None, and Partitioned: that platform's pages have them and no other site's.

use super::secrets::TOKEN_LENGTH;
use crate::service::Service;
use axum::http::{HeaderMap, HeaderValue, header};

/// Base name of the cookie of a browser.
pub const STUDENT_COOKIE: &str = "ggrade";
/// Base name of the cookie of a teacher's session.
pub const TEACHER_COOKIE: &str = "ggrade_teacher";

/// The name as it is sent: with https, browsers let nobody but this very host set it.
fn name_of_all(service: &Service, base: &str) -> String {
    if service.config.is_secure() { format!("__Host-{base}") } else { base.to_owned() }
}

/// The same in its course: another student at this browser in one course changes nothing in the others. A session is of all.
fn name(service: &Service, base: &str) -> String {
    let name = name_of_all(service, base);
    match service.course_id().filter(|_| base == STUDENT_COOKIE) {
        Some(course) => format!("{name}_{course}"),
        None => name,
    }
}

/// The value of ours that a request brings.
pub(super) fn read(service: &Service, headers: &HeaderMap, base: &str) -> Option<String> {
    let names = [name(service, base), name_of_all(service, base)];
    names.iter().find_map(|name| named(headers, name).filter(|value| is_token(value))).map(str::to_owned)
}

/// The secret by which a browser is known, where the request brings one.
pub(in crate::service) fn of_visitor(service: &Service, headers: &HeaderMap) -> Option<String> {
    read(service, headers, STUDENT_COOKIE)
}

/// Whether this can be a secret of ours.
fn is_token(value: &str) -> bool {
    value.len() == TOKEN_LENGTH && value.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// The value of the first cookie with this name.
pub(in crate::service) fn named<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a str> {
    let values = headers.get_all(header::COOKIE).iter().filter_map(|value| value.to_str().ok());
    let mut pairs = values.flat_map(|value| value.split(';')).filter_map(|pair| pair.trim().split_once('='));
    pairs.find(|(found, _)| *found == name).map(|(_, value)| value)
}

/// Takes a cookie of ours out of a request.
pub(super) fn remove(service: &Service, headers: &mut HeaderMap, base: &str) {
    let start = format!("{}=", name(service, base));
    let values = headers.get_all(header::COOKIE).iter().filter_map(|value| value.to_str().ok());
    let pairs = values.flat_map(|value| value.split(';')).map(str::trim).filter(|pair| !pair.starts_with(&start));
    let rest = pairs.collect::<Vec<_>>().join("; ");
    match HeaderValue::from_str(&rest) {
        Ok(rest) if !rest.is_empty() => headers.insert(header::COOKIE, rest),
        _ => headers.remove(header::COOKIE),
    };
}

/// Whether a response sets this cookie of ours.
pub(super) fn is_set(service: &Service, headers: &HeaderMap, base: &str) -> bool {
    let start = format!("{}=", name(service, base));
    headers.get_all(header::SET_COOKIE).iter().any(|value| value.as_bytes().starts_with(start.as_bytes()))
}

/// Where a cookie is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Jar {
    /// With those of this service's own pages.
    Own,
    /// With those of this service inside the pages of one other site.
    Embedded,
}

impl Jar {
    /// The one of a request: browsers say whether a page is for a frame.
    pub fn of(headers: &HeaderMap) -> Self {
        let place = headers.get("sec-fetch-dest").and_then(|value| value.to_str().ok());
        if matches!(place, Some("iframe" | "frame")) { Self::Embedded } else { Self::Own }
    }
}

/// A `Set-Cookie` of one of our secrets, which are hexadecimal; 0 seconds removes it.
pub(super) fn set(service: &Service, base: &str, value: &str, seconds: u64, jar: Jar) -> Option<HeaderValue> {
    let rest = match (service.config.is_secure(), jar) {
        (true, Jar::Embedded) => "SameSite=None; Secure; Partitioned",
        (true, Jar::Own) => "SameSite=Lax; Secure",
        (false, _) => "SameSite=Lax",
    };
    let name = name(service, base);
    format!("{name}={value}; Path=/; Max-Age={seconds}; HttpOnly; {rest}").parse().ok()
}

/// Base name of the cookie by which it is seen whether a browser keeps any inside another site's page.
const TRIAL_COOKIE: &str = "ggrade_trial";

/// Seconds for which that is known.
const TRIAL: u64 = 600;

/// A `Set-Cookie` that a browser is to keep inside another site's page.
pub(in crate::service) fn set_trial(service: &Service) -> Option<HeaderValue> {
    set(service, TRIAL_COOKIE, &"0".repeat(TOKEN_LENGTH), TRIAL, Jar::Embedded)
}

/// Whether a browser has kept it.
pub(in crate::service) fn has_trial(service: &Service, headers: &HeaderMap) -> bool {
    read(service, headers, TRIAL_COOKIE).is_some()
}

/// Base name of the cookie that binds a launch to its browser; each launch has its own.
const LAUNCH_COOKIE: &str = "ggrade_launch_";

/// A launch is begun in one tab while another one is under way: this much of its state tells their cookies apart.
fn of_launch(state: &str) -> String {
    format!("{LAUNCH_COOKIE}{}", state.get(..16).unwrap_or_default())
}

/// A `Set-Cookie` by which a launch is known to come back to the browser in which it began. The answer of the platform is
/// a form of another site, so that it comes with no cookie that is `Lax`.
pub(in crate::service) fn set_launch(service: &Service, state: &str, seconds: u64, jar: Jar) -> Option<HeaderValue> {
    let cookie = set(service, &of_launch(state), state, seconds, jar)?;
    if !service.config.is_secure() || jar == Jar::Embedded {
        return Some(cookie);
    }
    cookie.to_str().ok()?.replace("SameSite=Lax", "SameSite=None").parse().ok()
}

/// The same for a sign-in, whose answer is a link: cookies that are `Lax` come with it.
pub(in crate::service) fn set_sign_in(service: &Service, state: &str, seconds: u64) -> Option<HeaderValue> {
    set(service, &of_launch(state), state, seconds, Jar::Own)
}

/// Whether a request comes from the browser in which a launch or a sign-in began.
pub(in crate::service) fn has_launch(service: &Service, headers: &HeaderMap, state: &str) -> bool {
    read(service, headers, &of_launch(state)).is_some_and(|value| super::equal_secrets(&value, state))
}
