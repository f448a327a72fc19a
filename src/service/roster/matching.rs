//! Who of the roster an entry of an archive is.
//!
//! A student number, Moodle's number and the name each may say who it is, whatever their width, case and spaces. Where
//! two of them say different people, or one of them could be two people, nobody is taken: a file that counts for the
//! wrong student is worse than one that is shown apart.

use crate::intake::{Student as Entry, is_blind};
use crate::service::identity::normal_number;
use crate::service::store::StudentRecord;
use std::collections::{HashMap, HashSet};
use unicode_normalization::UnicodeNormalization;

/// The roster, by what tells its students apart.
#[derive(Debug, Default)]
pub struct Matcher {
    numbers: HashMap<String, String>,
    /// By Moodle's number, with the keys of the name.
    participants: HashMap<u64, (String, HashSet<String>)>,
    /// Everyone with a name of this key.
    names: HashMap<String, HashSet<String>>,
}

impl Matcher {
    /// The roster's students.
    pub fn new(roster: &[StudentRecord]) -> Self {
        let mut matcher = Self::default();
        for student in roster {
            matcher.numbers.insert(student.number.clone(), student.id.clone());
            let keys = name_keys(&student.name);
            if let Some(number) = student.moodle.and_then(|number| u64::try_from(number).ok()) {
                matcher.participants.insert(number, (student.id.clone(), keys.clone()));
            }
            for key in keys {
                matcher.names.entry(key).or_default().insert(student.id.clone());
            }
        }
        matcher
    }

    /// Ids of the students that the entries of one archive are, in their order. Two entries are never one student.
    pub fn of_batch<'a>(&self, entries: impl Iterator<Item = (&'a Entry, Option<&'a str>)>) -> Vec<Option<String>> {
        let found: Vec<Option<&String>> = entries.map(|(entry, path)| self.of(entry, path)).collect();
        let mut times: HashMap<&String, usize> = HashMap::new();
        for id in found.iter().flatten() {
            *times.entry(id).or_default() += 1;
        }
        found.iter().map(|id| id.filter(|id| times[id] == 1).cloned()).collect()
    }

    /// Whether a path of an archive names a student: their number or their name stands in it.
    pub fn path_names(&self, path: &str, id: &str) -> bool {
        path.split('/').any(|part| {
            let part = part.split("_assignsubmission_").next().unwrap_or_default();
            let without_number = part.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('_');
            self.by_number(part).into_iter().any(|found| found == id)
                || [part, without_number]
                    .into_iter()
                    .flat_map(name_keys)
                    .any(|key| self.names.get(&key).is_some_and(|ids| ids.contains(id)))
        })
    }

    fn of(&self, entry: &Entry, path: Option<&str>) -> Option<&String> {
        let keys = name_keys(&self.without_numbers(&entry.name));
        let mut found: HashSet<&String> = self.by_number(&entry.name);
        match &entry.moodle {
            // Moodle's own number stands in the path; the student's is in the name, where the site shows it there.
            Some(participant) => {
                if let Some((id, known)) = participant.number.and_then(|number| self.participants.get(&number))
                    && (is_blind(&participant.name) || known.is_empty() || !known.is_disjoint(&keys))
                {
                    found.insert(id);
                }
            }
            None => {
                let file = path.and_then(|path| path.rsplit('/').next()).unwrap_or_default();
                found.extend(self.by_number(file));
            }
        }
        let named: HashSet<&String> = keys.iter().filter_map(|key| self.names.get(key)).flatten().collect();
        match (found.len(), named.len()) {
            (0, 1) => named.into_iter().next(),
            // Of two students with one name, the number says which.
            (1, 0) => found.into_iter().next(),
            (1, _) => found.into_iter().next().filter(|id| named.contains(id)),
            _ => None,
        }
    }

    /// A text without the words of it that are student numbers: its name.
    fn without_numbers(&self, text: &str) -> String {
        let narrow: String = text.nfkc().collect();
        let is_number = |word: &&str| normal_number(word).is_some_and(|number| self.numbers.contains_key(&number));
        narrow.split(|c: char| !c.is_alphanumeric()).filter(|word| !is_number(word)).collect::<Vec<_>>().join(" ")
    }

    /// Students whose number stands in a text by itself.
    fn by_number(&self, text: &str) -> HashSet<&String> {
        let narrow: String = text.nfkc().collect();
        let is_inside = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        let words = narrow.split(|c| !is_inside(c)).flat_map(|word| {
            let parts = word.split(['_', '.', '-']);
            std::iter::once(word).chain(word.split('_')).chain(word.split('.')).chain(parts)
        });
        words.filter_map(|word| self.numbers.get(&normal_number(word)?)).collect()
    }
}

