//! Every sample of `submissions/` gets the report that stands beside it. `BLESS=1` writes the reports anew, and is red.

#[path = "corpus/seed.rs"]
mod seed;

use assert_cmd::Command;
use ggrade::grade::{Grader, Order};
use ggrade::hand_in::HandIn;
use ggrade::parallel;
use ggrade::render::AdapterKind;
use ggrade::report::Verdict;
use reference::assignment::MANIFEST;
use reference::{Assignment, Folder};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// How many samples each homework has. A sample that is lost, and a folder that is no longer walked, are seen here.
const SAMPLES: [(&str, usize); 31] = [
    ("blinn", 191),
    ("bumps", 13),
    ("dunes", 11),
    ("falloff-linear", 211),
    ("falloff-pixar", 222),
    ("falloff-quadratic", 210),
    ("flat", 150),
    ("fog", 13),
    ("ggsample06", 1487),
    ("ggsample11-map", 94),
    ("ggsample11-pcf", 64),
    ("ggsample11-projection", 58),
    ("ggsample11-vsm", 60),
    ("gouraud-point-light", 180),
    ("interpolation", 63),
    ("lambert", 133),
    ("lamp", 22),
    ("maps", 85),
    ("per-pixel", 11),
    ("phong", 191),
    ("phong-shading", 166),
    ("rings", 17),
    ("schlick", 191),
    ("several-lights", 189),
    ("shapes", 16),
    ("spot-directx", 230),
    ("spot-opengl", 221),
    ("spot-soft", 204),
    ("threshold", 200),
    ("toon", 23),
    ("waves", 14),
];

/// So many homeworks are graded at once: each begins and ends with one worker at work.
const AT_ONCE: usize = 2;

/// What a folder's name says of the verdict of all in it.
const FOLDERS: [(&str, &str); 4] =
    [("accepted", "correct"), ("wrong", "wrong"), ("rejected", "rejected"), ("stopped", "stopped")];

#[test]
fn every_sample_gets_its_expected_report() {
    let of_one = |(homework, count): &(&str, usize)| differences(homework, *count);
    let found = parallel::map(&SAMPLES, AT_ONCE, &AtomicBool::new(false), of_one);
    let found: Vec<String> = found.into_iter().flat_map(|of_one| of_one.expect("it is looked at")).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// What `ggrade corpus` says of the samples of a homework, where not all are as expected.
fn differences(homework: &str, count: usize) -> Option<String> {
    let folder = format!("tests/homeworks/{homework}");
    let assignment = if reference::assignment(homework).is_some() { homework } else { &folder };
    let output = Command::cargo_bin("ggrade")
        .unwrap()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["corpus", "--assignment", assignment])
        .output()
        .unwrap();
    let found = String::from_utf8_lossy(&output.stdout);
    let last = found.lines().last().unwrap_or_default();
    let is_expected = output.status.code() == Some(0) && last == format!("{count} of {count} samples are as expected");
    (!is_expected).then(|| format!("{homework}: {found}{}", String::from_utf8_lossy(&output.stderr)))
}

#[test]
fn every_homework_of_the_samples_is_counted() {
    let mut homeworks: Vec<_> = entries(&submissions()).iter().map(|path| name(path)).collect();
    homeworks.sort();
    assert_eq!(homeworks, SAMPLES.map(|(homework, _)| homework));
}

#[test]
fn a_folder_says_the_verdict_of_all_in_it() {
    let mut astray = Vec::new();
    for (_, path) in expectations() {
        let text = std::fs::read_to_string(&path).unwrap();
        let expected: Value = serde_json::from_str(&text).unwrap();
        let said: Vec<_> = path
            .parent()
            .unwrap()
            .strip_prefix(submissions())
            .unwrap()
            .iter()
            .filter_map(|part| FOLDERS.iter().find(|(folder, _)| part == *folder))
            .map(|(_, verdict)| *verdict)
            .collect();
        if said != [expected["verdict"].as_str().unwrap()] {
            astray.push(format!("{} is {}", path.display(), expected["verdict"]));
        }
    }
    assert!(astray.is_empty(), "{}", astray.join("\n"));
}

/// Two samples with the same text and the same expectation are one. Line ends and blanks at the end of a line make no
/// other text.
#[test]
fn no_sample_is_there_twice() {
    let mut texts: BTreeMap<(Vec<Vec<u8>>, String), PathBuf> = BTreeMap::new();
    let mut twice = Vec::new();
    for (sample, expectation) in expectations() {
        let mut files = if sample.is_dir() { entries(&sample) } else { vec![sample.clone()] };
        files.sort();
        let lines = |file: &PathBuf| {
            let bytes = std::fs::read(file).unwrap();
            let lines = bytes.split(|byte| *byte == b'\n').map(|line| line.trim_ascii_end().to_vec());
            let mut lines: Vec<_> = lines.collect();
            let end = lines.iter().rposition(|line| !line.is_empty()).map_or(0, |last| last + 1);
            lines.truncate(end);
            lines
        };
        let key = (files.iter().flat_map(lines).collect(), std::fs::read_to_string(&expectation).unwrap());
        if let Some(other) = texts.insert(key, sample.clone()) {
            twice.push(format!("{} and {}", other.display(), sample.display()));
        }
    }
    assert!(twice.is_empty(), "{}", twice.join("\n"));
}

