//! Gradescope: `results.json` of one submission, as Gradescope's "Autograder Specifications" describe it.

use super::untrusted::{html, one_line, rich_html};
use super::wording;
use crate::class::standing::Standing;
use crate::class::{ClassEntry, Outcome};
use crate::language::Language;
use crate::report::labels::Labels;
use crate::report::{Report, RubricLine};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// The file for `entry`; `expected` is the PNG of what a right answer draws.
///
/// After a failure of ours there is no score at all, neither for the submission nor for a test: Gradescope then shows
/// that the autograder failed, keeps the submission without a grade, and offers to run it again.
pub fn render(entry: &ClassEntry, expected: &[u8], language: Language) -> String {
    let mut results = json!({
        "output": output(entry, expected, language),
        "output_format": "html",
        "test_name_format": "text",
        "test_output_format": "html",
        "visibility": "visible",
        "stdout_visibility": "hidden",
    });
    match &entry.outcome {
        Outcome::Graded(report) => {
            results["score"] = json!(report.total());
            results["execution_time"] = json!(seconds(report));
            results["tests"] = report.rubric.iter().zip(1..).map(|(line, n)| test(line, n, language)).collect();
        }
        // What was handed in cannot be graded, which handing in again mends.
        Outcome::NotGraded(_) => results["score"] = json!(0),
        Outcome::Fault(_) => results["tests"] = json!([staff_only(entry, language)]),
    }
    results["extra_data"] = extra_data(entry);
    let mut text = format!("{results:#}");
    text.push('\n');
    text
}

fn test(line: &RubricLine, number: usize, language: Language) -> Value {
    json!({
        "name": one_line(line.label.get(language)),
        "number": number.to_string(),
        "score": line.points,
        "max_score": line.max_points,
        "status": if wording::is_full(line) { "passed" } else { "failed" },
        "output": rich_html(line.message.get(language)),
        "tags": line.mistake.iter().map(|mistake| one_line(mistake)).collect::<Vec<_>>(),
        "visibility": "visible",
    })
}

/// What only the course's staff sees of a failure.
fn staff_only(entry: &ClassEntry, language: Language) -> Value {
    json!({
        "name": Standing::Fault.word(language),
        "status": "failed",
        "output": rich_html(&wording::fault(entry, language).unwrap_or_default()),
        "visibility": "hidden",
    })
}

/// What is said of the submission as a whole, as HTML.
fn output(entry: &ClassEntry, expected: &[u8], language: Language) -> String {
    let mut output = format!(
        "<p><strong>{}</strong></p>\n<p>{}</p>\n",
        html(Standing::of(&entry.outcome).word(language)),
        rich_html(&wording::explanation(entry, language))
    );
    if let Some(portrait) = &entry.portrait {
        let labels = Labels::of(language);
        output.push_str(&format!(
            "<p>{} {}</p>\n",
            picture(labels.yours, portrait),
            picture(labels.expected, expected)
        ));
    }
    if entry.diagnostics().next().is_some() {
        let item = |(report, diagnostic)| {
            let place = html(&wording::place(report, diagnostic, language));
            format!("<li><strong>{place}</strong><br>{}</li>\n", rich_html(&wording::message(diagnostic, language)))
        };
        output.push_str(&format!("<ul>\n{}</ul>\n", entry.diagnostics().map(item).collect::<String>()));
    }
    if let Some(next) = wording::next_step(entry, language) {
        output.push_str(&format!("<p>→ {}</p>\n", rich_html(&next)));
    }
    output
}

fn picture(name: &str, png: &[u8]) -> String {
    format!("{} <img alt=\"{}\" src=\"data:image/png;base64,{}\">", html(name), html(name), STANDARD.encode(png))
}

/// For scripts on the exported submissions; students do not see it.
fn extra_data(entry: &ClassEntry) -> Value {
    let mut data = json!({ "schema": "ggrade/gradescope/v1", "verdict": Standing::of(&entry.outcome).id() });
    if let Some(report) = entry.report() {
        data["assignment"] = json!(report.assignment);
        data["mistakes"] = json!(report.mistakes);
        data["sha256"] = json!(report.sha256());
        data["seed"] = json!(report.probes.seed);
        data["ggrade"] = json!(report.environment.ggrade);
    }
    data
}

