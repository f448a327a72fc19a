//! The list of an archive's members.
//!
//! One damaged record costs that record only, so the central directory is read here and not by a library that gives up
//! the archive. Where there is no directory, because the file was cut off, the members are found one behind the other.

use super::record::{self, ArchiveRecord, CENTRAL_SIGNATURE, LOCAL, LOCAL_SIGNATURE, u16_at, u32_at, u64_at};
use super::storage::ArchiveStorage;

const END: usize = 22;
const END_SIGNATURE: [u8; 4] = *b"PK\x05\x06";
const END64: usize = 56;
const END64_SIGNATURE: [u8; 4] = *b"PK\x06\x06";
const LOCATOR: usize = 20;
const LOCATOR_SIGNATURE: [u8; 4] = *b"PK\x06\x07";
/// Longest comment behind the end record.
const MAX_COMMENT: usize = u16::MAX as usize;
/// Largest directory that is read, in bytes: more than 200,000 members of long names.
const MAX_DIRECTORY: u64 = 64 << 20;

/// What an archive has, in the order of its directory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Directory {
    pub records: Vec<ArchiveRecord>,
    /// Records that cannot be read.
    pub damaged: usize,
    /// Whether the directory is missing, and the members were found without it.
    pub is_recovered: bool,
}

/// Reads the directory; `None` where the bytes are no archive at all. At most `most` members are listed.
pub(super) fn read(storage: &ArchiveStorage, most: u64) -> Option<Directory> {
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    let mut directory = match central(storage) {
        Some((bytes, shift)) => listed(&bytes, shift, most),
        None => recovered(storage, most)?,
    };
    for record in &mut directory.records {
        if record.name.is_empty() {
            record.name = super::name::decode(&record.raw_name);
        }
    }
    Some(directory)
}

/// The bytes of the central directory, and how far the archive's data lie behind where it says they do.
fn central(storage: &ArchiveStorage) -> Option<(Vec<u8>, u64)> {
    let length = usize::try_from(storage.len()).unwrap_or(usize::MAX).min(END + MAX_COMMENT);
    let tail_start = storage.len() - length as u64;
    let tail = storage.bytes(tail_start, length)?;
    let ends: Vec<usize> = (0..tail.len().saturating_sub(END - 1))
        .rev()
        .filter(|&at| tail[at..].starts_with(&END_SIGNATURE))
        .filter(|&at| at + END + usize::from(u16_at(&tail, at + 20)) <= tail.len())
        .collect();
    // A comment can hold what looks like an end record: the one whose comment ends with the file is the real one.
    let is_last = |at: &usize| at + END + usize::from(u16_at(&tail, at + 20)) == tail.len();
    let (exact, others): (Vec<usize>, Vec<usize>) = ends.into_iter().partition(is_last);
    exact.into_iter().chain(others).find_map(|at| at_end(storage, &tail[at..], tail_start + at as u64))
}

/// The directory that the end record `end`, which stands at `position`, tells of.
fn at_end(storage: &ArchiveStorage, end: &[u8], position: u64) -> Option<(Vec<u8>, u64)> {
    let mut stated = (u64::from(u32_at(end, 12)), u64::from(u32_at(end, 16)));
    let mut directory_end = position;
    if let Some((end64, bytes)) = end64(storage, position) {
        stated = (u64_at(&bytes, 40), u64_at(&bytes, 48));
        directory_end = end64;
    }
    let (size, offset) = stated;
    if size > MAX_DIRECTORY {
        return None;
    }
    // Something stands before the archive, such as a program that unpacks it, where the two do not meet.
    let start = directory_end.checked_sub(size)?;
    let shifted = start.checked_sub(offset).map(|shift| (start, shift));
    [shifted, Some((offset, 0))].into_iter().flatten().find_map(|(start, shift)| {
        let bytes = storage.bytes(start, usize::try_from(size).ok()?)?;
        (bytes.is_empty() || bytes.starts_with(&CENTRAL_SIGNATURE)).then_some((bytes, shift))
    })
}

