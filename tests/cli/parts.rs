//! The parts of a solution: each that shows has a line of the rubric, and the rest of the colour has its own.

use super::authoring::Written;
use super::ggrade;
use std::fs;

#[test]
fn a_part_that_shows_nowhere_is_told() {
    let written = Written::from(&["leaf.frag"]);
    assert!(
        written.said.contains("`translucency`: within"),
        "bounds in which all shows are proposed: {}",
        written.said
    );
    let manifest = written.text("assignment.toml");
    let (before, entry) = manifest.split_once("name = \"translucency\"").unwrap();
    let (bounds, rest) = (entry.find("probe = ").unwrap(), entry.find("] }").unwrap() + 3);
    let narrow = format!(
        "{before}name = \"translucency\"{}probe = {{ within = [0.25, 1.0] }}{}",
        &entry[..bounds],
        &entry[rest..]
    );
    fs::write(written.folder().join("assignment.toml"), narrow).unwrap();
    let checked = ggrade().args(["assignment", "check"]).arg(written.folder()).args(["--lang", "en"]).assert().code(0);
    let said = String::from_utf8_lossy(&checked.get_output().stdout).into_owned();
    let line = said.lines().find(|line| line.contains("solution.frag:")).unwrap_or_else(|| panic!("{said}"));
    assert!(line.contains("`lit + (0.1 * translucency)` in place of `min(lit + (0.1 * translucency), 1.5)`"), "{line}");
    assert!(line.contains("solution.frag:20:") && line.contains("with `translucency` = "), "{line}");
}

#[test]
fn what_no_part_shows_has_a_line_of_its_own() {
    // Two operators are parts that can be taken out; what is wrong in a third one is beside both.
    let written = Written::from(&["tonemap.frag"]);
    written.tells("vec3(0.2126, 0.7152, 0.0722)", "vec3(0.299, 0.587, 0.114)");
    let manifest = written.text("assignment.toml");
    assert!(manifest.contains("id = \"aces\"") && manifest.contains("id = \"colour\""), "{manifest}");
}

#[test]
fn the_rest_of_the_colour_is_judged_where_no_part_shows() {
    let written = Written::from(&["strand.frag"]);
    // It shows only where the lamps do, which have a line of their own; that line's normal is right, and what is made of it is not.
    let report = written.graded(&[("strand * wrapped", "fract(strand * 9.7)")]);
    let points = |id: &str| {
        let lines = report["rubric"].as_array().unwrap();
        let line = lines.iter().find(|line| line["id"] == id).unwrap();
        line["points"].as_f64().unwrap() / line["max_points"].as_f64().unwrap()
    };
    assert_eq!((points("colour"), points("n")), (1.0, 0.4), "{report:#}");
    // The floor and the sky light what no lamp does.
    let swapped = written.graded(&[("mix(floorColour, skyColour, 0.5 + 0.5 * n.y)", "floorColour * skyColour")]);
    assert!(swapped["rubric"][0]["id"] == "colour" && swapped["rubric"][0]["points"].as_f64() < Some(50.0));
}
