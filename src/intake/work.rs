//! Whose work it is, where it was found, and what was left out.

use crate::language::Text;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Who handed in.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Student {
    /// Tells students of a class apart and names their files: ASCII letters, digits, `-`, `_` and `.` only, unique in
    /// the class, the same in every run on the same input.
    pub key: String,
    /// The name as shown; under `--anonymous` the pseudonym.
    pub name: String,
    /// How Moodle names them, where the file came out of a Moodle download.
    pub moodle: Option<Participant>,
    /// Their mail address, where the roster has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub email: Option<String>,
}

/// A student, or where groups hand in a group, as Moodle's files name them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Participant {
    /// What stands before the number in the download's names: the full name, under blind marking `Participant`, or the
    /// name of a group.
    pub name: String,
    /// The number in the download's names. A participant's is unique in an assignment, and the worksheet's
    /// `Participant 1234` has it too; a group's is of another kind, and may be somebody's by accident. None for those
    /// who are in no group and hand in together, the default group.
    pub number: Option<u64>,
}

impl Participant {
    /// What Moodle calls those who are in no group, in the languages of the course.
    pub const DEFAULT_GROUP: [&str; 2] = ["Default group", "デフォルトグループ"];
}

/// Where a file was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileLocation {
    /// As a teacher would look for it: from the input on, folders and file name joined by `/`; where there are several
    /// inputs, from the folder on that holds them all.
    pub path: String,
    /// The same as a file of this machine from the working folder on, where it is one (not inside an archive, and not
    /// elsewhere).
    pub local: Option<PathBuf>,
}

impl FileLocation {
    /// Several places in one line; `None` where there is none.
    pub fn joined(places: &[Self]) -> Option<String> {
        let paths: Vec<&str> = places.iter().map(|place| place.path.as_str()).collect();
        (!paths.is_empty()).then(|| paths.join(", "))
    }
}

/// A member of the input that was left out, and why. The rest was graded.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Refused {
    /// Where it was.
    pub path: String,
    /// Why.
    pub reason: Text,
}
