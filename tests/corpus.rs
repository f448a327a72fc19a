//! Every sample of `submissions/` gets the report that stands beside it. `BLESS=1` writes the reports anew, and is red.

use assert_cmd::Command;

#[test]
fn every_sample_gets_its_expected_report() {
    let output = Command::cargo_bin("ggrade")
        .unwrap()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["corpus", "submissions"])
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
