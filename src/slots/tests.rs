//! Which file is for which slot.

use super::*;
use crate::hand_in::HandedInFile;
use reference::assignment::{HandedIn, Solution};
use reference::interpreter::Stage;

pub(crate) fn slot(name: &str, stage: Stage) -> HandedIn {
    let solution = Solution { name: String::new(), text: String::new() };
    let (starter, starter_name) = (String::new(), String::new());
    HandedIn { name: name.into(), stage, starter, starter_name, solution, program: None, accepted: vec![] }
}

/// The slots of a homework of two files.
pub(crate) fn both() -> Vec<HandedIn> {
    vec![slot("ggsample11.vert", Stage::Vertex), slot("ggsample11.frag", Stage::Fragment)]
}

/// The names of the files by slot, or what is said instead.
fn filled(slots: &[Slot], files: &[(&str, &str)], trust: Trust) -> Result<Vec<String>, String> {
    let files = files.iter().map(|(name, text)| HandedInFile::new(*name, *text)).collect();
    match arrange(slots, &HandIn { files }, trust) {
        Ok(arranged) => Ok(arranged.files.into_iter().map(|file| file.name).collect()),
        Err(text) => {
            assert!(!text.ja.is_empty());
            Err(text.en)
        }
    }
}

const VERTEX: &str = "#version 410\nin vec4 pv;\nvoid main() { gl_Position = pv; }\n";
const FRAGMENT: &str =
    "#version 410\nlayout (location = 0) out vec4 fc; // no gl_Position here\nvoid main() { fc = vec4(1); }\n";

#[test]
fn each_file_goes_to_its_slot() {
    for (files, expected) in [
        ([("ggsample11.frag", "f"), ("ggsample11.vert", "v")], ["ggsample11.vert", "ggsample11.frag"]),
        ([("GGSAMPLE11.Frag", "f"), ("ggsample11 (1).vert", "v")], ["ggsample11 (1).vert", "GGSAMPLE11.Frag"]),
        ([("mine.frag", "f"), ("other.vert", "v")], ["other.vert", "mine.frag"]),
        ([("a.fs", "f"), ("a.vs", "v")], ["a.vs", "a.fs"]),
        ([("ggsample11.frag.txt", "f"), ("ggsample11.vert.txt", "v")], ["ggsample11.vert.txt", "ggsample11.frag.txt"]),
        ([("one.glsl", FRAGMENT), ("two.glsl", VERTEX)], ["two.glsl", "one.glsl"]),
        ([("fragment.glsl", "f"), ("vertex.glsl", "v")], ["vertex.glsl", "fragment.glsl"]),
        ([("frag.txt", "f"), ("a.vs.txt", "v")], ["a.vs.txt", "frag.txt"]),
        ([("fs", "f"), ("vs", "v")], ["vs", "fs"]),
        ([("a.txt", FRAGMENT), ("b", VERTEX)], ["b", "a.txt"]),
        // By name before the text: who swaps the two is told so by the compiler.
        ([("ggsample11.vert", FRAGMENT), ("ggsample11.frag", VERTEX)], ["ggsample11.vert", "ggsample11.frag"]),
        ([("ggsample11.vert", VERTEX), ("ggsample11.txt", FRAGMENT)], ["ggsample11.vert", "ggsample11.txt"]),
    ] {
        assert_eq!(filled(&both(), &files, Trust::Found).unwrap(), expected, "{files:?}");
    }
}

#[test]
fn a_file_that_is_given_twice_is_one_file() {
    let twice = [("ggsample11.vert", VERTEX), ("ggsample11.vert", VERTEX)];
    let said = filled(&both(), &twice, Trust::Named).unwrap_err();
    assert!(said.starts_with("There is no `ggsample11.frag`, only `ggsample11.vert` × 2."), "{said}");
}

