//! A class that is graded again, held against the earlier grading.

use crate::class::{Place, REJECTED, RIGHT, WRONG, sample};
use predicates::prelude::*;
use serde_json::{Value, json};
use std::fs;

fn changes(place: &Place, out: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(place.at(out).join("changes.json")).unwrap()).unwrap()
}

#[test]
fn who_gains_and_who_loses_is_told_with_the_reason() {
    let place = Place::of(&[
        ("better", &sample(WRONG)),
        ("worse", &sample(RIGHT)),
        ("same", &sample(WRONG)),
        ("gone", &sample(RIGHT)),
    ]);
    place.batch("old").args(["--formats", "csv", "--seed", "21"]).assert().code(1);
    place.hand_in("better", &sample(RIGHT));
    place.hand_in("worse", &sample(REJECTED));
    place.hand_in("new", &sample(RIGHT));
    fs::remove_dir_all(place.at("class/gone")).unwrap();
    place.batch("new").args(["--formats", "csv", "--compare", "old/results.jsonl"]).assert().code(1).stdout(
        predicate::str::contains("better  80 → 100")
            .and(predicate::str::contains("worse  100 → 0  Correct → Not accepted"))
            .and(predicate::str::contains("Specular  20 → 40  Half vector not normalised → –")),
    );
    let changes = changes(&place, "new");
    let keys =
        |list: &str| changes[list].as_array().unwrap().iter().map(|c| c["student"]["key"].clone()).collect::<Vec<_>>();
    assert_eq!((keys("gains"), keys("losses")), (vec![json!("better")], vec![json!("worse")]));
    assert_eq!((&changes["unchanged"], &changes["gains"][0]["is_new_file"]), (&json!(1), &json!(true)));
    assert_eq!((&changes["new"][0]["key"], &changes["gone"][0]["key"]), (&json!("new"), &json!("gone")));
    // The same probes: what differs is not by chance.
    assert_eq!((&changes["before"]["seed"], &changes["after"]["seed"]), (&json!(21), &json!(21)));
}

#[test]
fn another_judgement_of_the_same_file_is_told_as_such() {
    let place = Place::of(&[("a", &sample(WRONG))]);
    place.batch("old").args(["--formats", "csv"]).assert().code(1);
    // As an earlier version may have judged it.
    let journal = fs::read_to_string(place.at("old/results.jsonl")).unwrap();
    let (header, record) = journal.split_once('\n').unwrap();
    let mut record: Value = serde_json::from_str(record).unwrap();
    let report = &mut record["outcome"]["graded"];
    report["score"] = json!(60.0);
    report["rubric"][3]["points"] = json!(0.0);
    report["rubric"][3]["mistake"] = json!("unexplained");
    report["mistakes"] = json!(["unexplained"]);
    let header = header.replace("0.1.0", "0.0.9");
    fs::write(place.at("old/results.jsonl"), format!("{header}\n{record}\n")).unwrap();

    place.batch("new").args(["--formats", "csv", "--compare", "old", "--lang", "ja"]).assert().code(1).stdout(
        predicate::str::contains("60 → 80")
            .and(predicate::str::contains(
                "鏡面反射光  0 → 20  よくある間違いに当てはまらない → 中間ベクトルが正規化されていない",
            ))
            .and(predicate::str::contains("0.0.9"))
            .and(predicate::str::contains("別のファイル").not()),
    );
    assert_eq!(changes(&place, "new")["gains"][0]["is_new_file"], json!(false));
}

#[test]
fn a_folder_can_be_held_against_its_own_earlier_results() {
    let place = Place::of(&[("a", &sample(WRONG))]);
    place.batch("out").args(["--formats", "csv"]).assert().code(1);
    let options = ["--formats", "csv", "--compare", "out/results.jsonl", "--force"];
    place.batch("out").args(options).assert().code(1).stdout(predicate::str::contains("Nothing changed"));
    assert_eq!(changes(&place, "out")["unchanged"], json!(1));
}
