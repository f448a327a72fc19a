//! The content of one member, as far as it is wanted.

use super::record::{self, ArchiveRecord, LOCAL, LOCAL_SIGNATURE};
use super::storage::ArchiveStorage;
use crate::intake::IntakeLimits;
use crate::language::Text;
use std::io::Read;

/// The compression methods that are unpacked: stored, Deflate, Deflate64, bzip2.
const METHODS: [u16; 4] = [0, 8, 9, 12];

/// Unpacks a member. One of more than `limit` bytes is cut there where `is_cut_at_limit`, and refused where not.
pub(super) fn unpack(
    storage: &ArchiveStorage,
    record: &ArchiveRecord,
    limits: &IntakeLimits,
    limit: u64,
    is_cut_at_limit: bool,
) -> Result<Vec<u8>, Text> {
    let data = data_start(storage, record)?;
    if record.size > limits.bomb_bytes && record.size / limits.bomb_ratio > record.compressed {
        return Err(bomb(record));
    }
    if !METHODS.contains(&record.method) {
        return Err(Text::new(
            format!("It is compressed by method {}, which is not supported. Make the ZIP with Deflate.", record.method),
            format!("圧縮方式 {} には対応していません。Deflate 方式の ZIP にしてください。", record.method),
        ));
    }
    let is_cut = record.size > limit;
    if is_cut && !is_cut_at_limit {
        return Err(too_large(record.size, limit));
    }
    // What is left over of the compressed data is of no interest, and as long as the archive says.
    let readable = record.compressed.min(limit.saturating_mul(2).max(1 << 20));
    let compressed = u32::try_from(readable).map_err(|_| too_large(record.size, limit))?;
    let declared = u32::try_from(record.size.min(u64::from(u32::MAX))).unwrap_or(u32::MAX);
    let header = header(record, compressed, declared);
    let mut stream = header.as_slice().chain(storage.section(data).take(readable));
    let mut member = match zip::read::read_zipfile_from_stream(&mut stream) {
        Ok(Some(member)) => member,
        Ok(None) => return Err(broken("no data")),
        Err(error) => return Err(broken(&error.to_string())),
    };
    let mut bytes = Vec::new();
    let wanted = if is_cut { limit } else { record.size + 1 };
    (&mut member).take(wanted).read_to_end(&mut bytes).map_err(|error| broken(&error.to_string()))?;
    if !is_cut && bytes.len() as u64 != record.size {
        return Err(Text::new(
            format!("It says {} bytes and has {}.", record.size, bytes.len()),
            format!("大きさが {} バイトと書かれていますが、実際は {} バイトです。", record.size, bytes.len()),
        ));
    }
    Ok(bytes)
}

/// A header for the data alone: what it says has been checked, and no name or extra field goes to the library.
fn header(record: &ArchiveRecord, compressed: u32, size: u32) -> Vec<u8> {
    let mut header = LOCAL_SIGNATURE.to_vec();
    for field in [20, 0, record.method, 0, 0] {
        header.extend(field.to_le_bytes());
    }
    for field in [record.crc, compressed, size] {
        header.extend(field.to_le_bytes());
    }
    header.resize(LOCAL, 0);
    header
}

/// Where a member's data begin, if the header before them agrees with the directory.
fn data_start(storage: &ArchiveStorage, record: &ArchiveRecord) -> Result<u64, Text> {
    let lengths = storage.bytes(record.start, LOCAL).ok_or_else(cut_off)?;
    let length = LOCAL + usize::from(record::u16_at(&lengths, 26)) + usize::from(record::u16_at(&lengths, 28));
    let bytes = storage.bytes(record.start, length).ok_or_else(cut_off)?;
    let local = record::local(&bytes).ok_or_else(|| broken("there is no header where the directory says"))?;
    let found = &local.record;
    let has_sizes = found.flags & record::SIZES_BEHIND == 0;
    let sizes_agree = (found.compressed, found.size, found.crc) == (record.compressed, record.size, record.crc);
    if found.raw_name != record.raw_name || found.method != record.method || (has_sizes && !sizes_agree) {
        return Err(Text::new(
            "The archive says two different things about it.",
            "アーカイブ内の 2 か所の記述が食い違っています。",
        ));
    }
    let data = record.start + local.length;
    match data.checked_add(record.compressed).filter(|end| *end <= storage.len()) {
        Some(_) => Ok(data),
        None => Err(cut_off()),
    }
}

fn cut_off() -> Text {
    Text::new("The archive ends before it does.", "途中でアーカイブが終わっています。")
}

fn broken(detail: &str) -> Text {
    Text::new(
        format!("It is damaged and cannot be unpacked ({detail})."),
        format!("壊れているため展開できません ({detail})。"),
    )
}

fn bomb(record: &ArchiveRecord) -> Text {
    let mib = record.size.div_ceil(1 << 20);
    Text::new(
        format!("It would unpack from {} bytes to {mib} MiB: no text does that.", record.compressed),
        format!("{} バイトから {mib} MiB に展開されます。普通のテキストではあり得ません。", record.compressed),
    )
}

fn too_large(size: u64, limit: u64) -> Text {
    let (mib, limit) = (size.div_ceil(1 << 20), limit >> 20);
    Text::new(
        format!("It has {mib} MiB unpacked; at most {limit} MiB are read."),
        format!("展開すると {mib} MiB になります。読み込むのは {limit} MiB までです。"),
    )
}
