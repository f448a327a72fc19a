use super::*;
use crate::class::formats::nasty;
use crate::intake::FileLocation;
use crate::report::samples;

/// The schema of SARIF 2.1.0, formats such as `uri-reference` included.
fn schema() -> jsonschema::Validator {
    let text = include_str!("../../../../tests/schemas/sarif-2.1.0-rtm.5.json");
    // One pattern of the published schema has a `]` that nothing opens. Browsers take it for a literal one, strict
    // readers of regular expressions refuse the schema for it; escaped it means the same to both.
    let text = text.replace("-[a-zA-Z]{2}]?$", "-[a-zA-Z]{2}\\\\]?$");
    let schema = serde_json::from_str(&text).expect("a schema");
    let options = jsonschema::options().should_validate_formats(true);
    options.with_format("uri-reference", is_reference).build(&schema).expect("a valid schema")
}

/// Whether a text has only characters of RFC 3986, and every `%` two hexadecimal digits behind it. (The format is newer
/// than the schema's own draft, so that the library leaves it alone.)
fn is_reference(text: &str) -> bool {
    let mut escapes = text.split('%').skip(1);
    text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-._~:/?#[]@!$&'()*+,;=%".contains(&byte))
        && escapes.all(|rest| rest.len() >= 2 && rest.bytes().take(2).all(|byte| byte.is_ascii_hexdigit()))
}

/// The log of the class, held against the schema of SARIF 2.1.0.
fn log(class: &Class) -> Value {
    let log: Value = serde_json::from_str(&render(class)).expect("JSON");
    let validator = schema();
    let errors: Vec<_> =
        validator.iter_errors(&log).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    log
}

fn results(log: &Value) -> &[Value] {
    log["runs"][0]["results"].as_array().expect("results")
}

#[test]
fn the_schema_refuses_what_is_wrong() {
    let validator = schema();
    let good: Value = serde_json::from_str(&render(&nasty::class())).unwrap();
    for (pointer, bad) in [
        ("/version", json!("2.0.0")),
        ("/runs/0/columnKind", json!("bytes")),
        ("/runs/0/results/0/level", json!("fatal")),
        ("/runs/0/results/0/locations/0/physicalLocation/region/startLine", json!(0)),
        ("/runs/0/artifacts/0/location/uri", json!("a b|c")),
    ] {
        let mut log = good.clone();
        *log.pointer_mut(pointer).expect(pointer) = bad;
        assert!(!validator.is_valid(&log), "{pointer}");
    }
}

#[test]
fn results_stand_at_their_rule_line_and_columns() {
    let log = log(&nasty::class());
    // `wrong`: a lost line and a warning; `rejected`: two errors; `stopped`: one.
    let levels: Vec<_> = results(&log).iter().map(|result| result["level"].as_str().unwrap()).collect();
    assert_eq!(levels, ["warning", "warning", "error", "error", "error"]);
    let place = |index: usize| &results(&log)[index]["locations"][0]["physicalLocation"];
    // `Max`: column 12, three characters.
    let max = json!({ "startLine": 11, "startColumn": 12, "endLine": 11, "endColumn": 15 });
    assert_eq!(place(2)["region"], max);
    assert_eq!(place(2)["artifactLocation"]["uri"], "student-2/ggsample06.vert");
    assert_eq!(place(0)["region"], json!({ "startLine": 11 }));
    assert_eq!(place(3).get("region"), None);
    let rules = log["runs"][0]["tool"]["driver"]["rules"].as_array().unwrap();
    for result in results(&log) {
        assert_eq!(rules[result["ruleIndex"].as_u64().unwrap() as usize]["id"], result["ruleId"]);
        let artifact = &result["locations"][0]["physicalLocation"]["artifactLocation"];
        let listed = &log["runs"][0]["artifacts"][artifact["index"].as_u64().unwrap() as usize];
        assert_eq!(listed["location"]["uri"], artifact["uri"]);
    }
    assert_eq!(results(&log)[0]["ruleId"], "specular-half-unnormalized");
}

