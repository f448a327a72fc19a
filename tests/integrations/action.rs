//! The GitHub Action: its step runs as a runner runs it, with a `docker` that starts ggrade itself.

use super::repository;
use serde_json::Value;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

fn action() -> Value {
    serde_yaml_ng::from_str(&fs::read_to_string(repository().join("action.yml")).unwrap()).unwrap()
}

/// Takes the options of `docker run` that the action uses, and runs ggrade in their place, in the folder that is mounted.
const DOCKER: &str = r#"#!/bin/bash
set -eu
echo "$*" >>"$DOCKER_LOG"
[ "$1" = run ] && shift
while [ $# -gt 0 ]; do
    case $1 in
    --rm) shift ;;
    --network | --user) shift 2 ;;
    --env) [ "${2%%=*}" = GITHUB_STEP_SUMMARY ] || export "$2"; shift 2 ;;
    --volume)
        case $2 in
        *:/work) cd "${2%:/work}" ;;
        *:/summary) export GITHUB_STEP_SUMMARY="${2%:/summary}" ;;
        *) exit 125 ;;
        esac
        shift 2 ;;
    --*) exit 125 ;;
    *) break ;;
    esac
done
[ "$1" = registry.example/ggrade:1 ] || exit 125
shift
exec "$GGRADE" "$@"
"#;

struct Ran {
    code: i32,
    said: String,
    outputs: String,
    summary: String,
}

/// Runs the step in a workspace with these inputs.
fn run(workspace: &Path, inputs: &[(&str, &str)]) -> Ran {
    let runner = tempfile::tempdir().unwrap();
    let docker = runner.path().join("docker");
    fs::write(&docker, DOCKER).unwrap();
    fs::set_permissions(&docker, fs::Permissions::from_mode(0o755)).unwrap();
    let [summary, outputs, log] = ["summary", "outputs", "log"].map(|name| {
        fs::write(runner.path().join(name), "").unwrap();
        runner.path().join(name)
    });
    let action = action();
    let step = &action["runs"]["steps"][0];
    assert_eq!(step["shell"], "bash");
    let mut command = Command::new("bash");
    command.args(["--noprofile", "--norc", "-e", "-o", "pipefail", "-c", step["run"].as_str().unwrap()]);
    command.current_dir(workspace).env("GGRADE", env!("CARGO_BIN_EXE_ggrade")).env("DOCKER_LOG", &log);
    for (name, value) in step["env"].as_object().unwrap() {
        let input = value.as_str().unwrap().strip_prefix("${{ inputs.").and_then(|rest| rest.strip_suffix(" }}"));
        let input = input.unwrap_or_else(|| panic!("{name} is no input"));
        let declared = &action["inputs"][input];
        assert!(declared.is_object(), "{input} is not declared");
        let given = inputs.iter().find(|(name, _)| *name == input).map(|(_, value)| *value);
        command.env(name, given.or(declared["default"].as_str()).unwrap_or_else(|| panic!("{input} is required")));
    }
    let path = format!("{}:{}", runner.path().display(), std::env::var("PATH").unwrap());
    command.env("PATH", path).env("GITHUB_WORKSPACE", workspace).env("GITHUB_RUN_ID", "1658821493");
    command.env("GITHUB_STEP_SUMMARY", &summary).env("GITHUB_OUTPUT", &outputs).env("GGRADE_DEADLINE", "30");
    let output = command.output().unwrap();
    let said = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let [summary, outputs] = [summary, outputs].map(|file| fs::read_to_string(file).unwrap());
    Ran { code: output.status.code().unwrap(), said, outputs, summary }
}

const IMAGE: (&str, &str) = ("image", "registry.example/ggrade:1");

#[test]
fn the_step_marks_lines_and_leaves_a_summary_and_a_page() {
    let workspace = tempfile::tempdir().unwrap();
    fs::copy(super::wrong(), workspace.path().join("a.vert")).unwrap();
    let inputs = [IMAGE, ("files", "a.vert\n"), ("language", "ja"), ("report", "report.html")];
    let ran = run(workspace.path(), &inputs);
    assert_eq!((ran.code, ran.outputs.as_str()), (1, "exit-code=1\n"), "{}", ran.said);
    assert!(ran.said.contains("::warning file=a.vert,line=33"), "{}", ran.said);
    assert!(ran.summary.starts_with("## ggrade: a"), "{}", ran.summary);
    let page = fs::read_to_string(workspace.path().join("report.html")).unwrap();
    assert!(page.contains("lang=\"ja\"") && page.contains("1658821493"));
}

#[test]
fn inputs_are_words_and_no_commands() {
    let workspace = tempfile::tempdir().unwrap();
    fs::copy(super::correct(), workspace.path().join("a b; touch pwned.vert")).unwrap();
    let inputs = [IMAGE, ("files", "a b; touch pwned.vert"), ("assignment", "ggsample06")];
    let ran = run(workspace.path(), &inputs);
    assert_eq!((ran.code, ran.outputs.as_str()), (0, "exit-code=0\n"), "{}", ran.said);
    assert_eq!(fs::read_dir(workspace.path()).unwrap().count(), 1);
    // An unknown homework is the workflow's mistake, and a missing file is nothing to grade.
    let ran = run(workspace.path(), &[IMAGE, ("files", "a b; touch pwned.vert"), ("assignment", "$(touch x)")]);
    assert_eq!(ran.outputs, "exit-code=2\n", "{}", ran.said);
    let ran = run(workspace.path(), &[IMAGE, ("files", "missing.vert")]);
    assert_eq!((ran.code, ran.outputs.as_str()), (4, "exit-code=4\n"), "{}", ran.said);
}

#[test]
fn each_input_is_used_and_each_output_is_made() {
    let action = action();
    let step = action["runs"]["steps"][0].to_string();
    for input in action["inputs"].as_object().unwrap().keys() {
        assert!(step.contains(&format!("inputs.{input} ")), "{input} is not used");
    }
    assert_eq!(action["outputs"].as_object().unwrap().keys().collect::<Vec<_>>(), ["exit-code"]);
    // In the form of a runner no input stands in the script itself.
    assert!(!action["runs"]["steps"][0]["run"].as_str().unwrap().contains("${{"));
}
