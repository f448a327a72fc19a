//! The command line by what a person sees of it: exit codes, output, files.

#[path = "cli/assignment.rs"]
mod assignment;
#[path = "cli/authoring.rs"]
mod authoring;
#[path = "cli/blocks.rs"]
mod blocks;
#[path = "cli/equivalents.rs"]
mod equivalents;
#[path = "cli/folders.rs"]
mod folders;
#[path = "cli/manual.rs"]
mod manual;
#[path = "cli/marble.rs"]
mod marble;
#[path = "cli/messages.rs"]
mod messages;
#[path = "cli/own_values.rs"]
mod own_values;
#[path = "cli/parts.rs"]
mod parts;
#[path = "cli/preview.rs"]
mod preview;
#[path = "cli/proposals.rs"]
mod proposals;
#[path = "cli/refusals.rs"]
mod refusals;
#[path = "cli/solutions.rs"]
mod solutions;
#[path = "cli/written.rs"]
mod written;

use assert_cmd::Command;
use predicates::prelude::*;
use std::path::{Path, PathBuf};

fn ggrade() -> Command {
    let mut command = Command::cargo_bin("ggrade").unwrap();
    command.env_remove("GGRADE_LANG").env_remove("LC_ALL").env("LANG", "C");
    command
}

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(name)
}

/// Some sample of a folder whose name begins so.
fn sample_like(folder: &str, start: &str) -> PathBuf {
    let entries = std::fs::read_dir(sample(folder)).unwrap();
    let mut found: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    found.retain(|path| {
        path.extension().is_some_and(|e| e == "vert") && path.file_name().unwrap().to_string_lossy().starts_with(start)
    });
    found.sort();
    found.into_iter().next().unwrap_or_else(|| panic!("no sample {folder}/{start}*"))
}

fn json(file: &Path, arguments: &[&str]) -> serde_json::Value {
    let output = ggrade().arg("grade").arg(file).args(["--format", "json"]).args(arguments).output().unwrap();
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {}", String::from_utf8_lossy(&output.stderr)))
}

#[test]
fn a_right_answer_ends_with_0_and_says_what_agrees() {
    ggrade()
        .arg("grade")
        .arg(sample_like("accepted/answers", "plain-int-zero"))
        .assert()
        .code(0)
        .stdout(
            predicate::str::contains("100 / 100").and(predicate::str::contains("Every frame and every probe agrees")),
        )
        .stderr("");
}

#[test]
fn a_wrong_answer_ends_with_1_and_names_the_mistake() {
    ggrade()
        .arg("grade")
        .arg(sample_like("wrong", "specular-half-unnormalized--"))
        .assert()
        .code(1)
        .stdout(predicate::str::contains("Half vector not normalised").and(predicate::str::contains("40")));
}

#[test]
fn a_second_opinion_is_given_where_it_is_asked_for() {
    let right = sample_like("accepted/answers", "plain-int-zero");
    assert!(json(&right, &[]).get("cross_check").is_none());
    let checked = &json(&right, &["--cross-check"])["cross_check"];
    // 25 frames of three vertices, 560 probes that judge, and 80 fresh ones.
    assert_eq!((&checked["opinion"], &checked["agreeing"]), (&"agrees".into(), &715.into()));
    ggrade()
        .arg("grade")
        .arg(&right)
        .arg("--cross-check")
        .assert()
        .code(0)
        .stdout(predicate::str::contains("Interpreter  715 vertices agree with the driver, 0 differ"));
    // What the interpreter finds never changes what is judged.
    let wrong = sample_like("wrong", "specular-half-unnormalized--");
    let [without, with] = [vec![], vec!["--cross-check"]].map(|arguments| json(&wrong, &arguments)["score"].clone());
    assert_eq!(without, with);
}

#[test]
fn a_folder_is_held_against_the_interpreter() {
    ggrade()
        .arg("corpus")
        .arg(sample("accepted/translate"))
        .arg("--cross-check")
        .assert()
        .code(0)
        .stdout(predicate::str::contains("that were drawn agree with the interpreter; 0 differ, 0 were not run"));
}

#[test]
fn the_unchanged_starter_scores_0() {
    let starter = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/assignments/ggsample06/starter.vert");
    let report = json(&starter, &[]);
    assert_eq!(report["score"], 0);
    assert_eq!(report["mistakes"], serde_json::json!(["unchanged"]));
}

#[test]
fn a_broken_file_is_rejected_with_its_line_under_a_caret() {
    ggrade().arg("grade").arg(sample_like("rejected", "undeclared-capital-max")).assert().code(1).stdout(
        predicate::str::contains("Max").and(predicate::str::contains("^")).and(predicate::str::contains("max")),
    );
}

#[test]
fn the_json_report_has_the_fields_of_the_contract_in_their_order() {
    let report = json(&sample_like("accepted/answers", "plain-int-zero"), &["--seed", "7"]);
    let keys: Vec<_> = report.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(
        keys,
        [
            "schema",
            "assignment",
            "assignment_digest",
            "source",
            "sources",
            "verdict",
            "score",
            "max_score",
            "rubric",
            "mistakes",
            "advice",
            "diagnostics",
            "frames",
            "probes",
            "environment",
            "elapsed_ms"
        ]
    );
    assert_eq!(report["schema"], "ggrade/report/v1");
    assert_eq!(report["probes"]["seed"], 7);
    assert_eq!(report["frames"].as_array().unwrap().len(), 25);
}

