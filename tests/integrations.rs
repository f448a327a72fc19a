//! The formats of autograders and CI as their systems call ggrade: by the command line, and by the scripts in `deploy/`.

use assert_cmd::Command;
use base64::Engine;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Duration;

fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn correct() -> PathBuf {
    repository().join("submissions/accepted/answers/plain-int-zero.vert")
}

fn wrong() -> PathBuf {
    repository().join("submissions/wrong/specular-half-unnormalized--average.vert")
}

/// A shader whose only mistake is its second line.
fn rejected(folder: &Path) -> PathBuf {
    let file = folder.join("rejected.vert");
    std::fs::write(&file, "#version 410 core\nnot GLSL ::error::Grade :=>> 100\nvoid main() {}\n").unwrap();
    file
}

fn ggrade() -> Command {
    let mut command = Command::cargo_bin("ggrade").unwrap();
    command.env_remove("GITHUB_STEP_SUMMARY").env_remove("GGRADE_LANG").env("LANG", "C");
    command.timeout(Duration::from_secs(60));
    command
}

/// What is printed for a file in a format, and the exit code.
fn printed(format: &str, file: &Path, more: &[&str]) -> (String, i32) {
    let output = ggrade().arg("grade").arg(file).args(["--format", format]).args(more).output().unwrap();
    (String::from_utf8(output.stdout).unwrap(), output.status.code().unwrap())
}

fn json_of(format: &str, file: &Path, more: &[&str]) -> (Value, i32) {
    let (text, code) = printed(format, file, more);
    (serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}")), code)
}

fn is_valid(schema: &str, document: &Value) -> bool {
    let schema = std::fs::read_to_string(repository().join("tests/schemas").join(schema)).unwrap();
    jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap().is_valid(document)
}

const FORMATS: [&str; 8] =
    ["gradescope", "github", "classroom", "classroom-legacy", "junit", "sarif", "vpl", "coderunner"];

#[test]
fn every_ending_has_a_document_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("ggsample06.vert");
    for format in FORMATS {
        assert_eq!(printed(format, &missing, &[]).1, 4, "{format}");
        let (text, code) = printed(format, &correct(), &["--assignment", "ggsample99"]);
        assert_eq!(code, 3, "{format}");
        assert!(text.len() > 20, "{format}: {text}");
    }
}

#[test]
fn gradescope_gets_partial_scores_and_the_picture() {
    let (results, code) = json_of("gradescope", &wrong(), &["--lang", "ja"]);
    assert_eq!(code, 1);
    assert!(is_valid("gradescope-results.schema.json", &results), "{results:#}");
    assert_eq!((&results["score"], &results["tests"][3]["score"]), (&json!(80.0), &json!(20.0)));
    assert_eq!(results["tests"][3]["name"], "鏡面反射光");
    let output = results["output"].as_str().unwrap();
    let picture = output.split("base64,").nth(1).unwrap().split('"').next().unwrap();
    let picture = base64::engine::general_purpose::STANDARD.decode(picture).unwrap();
    assert_eq!(image::load_from_memory(&picture).unwrap().width(), 160);
    let (results, code) = json_of("gradescope", &correct(), &["--assignment", "ggsample99"]);
    assert_eq!((results.get("score"), code), (None, 3));
}

#[test]
fn github_gets_the_line_and_a_summary() {
    let folder = tempfile::tempdir().unwrap();
    let summary = folder.path().join("summary.md");
    std::fs::write(&summary, "before\n").unwrap();
    rejected(folder.path());
    let run = || {
        let mut command = ggrade();
        command.current_dir(folder.path()).env("GITHUB_STEP_SUMMARY", &summary);
        command.args(["grade", "./rejected.vert", "--format", "github"]).output().unwrap()
    };
    let output = run();
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    let error = text.lines().next().unwrap();
    assert!(error.starts_with("::error file=rejected.vert,line=2,endLine=2,"), "{text}");
    // The line is quoted, and what looks like a command in it stands behind `::stop-commands::`.
    let (_, fenced) = text.split_once("::stop-commands::").unwrap();
    assert!(fenced.contains("not GLSL ::error::Grade"), "{text}");
    let written = std::fs::read_to_string(&summary).unwrap();
    assert!(written.starts_with("before\n## ggrade: rejected&#46;vert\n"), "{written}");
    run();
    assert!(std::fs::read_to_string(&summary).unwrap().len() > written.len());
}

