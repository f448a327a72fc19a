//! What is wrong with members before their data are looked at.

use super::name;
use super::record::ArchiveRecord;
use crate::language::Text;
use std::collections::HashMap;

/// For each record why it is refused, if it is.
pub(super) fn find(records: &[ArchiveRecord]) -> Vec<Option<Text>> {
    let mut flaws: Vec<Option<Text>> = records.iter().map(of_one).collect();
    mark_duplicates(records, &mut flaws);
    mark_overlaps(records, &mut flaws);
    flaws
}

fn of_one(record: &ArchiveRecord) -> Option<Text> {
    const TYPE: u32 = 0o170_000;
    const LINK: u32 = 0o120_000;
    const ORDINARY: [u32; 3] = [0, 0o100_000, 0o040_000];
    let kind = record.mode & TYPE;
    if kind == LINK {
        Some(Text::new(
            "It is a symbolic link; links are not followed.",
            "シンボリックリンクです。リンクはたどりません。",
        ))
    } else if !ORDINARY.contains(&kind) {
        Some(Text::new("It is a device or a pipe, not a file.", "ファイルではなく、デバイスやパイプです。"))
    } else if record.is_encrypted() {
        Some(Text::new("It is encrypted.", "暗号化されています。"))
    } else {
        None
    }
}

/// Two members of one name: nobody can tell which of them is meant, unless they are the same.
fn mark_duplicates(records: &[ArchiveRecord], flaws: &mut [Option<Text>]) {
    let mut first_of: HashMap<Vec<String>, usize> = HashMap::new();
    for (at, record) in records.iter().enumerate().filter(|(_, record)| !record.is_folder()) {
        let Ok(path) = name::path(&record.name) else { continue };
        let first = *first_of.entry(path).or_insert(at);
        if first == at {
            continue;
        }
        let is_same = (record.crc, record.size) == (records[first].crc, records[first].size);
        if !is_same {
            flaws[first].get_or_insert_with(two_contents);
        }
        flaws[at].get_or_insert_with(if is_same { taken } else { two_contents });
    }
}

/// Members that share bytes of the archive: no archiver makes them, and a small archive becomes endless by them.
fn mark_overlaps(records: &[ArchiveRecord], flaws: &mut [Option<Text>]) {
    let end = |record: &ArchiveRecord| {
        let header = super::record::LOCAL as u64 + record.raw_name.len() as u64;
        record.start.saturating_add(header).saturating_add(record.compressed)
    };
    let mut order: Vec<usize> = (0..records.len()).collect();
    order.sort_by_key(|&at| records[at].start);
    let mut furthest: Option<usize> = None;
    for at in order {
        if let Some(before) = furthest.filter(|&before| end(&records[before]) > records[at].start) {
            for overlapping in [before, at] {
                flaws[overlapping].get_or_insert_with(|| {
                    Text::new(
                        "It shares its bytes with another member of the archive.",
                        "アーカイブ内の別のファイルとデータの範囲が重なっています。",
                    )
                });
            }
        }
        if furthest.is_none_or(|before| end(&records[before]) <= end(&records[at])) {
            furthest = Some(at);
        }
    }
}

/// The second member of a name that is taken.
pub(super) fn taken() -> Text {
    Text::new(
        "A member of this name came before; the first one counts.",
        "同じ名前のファイルがすでにあります。最初のものを使います。",
    )
}

fn two_contents() -> Text {
    Text::new("The archive has two different files of this name.", "同じ名前で内容の異なるファイルが 2 つあります。")
}
