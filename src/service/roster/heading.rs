//! The heading of a roster: which column is which.

use super::read::participant;
use crate::service::identity::normal_number;
use crate::service::store::RosterLine;
use unicode_normalization::UnicodeNormalization;

/// What columns are called, in the languages of the course and by Moodle; spaces and case aside.
const NUMBER: [&str; 17] = [
    "学籍番号",
    "学生番号",
    "学生証番号",
    "studentnumber",
    "studentno",
    "studentid",
    "matrikelnummer",
    "idnumber",
    "idナンバー",
    "sisuserid",
    "sid",
    "orgdefinedid",
    "ユーザ名",
    "ユーザー名",
    "username",
    "number",
    "id",
];
const NAME: [&str; 9] =
    ["氏名", "学生氏名", "名前", "姓名", "フルネーム", "fullname", "name", "studentname", "student"];
const FAMILY: [&str; 6] = ["姓", "surname", "lastname", "familyname", "last", "nachname"];
const GIVEN: [&str; 6] = ["名", "firstname", "givenname", "forename", "first", "vorname"];
const MOODLE: [&str; 2] = ["識別子", "identifier"];
const EMAIL: [&str; 10] = [
    "メールアドレス",
    "メール",
    "eメール",
    "電子メール",
    "email",
    "emailaddress",
    "e-mail",
    "e-mailaddress",
    "e-mail-adresse",
    "mail",
];
const GROUP: [&str; 7] = ["グループ", "班", "クラス", "group", "groups", "section", "gruppe"];

/// How lines of Canvas's gradebook begin that are no students.
const NO_STUDENT: [&str; 3] = ["points possible", "manual posting", "student, test"];

/// The columns that a heading names.
#[derive(Debug, Default)]
pub(super) struct Heading {
    number: Option<usize>,
    name: Option<usize>,
    family: Option<usize>,
    given: Option<usize>,
    moodle: Option<usize>,
    group: Option<usize>,
    email: Option<usize>,
    /// The names of the columns that are not taken.
    pub left_aside: Vec<String>,
}

impl Heading {
    /// A heading names the column of the numbers; a line without that is none.
    pub fn of(cells: &[String]) -> Option<Self> {
        let folded: Vec<String> = cells
            .iter()
            .map(|cell| {
                cell.nfkc().filter(|c| !c.is_whitespace() && !"_.".contains(*c)).collect::<String>().to_lowercase()
            })
            .collect();
        // The first name of the list counts: Moodle has both an ID number and a username.
        let find = |names: &[&str]| names.iter().find_map(|name| folded.iter().position(|cell| cell == name));
        let number = find(&NUMBER)?;
        let mut heading = Self {
            number: Some(number),
            name: find(&NAME),
            family: find(&FAMILY),
            given: find(&GIVEN),
            moodle: find(&MOODLE),
            group: find(&GROUP),
            email: find(&EMAIL),
            left_aside: Vec::new(),
        };
        let taken = heading.taken();
        let others =
            cells.iter().enumerate().filter(|(index, cell)| !taken.contains(&Some(*index)) && !cell.is_empty());
        heading.left_aside = others.map(|(_, cell)| cell.clone()).collect();
        Some(heading)
    }

    /// The columns that are taken. The parts of a name are where there is no whole one.
    fn taken(&self) -> [Option<usize>; 7] {
        let part = |column: Option<usize>| column.filter(|_| self.name.is_none());
        [self.number, self.name, part(self.family), part(self.given), self.moodle, self.group, self.email]
    }

    /// The student of a line; none where it has no student number.
    pub fn line(&self, cells: &[String]) -> Option<RosterLine> {
        let cell =
            |column: Option<usize>| column.and_then(|column| cells.get(column)).map(String::as_str).unwrap_or_default();
        let name = match cell(self.name) {
            "" => format!("{} {}", cell(self.family), cell(self.given)).trim().to_owned(),
            name => name.to_owned(),
        };
        Some(RosterLine {
            number: normal_number(cell(self.number).trim_start_matches('#'))?,
            name,
            moodle: participant(cell(self.moodle)),
            group: cell(self.group).to_owned(),
            email: cell(self.email).to_owned(),
        })
    }
}

/// Whether a line is one of a gradebook that stands for no student.
pub(super) fn is_no_student(cells: &[String]) -> bool {
    let first = cells.iter().find(|cell| !cell.is_empty());
    first.is_some_and(|first| NO_STUDENT.contains(&first.to_lowercase().as_str()))
}

#[cfg(test)]
mod tests {
    use super::super::read::{RosterFile, read};
    use super::*;

    fn of(text: &str) -> RosterFile {
        read(text.as_bytes()).expect("a roster")
    }

    fn line(name: &str, group: &str, email: &str) -> RosterLine {
        RosterLine { name: name.into(), group: group.into(), email: email.into(), number: "S1".into(), moodle: None }
    }

    #[test]
    fn columns_are_known_as_other_systems_name_them() {
        for (file, left_aside) in [
            ("Matrikelnummer;Nachname;Vorname;Gruppe;E-Mail\ns1;Wada;Hanako;Di;h@x.org\n", &[][..]),
            ("ID,Last Name,First Name,Group,E-Mail,Year\ns1,Wada,Hanako,Di,h@x.org,3\n", &["Year"]),
            (
                "OrgDefinedId,Username,Last Name,First Name,Email,Group,End-of-Line Indicator\n#s1,#hw,Wada,Hanako,h@x.org,Di,#\n",
                &["Username", "End-of-Line Indicator"],
            ),
        ] {
            let read = of(file);
            assert_eq!(
                (read.lines, read.left_aside),
                (
                    vec![line("Wada Hanako", "Di", "h@x.org")],
                    left_aside.iter().map(|&name| name.to_owned()).collect::<Vec<_>>()
                )
            );
        }
    }

    #[test]
    fn lines_of_canvas_that_are_no_students_are_passed_over() {
        let file = "Student,ID,SIS User ID,SIS Login ID,Section,Homework 1 (7)\n,,,,,Manual Posting\n    Points Possible,,,,,100\n\"Wada, Hanako\",12,s1,hw,CG-A,80\n\"Student, Test\",13,,ab12,CG-A,\n";
        let read = of(file);
        assert_eq!(read.lines, [line("Wada, Hanako", "CG-A", "")]);
        assert_eq!(read.left_aside, ["ID", "SIS Login ID", "Homework 1 (7)"]);
    }
}
