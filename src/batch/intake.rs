//! What was handed in: folders, files, archives and Moodle downloads → one [`HandIn`] per student.

use super::class::{Refused, Student};
use crate::language::Text;
use std::path::PathBuf;

/// What one student handed in.
#[derive(Clone, Debug, PartialEq)]
pub struct HandIn {
    /// Who.
    pub student: Student,
    /// Where the file was, as a teacher would look for it: archive, folders, file name joined by `/`; none without file.
    pub path: Option<String>,
    /// The same as a file of this machine, where it is one (not inside an archive).
    pub local: Option<PathBuf>,
    /// The file, or why there is nothing to grade.
    pub content: Content,
}

/// What can be graded of a hand-in.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A file to grade: its own name, and its bytes (cut just above the size that [`crate::source`] takes).
    File {
        /// File name without folders.
        name: String,
        /// Its bytes.
        bytes: Vec<u8>,
    },
    /// No file, several files, an unreadable one: what to tell student and teacher.
    Nothing(Text),
}

/// Everything found in the input, in a stable order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Intake {
    /// Title of the class: the name of the archive or folder.
    pub title: String,
    /// Everyone.
    pub hand_ins: Vec<HandIn>,
    /// Members that were left out, and why.
    pub refused: Vec<Refused>,
}
