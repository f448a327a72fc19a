//! Archives as the tools of students and teachers make them.

use super::builder::{ZipMember, archive};
use super::*;
use std::process::Command;

#[test]
fn a_moodle_download_is_read() {
    let intake = take_archive(&archive(&[
        ZipMember::deflated("山田 太郎_12_assignsubmission_file_/ggsample06.vert", b"1").utf8(),
        ZipMember::stored("Ann Lee_3_assignsubmission_file_/answer.vert", "2"),
        ZipMember::stored("Ann Lee_3_assignsubmission_onlinetext_/onlinetext.html", "<p>"),
    ]));
    assert_eq!(everyone(&intake), [("山田 太郎", Ok("1")), ("Ann Lee", Ok("2"))]);
    assert_eq!(intake.title, "class");
    assert_eq!(intake.refused, []);
    let first = &intake.hand_ins[0];
    assert_eq!(first.path().as_deref(), Some("山田 太郎_12_assignsubmission_file_/ggsample06.vert"));
    assert_eq!(local(first), None);
}

#[test]
fn names_in_shift_jis_are_read() {
    // 山田 is 8E 52 93 63 in Shift_JIS, 表 is 95 5C: a backslash in ASCII.
    let intake = take_archive(&archive(&[
        ZipMember::stored(b"\x8e\x52\x93\x63_12_assignsubmission_file_/\x95\x5c.vert", "1"),
        ZipMember::stored(b"\x95\x5c_13_assignsubmission_file_/ggsample06.vert", "2"),
    ]));
    assert_eq!(everyone(&intake), [("山田", Ok("1")), ("表", Ok("2"))]);
    assert!(intake.hand_ins[0].path().unwrap().ends_with("/表.vert"));
}

#[test]
fn the_unicode_path_field_counts_where_it_is_current() {
    let field = |crc: u32| {
        let path = "山田/ggsample06.vert".as_bytes();
        let mut extra = [0x7075_u16.to_le_bytes(), (path.len() as u16 + 5).to_le_bytes()].concat();
        extra.push(1);
        extra.extend(crc.to_le_bytes());
        extra.extend(path);
        extra
    };
    let current = ZipMember { extra: field(crc32fast::hash(b"xx/a.vert")), ..ZipMember::stored("xx/a.vert", "1") };
    let outdated = ZipMember { extra: field(crc32fast::hash(b"before")), ..ZipMember::stored("yy/a.vert", "2") };
    assert_eq!(everyone(&take_archive(&archive(&[current, outdated]))), [("山田", Ok("1")), ("yy", Ok("2"))]);
}

#[test]
fn names_from_macos_are_composed_and_its_litter_left_out() {
    let intake = take_archive(&archive(&[
        ZipMember::stored("か\u{3099}く/ggsample06.vert", "1"),
        ZipMember::stored("__MACOSX/か\u{3099}く/._ggsample06.vert", "\0"),
        ZipMember::stored("bob/ggsample06.vert", "2"),
        ZipMember::stored(".DS_Store", ""),
    ]));
    assert_eq!(everyone(&intake), [("がく", Ok("1")), ("bob", Ok("2"))]);
    assert_eq!(intake.refused, []);
}

#[test]
fn names_that_begin_with_a_dot_are_in_an_archive_too() {
    let double = b"\0\x05\x16\x07\0\x02\0\0";
    let intake = take_archive(&archive(&[
        ZipMember::stored(".太郎_31_assignsubmission_file/ggsample06.vert", "1").utf8(),
        ZipMember::deflated("Bob_32_assignsubmission_file/ggsample06.vert", b"2"),
        ZipMember::stored("Bob_32_assignsubmission_file/._ggsample06.vert", "beside"),
        ZipMember::deflated("Bob_32_assignsubmission_file/._other.docx", double),
        ZipMember::stored("Bob_32_assignsubmission_file/.DS_Store", ""),
        ZipMember::stored("__MACOSX/._Bob_32_assignsubmission_file", ""),
        ZipMember::stored(".unknown", ""),
    ]));
    assert_eq!(everyone(&intake), [(".太郎", Ok("1")), ("Bob", Ok("2"))]);
    assert_eq!(refused(&intake).len(), 1);
    assert!(reason(&intake, ".unknown").unwrap().contains("belongs to nobody"));
}

#[test]
fn an_archive_that_may_be_two_students_is_nobodys() {
    // Among loose files, Ann hands in an archive that is called as if it were Bob's.
    let own = archive(&[ZipMember::stored("ggsample06.vert", "ann")]);
    let intake = take_archive(&archive(&[
        ZipMember::stored("Ann_9_assignsubmission_file_Bob_10_assignsubmission_file.zip", own.clone()),
        ZipMember::stored("Cy_11_assignsubmission_file_work.zip", own),
    ]));
    assert_eq!(everyone(&intake), [("Cy", Ok("ann"))]);
    assert!(reason(&intake, "Bob_10_assignsubmission_file.zip").unwrap().contains("not graded for any of them"));
}

#[test]
fn archives_in_archives_are_opened() {
    let alice = archive(&[ZipMember::stored("ggsample06/ggsample06.vert", "a")]);
    let bob = archive(&[ZipMember::stored("ggsample06.vert", "b")]);
    let class = [ZipMember::stored("alice.zip", alice), ZipMember::deflated("bob.ZIP", &bob)];
    let intake = take_archive(&archive(&class));
    assert_eq!(everyone(&intake), [("alice", Ok("a")), ("bob", Ok("b"))]);
    assert_eq!(intake.hand_ins[0].path().as_deref(), Some("alice.zip/ggsample06/ggsample06.vert"));

    let year = archive(&[
        ZipMember::stored("A.zip", archive(&class)),
        ZipMember::stored("B.zip", archive(&[ZipMember::stored("C_5_assignsubmission_file_x.vert", "c")])),
    ]);
    assert_eq!(everyone(&take_archive(&year)), [("alice", Ok("a")), ("bob", Ok("b")), ("C", Ok("c"))]);
}

