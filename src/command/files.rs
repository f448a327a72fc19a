//! The files of one hand-in, as the command line names them.

use crate::hand_in::{HandIn, HandedInFile};
use crate::intake::{self, FileLocation, HandInContent, HandInPart, in_working_folder};
use crate::language::Text;
use reference::Assignment;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Longest file that is read: one over the source stage's limit is refused there, by its own message.
const MAX_READ: u64 = 1 << 20;

/// Standard input as a path.
const STANDARD_INPUT: &str = "-";

/// Why there is nothing to grade.
#[derive(Debug)]
pub(super) enum NotTaken {
    /// A file cannot be read.
    Unreadable(PathBuf, std::io::Error),
    /// What is missing or double.
    Unfit(Text),
}

impl NotTaken {
    /// What is said of it.
    pub fn message(&self) -> Text {
        match self {
            Self::Unreadable(path, error) => unreadable(path, error),
            Self::Unfit(why) => why.clone(),
        }
    }
}

/// The files that the assignment asks for, and where each was: standard input is nowhere.
pub(super) fn taken(paths: &[PathBuf], assignment: &Assignment) -> Result<(HandIn, Vec<FileLocation>), NotTaken> {
    let given = paths.iter().map(|path| given(path).map_err(|error| NotTaken::Unreadable(path.clone(), error)));
    let given: Vec<HandInPart> = given.collect::<Result<_, _>>()?;
    match intake::one(given, &intake::IntakeOptions::new(assignment)) {
        HandInContent::Files { hand_in, places } => {
            let is_somewhere = !paths.iter().any(|path| is_standard_input(path));
            Ok((hand_in, if is_somewhere { places } else { Vec::new() }))
        }
        HandInContent::Nothing(why) => Err(NotTaken::Unfit(why)),
    }
}

fn given(path: &Path) -> std::io::Result<HandInPart> {
    if !is_standard_input(path) && path.is_dir() {
        return Ok(HandInPart::Path(path.into()));
    }
    let (bytes, is_cut) = read(path)?;
    // An archive may be larger than a file.
    if is_cut && bytes.starts_with(b"PK") && path.is_file() {
        return Ok(HandInPart::Path(path.into()));
    }
    let local = (!is_standard_input(path)).then(|| path.to_owned());
    Ok(HandInPart::File { file: HandedInFile::new(name(path), bytes), local })
}

/// The bytes of the file, as far as they matter, and whether there may be more.
pub(super) fn read(path: &Path) -> std::io::Result<(Vec<u8>, bool)> {
    let mut bytes = Vec::new();
    if is_standard_input(path) {
        std::io::stdin().lock().take(MAX_READ).read_to_end(&mut bytes)?;
    } else {
        std::fs::File::open(path)?.take(MAX_READ).read_to_end(&mut bytes)?;
    }
    let is_cut = bytes.len() as u64 == MAX_READ;
    Ok((bytes, is_cut))
}

/// Where the files would be, whether they are there or not.
pub(super) fn places(paths: &[PathBuf]) -> Vec<FileLocation> {
    let place = |path: &PathBuf| {
        let local = in_working_folder(path);
        let shown = local.as_ref().map(|path| path.to_string_lossy().into_owned());
        FileLocation { path: shown.unwrap_or_else(|| name(path)), local }
    };
    paths.iter().filter(|path| !is_standard_input(path)).map(place).collect()
}

fn is_standard_input(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// What is said of a file that cannot be read.
pub(super) fn unreadable(path: &Path, error: &std::io::Error) -> Text {
    Text::new(
        format!("cannot read {}: {error}", path.display()),
        format!("{} を読み込めません: {error}", path.display()),
    )
}

/// The file's own name, without its folder.
fn name(path: &Path) -> String {
    if is_standard_input(path) {
        return "standard input".into();
    }
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The names of all, in one line.
pub(super) fn names(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| name(path)).collect::<Vec<_>>().join(", ")
}
