//! The bytes of an archive, on the disk or in memory.

use std::fs::File;
use std::io::{self, Read};
use std::os::unix::fs::FileExt;

/// Where an archive's bytes are.
#[derive(Debug)]
pub(super) enum ArchiveStorage {
    /// A file, and its length when it was opened.
    File(File, u64),
    /// An archive that was unpacked from another.
    Memory(Vec<u8>),
}

impl ArchiveStorage {
    pub fn file(file: File) -> io::Result<Self> {
        let length = file.metadata()?.len();
        Ok(Self::File(file, length))
    }

    pub fn len(&self) -> u64 {
        match self {
            Self::File(_, length) => *length,
            Self::Memory(bytes) => bytes.len() as u64,
        }
    }

    /// The `length` bytes from `offset` on; `None` where the archive ends before them or the disk fails.
    pub fn bytes(&self, offset: u64, length: usize) -> Option<Vec<u8>> {
        let end = offset.checked_add(length as u64)?;
        if end > self.len() {
            return None;
        }
        match self {
            Self::File(file, _) => {
                let mut bytes = vec![0; length];
                file.read_exact_at(&mut bytes, offset).ok()?;
                Some(bytes)
            }
            Self::Memory(bytes) => {
                let start = usize::try_from(offset).ok()?;
                Some(bytes.get(start..start + length)?.to_vec())
            }
        }
    }

    /// Reads from `offset` on, to the end at most.
    pub fn section(&self, offset: u64) -> Section<'_> {
        Section { storage: self, offset }
    }
}

/// A reader over a part of an archive.
#[derive(Debug)]
pub(super) struct Section<'a> {
    storage: &'a ArchiveStorage,
    offset: u64,
}

impl Read for Section<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = match self.storage {
            ArchiveStorage::File(file, _) => file.read_at(buffer, self.offset)?,
            ArchiveStorage::Memory(bytes) => {
                let start = usize::try_from(self.offset).unwrap_or(usize::MAX).min(bytes.len());
                let count = buffer.len().min(bytes.len() - start);
                buffer[..count].copy_from_slice(&bytes[start..start + count]);
                count
            }
        };
        self.offset += count as u64;
        Ok(count)
    }
}
