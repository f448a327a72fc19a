//! A ZIP → a tree. Members are unpacked one by one into memory, only those that may be shaders or archives, and never
//! further than the limits.

mod directory;
mod flaws;
mod member;
mod name;
mod record;
mod storage;

use super::limits::{IntakeLimits, spent, too_deep, too_many};
use super::moodle;
use super::reader::IntakeReader;
use super::tree::{self, Held, TreeFolder, TreeNode};
use crate::language::Text;
use crate::slots::NameFit;
use record::ArchiveRecord;
use std::collections::HashSet;
use std::fs::File;
use std::io;
use storage::ArchiveStorage;

/// Whether a file of this name is opened as an archive.
pub(super) fn is_archive(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("zip"))
}

/// Whether a file that begins so is an archive, whatever its name.
pub(super) fn is_archive_start(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// Everything in the archive `file`, which is shown as `shown`; or why it cannot be opened.
pub(super) fn read(file: File, shown: &str, reading: &mut IntakeReader) -> Result<TreeFolder, Text> {
    let unreadable = |error: io::Error| super::limits::unreadable(&error);
    unpacked(ArchiveStorage::file(file).map_err(unreadable)?, shown, 1, reading)
}

/// The same of an archive that was read already.
pub(super) fn read_bytes(bytes: Vec<u8>, shown: &str, reading: &mut IntakeReader) -> Result<TreeFolder, Text> {
    unpacked(ArchiveStorage::Memory(bytes), shown, 1, reading)
}

fn unpacked(storage: ArchiveStorage, shown: &str, depth: u32, reading: &mut IntakeReader) -> Result<TreeFolder, Text> {
    let directory = directory::read(&storage, reading.budget.entries.saturating_add(1)).ok_or_else(no_archive)?;
    if directory.is_recovered {
        reading.refuse(shown.into(), cut_off(directory.records.len()));
    }
    if directory.damaged > 0 {
        reading.refuse(shown.into(), damaged(directory.damaged));
    }
    let flaws = flaws::find(&directory.records);
    let names = directory.records.iter().filter_map(|record| name::path(&record.name).ok()).collect();
    let (folder, nested, astray) = (TreeFolder::default(), Vec::new(), Vec::new());
    let mut unpacking = Unpacking { storage, shown, depth, folder, names, nested, astray, reading };
    for (record, flaw) in directory.records.iter().zip(flaws) {
        if !unpacking.reading.budget.take_entry() {
            unpacking.refuse(&record.name, &too_many());
            break;
        }
        unpacking.add(record, flaw);
    }
    Ok(unpacking.finish())
}

/// One archive on its way into a tree.
struct Unpacking<'a, 'b> {
    storage: ArchiveStorage,
    shown: &'a str,
    depth: u32,
    folder: TreeFolder,
    /// Where its members stand.
    names: HashSet<Vec<String>>,
    /// The archives in it, each with its path. They come last, so that none uses up what the files beside it need.
    nested: Vec<(Vec<String>, ArchiveRecord)>,
    /// Members with names that lead elsewhere, and why they are refused.
    astray: Vec<(String, Text)>,
    reading: &'a mut IntakeReader<'b>,
}

impl Unpacking<'_, '_> {
    fn limits(&self) -> IntakeLimits {
        self.reading.options.limits
    }

    fn refuse(&mut self, name: &str, reason: &Text) {
        self.reading.refuse(format!("{}/{name}", self.shown), reason.clone());
    }

    fn add(&mut self, record: &ArchiveRecord, flaw: Option<Text>) {
        let mut path = match name::path(&record.name) {
            Ok(path) => path,
            Err(reason) => return self.goes_astray(&record.name, reason),
        };
        if path.iter().any(|part| tree::is_litter(part)) || self.is_beside_another(record, &path) {
            return;
        }
        if path.len() > self.limits().folder_depth {
            return self.goes_astray(&record.name, too_deep(&self.limits()));
        }
        if record.is_folder() {
            // Where a file has its name, the file has been or will be named.
            let _ = self.folder.folder(&path);
            return;
        }
        let whole = path.clone();
        let Some(last) = path.pop() else { return };
        let is_archive = is_archive(&last) && flaw.is_none();
        let held = match flaw {
            Some(reason) => Err(reason),
            None if is_archive => Ok(Held::Refused(too_many())),
            None if NameFit::best(&last, &self.reading.options.slots) == NameFit::Other => Ok(Held::Unread),
            None => self.unpack(record, self.limits().file_bytes, true).map(Held::Bytes),
        };
        let is_refused = held.is_err();
        let held = held.unwrap_or_else(|reason| {
            self.refuse(&record.name, &reason);
            Held::Refused(reason)
        });
        let node = TreeNode::File(tree::TreeFile { local: None, held });
        let inserted = self.folder.folder(&path).and_then(|folder| folder.insert(last, node));
        match inserted {
            Ok(()) if is_archive => self.nested.push((whole, record.clone())),
            Err(_) if !is_refused => self.refuse(&record.name, &flaws::taken()),
            _ => {}
        }
    }

    /// Whether this is what macOS keeps of another file: that stands beside it, or the content says so.
    fn is_beside_another(&mut self, record: &ArchiveRecord, path: &[String]) -> bool {
        let Some((last, folders)) = path.split_last().filter(|_| !record.is_folder()) else { return false };
        let Some(other) = tree::beside(last) else { return false };
        let other: Vec<String> = folders.iter().cloned().chain([other.to_owned()]).collect();
        self.names.contains(&other) || self.unpack(record, 4, true).is_ok_and(|start| tree::is_apple_double(&start))
    }

    fn open_nested(&mut self) {
        for (mut path, record) in std::mem::take(&mut self.nested) {
            let node = self.open(&record).map_or_else(
                |reason| {
                    self.refuse(&record.name, &reason);
                    TreeNode::File(tree::TreeFile { local: None, held: Held::Refused(reason) })
                },
                TreeNode::Folder,
            );
            if let (Some(last), Ok(folder)) = (path.pop(), self.folder.folder(&path)) {
                folder.replace(&last, node);
            }
        }
    }

    fn open(&mut self, record: &ArchiveRecord) -> Result<TreeFolder, Text> {
        let limits = self.limits();
        if self.depth >= limits.archive_depth {
            return Err(nested_too_deep(&limits));
        }
        let storage = ArchiveStorage::Memory(self.unpack(record, limits.archive_bytes, false)?);
        let shown = format!("{}/{}", self.shown, record.name);
        let depth = self.depth + 1;
        if self.depth > 1 {
            return unpacked(storage, &shown, depth, self.reading);
        }
        self.reading.part(&shown, |reading| unpacked(storage, &shown, depth, reading))
    }

    fn unpack(&mut self, record: &ArchiveRecord, limit: u64, is_cut_at_limit: bool) -> Result<Vec<u8>, Text> {
        // What turns out to be damaged has cost its time all the same.
        let cost = record.size.min(limit);
        let Some(left) = self.reading.budget.bytes.checked_sub(cost) else { return Err(spent()) };
        self.reading.budget.bytes = left;
        member::unpack(&self.storage, record, &self.limits(), limit, is_cut_at_limit)
    }

    /// Refuses a member that cannot stand where its name says. Its student is kept in mind, so that they get an answer.
    fn goes_astray(&mut self, name: &str, reason: Text) {
        self.refuse(name, &reason);
        let first = name.split(['/', '\\']).next().unwrap_or_default();
        if moodle::folder(first).is_some() {
            self.answer(name, reason);
        } else {
            self.astray.push((name.into(), reason));
        }
    }

    /// Puts a refused file into the folder with which its name begins.
    fn answer(&mut self, name: &str, reason: Text) {
        let Some((first, rest)) = name.split_once(['/', '\\']) else { return };
        let node = TreeNode::File(tree::TreeFile { local: None, held: Held::Refused(reason) });
        let _ = self.folder.folder(&[first.into()]).and_then(|folder| folder.insert(rest.into(), node));
    }

    fn finish(mut self) -> TreeFolder {
        self.open_nested();
        for (name, reason) in std::mem::take(&mut self.astray) {
            let first = name.split(['/', '\\']).next().unwrap_or_default();
            if self.folder.children().any(|(name, node)| name == first && matches!(node, TreeNode::Folder(_))) {
                self.answer(&name, reason);
            }
        }
        self.folder
    }
}

fn no_archive() -> Text {
    Text::new(
        "It is not a ZIP archive, or too damaged to be read as one.",
        "ZIP ファイルではないか、壊れているため読み込めません。",
    )
}

fn cut_off(found: usize) -> Text {
    Text::new(
        format!(
            "The end of the archive is missing: {found} members were found without its directory, what came behind them is lost. Download it again."
        ),
        format!(
            "アーカイブの末尾が欠けています。目録なしで見つかったファイルは {found} 個です。それより後は失われているので、もう一度ダウンロードしてください。"
        ),
    )
}

fn damaged(count: usize) -> Text {
    Text::new(
        format!("Its directory is damaged in {count} places; the members named there are lost."),
        format!("目録が {count} か所壊れています。そこに書かれたファイルは失われています。"),
    )
}

fn nested_too_deep(limits: &IntakeLimits) -> Text {
    let most = limits.archive_depth;
    Text::new(
        format!("It is an archive in an archive, more than {most} deep."),
        format!("アーカイブが {most} 段を超えて重なっています。"),
    )
}
