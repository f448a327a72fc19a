//! Archives that lie: each lie is named, and the honest member beside it is read.

use super::builder::{ZipMember, archive};
use super::*;

/// The archive of these members between two honest ones, which are there whatever the others do.
fn beside_honest(members: &[ZipMember]) -> Intake {
    let mut all = vec![ZipMember::stored("alice/ggsample06.vert", "a")];
    all.extend_from_slice(members);
    all.push(ZipMember::stored("zoe/ggsample06.vert", "z"));
    with_honest(take_archive(&archive(&all)))
}

fn with_honest(intake: Intake) -> Intake {
    let found = everyone(&intake);
    assert!(found.contains(&("alice", Ok("a"))) && found.contains(&("zoe", Ok("z"))), "{intake:?}");
    intake
}

fn only_reason(member: ZipMember) -> String {
    let intake = beside_honest(&[member]);
    assert_eq!(intake.refused.len(), 1, "{:?}", intake.refused);
    intake.refused[0].reason.en.clone()
}

#[test]
fn names_that_lead_out_are_refused() {
    for (name, expected) in [
        ("../ggsample06.vert", "`..`"),
        ("bob/../../ggsample06.vert", "`..`"),
        ("/etc/ggsample06.vert", "absolute"),
        ("C:/ggsample06.vert", "absolute"),
        ("bob\\ggsample06.vert", "backslash"),
        ("bob/gg\0sample06.vert", "NUL"),
    ] {
        let reason = only_reason(ZipMember::stored(name, "x"));
        assert!(reason.contains(expected), "{name}: {reason}");
    }
}

#[test]
fn a_participant_whose_file_went_astray_gets_an_answer() {
    let intake = take_archive(&archive(&[
        ZipMember::stored("Bob_7_assignsubmission_file_/../../ggsample06.vert", "x"),
        ZipMember::stored("Ann_8_assignsubmission_file_/ggsample06.vert", "a"),
    ]));
    let found = everyone(&intake);
    assert_eq!(found[0].0, "Bob");
    assert!(found[0].1.unwrap_err().contains("`..`"), "{found:?}");
    assert_eq!(found[1], ("Ann", Ok("a")));
}

#[test]
fn links_and_devices_are_refused() {
    for (mode, expected) in
        [(0o120_777, "symbolic link"), (0o020_666, "device"), (0o060_666, "device"), (0o010_666, "pipe")]
    {
        let reason = only_reason(ZipMember { mode, ..ZipMember::stored("bob/ggsample06.vert", "/etc/passwd") });
        assert!(reason.contains(expected), "{reason}");
    }
}

#[test]
fn encrypted_members_and_unknown_methods_are_refused() {
    let member = ZipMember::stored("bob/ggsample06.vert", "x");
    assert!(only_reason(ZipMember { flags: 1, ..member.clone() }).contains("encrypted"));
    assert!(only_reason(ZipMember { method: 99, ..member.clone() }).contains("encrypted"));
    assert!(only_reason(ZipMember { method: 14, ..member.clone() }).contains("method 14"));
    let intake = beside_honest(&[ZipMember { flags: 1, ..member }]);
    assert!(everyone(&intake)[1].1.unwrap_err().contains("encrypted"), "the student is told");
}

#[test]
fn lying_sizes_are_refused() {
    let data = "void main() {}\n".repeat(40);
    let honest = ZipMember::deflated("bob/ggsample06.vert", data.as_bytes());
    for member in [
        ZipMember { size: honest.size - 1, ..honest.clone() },
        ZipMember { size: honest.size + 1, ..honest.clone() },
        ZipMember { size: 0, ..honest.clone() },
        ZipMember { crc: honest.crc ^ 1, ..honest.clone() },
        ZipMember { compressed: honest.compressed - 1, ..honest.clone() },
        ZipMember { compressed: u32::MAX - 1, ..honest.clone() },
        ZipMember { method: 0, ..honest.clone() },
        ZipMember { start: Some(u32::MAX - 1), ..honest.clone() },
        ZipMember { local_name: Some(b"bob/somebody-else.vert".to_vec()), ..honest.clone() },
    ] {
        let mut members =
            vec![ZipMember::stored("alice/ggsample06.vert", "a"), ZipMember::stored("zoe/ggsample06.vert", "z")];
        members.push(member.clone());
        let intake = with_honest(take_archive(&archive(&members)));
        assert_eq!(intake.refused.len(), 1, "{member:?}: {:?}", intake.refused);
        assert!(everyone(&intake)[2].1.is_err());
    }
}