fn submissions() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions")
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

/// Every sample with its expectation.
fn expectations() -> Vec<(PathBuf, PathBuf)> {
    let mut folders = vec![submissions()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for path in entries(&folder) {
            // A sample of several files is a folder with its expectation beside it.
            let expectation = path.with_extension("json");
            if path.is_dir() && expectation.exists() {
                found.push((path, expectation));
            } else if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_none_or(|extension| extension != "json") {
                found.push((path, expectation));
            }
        }
    }
    assert_eq!(found.len(), SAMPLES.iter().map(|(_, count)| count).sum::<usize>());
    found
}

#[test]
fn a_folder_without_samples_is_no_success() {
    let folder = tempfile::tempdir().unwrap();
    Command::cargo_bin("ggrade").unwrap().arg("corpus").arg(folder.path()).assert().code(3);
}

#[test]
fn an_expectation_without_a_sample_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("lonely.json"), "{}").unwrap();
    std::fs::write(folder.path().join("other.vert"), "void main() {}").unwrap();
    let output = Command::cargo_bin("ggrade").unwrap().arg("corpus").arg(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&output.stderr).contains("lonely.json"));
}

#[test]
fn a_sample_without_an_expectation_is_a_difference_until_it_is_blessed() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("new.vert"), "void main() {}").unwrap();
    let corpus = |more: &[&str]| {
        let mut command = Command::cargo_bin("ggrade").unwrap();
        command.env_remove("CI").arg("corpus").arg(folder.path()).args(more).assert()
    };
    corpus(&[]).code(1);
    corpus(&["--bless"]).code(1).stderr(predicates::str::contains("1 expected reports were written anew"));
    corpus(&[]).code(0);

    // The wording is held.
    let expectation = folder.path().join("new.json");
    let text = std::fs::read_to_string(&expectation).unwrap();
    let other = text.replace("not judged", "not looked at");
    assert_ne!(other, text);
    std::fs::write(&expectation, other).unwrap();
    corpus(&[]).code(1).stdout(predicates::str::contains("expected  not looked at"));
}

/// The homework, with the reflection vector as right as the half vector where `accepted` says so.
fn homework(accepted: &str) -> Arc<Assignment> {
    let mut folder = Folder::clone(&reference::assignment("ggsample06").unwrap().folder);
    let line = "solution = \"solution.vert\"\n";
    let phong = folder.text("solution.vert").unwrap().replace("dot(n, h)", "dot(reflect(-l, n), v)");
    let manifest = folder.text(MANIFEST).unwrap().replace(line, &format!("{line}{accepted}"));
    folder.files.extend([("phong.vert".into(), phong.into()), (MANIFEST.into(), manifest.into())]);
    Arc::new(Assignment::load(folder).unwrap())
}

/// A shader that agrees with an accepted answer everywhere is right; one that agrees with none is judged by the solution.
#[test]
fn what_agrees_with_an_accepted_answer_is_right() {
    let sample = |name: &str| std::fs::read(submissions().join("ggsample06").join(name)).unwrap();
    let [right, phong, both] = [
        "accepted/answers/all-in-one-expression.vert",
        "wrong/specular-phong--reflect.vert",
        "wrong/ambient-missing+specular-phong--reflection-vector.vert",
    ]
    .map(sample);
    let mut judged = Vec::new();
    for accepted in ["", "accepted = [\"phong.vert\"]\n"] {
        let mut grader = Grader::open(homework(accepted), AdapterKind::Software).unwrap();
        for bytes in [&right, &phong, &both] {
            let report = grader
                .grade(&HandIn::of_one("ggsample06.vert", bytes.as_slice()), Order { seed: 1, ..Order::default() })
                .unwrap()
                .report;
            judged.push((report.verdict, report.mistakes.len(), report.score == report.max_score, report.advice.len()));
        }
    }
    // The first has a piece of advice, which is about the solution.
    let correct = |advice| (Verdict::Correct, 0, true, advice);
    let wrong = |mistakes| (Verdict::Wrong, mistakes, false, 0);
    assert_eq!(judged, [correct(1), wrong(1), wrong(2), correct(1), correct(0), wrong(2)]);
}
