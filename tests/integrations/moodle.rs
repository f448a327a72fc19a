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
    // CodeRunner marks 0 where there is no fraction, and shows the object as it is: so it is told what to show.
    let no_driver = folder_with_a_program("exec env VK_DRIVER_FILES=/nonexistent/driver.json \"$REAL\" \"$@\"", real);
    for failing in ["/nonexistent/ggrade", no_driver.path().join("ggrade").to_str().unwrap()] {
        let result = run("", failing);
        assert!(is_valid("coderunner-combinator.schema.json", &result), "{result:#}");
        let text = result["prologuehtml"].as_str().unwrap();
        assert!(text.starts_with("<p>") && text.contains("採点結果ではありません"), "{text}");
        assert_eq!((&result["fraction"], result.get("testresults")), (&json!(0.0), None));
    }
}

/// A folder with `ggrade`, a shell script in which `$REAL` is the program.
fn folder_with_a_program(script: &str, real: &str) -> tempfile::TempDir {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ggrade");
    std::fs::write(&path, format!("#!/bin/sh\nREAL={real}\n{script}\n")).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
    folder
}

/// The exit code, and what is said, of grading a right file in an address space of so many KB, as a job server bounds it.
fn graded_within(kilobytes: &str) -> (Option<i32>, String) {
    let mut shell = Command::new("bash");
    shell.env("GGRADE_DEADLINE", "30").env("REAL", env!("CARGO_BIN_EXE_ggrade"));
    shell.args(["-c", "ulimit -v \"$0\"; exec \"$REAL\" \"$@\"", kilobytes, "grade"]);
    let output = shell.arg(super::correct()).args(["--lang", "en"]).output().unwrap();
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn too_little_memory_is_called_so_and_is_nobodys_mistake() {
    let (code, said) = graded_within("400000");
    assert_eq!(code, Some(3), "{said}");
    assert!(said.contains("too little memory: this process may have 409 MB"), "{said}");
    assert!(said.contains("memory limit 0 in a CodeRunner question") && !said.contains("apt-get"), "{said}");
    // Each limit below what a worker needs fails in another way, and none in a verdict.
    for kilobytes in ["300000", "520000", "545000"] {
        let (code, said) = graded_within(kilobytes);
        assert!(code == Some(0) || code == Some(3) && said.contains("too little memory"), "{kilobytes}: {said}");
    }
}