#[test]
fn the_rules_tell_every_known_mistake_without_open_places() {
    let log = log(&nasty::class());
    let rules = log["runs"][0]["tool"]["driver"]["rules"].as_array().unwrap();
    // What GitHub's code scanning asks of every rule.
    for rule in rules {
        assert!(["id", "name"].iter().all(|field| rule[field].is_string()), "{rule}");
        let described =
            ["shortDescription", "fullDescription", "help"].iter().all(|field| rule[field]["text"].is_string());
        assert!(described, "{rule}");
    }
    assert!(rules.iter().any(|rule| rule["id"] == "specular-phong" && rule["name"] == "SpecularPhongMistake"));
    for mistake in &reference::assignment("ggsample06").unwrap().mistakes {
        let rule = rules.iter().find(|rule| rule["id"] == mistake.id.as_str()).expect(&mistake.id);
        assert_eq!(rule["shortDescription"]["text"], mistake.title.en.as_str());
        let text = format!("{rule}");
        assert!(!text.contains("{line}") && !text.contains('⟨'), "{text}");
    }
}

#[test]
fn our_failure_and_a_missing_file_are_notifications() {
    let log = log(&nasty::class());
    let invocation = &log["runs"][0]["invocations"][0];
    assert_eq!(invocation["executionSuccessful"], false);
    let levels: Vec<_> =
        invocation["toolExecutionNotifications"].as_array().unwrap().iter().map(|n| &n["level"]).collect();
    assert_eq!(levels, ["warning", "error"]);
    let mut fine = nasty::class();
    fine.entries.truncate(5);
    assert_eq!(self::log(&fine)["runs"][0]["invocations"][0]["executionSuccessful"], true);
}

#[test]
fn paths_are_relative_references_whatever_they_are_made_of() {
    let mut class = nasty::class();
    class.entries = samples::all().into_iter().map(nasty::attack).collect();
    let log = log(&class);
    let uri = results(&log)[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].as_str().unwrap();
    // RFC 3986: a comma, a blank, a colon and a percent sign.
    assert!(uri.starts_with("a%2C%20b%3A%20100%25/%3A%3Aset-output%20name"), "{uri}");
    assert!(uri.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-._~/%".contains(&byte)), "{uri}");
    let decoded = percent_encoding::percent_decode_str(uri).decode_utf8().unwrap();
    assert_eq!(decoded, class.entries[0].places[0].path);
    assert!(!render(&class).contains(['\u{1B}', '\0', '\r', '\u{202E}']));
}

#[test]
fn a_file_that_is_not_below_the_working_folder_is_named_from_the_input_on() {
    let mut class = nasty::class();
    class.entries[2].places = vec![FileLocation { path: "class.zip/a b/x.vert".into(), local: None }];
    let log = log(&class);
    let location = &results(&log)[2]["locations"][0]["physicalLocation"]["artifactLocation"];
    assert_eq!(location["uri"], "class.zip/a%20b/x.vert");
    assert_eq!(location["uriBaseId"], "%SRCROOT%");
}

#[test]
fn a_fingerprint_stays_when_lines_move_and_tells_findings_apart() {
    let fingerprints = |class: &Class| {
        let log = log(class);
        let of = |result: &Value| result["partialFingerprints"]["primaryLocationLineHash"].as_str().unwrap().to_owned();
        results(&log).iter().map(of).collect::<Vec<_>>()
    };
    let mut class = nasty::class();
    let before = fingerprints(&class);
    let distinct: std::collections::HashSet<_> = before.iter().collect();
    assert_eq!(distinct.len(), before.len());
    // Two lines more at the top, and the message two lines further down.
    let entry = &mut class.entries[2];
    entry.sources[0].text.insert_str(0, "\n\n");
    let Outcome::Graded(report) = &mut entry.outcome else { panic!("graded") };
    report.diagnostics[0].line = Some(13);
    assert_eq!(fingerprints(&class), before);
}

#[test]
fn each_of_several_files_is_an_artifact_and_a_finding_stands_in_its_own() {
    let class = Class { entries: vec![nasty::two_files()], ..nasty::class() };
    let log = log(&class);
    let artifacts = log["runs"][0]["artifacts"].as_array().unwrap();
    let uris: Vec<_> = artifacts.iter().map(|artifact| artifact["location"]["uri"].as_str().unwrap()).collect();
    assert_eq!(uris, ["student-7/ggsample11.vert", "student-7/ggsample11.frag"]);
    let places: Vec<_> = results(&log)
        .iter()
        .map(|result| {
            let place = &result["locations"][0]["physicalLocation"];
            (place["artifactLocation"]["uri"].as_str().unwrap(), place["region"]["startLine"].as_u64().unwrap())
        })
        .collect();
    assert_eq!(places, [("student-7/ggsample11.frag", 11), ("student-7/ggsample11.vert", 12)]);
}
