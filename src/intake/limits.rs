//! How much is read of what others made.

use crate::language::Text;

/// Limits of an intake. They hold over all inputs together, but for those of one file or archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IntakeLimits {
    /// Most bytes kept of one file. It lies above [`crate::source::MAX_BYTES`], so that the source stage refuses what is too large by
    /// its own message.
    pub file_bytes: u64,
    /// Most bytes of an archive that stands in another.
    pub archive_bytes: u64,
    /// How much is read in all.
    pub total: Budget,
    /// How much of it one archive that stands in another may take, with all that stand in it: a student's archive must
    /// not use up what the others need. One of the folders of an input may have as many entries.
    pub part: Budget,
    /// How deep archives stand in archives; 1 is an archive in none.
    pub archive_depth: u32,
    /// How deep folders stand in folders, archives counted.
    pub folder_depth: usize,
    /// From what compression ratio on a member above `bomb_bytes` is a bomb. Text seldom goes beyond 20.
    pub bomb_ratio: u64,
    /// The size up to which no compression ratio is suspicious.
    pub bomb_bytes: u64,
}

impl Default for IntakeLimits {
    fn default() -> Self {
        Self {
            file_bytes: 1 << 20,
            archive_bytes: 64 << 20,
            total: Budget { bytes: 1 << 30, entries: 400_000, refusals: 10_000 },
            part: Budget { bytes: 128 << 20, entries: 20_000, refusals: 100 },
            archive_depth: 4,
            folder_depth: 32,
            bomb_ratio: 100,
            bomb_bytes: 1 << 20,
        }
    }
}

/// How much may be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Bytes that are unpacked.
    pub bytes: u64,
    /// Files, folders and members of archives.
    pub entries: u64,
    /// Lines that say what was refused.
    pub refusals: u64,
}

impl Budget {
    /// Takes one entry; false where none is left.
    pub(super) fn take_entry(&mut self) -> bool {
        let left = self.entries.checked_sub(1);
        self.entries = left.unwrap_or(0);
        left.is_some()
    }

    /// The smaller of both in each.
    pub(super) fn within(self, part: Self) -> Self {
        Self {
            bytes: self.bytes.min(part.bytes),
            entries: self.entries.min(part.entries),
            refusals: self.refusals.min(part.refusals),
        }
    }

    /// What is left after a part of it has gone from `before` to `after`.
    pub(super) fn less(self, before: Self, after: Self) -> Self {
        Self {
            bytes: self.bytes - (before.bytes - after.bytes),
            entries: self.entries - (before.entries - after.entries),
            refusals: self.refusals - (before.refusals - after.refusals),
        }
    }
}

/// A file or folder that the machine does not give out.
pub(super) fn unreadable(error: &std::io::Error) -> Text {
    Text::new(format!("It cannot be read: {error}."), format!("読み込めません: {error}"))
}

/// The rest of something after the last entry that is taken.
pub(super) fn too_many() -> Text {
    Text::new(
        "There are too many files; from here on they are left out.",
        "ファイルが多すぎるため、これ以降は扱いません。",
    )
}

/// Members that would have been unpacked after the last byte that is.
pub(super) fn spent() -> Text {
    Text::new(
        "Too much would have been unpacked together with what came before.",
        "ここまでの分と合わせて、展開した大きさが上限を超えます。",
    )
}

/// What was refused after the last line that says so.
pub(super) fn more_refused(count: u64) -> Text {
    Text::new(
        format!("{count} more files in it were refused."),
        format!("ほかに {count} 個のファイルを受け付けませんでした。"),
    )
}

/// A path with too many folders in each other.
pub(super) fn too_deep(limits: &IntakeLimits) -> Text {
    let most = limits.folder_depth;
    Text::new(
        format!("More than {most} folders stand in each other."),
        format!("フォルダが {most} 段を超えて重なっています。"),
    )
}
