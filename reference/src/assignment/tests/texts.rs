//! What mistakes and messages are called, and what they say.

use super::*;

/// What is said must be said in both languages, and a placeholder must not be left over when its value is not known.
#[test]
fn every_text_stands_in_both_languages_and_can_do_without_values() {
    let a = assignment("ggsample06").expect("built in");
    // A definition is always known, by the student's name or by its symbol.
    let definitions = a.equation.definitions().iter();
    let names: Vec<(&str, &str)> =
        definitions.filter_map(|one| Some((one.name.as_str(), one.symbol.as_deref()?))).collect();
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
