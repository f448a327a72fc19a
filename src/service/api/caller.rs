//! Who asks for a change: a teacher, by a program or by a page's own script.

use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::store::StaffRole;
use axum::http::HeaderMap;

/// Header of a page's own script, with the token of its forms: no other page can set it.
const CSRF: &str = "x-ggrade-csrf";

/// A teacher, with the headers of the request.
pub(super) type Caller = (Teacher, HeaderMap);

/// Lets a request pass that no other site's page makes a teacher's browser send.
pub(super) fn check_page(teacher: &Teacher, headers: &HeaderMap, service: &Service) -> Result<(), Problem> {
    teacher.check_csrf(service, headers.get(CSRF).and_then(|value| value.to_str().ok()).unwrap_or_default())
}

/// Lets who may do that much pass, where no other site's page makes their browser ask.
pub(super) fn check((teacher, headers): &Caller, service: &Service, least: StaffRole) -> Result<(), Problem> {
    check_page(teacher, headers, service)?;
    teacher.check_role(least)
}

/// The same for what belongs to the whole course.
pub(super) fn check_course(caller: &Caller, service: &Service, least: StaffRole) -> Result<(), Problem> {
    check(caller, service, least)?;
    caller.0.check_course()
}

/// Lets who may read what belongs to the whole course pass.
pub(super) fn check_reader(teacher: &Teacher, least: StaffRole) -> Result<(), Problem> {
    teacher.check_role(least)?;
    teacher.check_course()
}
