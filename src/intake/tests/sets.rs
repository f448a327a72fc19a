//! Hand-ins of several files.

use super::*;
use crate::slots::tests::both;

const VERTEX: &str = "void main() { gl_Position = pv; }";
const FRAGMENT: &str = "out vec4 fc; void main() { fc = vec4(1.0); }";

fn options() -> IntakeOptions {
    IntakeOptions { slots: both(), limits: IntakeLimits::default() }
}

fn take(files: &[(&str, &str)]) -> Intake {
    let folder = folder(files);
    read(&[folder.path().join("class")], &options()).unwrap()
}

/// Everyone with the names and contents of their files, or the reason why there are none.
fn sets(intake: &Intake) -> Vec<(&str, String)> {
    let set = |content: &HandInContent| match content {
        HandInContent::Files { hand_in, .. } => {
            let file = |file: &HandedInFile| format!("{}={}", file.name, String::from_utf8_lossy(&file.bytes));
            hand_in.files.iter().map(file).collect::<Vec<_>>().join(" ")
        }
        HandInContent::Nothing(why) => why.en.clone(),
    };
    intake.hand_ins.iter().map(|work| (work.student.name.as_str(), set(&work.content))).collect()
}

#[test]
fn each_student_has_a_file_for_each_slot_or_is_told_which_is_missing() {
    let intake = take(&[
        ("alice/ggsample11.vert", "av"),
        ("alice/src/ggsample11.frag", "af"),
        ("alice/readme.txt", "hello"),
        ("bob/mine.frag", "bf"),
        ("bob/mine (1).vert", "bv"),
        ("carol/ggsample11.vert", "cv"),
        ("dave/ggsample11.vert", "dv"),
        ("dave/a.frag", "1"),
        ("dave/b.frag", "2"),
        ("frank/a/x.txt", FRAGMENT),
        ("frank/b/x.txt", VERTEX),
        ("erin/one.txt", FRAGMENT),
        ("erin/two.txt", VERTEX),
    ]);
    let found = sets(&intake);
    assert_eq!(found[0], ("alice", "ggsample11.vert=av ggsample11.frag=af".into()));
    assert_eq!(found[1], ("bob", "mine (1).vert=bv mine.frag=bf".into()));
    assert_eq!(
        found[2].1,
        "There is no `ggsample11.frag`, only `ggsample11.vert`. Hand in `ggsample11.vert` and `ggsample11.frag` together."
    );
    assert!(
        found[3].1.starts_with("It is not clear which file is `ggsample11.frag`: `a.frag`, `b.frag`."),
        "{found:?}"
    );
    assert_eq!(found[4], ("erin", format!("two.txt={VERTEX} one.txt={FRAGMENT}")));
    assert_eq!(found[5], ("frank", format!("ggsample11.vert={VERTEX} ggsample11.frag={FRAGMENT}")));
    let HandInContent::Files { places, .. } = &intake.hand_ins[0].content else { panic!("{intake:?}") };
    let paths: Vec<_> = places.iter().map(|place| place.path.as_str()).collect();
    assert_eq!(paths, ["alice/ggsample11.vert", "alice/src/ggsample11.frag"]);
}

#[test]
fn a_folder_with_a_pair_is_one_student_and_loose_pairs_are_students() {
    // Nothing here is the homework's own name: a pair is no class of two.
    let one = take(&[
        ("term/alice/x.vert", "1"),
        ("term/alice/x.frag", "2"),
        ("term/bob/y.vert", "3"),
        ("term/bob/y.frag", "4"),
    ]);
    assert_eq!(sets(&one), [("alice", "x.vert=1 x.frag=2".into()), ("bob", "y.vert=3 y.frag=4".into())]);
    let loose = take(&[("alice.vert", "1"), ("alice.frag", "2"), ("bob.frag", "4"), ("bob.vert", "3")]);
    assert_eq!(sets(&loose), [("alice", "alice.vert=1 alice.frag=2".into()), ("bob", "bob.vert=3 bob.frag=4".into())]);
}

#[test]
fn files_that_are_named_one_by_one_are_put_together_by_their_folder() {
    let folder = folder(&[
        ("alice/ggsample11.vert", "1"),
        ("alice/ggsample11.frag", "2"),
        ("bob/ggsample11.vert", "3"),
        ("bob/ggsample11.frag", "4"),
    ]);
    let paths = ["alice/ggsample11.vert", "bob/ggsample11.vert", "bob/ggsample11.frag", "alice/ggsample11.frag"];
    let inputs: Vec<PathBuf> = paths.iter().map(|path| folder.path().join("class").join(path)).collect();
    let found = read(&inputs, &options()).unwrap();
    let expected = [("alice", "ggsample11.vert=1 ggsample11.frag=2"), ("bob", "ggsample11.vert=3 ggsample11.frag=4")];
    assert_eq!(sets(&found), expected.map(|(name, set)| (name, set.to_owned())));
}

