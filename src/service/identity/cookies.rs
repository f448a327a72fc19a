//! Cookies: HttpOnly, SameSite=Lax, and behind https Secure and bound to the host.

use super::secrets::TOKEN_LENGTH;
use crate::service::Service;
use axum::http::{HeaderMap, HeaderValue, header};

/// Base name of the cookie of a browser.
pub const STUDENT_COOKIE: &str = "ggrade";
/// Base name of the cookie of a teacher's session.
pub const TEACHER_COOKIE: &str = "ggrade_teacher";

/// The name as it is sent: with https, browsers let nobody but this very host set it.
fn name(service: &Service, base: &str) -> String {
    if service.config.is_secure() { format!("__Host-{base}") } else { base.to_owned() }
}

/// The value of ours that a request brings.
pub(super) fn read(service: &Service, headers: &HeaderMap, base: &str) -> Option<String> {
    let name = name(service, base);
    named(headers, &name).filter(|value| is_token(value)).map(str::to_owned)
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

/// Whether a response sets this cookie of ours.
pub(super) fn is_set(service: &Service, headers: &HeaderMap, base: &str) -> bool {
    let start = format!("{}=", name(service, base));
    headers.get_all(header::SET_COOKIE).iter().any(|value| value.as_bytes().starts_with(start.as_bytes()))
}

/// A `Set-Cookie` of one of our secrets, which are hexadecimal; 0 seconds removes it.
pub(super) fn set(service: &Service, base: &str, value: &str, seconds: u64) -> Option<HeaderValue> {
    let secure = if service.config.is_secure() { "; Secure" } else { "" };
    let name = name(service, base);
    format!("{name}={value}; Path=/; Max-Age={seconds}; HttpOnly; SameSite=Lax{secure}").parse().ok()
}