#[test]
fn one_seed_gives_one_report() {
    let file = sample_like("wrong", "specular-phong--");
    let of_seed = |seed: &str| {
        let mut report = json(&file, &["--seed", seed]);
        report["elapsed_ms"].take();
        report
    };
    assert_eq!(of_seed("11"), of_seed("11"));
    assert_ne!(of_seed("11")["probes"], of_seed("12")["probes"]);
}

#[test]
fn both_languages_are_spoken() {
    let file = sample_like("wrong", "ambient-missing--");
    ggrade().arg("grade").arg(&file).args(["--lang", "ja"]).assert().stdout(predicate::str::contains("環境光"));
    ggrade().arg("grade").arg(&file).env("LANG", "ja_JP.UTF-8").assert().stdout(predicate::str::contains("環境光"));
    ggrade().arg("grade").arg(&file).args(["--lang", "en"]).assert().stdout(predicate::str::contains("Ambient"));
}

#[test]
fn no_colour_reaches_a_pipe() {
    let file = sample_like("wrong", "ambient-missing--");
    ggrade().arg("grade").arg(&file).assert().stdout(predicate::str::contains("\u{1b}[").not());
    ggrade().arg("grade").arg(&file).env("CLICOLOR_FORCE", "1").assert().stdout(predicate::str::contains("\u{1b}["));
}

#[test]
fn standard_input_is_graded_too() {
    let bytes = std::fs::read(sample_like("accepted/answers", "plain-int-zero")).unwrap();
    ggrade().args(["grade", "-"]).write_stdin(bytes).assert().code(0);
}

#[test]
fn a_file_that_is_not_there_ends_with_4() {
    ggrade()
        .args(["grade", "/nonexistent/ggsample06.vert"])
        .assert()
        .code(4)
        .stdout("")
        .stderr(predicate::str::contains("/nonexistent/ggsample06.vert"));
    ggrade().arg("grade").arg(tempfile::tempdir().unwrap().path()).assert().code(4);
}

#[test]
fn a_wrong_command_line_ends_with_2() {
    ggrade().args(["grade", "a.vert", "--format", "pdf"]).assert().code(2);
    ggrade().args(["grade", "a.vert", "--deadline", "-1"]).assert().code(2);
    ggrade().assert().code(2);
}

#[test]
fn an_unknown_assignment_is_a_usage_error_and_the_known_ones_are_named() {
    ggrade()
        .arg("grade")
        .arg(sample_like("accepted/answers", "plain-int-zero"))
        .args(["--assignment", "ggsample99"])
        .assert()
        .code(2)
        .stderr(predicate::str::contains("ggsample06"));
}

#[test]
fn a_missing_driver_is_our_fault_and_the_package_is_named() {
    ggrade()
        .arg("grade")
        .arg(sample_like("accepted/answers", "plain-int-zero"))
        .args(["--adapter", "gpu"])
        .assert()
        // A machine that has a graphics card grades with it.
        .code(predicate::in_iter([0, 3]));
}

#[test]
fn the_doctor_finds_this_machine_well() {
    let name = format!("ok   ggrade {} (", env!("CARGO_PKG_VERSION"));
    ggrade().arg("doctor").assert().code(0).stdout(
        predicate::str::starts_with(name)
            .and(predicate::str::contains("llvmpipe"))
            .and(predicate::str::contains("https: ")),
    );
}

#[test]
fn a_folder_or_an_archive_is_graded_as_one_hand_in() {
    let folder = tempfile::tempdir().unwrap();
    let right = std::fs::read(sample_like("accepted/answers", "plain-int-zero")).unwrap();
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    std::fs::write(folder.path().join("mine/ggsample06.vert"), &right).unwrap();
    std::fs::write(folder.path().join("mine/readme.txt"), "hello").unwrap();
    let report = json(&folder.path().join("mine"), &[]);
    assert_eq!((&report["verdict"], &report["sources"][0]["name"]), (&"correct".into(), &"ggsample06.vert".into()));
    let mut zip = zip::ZipWriter::new(std::fs::File::create(folder.path().join("mine.zip")).unwrap());
    zip.start_file("deep/ggsample06.vert", zip::write::SimpleFileOptions::default()).unwrap();
    std::io::Write::write_all(&mut zip, &right).unwrap();
    zip.finish().unwrap();
    assert_eq!(json(&folder.path().join("mine.zip"), &[])["verdict"], "correct");
    // Beside the file of the homework's name, others are left aside; without it, two are a question.
    let notes = folder.path().join("notes.vert");
    std::fs::write(&notes, "x").unwrap();
    ggrade().arg("grade").arg(folder.path().join("mine/ggsample06.vert")).arg(&notes).assert().code(0);
    let other = folder.path().join("other.vert");
    std::fs::write(&other, "y").unwrap();
    ggrade()
        .arg("grade")
        .args([&notes, &other])
        .assert()
        .code(4)
        .stderr(predicate::str::contains("Several files could be the one to grade: `notes.vert`, `other.vert`"));
}
