//! When a file is saved: once it lies still, whichever way the editor writes it.
//!
//! An editor may write into the file, empty it first, or put another in its place; so what is watched is its folder,
//! and what counts is the file that then stands under the name. Folders that tell nothing, on network drives say, are
//! looked at twice a second.

use crate::command::grade::{MAX_READ, unreadable};
use crate::language::Text;
use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{RecursiveMode, Watcher};
use std::io::Read;
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
    Content(Vec<u8>),
    /// The file went away and did not come back at once.
    Gone,
    Unreadable(Text),
}

/// The saves of one file.
pub(super) struct Saves {
    path: PathBuf,
    name: String,
    seen: Option<Seen>,
    changed: Arc<Notify>,
    /// Tells of changes for as long as it is there; none where the system cannot.
    _watcher: Option<notify::RecommendedWatcher>,
}

/// What the file was when it was read last.
#[derive(Debug)]
struct Seen {
    stamp: Option<Stamp>,
    bytes: Vec<u8>,
}

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
    /// Watches the file from now on; the first save is what it is now.
    pub fn of(path: &Path) -> Self {
        let changed = Arc::new(Notify::new());
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        Self { path: path.into(), name, seen: None, _watcher: watcher(path, &changed), changed }
    }

    /// The file's own name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Waits for the next save.
    pub async fn next(&mut self) -> Save {
        loop {
            let stamp = Stamp::of(&self.path);
            if self.seen.as_ref().is_some_and(|seen| seen.stamp == stamp) {
                let was_told = timeout(LOOK, self.changed.notified()).await.is_ok();
                // Two saves within one tick of the file system's clock have the same stamp.
                if !(was_told && self.differs()) && self.seen.as_ref().is_some_and(|s| s.stamp == Stamp::of(&self.path))
                {
                    continue;
                }
            }
            let stamp = self.settled().await;
            let (save, bytes) = match read(&self.path) {
                Ok(bytes) => (Save::Content(bytes.clone()), bytes),
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => (Save::Gone, Vec::new()),
                Err(error) => (Save::Unreadable(unreadable(&self.path, &error)), Vec::new()),
            };
            self.seen = Some(Seen { stamp, bytes });
            return save;
        }
    }

    /// Whether the file was saved again since [`Self::next`] gave its content.
    pub fn is_outdated(&self) -> bool {
        let stamp = Stamp::of(&self.path);
        stamp.is_some_and(|stamp| stamp.size > 0) && self.seen.as_ref().is_none_or(|seen| seen.stamp != stamp)
    }

    fn differs(&self) -> bool {
        let seen = self.seen.as_ref().map(|seen| &seen.bytes);
        read(&self.path).is_ok_and(|bytes| Some(&bytes) != seen)
    }

    /// Waits until the file lies still.
    async fn settled(&self) -> Option<Stamp> {
        let began = Instant::now();
        let mut stamp = Stamp::of(&self.path);
        loop {
            sleep(STILL).await;
            let now = Stamp::of(&self.path);
            let is_whole = now.is_some_and(|now| now.size > 0) || began.elapsed() > MIDDLE;
            if now == stamp && is_whole {
                return now;
            }
            stamp = now;
        }
    }
}

/// Watches the folder of the file, and where the file is a link, that of what it points to.
fn watcher(path: &Path, changed: &Arc<Notify>) -> Option<notify::RecommendedWatcher> {
    let target = std::fs::canonicalize(path).ok();
    let files: Vec<PathBuf> = [std::path::absolute(path).ok(), target].into_iter().flatten().collect();
    let names: Vec<_> = files.iter().filter_map(|file| file.file_name().map(ToOwned::to_owned)).collect();
    let changed = Arc::clone(changed);
    let told = move |event: notify::Result<notify::Event>| {
        let is_ours = event.as_ref().map_or(true, |event| {
            let is_read = matches!(event.kind, EventKind::Access(kind) if kind != AccessKind::Close(AccessMode::Write));
            let names = |path: &PathBuf| path.file_name().is_none_or(|name| names.iter().any(|n| n == name));
            !is_read && (event.paths.is_empty() || event.paths.iter().any(names))
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
    Some(watcher)
}

fn read(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    std::fs::File::open(path)?.take(MAX_READ).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The file went away.
pub(super) fn gone(name: &str) -> Text {
    Text::new(
        format!("{name} is gone. It is graded when it comes back."),
        format!("{name} がなくなりました。再び現れたら採点します。"),
    )
}
