//! The folder of an assignment: its files, read once, wherever they come from.

use crate::assignment::{AssignmentError, MANIFEST, error};
use crate::text::both;
use crate::{Text, built_in, manifest};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;
use std::{fmt, fs, io};

/// Most files of a folder, and most bytes of all of them: who names the wrong folder is told so, not kept waiting.
const MAX_FILES: usize = 1000;
const MAX_BYTES: u64 = 64 << 20;

/// How many folders may stand in one another.
const MAX_DEPTH: usize = 8;

/// All files of an assignment, by their names relative to its folder, with `/` between folders.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Folder {
    /// The bytes of each file by its name.
    pub files: BTreeMap<String, Vec<u8>>,
}

impl Folder {
    /// Reads a folder. Hidden files and an editor's backups (`NAME~`) are no part of it.
    ///
    /// # Errors
    /// It is no folder, has no `assignment.toml`, is too large, or a file cannot be read, or leads out of it.
    pub fn read(folder: &Path) -> Result<Self, AssignmentError> {
        let shown = folder.display();
        let unreadable = |e: io::Error| {
            error(
                MANIFEST,
                both(
                    format!("the folder {shown} cannot be read: {e}"),
                    format!("フォルダ {shown} を読み込めません: {e}"),
                ),
            )
        };
        let root = fs::canonicalize(folder).map_err(unreadable)?;
        if !root.is_dir() {
            return Err(error(
                MANIFEST,
                both(
                    format!("{shown} is no folder: name the folder that {MANIFEST} is in"),
                    format!("{shown} はフォルダではありません。{MANIFEST} のあるフォルダを指定してください"),
                ),
            ));
        }
        if fs::symlink_metadata(root.join(MANIFEST)).is_err() {
            return Err(error(
                MANIFEST,
                both(
                    format!("is not in the folder {shown}: every assignment has one"),
                    format!("フォルダ {shown} にありません。どの課題にも必要なファイルです"),
                ),
            ));
        }
        Self::read_alone(&root)?.with_bases(root.parent())
    }

    /// The files of a folder, without those that it extends.
    fn read_alone(root: &Path) -> Result<Self, AssignmentError> {
        let mut reading = FolderReader { root, bytes: 0, files: BTreeMap::new() };
        reading.folder(root, "", 0)?;
        Ok(Self { files: reading.files })
    }

    /// The same with what it extends: the files that it does not have itself, and the manifests under the names
    /// `../NAME/assignment.toml`. A folder is looked for beside it first, then among those that are built in.
    ///
    /// # Errors
    /// What it extends is nowhere, or cannot be read.
    pub fn with_bases(mut self, beside: Option<&Path>) -> Result<Self, AssignmentError> {
        let mut from = MANIFEST.to_owned();
        while let Some(base) = self.text(&from).ok().and_then(manifest::extended) {
            let file = manifest::name_of_base(&base);
            if self.files.contains_key(&file) {
                break;
            }
            let is_name = !base.is_empty() && !base.contains(['/', '\\']) && !base.starts_with('.');
            let root = beside.filter(|_| is_name).map(|folder| folder.join(&base));
            let found = match root.filter(|root| root.join(MANIFEST).is_file()) {
                Some(root) => Some(Self::read_alone(&fs::canonicalize(&root).map_err(|e| cannot_read(&base, &e))?)?),
                None => built_in::folder(&base),
            };
            let Some(mut found) = found else { return Err(self.extends_nothing(&from, &base)) };
            let text = found.files.remove(MANIFEST).unwrap_or_default();
            self.files.insert(file.clone(), text);
            for (name, bytes) in found.files {
                self.files.entry(name).or_insert(bytes);
            }
            from = file;
        }
        Ok(self)
    }

    fn extends_nothing(&self, from: &str, base: &str) -> AssignmentError {
        let known = built_in::names().collect::<Vec<_>>().join(", ");
        let line = self.text(from).map_or(1, manifest::line_of_extends);
        error(
            format!("{from}, line {line}"),
            both(
                format!(
                    "there is no folder `{base}` beside this one with an {MANIFEST}, and none is built in: built in are {known}"
                ),
                format!(
                    "`{base}` というフォルダ（{MANIFEST} を持つもの）がこのフォルダと同じ場所になく、組み込みの課題にもありません。組み込みの課題: {known}"
                ),
            ),
        )
    }

