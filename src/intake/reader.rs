//! Reads one input after the other, within the limits, and keeps what it refuses.

use super::tree::{Held, TreeFile, TreeFolder};
use super::{
    Budget, HandInPart, IntakeOptions, Refused, archive, folder, in_working_folder, is_archive, limits, place,
};
use crate::hand_in::HandedInFile;
use crate::language::Text;
use crate::slots::NameFit;
use std::os::unix::fs::FileExt;
use std::path::Path;

/// What one path of the command line is.
pub(super) enum InputPath {
    Folder(TreeFolder),
    File(TreeFile),
}

/// What goes on while everything is read.
pub(super) struct IntakeReader<'a> {
    pub options: &'a IntakeOptions,
    pub budget: Budget,
    pub refused: Vec<Refused>,
    /// How many refusals were too many to be listed.
    pub untold: u64,
}

impl IntakeReader<'_> {
    pub fn input(&mut self, path: &Path, name: &str) -> Option<InputPath> {
        let metadata = match std::fs::metadata(path) {
            Ok(metadata) => metadata,
            Err(error) => {
                self.refuse(name.into(), limits::unreadable(&error));
                return None;
            }
        };
        if metadata.is_dir() {
            return Some(InputPath::Folder(folder::read(path, name, self)));
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

    /// One part of a hand-in, and what it is called.
    pub fn given(&mut self, given: HandInPart) -> (String, Option<InputPath>) {
        match given {
            HandInPart::Path(path) => {
                let name = place::names(std::slice::from_ref(&path)).concat();
                let input = self.input(&path, &name);
                (name, input)
            }
            HandInPart::File { file: HandedInFile { name, bytes }, local } => {
                let shown = local.as_deref().and_then(in_working_folder);
                let shown = shown.map_or_else(|| name.clone(), |path| path.to_string_lossy().into_owned());
                if is_archive(&name, &bytes) {
                    let read = archive::read_bytes(bytes, &name, self).map_err(|reason| self.refuse(name, reason));
                    return (shown, read.ok().map(InputPath::Folder));
                }
                (shown, Some(InputPath::File(TreeFile { local, held: Held::Bytes(bytes) })))
            }
        }
    }

    fn file(&mut self, file: std::fs::File, path: &Path, name: &str) -> Result<InputPath, Text> {
        let limit = self.options.limits.file_bytes;
        let mut start = [0; 4];
        let begins_as_archive = file.read_exact_at(&mut start, 0).is_ok() && archive::is_archive_start(&start);
        let is_shader = NameFit::best(name, &self.options.slots) <= NameFit::Renamed;
        if archive::is_archive(name) || begins_as_archive && !is_shader {
            return archive::read(file, name, self).map(InputPath::Folder);
        }
        let bytes = folder::contents(file, limit).map_err(|error| limits::unreadable(&error))?;
        Ok(InputPath::File(TreeFile { local: Some(path.into()), held: Held::Bytes(bytes) }))
    }

    pub fn refuse(&mut self, path: String, reason: Text) {
        match self.budget.refusals.checked_sub(1) {
            Some(left) => {
                self.budget.refusals = left;
                self.refused.push(Refused { path, reason });
            }
            None => self.untold += 1,
        }
    }

    /// Reads a part of an input, shown as `shown`, within the limits of a part.
    pub fn part<T>(&mut self, shown: &str, read: impl FnOnce(&mut Self) -> T) -> T {
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