#[test]
fn bombs_are_refused() {
    let zeros = vec![0; 8 << 20];
    let reason = only_reason(ZipMember::deflated("bob/ggsample06.vert", &zeros));
    assert!(reason.contains("8 MiB"), "{reason}");
    let reason = only_reason(ZipMember::deflated("bob/hw.zip", &zeros));
    assert!(reason.contains("8 MiB"), "{reason}");
    // One that says it is small is stopped where it says it ends.
    let lying = ZipMember { size: 100, ..ZipMember::deflated("bob/ggsample06.vert", &zeros) };
    assert!(only_reason(lying).contains("damaged"));
}

#[test]
fn what_is_unpacked_in_all_has_a_limit() {
    // Noise does not compress: no ratio gives it away.
    let mut state = 1_u32;
    let noise: Vec<u8> = std::iter::repeat_with(|| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    })
    .take(1000)
    .collect();
    let members: Vec<ZipMember> = (0..5).map(|n| ZipMember::stored(format!("s{n}/ggsample06.vert"), &noise)).collect();
    let intake = take_archive_within(&archive(&members), within(2500, 100));
    assert_eq!(
        intake.hand_ins.iter().filter(|hand_in| matches!(hand_in.content, HandInContent::Files { .. })).count(),
        2
    );
    assert_eq!(intake.refused.len(), 3);
}

#[test]
fn the_number_of_members_has_a_limit() {
    let members: Vec<ZipMember> = (0..9).map(|n| ZipMember::stored(format!("s{n}/ggsample06.vert"), "x")).collect();
    let intake = take_archive_within(&archive(&members), within(1 << 20, 4));
    assert_eq!(names(&intake), ["s0", "s1", "s2", "s3"]);
    assert_eq!(intake.refused.len(), 1);
}

#[test]
fn members_that_share_bytes_are_refused() {
    // The second says that it begins where the first does, with the first one's content.
    let one = ZipMember::stored("bob/ggsample06.vert", "x");
    let other = ZipMember { start: Some(0), ..ZipMember::stored("eve/ggsample06.vert", "x") };
    let honest = ZipMember::stored("zoe/ggsample06.vert", "z");
    let intake = take_archive(&archive(&[one, other, honest]));
    assert_eq!(intake.refused.len(), 2, "{:?}", intake.refused);
    assert!(intake.refused.iter().all(|refused| refused.reason.en.contains("shares its bytes")));
    assert!(everyone(&intake).contains(&("zoe", Ok("z"))));
}

#[test]
fn of_two_members_of_one_name_nobody_knows_which_is_meant() {
    let intake = beside_honest(&[
        ZipMember::stored("bob/ggsample06.vert", "1"),
        ZipMember::stored("bob/./ggsample06.vert", "2"),
    ]);
    assert_eq!(intake.refused.len(), 2);
    assert!(everyone(&intake)[1].1.unwrap_err().contains("two different files"));

    let intake =
        beside_honest(&[ZipMember::stored("bob/ggsample06.vert", "1"), ZipMember::stored("bob/ggsample06.vert", "1")]);
    assert_eq!(intake.refused.len(), 1);
    assert_eq!(everyone(&intake)[1], ("bob", Ok("1")));

    let intake = beside_honest(&[ZipMember::stored("bob", "1"), ZipMember::stored("bob/ggsample06.vert", "1")]);
    assert!(!intake.refused.is_empty());
}