#[test]
fn a_moodle_download_has_the_files_of_each_participant_together() {
    let intake = take(&[
        ("山田 太郎_12_assignsubmission_file_/ggsample11.vert", "1"),
        ("山田 太郎_12_assignsubmission_file_/ggsample11.frag", "2"),
        ("鈴木 花子_13_assignsubmission_file_ggsample11.frag", "4"),
        ("鈴木 花子_13_assignsubmission_file_ggsample11.vert", "3"),
    ]);
    let sets: Vec<String> = sets(&intake).into_iter().map(|(_, set)| set).collect();
    assert_eq!(sets, ["ggsample11.vert=1 ggsample11.frag=2", "ggsample11.vert=3 ggsample11.frag=4"]);
}

fn given(files: &[(&str, &[u8])]) -> Vec<HandInPart> {
    files.iter().map(|(name, bytes)| HandInPart::File { file: HandedInFile::new(*name, *bytes), local: None }).collect()
}

#[test]
fn one_hand_in_comes_as_files_as_a_folder_or_as_an_archive() {
    let names = |content: HandInContent| match content {
        HandInContent::Files { hand_in, .. } => hand_in.names(),
        HandInContent::Nothing(why) => why.en,
    };
    let right = "ggsample11.vert, ggsample11.frag";
    let files: [(&str, &[u8]); 2] = [("ggsample11.frag", b"2"), ("ggsample11.vert", b"1")];
    assert_eq!(names(one(given(&files), &options())), right);
    let folder = folder(&[("ggsample11.vert", "1"), ("deep/ggsample11.frag", "2"), ("notes.md", "")]);
    assert_eq!(names(one(vec![HandInPart::Path(folder.path().join("class"))], &options())), right);
    let members =
        [builder::ZipMember::stored("x/ggsample11.vert", "1"), builder::ZipMember::stored("x/ggsample11.frag", "2")];
    let archive = builder::archive(&members);
    assert_eq!(names(one(given(&[("mine.zip", &archive)]), &options())), right);
    assert!(names(one(given(&[("mine.vert", &archive)]), &options())).starts_with("There is no `ggsample11.frag`"));
    assert!(names(one(given(&[("mine.zip", b"PK\x03\x04")]), &options())).starts_with("mine.zip: "));
    assert!(names(one(Vec::new(), &options())).starts_with("No file was handed in."));
}

/// What somebody sent, by slot.
fn placed(files: &[(&str, &str)], asked: usize) -> Result<Vec<Option<String>>, String> {
    let given = |(name, text): &(&str, &str)| HandInPart::File { file: HandedInFile::new(*name, *text), local: None };
    let placed = some(files.iter().map(given).collect(), asked, &options()).map_err(|why| why.en)?;
    Ok(placed.into_iter().map(|file| file.map(|file| file.name)).collect())
}

#[test]
fn a_part_of_a_hand_in_goes_to_its_slots() {
    let named = |name: &str| Some(name.to_owned());
    assert_eq!(placed(&[("ggsample11.frag", FRAGMENT)], 0).unwrap(), [None, named("ggsample11.frag")]);
    assert_eq!(placed(&[("one.txt", FRAGMENT), ("two.txt", VERTEX)], 0).unwrap(), [named("two.txt"), named("one.txt")]);
    // One that does not say what it is goes where the person is.
    assert_eq!(placed(&[("notes.txt", "void f() {}")], 1).unwrap(), [None, named("notes.txt")]);
    assert_eq!(placed(&[("a.glsl", "void f() {}")], 0).unwrap(), [named("a.glsl"), None]);
    let double = placed(&[("a.frag", "1"), ("b.frag", "2"), ("a.vert", "3")], 0).unwrap_err();
    assert!(double.starts_with("It is not clear which file is `ggsample11.frag`: `a.frag`, `b.frag`."), "{double}");
    let none = placed(&[("main.cpp", ""), ("a.h", "")], 0).unwrap_err();
    assert!(
        none.starts_with("There is no `ggsample11.vert` and no `ggsample11.frag`, only `main.cpp`, `a.h`."),
        "{none}"
    );
}
