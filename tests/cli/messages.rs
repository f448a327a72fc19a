//! What a report says, and how much of it by the mode of hints.

use super::{ggrade, json, sample, sample_like};
use predicates::prelude::*;

/// What one line of a sample's rubric says.
fn said(name: &str, line: &str) -> (String, Option<u64>) {
    let report = json(&sample(name), &["--lang", "en", "--seed", "1"]);
    let lines = report["rubric"].as_array().unwrap();
    let line = lines.iter().find(|found| found["id"] == line).unwrap();
    (line["message"].as_str().unwrap().to_owned(), line["line"].as_u64())
}

#[test]
fn a_term_that_is_0_is_not_called_missing_from_the_sum() {
    let (message, line) = said("wrong/diffuse-missing--scaled-by-0.vert", "diffuse");
    assert!(message.contains("its value is 0 everywhere: look at line 40"), "{message}");
    assert_eq!(line, Some(40));
    let (message, _) = said("wrong/specular-missing--function-not-called.vert", "specular");
    assert!(message.contains("does not appear in the sum"), "{message}");
}

#[test]
fn a_message_names_only_what_stands_in_the_file() {
    // Without `pow`, nothing is asked about it; vectors have the student's names.
    let (message, _) = said("wrong/diffuse-with-exponent--cosine-times-itself.vert", "diffuse");
    assert!(!message.contains("`pow`") && message.contains("How often is the cosine multiplied"), "{message}");
    let (message, _) = said("wrong/specular-phong--own-names.vert", "specular");
    assert!(message.contains("halfway between `toLight` and `toEye`"), "{message}");
}

#[test]
fn without_hints_no_view_names_a_mistake_or_a_line() {
    const TITLE: &str = "Half vector not normalised";
    let half = sample_like("wrong", "specular-half-unnormalized--");
    let formats = "text json html gradescope github classroom-legacy junit sarif vpl coderunner";
    for format in formats.split_whitespace() {
        let run = |hints: &str| {
            let output = ggrade()
                .args(["grade", "-", "--seed", "1", "--lang", "en", "--hints", hints, "--format", format])
                .write_stdin(std::fs::read(&half).unwrap())
                .output()
                .unwrap();
            String::from_utf8(output.stdout).unwrap()
        };
        let none = run("none");
        // SARIF lists all rules that there are; none of its results may be of the mistake's.
        let said = if format == "sarif" { none[none.find("\"results\"").unwrap()..].to_owned() } else { none };
        assert!(!said.contains("specular-half-unnormalized") && !said.contains(TITLE), "{format}: {said}");
        assert!(!said.contains("on line ") && !said.contains("at line "), "{format}: {said}");
        // These three have points and words, and name no mistake; what people read has the title.
        let is_without = ["classroom-legacy", "vpl", "coderunner"].contains(&format);
        let name = if ["text", "github"].contains(&format) { TITLE } else { "specular-half-unnormalized" };
        assert!(is_without || run("full").contains(name), "{format}");
    }
    let report = json(&half, &["--hints", "none"]);
    assert_eq!(report["mistakes"], serde_json::json!([]));
    for line in report["rubric"].as_array().unwrap() {
        assert_eq!((&line["mistake"], &line["line"]), (&serde_json::Value::Null, &serde_json::Value::Null));
    }
}

#[test]
fn hints_on_errors_follow_the_mode() {
    let broken = sample("rejected/undeclared-capital-max.vert");
    for (hints, has_hint) in [("none", false), ("gentle", true), ("full", true)] {
        let report = json(&broken, &["--hints", hints]);
        let error = &report["diagnostics"][0];
        assert!(error["line"].is_u64() && !error["message"].as_str().unwrap().is_empty());
        assert_eq!(error["hint"].is_string(), has_hint, "{hints}: {error}");
    }
}

#[test]
fn advice_costs_nothing_and_does_not_depend_on_the_seed() {
    let answer = sample("accepted/advice/normal-length--matrix-only.vert");
    for seed in ["1", "2", "77"] {
        let report = json(&answer, &["--lang", "en", "--seed", seed]);
        assert_eq!((&report["verdict"], &report["score"]), (&"correct".into(), &100.into()));
        let advice = report["advice"].as_array().unwrap();
        assert_eq!(advice.len(), 1, "{advice:?}");
        assert_eq!((&advice[0]["id"], &advice[0]["line"]), (&"normal-length".into(), &36.into()));
        assert_eq!(advice[0]["file"], "normal-length--matrix-only.vert");
    }
    ggrade()
        .args(["grade", "--lang", "en"])
        .arg(&answer)
        .assert()
        .code(0)
        .stdout(predicate::str::contains("For your next shader\n  The normals of this homework have length 1."));
    ggrade()
        .args(["grade", "--lang", "en", "--format", "html"])
        .arg(&answer)
        .assert()
        .code(0)
        .stdout(predicate::str::contains("id=\"advice\"").and(predicate::str::contains("<a href=\"#L36\">")));
    let sarif = ggrade().args(["grade", "--format", "sarif"]).arg(&answer).output().unwrap();
    let sarif: serde_json::Value = serde_json::from_slice(&sarif.stdout).unwrap();
    let result = &sarif["runs"][0]["results"][0];
    assert_eq!((&result["ruleId"], &result["level"]), (&"normal-length".into(), &"note".into()));
    assert_eq!(json(&answer, &["--hints", "none"])["advice"], serde_json::json!([]));
}