/// Seconds, to the hundredth.
fn seconds(report: &Report) -> f64 {
    (report.elapsed_ms / 10.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::formats::nasty;
    use crate::report::samples;
    use scraper::Html;

    fn results(entry: &ClassEntry, language: Language) -> Value {
        let results = serde_json::from_str(&render(entry, nasty::PNG, language)).expect("JSON");
        let schema = include_str!("../../../tests/schemas/gradescope-results.schema.json");
        let schema = serde_json::from_str(schema).expect("a schema");
        let validator = jsonschema::validator_for(&schema).expect("a valid schema");
        let errors: Vec<_> = validator.iter_errors(&results).map(|error| error.to_string()).collect();
        // A result without any score is what a failure of ours is reported by.
        let expected = if matches!(entry.outcome, Outcome::Fault(_)) { 1 } else { 0 };
        assert_eq!(errors.len(), expected, "{errors:?}");
        results
    }

    #[test]
    fn rubric_lines_are_tests_with_partial_scores_that_add_up() {
        let class = nasty::class();
        for entry in class.entries.iter().filter(|entry| entry.report().is_some()) {
            let results = results(entry, Language::En);
            let of = |field| results["tests"].as_array().unwrap().iter().map(|t| t[field].as_f64().unwrap()).sum();
            let (score, max): (f64, f64) = (of("score"), of("max_score"));
            assert_eq!((Some(score), max), (results["score"].as_f64(), 100.0));
        }
        let wrong = results(&class.entries[1], Language::Ja);
        let specular = &wrong["tests"][3];
        assert_eq!((&specular["name"], &specular["status"]), (&json!("鏡面反射光"), &json!("failed")));
        assert_eq!((&specular["score"], &specular["max_score"]), (&json!(20.0), &json!(40.0)));
        assert_eq!(specular["tags"], json!(["specular-half-unnormalized"]));
        assert_eq!(wrong["tests"][0]["status"], "passed");
        // 412.25 ms.
        assert_eq!(wrong["execution_time"], json!(0.41));
    }

    #[test]
    fn a_rejection_says_where() {
        let results = results(&nasty::class().entries[2], Language::En);
        assert_eq!(results["score"], json!(0.0));
        let output = results["output"].as_str().unwrap();
        assert!(
            output.contains("line 11, column 12") && output.contains("<code>Max</code> is not declared"),
            "{output}"
        );
    }

    #[test]
    fn a_failure_of_ours_has_no_score_anywhere() {
        let results = results(&nasty::class().entries[5], Language::En);
        assert!(results.get("score").is_none());
        let tests = results["tests"].as_array().unwrap();
        assert!(tests.iter().all(|test| test.get("score").is_none() && test["visibility"] == "hidden"));
        assert!(tests[0]["output"].as_str().unwrap().contains("no driver"));
        let output = results["output"].as_str().unwrap();
        assert!(output.contains("costs no points") && !output.contains("/usr/share"), "{output}");
    }

    #[test]
    fn nothing_handed_in_scores_0_and_says_what_is_missing() {
        let results = results(&nasty::class().entries[4], Language::En);
        assert_eq!(results["score"], 0);
        assert!(results["output"].as_str().unwrap().contains("There is no .vert file"));
    }

    #[test]
    fn students_write_no_markup() {
        for report in samples::all() {
            let mut entry = nasty::attack(report);
            entry.portrait = Some(nasty::PNG.into());
            let results = results(&entry, Language::En);
            let tests = results["tests"].as_array().unwrap().iter().map(|test| &test["output"]);
            for output in tests.chain([&results["output"]]) {
                let page = Html::parse_fragment(output.as_str().unwrap());
                let elements = page.root_element().descendent_elements().map(|element| element.value().name());
                let ours = ["html", "p", "strong", "ul", "li", "br", "code", "img"];
                assert!(elements.into_iter().all(|name| ours.contains(&name)), "{output}");
                let text: String = page.root_element().text().collect();
                assert!(!text.contains(['\u{1B}', '\0', '\r', '\u{202E}']), "{text:?}");
            }
        }
    }

    #[test]
    fn pictures_stand_beside_the_expected_one() {
        let mut entry = nasty::class().entries.remove(1);
        entry.portrait = Some(b"yours".to_vec());
        let output = results(&entry, Language::En)["output"].as_str().unwrap().to_owned();
        let page = Html::parse_fragment(&output);
        let images = scraper::Selector::parse("img").unwrap();
        let sources = page.select(&images).map(|image| image.attr("src").unwrap());
        // Base64 of "yours" and of the eight bytes of a PNG's signature.
        assert_eq!(
            sources.collect::<Vec<_>>(),
            ["data:image/png;base64,eW91cnM=", "data:image/png;base64,iVBORw0KGgo="]
        );
    }
}
