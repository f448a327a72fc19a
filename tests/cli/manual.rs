//! Manual pages and completions are made of the command line itself.

use super::ggrade;
use clap::CommandFactory;
use std::collections::BTreeSet;

/// The names of the pages of a command and of those below it; hidden ones have none.
fn pages(command: &clap::Command, name: &str, found: &mut BTreeSet<String>) {
    found.insert(format!("{name}.1"));
    for below in command.get_subcommands().filter(|below| !below.is_hide_set()) {
        pages(below, &format!("{name}-{}", below.get_name()), found);
    }
}

#[test]
fn each_command_has_a_page() {
    let folder = tempfile::tempdir().unwrap();
    ggrade().arg("man").arg(folder.path().join("man")).assert().code(0).stdout("").stderr("");
    let entries = std::fs::read_dir(folder.path().join("man")).unwrap();
    let written: BTreeSet<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    let mut expected = BTreeSet::new();
    pages(&ggrade::cli::Cli::command(), "ggrade", &mut expected);
    assert_eq!(written, expected);
    assert!(written.contains("ggrade-batch-merge.1") && !written.contains("ggrade-worker.1"));
    let serve = std::fs::read_to_string(folder.path().join("man/ggrade-serve.1")).unwrap();
    assert!(serve.contains("\\-\\-healthcheck") && serve.contains("GGRADE_CONFIG"), "{serve}");
    // A folder that cannot be made is named.
    let file = folder.path().join("man/ggrade.1");
    let said = ggrade().arg("man").arg(file.join("x")).assert().code(3).get_output().stderr.clone();
    assert!(String::from_utf8(said).unwrap().contains("ggrade.1/x"));
}

/// What bash offers after these words, the last of which is being typed.
fn offered(script: &std::path::Path, words: &[&str]) -> Vec<String> {
    let program = "source \"$1\"; shift; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _ggrade ggrade \"${@: -1}\" \"${@: -2:1}\"; \
                   printf '%s\\n' \"${COMPREPLY[@]}\"";
    let output =
        std::process::Command::new("bash").args(["-c", program, "bash"]).arg(script).args(words).output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().lines().map(str::to_owned).collect()
}

#[test]
fn bash_completes_commands_options_and_values() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("ggrade.bash");
    let output = ggrade().args(["completions", "bash"]).output().unwrap();
    std::fs::write(&script, output.stdout).unwrap();
    assert_eq!(offered(&script, &["ggrade", "gra"]), ["grade"]);
    assert_eq!(offered(&script, &["ggrade", "grade", "--cross"]), ["--cross-check"]);
    assert_eq!(offered(&script, &["ggrade", "grade", "--lang", "j"]), ["ja"]);
    for shell in ["zsh", "fish", "elvish", "powershell"] {
        let output = ggrade().args(["completions", shell]).assert().code(0).get_output().stdout.clone();
        assert!(String::from_utf8(output).unwrap().contains("healthcheck"), "{shell}");
    }
    ggrade().args(["completions", "cmd"]).assert().code(2);
}
