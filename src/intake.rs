//! What was handed in: folders, files, archives and Moodle downloads → one [`StudentWork`] per student.
//!
//! [`folder`] walks a folder of this machine, [`archive`] reads a ZIP; both fill a [`tree`]. [`students`] finds in the
//! tree whose each file is ([`moodle`] knows the names in a Moodle download, [`layout`] what a folder looks like),
//! [`choose`] which of a student's files is the one to grade. Nothing is ever unpacked onto the disk, and no link is followed.

mod archive;
mod choose;
mod folder;
mod key;
mod layout;
mod limits;
mod moodle;
mod place;
mod reader;
mod students;
#[cfg(test)]
mod tests;
mod tree;
mod wording;
mod work;

pub use key::portable;
pub use limits::{Budget, IntakeLimits};
#[cfg(feature = "service")]
pub(crate) use moodle::is_blind;
pub use place::in_working_folder;
pub use work::{FileLocation, Participant, Refused, Student};

use crate::fault::Fault;
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Text;
use crate::slots::Slot;
use reader::{InputPath, IntakeReader};
use reference::Assignment;
use std::path::{Path, PathBuf};
use students::{Owned, StudentFiles, Who};

/// What one student handed in.
#[derive(Clone, Debug, PartialEq)]
pub struct StudentWork {
    /// Who.
    pub student: Student,
    /// The files, or why there is nothing to grade.
    pub content: HandInContent,
}

impl StudentWork {
    /// Where the files were, in one line; `None` without files.
    pub fn path(&self) -> Option<String> {
        match &self.content {
            HandInContent::Files { places, .. } => FileLocation::joined(places),
            HandInContent::Nothing(_) => None,
        }
    }
}

/// What can be graded of a hand-in.
#[derive(Clone, Debug, PartialEq)]
pub enum HandInContent {
    /// The files to grade, one for each slot of the homework.
    Files {
        /// Names and bytes (cut above the size that [`crate::source`] takes), in the order of the slots.
        hand_in: HandIn,
        /// Where each was.
        places: Vec<FileLocation>,
    },
    /// A file that is missing, double or unreadable: what to tell student and teacher.
    Nothing(Text),
}

/// Everything found in the input, in a stable order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Intake {
    /// Title of the class: the name of the archive or folder.
    pub title: String,
    /// Everyone.
    pub hand_ins: Vec<StudentWork>,
    /// Members that were left out, and why.
    pub refused: Vec<Refused>,
}

/// What is looked for, and how much is read at most.
#[derive(Clone, Debug)]
pub struct IntakeOptions {
    /// The files that the assignment asks for.
    pub slots: Vec<Slot>,
    /// How much is read.
    pub limits: IntakeLimits,
}

impl IntakeOptions {
    /// The options for an assignment.
    pub fn new(assignment: &Assignment) -> Self {
        Self { slots: assignment.files.clone(), limits: IntakeLimits::default() }
    }
}

/// Reads everything that is handed in below `inputs`: folders, archives and single files.
///
/// What cannot be read, or must not be, is named in [`Intake::refused`]; the rest is there.
pub fn read(inputs: &[PathBuf], options: &IntakeOptions) -> Result<Intake, Fault> {
    let names = place::names(inputs);
    let named: Vec<_> = inputs.iter().map(PathBuf::as_path).zip(&names).collect();
    Ok(Intake { title: place::title(inputs), ..read_named(&named, options) })
}

/// The same of one archive that somebody sent under the name `title`.
pub fn read_archive(archive: &Path, title: &str, options: &IntakeOptions) -> Intake {
    let name = format!("{title}.zip");
    Intake { title: title.into(), ..read_named(&[(archive, &name)], options) }
}

/// A part of one hand-in, as somebody named or sent it.
#[derive(Clone, Debug)]
pub enum HandInPart {
    /// A folder or an archive of this machine.
    Path(PathBuf),
    /// A file, or an archive, that was read already; and where it is on this machine, where it is there.
    File {
        /// Name and bytes.
        file: HandedInFile,
        /// Where it is.
        local: Option<PathBuf>,
    },
}

