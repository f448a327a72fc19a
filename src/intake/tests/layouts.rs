//! Whose each file is, in the ways in which classes come.

use super::*;
use crate::intake::Participant;

#[test]
fn each_folder_is_a_student_and_an_empty_one_too() {
    let intake = take_folder(&[("bob/ggsample06.vert", "b"), ("alice/src/ggsample06.vert", "a"), ("carol/", "")]);
    let found = everyone(&intake);
    assert_eq!(found[..2], [("alice", Ok("a")), ("bob", Ok("b"))]);
    assert_eq!(found[2].0, "carol");
    assert!(found[2].1.unwrap_err().starts_with("No file was handed in"), "{found:?}");
    assert_eq!((intake.title.as_str(), intake.refused.len()), ("class", 0));
    let alice = &intake.hand_ins[0];
    assert_eq!(alice.student.key, "alice");
    assert_eq!(alice.path().as_deref(), Some("alice/src/ggsample06.vert"));
    // It is not below the working folder.
    assert_eq!(local(alice), None);
}

#[test]
fn loose_shaders_are_students_and_other_files_are_named() {
    let intake = take_folder(&[("alice.vert", "a"), ("bob.vert.txt", "b"), ("山田.vert", "y"), ("notes.docx", "")]);
    assert_eq!(everyone(&intake), [("alice", Ok("a")), ("bob", Ok("b")), ("山田", Ok("y"))]);
    assert!(reason(&intake, "notes.docx").unwrap().contains("belongs to nobody"));
}

#[test]
fn classes_in_a_year_are_looked_into() {
    let files =
        [("A/alice/x.vert", "1"), ("A/bob/x.vert", "2"), ("B/alice/x.vert", "3"), ("B/dave/x.vert", "4"), ("C/", "")];
    let intake = take_folder(&files);
    assert_eq!(names(&intake), ["alice", "bob", "alice", "dave", "C"]);
    let keys: std::collections::HashSet<_> = intake.hand_ins.iter().map(|hand_in| &hand_in.student.key).collect();
    assert_eq!(keys.len(), 5);
}

#[test]
fn a_student_does_not_become_several_by_the_folders_they_hand_in() {
    let intake = take_folder(&[
        ("alice/ggsample06.vert", "a"),
        ("mallory/bob/x.vert", "1"),
        ("mallory/carol/x.vert", "2"),
        ("mallory/Ann_7_assignsubmission_file_/x.vert", "3"),
    ]);
    assert_eq!(names(&intake), ["alice", "mallory"]);
    assert!(everyone(&intake)[1].1.unwrap_err().starts_with("Several files"));
}

#[test]
fn inputs_named_one_by_one_are_one_student_each() {
    let folder = folder(&[("alice/ggsample06.vert", "a"), ("bob/ggsample06.vert", "b"), ("carol.vert", "c")]);
    let class = folder.path().join("class");
    let files = [class.join("alice/ggsample06.vert"), class.join("bob/ggsample06.vert"), class.join("carol.vert")];
    assert_eq!(everyone(&take(&files)), [("alice", Ok("a")), ("bob", Ok("b")), ("carol", Ok("c"))]);
    let places: Vec<_> = take(&files).hand_ins.into_iter().filter_map(|hand_in| hand_in.path()).collect();
    assert_eq!(places, ["alice/ggsample06.vert", "bob/ggsample06.vert", "carol.vert"]);
    let folders = [class.join("alice"), class.join("bob")];
    assert_eq!(everyone(&take(&folders)), [("alice", Ok("a")), ("bob", Ok("b"))]);
    assert_eq!(take(&folders).title, "class");
}

#[test]
fn an_input_that_is_not_there_is_named_and_the_rest_is_read() {
    let folder = folder(&[("alice.vert", "a")]);
    let class = folder.path().join("class");
    let intake = take(&[class.join("nobody.vert"), class.join("alice.vert")]);
    assert_eq!(everyone(&intake), [("alice", Ok("a"))]);
    assert!(reason(&intake, "nobody.vert").unwrap().contains("No such file"));
}

