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
mod students;
#[cfg(test)]
mod tests;
mod tree;
mod wording;

pub use limits::{Budget, Limits};
pub(crate) use moodle::is_blind;
pub use place::in_working_folder;

use super::class::{Refused, Student};
use crate::fault::Fault;
use crate::language::Text;
use reference::Assignment;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use students::Group;
use tree::{File, Folder, Held};

/// What one student handed in.
#[derive(Clone, Debug, PartialEq)]
pub struct StudentWork {
    /// Who.
    pub student: Student,
    /// Where the file was, as a teacher would look for it: from the input on, folders and file name joined by `/`; where
    /// there are several inputs, from the folder on that holds them all. None without file.
    pub path: Option<String>,
    /// The same as a file of this machine from the working folder on, where it is one (not inside an archive, and not
    /// elsewhere).
    pub local: Option<PathBuf>,
    /// The file, or why there is nothing to grade.
    pub content: Content,
}

/// What can be graded of a hand-in.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A file to grade: its own name, and its bytes (cut above the size that [`crate::source`] takes).
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
    pub hand_ins: Vec<StudentWork>,
    /// Members that were left out, and why.
    pub refused: Vec<Refused>,
}

/// What is looked for, and how much is read at most.
#[derive(Clone, Debug)]
pub struct Options {
    /// Name of the file that the assignment asks for, such as `ggsample06.vert`.
    pub file_name: String,
    /// How much is read.
    pub limits: Limits,
}

impl Options {
    /// The options for an assignment of one file.
    pub fn new(assignment: &Assignment) -> Result<Self, Fault> {
        let file = assignment.files.first().ok_or_else(|| {
            let message = format!("assignment {}: no file is handed in", assignment.id);
            Fault::new(Text::verbatim(message))
        })?;
        Ok(Self { file_name: file.name.clone(), limits: Limits::default() })
    }
}

/// Reads everything that is handed in below `inputs`: folders, archives and single files.
///
/// What cannot be read, or must not be, is named in [`Intake::refused`]; the rest is there.
pub fn read(inputs: &[PathBuf], options: &Options) -> Result<Intake, Fault> {
    let names = place::names(inputs);
    let named: Vec<_> = inputs.iter().map(PathBuf::as_path).zip(&names).collect();
    Ok(Intake { title: place::title(inputs), ..read_named(&named, options) })
}

/// The same of one archive that somebody sent under the name `title`.
pub fn read_archive(archive: &Path, title: &str, options: &Options) -> Intake {
    let name = format!("{title}.zip");
    Intake { title: title.into(), ..read_named(&[(archive, &name)], options) }
}

/// Reads inputs, each with what it is called.
fn read_named(inputs: &[(&Path, &String)], options: &Options) -> Intake {
    let mut reading = Reading { options, budget: options.limits.total, refused: Vec::new(), untold: 0 };
    let mut groups = Vec::new();
    let mut loose = Vec::new();
    for &(path, name) in inputs {
        let found = reading.input(path, name);
        let untold = std::mem::take(&mut reading.untold);
        if untold > 0 {
            reading.refused.push(Refused { path: name.clone(), reason: limits::more_refused(untold) });
        }
        match found {
            Some(Input::Folder(folder)) => {
                let (found, refused) = students::in_folder(name, folder, options, inputs.len() > 1);
                groups.extend(found);
                reading.refused.extend(refused);
            }
            Some(Input::File(file)) => loose.push((name.clone(), path.to_owned(), file)),
            None => {}
        }
    }
    let (found, refused) = students::of_files(loose, options);
    groups.extend(found);
    reading.refused.extend(refused);
    let students = key::students(groups.iter().map(|group| &group.who));
    let mut hand_ins: Vec<StudentWork> =
        students.into_iter().zip(groups).map(|(student, group)| hand_in(student, group, options)).collect();
    if let [(_, name)] = inputs {
        let places = hand_ins.iter_mut().filter_map(|hand_in| hand_in.path.as_mut());
        for path in places.chain(reading.refused.iter_mut().map(|refused| &mut refused.path)) {
            *path = place::below(std::mem::take(path), name);
        }
    }
    Intake { title: String::new(), hand_ins, refused: reading.refused }
}

fn hand_in(student: Student, group: Group, options: &Options) -> StudentWork {
    let chosen = choose::choose(group, options);
    let local = chosen.local.and_then(|local| in_working_folder(&local));
    StudentWork { student, path: chosen.path, local, content: chosen.content }
}

/// What one path of the command line is.
enum Input {
    Folder(Folder),
    File(File),
}

/// What goes on while everything is read.
struct Reading<'a> {
    options: &'a Options,
    budget: Budget,
    refused: Vec<Refused>,
    /// How many refusals were too many to be listed.
    untold: u64,
}

impl Reading<'_> {
    fn input(&mut self, path: &Path, name: &str) -> Option<Input> {
        let metadata = match std::fs::metadata(path) {
            Ok(metadata) => metadata,
            Err(error) => {
                self.refuse(name.into(), limits::unreadable(&error));
                return None;
            }
        };
        if metadata.is_dir() {
            return Some(Input::Folder(folder::read(path, name, self)));
        }
        // The person who started ggrade chose this path: a link in it is meant.
        let read = std::fs::File::open(path).map_err(|error| limits::unreadable(&error));
        match read.and_then(|file| self.file(file, path, name)) {
            Ok(input) => Some(input),
            Err(reason) => {
                self.refuse(name.into(), reason);
                None
            }
        }
    }

    fn file(&mut self, file: std::fs::File, path: &Path, name: &str) -> Result<Input, Text> {
        let limit = self.options.limits.file_bytes;
        let mut start = [0; 4];
        let begins_as_archive = file.read_exact_at(&mut start, 0).is_ok() && archive::is_archive_start(&start);
        let is_shader = choose::fit(name, &self.options.file_name) <= choose::Fit::Renamed;
        if archive::is_archive(name) || begins_as_archive && !is_shader {
            return archive::read(file, name, self).map(Input::Folder);
        }
        let bytes = folder::contents(file, limit).map_err(|error| limits::unreadable(&error))?;
        Ok(Input::File(File { local: Some(path.into()), held: Held::Bytes(bytes) }))
    }

    fn refuse(&mut self, path: String, reason: Text) {
        match self.budget.refusals.checked_sub(1) {
            Some(left) => {
                self.budget.refusals = left;
                self.refused.push(Refused { path, reason });
            }
            None => self.untold += 1,
        }
    }

    /// Reads a part of an input, shown as `shown`, within the limits of a part.
    fn part<T>(&mut self, shown: &str, read: impl FnOnce(&mut Self) -> T) -> T {
        let whole = self.budget;
        let before = whole.within(self.options.limits.part);
        let untold = std::mem::replace(&mut self.untold, 0);
        self.budget = before;
        let result = read(self);
        self.budget = whole.less(before, self.budget);
        let untold = std::mem::replace(&mut self.untold, untold);
        if untold > 0 {
            // One line more than the part may have: what it hides is the whole's affair.
            self.refused.push(Refused { path: shown.into(), reason: limits::more_refused(untold) });
        }
        result
    }
}