#[test]
fn what_lies_beside_is_left_aside() {
    let files =
        [("readme.txt", "hello"), ("ggsample11.vert", "v"), ("old.vert", "o"), ("main.cpp", ""), ("x.frag", "f")];
    assert_eq!(filled(&both(), &files, Trust::Found).unwrap(), ["ggsample11.vert", "x.frag"]);
}

#[test]
fn what_is_missing_is_named() {
    let one = filled(&both(), &[("ggsample11.vert", VERTEX)], Trust::Named).unwrap_err();
    assert_eq!(
        one,
        "There is no `ggsample11.frag`, only `ggsample11.vert`. Hand in `ggsample11.vert` and `ggsample11.frag` together."
    );
    let none = filled(&both(), &[], Trust::Named).unwrap_err();
    assert_eq!(none, "No file was handed in. `ggsample11.vert` and `ggsample11.frag` are what is graded.");
    let neither = filled(&both(), &[("a.cpp", ""), ("b.png", "")], Trust::Named).unwrap_err();
    assert!(
        neither.starts_with("There is no `ggsample11.vert` and no `ggsample11.frag`, only `a.cpp`, `b.png`. A picture")
    );
}

#[test]
fn what_is_double_is_named_unless_it_is_the_same() {
    let double = [("a.vert", "1"), ("b.vert", "2"), ("ggsample11.frag", "f")];
    let message = filled(&both(), &double, Trust::Named).unwrap_err();
    assert!(message.starts_with("It is not clear which file is `ggsample11.vert`: `a.vert`, `b.vert`."), "{message}");
    let same = [("a.vert", "1"), ("b.vert", "1"), ("ggsample11.frag", "f")];
    assert_eq!(filled(&both(), &same, Trust::Found).unwrap(), ["a.vert", "ggsample11.frag"]);
    let both_at_once = filled(&both(), &[("a.vert", "1"), ("b.vert", "2")], Trust::Named).unwrap_err();
    assert!(both_at_once.contains("which file is `ggsample11.vert`") && both_at_once.contains("no `ggsample11.frag`"));
}

#[test]
fn two_slots_of_one_stage_are_told_apart_by_name_alone() {
    let slots = [slot("depth.vert", Stage::Vertex), slot("shade.vert", Stage::Vertex)];
    assert_eq!(
        filled(&slots, &[("shade.vert", "s"), ("depth (2).vert", "d")], Trust::Found).unwrap(),
        ["depth (2).vert", "shade.vert"]
    );
    let message = filled(&slots, &[("a.vert", "1"), ("b.vert", "2")], Trust::Named).unwrap_err();
    assert!(message.contains("which file is `depth.vert`") && message.contains("which file is `shade.vert`"));
    assert_eq!(
        filled(&slots, &[("shade.vert", "s"), ("x.vert", "d")], Trust::Found).unwrap(),
        ["x.vert", "shade.vert"]
    );
}

#[test]
fn a_file_that_a_person_names_needs_no_name_of_its_own() {
    let slots = [slot("ggsample06.vert", Stage::Vertex)];
    for name in ["", "answer", "ggsample06.frag", "x.cpp"] {
        assert_eq!(filled(&slots, &[(name, "x")], Trust::Named).unwrap(), [name]);
        assert!(filled(&slots, &[(name, "x")], Trust::Found).is_err());
    }
    assert_eq!(
        filled(&both(), &[("ggsample11.vert", VERTEX), ("answer", "x")], Trust::Named).unwrap(),
        ["ggsample11.vert", "answer"]
    );
}

