//! Which of a student's files is graded.

use super::*;

/// The name of the file that is graded of a student who hands in these, or the English reason why none is.
fn graded(files: &[(&str, &str)]) -> Result<String, String> {
    let files: Vec<_> = files.iter().map(|(name, content)| (format!("alice/{name}"), *content)).collect();
    let files: Vec<_> = files.iter().map(|(name, content)| (name.as_str(), *content)).collect();
    let mut intake = take_folder(&[&files[..], &[("zoe/ggsample06.vert", "z")]].concat());
    assert_eq!(names(&intake), ["alice", "zoe"]);
    match intake.hand_ins.remove(0).content {
        HandInContent::Files { hand_in, .. } => Ok(hand_in.names()),
        HandInContent::Nothing(reason) => {
            assert!(!reason.ja.is_empty());
            Err(reason.en)
        }
    }
}

#[test]
fn the_assignments_own_name_wins() {
    assert_eq!(graded(&[("a.vert", "1"), ("GGSAMPLE06.vert", "2")]).unwrap(), "GGSAMPLE06.vert");
    assert_eq!(graded(&[("ggsample06.vert", "1"), ("ggsample06 (1).vert", "2")]).unwrap(), "ggsample06.vert");
    assert_eq!(graded(&[("ggsample06 (1).vert", "1"), ("old.vert", "2")]).unwrap(), "ggsample06 (1).vert");
    assert_eq!(graded(&[("x/y/answer.vert", "1"), ("x/ggsample06.frag", "2")]).unwrap(), "answer.vert");
}

#[test]
fn two_that_differ_are_a_question_and_two_that_agree_are_none() {
    let question = graded(&[("a.vert", "1"), ("b.vert", "2")]).unwrap_err();
    assert!(question.contains("`a.vert`, `b.vert`"), "{question}");
    assert_eq!(graded(&[("a.vert", "1"), ("b.vert", "1")]).unwrap(), "a.vert");
    let question = graded(&[("x/ggsample06.vert", "1"), ("y/ggsample06.vert", "2")]).unwrap_err();
    assert!(question.contains("`x/ggsample06.vert`, `y/ggsample06.vert`"), "{question}");
    assert!(graded(&[("ggsample06 (1).vert", "1"), ("ggsample06 (2).vert", "2")]).is_err());
}

#[test]
fn a_renamed_shader_is_graded() {
    assert_eq!(graded(&[("ggsample06.vert.txt", "1")]).unwrap(), "ggsample06.vert.txt");
    assert_eq!(graded(&[("answer.glsl", "1"), ("readme.txt", "hello")]).unwrap(), "answer.glsl");
    assert_eq!(graded(&[("answer.txt", "void main() { gl_Position = pv; }")]).unwrap(), "answer.txt");
    assert!(graded(&[("answer.txt", "It did not work.")]).unwrap_err().contains("`answer.txt`"));
}

#[test]
fn what_is_there_instead_is_said() {
    for (name, expected) in [
        ("ggsample06.frag", "fragment shader"),
        ("kadai.docx", "document"),
        ("kadai.rar", "only ZIP"),
        ("screen.png", "picture"),
    ] {
        let reason = graded(&[(name, "")]).unwrap_err();
        assert!(reason.contains(&format!("`{name}`")) && reason.contains(expected), "{reason}");
    }
    let many: Vec<_> = (0..9).map(|n| format!("{n}.cpp")).collect();
    let reason = graded(&many.iter().map(|name| (name.as_str(), "")).collect::<Vec<_>>()).unwrap_err();
    assert!(reason.contains("`3.cpp` and 5 more"), "{reason}");
}

#[test]
fn a_long_file_is_cut_above_what_the_source_stage_takes() {
    let intake = take_folder(&[("alice/ggsample06.vert", &"x".repeat(3 << 20))]);
    let HandInContent::Files { hand_in, .. } = &intake.hand_ins[0].content else { panic!("{intake:?}") };
    let length = hand_in.files[0].bytes.len();
    assert_eq!(length, 1 << 20);
    assert!(length > crate::source::MAX_BYTES);
}

#[test]
fn an_unreadable_file_is_named() {
    if nix::unistd::geteuid().is_root() {
        // Root reads everything; a folder that becomes a file's name cannot be read by anyone.
        let folder = folder(&[("alice/ggsample06.vert", "a")]);
        let gone = folder.path().join("class/alice/ggsample06.vert");
        assert!(super::super::folder::bytes(gone.parent().unwrap(), 10).is_err());
        return;
    }
    use std::os::unix::fs::PermissionsExt;
    let folder = folder(&[("alice/ggsample06.vert", "a"), ("bob/ggsample06.vert", "b")]);
    let file = folder.path().join("class/alice/ggsample06.vert");
    fs::set_permissions(&file, fs::Permissions::from_mode(0o000)).unwrap();
    let intake = take(&[folder.path().join("class")]);
    let found = everyone(&intake);
    assert!(found[0].1.unwrap_err().contains("ggsample06.vert"));
    assert_eq!(found[1], ("bob", Ok("b")));
}
