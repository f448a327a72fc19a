//! When a file of a hand-in, or of an assignment's folder, is saved: once all lie still, whichever way the editor writes it.
//!
//! An editor may write into the file, empty it first, or put another in its place; so what is watched is its folder,
//! and what counts is the file that then stands under the name. Folders that tell nothing, on network drives say, are
//! looked at twice a second.

use crate::command::files;
use crate::hand_in::HandedInFile;
use crate::intake::HandInPart;
use crate::language::Text;
use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{RecursiveMode, Watcher};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::Notify;
use tokio::time::{sleep, timeout};

/// How long the file must lie still to be read. Editors write a few kilobytes within a millisecond or two.
const STILL: Duration = Duration::from_millis(15);
/// How long an empty file, or none, may be the middle of a save.
const MIDDLE: Duration = Duration::from_millis(500);
/// How often the file is looked at without being told to.
const LOOK: Duration = Duration::from_millis(500);

/// What a save left behind.
#[derive(Debug)]
pub(super) enum Save {
    Content(Vec<HandInPart>),
    /// A file went away and did not come back at once.
    Gone,
    Unreadable(Text),
}

/// The saves of the files of one hand-in, or of one assignment.
pub(super) struct Saves {
    /// Files, and folders of files.
    paths: Vec<PathBuf>,
    /// Whether the folders in folders count as well.
    depth: RecursiveMode,
    name: String,
    seen: Option<SavedFiles>,
    changed: Arc<Notify>,
    /// Tells of changes for as long as it is there; `None` where the system cannot.
    _watcher: Option<notify::RecommendedWatcher>,
}

/// What the files were when they were read last.
#[derive(Debug)]
struct SavedFiles {
    stamps: Stamps,
    contents: Vec<Vec<u8>>,
}

/// The files with what changes when one is saved.
type Stamps = Vec<(PathBuf, Option<Stamp>)>;

/// What changes when a file is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stamp {
    modified: (i64, i64),
    size: u64,
    file: (u64, u64),
}

impl Stamp {
    fn of(path: &Path) -> Option<Self> {
        let metadata = std::fs::metadata(path).ok()?;
        Some(Self {
            modified: (metadata.mtime(), metadata.mtime_nsec()),
            size: metadata.size(),
            file: (metadata.dev(), metadata.ino()),
        })
    }
}

impl Saves {
    /// Watches the files, and those in the folders, from now on; the first save is what they are now.
    pub fn of(paths: &[PathBuf]) -> Self {
        Self::at(paths, RecursiveMode::NonRecursive)
    }

    /// The same with everything below a folder.
    pub fn below(folder: &Path) -> Self {
        Self::at(&[folder.to_owned()], RecursiveMode::Recursive)
    }

    fn at(paths: &[PathBuf], depth: RecursiveMode) -> Self {
        let changed = Arc::new(Notify::new());
        let watcher = watcher(paths, depth, &changed);
        Self { paths: paths.into(), depth, name: files::names(paths), seen: None, _watcher: watcher, changed }
    }

    /// The names of the files.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Waits for the next save.
    pub async fn next(&mut self) -> Save {
        loop {
            let stamps = self.stamps();
            if self.seen.as_ref().is_some_and(|seen| seen.stamps == stamps) {
                let was_told = timeout(LOOK, self.changed.notified()).await.is_ok();
                // Two saves within one tick of the file system's clock have the same stamp.
                if !(was_told && self.differs()) && self.seen.as_ref().is_some_and(|seen| seen.stamps == self.stamps())
                {
                    continue;
                }
            }
            let stamps = self.settled().await;
            let (save, contents) = match contents(&stamps) {
                Ok(contents) => (Save::Content(given(&stamps, &contents)), contents),
                Err((_, error)) if error.kind() == std::io::ErrorKind::NotFound => (Save::Gone, Vec::new()),
                Err((path, error)) => (Save::Unreadable(files::unreadable(&path, &error)), Vec::new()),
            };
            self.seen = Some(SavedFiles { stamps, contents });
            return save;
        }
    }

    /// Whether a file was saved again since [`Self::next`] gave the contents.
    pub fn is_outdated(&self) -> bool {
        let stamps = self.stamps();
        is_whole(&stamps) && self.seen.as_ref().is_none_or(|seen| seen.stamps != stamps)
    }

