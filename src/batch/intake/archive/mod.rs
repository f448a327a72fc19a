//! A ZIP → a tree. Members are unpacked one by one into memory, only those that may be shaders or archives, and never
//! further than the limits.

mod directory;
mod flaws;
mod member;
mod name;
mod record;
mod storage;

use super::choose::{Fit, fit};
use super::limits::{Limits, too_deep, too_many};
use super::tree::{self, Folder, Held, Node};
use super::{Reading, moodle};
use crate::language::Text;
use record::Record;
use std::fs::File;
use std::io;
use storage::Storage;

/// Whether a file of this name is opened as an archive.
pub(super) fn is_archive(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("zip"))
}

/// Whether a file that begins so is an archive, whatever its name.
pub(super) fn is_archive_start(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// Everything in the archive `file`, which is shown as `shown`; or why it cannot be opened.
pub(super) fn read(file: File, shown: &str, reading: &mut Reading) -> Result<Folder, Text> {
    let unreadable = |error: io::Error| super::limits::unreadable(&error);
    unpacked(Storage::file(file).map_err(unreadable)?, shown, 1, reading)
}

fn unpacked(storage: Storage, shown: &str, depth: u32, reading: &mut Reading) -> Result<Folder, Text> {
    let directory = directory::read(&storage, reading.budget.entries.saturating_add(1)).ok_or_else(no_archive)?;
    if directory.is_recovered {
        reading.refuse(shown.into(), cut_off(directory.records.len()));
    }
    if directory.damaged > 0 {
        reading.refuse(shown.into(), damaged(directory.damaged));
    }
    let flaws = flaws::find(&directory.records);
    let mut unpacking = Unpacking { storage, shown, depth, folder: Folder::default(), astray: Vec::new(), reading };
    for (record, flaw) in directory.records.iter().zip(flaws) {
        if !unpacking.reading.budget.take_entry() {
            let reason = too_many(&unpacking.limits());
            unpacking.refuse(&record.name, &reason);
            break;
        }
        unpacking.add(record, flaw);
    }
    Ok(unpacking.finish())
}

/// One archive on its way into a tree.
struct Unpacking<'a, 'b> {
    storage: Storage,
    shown: &'a str,
    depth: u32,
    folder: Folder,
    /// Members with names that lead elsewhere, and why they are refused.
    astray: Vec<(String, Text)>,
    reading: &'a mut Reading<'b>,
}

impl Unpacking<'_, '_> {
    fn limits(&self) -> Limits {
        self.reading.options.limits
    }

    fn refuse(&mut self, name: &str, reason: &Text) {
        self.reading.refuse(format!("{}/{name}", self.shown), reason.clone());
    }

    fn add(&mut self, record: &Record, flaw: Option<Text>) {
        let mut path = match name::path(&record.name) {
            Ok(path) => path,
            Err(reason) => {
                self.refuse(&record.name, &reason);
                self.astray.push((record.name.clone(), reason));
                return;
            }
        };
        if path.iter().any(|part| tree::is_litter(part)) {
            return;
        }
        if path.len() > self.limits().folder_depth {
            let reason = too_deep(&self.limits());
            return self.refuse(&record.name, &reason);
        }
        if record.is_folder() {
            // Where a file has its name, the file has been or will be named.
            let _ = self.folder.folder(&path);
            return;
        }
        let Some(last) = path.pop() else { return };
        let node = match flaw.map_or_else(|| self.content(record, &last), Err) {
            Ok(node) => node,
            Err(reason) => {
                self.refuse(&record.name, &reason);
                Node::File(tree::File { local: None, held: Held::Refused(reason) })
            }
        };
        let is_refused = matches!(node, Node::File(tree::File { held: Held::Refused(_), .. }));
        let inserted = self.folder.folder(&path).and_then(|folder| folder.insert(last, node));
        if inserted.is_err() && !is_refused {
            self.refuse(&record.name, &flaws::taken());
        }
    }

    fn content(&mut self, record: &Record, name: &str) -> Result<Node, Text> {
        let limits = self.limits();
        let is_archive = is_archive(name);
        let held = if is_archive && self.depth >= limits.archive_depth {
            return Err(nested_too_deep(&limits));
        } else if is_archive {
            let storage = Storage::Memory(self.unpack(record, limits.archive_bytes, false)?);
            let shown = format!("{}/{}", self.shown, record.name);
            return unpacked(storage, &shown, self.depth + 1, self.reading).map(Node::Folder);
        } else if fit(name, &self.reading.options.file_name) == Fit::Other {
            Held::Unread
        } else {
            Held::Bytes(self.unpack(record, limits.file_bytes, true)?)
        };
        Ok(Node::File(tree::File { local: None, held }))
    }

    fn unpack(&mut self, record: &Record, limit: u64, is_cut_at_limit: bool) -> Result<Vec<u8>, Text> {
        let limits = self.limits();
        if record.size.min(limit) > self.reading.budget.bytes {
            return Err(spent(&limits));
        }
        let bytes = member::unpack(&self.storage, record, &limits, limit, is_cut_at_limit)?;
        self.reading.budget.bytes = self.reading.budget.bytes.saturating_sub(bytes.len() as u64);
        Ok(bytes)
    }

    /// The tree. A member that went astray is among the files of the student in whose folder its name begins, so that
    /// they are not left without an answer.
    fn finish(mut self) -> Folder {
        for (name, reason) in self.astray {
            let mut parts = name.splitn(2, ['/', '\\']);
            let (Some(first), Some(rest)) = (parts.next(), parts.next()) else { continue };
            let is_folder = self.folder.children().any(|(name, node)| name == first && matches!(node, Node::Folder(_)));
            if is_folder || moodle::folder(first).is_some() {
                let file = tree::File { local: None, held: Held::Refused(reason) };
                let _ =
                    self.folder.folder(&[first.into()]).and_then(|folder| folder.insert(rest.into(), Node::File(file)));
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

fn nested_too_deep(limits: &Limits) -> Text {
    let most = limits.archive_depth;
    Text::new(
        format!("It is an archive in an archive, more than {most} deep."),
        format!("アーカイブが {most} 段を超えて重なっています。"),
    )
}

fn spent(limits: &Limits) -> Text {
    let mib = limits.total_bytes >> 20;
    Text::new(
        format!("More than {mib} MiB would have been unpacked in all. Grade it in parts."),
        format!("展開した合計が {mib} MiB を超えます。分けて採点してください。"),
    )
}
