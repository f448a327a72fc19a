//! What comes of a class.

use crate::class::{Place, REJECTED, RIGHT, WRONG, ggrade, sample, samples};
use predicates::prelude::*;
use serde_json::Value;
use std::fs;
use std::io::Write;

#[test]
fn a_class_gets_its_grades_in_every_format() {
    let place = Place::of(&[("佐藤 花子", &sample(RIGHT)), ("tanaka", &sample(WRONG)), ("suzuki", &sample(REJECTED))]);
    place
        .batch("out")
        .assert()
        .code(1)
        .stderr("")
        .stdout(predicate::str::contains("3 students").and(predicate::str::contains("Half vector not normalised")));
    let journal = place.journal("out");
    assert_eq!(journal.len(), 1 + 3);
    assert_eq!((&journal[0]["schema"], &journal[0]["assignment"]), (&"ggrade/batch/v1".into(), &"ggsample06".into()));
    for file in ["report.html", "grades.csv", "junit.xml", "report.sarif", "gradescope/tanaka.json", "vpl/suzuki.txt"] {
        assert!(place.at("out").join(file).is_file(), "{file}");
    }
    let scores = place.scores("out");
    assert_eq!(scores["tanaka"], ("wrong".into(), 80.0));
    assert_eq!(scores["suzuki"], ("rejected".into(), 0.0));
    assert!(scores.values().any(|score| *score == ("correct".into(), 100.0)));
    // Who was drawn has a picture; everyone has a page.
    assert!(place.at("out/students/tanaka.png").is_file() && !place.at("out/students/suzuki.png").exists());
    let page = fs::read_to_string(place.at("out/students/suzuki.html")).unwrap();
    assert!(page.contains("Not accepted"));
}

#[test]
fn the_exit_code_tells_how_the_class_came_out() {
    let place = Place::of(&[("a", &sample(RIGHT)), ("b", &sample(RIGHT))]);
    place.batch("right").args(["--formats", "csv"]).assert().code(0);
    fs::create_dir(place.at("class/c")).unwrap();
    fs::write(place.at("class/c/homework.docx"), "PK").unwrap();
    place.batch("one-without").args(["--formats", "csv"]).assert().code(1).stdout(predicate::str::contains("docx"));
    for student in ["a", "b"] {
        fs::remove_dir_all(place.at("class").join(student)).unwrap();
    }
    place.batch("none").args(["--formats", "csv"]).assert().code(4);
    assert!(place.at("none/grades.csv").is_file(), "who handed in nothing is in the table all the same");
    fs::remove_dir_all(place.at("class/c")).unwrap();
    place.batch("empty").assert().code(4).stderr(predicate::str::contains("nothing to grade"));
    assert!(!place.at("empty").exists());
}

#[test]
fn our_own_fault_is_3_and_costs_nobody_else() {
    // Valid GLSL that ggrade does not take: docs/limits.md.
    let subroutine = "#version 410 core\nsubroutine vec4 shade();\nsubroutine uniform shade pick;\nin vec4 pv;\n\
                      uniform mat4 mc;\nout vec4 vc;\nsubroutine(shade) vec4 red() { return vec4(1.0); }\n\
                      void main(void) { vc = pick(); gl_Position = mc * pv; }\n";
    let place = Place::of(&[("a", &sample(RIGHT)), ("faulty", subroutine.as_bytes()), ("z", &sample(WRONG))]);
    place.batch("out").assert().code(3).stdout(predicate::str::contains("faulty"));
    let scores = place.scores("out");
    assert_eq!((scores["a"].1, scores["z"].1), (100.0, 80.0));
    assert_eq!(scores["faulty"].0, "none");
    assert!(fs::read_to_string(place.at("out/grades.csv")).unwrap().contains("fault"));
}

#[test]
fn nothing_is_graded_without_a_driver() {
    let place = Place::of(&[("a", &sample(RIGHT))]);
    place
        .batch("out")
        .env("VK_DRIVER_FILES", "/nonexistent/driver.json")
        .assert()
        .code(3)
        .stderr(predicate::str::contains("costs no points"));
    // Nothing stands in the way of the next try.
    place.batch("out").assert().code(0);
}