    /// The files as they are now: those that are named, and those in the folders that are.
    fn stamps(&self) -> Stamps {
        let files =
            self.paths.iter().flat_map(|path| in_folder(path, self.depth).unwrap_or_else(|| vec![path.clone()]));
        files.map(|path| (path.clone(), Stamp::of(&path))).collect()
    }

    fn differs(&self) -> bool {
        let seen = self.seen.as_ref().map(|seen| &seen.contents);
        contents(&self.stamps()).is_ok_and(|contents| Some(&contents) != seen)
    }

    /// Waits until the files lie still.
    async fn settled(&self) -> Stamps {
        let began = Instant::now();
        let mut stamps = self.stamps();
        loop {
            sleep(STILL).await;
            let now = self.stamps();
            if now == stamps && (is_whole(&now) || began.elapsed() > MIDDLE) {
                return now;
            }
            stamps = now;
        }
    }
}

/// The files in a folder, in a stable order; `None` for what is no folder.
fn in_folder(folder: &Path, depth: RecursiveMode) -> Option<Vec<PathBuf>> {
    // Editors keep files of their own beside those that they write.
    let is_own = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        !name.starts_with('.') && !name.ends_with('~')
    };
    let entries = std::fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path());
    let mut files = Vec::new();
    for path in entries.filter(is_own) {
        if path.is_file() {
            files.push(path);
        } else if depth == RecursiveMode::Recursive && !path.is_symlink() {
            files.extend(in_folder(&path, depth).unwrap_or_default());
        }
    }
    files.sort();
    Some(files)
}

/// Whether every file is there, and not just emptied by an editor that goes on to fill it.
fn is_whole(stamps: &Stamps) -> bool {
    stamps.iter().all(|(_, stamp)| stamp.is_some_and(|stamp| stamp.size > 0))
}

fn contents(stamps: &Stamps) -> Result<Vec<Vec<u8>>, (PathBuf, std::io::Error)> {
    let read = |path: &PathBuf| files::read(path).map(|(bytes, _)| bytes).map_err(|error| (path.clone(), error));
    stamps.iter().map(|(path, _)| read(path)).collect()
}

fn given(stamps: &Stamps, contents: &[Vec<u8>]) -> Vec<HandInPart> {
    let files = stamps.iter().zip(contents).map(|((path, _), bytes)| HandInPart::File {
        file: HandedInFile::new(files::names(std::slice::from_ref(path)), bytes.as_slice()),
        local: Some(path.clone()),
    });
    files.collect()
}

/// Watches the folder of each file, and where the file is a link, that of what it points to.
fn watcher(paths: &[PathBuf], depth: RecursiveMode, changed: &Arc<Notify>) -> Option<notify::RecommendedWatcher> {
    let (folders, files): (Vec<_>, Vec<_>) = paths.iter().partition(|path| path.is_dir());
    let places = |path: &PathBuf| [std::path::absolute(path).ok(), std::fs::canonicalize(path).ok()];
    let files: Vec<PathBuf> = files.into_iter().flat_map(places).flatten().collect();
    let in_folders = !folders.is_empty();
    let names: Vec<_> = files.iter().filter_map(|file| file.file_name().map(ToOwned::to_owned)).collect();
    let changed = Arc::clone(changed);
    let told = move |event: notify::Result<notify::Event>| {
        let is_ours = event.as_ref().map_or(true, |event| {
            let is_read = matches!(event.kind, EventKind::Access(kind) if kind != AccessKind::Close(AccessMode::Write));
            let names = |path: &PathBuf| path.file_name().is_none_or(|name| names.iter().any(|n| n == name));
            !is_read && (in_folders || event.paths.is_empty() || event.paths.iter().any(names))
        });
        if is_ours {
            changed.notify_one();
        }
    };
    let mut watcher = notify::recommended_watcher(told).ok()?;
    for file in &files {
        // What cannot be watched is looked at.
        let _ = file.parent().map(|folder| watcher.watch(folder, RecursiveMode::NonRecursive));
    }
    for folder in folders {
        let _ = watcher.watch(folder, depth);
    }
    Some(watcher)
}

/// The file went away.
pub(super) fn gone(name: &str) -> Text {
    Text::new(
        format!("{name} is gone. It is graded when it comes back."),
        format!("{name} がなくなりました。再び現れたら採点します。"),
    )
}
