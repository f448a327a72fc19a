//! A class in parts, and what becomes of the parts.

use crate::class::{Place, REJECTED, RIGHT, WRONG, sample};
use predicates::prelude::*;
use std::fs;

/// Formats with a file for each student, and of the whole class, that say nothing of the time that a grading took.
const OPTIONS: [&str; 4] = ["--formats", "html,csv,vpl,sarif", "--seed", "11"];

/// A class with copies, with what is no shader, and with somebody who handed in nothing.
fn class() -> Place {
    let place = Place::of_many(40);
    for (student, file) in [("copy-1", WRONG), ("copy-2", WRONG), ("copy-3", WRONG), ("broken", REJECTED)] {
        place.hand_in(student, &sample(file));
    }
    fs::create_dir(place.at("class/nothing")).unwrap();
    fs::write(place.at("class/nothing/notes.txt"), "to do\n").unwrap();
    place
}

fn shard(place: &Place, number: usize, count: usize) -> assert_cmd::assert::Assert {
    let shard = format!("{number}/{count}");
    place.batch(&format!("part-{number}")).args(OPTIONS).args(["--shard", &shard]).assert()
}

fn merge(place: &Place, out: &str, parts: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = crate::class::ggrade();
    command.current_dir(place.at("")).args(["batch", "merge", "class", "--out", out, "--deadline", "10"]);
    command.args(OPTIONS).arg("--shards").args(parts).assert()
}

#[test]
fn shards_give_what_one_run_gives() {
    let place = class();
    place.batch("whole").args(OPTIONS).assert().code(1);
    let whole = place.files("whole");
    // One more than there are gradings in one of them: a shard may be empty.
    let (parts, mut students) = (["part-4", "part-1", "part-3", "part-2"], 0);
    for number in 1..=parts.len() {
        shard(&place, number, parts.len()).code(0).stderr(predicate::str::contains("batch merge"));
        let part = format!("part-{number}");
        students += place.journal(&part).len() - 1;
        assert!(!place.at(&part).join("grades.csv").exists(), "part of a grade book looks like a whole one");
    }
    assert_eq!(students, fs::read_dir(place.at("class")).unwrap().count());

    merge(&place, "merged", &parts).code(1).stderr(predicate::str::contains("0 are to come").not());
    let merged = place.files("merged");
    assert_eq!(merged.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>());
    for (name, bytes) in &whole {
        assert!(merged[name] == *bytes, "{} is not what it is after one run", name.display());
    }
}

#[test]
fn a_shard_goes_on_as_a_whole_class_does_and_what_it_has_not_is_graded_at_the_end() {
    let place = class();
    place.batch("whole").args(OPTIONS).assert().code(1);
    for number in [1, 2] {
        shard(&place, number, 2).code(0);
    }
    let before = fs::read_to_string(place.at("part-1/results.jsonl")).unwrap();
    let cut: Vec<&str> = before.lines().take(3).collect();
    fs::write(place.at("part-1/results.jsonl"), cut.join("\n") + "\n").unwrap();
    // Another part of the class is not what is in the folder.
    let other = ["--shard", "2/2", "--resume"];
    place.batch("part-1").args(OPTIONS).args(other).assert().code(2).stderr(predicate::str::contains("--shard"));
    merge(&place, "early", &["part-1", "part-2"]).code(1);
    assert_eq!(place.files("early"), place.files("whole"));
    // Of the two students that are left, one handed in nothing that could be kept.
    let same = ["--shard", "1/2", "--resume"];
    place
        .batch("part-1")
        .args(OPTIONS)
        .args(same)
        .assert()
        .code(0)
        .stderr(predicate::str::contains("1 results are kept"));
    let (after, before) = (place.journal("part-1").len(), before.lines().count());
    assert_eq!(after, before);
}

#[test]
fn only_all_shards_of_one_class_are_put_together() {
    let place = Place::of(&[("a", &sample(RIGHT)), ("b", &sample(WRONG))]);
    for number in [1, 2] {
        shard(&place, number, 2).code(0);
    }
    place.batch("whole").args(OPTIONS).assert().code(1);
    place.batch("other").args(["--formats", "csv", "--seed", "12", "--shard", "2/2"]).assert().code(0);
    for (parts, named) in [
        (vec!["part-1"], "shards are missing: 2/2"),
        (vec!["part-1", "part-1", "part-2"], "shard 1/2"),
        (vec!["part-1", "other"], "--seed: was 11, is 12"),
        (vec!["part-1", "part-2", "whole"], "nothing to merge"),
        (vec!["part-1", "part-2", "class"], "no results of a shard"),
    ] {
        merge(&place, "out", &parts).code(2).stderr(predicate::str::contains(named));
        assert!(!place.at("out/results.jsonl").exists());
    }
    merge(&place, "whole", &["part-1", "part-2"]).code(2).stderr(predicate::str::contains("--force"));
    for (options, named) in [
        (vec!["--shard", "3/2", "--seed", "1"], "such as 3/8"),
        (vec!["--shard", "1/2"], "--seed"),
        (vec!["--shard", "1/2", "--seed", "1", "--anonymous"], "--anonymous"),
    ] {
        place.batch("out").args(&options).assert().code(2).stderr(predicate::str::contains(named));
    }
}