/// The ZIP64 end record of the end record at `position`, and where it stands.
fn end64(storage: &ArchiveStorage, position: u64) -> Option<(u64, Vec<u8>)> {
    let locator_at = position.checked_sub(LOCATOR as u64)?;
    let locator = storage.bytes(locator_at, LOCATOR).filter(|bytes| bytes.starts_with(&LOCATOR_SIGNATURE))?;
    [Some(u64_at(&locator, 8)), locator_at.checked_sub(END64 as u64)].into_iter().flatten().find_map(|at| {
        let bytes = storage.bytes(at, END64)?;
        bytes.starts_with(&END64_SIGNATURE).then_some((at, bytes))
    })
}

fn listed(mut bytes: &[u8], shift: u64, most: usize) -> Directory {
    let mut directory = Directory::default();
    while !bytes.is_empty() && directory.records.len() < most {
        match record::central(bytes) {
            Some((mut record, length)) => {
                record.start = record.start.saturating_add(shift);
                directory.records.push(record);
                bytes = &bytes[length..];
            }
            None => {
                directory.damaged += 1;
                let next = bytes.windows(4).skip(1).position(|window| window == CENTRAL_SIGNATURE);
                bytes = next.map_or(&[], |at| &bytes[at + 1..]);
            }
        }
    }
    directory
}

/// The members of an archive whose end is missing.
fn recovered(storage: &ArchiveStorage, most: usize) -> Option<Directory> {
    let mut directory = Directory { is_recovered: true, ..Directory::default() };
    let mut at = 0;
    while directory.records.len() < most {
        let available = usize::try_from(storage.len().saturating_sub(at)).unwrap_or(usize::MAX);
        let Some(header) = storage.bytes(at, available.min(LOCAL + 2 * MAX_COMMENT)) else { break };
        let Some(found) = record::local(&header) else { break };
        let mut record = ArchiveRecord { start: at, ..found.record };
        let data = at + found.length;
        let is_sized = record.flags & record::SIZES_BEHIND == 0 || record.compressed != 0;
        let end = if is_sized { data.checked_add(record.compressed) } else { sized_behind(storage, data, &mut record) };
        directory.records.push(record);
        match end.and_then(|end| past_descriptor(storage, end)) {
            Some(next) => at = next,
            None => break,
        }
    }
    (!directory.records.is_empty()).then_some(directory)
}

/// Finds the sizes that stand behind the data at `data`: where a descriptor tells just the length that lies before it.
fn sized_behind(storage: &ArchiveStorage, data: u64, record: &mut ArchiveRecord) -> Option<u64> {
    const STEP: usize = 1 << 16;
    const DESCRIPTOR: usize = 24;
    let mut at = data;
    while at < storage.len() {
        let length = usize::try_from(storage.len() - at).unwrap_or(usize::MAX).min(STEP + DESCRIPTOR);
        let bytes = storage.bytes(at, length)?;
        for found in (0..bytes.len().min(STEP)).filter(|&found| bytes[found..].starts_with(b"PK\x07\x08")) {
            let (descriptor, before) = (&bytes[found..], at + found as u64 - data);
            let narrow = (u64::from(u32_at(descriptor, 8)), u64::from(u32_at(descriptor, 12)), 16);
            let wide = (u64_at(descriptor, 8), u64_at(descriptor, 16), 24);
            for (compressed, size, length) in [narrow, wide] {
                if compressed == before {
                    (record.compressed, record.size, record.crc) = (compressed, size, u32_at(descriptor, 4));
                    return Some(at + found as u64 + length);
                }
            }
        }
        at += STEP as u64;
    }
    // Cut off: it claims more than there is.
    record.compressed = u64::MAX;
    None
}

/// Where the next local header may be: behind the data, and a descriptor that some archivers write all the same.
fn past_descriptor(storage: &ArchiveStorage, end: u64) -> Option<u64> {
    [0, 12, 16, 20, 24]
        .into_iter()
        .map(|length| end.saturating_add(length))
        .find(|&at| storage.bytes(at, 4).is_some_and(|bytes| bytes == LOCAL_SIGNATURE))
}