#[test]
fn an_archive_is_a_class_and_its_bad_members_cost_nobody_else() {
    let place = Place::new();
    let mut archive = zip::ZipWriter::new(fs::File::create(place.at("class.zip")).unwrap());
    let options = zip::write::SimpleFileOptions::default();
    for (name, bytes) in [
        ("山田 太郎_4001_assignsubmission_file/ggsample06.vert", sample(RIGHT)),
        ("田中 花子_4002_assignsubmission_file/ggsample06.vert", sample(WRONG)),
        ("../../evil_4003_assignsubmission_file/ggsample06.vert", sample(RIGHT)),
    ] {
        archive.start_file(name, options).unwrap();
        archive.write_all(&bytes).unwrap();
    }
    archive.finish().unwrap();
    let sheet = "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Grade can be changed,\
                 Last modified (submission),Last modified (grade),Feedback comments\r\n\
                 Participant 4001,山田 太郎,y@example.org,Submitted,,100.00,Yes,-,-,\r\n\
                 Participant 4009,佐藤 次郎,s@example.org,No submission,,100.00,Yes,-,-,\r\n";
    fs::write(place.at("sheet.csv"), sheet).unwrap();
    let mut command = ggrade();
    command.current_dir(place.at("")).args(["batch", "class.zip", "--out", "out", "--deadline", "10", "--lang", "ja"]);
    command.args(["--moodle-worksheet", "sheet.csv"]);
    command.assert().code(1).stdout(predicate::str::contains("2 名").and(predicate::str::contains("evil")));
    let scores = place.scores("out");
    assert_eq!((scores["4001"].1, scores["4002"].1), (100.0, 80.0));
    let mut feedback = zip::ZipArchive::new(fs::File::open(place.at("out/moodle-feedback.zip")).unwrap()).unwrap();
    let names: Vec<_> =
        (0..feedback.len()).map(|i| feedback.by_index(i).unwrap().name().unwrap().into_owned()).collect();
    assert_eq!(names.len(), 2, "{names:?}");
    let filled = fs::read_to_string(place.at("out/moodle-worksheet.csv")).unwrap();
    let rows: Vec<_> = filled.split("\r\n").zip(sheet.split("\r\n")).collect();
    assert!(rows[1].0.starts_with("Participant 4001,山田 太郎,y@example.org,Submitted,100"), "{filled}");
    assert!([0, 2].iter().all(|&row| rows[row].0 == rows[row].1), "{filled}");
    assert!(!place.at("evil_4003_assignsubmission_file").exists());
}