#[test]
fn an_extracted_moodle_download_is_read_in_all_its_forms() {
    for files in [
        ["山田 太郎_12_assignsubmission_file/ggsample06.vert", "A_B 3_4_assignsubmission_file/x.vert"],
        ["山田 太郎_12_assignsubmission_file_/ggsample06.vert", "A_B 3_4_assignsubmission_file_/sub/x.vert"],
        ["山田 太郎_12_assignsubmission_file_ggsample06.vert", "A_B 3_4_assignsubmission_file_x.vert"],
    ] {
        let text = "山田 太郎_12_assignsubmission_onlinetext/onlinetext.html";
        let only_text = "C_5_assignsubmission_onlinetext_/onlinetext.html";
        let intake = take_folder(&[(files[0], "1"), (files[1], "2"), (text, "<p>"), (only_text, "<p>")]);
        let mut found = everyone(&intake);
        found.sort();
        assert_eq!(found[0], ("A_B 3", Ok("2")), "{files:?}");
        assert_eq!(found[1].0, "C");
        assert!(found[1].1.unwrap_err().starts_with("Only text typed into Moodle"));
        assert_eq!(found[2], ("山田 太郎", Ok("1")));
        let keys: Vec<_> = intake.hand_ins.iter().map(|hand_in| hand_in.student.key.as_str()).collect();
        assert!(keys.contains(&"12") && keys.contains(&"4") && keys.contains(&"5"), "{keys:?}");
    }
}

#[test]
fn blind_participants_are_told_apart_by_their_numbers() {
    let intake = take_folder(&[
        ("Participant_7_assignsubmission_file_/ggsample06.vert", "7"),
        ("参加者_8_assignsubmission_file/ggsample06.vert", "8"),
        ("Participant 9/ggsample06.vert", "9"),
        ("stray.vert", ""),
    ]);
    assert_eq!(everyone(&intake), [("Participant 9", Ok("9")), ("Participant 7", Ok("7")), ("参加者 8", Ok("8"))]);
    assert_eq!(intake.hand_ins[2].student.moodle.as_ref().unwrap().number, Some(8));
    assert!(reason(&intake, "stray.vert").is_some());
}

#[test]
fn links_and_pipes_are_refused_and_never_opened() {
    let folder = folder(&[("alice/ggsample06.vert", "a"), ("bob/", ""), ("carol/", ""), ("secret", "s")]);
    let class = folder.path().join("class");
    std::os::unix::fs::symlink("/etc/passwd", class.join("bob/ggsample06.vert")).unwrap();
    std::os::unix::fs::symlink("/etc", class.join("bob/etc")).unwrap();
    std::os::unix::fs::symlink("../..", class.join("bob/up")).unwrap();
    nix::unistd::mkfifo(&class.join("carol/ggsample06.vert"), nix::sys::stat::Mode::S_IRWXU).unwrap();
    let intake = take(&[class]);
    let found = everyone(&intake);
    assert_eq!(found[0], ("alice", Ok("a")));
    assert!(found[1].1.unwrap_err().contains("symbolic link"), "{found:?}");
    assert!(found[2].1.unwrap_err().contains("pipe"), "{found:?}");
    assert!(reason(&intake, "bob/ggsample06.vert").is_some() && reason(&intake, "bob/up").is_some());
}

#[test]
fn what_systems_leave_behind_is_not_there() {
    let intake = take_folder(&[
        ("alice/.git/x.vert", ""),
        ("alice/._ggsample06.vert", ""),
        ("alice/.DS_Store", ""),
        ("alice/__MACOSX/ggsample06.vert", ""),
        ("alice/ggsample06.vert", "a"),
        (".DS_Store", ""),
    ]);
    assert_eq!(everyone(&intake), [("alice", Ok("a"))]);
    assert_eq!(intake.refused, []);
}

#[test]
fn names_that_begin_with_a_dot_are_students() {
    // Moodle's importer of feedback takes them for hidden files; its downloads have them all the same.
    let intake = take_folder(&[
        (".Dot Taro_31_assignsubmission_file/ggsample06.vert", "1"),
        ("..Dots_32_assignsubmission_file_/ggsample06.vert", "2"),
        ("._Eve_33_assignsubmission_file/ggsample06.vert", "3"),
        (".git_34_assignsubmission_file/.git/x.vert", "no"),
        (".git_34_assignsubmission_file/.my.vert", "4"),
        (".DS_Store", ""),
        (".hidden.docx", ""),
        (".notes/", ""),
    ]);
    let mut found = everyone(&intake);
    found.sort();
    let expected = [("..Dots", Ok("2")), (".Dot Taro", Ok("1")), ("._Eve", Ok("3")), (".git", Ok("4"))];
    assert_eq!(found, expected);
    let named: Vec<_> = refused(&intake).into_iter().filter_map(|(path, _)| path.rsplit('/').next()).collect();
    assert_eq!(named, [".hidden.docx", ".notes"]);
    // Without Moodle, and with folders off.
    let intake = take_folder(&[
        (".taro/ggsample06.vert", "1"),
        ("bob/ggsample06.vert", "2"),
        ("bob/._x.vert", "\0\x05\x16\x07"),
    ]);
    assert_eq!(everyone(&intake), [(".taro", Ok("1")), ("bob", Ok("2"))]);
    let loose =
        take_folder(&[(".Taro_5_assignsubmission_file_x.vert", "1"), ("._Taro_5_assignsubmission_file_x.vert", "")]);
    let mut found = everyone(&loose);
    found.sort();
    // The second is what macOS keeps of `Taro_5_…`, but there is no such file, and it says nothing of the kind: a text.
    assert_eq!(found.len(), 1);
    assert!(found[0].1.unwrap_err().starts_with("Several files"), "{found:?}");
}

