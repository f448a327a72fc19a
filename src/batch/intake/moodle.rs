//! The names in a Moodle download, from which its students are told apart.
//!
//! "Download all submissions" names everything `NAME_NUMBER_assignsubmission_PLUGIN`: a folder of that name with the
//! student's files in it (up to Moodle 4.0 with an `_` more behind it), or, where the teacher has switched folders off,
//! files of that name with `_` and the student's own file name behind it. NUMBER is the participant's in this
//! assignment; under blind marking NAME is the word for participant in the teacher's language.

use crate::batch::class::Participant;

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
    /// The student's own file name; none for a folder.
    pub file_name: Option<&'a str>,
}

/// Reads the name of a folder. All of it is Moodle's own making, so the last mark is the one that counts: a full name
/// may contain anything.
pub(super) fn folder(name: &str) -> Option<Marked<'_>> {
    if let Some((before, after)) = name.rsplit_once(MARK) {
        let plugin = after.strip_suffix('_').unwrap_or(after);
        return Some(Marked { participant: participant(before)?, plugin: plugin_name(plugin)?, file_name: None });
    }
    let participant = participant(name).filter(|participant| is_blind(&participant.name))?;
    Some(Marked { participant, plugin: "file", file_name: None })
}

/// Reads the name of a file among those of all students. Its end is the student's own choice, so the first mark is the
/// one that counts: no file name can pass for another student's.
pub(super) fn file(name: &str) -> Option<Marked<'_>> {
    name.match_indices(MARK).find_map(|(at, mark)| {
        let (plugin, file_name) = name[at + mark.len()..].split_once('_')?;
        Some(Marked {
            participant: participant(&name[..at])?,
            plugin: plugin_name(plugin)?,
            file_name: Some(file_name).filter(|name| !name.is_empty()),
        })
    })
}

/// The name shown of a participant.
pub(super) fn shown(participant: &Participant) -> String {
    let Participant { name, number } = participant;
    if name.is_empty() {
        number.to_string()
    } else if is_blind(name) {
        format!("{name} {number}")
    } else {
        name.clone()
    }
}

/// `NAME_NUMBER`, or `PARTICIPANT NUMBER`, read from its end.
fn participant(text: &str) -> Option<Participant> {
    let digits = text.bytes().rev().take_while(u8::is_ascii_digit).count();
    let (before, number) = text.split_at(text.len() - digits);
    let number = number.parse().ok()?;
    let spaced = || before.strip_suffix(' ').filter(|name| is_blind(name));
    let name = before.strip_suffix('_').or_else(spaced)?;
    Some(Participant { name: name.into(), number })
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
        Some((marked.participant.name, marked.participant.number, marked.plugin))
    }

    fn in_file(name: &str) -> Option<(String, u64, &str, &str)> {
        let marked = file(name)?;
        Some((marked.participant.name, marked.participant.number, marked.plugin, marked.file_name.unwrap_or_default()))
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
    fn a_file_name_cannot_pass_for_another_student() {
        for (name, expected) in [
            ("山田 太郎_1234_assignsubmission_file_ggsample06.vert", ("山田 太郎", 1234, "file", "ggsample06.vert")),
            ("Ann Lee_9_assignsubmission_file__final_2.vert", ("Ann Lee", 9, "file", "_final_2.vert")),
            ("Ann Lee_9_assignsubmission_onlinetext_onlinetext.html", ("Ann Lee", 9, "onlinetext", "onlinetext.html")),
            (
                "Ann_9_assignsubmission_file_Bob_10_assignsubmission_file_x.vert",
                ("Ann", 9, "file", "Bob_10_assignsubmission_file_x.vert"),
            ),
            ("2012_Ann_9_assignsubmission_file_a b.vert", ("2012_Ann", 9, "file", "a b.vert")),
        ] {
            let (person, number, plugin, own) = expected;
            assert_eq!(in_file(name), Some((person.into(), number, plugin, own)), "{name}");
        }
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
            assert_eq!(participant.number, 1234);
        }
        assert_eq!(shown(&folder("参加者 77_assignsubmission_file").unwrap().participant), "参加者 77");
        assert_eq!(shown(&file("参加者_77_assignsubmission_file_x.vert").unwrap().participant), "参加者 77");
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
