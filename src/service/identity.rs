//! Who is there: a browser, a student in it, a teacher.
//!
//! A browser is known by an unguessable cookie, which ties its own history together. A student number is given by form
//! to whoever came by the course link; it says whom a submission counts for in the class table, and opens nothing: a
//! history belongs to the browser, so that typing a neighbour's number shows nobody's files. A report's address is a
//! capability. Cookies are stored as hashes only.

mod cookies;
mod csrf;
mod join;
mod login;
mod secrets;
mod teacher;
mod visitor;

pub use cookies::{STUDENT_COOKIE, TEACHER_COOKIE};
pub(super) use cookies::{named as cookie, of_visitor as visitor_cookie};
pub use join::{check_course_link, course_secret, join, leave, normal_number, renew_course_secret};
pub(super) use login::PASSWORD_SETTING;
pub use login::{LoginForm, login, logout};
pub use secrets::{hash_password, new_id, new_token, token_hash};
pub(super) use secrets::{hex, same};
pub use teacher::{Teacher, TeacherPage};
pub(super) use teacher::{bearer, is_teachers_program};
pub use visitor::{Visitor, visit};

use super::store::{Owner, Student};

/// Who hands in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Identity {
    /// Somebody, known by nothing.
    Nobody,
    /// A browser.
    Browser(Owner),
    /// A student who gave a number in a browser. Whoever a learning platform vouches for joins here.
    Student(Owner, Student),
    /// A student for whom the teacher's program hands in.
    OnBehalf(Student),
}

impl Identity {
    /// Id of the browser.
    pub fn owner_id(&self) -> Option<&str> {
        match self {
            Self::Browser(owner) | Self::Student(owner, _) => Some(&owner.id),
            Self::Nobody | Self::OnBehalf(_) => None,
        }
    }

    /// The student.
    pub fn student(&self) -> Option<&Student> {
        match self {
            Self::Student(_, student) | Self::OnBehalf(student) => Some(student),
            Self::Nobody | Self::Browser(_) => None,
        }
    }
}