#[test]
fn archives_in_archives_end_at_a_depth() {
    let mut bytes = archive(&[ZipMember::stored("ggsample06.vert", "x")]);
    for _ in 1..IntakeLimits::default().archive_depth {
        bytes = archive(&[ZipMember::stored("a.zip", bytes)]);
    }
    assert_eq!(everyone(&take_archive(&bytes)).last().unwrap().1, Ok("x"));
    let intake = take_archive(&archive(&[ZipMember::stored("a.zip", bytes)]));
    assert!(intake.refused[0].reason.en.contains("deep"), "{intake:?}");
    assert!(everyone(&intake).iter().all(|(_, content)| content.is_err()));
}

#[test]
fn an_archive_behind_a_program_is_read() {
    let mut bytes = b"MZ this program unpacks itself".to_vec();
    bytes.extend(archive(&[ZipMember::stored("alice/ggsample06.vert", "a")]));
    assert_eq!(everyone(&take_archive(&bytes)), [("alice", Ok("a"))]);
}

#[test]
fn archives_of_other_tools_are_read() {
    let folder = folder(&[("山田/ggsample06.vert", "1"), ("bob/ggsample06.vert", "2")]);
    let script = "import zipfile, sys
for method in ('STORED', 'DEFLATED', 'BZIP2'):
    with zipfile.ZipFile(f'python-{method}.zip', 'w', getattr(zipfile, 'ZIP_' + method)) as z:
        z.write('class/山田/ggsample06.vert'); z.write('class/bob/ggsample06.vert')
with zipfile.ZipFile('python-zip64.zip', 'w') as z:
    for name in ('山田', 'bob'):
        with z.open(f'class/{name}/ggsample06.vert', 'w', force_zip64=True) as f:
            f.write(open(f'class/{name}/ggsample06.vert', 'rb').read())
class Stream:
    def __init__(self, f): self.f = f
    def write(self, b): return self.f.write(b)
    def flush(self): self.f.flush()
with open('python-stream.zip', 'wb') as f, zipfile.ZipFile(Stream(f), 'w', zipfile.ZIP_DEFLATED) as z:
    z.write('class/山田/ggsample06.vert'); z.write('class/bob/ggsample06.vert')
";
    let run = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).current_dir(folder.path()).output();
        let output = output.unwrap_or_else(|error| panic!("{program}: {error}; script/bootstrap --test installs it"));
        assert!(output.status.success(), "{program}: {}", String::from_utf8_lossy(&output.stderr));
    };
    run("python3", &["-c", script]);
    run("zip", &["-qr", "info-zip.zip", "class"]);
    run("sh", &["-c", "zip -qr - class | cat > info-zip-stream.zip"]);
    run("7z", &["a", "-bd", "7z.zip", "class"]);
    for name in [
        "python-STORED",
        "python-DEFLATED",
        "python-BZIP2",
        "python-zip64",
        "python-stream",
        "info-zip",
        "info-zip-stream",
        "7z",
    ] {
        let intake = take(&[folder.path().join(format!("{name}.zip"))]);
        let mut found = everyone(&intake);
        found.sort();
        assert_eq!(found, [("bob", Ok("2")), ("山田", Ok("1"))], "{name}");
        assert_eq!(intake.refused, [], "{name}");
    }
}

#[test]
fn a_students_archive_among_loose_files_is_theirs() {
    let project = archive(&[ZipMember::stored("ggsample06/ggsample06.vert", "a")]);
    let intake = take_archive(&archive(&[
        ZipMember::stored("Ann Lee_3_assignsubmission_file_hw.zip", project),
        ZipMember::stored("Bob_4_assignsubmission_file_hw.zip", "no archive"),
        ZipMember::stored("Carol_5_assignsubmission_file_x.vert", "c"),
    ]));
    let found = everyone(&intake);
    assert_eq!((found[0], found[2]), (("Ann Lee", Ok("a")), ("Carol", Ok("c"))));
    assert_eq!(found[1].0, "Bob");
    assert!(found[1].1.unwrap_err().contains("not a ZIP"), "{found:?}");
}

#[test]
fn a_student_whose_archive_is_broken_is_a_student() {
    let alice = archive(&[ZipMember::stored("ggsample06.vert", "a")]);
    let intake =
        take_archive(&archive(&[ZipMember::stored("alice.zip", alice), ZipMember::stored("bob.zip", "broken")]));
    let found = everyone(&intake);
    assert_eq!(found[0], ("alice", Ok("a")));
    assert_eq!(found[1].0, "bob");
    assert!(found[1].1.unwrap_err().contains("not a ZIP"), "{found:?}");
}

#[test]
fn archives_named_one_by_one_are_one_student_each() {
    let folder = tempfile::tempdir().unwrap();
    let inputs = ["alice.zip", "bob.zip"].map(|name| folder.path().join(name));
    for (input, content) in inputs.iter().zip(["a", "b"]) {
        fs::write(input, archive(&[ZipMember::stored("ggsample06/ggsample06.vert", content)])).unwrap();
    }
    assert_eq!(everyone(&take(&inputs)), [("alice", Ok("a")), ("bob", Ok("b"))]);
    assert_eq!(everyone(&take(&inputs[..1])), [("alice", Ok("a"))]);
}
