//! Every sample of `submissions/` gets the report that stands beside it. `BLESS=1` writes the reports anew, and is red.

#[path = "corpus/seed.rs"]
mod seed;

use assert_cmd::Command;
use ggrade::grade::{Grader, Order};
use ggrade::hand_in::HandIn;
use ggrade::render::AdapterKind;
use ggrade::report::Verdict;
use reference::assignment::MANIFEST;
use reference::{Assignment, Folder};
use std::path::Path;
use std::sync::Arc;

#[test]
fn every_sample_gets_its_expected_report() {
    let output = Command::cargo_bin("ggrade")
        .unwrap()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["corpus"])
        .output()
        .unwrap();
    let found = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{found}{errors}");
    let last = found.lines().last().unwrap_or_default();
    let samples: usize = last.split_whitespace().next().and_then(|count| count.parse().ok()).unwrap_or(0);
    assert!(samples > 500, "only {samples} samples were graded: {last}");
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
fn a_sample_without_an_expectation_is_a_difference() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("new.vert"), "void main() {}").unwrap();
    Command::cargo_bin("ggrade").unwrap().arg("corpus").arg(folder.path()).assert().code(1);
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
    let sample = |name: &str| {
        std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(name)).unwrap()
    };
    let [right, phong, both] = [
        "accepted/answers/all-in-one-expression.vert",
        "wrong/specular-phong--reflect.vert",
        "wrong/ambient-missing+specular-phong--reflection-vector.vert",
    ]
    .map(sample);
    let mut judged = Vec::new();
    for accepted in ["", "accepted = [\"phong.vert\"]\n"] {
        let mut grader = Grader::new(homework(accepted), AdapterKind::Software).unwrap();
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