#[test]
fn every_finished_entry_is_a_json_object_on_standard_output() {
    let place = Place::of(&[("a", &sample(RIGHT)), ("b", &sample(WRONG)), ("c", &sample(WRONG))]);
    fs::create_dir(place.at("class/d")).unwrap();
    fs::write(place.at("class/d/notes.docx"), "PK").unwrap();
    let output = place.batch("out").args(["--json-lines", "--formats", "csv", "--seed", "5"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    let mut lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    lines.sort_by_key(|line| line["student"]["key"].to_string());
    assert_eq!(lines.len(), 4);
    assert!(lines.iter().all(|line| line["schema"] == "ggrade/entry/v1"));
    let standings: Vec<_> = lines.iter().map(|line| line["standing"].as_str().unwrap()).collect();
    assert_eq!(standings, ["correct", "wrong", "wrong", "not-graded"]);
    assert_eq!(lines[1]["report"]["schema"], "ggrade/report/v1");
    assert_eq!(lines[1]["report"]["probes"]["seed"], 5);
    assert_eq!(lines[1]["shares_with"], serde_json::json!(["c"]));
    assert!(lines[3]["report"].is_null() && lines[3]["message"].is_string());
}

#[test]
fn the_same_file_is_graded_once_and_both_share_the_answer() {
    let text = String::from_utf8(sample(WRONG)).unwrap();
    let spaced = text.replace("vc =", "// my own comment\n  vc  =");
    assert_ne!(spaced, text);
    let unchanged = include_bytes!("../../reference/assignments/ggsample06/starter.vert");
    let place = Place::of(&[
        ("a", text.as_bytes()),
        ("b", text.replace('\n', "\r\n").as_bytes()),
        ("c", spaced.as_bytes()),
        ("d", &sample(RIGHT)),
        ("e", unchanged),
        ("f", unchanged),
    ]);
    let output = place.batch("out").args(["--json-lines", "--formats", "html"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let of = |key: &str| lines.iter().find(|line| line["student"]["key"] == key).unwrap();
    let shares = |key: &str| of(key)["shares_with"].clone();
    assert_eq!(shares("a"), serde_json::json!(["b", "c"]));
    assert_eq!(shares("c"), serde_json::json!(["a", "b"]));
    assert_eq!(shares("d"), serde_json::json!([]));
    assert_eq!(shares("e"), serde_json::json!([]), "the hand-out is nobody's own");
    assert_eq!(of("a")["alike"][0]["is_same"], true);
    let page = fs::read_to_string(place.at("out/likeness.html")).unwrap();
    assert!(page.contains("<mark>") && page.contains("Content-Security-Policy"), "{page}");
    // One grading has one duration.
    let elapsed = |key: &str| of(key)["report"]["elapsed_ms"].clone();
    assert_eq!(elapsed("a"), elapsed("b"));
    // The facts of each file are its own.
    assert_ne!(of("a")["report"]["source"]["sha256"], of("b")["report"]["source"]["sha256"]);
    assert_ne!(of("a")["report"]["source"]["bytes"], of("b")["report"]["source"]["bytes"]);
    // And so are the lines: the comment moves the assignment down by one.
    let line = |key: &str| of(key)["report"]["rubric"][3]["line"].as_u64();
    assert_eq!(of("c")["report"]["score"], of("a")["report"]["score"]);
    assert!(line("c") >= line("a"));
}

#[test]
fn an_earlier_term_is_compared_and_not_graded() {
    let place = Place::of(&[("a", &sample("accepted/answers/dot-by-hand.vert")), ("b", &sample(RIGHT))]);
    fs::create_dir_all(place.at("earlier/somebody")).unwrap();
    let copy = String::from_utf8(sample("accepted/answers/dot-by-hand.vert")).unwrap().replace("naiseki", "inner");
    fs::write(place.at("earlier/somebody/ggsample06.vert"), copy).unwrap();
    let mut command = place.batch("out");
    command.args(["--json-lines", "--formats", "html,csv", "--earlier"]).arg(place.at("earlier"));
    let output = command.output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 2, "{text}");
    let of = |key: &str| lines.iter().find(|line| line["student"]["key"] == key).unwrap()["alike"].clone();
    assert_eq!(of("b"), serde_json::json!([]));
    assert_eq!((&of("a")[0]["is_earlier"], of("a").as_array().unwrap().len()), (&Value::Bool(true), 1), "{text}");
    assert!(of("a")[0]["key"].as_str().unwrap().contains("somebody"), "{text}");
    let grades = fs::read_to_string(place.at("out/grades.csv")).unwrap();
    assert!(grades.lines().any(|line| line.starts_with("a,") && line.contains("somebody")), "{grades}");
}

#[test]
fn hostile_files_get_named_verdicts_and_change_no_honest_report() {
    let place = Place::of(&[("honest-1", &sample(RIGHT)), ("honest-2", &sample(WRONG))]);
    place.batch("quiet").args(["--formats", "csv", "--seed", "3"]).assert().code(1);
    let mut hostile = 0;
    for folder in [
        "rejected/degenerate",
        "rejected/encodings",
        "rejected/preprocessor",
        "rejected/recursion",
        "stopped/compile-bombs",
        "stopped/loops",
        "stopped/memory",
        "stopped/nesting",
    ] {
        for path in samples(&format!("hostile/{folder}")).iter().step_by(6) {
            let (_, kind) = folder.split_once('/').unwrap();
            place.hand_in(&format!("{kind}-{}", path.file_stem().unwrap().display()), &fs::read(path).unwrap());
            hostile += 1;
        }
    }
    assert!(hostile > 20);
    place.batch("mixed").args(["--formats", "csv", "--seed", "3"]).assert().code(1);
    let (quiet, mixed) = (place.journal("quiet"), place.journal("mixed"));
    assert_eq!(mixed.len(), 1 + 2 + hostile);
    for record in &quiet[1..] {
        assert!(mixed.contains(record), "{}", record["student"]["key"]);
    }
    for record in &mixed[1..] {
        let verdict = record["outcome"]["graded"]["verdict"].as_str();
        assert!(verdict.is_some(), "{record}");
    }
}

#[test]
fn names_that_steer_a_terminal_do_not() {
    let place = Place::of(&[("\u{1b}]0;owned\u{7}", &sample(RIGHT)), ("\u{1b}[2J\u{202e}evil", &sample(WRONG))]);
    fs::remove_file(place.at("class/\u{1b}]0;owned\u{7}/ggsample06.vert")).unwrap();
    fs::write(place.at("class/\u{1b}]0;owned\u{7}/x\u{9b}31m.docx"), "PK").unwrap();
    let output = place.batch("out").args(["--title", "\u{1b}[31mred"]).output().unwrap();
    for text in [output.stdout, output.stderr] {
        let text = String::from_utf8(text).unwrap();
        assert!(!text.contains(['\u{1b}', '\u{7}', '\u{9b}', '\u{202e}']), "{text:?}");
    }
}
