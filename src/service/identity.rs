//! Who is there: a browser, a student in it, a teacher.
//!
//! A browser is known by an unguessable cookie, which ties its own history together. Whoever came by the course link gives
//! a student number, and the personal code that goes with it ([`codes`]): then what the browser hands in counts for that
//! student. Without a roster there is nobody who hands codes out, and the first browser that gives a number has it. A
//! report's address is a capability. Cookies are stored as hashes only.

mod accounts;
mod codes;
mod cookies;
mod csrf;
mod extractors;
mod join;
mod login;
mod origin;
mod pseudonyms;
mod secrets;
mod staff;
mod teacher;
mod tokens;
mod visitor;

pub(super) use accounts::vouched_for;
pub use accounts::{check_may_invite, people};
pub use codes::{code_needed, personal_code, personal_link};
pub use cookies::{Jar, STUDENT_COOKIE, TEACHER_COOKIE};
pub(super) use cookies::{has_launch, has_trial, set_launch, set_sign_in, set_trial};
pub(super) use cookies::{named as cookie, of_visitor as visitor_cookie};
pub(super) use csrf::{check as check_form, token as form_token};
pub use extractors::{LecturerPage, TeacherPage};
pub(super) use join::{become_student, check_code};
pub use join::{
    check_course_link, course_link, course_secret, join, leave, normal_number, renew_course_secret, with_code,
};
pub use login::{LoginForm, login, logout, open_for};
pub(super) use login::{check_session, end_session};
pub use origin::is_own_page;
pub(super) use secrets::equal_secrets;
pub use secrets::{hash_password, new_id, new_token, token_hash};
pub(super) use staff::PASSWORD_SETTING;
pub(crate) use staff::SHORTEST_PASSWORD;
pub use staff::{
    add_staff, check_may_manage, choose_password, invitation_link, invite, invited, let_in, member_of, set_staff,
};
pub use teacher::Teacher;
pub(super) use teacher::{bearer, is_teachers_program};
pub use tokens::{LONGEST_DAYS, WantedToken, check_wanted_scope, end_token, make_token, tokens_for};
pub use visitor::{Visitor, visit};

use super::store::{Owner, StudentRecord, Submission};

/// Who hands in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Identity {
    /// Somebody, known by nothing.
    Nobody,
    /// A browser.
    Browser(Owner),
    /// A browser in which somebody gave a number that they have not proved to be theirs.
    Claimed(Owner, StudentRecord),
    /// A student who proved in a browser who they are.
    Student(Owner, StudentRecord),
    /// A student for whom the teacher's program hands in.
    OnBehalf(StudentRecord),
}

impl Identity {
    /// Id of the browser.
    pub fn owner_id(&self) -> Option<&str> {
        match self {
            Self::Browser(owner) | Self::Claimed(owner, _) | Self::Student(owner, _) => Some(&owner.id),
            Self::Nobody | Self::OnBehalf(_) => None,
        }
    }

    /// The student.
    pub fn student(&self) -> Option<&StudentRecord> {
        match self {
            Self::Student(_, student) | Self::OnBehalf(student) => Some(student),
            Self::Nobody | Self::Browser(_) | Self::Claimed(..) => None,
        }
    }

    /// Id of the student.
    pub fn student_id(&self) -> Option<&str> {
        self.student().map(|student| student.id.as_str())
    }

    /// Whether they handed this in: in this browser, or as the student who proved in it who they are.
    pub fn has_handed_in(&self, submission: &Submission) -> bool {
        let is_theirs = |own: Option<&str>, of: &Option<String>| own.is_some() && own == of.as_deref();
        let is_students = submission.student_id.is_none() || submission.student_id.as_deref() == self.student_id();
        is_theirs(self.student_id(), &submission.student_id)
            || (is_students && is_theirs(self.owner_id(), &submission.owner_id))
    }

    /// The student whose number was given without a proof.
    pub fn claimed(&self) -> Option<&StudentRecord> {
        match self {
            Self::Claimed(_, student) => Some(student),
            _ => None,
        }
    }
}
