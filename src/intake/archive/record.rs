//! One member as the directory of an archive describes it, and the header that stands before its data.
//!
//! The layout is that of PKWARE's APPNOTE.TXT 6.3: sections 4.3.7 (local header), 4.3.12 (central directory), 4.5.3
//! (ZIP64) and 4.6.9 (Info-ZIP's Unicode path).

use super::name;

/// Length of the fixed part of a local header, and of a record of the central directory.
pub(super) const LOCAL: usize = 30;
pub(super) const CENTRAL: usize = 46;
pub(super) const LOCAL_SIGNATURE: [u8; 4] = *b"PK\x03\x04";
pub(super) const CENTRAL_SIGNATURE: [u8; 4] = *b"PK\x01\x02";

/// Bits of the flags: encrypted, sizes behind the data, strong encryption, UTF-8, directory masked.
const ENCRYPTED: u16 = 1 | 1 << 6 | 1 << 13;
pub(super) const SIZES_BEHIND: u16 = 1 << 3;
const UTF8: u16 = 1 << 11;

/// A member of an archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ArchiveRecord {
    /// Its name as stored.
    pub raw_name: Vec<u8>,
    /// Its name as text; the encoding is settled for the archive as a whole.
    pub name: String,
    pub flags: u16,
    pub method: u16,
    pub crc: u32,
    pub compressed: u64,
    pub size: u64,
    /// Where its local header is, from the start of the archive's own data.
    pub start: u64,
    /// File type and permissions as on Unix, where the archiver wrote them; else 0.
    pub mode: u32,
}

/// What stands before the data of a member.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LocalHeader {
    pub record: ArchiveRecord,
    /// Bytes from the start of the header to the data.
    pub length: u64,
}

impl ArchiveRecord {
    pub fn is_encrypted(&self) -> bool {
        const AES: u16 = 99;
        self.flags & ENCRYPTED != 0 || self.method == AES
    }

    pub fn is_folder(&self) -> bool {
        self.name.ends_with('/')
    }
}

/// Little-endian numbers at byte offsets; 0 beyond the end.
pub(super) fn u16_at(bytes: &[u8], at: usize) -> u16 {
    bytes.get(at..at + 2).map_or(0, |b| u16::from_le_bytes([b[0], b[1]]))
}

pub(super) fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from(u16_at(bytes, at)) | u32::from(u16_at(bytes, at + 2)) << 16
}

pub(super) fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from(u32_at(bytes, at)) | u64::from(u32_at(bytes, at + 4)) << 32
}

/// The first record of the central directory in `bytes` and its length; `None` where there is none, or it is cut off.
pub(super) fn central(bytes: &[u8]) -> Option<(ArchiveRecord, usize)> {
    let fixed = bytes.get(..CENTRAL).filter(|fixed| fixed.starts_with(&CENTRAL_SIGNATURE))?;
    let [name, extra, comment] = [28, 30, 32].map(|at| usize::from(u16_at(fixed, at)));
    let length = CENTRAL + name + extra + comment;
    let variable = bytes.get(CENTRAL..length)?;
    let raw_name = variable[..name].to_vec();
    let extra = &variable[name..name + extra];
    let mut record = ArchiveRecord {
        flags: u16_at(fixed, 8),
        method: u16_at(fixed, 10),
        crc: u32_at(fixed, 16),
        compressed: u32_at(fixed, 20).into(),
        size: u32_at(fixed, 24).into(),
        start: u32_at(fixed, 42).into(),
        mode: u32_at(fixed, 38) >> 16,
        name: String::new(),
        raw_name,
    };
    widen(&mut record, extra, true);
    settle_name(&mut record, extra);
    Some((record, length))
}

/// The local header at the start of `bytes`; `None` where there is none, or it is cut off.
pub(super) fn local(bytes: &[u8]) -> Option<LocalHeader> {
    let fixed = bytes.get(..LOCAL).filter(|fixed| fixed.starts_with(&LOCAL_SIGNATURE))?;
    let [name, extra] = [26, 28].map(|at| usize::from(u16_at(fixed, at)));
    let variable = bytes.get(LOCAL..LOCAL + name + extra)?;
    let mut record = ArchiveRecord {
        flags: u16_at(fixed, 6),
        method: u16_at(fixed, 8),
        crc: u32_at(fixed, 14),
        compressed: u32_at(fixed, 18).into(),
        size: u32_at(fixed, 22).into(),
        start: 0,
        mode: 0,
        name: String::new(),
        raw_name: variable[..name].to_vec(),
    };
    widen(&mut record, &variable[name..], false);
    settle_name(&mut record, &variable[name..]);
    Some(LocalHeader { record, length: (LOCAL + name + extra) as u64 })
}

/// The extra fields, each with its number; a broken tail is left out.
fn extras(mut extra: &[u8]) -> impl Iterator<Item = (u16, &[u8])> {
    std::iter::from_fn(move || {
        let content = extra.get(4..4 + usize::from(u16_at(extra, 2)))?;
        let id = u16_at(extra, 0);
        extra = &extra[4 + content.len()..];
        Some((id, content))
    })
}

/// Takes the sizes that do not fit 32 bits from the ZIP64 extra field: those that are all ones, in this order.
fn widen(record: &mut ArchiveRecord, extra: &[u8], has_start: bool) {
    const ZIP64: u16 = 1;
    let Some((_, content)) = extras(extra).find(|(id, _)| *id == ZIP64) else { return };
    let mut values = content.chunks_exact(8).map(|bytes| u64_at(bytes, 0));
    for field in [Some(&mut record.size), Some(&mut record.compressed), has_start.then_some(&mut record.start)] {
        if let Some(field) = field.filter(|field| **field == u64::from(u32::MAX)) {
            *field = values.next().unwrap_or(u64::MAX);
        }
    }
}

/// The name as text, where the member says how it is to be read; else it stays empty.
fn settle_name(record: &mut ArchiveRecord, extra: &[u8]) {
    const UNICODE_PATH: u16 = 0x7075;
    let is_current = |content: &&[u8]| {
        content.len() > 5 && content[0] == 1 && u32_at(content, 1) == crc32fast::hash(&record.raw_name)
    };
    let unicode = extras(extra).filter(|(id, _)| *id == UNICODE_PATH).map(|(_, content)| content).find(is_current);
    let stated = unicode.map(|content| &content[5..]).and_then(|path| std::str::from_utf8(path).ok());
    let utf8 = || (record.flags & UTF8 != 0).then(|| std::str::from_utf8(&record.raw_name).ok()).flatten();
    if let Some(text) = stated.or_else(utf8) {
        record.name = name::composed(text);
    }
}