#[test]
fn names_are_ranked() {
    for (name, expected) in [
        ("ggsample06.vert", NameFit::Exact),
        ("GGSample06.VERT", NameFit::Exact),
        ("ggsample06 (1).vert", NameFit::Copy),
        ("ggsample06(2).vert", NameFit::Copy),
        ("ggsample06 - Copy.vert", NameFit::Copy),
        ("ggsample06 - Copy (2).vert", NameFit::Copy),
        ("ggsample06 - コピー.vert", NameFit::Copy),
        ("ggsample06 - コピー (3).vert", NameFit::Copy),
        ("ggsample06のコピー.vert", NameFit::Copy),
        ("ggsample06 copy 2.vert", NameFit::Copy),
        ("ggsample06 2.vert", NameFit::Copy),
        ("ggsample06_1234567890.vert", NameFit::Copy),
        ("ggsample06-1.vert", NameFit::Copy),
        ("ggsample05.vert", NameFit::Shader),
        ("ggsample0.vert", NameFit::Shader),
        ("ggsample061.vert", NameFit::Shader),
        ("kadai6_s2012345.vert", NameFit::Shader),
        ("ggsample06.vert.txt", NameFit::Renamed),
        ("ggsample06.txt", NameFit::Renamed),
        ("ggsample06", NameFit::Renamed),
        ("ggsample06 (1).txt", NameFit::Renamed),
        ("answer.glsl", NameFit::Renamed),
        ("old.vert.txt", NameFit::Renamed),
        ("ggsample06.vert.bak", NameFit::Renamed),
        ("readme.txt", NameFit::Text),
        ("LICENSE", NameFit::Text),
        ("ggsample06.frag", NameFit::Other),
        ("ggsample06.docx", NameFit::Other),
        ("ggsample06.cpp", NameFit::Other),
        ("(1).vert", NameFit::Shader),
        ("", NameFit::Text),
    ] {
        assert_eq!(fit(name, &slot("ggsample06.vert", Stage::Vertex)), expected, "{name}");
    }
}

/// The names of what is placed by slot, or what is said instead.
fn placed(files: &[(&str, &str)]) -> Result<Vec<Option<String>>, Vec<SlotProblem>> {
    let files: Vec<_> = files.iter().map(|(name, text)| HandedInFile::new(*name, *text)).collect();
    let placed = place(&both(), &files)?;
    Ok(placed.into_iter().map(|index| index.map(|index| files[index].name.clone())).collect())
}

#[test]
fn a_part_of_the_files_is_placed_by_itself() {
    let named = |name: &str| Some(name.to_owned());
    assert_eq!(placed(&[("mine.fs", "f")]).unwrap(), [None, named("mine.fs")]);
    assert_eq!(placed(&[("x.glsl", VERTEX), ("main.cpp", "")]).unwrap(), [named("x.glsl"), None]);
    assert_eq!(placed(&[("a.frag", "f"), ("b.vert", "v")]).unwrap(), [named("b.vert"), named("a.frag")]);
    assert_eq!(placed(&[("main.cpp", "")]).unwrap(), [None, None]);
    let double = placed(&[("a.frag", "1"), ("b.frag", "2")]).unwrap_err();
    assert_eq!(double, [SlotProblem::Several { slot: 1, files: vec![0, 1] }]);
}

#[test]
fn files_whose_slots_are_known_are_found_there_again() {
    let kept = |names: [&str; 2]| {
        let files = names.map(|name| HandedInFile::new(name, name)).into();
        let kept = keep_order(&both(), HandIn { files });
        let contents: Vec<_> =
            kept.files.iter().map(|file| String::from_utf8_lossy(&file.bytes).into_owned()).collect();
        assert_eq!(contents, names, "nothing changes its place");
        let found = fill(&both(), &kept.files, Trust::Named);
        assert_eq!(found, Ok(vec![0, 1]), "{names:?}");
        kept.files.into_iter().map(|file| file.name).collect::<Vec<_>>()
    };
    assert_eq!(kept(["mine.vert", "other.frag"]), ["mine.vert", "other.frag"]);
    assert_eq!(kept(["ggsample11.vert", "notes.txt"]), ["ggsample11.vert", "notes.txt"]);
    // Names that say something else than the person who put the files there.
    assert_eq!(kept(["mine.frag", "mine.vert"]), ["ggsample11.vert", "ggsample11.frag"]);
    assert_eq!(kept(["a.txt", "b.txt"]), ["ggsample11.vert", "ggsample11.frag"]);
}
