//! A class of hostile files: each has the verdict that is promised, and the run ends as any other.

#[path = "../hostile/files.rs"]
mod files;

use crate::class::{Place, ggrade};
use files::{Hostile, Seen};
use ggrade::intake::IntakeLimits;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::io::Write;

#[test]
fn hostile_files_in_folders_and_in_an_archive_get_their_verdicts() {
    let files = files::all();
    let place = Place::new();
    let mut archive = zip::ZipWriter::new(fs::File::create(place.at("class.zip")).unwrap());
    for (number, file) in files.iter().enumerate() {
        let student = student(number);
        if number.is_multiple_of(2) {
            place.hand_in(&student, &file.bytes);
        } else {
            archive.start_file(format!("{student}/ggsample06.vert"), zip::write::SimpleFileOptions::default()).unwrap();
            archive.write_all(&file.bytes).unwrap();
        }
    }
    archive.finish().unwrap();

    // Every format is written, for what a hostile file says stands in all of them.
    let output = ggrade()
        .current_dir(place.at(""))
        .args(["batch", "class", "class.zip", "--out", "out", "--json-lines", "--seed", "7", "--deadline", "60"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    let lines = String::from_utf8(output.stdout).unwrap();
    let entries: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let mut by_student: BTreeMap<&str, &Value> = BTreeMap::new();
    for entry in &entries {
        let name = entry["student"]["name"].as_str().unwrap();
        assert!(by_student.insert(name, entry).is_none(), "{name} has two entries");
    }
    assert_eq!(by_student.len(), files.len(), "{said}");
    let broken: Vec<String> = files
        .iter()
        .enumerate()
        .filter_map(|(number, file)| check(file, by_student.get(&*student(number)).copied()).err())
        .collect();
    assert!(broken.is_empty(), "{} of {} files:\n{}", broken.len(), files.len(), broken.join("\n"));
    assert_eq!(place.journal("out").len(), 1 + files.len());
    for written in ["report.html", "grades.csv", "junit.xml", "report.sarif"] {
        assert!(place.at("out").join(written).is_file(), "{written}");
    }
}

fn student(number: usize) -> String {
    format!("s{number:04}")
}

fn check(file: &Hostile, entry: Option<&Value>) -> Result<(), String> {
    let entry = entry.ok_or_else(|| format!("{}: no entry", file.name))?;
    // A member of an archive that unpacks to so much of so little is a bomb before it is a shader.
    if entry["report"].is_null() && file.bytes.len() as u64 > IntakeLimits::default().bomb_bytes {
        let is_named = entry["message"].as_str().is_some_and(|message| message.contains("no text does that"));
        return is_named.then_some(()).ok_or_else(|| format!("{}: {}", file.name, entry["message"]));
    }
    let seen = Seen::of_json(&entry["report"]);
    file.check(&seen.ok_or_else(|| format!("{}: no report: {}", file.name, entry["message"]))?)
}
