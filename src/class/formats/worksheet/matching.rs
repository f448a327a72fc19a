//! Whose each row of a worksheet is.
//!
//! Participants are told apart by their numbers, never by their names. Where groups hand in, the download has a group's
//! name and a number that counts groups, which may be some participant's by accident; the worksheet has participants and
//! a column with their group. There the name of the group is what both have. Up to Moodle 4.0 such a download has
//! `GROUP-NAME` and the participant's number: then number, group and name must agree.

use super::sheet::{Worksheet, WorksheetPerson};
use crate::class::formats::feedback::Recipient;
use crate::class::{Class, ClassEntry};
use crate::intake::Participant;
use std::collections::{BTreeSet, HashMap};
use unicode_normalization::UnicodeNormalization;

/// What Moodle up to 4.0 puts for a name under blind marking.
pub(super) const BLIND: [&str; 2] = ["Participant", "参加者"];

/// What was found for a row.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Match<'a> {
    /// The only submission that can be this person's.
    Of(&'a ClassEntry),
    /// Submissions among which nothing tells which one is.
    Several(Vec<&'a ClassEntry>),
    Nobody,
}

/// The submissions of a class by what a worksheet knows of them.
#[derive(Debug)]
pub(super) struct Matching<'a> {
    by_number: HashMap<u64, Vec<&'a ClassEntry>>,
    /// Only where groups hand in.
    groups: Option<Groups<'a>>,
    /// Whether the download is one of groups and the worksheet is not.
    pub is_of_other_kind: bool,
}

/// Groups by their names as a download has them.
#[derive(Debug)]
struct Groups<'a> {
    submissions: HashMap<String, Vec<&'a ClassEntry>>,
    /// The names in the worksheet that become this one.
    names: HashMap<String, BTreeSet<String>>,
}

impl<'a> Matching<'a> {
    pub fn new(class: &'a Class, sheet: &Worksheet) -> Self {
        let mut by_number: HashMap<u64, Vec<&ClassEntry>> = HashMap::new();
        let mut submissions: HashMap<String, Vec<&ClassEntry>> = HashMap::new();
        let mut has_default_group = false;
        for entry in &class.entries {
            let Some(Participant { name, number }) = &entry.student.moodle else { continue };
            submissions.entry(as_in_archive(name)).or_default().push(entry);
            match number {
                Some(number) => by_number.entry(*number).or_default().push(entry),
                None => has_default_group = true,
            }
        }
        let is_of_groups = sheet.columns.group.is_some();
        let is_of_other_kind = has_default_group && !is_of_groups;
        if is_of_other_kind {
            by_number.clear();
        }
        let mut names: HashMap<String, BTreeSet<String>> = HashMap::new();
        for group in sheet.rows.iter().filter_map(|row| sheet.person(row)?.ok()?.group) {
            names.entry(as_in_archive(&group)).or_default().insert(group);
        }
        Self { by_number, groups: is_of_groups.then_some(Groups { submissions, names }), is_of_other_kind }
    }

    /// Whose submission stands for this person.
    pub fn of(&self, person: &WorksheetPerson) -> Match<'a> {
        let by_number = self.by_number.get(&person.number).map(Vec::as_slice).unwrap_or_default();
        let Some(groups) = &self.groups else { return only(by_number) };
        let group = person.group.as_deref().unwrap_or_default();
        let names = person.name.iter().map(String::as_str).chain(BLIND);
        let own: Vec<String> = names.map(|name| as_in_archive(&format!("{group}-{name}"))).collect();
        let is_own = |entry: &&&ClassEntry| {
            entry.student.moodle.as_ref().is_some_and(|moodle| own.contains(&as_in_archive(&moodle.name)))
        };
        let agreeing: Vec<&ClassEntry> = by_number.iter().filter(is_own).copied().collect();
        if !agreeing.is_empty() {
            return only(&agreeing);
        }
        let name = as_in_archive(group);
        let entries = groups.submissions.get(&name).map(Vec::as_slice).unwrap_or_default();
        match groups.names.get(&name) {
            Some(names) if names.len() > 1 && !entries.is_empty() => Match::Several(entries.to_vec()),
            _ => only(entries),
        }
    }

    /// Whether the number of this recipient is nobody else's.
    pub fn is_only(&self, recipient: &Recipient) -> bool {
        self.by_number.get(&recipient.number).is_some_and(|entries| entries.len() == 1)
    }
}

fn only<'a>(entries: &[&'a ClassEntry]) -> Match<'a> {
    match entries {
        [] => Match::Nobody,
        [entry] => Match::Of(entry),
        several => Match::Several(several.to_vec()),
    }
}

/// A group's name as Moodle puts it into a download: an ampersand is escaped (`format_string`), what files must not have is
/// taken out (`PARAM_FILE`), `_` becomes a blank, and the archiver makes `_` of the rest. Two names that come out the same
/// cannot be told apart there.
fn as_in_archive(name: &str) -> String {
    if Participant::DEFAULT_GROUP.contains(&name) {
        return Participant::DEFAULT_GROUP[0].into();
    }
    let mut text = String::with_capacity(name.len());
    for (at, c) in name.char_indices() {
        match c {
            '&' if !is_entity(&name[at + 1..]) => text.push_str("amp;"),
            '&' | '<' | '>' | '"' | '`' | '|' | '\'' | ':' | '\\' | '/' => {}
            c if c.is_control() => {}
            '_' | '*' | '?' => text.push(' '),
            c => text.push(c),
        }
    }
    text.trim().nfc().collect()
}

/// Whether Moodle takes what follows a `&` for an entity.
fn is_entity(rest: &str) -> bool {
    rest.split_once(';').is_some_and(|(name, _)| {
        (1..=8).contains(&name.len()) && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'#')
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_compared_as_the_download_has_them() {
        for (worksheet, archive) in [
            ("チーム赤", "チーム赤"),
            ("A_1", "A 1"),
            ("Who?", "Who_"),
            ("R&D / \"x\": 1|2", "Ramp;D  x 12"),
            ("AT&amp;T", "ATamp;T"),
            ("か\u{3099}", "が"),
            ("Default group", "デフォルトグループ"),
        ] {
            assert_eq!(as_in_archive(worksheet), as_in_archive(archive), "{worksheet}");
        }
        assert_ne!(as_in_archive("A 1"), as_in_archive("A 10"));
    }
}
