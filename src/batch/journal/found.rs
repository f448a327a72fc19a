//! A journal read back: its header, and what became of each student as far as the lines are whole.

use super::{JournalHeader, JournalRecord, SCHEMA};
use crate::class::folder::unreadable;
use crate::fault::Fault;
use crate::language::Text;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

/// A journal as it is found.
#[derive(Clone, Debug)]
pub struct FoundJournal {
    /// Its first line.
    pub header: JournalHeader,
    /// One record a student, the last where there are several.
    pub records: Vec<JournalRecord>,
    /// Lines that cannot be read, such as a torn one at the end.
    pub torn: usize,
}

/// Why there is nothing to be had of a journal.
#[derive(Debug)]
pub enum UnreadableJournal {
    /// There is no such file.
    Missing,
    /// It is something else, or of another version: what its first line says.
    Foreign(Text),
    /// It cannot be read.
    Fault(Fault),
}

/// Reads a journal.
pub fn read(path: &Path) -> Result<FoundJournal, UnreadableJournal> {
    let failed = |error: io::Error| match error.kind() {
        io::ErrorKind::NotFound => UnreadableJournal::Missing,
        _ => UnreadableJournal::Fault(unreadable(path, &error)),
    };
    let mut lines = BufReader::new(File::open(path).map_err(failed)?).split(b'\n');
    let first = lines.next().transpose().map_err(failed)?.unwrap_or_default();
    let header: JournalHeader =
        serde_json::from_slice(&first).map_err(|_| UnreadableJournal::Foreign(foreign(path, &first)))?;
    if header.schema != SCHEMA {
        return Err(UnreadableJournal::Foreign(foreign(path, &first)));
    }
    let mut records: Vec<JournalRecord> = Vec::new();
    let mut places = std::collections::HashMap::new();
    let mut torn = 0;
    for line in lines {
        let line = line.map_err(failed)?;
        let Ok(record) = serde_json::from_slice::<JournalRecord>(&line) else {
            torn += 1;
            continue;
        };
        match places.get(&record.student.key) {
            Some(&place) => records[place] = record,
            None => {
                places.insert(record.student.key.clone(), records.len());
                records.push(record);
            }
        }
    }
    Ok(FoundJournal { header, records, torn })
}

fn foreign(path: &Path, first: &[u8]) -> Text {
    let path = path.display();
    let schema = serde_json::from_slice::<serde_json::Value>(first).ok();
    let schema = schema.as_ref().and_then(|value| value.get("schema")?.as_str()).unwrap_or("none");
    let schema: String = schema.chars().filter(|c| !c.is_control()).take(60).collect();
    Text::new(
        format!("{path} is no journal of `ggrade batch` (schema {SCHEMA} is wanted, found: {schema})"),
        format!("{path} は `ggrade batch` の結果ファイルではありません (必要なスキーマ: {SCHEMA}、実際: {schema})"),
    )
}
