//! A class in parts, graded on several machines: each part is a run of its own, and their results make one class.
//!
//! Every shard reads the whole input, because who shares an answer is a fact about the whole class. It grades its own
//! students only. Hand-ins that need one grading are in one shard.

use super::journal::{self, FoundJournal, JournalRecord, UnreadableJournal};
use super::resume::NotBegun;
use crate::class::folder::{OutputFolder, page_file, portrait_file};
use crate::class::roll::{GradingCandidate, groups};
use crate::fault::Fault;
use crate::language::Text;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// One of several parts of a class, written `3/8`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Shard {
    /// Which part, from 1.
    number: usize,
    /// How many parts there are.
    count: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers =
            text.split_once('/').and_then(|(number, count)| Some((number.parse().ok()?, count.parse().ok()?)));
        match numbers {
            Some((number, count)) if (1..=count).contains(&number) => Ok(Self { number, count }),
            _ => Err("a shard is its number from 1 and how many there are, such as 3/8".into()),
        }
    }
}

impl TryFrom<String> for Shard {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

impl Shard {
    /// The students of this shard, in the order of the class.
    pub fn of(self, candidates: Vec<GradingCandidate>) -> Vec<GradingCandidate> {
        let all: Vec<usize> = (0..candidates.len()).collect();
        let mut is_ours = vec![false; candidates.len()];
        // In turns, because students who stand side by side in a class often hand in at the same pace.
        for group in groups(&candidates, &all).iter().skip(self.number - 1).step_by(self.count) {
            group.iter().for_each(|&index| is_ours[index] = true);
        }
        candidates.into_iter().zip(is_ours).filter_map(|(candidate, is_ours)| is_ours.then_some(candidate)).collect()
    }
}

/// Copies the files of all shards' students into `folder`, and gives what all journals say as one.
pub fn gather(folder: &OutputFolder, shards: &[PathBuf]) -> Result<FoundJournal, NotBegun> {
    let mut found: Vec<(&Path, FoundJournal)> = Vec::new();
    for path in shards {
        let journal = journal::read(&path.join(journal::NAME)).map_err(|error| match error {
            UnreadableJournal::Missing => no_results(path),
            UnreadableJournal::Foreign(text) => NotBegun::Usage(text),
            UnreadableJournal::Fault(fault) => NotBegun::Fault(fault),
        })?;
        found.push((path, journal));
    }
    all_there(&found)?;
    let mut header = found[0].1.header.clone();
    header.shard = None;
    let mut whole = FoundJournal { header, records: Vec::new(), torn: 0 };
    for (path, journal) in found {
        for record in &journal.records {
            copy(folder, path, record)?;
        }
        whole.torn += journal.torn;
        whole.records.extend(journal.records);
    }
    Ok(whole)
}

/// Refuses results that are not of all shards of one class, each once.
fn all_there(found: &[(&Path, FoundJournal)]) -> Result<(), NotBegun> {
    let Some((first_path, first)) = found.first() else {
        let text = Text::new("name the folders of all shards", "すべての分割のフォルダを指定してください");
        return Err(NotBegun::Usage(text));
    };
    let mut missing: BTreeSet<Shard> = BTreeSet::new();
    if let Some(Shard { count, .. }) = first.header.shard {
        missing.extend((1..=count).map(|number| Shard { number, count }));
    }
    for (path, journal) in found {
        let Some(shard) = journal.header.shard else { return Err(not_a_shard(path)) };
        let alike = journal::JournalHeader { shard: first.header.shard, ..journal.header.clone() };
        super::resume::same_conditions(first_path, &first.header, &alike)?;
        if !missing.remove(&shard) {
            return Err(one_too_many(path, shard));
        }
    }
    if missing.is_empty() { Ok(()) } else { Err(missing_shards(&missing)) }
}

/// Copies what a run wrote of one student.
fn copy(folder: &OutputFolder, from: &Path, record: &JournalRecord) -> Result<(), Fault> {
    let key = &record.student.key;
    // The journal is a file that others may have written: a key is no path.
    if key.is_empty() || key.contains('/') {
        return Ok(());
    }
    for name in [page_file(key), portrait_file(key)] {
        match std::fs::read(from.join(&name)) {
            Ok(bytes) => drop(folder.write(&name, &bytes)?),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
            Err(error) => return Err(crate::class::folder::unreadable(&from.join(&name), &error)),
        }
    }
    Ok(())
}

fn no_results(path: &Path) -> NotBegun {
    let path = path.display();
    NotBegun::Usage(Text::new(
        format!("{path} has no results of a shard: it was not begun, or another folder is meant"),
        format!("{path} に分割採点の結果がありません。まだ採点していないか、フォルダが違います"),
    ))
}

fn not_a_shard(path: &Path) -> NotBegun {
    let path = path.display();
    NotBegun::Usage(Text::new(
        format!("{path} has the results of a whole class, not of a shard: there is nothing to merge"),
        format!("{path} は分割ではなくクラス全体の採点結果です。まとめる必要はありません"),
    ))
}

fn one_too_many(path: &Path, shard: Shard) -> NotBegun {
    let path = path.display();
    NotBegun::Usage(Text::new(
        format!("{path} is shard {shard}, which is there already or is one of another number of shards"),
        format!("{path} は分割 {shard} ですが、同じ分割がすでにあるか、分割数がほかと異なります"),
    ))
}

fn missing_shards(missing: &BTreeSet<Shard>) -> NotBegun {
    let list = missing.iter().map(Shard::to_string).collect::<Vec<_>>().join(", ");
    NotBegun::Usage(Text::new(
        format!("shards are missing: {list}. Grade them with --shard, or name their folders"),
        format!("足りない分割があります: {list}。--shard で採点するか、そのフォルダも指定してください"),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shard_is_a_number_among_how_many() {
        assert_eq!("3/8".parse(), Ok(Shard { number: 3, count: 8 }));
        assert_eq!(Shard { number: 3, count: 8 }.to_string(), "3/8");
        for wrong in ["", "3", "0/8", "9/8", "3/", "/8", "-1/2", "1/0", "1/2/3", "a/b"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
