//! Who is in a download, and what stands for each.

use super::participants::participants;
use super::{DownloadSelection, Pick};
use crate::class::roll::roll;
use crate::class::{Class, Outcome};
use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::intake::{FileLocation, HandInContent, Participant, Refused, Student, StudentWork, portable};
use crate::language::{Language, Text};
use crate::service::State;
use crate::service::classes::people::{Person, people};
use crate::service::errors::Problem;
use crate::service::store::{ClassRow, StoredSubmission};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// One student of a class, with what stands for them.
pub(super) struct ClassMember {
    pub(super) student: Student,
    pub(super) path: Option<String>,
    pub(super) stored: Option<StoredSubmission>,
    pub(super) hand_in: HandIn,
    pub(super) note: Option<Text>,
}

/// Everyone of a download. Moodle's worksheet says who of the class its participants are; those of an archive are known.
pub(super) async fn members(
    state: &State,
    whose: DownloadSelection,
    sheet: Option<&[u8]>,
) -> Result<(String, Vec<Refused>, Vec<ClassMember>), Problem> {
    match whose {
        DownloadSelection::Batch(batch) => {
            let mut members = Vec::new();
            for entry in state.store.batch_entries(&batch.id).await? {
                let (stored, hand_in) = with_files(state, entry.submission_id.as_deref()).await?;
                members.push(ClassMember {
                    student: entry.student,
                    path: entry.path,
                    stored,
                    hand_in,
                    note: entry.note,
                });
            }
            Ok((batch.title, batch.refused, members))
        }
        DownloadSelection::Students(pick) => {
            let mut members: Vec<ClassMember> = Vec::new();
            let mut keys = HashSet::new();
            let roster = state.store.roster().await?.into_iter();
            let mut emails: HashMap<String, String> = roster.map(|student| (student.id, student.email)).collect();
            let mut participants = match sheet {
                Some(sheet) => participants(state, sheet).await?,
                None => HashMap::new(),
            };
            for person in people(state).await?.class {
                let chosen = chosen(&person, pick).or(person.rows.first());
                let (stored, hand_in) = with_files(state, chosen.map(|row| row.row.submission.id.as_str())).await?;
                let path = stored.as_ref().map(|stored| stored.submission.name.clone());
                let moodle = participants.remove(&person.key).or(person.moodle);
                let email = emails.remove(&person.key).filter(|email| !email.is_empty());
                let student = student(person.number, person.name, moodle, &person.key, &mut keys);
                let student = Student { email, ..student };
                members.push(ClassMember { student, path, stored, hand_in, note: person.note });
            }
            members.sort_by(|a, b| a.student.key.cmp(&b.student.key));
            Ok((state.assignment.id.clone(), Vec::new(), members))
        }
    }
}

/// Somebody of the class as files name them, and as files can be named; who has no number is told apart by a part of what is known of
/// them.
pub(super) fn student(
    number: String,
    name: String,
    moodle: Option<Participant>,
    key: &str,
    keys: &mut HashSet<String>,
) -> Student {
    let known = if number.is_empty() { format!("browser-{}", key.chars().take(8).collect::<String>()) } else { number };
    let name = if name.is_empty() { known.clone() } else { name };
    let plain = portable(&known);
    let mut key = plain.clone();
    for time in 2.. {
        if keys.insert(key.to_ascii_lowercase()) {
            break;
        }
        key = format!("{plain}.{time}");
    }
    Student { key, name, moodle, email: None }
}

/// The submission that counts.
pub(super) fn chosen(person: &Person, pick: Pick) -> Option<&ClassRow> {
    match pick {
        Pick::Latest => person.rows.iter().find(|row| row.row.score.is_some()),
        Pick::Counted => person.counted(),
        Pick::Best => person.best(),
    }
}

pub(super) async fn with_files(state: &State, id: Option<&str>) -> Result<(Option<StoredSubmission>, HandIn), Problem> {
    let Some(id) = id else { return Ok((None, HandIn::default())) };
    let Some(stored) = state.store.stored(id).await? else { return Ok((None, HandIn::default())) };
    let hand_in = state.store.hand_in(id).await?.unwrap_or_default();
    Ok((Some(stored), hand_in))
}

