//! How a run begins: in a new folder, where an earlier run stopped, or in place of one.

use super::journal::{self, FoundJournal, JournalHeader, JournalRecord, UnreadableJournal};
use crate::class::folder::{OutputFolder, page_file, portrait_file};
use crate::class::formats::{ClassFormat, KEY};
use crate::class::output::Wants;
use crate::class::roll::GradingCandidate;
use crate::class::{ClassEntry, Outcome};
use crate::fault::Fault;
use crate::language::Text;
use clap::ValueEnum;
use std::collections::HashSet;
use std::path::Path;

/// What is wanted where the folder has results already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ResumeMode {
    /// Leave it alone.
    New,
    /// Go on.
    Resume,
    /// Begin anew.
    Force,
}

/// Why a run cannot begin as it is wanted.
#[derive(Debug)]
pub enum NotBegun {
    /// The command line does not fit what is in the folder.
    Usage(Text),
    /// It cannot be read or written.
    Fault(Fault),
}

impl From<Fault> for NotBegun {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

/// The earlier results that this run goes on from; `None` where it begins anew.
pub fn earlier(folder: &OutputFolder, shown: &Path, mode: ResumeMode) -> Result<Option<FoundJournal>, NotBegun> {
    let path = folder.at(journal::NAME);
    match (journal::read(&path), mode) {
        (Err(UnreadableJournal::Missing), _) => Ok(None),
        (Err(UnreadableJournal::Fault(fault)), _) => Err(NotBegun::Fault(fault)),
        (Err(UnreadableJournal::Foreign(_)), ResumeMode::Force) => {
            clear(folder, &[])?;
            Ok(None)
        }
        (Err(UnreadableJournal::Foreign(text)), _) => Err(NotBegun::Usage(text)),
        (Ok(_), ResumeMode::New) => Err(NotBegun::Usage(occupied(shown))),
        (Ok(found), ResumeMode::Resume) => Ok(Some(found)),
        (Ok(found), ResumeMode::Force) => {
            clear(folder, &found.records)?;
            Ok(None)
        }
    }
}

/// A candidate's entry by an earlier result, where that is still this hand-in's: the same bytes under the same names,
/// graded, and with the files that are wanted.
pub fn kept(
    candidate: &GradingCandidate,
    record: &JournalRecord,
    folder: &OutputFolder,
    wants: Wants,
) -> Option<ClassEntry> {
    let Outcome::Graded(report) = &record.outcome else { return None };
    let names = candidate.files()?.files.iter().map(|file| &file.name);
    if record.sha256 != candidate.sha256 || !report.sources.iter().map(|source| &source.name).eq(names) {
        return None;
    }
    let key = &candidate.hand_in.student.key;
    let has_portrait = wants.portraits && report.verdict.is_drawn();
    let portrait = match has_portrait {
        true => Some(folder.read(&portrait_file(key)).ok().flatten()?),
        false => None,
    };
    let page = page_file(key);
    let page = match wants.pages {
        true => Some(folder.has(&page).then(|| folder.at(&page))?),
        false => None,
    };
    Some(candidate.entry(record.outcome.clone(), portrait, page))
}

/// Refuses to mix results that were graded otherwise with those that are wanted.
pub fn same_conditions(shown: &Path, found: &JournalHeader, wanted: &JournalHeader) -> Result<(), NotBegun> {
    let differences = differences(found, wanted);
    if differences.is_empty() { Ok(()) } else { Err(NotBegun::Usage(mixed(shown, &differences))) }
}

/// What was graded otherwise, as options of the command line.
fn differences(found: &JournalHeader, wanted: &JournalHeader) -> Vec<Text> {
    let mut differences = Vec::new();
    let mut compare = |what: Text, found: String, wanted: String| {
        if found != wanted {
            differences.push(Text::new(
                format!("{}: was {found}, is {wanted}", what.en),
                format!("{}: 前回 {found}、今回 {wanted}", what.ja),
            ));
        }
    };
    let option = |name: &str| Text::verbatim(format!("--{name}"));
    compare(Text::new("version of ggrade", "ggrade のバージョン"), found.ggrade.clone(), wanted.ggrade.clone());
    compare(option("assignment"), found.assignment.clone(), wanted.assignment.clone());
    if !found.assignment_digest.is_empty() {
        let short = |digest: &str| digest.chars().take(12).collect::<String>();
        let what = Text::new("files of the assignment (digest)", "課題のファイル (ダイジェスト)");
        compare(what, short(&found.assignment_digest), short(&wanted.assignment_digest));
    }
    compare(option("seed"), found.seed.to_string(), wanted.seed.to_string());
    compare(option("hints"), name(&found.hints), name(&wanted.hints));
    compare(option("deadline"), found.deadline.to_string(), wanted.deadline.to_string());
    compare(option("adapter"), found.adapter.clone(), wanted.adapter.clone());
    compare(option("lang"), name(&found.language), name(&wanted.language));
    compare(option("anonymous"), found.anonymous.to_string(), wanted.anonymous.to_string());
    let shard = |header: &JournalHeader| header.shard.map_or_else(|| "-".to_owned(), |shard| shard.to_string());
    compare(option("shard"), shard(found), shard(wanted));
    differences
}

fn mixed(shown: &Path, differences: &[Text]) -> Text {
    let path = shown.display();
    let join = |texts: Vec<&str>| texts.join("; ");
    let en = join(differences.iter().map(|text| text.en.as_str()).collect());
    let ja = join(differences.iter().map(|text| text.ja.as_str()).collect());
    Text::new(
        format!(
            "the results in {path} were graded otherwise ({en}). Use the same options, or grade into another folder and \
             --compare, or begin anew with --force"
        ),
        format!(
            "{path} の結果は異なる条件で採点されています ({ja})。同じオプションを指定するか、別のフォルダに採点して \
             --compare で比べるか、--force で最初からやり直してください"
        ),
    )
}

/// What is said where `--resume` finds the results of other students.
pub fn other_class(shown: &Path) -> Text {
    let path = shown.display();
    Text::new(
        format!("the results in {path} are of another class: none of its students is in the input"),
        format!("{path} にあるのは別のクラスの結果です (入力に同じ学生が 1 人もいません)"),
    )
}

/// Takes away what earlier runs wrote of students who are not in the class.
pub fn forget(folder: &OutputFolder, records: &[JournalRecord], keys: &HashSet<&str>) -> Result<(), Fault> {
    for record in records.iter().filter(|record| !keys.contains(record.student.key.as_str())) {
        remove_student(folder, &record.student.key)?;
    }
    Ok(())
}

/// Takes away all that a run writes, but the key of the pseudonyms.
fn clear(folder: &OutputFolder, records: &[JournalRecord]) -> Result<(), Fault> {
    for record in records {
        remove_student(folder, &record.student.key)?;
    }
    let formats = ClassFormat::value_variants().iter().flat_map(|format| format.files());
    for file in formats.filter(|file| !file.contains(KEY)) {
        folder.remove(file)?;
    }
    folder.remove(super::changes::NAME)?;
    // Last: what is there without it would be nobody's.
    folder.remove(journal::NAME)
}

fn remove_student(folder: &OutputFolder, key: &str) -> Result<(), Fault> {
    // The journal is a file that others may have written: a key is no path.
    if key.is_empty() || key.contains('/') {
        return Ok(());
    }
    folder.remove(&page_file(key))?;
    folder.remove(&portrait_file(key))?;
    let formats = ClassFormat::value_variants().iter().flat_map(|format| format.files());
    formats.filter(|file| file.contains(KEY)).try_for_each(|file| folder.remove(&file.replace(KEY, key)))
}

fn occupied(shown: &Path) -> Text {
    let path = shown.display();
    Text::new(
        format!(
            "{path} has results already: --resume goes on with them, --force begins anew in their place, and another \
             --out leaves them alone"
        ),
        format!(
            "{path} にはすでに採点結果があります。続きから採点するには --resume、最初からやり直すには --force、\
             残しておくには別の --out を指定してください"
        ),
    )
}

/// What serde calls a value, which is what the command line calls it.
fn name(value: &impl serde::Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(name)) => name,
        other => format!("{other:?}"),
    }
}