/// What a name is compared by: its letters and digits without width, case and spaces, its words in any order.
fn name_keys(name: &str) -> HashSet<String> {
    let folded: String = name.nfkc().collect::<String>().to_lowercase();
    let mut words: Vec<&str> = folded.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let mut keys = HashSet::from([words.concat()]);
    words.reverse();
    keys.insert(words.concat());
    words.sort_unstable();
    keys.insert(words.concat());
    keys.remove("");
    keys
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intake::Participant;

    fn student(number: &str, name: &str, moodle: Option<i64>) -> StudentRecord {
        StudentRecord {
            id: format!("id-{number}"),
            number: number.into(),
            name: name.into(),
            on_roster: 1,
            moodle,
            code_generation: 0,
            group_name: String::new(),
            email: String::new(),
        }
    }

    fn folder(name: &str) -> Entry {
        Entry { key: name.into(), name: name.into(), moodle: None, email: None }
    }

    fn of_moodle(name: &str, number: u64) -> Entry {
        Entry {
            key: number.to_string(),
            name: name.into(),
            moodle: Some(Participant { name: name.into(), number: Some(number) }),
            email: None,
        }
    }

    fn roster() -> Matcher {
        Matcher::new(&[
            student("S1001", "和田 花子", None),
            student("S1002", "Smith, John", None),
            student("S1003", "鈴木 一郎", Some(77)),
            student("S1004", "鈴木 一郎", Some(78)),
            student("101", "Ｙａｍａｄａ　Ｔａｒｏ", None),
        ])
    }

    fn found(entry: &Entry, path: Option<&str>) -> Option<String> {
        roster().of(entry, path).cloned()
    }

    #[test]
    fn a_number_or_a_name_says_who_it_is_however_it_is_written() {
        for name in [
            "S1001",
            "s1001",
            "ｓ１００１",
            "s1001 和田花子",
            "S1001_wada",
            "和田花子",
            "花子　和田",
            "和田 花子 (s1001)",
        ] {
            assert_eq!(found(&folder(name), None).as_deref(), Some("id-S1001"), "{name}");
        }
        for name in ["John Smith", "SMITH John", "smith-john"] {
            assert_eq!(found(&folder(name), None).as_deref(), Some("id-S1002"), "{name}");
        }
        assert_eq!(found(&folder("x"), Some("class.zip/x/S1001.vert")).as_deref(), Some("id-S1001"));
        assert_eq!(found(&of_moodle("yamada taro", 9), None).as_deref(), Some("id-101"));
    }

    #[test]
    fn what_could_be_two_people_is_nobody() {
        assert_eq!(found(&folder("鈴木 一郎"), None), None, "two have this name");
        assert_eq!(found(&folder("S1001 John Smith"), None), None, "two different people");
        assert_eq!(found(&folder("S1001 S1002"), None), None);
        assert_eq!(found(&folder("S10011"), None), None);
        assert_eq!(found(&folder("2012345_Yamada Taro"), None), None, "another number");
        // Moodle's number 101 is nobody's student number.
        assert_eq!(
            found(&of_moodle("佐藤 花子", 101), Some("a.zip/佐藤 花子_101_assignsubmission_file_/x.vert")),
            None
        );
        let twice = [folder("S1001"), folder("和田 花子"), folder("S1002")];
        let ids = roster().of_batch(twice.iter().map(|entry| (entry, None)));
        assert_eq!(ids, [None, None, Some("id-S1002".to_owned())]);
    }

    #[test]
    fn moodles_number_tells_two_of_one_name_apart() {
        assert_eq!(found(&of_moodle("鈴木 一郎", 77), None).as_deref(), Some("id-S1003"));
        assert_eq!(found(&of_moodle("鈴木 一郎", 79), None), None);
        assert_eq!(found(&of_moodle("Participant", 78), None).as_deref(), Some("id-S1004"), "blind marking");
        assert_eq!(found(&of_moodle("山本 次郎", 77), None), None, "the name of somebody else");
    }

    #[test]
    fn a_path_is_recognised_by_who_it_names() {
        let roster = roster();
        assert!(roster.path_names("a.zip/和田 花子_12_assignsubmission_file_/../x", "id-S1001"));
        assert!(roster.path_names("a.zip/s1001/x.exe", "id-S1001"));
        assert!(!roster.path_names("a.zip/s1002/x.exe", "id-S1001"));
    }
}
