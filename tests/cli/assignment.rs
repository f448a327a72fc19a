//! What `ggrade assignment` says of folders: which there are, what one asks for, and what its check finds.

use super::folders::{Copy, MANIFEST};
use super::ggrade;
use std::fs;

/// What the lines of `toon` lack.
const TONES: &str = "without = { replace = [[\"floor(lit * float(tones)) / float(tones)\", \"lit\"]] }";
const OUTLINE: &str = "without = { replace = [[\"< 0.3)\", \"< -2.0)\"]] }";

#[test]
fn a_folder_is_checked_by_its_own_files() {
    let check = |copy: &Copy| ggrade().args(["assignment", "check"]).arg(copy.folder()).output().unwrap();
    let copy = Copy::new();
    let output = check(&copy);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("ok   the solution: Correct, 100 of 100 points"), "{said}");
    assert!(said.contains("ok   what is handed out: Wrong, 0 of 100 points"), "{said}");
    // What is handed out must leave something to do.
    fs::copy(copy.path("solution.vert"), copy.path("starter.vert")).unwrap();
    let output = check(&copy);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("FAIL what is handed out: Correct"), "{said}");
}

#[test]
fn a_check_says_what_each_line_is_judged_by() {
    let check = |copy: &Copy| {
        let output = ggrade().args(["assignment", "check"]).arg(copy.folder()).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let (code, said) = check(&Copy::of("tests/homeworks/toon"));
    assert_eq!(code, Some(0), "{said}");
    for line in ["tones", "outline"] {
        assert!(said.contains(&format!("ok   rubric line `{line}`: shows at ")), "{said}");
    }
    assert!(said.contains("ok   mistake `tones-rounded`: shows at "), "{said}");
    // Of two lines that show at the same places neither can be judged.
    let everywhere =
        |grey: &str| format!("without = {{ replace = [[\"tint = vec4(colour, 1.0)\", \"tint = vec4({grey})\"]] }}");
    let copy = Copy::of("tests/homeworks/toon").replace(MANIFEST, OUTLINE, &everywhere("-1.0"));
    let (code, said) = check(&copy.replace(MANIFEST, TONES, &everywhere("2.0")));
    assert_eq!(code, Some(0), "{said}");
    assert!(
        said.contains("note rubric line `tones`: shows at ") && said.contains("so that no probe judges it alone"),
        "{said}"
    );
    // A line without `without` judges the rest; where there are two, nothing tells what either judges.
    let line =
        |id: &str| format!("[[rubric]]\nid = \"{id}\"\npoints = 10\nlabel = {{ en = \"Rest\", ja = \"残り\" }}\n\n");
    let with = |lines: &str| {
        let copy = Copy::of("tests/homeworks/toon");
        let text =
            fs::read_to_string(copy.path(MANIFEST)).unwrap().replacen("[[rubric]]", &format!("{lines}[[rubric]]"), 1);
        let number = text.lines().position(|own| own == "id = \"rest\"").unwrap() + 1;
        fs::write(copy.path(MANIFEST), text).unwrap();
        (number, check(&copy).1)
    };
    let (number, said) = with(&line("rest"));
    let place = format!("assignment.toml:{number}: rubric line `rest`: has no `without`");
    assert!(said.contains(&format!("ok   {place}, so it judges the colour where no other line shows")), "{said}");
    let (number, said) = with(&(line("rest") + &line("more")));
    let place = format!("assignment.toml:{number}: rubric line `rest`: has no `without`");
    assert!(said.contains(&format!("note {place}, and neither has another line")), "{said}");
    // A mistake that shows nothing, and two that show the same.
    let ceil = "\"ceil(lit * float(tones))\"";
    let (code, said) =
        check(&Copy::of("tests/homeworks/toon").replace(MANIFEST, ceil, "\"floor(lit * float(tones) * 1.0)\""));
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("FAIL mistake `tones-rounded`, variant 1: shows at no probe"), "{said}");
    let (code, said) =
        check(&Copy::of("tests/homeworks/toon").replace(MANIFEST, ceil, "\"round(lit * float(tones))\""));
    assert_eq!(code, Some(2), "{said}");
    let same = "FAIL mistake `tones-rounded`, variant 1: shows the same as mistake `tones-rounded`, variant 0";
    assert!(said.contains(same), "{said}");
}

#[test]
fn a_check_draws_what_lacks_something_and_names_what_is_not_translated() {
    let copy = Copy::of("tests/homeworks/toon").replace(MANIFEST, "ja = \"輪郭線\"", "ja = \"Outline\"");
    let pictures = copy.around.path().join("pictures");
    let mut command = ggrade();
    let output =
        command.args(["assignment", "check"]).arg(copy.folder()).arg("--pictures").arg(&pictures).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("note rubric `outline`, label: the same in both languages"), "{said}");
    let picture = |name: &str| fs::read(pictures.join(format!("{name}.png"))).unwrap();
    let all = ["solution", "handed-out", "without-tones", "without-outline", "tones-rounded-0"].map(picture);
    for (place, own) in all.iter().enumerate() {
        assert!(own.starts_with(b"\x89PNG") && all[..place].iter().all(|other| other != own), "picture {place}");
    }
}

#[test]
fn the_built_in_assignments_are_listed_with_their_files() {
    let output = ggrade().args(["assignment", "list"]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0));
    assert!(said.lines().any(|line| line.starts_with("ggsample06  ggsample06.vert  ")), "{said}");
    assert!(said.lines().any(|line| line.starts_with("flat  flat.vert, flat.frag  ")), "{said}");
    assert!(said.lines().any(|line| line.starts_with("gouraud-point-light  gouraud.vert  ")), "{said}");
    assert!(said.lines().count() >= 17, "{said}");
}

#[test]
fn a_folder_is_shown_as_a_person_reads_it() {
    for (language, parts) in [
        (
            "en",
            [
                "ggsample06: Gouraud shading",
                "vec4 pv  carries position",
                "diffuse  30 points",
                "specular-half-unnormalized",
            ],
        ),
        ("ja", ["グーローシェーディング", "mat4 mc  役割 model-view-projection", "合計 100 点", "ダイジェスト"]),
    ] {
        let mut command = ggrade();
        let assert = command.args(["assignment", "show", "ggsample06", "--lang", language]).assert().code(0);
        let said = String::from_utf8_lossy(&assert.get_output().stdout).into_owned();
        parts.iter().for_each(|part| assert!(said.contains(part), "{part} in {said}"));
    }
    ggrade().args(["assignment", "show", "no-such"]).assert().code(2);
}
