//! The names in a Moodle download, from which its students are told apart.
//!
//! "Download all submissions" names everything `NAME_NUMBER_assignsubmission_PLUGIN`: a folder of that name with the
//! student's files in it (up to Moodle 4.0 with an `_` more behind it), or, where the teacher has switched folders off,
//! files of that name with `_` and the student's own file name behind it. NUMBER is the participant's in this
//! assignment; under blind marking NAME is the word for participant in the teacher's language. Where groups hand in,
//! NAME and NUMBER are a group's (up to Moodle 4.0 `GROUP-NAME` and the participant's), and those in no group have a name
//! without number.
//!
//! Moodle writes no `_` into a NAME, but the archiver makes one of `*`, `?` and some more.

use super::Participant;

const MARK: &str = "_assignsubmission_";
/// The words for a participant under blind marking, in the languages of the course.
const BLIND: [&str; 2] = ["Participant", "参加者"];

/// What the name of a folder or file in a Moodle download says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Marked<'a> {
    /// Whose it is.
    pub participant: Participant,
    /// The way of handing in: `file`, `onlinetext`.
    pub plugin: &'a str,
    /// The student's own file name; `None` for a folder.
    pub file_name: Option<&'a str>,
}

/// What the name of a file among those of all students says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Loose<'a> {
    /// Whose it is.
    Of(Marked<'a>),
    /// It can be read as each of these: a student's name, or a file's, looks like the beginning of another's.
    Unclear(Vec<Participant>),
}

/// Reads the name of a folder. All of it is Moodle's own making, so the last mark is the one that counts: a full name
/// may contain anything.
pub(super) fn folder(name: &str) -> Option<Marked<'_>> {
    if let Some((before, after)) = name.rsplit_once(MARK) {
        let plugin = after.strip_suffix('_').unwrap_or(after);
        return Some(Marked { participant: owner(before)?, plugin: plugin_name(plugin)?, file_name: None });
    }
    let participant = participant(name).filter(|participant| is_blind(&participant.name))?;
    Some(Marked { participant, plugin: "file", file_name: None })
}

/// Reads the name of a file among those of all students. Its end is one student's choice and its beginning, with a name
/// that has marks in it, may be another's: where that leaves two students, neither has handed it in.
pub(super) fn file(name: &str) -> Option<Loose<'_>> {
    loose(name, None)
}

/// The same of an archive: a student's own among loose files, or one that somebody has made of a student's folder.
pub(super) fn archive<'a>(name: &'a str, stem: &'a str) -> Option<Loose<'a>> {
    loose(name, folder(stem))
}

fn loose<'a>(name: &'a str, whole: Option<Marked<'a>>) -> Option<Loose<'a>> {
    let reading = |(at, mark): (usize, &str)| {
        let (plugin, file_name) = name[at + mark.len()..].split_once('_')?;
        Some(Marked {
            participant: owner(&name[..at])?,
            plugin: plugin_name(plugin)?,
            file_name: Some(file_name).filter(|name| !name.is_empty()),
        })
    };
    let mut readings: Vec<Marked> = name.match_indices(MARK).filter_map(reading).chain(whole).collect();
    let mut owners: Vec<Participant> = readings.iter().map(|reading| reading.participant.clone()).collect();
    owners.dedup_by_key(|owner| owner.number);
    match owners.len() {
        0 => None,
        1 => Some(Loose::Of(readings.swap_remove(0))),
        _ => Some(Loose::Unclear(owners)),
    }
}

/// The name shown of a participant.
pub(super) fn shown(participant: &Participant) -> String {
    let Participant { name, number } = participant;
    match number {
        Some(number) if name.is_empty() => number.to_string(),
        Some(number) if is_blind(name) => format!("{name} {number}"),
        _ => name.clone(),
    }
}

/// Name and number, to tell participants of one name apart.
pub(super) fn numbered(participant: &Participant) -> String {
    let Participant { name, number } = participant;
    number.map_or_else(|| name.clone(), |number| format!("{name} ({number})"))
}

