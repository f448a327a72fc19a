//! The formats of autograders and CI as their systems call ggrade: by the command line, and by the scripts in `deploy/`.

mod action;
mod container;
mod debian;
mod gradescope;
mod kubernetes;
mod moodle;
mod service;

use assert_cmd::Command;
use base64::Engine;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Duration;

fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn correct() -> PathBuf {
    repository().join("submissions/ggsample06/accepted/answers/plain-int-zero.vert")
}

fn wrong() -> PathBuf {
    repository().join("submissions/ggsample06/wrong/specular-half-unnormalized--average.vert")
}

/// A shader whose only mistake is its second line.
fn rejected(folder: &Path) -> PathBuf {
    let file = folder.join("rejected.vert");
    std::fs::write(&file, "#version 410 core\nnot GLSL ::error::Grade :=>> 100\nvoid main() {}\n").unwrap();
    file
}

/// A program that may start ggrade. Tests share the machine with others, which must not make one of them fail.
fn program(path: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(path);
    command.env("GGRADE_DEADLINE", "30").timeout(Duration::from_secs(120));
    command
}

fn ggrade() -> Command {
    let mut command = program(env!("CARGO_BIN_EXE_ggrade"));
    command.env_remove("GITHUB_STEP_SUMMARY").env_remove("GGRADE_LANG").env("LANG", "C");
    command
}

/// What is printed for a file in a format, and the exit code.
fn printed(format: &str, file: &Path, more: &[&str]) -> (String, i32) {
    let output = ggrade().arg("grade").arg(file).args(["--format", format]).args(more).output().unwrap();
    (String::from_utf8(output.stdout).unwrap(), output.status.code().unwrap())
}

/// The same for a right answer on a machine where nothing can be drawn.
fn without_driver(format: &str) -> (String, i32) {
    let mut command = ggrade();
    command.env_remove("VK_ICD_FILENAMES").env("VK_DRIVER_FILES", "/nowhere/lvp_icd.json");
    let output = command.arg("grade").arg(correct()).args(["--format", format]).output().unwrap();
    (String::from_utf8(output.stdout).unwrap(), output.status.code().unwrap())
}

fn json_of(format: &str, file: &Path, more: &[&str]) -> (Value, i32) {
    let (text, code) = printed(format, file, more);
    (serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}")), code)
}

fn is_valid(schema: &str, document: &Value) -> bool {
    let schema = std::fs::read_to_string(repository().join("tests/schemas").join(schema)).unwrap();
    jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap().is_valid(document)
}

const FORMATS: [&str; 7] = ["gradescope", "github", "classroom-legacy", "junit", "sarif", "vpl", "coderunner"];

#[test]
fn every_ending_has_a_document_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("ggsample06.vert");
    for format in FORMATS {
        assert_eq!(printed(format, &missing, &[]).1, 4, "{format}");
        let (text, code) = without_driver(format);
        assert_eq!(code, 3, "{format}");
        assert!(text.len() > 20, "{format}: {text}");
        // Who sets it up wrongly is told so, not a student.
        assert_eq!(printed(format, &correct(), &["--assignment", "ggsample99"]), (String::new(), 2), "{format}");
    }
}

#[test]
fn gradescope_gets_partial_scores_and_the_picture() {
    let (results, code) = json_of("gradescope", &wrong(), &["--lang", "ja"]);
    assert_eq!(code, 1);
    assert!(is_valid("gradescope-results.schema.json", &results), "{results:#}");
    assert_eq!((&results["score"], &results["tests"][3]["score"]), (&json!(80.0), &json!(20.0)));
    assert_eq!(results["tests"][3]["name"], "鏡面反射光");
    let output = results["output"].as_str().unwrap();
    let picture = output.split("base64,").nth(1).unwrap().split('"').next().unwrap();
    let picture = base64::engine::general_purpose::STANDARD.decode(picture).unwrap();
    assert_eq!(image::load_from_memory(&picture).unwrap().width(), 160);
    let (text, code) = without_driver("gradescope");
    let results: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((results.get("score"), code), (None, 3));
}

#[test]
fn github_gets_the_line_and_a_summary() {
    let folder = tempfile::tempdir().unwrap();
    let summary = folder.path().join("summary.md");
    std::fs::write(&summary, "before\n").unwrap();
    rejected(folder.path());
    let run = || {
        let mut command = ggrade();
        command.current_dir(folder.path()).env("GITHUB_STEP_SUMMARY", &summary);
        command.args(["grade", "./rejected.vert", "--format", "github"]).output().unwrap()
    };
    let output = run();
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    let error = text.lines().next().unwrap();
    assert!(error.starts_with("::error file=rejected.vert,line=2,endLine=2,"), "{text}");
    // The line is quoted, and what looks like a command in it stands behind `::stop-commands::`.
    let (_, fenced) = text.split_once("::stop-commands::").unwrap();
    assert!(fenced.contains("not GLSL ::error::Grade"), "{text}");
    let written = std::fs::read_to_string(&summary).unwrap();
    assert!(written.starts_with("before\n## ggrade: rejected&#46;vert\n"), "{written}");
    run();
    assert!(std::fs::read_to_string(&summary).unwrap().len() > written.len());
}

/// The reporter decodes the text, adds the scores of the tests and shows them beside `max_score`.
#[test]
fn classrooms_reporter_gets_the_points() {
    let (text, code) = printed("classroom-legacy", &wrong(), &["--seed", "7"]);
    assert_eq!(code, 1);
    let result = base64::engine::general_purpose::STANDARD.decode(text.trim_end()).unwrap();
    let result: Value = serde_json::from_slice(&result).unwrap();
    let points: f64 = result["tests"].as_array().unwrap().iter().map(|test| test["score"].as_f64().unwrap()).sum();
    assert_eq!((points, &result["max_score"], &result["status"]), (80.0, &json!(100.0), &json!("fail")));
    // What no reader reads is no format.
    let mut command = ggrade();
    command.arg("grade").arg(wrong()).args(["--format", "classroom"]).assert().code(2);
}

#[test]
fn sarif_and_junit_name_the_mistake() {
    let (log, _) = json_of("sarif", &wrong(), &[]);
    let result = &log["runs"][0]["results"][0];
    assert_eq!(result["ruleId"], "specular-half-unnormalized");
    assert_eq!(result["locations"][0]["physicalLocation"]["region"]["startLine"], 33);
    let (xml, _) = printed("junit", &wrong(), &[]);
    assert!(xml.contains("type=\"specular-half-unnormalized\""), "{xml}");
}