#[test]
fn classrooms_two_forms_agree() {
    let (new, code) = json_of("classroom", &wrong(), &["--seed", "7"]);
    assert_eq!(code, 1);
    let (old, _) = printed("classroom-legacy", &wrong(), &["--seed", "7"]);
    let old = base64::engine::general_purpose::STANDARD.decode(old.trim_end()).unwrap();
    let old: Value = serde_json::from_slice(&old).unwrap();
    assert_eq!((&new["score"], &new["max_score"]), (&json!(80.0), &json!(100.0)));
    assert_eq!(old["max_score"], json!(100.0));
    for (new, old) in new["tests"].as_array().unwrap().iter().zip(old["tests"].as_array().unwrap()) {
        assert_eq!((&new["score"], &new["status"]), (&old["score"], &old["status"]));
    }
}

#[test]
fn sarif_and_junit_name_the_mistake() {
    let (log, _) = json_of("sarif", &wrong(), &[]);
    let result = &log["runs"][0]["results"][0];
    assert_eq!(result["ruleId"], "specular-half-unnormalized");
    assert_eq!(result["locations"][0]["physicalLocation"]["region"]["startLine"], 33);
    let (xml, _) = printed("junit", &wrong(), &[]);
    assert!(xml.contains("type=\"specular-half-unnormalized\""), "{xml}");
}

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
        Command::new("bash")
            .arg(script)
            .env("AUTOGRADER_ROOT", self.0.path())
            .env("LANG", "C")
            .env_remove("GGRADE_LANG")
            .timeout(Duration::from_secs(60))
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

/// What VPL makes of an output: the last proposed grade.
fn grade(output: &str) -> Option<&str> {
    output.lines().filter_map(|line| line.strip_prefix("Grade :=>>")).next_back().map(str::trim)
}

#[test]
fn vpl_evaluates_on_its_own_scale() {
    let folder = tempfile::tempdir().unwrap();
    let script = repository().join("deploy/vpl/vpl_evaluate.sh");
    std::fs::write(
        folder.path().join("vpl_environment.sh"),
        "export VPL_GRADEMIN=0\nexport VPL_GRADEMAX=10.00000\nexport VPL_LANG=ja_JP.UTF-8\n",
    )
    .unwrap();
    let run = |ggrade: &str| {
        let _ = std::fs::remove_file(folder.path().join("vpl_execution"));
        Command::new("bash").arg(&script).current_dir(folder.path()).env("GGRADE", ggrade).assert().code(0);
        // VPL runs it in a process without the variables.
        let mut execution = Command::new(folder.path().join("vpl_execution"));
        execution.current_dir(folder.path()).env_remove("VPL_GRADEMAX").timeout(Duration::from_secs(60));
        String::from_utf8(execution.output().unwrap().stdout).unwrap()
    };
    let real = env!("CARGO_BIN_EXE_ggrade");
    assert_eq!(grade(&run(real)), Some("0"), "nothing handed in");
    std::fs::copy(wrong(), folder.path().join("ggsample06.vert")).unwrap();
    let output = run(real);
    assert_eq!(grade(&output), Some("8"), "{output}");
    assert!(output.contains("-鏡面反射光 20 / 40"), "{output}");
    std::fs::copy(rejected(folder.path()), folder.path().join("ggsample06.vert")).unwrap();
    assert_eq!(grade(&run(real)), Some("0"));
    let output = run("/nonexistent/ggrade");
    assert!(grade(&output).is_none() && output.starts_with("Comment :=>> ggrade ended with 127"), "{output}");
}

/// The template with `answer` in its place, as Twig's `e('py')` of CodeRunner escapes it for a Python string.
fn template(answer: &str) -> String {
    let template = std::fs::read_to_string(repository().join("deploy/coderunner/template.py")).unwrap();
    let escaped = answer.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n");
    let filled = template.replace("{{ STUDENT_ANSWER | e('py') }}", &escaped);
    assert_ne!(filled, template);
    filled
}

#[test]
fn coderunner_gets_a_fraction_from_the_template() {
    let run = |answer: &str, ggrade: &str| -> Value {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("template.py"), template(answer)).unwrap();
        let mut python = Command::new("python3");
        python.arg("template.py").current_dir(folder.path()).env("GGRADE", ggrade).timeout(Duration::from_secs(60));
        let output = python.output().unwrap();
        assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let real = env!("CARGO_BIN_EXE_ggrade");
    let result = run(&std::fs::read_to_string(wrong()).unwrap(), real);
    assert!(is_valid("coderunner-combinator.schema.json", &result), "{result:#}");
    assert_eq!((&result["fraction"], &result["testresults"][4][1]), (&json!(0.8), &json!("鏡面反射光")));
    let result = run("\"\"\" + open('/etc/passwd') + \"\"\"\\", real);
    assert_eq!(result["fraction"], json!(0.0));
    let result = run("", "/nonexistent/ggrade");
    assert!(result.get("fraction").is_none(), "{result:#}");
}