pub(super) fn class(
    state: &State,
    title: String,
    refused: Vec<Refused>,
    members: Vec<ClassMember>,
    portraits: Vec<Option<Vec<u8>>>,
    language: Language,
) -> Result<Class, Fault> {
    let nobody = || Text::new("nothing was handed in", "提出がありません");
    let mut outcomes = Vec::new();
    let mut hand_ins = Vec::new();
    for member in members {
        let ClassMember { student, path, stored, hand_in, note } = member;
        let content = match &stored {
            Some(_) => HandInContent::Files { places: places(path, &hand_in), hand_in },
            None => HandInContent::Nothing(note.unwrap_or_else(nobody)),
        };
        outcomes.push(stored.map(outcome));
        hand_ins.push(StudentWork { student, content });
    }
    let candidates = roll(hand_ins, Vec::new(), &state.assignment).candidates;
    let entries = candidates.iter().zip(outcomes).zip(portraits).map(|((candidate, outcome), portrait)| {
        candidate.entry(outcome.unwrap_or_else(|| candidate.nothing()), portrait, None)
    });
    Ok(Class {
        assignment: Arc::clone(&state.assignment),
        title,
        entries: entries.collect(),
        refused,
        expected_portrait: state.right.portraits()?.expected.clone(),
        language,
    })
}

/// Where the files were: the paths that an archive's list has in one line, or else their names.
pub(super) fn places(path: Option<String>, hand_in: &HandIn) -> Vec<FileLocation> {
    let names: Vec<&str> = hand_in.files.iter().map(|file| file.name.as_str()).collect();
    let equal = |path| Some(str::split(path, ", ").collect()).filter(|parts: &Vec<&str>| parts.len() == names.len());
    let paths = path.as_deref().and_then(|path| split(path, &names).or_else(|| equal(path)));
    let paths = paths.unwrap_or(names);
    paths.into_iter().map(|path| FileLocation { path: path.to_owned(), local: None }).collect()
}

/// The paths of files with these names, of which [`FileLocation::joined`] has made one line. A folder or a name may have in it what
/// stands between two of them.
pub(super) fn split<'a>(joined: &'a str, names: &[&str]) -> Option<Vec<&'a str>> {
    let [name, rest @ ..] = names else { return None };
    if rest.is_empty() {
        return Some(vec![joined]);
    }
    let is_named = |path: &str| path.rsplit('/').next() == Some(*name);
    joined.match_indices(", ").find_map(|(end, between)| {
        let path = &joined[..end];
        let further = split(&joined[end + between.len()..], rest).filter(|_| is_named(path))?;
        Some([vec![path], further].concat())
    })
}

pub(super) fn outcome(stored: StoredSubmission) -> Outcome {
    match (stored.report, stored.submission.fault) {
        (Some(report), _) => Outcome::Graded(Box::new(report)),
        (None, Some(fault)) => Outcome::Fault(fault),
        (None, None) => Outcome::NotGraded(Text::new("not graded yet", "まだ採点していません")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_in::HandedInFile;

    #[test]
    fn whatever_number_somebody_has_is_a_file_of_theirs_alone() {
        let mut keys = HashSet::new();
        let mut key = |number: &str| student(number.to_owned(), String::new(), None, "k", &mut keys);
        for (number, expected) in [("S1", "S1"), ("..", ".._"), ("CON", "_CON"), ("T1.", "T1._"), ("T1._", "T1._.2")] {
            let student = key(number);
            assert_eq!((student.key.as_str(), student.name.as_str()), (expected, number));
        }
    }

    #[test]
    fn each_file_has_its_own_path_whatever_its_folder_is_called() {
        let found = |path: Option<&str>, names: &[&str]| {
            let files = names.iter().map(|name| HandedInFile::new(*name, "")).collect();
            places(path.map(str::to_owned), &HandIn { files }).into_iter().map(|place| place.path).collect::<Vec<_>>()
        };
        let both = ["a.vert", "a.frag"];
        assert_eq!(found(Some("S1/a.vert, S1/a.frag"), &both), ["S1/a.vert", "S1/a.frag"]);
        assert_eq!(
            found(Some("Smith, Ann_1/a.vert, Smith, Ann_1/a.frag"), &both),
            ["Smith, Ann_1/a.vert", "Smith, Ann_1/a.frag"]
        );
        assert_eq!(found(Some("x, y.vert, a.frag"), &["x, y.vert", "a.frag"]), ["x, y.vert", "a.frag"]);
        assert_eq!(found(Some("Smith, Ann/a.vert"), &both[..1]), ["Smith, Ann/a.vert"]);
        // Two files of one name are stored under those of their slots.
        assert_eq!(found(Some("S1/a/x.txt, S1/b/x.txt"), &both), ["S1/a/x.txt", "S1/b/x.txt"]);
        assert_eq!(found(None, &both), both);
    }
}
