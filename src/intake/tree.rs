//! What was found in an input: folders and files, wherever they were.

use crate::language::Text;
use std::collections::HashMap;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::PathBuf;
use unicode_normalization::UnicodeNormalization;

/// A folder, or an archive, which is a folder as well.
#[derive(Debug, Default)]
pub(super) struct TreeFolder {
    children: Vec<(String, TreeNode)>,
    by_name: HashMap<String, usize>,
}

/// What stands in a folder.
#[derive(Debug)]
pub(super) enum TreeNode {
    Folder(TreeFolder),
    File(TreeFile),
}

/// A file.
#[derive(Debug)]
pub(super) struct TreeFile {
    /// Where it is on this machine, where it is there.
    pub local: Option<PathBuf>,
    pub held: Held,
}

/// What is known of a file's content.
#[derive(Debug)]
pub(super) enum Held {
    /// It is read from the disk when it is wanted.
    OnDisk,
    /// Its bytes, cut above what is ever graded.
    Bytes(Vec<u8>),
    /// Its name shows that it is no shader: it was not read.
    Unread,
    /// It cannot be read, or must not be.
    Refused(Text),
}

/// Something else has the name already.
#[derive(Debug)]
pub(super) struct NameTaken;

impl TreeFolder {
    pub fn children(&self) -> impl Iterator<Item = (&str, &TreeNode)> {
        self.children.iter().map(|(name, node)| (name.as_str(), node))
    }

    /// The names of the files that lie in the folder itself.
    pub fn file_names(&self) -> impl Iterator<Item = &str> {
        self.children().filter(|(_, node)| matches!(node, TreeNode::File(_))).map(|(name, _)| name)
    }

    pub fn is_empty(&self) -> bool {
        self.children.is_empty()
    }

    pub fn into_children(self) -> Vec<(String, TreeNode)> {
        self.children
    }

    /// The folder `path` below this one, made where it is not there.
    pub fn folder(&mut self, path: &[String]) -> Result<&mut Self, NameTaken> {
        let Some((first, rest)) = path.split_first() else { return Ok(self) };
        let at = match self.by_name.get(first) {
            Some(&at) => at,
            None => self.push(first.clone(), TreeNode::Folder(Self::default())),
        };
        match &mut self.children[at].1 {
            TreeNode::Folder(folder) => folder.folder(rest),
            TreeNode::File(_) => Err(NameTaken),
        }
    }

    /// Puts a node where there is none of that name.
    pub fn insert(&mut self, name: String, node: TreeNode) -> Result<(), NameTaken> {
        if self.by_name.contains_key(&name) {
            return Err(NameTaken);
        }
        self.push(name, node);
        Ok(())
    }

    /// Puts a node in the place of the one of this name.
    pub fn replace(&mut self, name: &str, node: TreeNode) {
        if let Some(&at) = self.by_name.get(name) {
            self.children[at].1 = node;
        }
    }

    fn push(&mut self, name: String, node: TreeNode) -> usize {
        let at = self.children.len();
        self.by_name.insert(name.clone(), at);
        self.children.push((name, node));
        at
    }

    /// All files below, each with its path from this folder, in order.
    pub fn into_files(self) -> Vec<(Vec<String>, TreeFile)> {
        let mut files = Vec::new();
        self.collect(&mut Vec::new(), &mut files);
        files
    }

    fn collect(self, path: &mut Vec<String>, files: &mut Vec<(Vec<String>, TreeFile)>) {
        for (name, node) in self.children {
            path.push(name);
            match node {
                TreeNode::Folder(folder) => folder.collect(path, files),
                TreeNode::File(file) => files.push((path.clone(), file)),
            }
            path.pop();
        }
    }

    /// Whether any file below has a name for which this holds.
    pub fn has_file(&self, is_wanted: &dyn Fn(&str) -> bool) -> bool {
        self.children.iter().any(|(name, node)| match node {
            TreeNode::Folder(folder) => folder.has_file(is_wanted),
            TreeNode::File(_) => is_wanted(name),
        })
    }
}

/// A name of this machine's as text: UTF-8, or else Shift_JIS, which old tools left behind; composed as people type.
pub(super) fn decoded(name: &OsStr) -> String {
    let bytes = name.as_bytes();
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => match encoding_rs::SHIFT_JIS.decode_without_bom_handling_and_without_replacement(bytes) {
            Some(text) => text,
            None => String::from_utf8_lossy(bytes),
        },
    };
    text.nfc().collect()
}

/// What systems and tools leave in folders and archives by themselves, and nobody hands in. Other names that begin with a
/// dot are names: Moodle's folders begin with those of people.
const LITTER: [&str; 25] = [
    ".AppleDouble",
    ".DS_Store",
    ".LSOverride",
    ".Spotlight-V100",
    ".TemporaryItems",
    ".Trash",
    ".Trashes",
    ".cache",
    ".clangd",
    ".directory",
    ".fseventsd",
    ".git",
    ".gitattributes",
    ".github",
    ".gitignore",
    ".gitkeep",
    ".hg",
    ".idea",
    ".localized",
    ".svn",
    ".vs",
    ".vscode",
    "__MACOSX",
    "Thumbs.db",
    "desktop.ini",
];

/// Whether this is the name of such a thing.
pub(super) fn is_litter(name: &str) -> bool {
    LITTER.iter().any(|litter| name.eq_ignore_ascii_case(litter))
}

/// What macOS keeps of the file `NAME` beside it, in `._NAME`: the part of the name that is the other's.
pub(super) fn beside(name: &str) -> Option<&str> {
    name.strip_prefix("._").filter(|name| !name.is_empty())
}

/// Whether a file begins as one that macOS keeps beside another (AppleDouble, RFC 1740).
pub(super) fn is_apple_double(start: &[u8]) -> bool {
    start.starts_with(&[0x00, 0x05, 0x16, 0x07])
}
