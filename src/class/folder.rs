//! The folder that a class is graded into. Every file in it is whole or not there, and one run at a time writes.

use crate::fault::Fault;
use crate::language::Text;
use std::fs::{self, File, Permissions, TryLockError};
use std::io::{self, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// What the names of files begin with that are not finished. A run that was killed leaves some behind.
const UNFINISHED: &str = ".ggrade-";

/// An output folder, held against other runs for as long as this lives.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
    _lock: File,
}

/// Where the portrait and the page of a student are, in the output folder.
pub fn portrait_file(key: &str) -> String {
    format!("students/{key}.png")
}

/// See [`portrait_file`].
pub fn page_file(key: &str) -> String {
    format!("students/{key}.html")
}

/// Why a folder cannot be used.
#[derive(Debug)]
pub enum NotOpened {
    /// Another run is writing into it.
    InUse,
    /// It cannot be made or written to.
    Fault(Fault),
}

impl OutputFolder {
    /// Opens a folder, which is made where it is not there.
    pub fn open(path: &Path) -> Result<Self, NotOpened> {
        let failed = |error: io::Error| NotOpened::Fault(unwritable(path, &error));
        fs::create_dir_all(path).map_err(failed)?;
        let lock = File::open(path).map_err(failed)?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(NotOpened::InUse),
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        let folder = Self { path: path.into(), _lock: lock };
        folder.tidy(path);
        Ok(folder)
    }

    /// The file or folder `name` in it; `/` stands between folders.
    pub fn at(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file, all of it or nothing; the folders on the way are made.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, Fault> {
        self.write_as(name, bytes, 0o666)
    }

    /// The same for nobody else's eyes.
    pub fn write_private(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, Fault> {
        self.write_as(name, bytes, 0o600)
    }

    fn write_as(&self, name: &str, bytes: &[u8], mode: u32) -> Result<PathBuf, Fault> {
        let path = self.at(name);
        replace(&path, bytes, mode).map_err(|error| unwritable(&path, &error))?;
        Ok(path)
    }

    /// Writes a file bit by bit, all of it or nothing.
    pub fn write_by<T>(&self, name: &str, write: impl FnOnce(&mut File) -> Result<T, Fault>) -> Result<T, Fault> {
        let path = self.at(name);
        let mut file = unfinished(&path, 0o666).map_err(|error| unwritable(&path, &error))?;
        let result = write(file.as_file_mut())?;
        file.persist(&path).map_err(|error| unwritable(&path, &error.error))?;
        Ok(result)
    }

    /// The bytes of a file; `None` where it is not there.
    pub fn read(&self, name: &str) -> Result<Option<Vec<u8>>, Fault> {
        match fs::read(self.at(name)) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(unreadable(&self.at(name), &error)),
        }
    }

    /// Whether the file is there and has something in it.
    pub fn has(&self, name: &str) -> bool {
        fs::metadata(self.at(name)).is_ok_and(|metadata| metadata.is_file() && metadata.len() > 0)
    }

    /// Takes a file away, where it is there.
    pub fn remove(&self, name: &str) -> Result<(), Fault> {
        match fs::remove_file(self.at(name)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(unwritable(&self.at(name), &error)),
            _ => Ok(()),
        }
    }

    /// Takes away what a killed run left unfinished, in the folder and the folders in it.
    fn tidy(&self, path: &Path) {
        for entry in fs::read_dir(path).into_iter().flatten().flatten() {
            let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
            if is_folder && path == self.path {
                self.tidy(&entry.path());
            } else if !is_folder && entry.file_name().to_string_lossy().starts_with(UNFINISHED) {
                let _ = fs::remove_file(entry.path());
            }
        }
    }
}

/// Puts a file with this content in place of what is at `path`, in one step.
fn replace(path: &Path, bytes: &[u8], mode: u32) -> io::Result<()> {
    let mut file = unfinished(path, mode)?;
    file.write_all(bytes)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// A file beside `path` that is to take its place; the folders on the way are made.
fn unfinished(path: &Path, mode: u32) -> io::Result<NamedTempFile> {
    let parent = path.parent().unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(UNFINISHED).permissions(Permissions::from_mode(mode));
    match builder.tempfile_in(parent) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            fs::create_dir_all(parent)?;
            builder.tempfile_in(parent)
        }
        file => file,
    }
}

/// The fault of a file or folder that cannot be written.
pub fn unwritable(path: &Path, error: &io::Error) -> Fault {
    let path = path.display();
    Fault::new(Text::new(format!("cannot write {path}: {error}"), format!("{path} に書き込めません: {error}"))).remedy(
        Text::new(
            "Name a folder that you may write to with --out, on a disk with room. What is graded already is kept: \
             --resume goes on.",
            "--out に、書き込みができて空き容量のあるフォルダを指定してください。採点が済んだ分は残っています。\
             --resume を付けると続きから採点します。",
        ),
    )
}

/// The fault of a file that cannot be read.
pub fn unreadable(path: &Path, error: &io::Error) -> Fault {
    let path = path.display();
    Fault::new(Text::new(format!("cannot read {path}: {error}"), format!("{path} を読み込めません: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_one_run_at_a_time() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("new/class");
        let first = OutputFolder::open(&path).unwrap();
        assert!(matches!(OutputFolder::open(&path), Err(NotOpened::InUse)));
        drop(first);
        OutputFolder::open(&path).unwrap();
    }

    #[test]
    fn what_was_left_unfinished_is_taken_away() {
        let place = tempfile::tempdir().unwrap();
        for name in [".ggrade-abc", "students/.ggrade-x1", "students/tanaka.html", "mine.txt"] {
            let path = place.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "x").unwrap();
        }
        let folder = OutputFolder::open(place.path()).unwrap();
        assert!(!folder.has(".ggrade-abc") && !folder.has("students/.ggrade-x1"));
        assert!(folder.has("students/tanaka.html") && folder.has("mine.txt"));
    }

    #[test]
    fn a_file_is_replaced_with_the_permissions_asked_for() {
        let place = tempfile::tempdir().unwrap();
        let folder = OutputFolder::open(place.path()).unwrap();
        folder.write("a/b.txt", b"one").unwrap();
        folder.write("a/b.txt", b"two").unwrap();
        assert_eq!(folder.read("a/b.txt").unwrap().unwrap(), b"two");
        let mode = |name| fs::metadata(folder.at(name)).unwrap().permissions().mode() & 0o777;
        fs::write(folder.at("a/plain.txt"), "as the umask has it").unwrap();
        assert_eq!(mode("a/b.txt"), mode("a/plain.txt"));
        folder.write_private("key", b"secret").unwrap();
        assert_eq!(mode("key"), 0o600);
        assert_eq!(folder.read("missing").unwrap(), None);
        folder.remove("key").unwrap();
        folder.remove("key").unwrap();
        assert_eq!(fs::read_dir(place.path().join("a")).unwrap().count(), 2, "nothing unfinished is left");
    }
}
