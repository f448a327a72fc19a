//! Classes to grade, and what was written of them.

use assert_cmd::Command;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A right answer and some that are not, from the samples.
pub const RIGHT: &str = "accepted/answers/alpha-two.vert";
pub const WRONG: &str = "wrong/specular-half-unnormalized--average.vert";
pub const REJECTED: &str = "rejected/brace-missing-at-end.vert";

/// The bytes of a sample.
pub fn sample(path: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(path);
    fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The samples of a folder, in order of name.
pub fn samples(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(folder);
    let mut found: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.retain(|path| path.extension().is_some_and(|extension| extension == "vert"));
    found.sort();
    found
}

/// A place with a folder `class` in it, and room for outputs beside it.
pub struct Place {
    place: tempfile::TempDir,
}

impl Place {
    pub fn new() -> Self {
        let place = tempfile::tempdir().unwrap();
        fs::create_dir(place.path().join("class")).unwrap();
        Self { place }
    }

    /// A class in which each of these students has handed in this.
    pub fn of(students: &[(&str, &[u8])]) -> Self {
        let place = Self::new();
        for (name, bytes) in students {
            place.hand_in(name, bytes);
        }
        place
    }

    /// A class of many, all different: every `stride`-th of the right and wrong answers.
    pub fn of_many(stride: usize) -> Self {
        let place = Self::new();
        let all = [samples("accepted/answers"), samples("wrong")].concat();
        for (number, path) in all.iter().step_by(stride).enumerate() {
            place.hand_in(&format!("s{number:03}"), &fs::read(path).unwrap());
        }
        place
    }

    pub fn hand_in(&self, student: &str, bytes: &[u8]) {
        let folder = self.at("class").join(student);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("ggsample06.vert"), bytes).unwrap();
    }

    pub fn at(&self, name: &str) -> PathBuf {
        self.place.path().join(name)
    }

    /// `ggrade batch class --out OUT`, in this place, in English.
    pub fn batch(&self, out: &str) -> Command {
        let mut command = ggrade();
        command.current_dir(self.place.path()).args(["batch", "class", "--out", out, "--deadline", "10"]);
        command
    }

    /// The records of a journal, without their timings, and its header first.
    pub fn journal(&self, out: &str) -> Vec<Value> {
        let text = fs::read_to_string(self.at(out).join("results.jsonl")).unwrap();
        text.lines().map(|line| timeless(serde_json::from_str(line).unwrap())).collect()
    }

    /// What each student has in a journal: key → verdict and score.
    pub fn scores(&self, out: &str) -> BTreeMap<String, (String, f64)> {
        let graded = |record: &Value| {
            let report = &record["outcome"]["graded"];
            let key = record["student"]["key"].as_str().unwrap().to_owned();
            (key, (report["verdict"].as_str().unwrap_or("none").to_owned(), report["score"].as_f64().unwrap_or(-1.0)))
        };
        self.journal(out)[1..].iter().map(graded).collect()
    }

    /// Every file of an output folder, without timings.
    pub fn files(&self, out: &str) -> BTreeMap<PathBuf, Vec<u8>> {
        let root = self.at(out);
        walkdir::WalkDir::new(&root)
            .into_iter()
            .map(Result::unwrap)
            .filter(|entry| entry.file_type().is_file())
            .map(|entry| {
                let name = entry.path().strip_prefix(&root).unwrap().to_owned();
                let bytes = fs::read(entry.path()).unwrap();
                let bytes = if name.extension().is_some_and(|e| e == "png") { bytes } else { without_timings(&bytes) };
                (name, bytes)
            })
            .collect()
    }
}

/// The program, in English and without the caller's wishes.
pub fn ggrade() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ggrade"));
    command.env_remove("GGRADE_LANG").env_remove("LC_ALL").env_remove("LC_MESSAGES").env("LANG", "C");
    command
}

/// A JSON value whose `elapsed_ms` are 0.
pub fn timeless(mut value: Value) -> Value {
    match &mut value {
        Value::Object(fields) => {
            for (name, field) in fields.iter_mut() {
                *field = if name == "elapsed_ms" { 0.into() } else { timeless(field.take()) };
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|item| *item = timeless(item.take())),
        _ => {}
    }
    value
}

/// The text without the numbers before ` ms` and after `elapsed_ms":`, which are all the timings that there are in the
/// formats that tests compare.
fn without_timings(bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(bytes);
    let is_number = |c: char| c.is_ascii_digit() || c == '.';
    let pieces: Vec<_> = text.split(" ms").collect();
    let cut = |(index, piece): (usize, &&str)| match index + 1 < pieces.len() {
        true => piece.trim_end_matches(is_number).to_owned() + " ms",
        false => (*piece).to_owned(),
    };
    let kept: String = pieces.iter().enumerate().map(cut).collect();
    let mut parts = kept.split("\"elapsed_ms\":");
    let first = parts.next().unwrap_or_default().to_owned();
    let rest = parts.map(|part| "\"elapsed_ms\":".to_owned() + part.trim_start_matches(is_number));
    (first + &rest.collect::<String>()).into_bytes()
}
