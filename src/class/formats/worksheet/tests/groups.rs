//! Assignments in which groups hand in.

use super::moodle::Moodle;
use crate::class::formats::samples;
use crate::class::formats::worksheet::{fill, recipients};
use crate::class::{Class, Outcome};
use crate::intake::Participant;
use crate::language::Language;
use crate::report::samples as reports;

const NO_GROUP: &str = "Not a member of any group, so unable to make submissions.";
const SEVERAL: &str = "Member of more than one group, so unable to make submissions.";

/// A class of these names and numbers of a download, each with full marks but the last, which has 80.
fn class(names: &[(&str, Option<u64>)]) -> Class {
    let mut class = samples::class(Language::En);
    class.entries.truncate(names.len());
    let last = names.len() - 1;
    for (index, (entry, (name, number))) in class.entries.iter_mut().zip(names).enumerate() {
        let report = if index == last { reports::wrong() } else { reports::correct() };
        entry.outcome = Outcome::Graded(Box::new(report));
        entry.student.name = (*name).into();
        entry.student.key = format!("k{index}");
        entry.student.moodle = Some(Participant { name: (*name).into(), number: *number });
    }
    class
}

/// The grades in Moodle after the class, by number; and what was said.
fn graded(moodle: &mut Moodle, class: &Class) -> (Vec<(u64, String)>, Vec<String>) {
    let filled = fill(class, &moodle.download()).expect("a worksheet");
    moodle.upload(&filled.bytes);
    let grades = moodle.grades.iter().filter(|(_, row)| !row.grade.is_empty() || !row.comment.is_empty());
    (
        grades.map(|(number, row)| (*number, row.grade.clone())).collect(),
        filled.notes.into_iter().map(|note| note.en).collect(),
    )
}

fn given(class: &Class, moodle: &Moodle) -> Vec<(u64, String)> {
    let recipients = recipients(class, &moodle.download()).expect("a worksheet");
    recipients.into_iter().map(|one| (one.number, one.entry.student.name.clone())).collect()
}

fn expected(grades: &[(u64, &str)]) -> Vec<(u64, String)> {
    grades.iter().map(|(number, grade)| (*number, (*grade).to_owned())).collect()
}

#[test]
fn every_member_gets_the_groups_grade_and_nobody_whose_number_is_the_groups() {
    for is_japanese in [false, true] {
        // 180 is the number of the group in the download, and of somebody in no group.
        let mut moodle = Moodle::with(&[
            (11, "A", Some("チーム赤"), ""),
            (12, "B", Some("チーム赤"), ""),
            (13, "C", Some("Team_1 & *2*"), ""),
            (14, "D", Some("Team_10"), ""),
            (180, "E", Some(NO_GROUP), ""),
            (181, "F", Some(SEVERAL), ""),
            (190, "G", Some("チーム赤"), ""),
        ]);
        moodle.is_japanese = is_japanese;
        let class = class(&[("チーム赤", Some(180)), ("Ghosts", Some(11)), ("Team 1 amp; _2_", Some(190))]);
        let all = [(11, "100.00"), (12, "100.00"), (13, "80.00"), (190, "100.00")];
        for _ in 0..3 {
            let (grades, notes) = graded(&mut moodle, &class);
            assert_eq!(grades, expected(&all));
            assert!(notes.iter().any(|note| note == "Not in the worksheet: Ghosts."), "{notes:?}");
            let left = notes.iter().find(|note| note.contains("without a submission")).expect("a note");
            let word = if is_japanese { "参加者" } else { "Participant " };
            for row in
                [format!("{word}14 (Team_10)"), format!("{word}180 ({NO_GROUP})"), format!("{word}181 ({SEVERAL})")]
            {
                assert!(left.contains(&row), "{row}: {left}");
            }
        }
        let group = |name: &str| name.to_owned();
        assert_eq!(
            given(&class, &moodle),
            [
                (11, group("チーム赤")),
                (12, group("チーム赤")),
                (13, group("Team 1 amp; _2_")),
                (190, group("チーム赤"))
            ]
        );
    }
}

#[test]
fn groups_that_cannot_be_told_apart_are_named_and_not_graded() {
    let mut moodle = Moodle::with(&[
        (1, "A", Some("B_2"), ""),
        (2, "B", Some("B 2"), ""),
        (3, "C", Some("Twins"), ""),
        (4, "D", Some("Sure"), ""),
        (5, "E", Some("Default group"), ""),
    ]);
    // Only one of `B_2` and `B 2` handed in; two groups have one name; a group is called like those in none.
    let class = class(&[
        ("B 2", Some(3)),
        ("Twins", Some(1)),
        ("Twins", Some(2)),
        ("Default group", Some(4)),
        ("Default group", None),
        ("Sure", Some(5)),
    ]);
    let (grades, notes) = graded(&mut moodle, &class);
    assert_eq!(grades, expected(&[(4, "80.00")]));
    let note = "Several submissions or groups go by this name or number, so that none of them is filled in: B 2, B_2, \
                Default group, Twins.";
    assert!(notes.iter().any(|found| found == note), "{notes:?}");
    assert!(!notes.iter().any(|note| note.starts_with("Not in the worksheet")), "{notes:?}");
    assert_eq!(given(&class, &moodle), [(4, "Sure".to_owned())]);
}

#[test]
fn those_in_no_group_hand_in_together() {
    let people: [(u64, &str, Option<&str>, &str); 3] =
        [(1, "A", Some("デフォルトグループ"), ""), (2, "B", Some("デフォルトグループ"), ""), (3, "C", Some("Red"), "")];
    let class = class(&[("Default group", None), ("Red", Some(1))]);
    let (grades, _) = graded(&mut Moodle::with(&people), &class);
    assert_eq!(grades, expected(&[(1, "100.00"), (2, "100.00"), (3, "80.00")]));
    // The worksheet of an assignment in which everyone hands in alone is not this archive's.
    let alone = people.map(|(number, name, _, comment)| (number, name, None, comment));
    let (grades, notes) = graded(&mut Moodle::with(&alone), &class);
    assert_eq!(grades, []);
    assert!(notes.iter().any(|note| note.contains("no column \"Group\"")), "{notes:?}");
    assert_eq!(given(&class, &Moodle::with(&alone)), []);
}

#[test]
fn the_downloads_of_moodle_4_0_are_the_members() {
    let mut moodle =
        Moodle::with(&[(21, "Ann Lee", Some("Red"), ""), (22, "Bob", Some("Red"), ""), (23, "Cy", Some("Blue"), "")]);
    // Number, group and name agree for two of them; 23 is a member of another group now.
    let class = class(&[("Red-Ann Lee", Some(21)), ("Red-Cy", Some(23)), ("Red-Bob", Some(22))]);
    let (grades, notes) = graded(&mut moodle, &class);
    assert_eq!(grades, expected(&[(21, "100.00"), (22, "80.00")]));
    assert!(notes.iter().any(|note| note == "Not in the worksheet: Red-Cy."), "{notes:?}");
}

#[test]
fn a_number_that_two_submissions_have_is_nobodys() {
    let mut moodle = Moodle::with(&[(7, "A", None, ""), (8, "B", None, "")]);
    let class = class(&[("A", Some(7)), ("A too", Some(7)), ("B", Some(8))]);
    let (grades, notes) = graded(&mut moodle, &class);
    assert_eq!(grades, expected(&[(8, "80.00")]));
    assert!(notes.iter().any(|note| note.contains("none of them is filled in: Participant 7.")), "{notes:?}");
    assert_eq!(given(&class, &moodle), [(8, "B".to_owned())]);
}
