//! A folder of this machine → a tree. No link is followed, and only ordinary files are opened.

use super::reader::IntakeReader;
use super::tree::{self, Held, TreeFolder, TreeNode};
use super::{archive, limits};
use crate::language::Text;
use nix::fcntl::OFlag;
use std::collections::HashMap;
use std::ffi::OsString;
use std::fs::{File, OpenOptions};
use std::io::Read;
use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
use std::path::Path;
use walkdir::{DirEntry, WalkDir};

/// Everything below `root`, which is shown as `shown`.
pub(super) fn read(root: &Path, shown: &str, reading: &mut IntakeReader) -> TreeFolder {
    let mut folder = TreeFolder::default();
    let walk = WalkDir::new(root).min_depth(1).follow_links(false).sort_by_file_name();
    let mut entries = walk.into_iter();
    // How many entries each folder directly below the root has had.
    let mut within: HashMap<OsString, u64> = HashMap::new();
    while let Some(entry) = entries.next() {
        match entry {
            Ok(entry) => {
                let is_folder = entry.file_type().is_dir();
                let first = entry.path().strip_prefix(root).ok().and_then(|below| below.iter().next());
                let count = within.entry(first.unwrap_or_default().to_owned()).or_default();
                *count += 1;
                if *count > reading.options.limits.part.entries {
                    if *count == reading.options.limits.part.entries + 1 {
                        reading.refuse(below(root, shown, entry.path()), limits::too_many());
                    }
                    if is_folder {
                        entries.skip_current_dir();
                    }
                    continue;
                }
                match add(&mut folder, root, shown, &entry, reading) {
                    Descent::On => {}
                    Descent::Over if is_folder => entries.skip_current_dir(),
                    Descent::Over => {}
                    Descent::Out => return folder,
                }
            }
            Err(error) => {
                let path = error.path().map_or_else(|| shown.into(), |path| below(root, shown, path));
                let reason = match error.into_io_error() {
                    Some(error) => limits::unreadable(&error),
                    None => limits::too_deep(&reading.options.limits),
                };
                reading.refuse(path, reason);
            }
        }
    }
    folder
}

/// A path below `root`, which is shown as `shown`, as it is shown.
fn below(root: &Path, shown: &str, path: &Path) -> String {
    let below = path.strip_prefix(root).unwrap_or(Path::new(""));
    std::iter::once(shown.to_owned()).chain(below.iter().map(tree::decoded)).collect::<Vec<_>>().join("/")
}

/// How the walk goes on.
enum Descent {
    On,
    /// Not into this folder.
    Over,
    Out,
}

fn add(folder: &mut TreeFolder, root: &Path, shown: &str, entry: &DirEntry, reading: &mut IntakeReader) -> Descent {
    let name = tree::decoded(entry.file_name());
    if tree::is_litter(&name) || is_beside_another(entry, &name) {
        return Descent::Over;
    }
    let below = entry.path().strip_prefix(root).unwrap_or(entry.path());
    let mut path: Vec<String> = below.iter().map(tree::decoded).collect();
    let full = || format!("{shown}/{}", path.join("/"));
    if !reading.budget.take_entry() {
        reading.refuse(full(), limits::too_many());
        return Descent::Out;
    }
    if path.len() > reading.options.limits.folder_depth {
        reading.refuse(full(), limits::too_deep(&reading.options.limits));
        return Descent::Over;
    }
    let kind = entry.file_type();
    let node = if kind.is_dir() {
        TreeNode::Folder(TreeFolder::default())
    } else if kind.is_file() && archive::is_archive(&name) {
        match open(entry.path())
            .map_err(|error| limits::unreadable(&error))
            .and_then(|file| archive::read(file, &full(), reading))
        {
            Ok(folder) => TreeNode::Folder(folder),
            Err(reason) => {
                reading.refuse(full(), reason.clone());
                TreeNode::File(tree::TreeFile { local: Some(entry.path().into()), held: Held::Refused(reason) })
            }
        }
    } else if kind.is_file() {
        TreeNode::File(tree::TreeFile { local: Some(entry.path().into()), held: Held::OnDisk })
    } else {
        let reason = not_a_file(kind);
        reading.refuse(full(), reason.clone());
        TreeNode::File(tree::TreeFile { local: Some(entry.path().into()), held: Held::Refused(reason) })
    };
    let full = full();
    let last = path.pop().unwrap_or_default();
    let inserted = folder.folder(&path).and_then(|folder| folder.insert(last, node));
    if inserted.is_err() {
        let reason = Text::new(
            "Another file of this folder has the same name, but for the way in which its letters are stored.",
            "同じフォルダに、文字の表し方だけが異なる同じ名前のファイルがあります。",
        );
        reading.refuse(full, reason);
        return Descent::Over;
    }
    Descent::On
}

/// Whether this is what macOS keeps of another file: that stands beside it, or the content says so.
fn is_beside_another(entry: &DirEntry, name: &str) -> bool {
    let Some(other) = tree::beside(name).filter(|_| entry.file_type().is_file()) else { return false };
    entry.path().with_file_name(other).exists()
        || bytes(entry.path(), 4).is_ok_and(|start| tree::is_apple_double(&start))
}

fn not_a_file(kind: std::fs::FileType) -> Text {
    if kind.is_symlink() {
        return Text::new(
            "It is a symbolic link; links are not followed.",
            "シンボリックリンクです。リンクはたどりません。",
        );
    }
    let (en, ja) = if kind.is_fifo() {
        ("a pipe", "パイプ")
    } else if kind.is_socket() {
        ("a socket", "ソケット")
    } else {
        ("a device", "デバイス")
    };
    Text::new(format!("It is {en}, not a file."), format!("ファイルではなく{ja}です。"))
}

/// The first `limit` bytes of an ordinary file. What became a link or a pipe since it was found is not opened.
pub(super) fn bytes(path: &Path, limit: u64) -> std::io::Result<Vec<u8>> {
    contents(open(path)?, limit)
}

fn open(path: &Path) -> std::io::Result<File> {
    let flags = OFlag::O_NOFOLLOW | OFlag::O_NONBLOCK | OFlag::O_CLOEXEC;
    OpenOptions::new().read(true).custom_flags(flags.bits()).open(path)
}

/// The first `limit` bytes of an open file.
pub(super) fn contents(file: File, limit: u64) -> std::io::Result<Vec<u8>> {
    if !file.metadata()?.is_file() {
        return Err(std::io::Error::other("it is not an ordinary file"));
    }
    let mut bytes = Vec::new();
    file.take(limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}
