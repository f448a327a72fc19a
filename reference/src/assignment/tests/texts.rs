//! What mistakes and messages are called, and what they say.

use super::*;
use crate::interpreter::Operator;

/// What is said must be said in both languages, and a placeholder must not be left over when its value is not known.
#[test]
fn every_text_stands_in_both_languages_and_can_do_without_values() {
    let a = assignment("ggsample06").expect("built in");
    // A definition is always known, by the student's name or by its symbol.
    let names = a.names.iter().filter_map(|(name, own)| Some((name.as_str(), own.symbol.as_deref()?)));
    let names: Vec<(&str, &str)> = names.collect();
    for mistake in &a.mistakes {
        for text in [&mistake.seen, &mistake.equation, &mistake.look] {
            let bare = text.fill(&names);
            for wording in [&bare.en, &bare.ja] {
                assert!(!wording.trim().is_empty(), "{}", mistake.id);
                assert!(!wording.contains(['{', '⟨', '⟩']) && !wording.contains("  "), "{}: {wording}", mistake.id);
            }
            assert!(bare.en.is_ascii() || !bare.en.contains(['。', '、']));
            assert!(bare.ja.contains(['。', '?']), "{}: {}", mistake.id, bare.ja);
            let places = [("line", "7"), ("name", "h"), ("expected", "1"), ("found", "2"), ("frames", "25")];
            let full = text.fill(&[&places[..], &names].concat());
            assert!(!full.en.contains('{') && !full.ja.contains('{'));
        }
    }
}

#[test]
fn the_mistakes_of_the_contract_are_there() {
    let a = assignment("ggsample06").expect("built in");
    for id in [
        "unchanged",
        "ambient-missing",
        "ambient-added",
        "diffuse-missing",
        "diffuse-unclamped",
        "diffuse-abs",
        "diffuse-factor-missing",
        "specular-missing",
        "specular-phong",
        "specular-half-unnormalized",
        "specular-no-exponent",
        "specular-wrong-exponent",
        "specular-unclamped",
        "specular-view-reversed",
        "specular-uses-diffuse-colour",
        "specular-gated",
        "normal-not-transformed",
        "normal-wrong-transform",
        "position-changed",
        "constants-changed",
        "hard-coded",
        "flat-per-triangle",
        "gamma",
        "clamped-early",
        "unexplained",
    ] {
        let mistake = a.mistake(id).expect(id);
        assert!(mistake.keeps.iter().any(|(_, kept)| *kept < 1.0), "{id} costs nothing");
    }
    for line in &a.rubric {
        assert_eq!(a.mistake("unchanged").expect("there").keeps(&line.id), 0.0);
    }
}

#[test]
fn what_goes_wrong_in_any_homework_has_texts_until_a_folder_has_its_own() {
    let (waves, lecture) = (waves(), assignment("ggsample06").expect("built in"));
    for id in ["position-changed", "constants-changed", "hard-coded", "nearly-right", "unexplained"] {
        let (general, own) = (waves.mistake(id).expect(id), lecture.mistake(id).expect(id));
        assert_ne!(general.seen, own.seen, "{id}");
    }
    let kept = |id: &str, line: &str| waves.mistake(id).expect(id).keeps(line);
    assert_eq!([kept("position-changed", "surface"), kept("position-changed", "colour")], [0.0, 1.0]);
    assert_eq!([kept("unexplained", "surface"), kept("unexplained", "colour")], [1.0, 0.0]);
}

#[test]
fn where_no_line_judges_the_position_the_lines_pay_whose_feature_moves_something() {
    let kept = |lines: [&str; 2]| {
        let line = |(at, replace): (usize, &str)| {
            format!(
                "[[rubric]]\nid = \"line{at}\"\npoints = 50\nlabel = {{ en = \"Line\", ja = \"行\" }}\n\
                 without = {{ replace = [[\"{replace}\", \"0.0\"]] }}\n\n"
            )
        };
        let lines: String = lines.into_iter().enumerate().map(line).collect();
        let assignment =
            Assignment::load(with_rubric(homework("waves"), &lines)).unwrap_or_else(|error| panic!("{error}"));
        ["line0", "line1"].map(|id| assignment.mistake("position-changed").expect("general").keeps(id))
    };
    assert_eq!(kept(["height(waves[0], position.xz)", "0.4"]), [0.0, 1.0]);
    assert_eq!(kept(["0.2", "0.4"]), [0.5, 0.5]);
}

#[test]
fn what_a_solution_of_branches_computes_has_names_of_the_lecture() {
    let said = "\n[definition.n]\nmeans = { en = \"the normal vector\", ja = \"法線ベクトル\" }\n\n[[rubric]]\n";
    let named = Assignment::load(changed(homework("toon"), "assignment.toml", "\n[[rubric]]\n", said));
    let mistake = named.expect("a homework").repaired(Operator::NormalizeLeftOut, Some("n"), false);
    assert_eq!(
        (mistake.id.as_str(), mistake.title.en.as_str()),
        ("derived-normalize-missing-n", "Vector not of length 1 (the normal vector)")
    );
    let said = mistake.look.fill(&[("line", "7"), ("name", "m")]).en;
    assert!(said.starts_with("The normal vector (here `m`) on line 7 does not have length 1."), "{said}");
    // What has no name is called as the student calls it, and nothing where that is not known.
    let toon = Assignment::load(homework("toon")).expect("a homework");
    let look = toon.repaired(Operator::NormalizeLeftOut, None, false).look;
    assert!(look.fill(&[("name", "m")]).en.starts_with("`m` does not have length 1."), "{look:?}");
    assert!(look.fill(&[]).en.starts_with("The result does not have length 1."), "{look:?}");
    let said = "\n[definition.nn]\nsymbol = \"N\"\n\n[[rubric]]\n";
    let other = refused(changed(homework("toon"), "assignment.toml", "\n[[rubric]]\n", said)).en;
    assert!(other.contains("definition `nn`: the solution computes no `nn`; it computes "), "{other}");
}