/// The files of one hand-in: those that are given, and those in the folders and archives among them.
pub fn one(given: Vec<HandInPart>, options: &IntakeOptions) -> HandInContent {
    match together(given, options) {
        Ok(group) => choose::choose(&group, options),
        Err(why) => HandInContent::Nothing(why),
    }
}

/// The names of the files of one hand-in, also of those in the folders and archives among what is given.
pub fn names(given: Vec<HandInPart>, options: &IntakeOptions) -> Vec<String> {
    let files = together(given, options).map(|group| group.files).unwrap_or_default();
    files.into_iter().map(|file| file.name).collect()
}

/// What there is for each slot among the files that are given, and in the archives among them; a single file that does not
/// say what it is is for the slot `asked`.
///
/// # Errors
/// Why nothing of it is for a slot, or for which slot there are several.
pub fn some(given: Vec<HandInPart>, asked: usize, options: &IntakeOptions) -> Result<Vec<Option<HandedInFile>>, Text> {
    choose::place(&together(given, options)?, asked, options)
}

/// The files that are given, and those in the folders and archives among them, as those of one person.
fn together(given: Vec<HandInPart>, options: &IntakeOptions) -> Result<StudentFiles, Text> {
    let mut reading = IntakeReader { options, budget: options.limits.total, refused: Vec::new(), untold: 0 };
    let mut files = Vec::new();
    let mut is_named = true;
    for given in given {
        let (name, input) = reading.given(given);
        match input {
            Some(InputPath::Folder(folder)) => {
                is_named = false;
                files.extend(students::owned(&name, folder));
            }
            Some(InputPath::File(file)) => {
                let own = name.rsplit('/').next().unwrap_or(&name).to_owned();
                files.push(Owned { below: own.clone(), name: own, path: name, file });
            }
            None => {}
        }
    }
    if let (true, Some(refused)) = (files.is_empty(), reading.refused.into_iter().next()) {
        let Text { en, ja } = refused.reason;
        return Err(Text::new(format!("{}: {en}", refused.path), format!("{}: {ja}", refused.path)));
    }
    let who = Who { name: String::new(), moodle: None, place: String::new() };
    Ok(StudentFiles { who, files, is_named, has_online_text: false })
}

/// Whether a file is to be opened as an archive: documents of office programs are archives as well, and have names of
/// their own.
fn is_archive(name: &str, bytes: &[u8]) -> bool {
    archive::is_archive_start(bytes) && (archive::is_archive(name) || !name.contains('.'))
}

/// Reads inputs, each with what it is called.
fn read_named(inputs: &[(&Path, &String)], options: &IntakeOptions) -> Intake {
    let mut reading = IntakeReader { options, budget: options.limits.total, refused: Vec::new(), untold: 0 };
    let mut groups = Vec::new();
    let mut loose = Vec::new();
    for &(path, name) in inputs {
        let found = reading.input(path, name);
        let untold = std::mem::take(&mut reading.untold);
        if untold > 0 {
            reading.refused.push(Refused { path: name.clone(), reason: limits::more_refused(untold) });
        }
        match found {
            Some(InputPath::Folder(folder)) => {
                let (found, refused) = students::in_folder(name, folder, options, inputs.len() > 1);
                groups.extend(found);
                reading.refused.extend(refused);
            }
            Some(InputPath::File(file)) => loose.push((name.clone(), path.to_owned(), file)),
            None => {}
        }
    }
    let (found, refused) = students::of_files(loose, options);
    groups.extend(found);
    reading.refused.extend(refused);
    let students = key::students(groups.iter().map(|group| &group.who));
    let mut hand_ins: Vec<StudentWork> = students
        .into_iter()
        .zip(&groups)
        .map(|(student, group)| StudentWork { student, content: choose::choose(group, options) })
        .collect();
    if let [(_, name)] = inputs {
        let places = hand_ins.iter_mut().flat_map(|hand_in| match &mut hand_in.content {
            HandInContent::Files { places, .. } => places.as_mut_slice(),
            HandInContent::Nothing(_) => &mut [],
        });
        for path in
            places.map(|place| &mut place.path).chain(reading.refused.iter_mut().map(|refused| &mut refused.path))
        {
            *path = place::below(std::mem::take(path), name);
        }
    }
    Intake { title: String::new(), hand_ins, refused: reading.refused }
}