/// Whose a name is that stands before a mark.
fn owner(text: &str) -> Option<Participant> {
    let default =
        || Participant::DEFAULT_GROUP.contains(&text).then(|| Participant { name: text.into(), number: None });
    participant(text).or_else(default)
}

/// `NAME_NUMBER`, or `PARTICIPANT NUMBER`, read from its end.
fn participant(text: &str) -> Option<Participant> {
    let digits = text.bytes().rev().take_while(u8::is_ascii_digit).count();
    let (before, number) = text.split_at(text.len() - digits);
    let number = number.parse().ok()?;
    let spaced = || before.strip_suffix(' ').filter(|name| is_blind(name));
    let name = before.strip_suffix('_').or_else(spaced)?;
    Some(Participant { name: name.into(), number: Some(number) })
}

/// Whether a name is the word for a participant, and nobody's own.
pub(crate) fn is_blind(name: &str) -> bool {
    BLIND.contains(&name)
}

fn plugin_name(name: &str) -> Option<&str> {
    let is_name = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit());
    is_name.then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn in_folder(name: &str) -> Option<(String, u64, &str)> {
        let marked = folder(name)?;
        assert_eq!(marked.file_name, None);
        Some((marked.participant.name, marked.participant.number?, marked.plugin))
    }

    fn in_file(name: &str) -> Option<(String, u64, &str, &str)> {
        let Loose::Of(Marked { participant, plugin, file_name }) = file(name)? else { return None };
        Some((participant.name, participant.number?, plugin, file_name.unwrap_or_default()))
    }

    fn numbers(loose: Option<Loose>) -> Vec<Option<u64>> {
        match loose {
            None => vec![],
            Some(Loose::Of(marked)) => vec![marked.participant.number],
            Some(Loose::Unclear(participants)) => participants.iter().map(|participant| participant.number).collect(),
        }
    }

    #[test]
    fn a_folder_is_read_from_the_right() {
        for (name, expected) in [
            ("山田 太郎_1234_assignsubmission_file", ("山田 太郎", 1234, "file")),
            ("山田 太郎_1234_assignsubmission_file_", ("山田 太郎", 1234, "file")),
            ("山田 太郎_1234_assignsubmission_onlinetext", ("山田 太郎", 1234, "onlinetext")),
            ("s2012345 山田 太郎_7_assignsubmission_file", ("s2012345 山田 太郎", 7, "file")),
            ("2012345_YAMADA Taro_7_assignsubmission_file_", ("2012345_YAMADA Taro", 7, "file")),
            ("Jean_Luc_3_P_12_assignsubmission_file", ("Jean_Luc_3_P", 12, "file")),
            ("Group A-O'Neil, Síle (2)_88_assignsubmission_file", ("Group A-O'Neil, Síle (2)", 88, "file")),
            ("A_1_assignsubmission_file_B_2_assignsubmission_file_", ("A_1_assignsubmission_file_B", 2, "file")),
            ("_5_assignsubmission_file", ("", 5, "file")),
            ("5_6_assignsubmission_file", ("5", 6, "file")),
            ("X_18446744073709551615_assignsubmission_file", ("X", u64::MAX, "file")),
        ] {
            let (person, number, plugin) = expected;
            assert_eq!(in_folder(name), Some((person.into(), number, plugin)), "{name}");
        }
    }

    #[test]
    fn a_file_is_read_where_only_one_student_can_be_meant() {
        for (name, expected) in [
            ("山田 太郎_1234_assignsubmission_file_ggsample06.vert", ("山田 太郎", 1234, "file", "ggsample06.vert")),
            ("Ann Lee_9_assignsubmission_file__final_2.vert", ("Ann Lee", 9, "file", "_final_2.vert")),
            ("Ann Lee_9_assignsubmission_onlinetext_onlinetext.html", ("Ann Lee", 9, "onlinetext", "onlinetext.html")),
            ("2012_Ann_9_assignsubmission_file_a b.vert", ("2012_Ann", 9, "file", "a b.vert")),
            // `*` in a name, and a number before the participant's.
            ("Eve_36_41_assignsubmission_file_x.vert", ("Eve_36", 41, "file", "x.vert")),
            (
                "Eve_assignsubmission_file_x_41_assignsubmission_file_y",
                ("Eve_assignsubmission_file_x", 41, "file", "y"),
            ),
            // What one has downloaded of one's own and hands in again is still one's own.
            (
                "Ann_9_assignsubmission_file_Ann_9_assignsubmission_file_x.vert",
                ("Ann", 9, "file", "Ann_9_assignsubmission_file_x.vert"),
            ),
        ] {
            let (person, number, plugin, own) = expected;
            assert_eq!(in_file(name), Some((person.into(), number, plugin, own)), "{name}");
        }
    }

    #[test]
    fn nobody_passes_for_another_by_a_name() {
        // A person called `Eve*36*assignsubmission*file*x`, whose number is 41; files that are called like others' files.
        for (name, expected) in [
            ("Eve_36_assignsubmission_file_x_41_assignsubmission_file_ggsample06.vert", vec![Some(36), Some(41)]),
            ("Ann_9_assignsubmission_file_Bob_10_assignsubmission_file_x.vert", vec![Some(9), Some(10)]),
            ("Ann_9_assignsubmission_file__10_assignsubmission_onlinetext_x", vec![Some(9), Some(10)]),
            ("Default group_assignsubmission_file_B_10_assignsubmission_file_x.vert", vec![None, Some(10)]),
            (
                "_1_assignsubmission_file__2_assignsubmission_file__3_assignsubmission_file_",
                vec![Some(1), Some(2), Some(3)],
            ),
        ] {
            assert_eq!(numbers(file(name)), expected, "{name}");
        }
        let archive = |stem: &str| numbers(archive(&format!("{stem}.zip"), stem));
        assert_eq!(archive("Ann_9_assignsubmission_file_Bob_10_assignsubmission_file"), [Some(9), Some(10)]);
        assert_eq!(archive("Ann_9_assignsubmission_file_work"), [Some(9)]);
        assert_eq!(archive("Ann_9_assignsubmission_file_"), [Some(9)]);
        assert_eq!(archive("Ann_9_assignsubmission_file"), [Some(9)]);
    }

    #[test]
    fn those_in_no_group_have_no_number() {
        for word in Participant::DEFAULT_GROUP {
            let folder = folder(&format!("{word}_assignsubmission_file")).unwrap().participant;
            assert_eq!((shown(&folder).as_str(), folder.number), (word, None));
            assert_eq!(numbers(file(&format!("{word}_assignsubmission_file_x.vert"))), [None]);
        }
        assert_eq!(in_folder("チーム赤_180_assignsubmission_file"), Some(("チーム赤".into(), 180, "file")));
    }

    #[test]
    fn under_blind_marking_the_number_is_the_name() {
        for name in [
            "Participant 1234",
            "Participant_1234_assignsubmission_file_",
            "Participant 1234_assignsubmission_file",
            "Participant_1234",
        ] {
            let participant = folder(name).unwrap().participant;
            assert_eq!(shown(&participant), "Participant 1234", "{name}");
            assert_eq!(participant.number, Some(1234));
        }
        assert_eq!(shown(&folder("参加者 77_assignsubmission_file").unwrap().participant), "参加者 77");
        assert_eq!(in_file("参加者_77_assignsubmission_file_x.vert").unwrap().0, "参加者");
        assert_eq!(shown(&folder("_5_assignsubmission_file").unwrap().participant), "5");
    }

    #[test]
    fn other_names_are_no_participants() {
        for name in [
            "alice",
            "ggsample06.vert",
            "alice_12",
            "Participant",
            "Participant x",
            "Ann Lee_assignsubmission_file",
            "Ann Lee 12_assignsubmission_file",
            "Ann Lee_12_assignsubmission_",
            "Ann Lee_12_assignsubmission_file_x.vert",
            "Ann Lee_12_assignsubmission_File",
            "Ann Lee_99999999999999999999_assignsubmission_file",
            "Ann Lee_1２_assignsubmission_file",
            "",
        ] {
            assert_eq!(folder(name), None, "{name}");
        }
        assert_eq!(file("Ann Lee_12_assignsubmission_file"), None);
        assert_eq!(file("Ann Lee_x_assignsubmission_file_y.vert"), None);
    }
}
