//! The folder on disk in which packed pictures are kept, by the digest of their assignment.
//!
//! It is a convenience: where it cannot be written, or a file in it is damaged or of another version, the pictures are
//! computed again.

use super::Pack;
use crate::hand_in::hexadecimal;
use reference::Assignment;
use sha2::{Digest, Sha256};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// First word of every file; a change of the format changes it.
const FORMAT: &str = "ggrade-frames/1";

/// The most that all files may take together, in bytes; the oldest go first.
const ROOM: u64 = 256 << 20;

/// The longest file that is read.
const LONGEST: u64 = 128 << 20;

/// The folder that the environment names: `GGRADE_CACHE` (empty: none), or `ggrade` in the user's cache folder.
pub fn folder() -> Option<PathBuf> {
    folder_in(|name| std::env::var_os(name))
}

fn folder_in(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    if let Some(folder) = variable("GGRADE_CACHE") {
        return (!folder.is_empty()).then(|| folder.into());
    }
    // The XDG rules: a path that is not absolute does not count.
    let absolute = |name| variable(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let user = absolute("XDG_CACHE_HOME").or_else(|| Some(absolute("HOME")?.join(".cache")))?;
    Some(user.join("ggrade"))
}

/// The pictures of an assignment, where they are kept and whole.
pub fn read(folder: &Path, assignment: &Assignment) -> Option<Pack> {
    let mut bytes = Vec::new();
    File::open(folder.join(name(assignment))).ok()?.take(LONGEST).read_to_end(&mut bytes).ok()?;
    let pack = Pack::of_bytes(bytes.strip_prefix(head(assignment, checked_part(&bytes)?).as_bytes())?);
    let is_whole = pack.frames(assignment).all(|frame| frame.is_ok());
    is_whole.then_some(pack)
}

/// Keeps the pictures of an assignment. The file appears whole or not at all.
pub fn write(folder: &Path, assignment: &Assignment, pack: &Pack) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    io::Write::write_all(&mut file, head(assignment, pack.bytes()).as_bytes())?;
    io::Write::write_all(&mut file, pack.bytes())?;
    file.persist(folder.join(name(assignment))).map_err(|error| error.error)?;
    make_room(folder, ROOM)
}

/// The name of its file: of another version of the folder, or computed by another version of ggrade, it is another file.
fn name(assignment: &Assignment) -> String {
    format!("{}-{}.frames", assignment.digest, reference::ENGINE)
}

/// What stands before the pictures.
fn head(assignment: &Assignment, pack: &[u8]) -> String {
    let sum = hexadecimal(&Sha256::digest(pack));
    format!("{FORMAT} {} {} {sum}\n", reference::ENGINE, assignment.digest)
}

/// What follows the first line.
fn checked_part(bytes: &[u8]) -> Option<&[u8]> {
    let end = bytes.iter().position(|byte| *byte == b'\n')?;
    bytes.get(end + 1..)
}

/// Removes the oldest files until the others take no more than `room`.
fn make_room(folder: &Path, room: u64) -> io::Result<()> {
    let mut files: Vec<(SystemTime, u64, PathBuf)> = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        if path.extension().is_some_and(|extension| extension == "frames") {
            let metadata = entry.metadata()?;
            files.push((metadata.modified()?, metadata.len(), path));
        }
    }
    files.sort();
    let mut taken = 0;
    for (_, bytes, path) in files.into_iter().rev() {
        taken += bytes;
        if taken > room {
            fs::remove_file(path)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::Packer;
    use super::*;

    #[test]
    fn the_environment_names_the_folder() {
        let folder = |set: &[(&str, &str)]| {
            folder_in(|name| set.iter().find(|(known, _)| *known == name).map(|(_, value)| value.into()))
        };
        assert_eq!(folder(&[("GGRADE_CACHE", "here"), ("HOME", "/h")]), Some("here".into()));
        assert_eq!(folder(&[("GGRADE_CACHE", ""), ("HOME", "/h")]), None);
        assert_eq!(folder(&[("XDG_CACHE_HOME", "/c"), ("HOME", "/h")]), Some("/c/ggrade".into()));
        assert_eq!(folder(&[("XDG_CACHE_HOME", "c"), ("HOME", "/h")]), Some("/h/.cache/ggrade".into()));
        assert_eq!(folder(&[]), None);
    }

    #[test]
    fn what_is_kept_comes_back_and_what_is_damaged_does_not() {
        let assignment = reference::assignment("ggsample06").expect("built in");
        let mut packer = Packer::default();
        super::super::frames(assignment).for_each(|frame| packer.add(&frame).expect("in memory"));
        let pack = packer.finish().expect("in memory");
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path().join("made when it is missing");
        assert_eq!(read(&folder, assignment), None);
        write(&folder, assignment, &pack).expect("written");
        assert_eq!(read(&folder, assignment), Some(pack.clone()));
        let path = folder.join(name(assignment));
        let whole = fs::read(&path).expect("a file");
        for at in [0, 20, 60, 100, 200, whole.len() / 2, whole.len() - 1] {
            let mut bytes = whole.clone();
            bytes[at] ^= 1;
            fs::write(&path, &bytes).expect("written");
            assert_eq!(read(&folder, assignment), None, "byte {at}");
            fs::write(&path, &whole[..at]).expect("written");
            assert_eq!(read(&folder, assignment), None, "{at} bytes");
        }
        // What is damaged is written anew.
        write(&folder, assignment, &pack).expect("written");
        assert_eq!(read(&folder, assignment), Some(pack));
    }

    #[test]
    fn the_oldest_files_make_room() {
        let folder = tempfile::tempdir().expect("a folder");
        let day = std::time::Duration::from_secs(86_400);
        for (name, days) in [("old.frames", 30), ("new.frames", 0), ("middle.frames", 10), ("foreign.txt", 90)] {
            let file = File::create(folder.path().join(name)).expect("a file");
            file.set_len(100).expect("its length");
            file.set_modified(SystemTime::now() - days * day).expect("its time");
        }
        make_room(folder.path(), 250).expect("room");
        let mut left: Vec<_> =
            fs::read_dir(folder.path()).expect("a folder").map(|e| e.expect("one").file_name()).collect();
        left.sort();
        assert_eq!(left, ["foreign.txt", "middle.frames", "new.frames"]);
    }
}