    /// A folder of these files.
    pub fn of<N: Into<String>, B: Into<Vec<u8>>>(files: impl IntoIterator<Item = (N, B)>) -> Self {
        Self { files: files.into_iter().map(|(name, bytes)| (name.into(), bytes.into())).collect() }
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// There is no such file.
    pub fn bytes(&self, name: &str) -> Result<&[u8], AssignmentError> {
        self.files.get(name).map(Vec::as_slice).ok_or_else(|| {
            let files: Vec<_> = self.files.keys().map(String::as_str).collect();
            let message = both(
                format!("is not in the folder, which has {}: add it, or correct the name", files.join(", ")),
                format!(
                    "フォルダにありません (あるもの: {})。ファイルを追加するか、名前を直してください",
                    files.join(", ")
                ),
            );
            AssignmentError::of_file(name, message)
        })
    }

    /// A file as text.
    ///
    /// # Errors
    /// There is no such file, or it is not UTF-8, or has a NUL, with the line.
    pub fn text(&self, name: &str) -> Result<&str, AssignmentError> {
        let bytes = self.bytes(name)?;
        let line = |at: usize| bytes[..at].iter().filter(|byte| **byte == b'\n').count() + 1;
        let place = |at: usize| format!("{name}, line {}", line(at));
        let text = std::str::from_utf8(bytes).map_err(|e| {
            error(
                place(e.valid_up_to()),
                both("is not UTF-8: save the file in that encoding", "UTF-8 ではありません。UTF-8 で保存してください"),
            )
        })?;
        match text.find('\0') {
            Some(at) => Err(error(
                place(at),
                both(
                    "has a NUL, which no text has: remove it",
                    "NUL 文字があります。テキストには使えないので、取り除いてください",
                ),
            )),
            None => Ok(text),
        }
    }

    /// SHA-256 over names and bytes of all files, in hexadecimal: folders of the same digest are the same assignment.
    pub fn digest(&self) -> String {
        let mut hash = Sha256::new();
        for (name, bytes) in &self.files {
            for part in [name.as_bytes(), bytes] {
                // The length first: nothing moves from a name into a file unseen.
                hash.update((part.len() as u64).to_le_bytes());
                hash.update(part);
            }
        }
        hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl fmt::Debug for Folder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.files.iter().map(|(name, bytes)| (name, bytes.len()))).finish()
    }
}

fn at(file: &str, message: Text) -> AssignmentError {
    AssignmentError::of_file(file, message)
}

fn cannot_read(file: &str, e: &io::Error) -> AssignmentError {
    at(file, both(format!("cannot be read: {e}"), format!("読み込めません: {e}")))
}

/// A folder that is being read.
struct FolderReader<'a> {
    root: &'a Path,
    bytes: u64,
    files: BTreeMap<String, Vec<u8>>,
}

impl FolderReader<'_> {
    fn folder(&mut self, folder: &Path, before: &str, depth: usize) -> Result<(), AssignmentError> {
        let unreadable = |e: io::Error| cannot_read(before.trim_end_matches('/'), &e);
        for entry in fs::read_dir(folder).map_err(unreadable)? {
            let entry = entry.map_err(unreadable)?;
            let Ok(name) = entry.file_name().into_string() else {
                let shown = format!("{before}{}", entry.file_name().to_string_lossy());
                return Err(at(
                    &shown,
                    both(
                        "has a name that is not UTF-8: rename it",
                        "ファイル名が UTF-8 ではありません。名前を変えてください",
                    ),
                ));
            };
            if name.starts_with('.') || name.ends_with('~') {
                continue;
            }
            self.entry(&entry.path(), format!("{before}{name}"), depth)?;
        }
        Ok(())
    }

    fn entry(&mut self, path: &Path, name: String, depth: usize) -> Result<(), AssignmentError> {
        let unreadable = |e: io::Error| cannot_read(&name, &e);
        // A link is followed, but not out of the folder: what is outside is not handed on with it.
        let target = fs::canonicalize(path).map_err(unreadable)?;
        if !target.starts_with(self.root) {
            return Err(at(
                &name,
                both(
                    "is a link that leads out of the folder: put the file itself here",
                    "フォルダの外を指すリンクです。ファイルそのものを置いてください",
                ),
            ));
        }
        let metadata = fs::metadata(&target).map_err(unreadable)?;
        if metadata.is_dir() {
            if depth == MAX_DEPTH {
                return Err(at(
                    &name,
                    both(
                        format!("folders stand in one another more than {MAX_DEPTH} deep: put it higher"),
                        format!("フォルダの入れ子が {MAX_DEPTH} 段を超えています。浅くしてください"),
                    ),
                ));
            }
            return self.folder(path, &format!("{name}/"), depth + 1);
        }
        if !metadata.is_file() {
            return Err(at(&name, both("is no file: remove it", "通常のファイルではありません。取り除いてください")));
        }
        self.bytes += metadata.len();
        if self.bytes > MAX_BYTES || self.files.len() == MAX_FILES {
            let room = MAX_BYTES >> 20;
            let message = both(
                format!("the folder has more than {MAX_FILES} files or {room} MiB: is it the folder of an assignment?"),
                format!(
                    "フォルダのファイルが {MAX_FILES} 個または {room} MiB を超えています。課題のフォルダか確かめてください"
                ),
            );
            return Err(at(&name, message));
        }
        let bytes = fs::read(&target).map_err(unreadable)?;
        self.files.insert(name, bytes);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_is_of_names_and_bytes_and_their_borders() {
        let digest = |files: &[(&str, &str)]| Folder::of(files.iter().copied()).digest();
        let one = digest(&[("a", "bc"), ("d", "")]);
        assert_eq!(one, digest(&[("d", ""), ("a", "bc")]));
        for other in
            [&[("a", "bc")][..], &[("ab", "c"), ("d", "")], &[("a", "bc"), ("e", "")], &[("a", "bd"), ("d", "")]]
        {
            assert_ne!(one, digest(other), "{other:?}");
        }
        // SHA-256 of nothing.
        assert_eq!(digest(&[]), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    }
}
