//! How much is read of what others made.

use crate::language::Text;
use crate::source::MAX_BYTES;

/// Limits of an intake. They hold over all inputs together, but for those of one file or archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most bytes kept of one file. It lies above [`MAX_BYTES`], so that the source stage refuses what is too large by
    /// its own message.
    pub file_bytes: u64,
    /// Most bytes unpacked from one archive inside another.
    pub archive_bytes: u64,
    /// Most bytes unpacked in all.
    pub total_bytes: u64,
    /// Most files, folders and archive members in all.
    pub entries: u64,
    /// How deep archives stand in archives; 1 is an archive in none.
    pub archive_depth: u32,
    /// How deep folders stand in folders, archives counted.
    pub folder_depth: usize,
    /// From what compression ratio on a member above `bomb_bytes` is a bomb. Text seldom goes beyond 20.
    pub bomb_ratio: u64,
    /// The size up to which no compression ratio is suspicious.
    pub bomb_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 1 << 20,
            archive_bytes: 64 << 20,
            total_bytes: 1 << 30,
            entries: 200_000,
            archive_depth: 4,
            folder_depth: 32,
            bomb_ratio: 100,
            bomb_bytes: MAX_BYTES as u64,
        }
    }
}

impl Limits {
    /// What may be spent under these limits.
    pub(super) fn budget(&self) -> Budget {
        Budget { bytes: self.total_bytes, entries: self.entries }
    }
}

/// What is left of the limits that hold over all inputs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    pub bytes: u64,
    pub entries: u64,
}

impl Budget {
    /// Takes one entry; false where none is left.
    pub fn take_entry(&mut self) -> bool {
        let left = self.entries.checked_sub(1);
        self.entries = left.unwrap_or(0);
        left.is_some()
    }
}

/// A file or folder that the machine does not give out.
pub(super) fn unreadable(error: &std::io::Error) -> Text {
    Text::new(format!("It cannot be read: {error}."), format!("読み込めません: {error}"))
}

/// The rest of something after the last entry that is taken.
pub(super) fn too_many(limits: &Limits) -> Text {
    let most = limits.entries;
    Text::new(
        format!("There are more than {most} files; what comes from here on is left out. Grade it in parts."),
        format!("ファイルが {most} 個を超えたため、これ以降は扱いません。分けて採点してください。"),
    )
}

/// A path with too many folders in each other.
pub(super) fn too_deep(limits: &Limits) -> Text {
    let most = limits.folder_depth;
    Text::new(
        format!("More than {most} folders stand in each other."),
        format!("フォルダが {most} 段を超えて重なっています。"),
    )
}
