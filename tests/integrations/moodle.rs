//! Moodle's VPL and CodeRunner.

use super::{is_valid, program, rejected, repository, wrong};
use assert_cmd::Command;
use serde_json::{Value, json};

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
        let mut execution = program(folder.path().join("vpl_execution"));
        execution.current_dir(folder.path()).env_remove("VPL_GRADEMAX");
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
        let mut python = program("python3");
        python.arg("template.py").current_dir(folder.path()).env("GGRADE", ggrade);
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
