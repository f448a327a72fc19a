//! Gradescope's autograder as its container calls it.

use super::{correct, is_valid, program, repository, wrong};
use assert_cmd::Command;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Gradescope's folders in a temporary place, with ggrade where the ZIP puts it.
struct Container(tempfile::TempDir);

impl Container {
    fn new(settings: &str) -> Self {
        let container = Self(tempfile::tempdir().unwrap());
        for folder in ["source", "submission", "results"] {
            std::fs::create_dir(container.at(folder)).unwrap();
        }
        std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_ggrade"), container.at("source/ggrade")).unwrap();
        std::fs::write(container.at("source/settings"), settings).unwrap();
        container
    }

    fn at(&self, path: &str) -> PathBuf {
        self.0.path().join(path)
    }

    fn hand_in(&self, name: &str, file: &Path) -> &Self {
        let target = self.at("submission").join(name);
        std::fs::create_dir_all(target.parent().unwrap()).unwrap();
        std::fs::copy(file, target).unwrap();
        self
    }

    /// Runs `run_autograder` as Gradescope does; its results.
    fn run(&self) -> Value {
        self.run_script(&repository().join("deploy/gradescope/run_autograder"))
    }

    fn run_script(&self, script: &Path) -> Value {
        program("bash")
            .arg(script)
            .env("AUTOGRADER_ROOT", self.0.path())
            .env("LANG", "C")
            .env_remove("GGRADE_LANG")
            .assert()
            .code(0);
        let text = std::fs::read_to_string(self.at("results/results.json")).unwrap();
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
    }
}

fn has_no_score(results: &Value) -> bool {
    let tests = results["tests"].as_array().into_iter().flatten();
    results.get("score").is_none() && tests.into_iter().all(|test| test.get("score").is_none())
}

#[test]
fn run_autograder_grades_what_was_handed_in() {
    let container = Container::new("GGRADE_LANG=ja\n");
    let results = container.hand_in("ggsample06.vert", &correct()).run();
    assert!(is_valid("gradescope-results.schema.json", &results), "{results:#}");
    assert_eq!(results["score"], json!(100.0));
    assert!(results["output"].as_str().unwrap().contains("正解"));
    // The next submission in the same container.
    let results = container.hand_in("ggsample06.vert", &wrong()).run();
    assert_eq!(results["score"], json!(80.0));
}

#[test]
fn run_autograder_finds_the_one_file_that_is_meant() {
    let container = Container::new("");
    // What archives of macOS bring along, another name, and a folder with blanks and a line end in its name.
    container.hand_in("__MACOSX/._ggsample06.vert", &wrong()).hand_in("._x.vert", &wrong());
    let results = container.hand_in("my work\n(1)/Homework.VERT", &correct()).run();
    assert_eq!(results["score"], json!(100.0), "{results:#}");
    // A second shader: the one with the wanted name is meant.
    let results = container.hand_in("other/GGsample06.vert", &wrong()).run();
    assert_eq!(results["score"], json!(80.0), "{results:#}");
}

#[test]
fn run_autograder_says_what_is_missing() {
    let container = Container::new("");
    let results = container.run();
    assert!(is_valid("gradescope-results.schema.json", &results));
    assert_eq!(results["score"], 0);
    assert!(results["output"].as_str().unwrap().contains("no .vert file"));
    let results = container.hand_in("a.vert", &correct()).hand_in("b.vert", &wrong()).run();
    assert!(is_valid("gradescope-results.schema.json", &results));
    assert!(results["output"].as_str().unwrap().contains("2 .vert files"));
}

#[test]
fn run_autograder_follows_no_link_out_of_the_submission() {
    let container = Container::new("");
    std::os::unix::fs::symlink(correct(), container.at("submission/ggsample06.vert")).unwrap();
    assert!(container.run()["output"].as_str().unwrap().contains("no .vert file"));
}

#[test]
fn run_autograder_gives_no_score_when_ggrade_fails() {
    // ggrade refuses its command line; it is not there; it is killed; it writes nothing.
    let container = Container::new("GGRADE_SANDBOX=nonsense\n");
    let results = container.hand_in("ggsample06.vert", &correct()).run();
    assert!(has_no_score(&results) && results["output"].as_str().unwrap().contains("costs no points"), "{results:#}");
    let container = Container::new("GGRADE_LANG=ja\n");
    container.hand_in("ggsample06.vert", &correct());
    let program = container.at("source/ggrade");
    std::fs::remove_file(&program).unwrap();
    let results = container.run();
    assert!(
        has_no_score(&results) && results["output"].as_str().unwrap().contains("減点にもなりません"),
        "{results:#}"
    );
    for body in ["kill -KILL $$", "exit 1"] {
        std::fs::write(&program, format!("#!/bin/sh\n{body}\n")).unwrap();
        std::fs::set_permissions(&program, std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
        assert!(has_no_score(&container.run()), "{body}");
    }
}

#[test]
fn a_result_is_there_even_when_the_time_is_up() {
    let container = Container::new("");
    container.hand_in("ggsample06.vert", &correct());
    let program = container.at("source/ggrade");
    std::fs::remove_file(&program).unwrap();
    // What Gradescope kills at its time limit leaves what is there at that moment.
    std::fs::write(
        &program,
        "#!/bin/sh\ncp \"$AUTOGRADER_ROOT/results/results.json\" \"$AUTOGRADER_ROOT/then.json\"\n",
    )
    .unwrap();
    std::fs::set_permissions(&program, std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
    container.run();
    let then = std::fs::read_to_string(container.at("then.json")).unwrap();
    assert!(has_no_score(&serde_json::from_str(&then).unwrap()));
}

#[test]
fn the_gradescope_archive_grades() {
    let folder = tempfile::tempdir().unwrap();
    let archive = folder.path().join("autograder.zip");
    let pack = |glibc: &str| {
        let mut script = Command::new(repository().join("script/gradescope"));
        script.args(["--lang", "ja", "--glibc", glibc, "--binary", env!("CARGO_BIN_EXE_ggrade"), "--output"]);
        script.arg(&archive).assert()
    };
    // Whatever this machine's C library is: it is this machine that runs the program here.
    pack("99").code(0);
    let container = Container::new("");
    std::fs::remove_dir_all(container.at("source")).unwrap();
    zip::ZipArchive::new(std::fs::File::open(&archive).unwrap()).unwrap().extract(container.at("source")).unwrap();
    let script = container.at("source/run_autograder");
    let results = container.hand_in("ggsample06.vert", &wrong()).run_script(&script);
    assert_eq!((&results["score"], &results["tests"][3]["name"]), (&json!(80.0), &json!("鏡面反射光")));
    assert!(container.at("source/setup.sh").exists());
    // The C library of the year 2006 is too old for any Rust program.
    pack("2.5").code(3).stderr(predicates::str::contains("2.5"));
}