#[test]
fn what_macos_keeps_of_files_is_not_handed_in() {
    let double = "\0\x05\x16\x07\0\x02";
    let intake = take_folder(&[
        ("Ann_1_assignsubmission_file_ggsample06.vert", "a"),
        ("._Ann_1_assignsubmission_file_ggsample06.vert", "beside"),
        ("._Bob_2_assignsubmission_file_ggsample06.vert", double),
    ]);
    assert_eq!(everyone(&intake), [("Ann", Ok("a"))]);
    assert_eq!(intake.refused, []);
}

#[test]
fn loose_files_that_may_be_two_students_are_nobodys_and_are_named() {
    // `Eve*36*assignsubmission*file*x`, whose number is 41; and a file of Ann's that is called as if it were Bob's.
    let crafted = "Eve_36_assignsubmission_file_x_41_assignsubmission_file_ggsample06.vert";
    let passed_off = "Ann_9_assignsubmission_file_Bob_10_assignsubmission_file_ggsample06.vert";
    let intake = take_folder(&[
        (crafted, "eve"),
        (passed_off, "ann"),
        ("Victim_36_assignsubmission_file_ggsample06.vert", "victim"),
        ("Bob_10_assignsubmission_file_ggsample06.vert", "bob"),
        ("Ann_9_assignsubmission_file_notes.txt", ""),
    ]);
    let mut found = everyone(&intake);
    found.sort_by_key(|(name, _)| *name);
    assert_eq!(found[1..], [("Bob", Ok("bob")), ("Victim", Ok("victim"))]);
    assert!(found[0].0 == "Ann" && found[0].1.unwrap_err().contains("notes.txt"), "{found:?}");
    let why = reason(&intake, crafted).unwrap();
    assert!(why.contains("`Eve (36)`") && why.contains("`Eve_36_assignsubmission_file_x (41)`"), "{why}");
    let why = reason(&intake, passed_off).unwrap();
    assert!(why.contains("`Ann (9)`") && why.contains("`Ann_9_assignsubmission_file_Bob (10)`"), "{why}");
    // With folders on, the end of a folder's name is Moodle's own, whatever the name is.
    let intake = take_folder(&[
        ("Eve_36_assignsubmission_file_x_41_assignsubmission_file/ggsample06.vert", "eve"),
        ("Victim_36_assignsubmission_file/ggsample06.vert", "victim"),
    ]);
    let keys: Vec<_> = intake.hand_ins.iter().map(|hand_in| hand_in.student.key.as_str()).collect();
    assert_eq!((keys, intake.refused.len()), (vec!["41", "36"], 0));
    // The same of files that are named one by one.
    let folder = folder(&[(crafted, "eve"), ("Victim_36_assignsubmission_file_ggsample06.vert", "victim")]);
    let class = folder.path().join("class");
    let intake = take(&[class.join(crafted), class.join("Victim_36_assignsubmission_file_ggsample06.vert")]);
    assert_eq!(everyone(&intake), [("Victim", Ok("victim"))]);
    assert!(reason(&intake, crafted).is_some());
}

#[test]
fn groups_and_those_in_none_are_read() {
    let intake = take_folder(&[
        ("チーム_赤 1_180_assignsubmission_file/ggsample06.vert", "1"),
        ("Default group_assignsubmission_file/ggsample06.vert", "2"),
    ]);
    let found: Vec<_> = intake.hand_ins.iter().map(|h| (h.student.name.as_str(), h.student.moodle.clone())).collect();
    let participant = |name: &str, number| Some(Participant { name: name.into(), number });
    let expected =
        [("Default group", participant("Default group", None)), ("チーム_赤 1", participant("チーム_赤 1", Some(180)))];
    assert_eq!(found, expected);
    assert!(intake.hand_ins[0].student.key.starts_with("Default-group-"));
    let loose = take_folder(&[("デフォルトグループ_assignsubmission_file_ggsample06.vert", "2")]);
    assert_eq!(everyone(&loose), [("デフォルトグループ", Ok("2"))]);
}

#[test]
fn more_files_than_the_limit_are_named_once() {
    let folder = folder(&[("a.vert", ""), ("b.vert", ""), ("c.vert", ""), ("d.vert", "")]);
    let limits = within(1 << 20, 2);
    let intake = read(&[folder.path().join("class")], &IntakeOptions { limits, ..options() }).unwrap();
    assert_eq!(names(&intake), ["a", "b"]);
    assert_eq!(intake.refused.len(), 1);
}