#[test]
fn a_cut_off_archive_gives_what_is_whole() {
    let members: Vec<ZipMember> =
        (0..5).map(|n| ZipMember::deflated(format!("s{n}/ggsample06.vert"), format!("{n}").as_bytes())).collect();
    let whole = archive(&members);
    let fourth = whole.windows(2).position(|window| window == b"s3").unwrap();
    let intake = take_archive(&whole[..fourth + 20]);
    let found = everyone(&intake);
    assert_eq!(found[..3], [("s0", Ok("0")), ("s1", Ok("1")), ("s2", Ok("2"))]);
    assert!(intake.refused[0].reason.en.contains("end of the archive is missing"), "{:?}", intake.refused);
    assert!(reason(&intake, "s3/ggsample06.vert").is_some() || found.len() == 3);
}

#[test]
fn a_damaged_directory_record_costs_that_record_only() {
    let mut bytes = archive(&[
        ZipMember::stored("alice/ggsample06.vert", "a"),
        ZipMember::stored("bob/ggsample06.vert", "b"),
        ZipMember::stored("zoe/ggsample06.vert", "z"),
    ]);
    let second = bytes.windows(4).enumerate().filter(|(_, window)| *window == b"PK\x01\x02").nth(1).unwrap().0;
    bytes[second] = b'X';
    let intake = with_honest(take_archive(&bytes));
    assert_eq!(names(&intake), ["alice", "zoe"]);
    assert!(intake.refused[0].reason.en.contains("directory is damaged in 1"), "{:?}", intake.refused);
}

#[test]
fn what_is_no_archive_is_named() {
    for bytes in [&b""[..], b"PK", b"PK\x05\x06", b"Rar!\x1a\x07\x00 and more", &[0; 100]] {
        let intake = take_archive(bytes);
        assert_eq!(intake.hand_ins, []);
        assert!(refused(&intake)[0].1.contains("not a ZIP"), "{intake:?}");
    }
    let intake = beside_honest(&[ZipMember::stored("bob/hw.zip", "no archive")]);
    assert!(everyone(&intake)[1].1.unwrap_err().contains("hw.zip"), "the student is told");
    assert_eq!(take_archive(&archive(&[])).hand_ins, []);
}

#[test]
fn one_students_archive_does_not_use_up_what_the_others_need() {
    let many: Vec<ZipMember> = (0..50).map(|n| ZipMember::stored(format!("{n}.vert"), format!("{n}"))).collect();
    let bad: Vec<ZipMember> = (0..50).map(|n| ZipMember::stored(format!("../{n}.vert"), "")).collect();
    let one_file = archive(&[ZipMember::stored("ggsample06.vert", "z")]);
    let class = archive(&[
        ZipMember::stored("Many_1_assignsubmission_file_/a.zip", archive(&many)),
        ZipMember::stored("Bad_2_assignsubmission_file_/a.zip", archive(&bad)),
        ZipMember::stored("Ann_3_assignsubmission_file_/ggsample06.vert", "a"),
        ZipMember::stored("Zoe_4_assignsubmission_file_/a.zip", one_file),
    ]);
    let part = Budget { bytes: 1000, entries: 20, refusals: 5 };
    let total = Budget { bytes: 1 << 20, entries: 60, refusals: 100 };
    let intake = take_archive_within(&class, IntakeLimits { part, total, ..IntakeLimits::default() });
    assert_eq!(names(&intake), ["Many", "Bad", "Ann", "Zoe"]);
    let found = everyone(&intake);
    assert_eq!(found[2..], [("Ann", Ok("a")), ("Zoe", Ok("z"))]);
    assert!(found[0].1.is_err() && found[1].1.is_err(), "{found:?}");
    // Too many entries once; five members that lead out, and one line for the rest of the 20.
    assert_eq!(intake.refused.len(), 1 + 5 + 1, "{:?}", refused(&intake));
    assert!(intake.refused.iter().any(|refused| refused.reason.en.starts_with("16 more files")));
}

#[test]
fn a_deep_path_is_refused_and_its_student_told() {
    let name = format!("Bob_7_assignsubmission_file_/{}ggsample06.vert", "d/".repeat(40));
    let intake = take_archive(&archive(&[ZipMember::stored(name, "x")]));
    assert!(everyone(&intake)[0].1.unwrap_err().contains("32 folders"), "{intake:?}");
    assert_eq!(intake.refused.len(), 1);
}
