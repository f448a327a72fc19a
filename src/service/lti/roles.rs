//! What the roles that a platform names say here: only roles in the course do.
//!
//! LTI 1.3 writes a role in a course as `…/membership#PRINCIPAL`, a sub-role of it as `…/membership/PRINCIPAL#SUB`, and takes the
//! plain name of a principal role for it. Roles of a person at an institution or in a system are other vocabularies. Who has a
//! sub-role should be named with its principal role as well.

use crate::service::store::StaffRole;

/// The vocabulary of roles in a course.
const MEMBERSHIP: &str = "http://purl.imsglobal.org/vocab/lis/v2/membership";

const INSTRUCTOR: &str = "Instructor";
const ASSISTANT: &str = "TeachingAssistant";

/// A role in the course.
#[derive(Clone, Copy)]
struct CourseRole<'a> {
    principal: &'a str,
    sub: Option<&'a str>,
}

impl<'a> CourseRole<'a> {
    /// The role of this name; none where it is none in the course.
    fn of(name: &'a str) -> Option<Self> {
        let Some(rest) = name.strip_prefix(MEMBERSHIP) else {
            let is_plain = !name.contains(['/', '#', ':']);
            return is_plain.then_some(Self { principal: name, sub: None });
        };
        match rest.split_once('#')? {
            ("", principal) => Some(Self { principal, sub: None }),
            (principal, sub) => Some(Self { principal: principal.strip_prefix('/')?, sub: Some(sub) }),
        }
    }

    /// Whether it says that somebody assists.
    fn assists(self) -> bool {
        match self.sub {
            Some(sub) => self.principal == INSTRUCTOR && (sub.starts_with(ASSISTANT) || sub == "Grader"),
            None => self.principal == ASSISTANT,
        }
    }

    /// Whether it says that somebody teaches.
    fn teaches(self) -> bool {
        matches!(self.principal, INSTRUCTOR | "Administrator") && !self.assists()
    }
}

fn in_course(roles: &[String]) -> impl Iterator<Item = CourseRole<'_>> {
    roles.iter().filter_map(|role| CourseRole::of(role))
}

/// What somebody with these roles may do here; none for who does not teach.
pub(super) fn staff_role(roles: &[String]) -> Option<StaffRole> {
    let assists = in_course(roles).any(CourseRole::assists);
    // Of an assistant the principal role says no more than that they are one.
    let counts = |role: &CourseRole<'_>| !(assists && role.principal == INSTRUCTOR && role.sub.is_none());
    match in_course(roles).filter(counts).any(CourseRole::teaches) {
        true => Some(StaffRole::Lecturer),
        false => assists.then_some(StaffRole::Assistant),
    }
}

/// Whether somebody with these roles is a student of the course.
pub(super) fn is_learner(roles: &[String]) -> bool {
    in_course(roles).any(|role| role.principal == "Learner")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(roles: &[&str]) -> (Option<StaffRole>, bool) {
        let whole = |role: &&str| match role.strip_prefix("~") {
            Some(rest) => format!("http://purl.imsglobal.org/vocab/lis/v2/{rest}"),
            None => (*role).to_owned(),
        };
        let roles: Vec<String> = roles.iter().map(whole).collect();
        (staff_role(&roles), is_learner(&roles))
    }

    #[test]
    fn only_roles_in_the_course_count() {
        let (lecturer, assistant) = ((Some(StaffRole::Lecturer), false), (Some(StaffRole::Assistant), false));
        let (student, nobody) = ((None, true), (None, false));
        let cases: [(&[&str], _); 22] = [
            (&["~membership#Instructor"], lecturer),
            (&["Instructor"], lecturer),
            (&["~membership#Administrator"], lecturer),
            (&["~membership/Instructor#PrimaryInstructor"], lecturer),
            (&["~membership/Instructor#TeachingAssistant"], assistant),
            (&["~membership/Instructor#TeachingAssistantSection"], assistant),
            (&["~membership/Instructor#Grader"], assistant),
            (&["TeachingAssistant"], assistant),
            // The principal role comes along.
            (&["~membership#Instructor", "~membership/Instructor#TeachingAssistant"], assistant),
            // An assistant of one group, and more than that in another one.
            (&["~membership/Instructor#Lecturer", "~membership/Instructor#TeachingAssistant"], lecturer),
            (&["~membership#Administrator", "~membership/Instructor#TeachingAssistant"], lecturer),
            (&["~membership#Learner"], student),
            (&["Learner"], student),
            (&["~membership/Learner#Instructor"], student),
            (&["~membership#Learner", "~institution/person#Instructor"], student),
            (&["~membership#Learner", "~system/person#Administrator"], student),
            (&["~membership#ContentDeveloper"], nobody),
            (&["~institution/person#Learner"], nobody),
            (&["~institution/person#Administrator", "~institution/person#Faculty"], nobody),
            (&["urn:lti:sysrole:ims/lis/SysAdmin", "https://else.example/membership#Instructor"], nobody),
            (&["~membershipx#Instructor", "~membership", "~membership/Instructor", "#Instructor"], nobody),
            (&[], nobody),
        ];
        for (roles, expected) in cases {
            assert_eq!(of(roles), expected, "{roles:?}");
        }
    }
}
