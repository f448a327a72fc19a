//! What is refused before anything is graded, and what a folder that has results is good for.

use crate::class::{Place, RIGHT, WRONG, sample};
use predicates::prelude::*;
use std::fs;

#[test]
fn results_are_never_overwritten_unasked() {
    let place = Place::of(&[("a", &sample(RIGHT)), ("b", &sample(WRONG))]);
    place.batch("out").assert().code(1);
    let before = place.files("out");
    place
        .batch("out")
        .assert()
        .code(2)
        .stderr(predicate::str::contains("--resume").and(predicate::str::contains("--force")));
    assert_eq!(place.files("out"), before);

    fs::remove_dir_all(place.at("class/b")).unwrap();
    place.hand_in("c", &sample(RIGHT));
    place.batch("out").args(["--force", "--seed", "9"]).assert().code(0);
    let keys: Vec<_> = place.scores("out").into_keys().collect();
    assert_eq!(keys, ["a", "c"]);
    let stale: Vec<_> =
        place.files("out").into_keys().filter(|name| name.file_stem().is_some_and(|s| s == "b")).collect();
    assert!(stale.is_empty(), "{stale:?}");
    assert_eq!(place.journal("out")[0]["seed"], 9);
}

#[test]
fn going_on_keeps_what_is_graded_and_grades_what_changed() {
    let place = Place::of(&[("a", &sample(RIGHT)), ("b", &sample(WRONG)), ("gone", &sample(WRONG))]);
    place.batch("out").assert().code(1);
    let first = place.journal("out");
    place.hand_in("b", &sample(RIGHT));
    place.hand_in("new", &sample(RIGHT));
    fs::remove_dir_all(place.at("class/gone")).unwrap();
    fs::remove_file(place.at("out/report.html")).unwrap();
    place
        .batch("out")
        .arg("--resume")
        .assert()
        .code(0)
        .stderr(predicate::str::contains("1 results are kept, 2 are to come (1 changed files"));
    let second = place.journal("out");
    assert_eq!((&second[0], &second[1]), (&first[0], &first[1]), "the seed is that of the first run");
    let keys: Vec<_> = place.scores("out").into_keys().collect();
    assert_eq!(keys, ["a", "b", "new"]);
    assert!(place.at("out/report.html").is_file());
    assert!(!place.at("out/students/gone.html").exists());

    // With nothing left to grade, only the files are written again.
    place.batch("out").arg("--resume").assert().code(0);
    assert_eq!(place.journal("out"), second);
    // A page that is missing is made again.
    fs::remove_file(place.at("out/students/a.html")).unwrap();
    place.batch("out").arg("--resume").assert().code(0);
    assert!(place.at("out/students/a.html").is_file());
}

#[test]
fn results_that_do_not_go_together_are_not_mixed() {
    let place = Place::of(&[("a", &sample(RIGHT))]);
    place.batch("out").args(["--formats", "csv", "--seed", "4"]).assert().code(0);
    for (options, named) in [
        (vec!["--seed", "5"], "--seed: was 4, is 5"),
        (vec!["--hints", "none"], "--hints: was full, is none"),
        (vec!["--lang", "ja"], "--lang"),
        (vec!["--anonymous"], "--anonymous"),
    ] {
        place.batch("out").arg("--resume").args(&options).assert().code(2).stderr(predicate::str::contains(named));
    }
    let journal = fs::read_to_string(place.at("out/results.jsonl")).unwrap();
    fs::write(place.at("out/results.jsonl"), journal.replacen("0.1.0", "0.0.9", 1)).unwrap();
    place.batch("out").arg("--resume").assert().code(2).stderr(predicate::str::contains("was 0.0.9"));
    fs::write(place.at("out/results.jsonl"), &journal).unwrap();
    fs::rename(place.at("class/a"), place.at("class/other")).unwrap();
    place.batch("out").arg("--resume").assert().code(2).stderr(predicate::str::contains("another class"));
    assert_eq!(fs::read_to_string(place.at("out/results.jsonl")).unwrap(), journal);
}

#[test]
fn a_strangers_file_is_left_alone() {
    let place = Place::of(&[("a", &sample(RIGHT))]);
    fs::create_dir(place.at("out")).unwrap();
    fs::write(place.at("out/results.jsonl"), "{\"mine\": true}\n").unwrap();
    for option in [None, Some("--resume")] {
        place.batch("out").args(option).assert().code(2).stderr(predicate::str::contains("ggrade/batch/v1"));
    }
    assert_eq!(fs::read_to_string(place.at("out/results.jsonl")).unwrap(), "{\"mine\": true}\n");
}

#[test]
fn what_cannot_be_done_is_said_before_anything_is_graded() {
    let place = Place::of(&[("a", &sample(RIGHT))]);
    fs::write(place.at("sheet.csv"), "no,worksheet\n1,2\n").unwrap();
    for (out, options, named) in [
        ("out", vec!["--deadline", "0"], "--deadline"),
        ("out", vec!["--moodle-worksheet", "missing.csv"], "missing.csv"),
        ("out", vec!["--moodle-worksheet", "sheet.csv"], "sheet.csv"),
        ("out", vec!["--formats", "moodle-worksheet"], "--moodle-worksheet"),
        ("out", vec!["--formats", "moodle-feedback", "--anonymous"], "blind marking"),
        ("out", vec!["--compare", "missing.jsonl"], "missing.jsonl"),
        ("out", vec!["--names", "names.csv"], "--anonymous"),
        ("out", vec!["--resume", "--force"], "--force"),
        ("class/out", vec![], "inside the input"),
        ("./class/../class", vec![], "inside the input"),
    ] {
        let mut command = place.batch(out);
        if options.first() == Some(&"--deadline") {
            command = crate::class::ggrade();
            command.current_dir(place.at("")).args(["batch", "class", "--out", out]);
        }
        command.args(&options).assert().code(2).stderr(predicate::str::contains(named));
        assert!(!place.at("out").exists(), "{options:?}");
    }
    assert_eq!(fs::read_dir(place.at("class")).unwrap().count(), 1);
}

#[test]
fn two_runs_do_not_write_into_one_folder() {
    let place = Place::of(&[("a", &sample(RIGHT))]);
    let out = place.at("out");
    let held = ggrade::class::folder::OutputFolder::open(&out).unwrap();
    place.batch("out").assert().code(2).stderr(predicate::str::contains("another ggrade"));
    drop(held);
    place.batch("out").assert().code(0);
}

#[test]
fn a_folder_that_cannot_be_written_is_our_fault_and_is_named() {
    let place = Place::of(&[("a", &sample(RIGHT))]);
    fs::write(place.at("file"), "").unwrap();
    place.batch("file/out").assert().code(3).stderr(predicate::str::contains("file/out"));
    // Students' pages cannot be written: what was graded is not lost, and nothing is said to be there that is not.
    fs::create_dir(place.at("out")).unwrap();
    fs::write(place.at("out/students"), "").unwrap();
    place
        .batch("out")
        .assert()
        .code(3)
        .stderr(predicate::str::contains("students").and(predicate::str::contains("--resume")));
    fs::remove_file(place.at("out/students")).unwrap();
    place.batch("out").arg("--resume").assert().code(0);
}
